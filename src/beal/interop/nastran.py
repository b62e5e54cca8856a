"""Stick models in Nastran bulk data become vehicles.

The reader is our own: pyNastran 1.4 holds NumPy below 2 and needs matplotlib, takes 0.6 s to import, stops at the first
bad card and does not say in which line; this one names every line that is wrong, and what it leaves out.
"""

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from beal.errors import ModelError
from beal.interop.bulk import understood
from beal.interop.cards import Deck, read_deck
from beal.interop.joined import joined
from beal.interop.stick import described
from beal.interop.structure import listed, shown
from beal.interop.view import viewed
from beal.units import to_si
from beal.vehicle.file import vehicle_from
from beal.vehicle.vehicle import Vehicle

PLANES = ("xy", "xz", "yx", "yz", "zx", "zy")


@dataclass(frozen=True)
class Imported:
    """A vehicle from another program's file, and how it was understood.

    Parameters
    ----------
    vehicle : Vehicle
    notes : tuple of str
        What was assumed, and what the file holds that has no influence.
    ignored : tuple of str
        What was left out or simplified although it has an influence.
    """

    vehicle: Vehicle
    notes: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()


def read_nastran(
    path: str | os.PathLike[str],
    plane: str | None = None,
    nose: Literal["high", "low"] = "high",
    lumps: Literal["keep", "spread"] = "keep",
    length_unit: str = "m",
    force_unit: str = "N",
) -> Imported:
    """Read the vehicle that a stick model in Nastran bulk data describes.

    Bars (CBAR, CBEAM) along one axis become stages, springs (CBUSH, CELAS2) and rigid ties (RBE2) between grids at one
    station joints, CONM2 point masses, and constraints (SPC, SPC1) of the end grids supports.

    Parameters
    ----------
    path : str or path-like
        Small, large or free fields; included files are read too.
    plane : str, optional
        The stick's axis and the direction in which it bends, such as ``xy``.
    nose : {"high", "low"}
        Which end of the axis the nose is: ``high`` where the axis points forward.
    lumps : {"keep", "spread"}
        What to do with masses on grids of bars that have none: leave them there, or spread them along the bars.
    length_unit, force_unit : str
        Units of the deck; that of mass follows, force times second squared per length.

    Returns
    -------
    Imported

    Raises
    ------
    ModelError
        If the deck is no stick: every reason, with its line and card.
    """
    problems = [
        (name, f"must be one of {', '.join(known)}, found {value!r}")
        for name, value, known in (
            ("plane", plane or "xy", PLANES),
            ("nose", nose, ("high", "low")),
            ("lumps", lumps, ("keep", "spread")),
        )
        if value not in known
    ]
    scales = _scales(length_unit, force_unit, problems)
    if problems:
        raise ModelError(problems)
    source = str(path)
    deck = read_deck(path)
    found = understood(deck)
    view = viewed(found, plane, nose)
    data: dict[str, Any] = {}
    if view is not None:
        line = joined(found, view)
        if not found.problems:
            data = described(line, found, lumps == "spread", by_comments=bool(deck.kept))
    kept = _kept(deck, found.problems)
    if kept.get("units") == "nondimensional" and (length_unit, force_unit) != ("m", "N"):
        found.problems.append(("length_unit, force_unit", "do not suit a deck that says it is nondimensional"))
    if found.problems or view is None:
        raise ModelError(shown(found.problems), source)
    end = "highest" if nose == "high" else "lowest"
    notes = [("", f"the nose is at the {end} {'xyz'[view.axis]}, bending in the plane {view.plane}")]
    if kept.get("units") != "nondimensional":
        notes.append(("", f"units: {length_unit}, {force_unit}, s; mass in {force_unit} s^2/{length_unit}"))
        _scale(data, *scales)
    title = "" if deck.kept else Path(path).stem
    vehicle = vehicle_from({"title": title, **_merged(kept, data, source)}, source)
    return Imported(vehicle, listed(notes + found.notes), listed(found.ignored))


def _scales(length_unit: str, force_unit: str, problems: list[tuple[str, str]]) -> tuple[float, float]:
    """SI values of the deck's units."""
    found = []
    for name, unit, wanted in (("length_unit", length_unit, "m"), ("force_unit", force_unit, "N")):
        try:
            found.append(to_si(f"1 {unit}", wanted))
        except ValueError as error:
            problems.append((name, str(error)))
            found.append(1.0)
    return found[0], found[1]


def _scale(data: dict[str, Any], length: float, force: float) -> None:
    """Quantities into SI units, in place."""
    moment, spring = force * length, force / length
    factors = {
        "stage": {
            "length": length,
            "mass_per_length": force / length**2,
            "bending_stiffness": force * length**2,
            "shear_stiffness": force,
        },
        "joint": {
            "rotational_stiffness": moment,
            "shear_stiffness": spring,
            "rotational_damping": moment,
            "shear_damping": spring,
        },
        "point_mass": {"station": length, "mass": spring, "rotary_inertia": moment},
        "support": {"translation": spring, "rotation": moment},
    }
    parts = {**data, "support": [end for end in data["support"].values() if isinstance(end, dict)]}
    for kind, by_key in factors.items():
        for part in parts[kind]:
            for key in by_key.keys() & part.keys():
                part[key] = _scaled(part[key], by_key[key], length)


def _scaled(value: Any, factor: float, length: float) -> Any:
    if isinstance(value, dict):
        return {"x": [length * x for x in value["x"]], "value": [factor * item for item in value["value"]]}
    return factor * value


def _kept(deck: Deck, problems: list[tuple[str, str]]) -> dict[str, Any]:
    """What comments say in the words of a model file."""
    try:
        return tomllib.loads("\n".join(deck.kept))
    except (ValueError, RecursionError) as error:
        problems.append(("comments that begin with $ beal:", f"are not valid TOML: {error}"))
        return {}


def _merged(kept: dict[str, Any], data: dict[str, Any], source: str) -> dict[str, Any]:
    """The model of the cards, with what the comments add to it; the cards win."""
    for key in ("stage", "joint"):
        extra = kept.pop(key, [{}] * len(data[key]))
        if not isinstance(extra, list) or len(extra) != len(data[key]) or not all(isinstance(x, dict) for x in extra):
            message = f"must be a list of {len(data[key])} tables, one for each {key} of the cards"
            raise ModelError([(f"$ beal: {key}", message)], source)
        data[key] = [{**more, **part} for more, part in zip(extra, data[key], strict=True)]
    return {**kept, **data}
