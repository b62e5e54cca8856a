"""From a question to its vehicle, and from a vehicle to what the page shows of it."""

import base64
import binascii
import json
import math
import re
import tomllib
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, get_args

from beal.errors import ModelError
from beal.interop.files import DECKS, TABLES, imported
from beal.interop.nastran import Imported
from beal.vehicle.base import Part
from beal.vehicle.file import dumps, loads, reading_only, vehicle_from
from beal.vehicle.parts import HeldEnd, ShearAxis, Thrust
from beal.vehicle.paths import entries, paths, unit_at, value_at, with_values
from beal.vehicle.summary import summary
from beal.vehicle.vehicle import Vehicle
from beal.web.questions import Dropped, Question

NOMINAL = "thrust.nominal"
ENTRIES = 200  # of tables, beyond which a page is too long to be of use
STAGES = 60  # beyond this an answer takes seconds
SPRINGS = {"rotational_stiffness": 1, "shear_stiffness": -1, "translation": -1, "rotation": 1}  # EI/L^2 L^n
CHOICES: dict[str, tuple[str, ...]] = {
    "nose": get_args(HeldEnd),
    "tail": get_args(HeldEnd),
    "shear_axis": get_args(ShearAxis),
    "line": ("moving", "fixed"),
    "along": ("slope", "section"),
    "axial_term": ("engesser", "haringx"),
    "axial_force": ("inertia", "constant"),
}


def vehicle_of(question: Question) -> Vehicle:
    """The vehicle that a question is about.

    Raises
    ------
    ModelError
        With every problem and its path.

    Examples
    --------
    >>> stage = {"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": 1.0}
    >>> vehicle_of(Question(model={"stage": [stage]}, values={"stage[0].length": 2.0})).length
    2.0
    """
    vehicle = base_of(question)
    if not question.values:
        return vehicle
    rigid = {path: math.inf if value == "inf" else value for path, value in question.values.items()}
    return with_values(vehicle, rigid)


def base_of(question: Question) -> Vehicle:
    """The vehicle before any slider was moved."""
    text = question.model if isinstance(question.model, str) else json.dumps(question.model)
    return _base(text, isinstance(question.model, str), tuple(question.choices.items()))


@lru_cache(maxsize=64)
def _base(text: str, toml: bool, choices: tuple[tuple[str, str], ...]) -> Vehicle:
    with reading_only():
        vehicle = loads(text) if toml else vehicle_from(json.loads(text), "model")
    if len(vehicle.stages) > STAGES:
        raise ModelError([("stage", f"at most {STAGES} are explored at once, found {len(vehicle.stages)}")])
    return _chosen(vehicle, choices) if choices else vehicle


def _chosen(vehicle: Vehicle, choices: tuple[tuple[str, str], ...]) -> Vehicle:
    """The vehicle with some words replaced."""
    known = {choice["path"]: choice["options"] for choice in _choices(vehicle)}
    tree = tomllib.loads(dumps(vehicle))
    for path, word in choices:
        if path not in known:
            raise ModelError([(path, f"is not a choice of this vehicle; known: {', '.join(known)}"[:300])])
        part, name = path.rsplit(".", 1)
        match = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", part)
        branch = tree.setdefault(match[1], {}) if match else {}
        (branch[int(match[2])] if match and match[2] else branch)[name] = word
    return vehicle_from(tree, "model")


def opened(dropped: Dropped) -> Imported:
    """The vehicle in a file that was dropped on the page.

    Raises
    ------
    ModelError
        With every problem in it.
    """
    ending = Path(dropped.name).suffix.lower()
    if ending not in (known := (".toml", *DECKS, *TABLES)):
        raise ModelError([("name", f"must end with {', '.join(known)}, found {dropped.name!r}")])
    try:
        content = base64.b64decode(dropped.content, validate=True)
    except (binascii.Error, ValueError):
        raise ModelError([("content", "must be in base64")]) from None
    with TemporaryDirectory() as folder, reading_only(Path(folder)):
        file = Path(folder) / f"vehicle{ending}"  # the readers take files
        file.write_bytes(content)
        return imported(file)


def described(vehicle: Vehicle) -> dict[str, Any]:
    """What is drawn of a vehicle: what ``beal check --json`` says, and its forces."""
    forces = [{"name": force.name, "station": force.station, "kind": force.signal.kind} for force in vehicle.forces]
    return {**summary(vehicle), "forces": forces}


def controls(base: Vehicle, vehicle: Vehicle) -> dict[str, Any]:
    """The sliders and choices of a vehicle; their ranges are those of the vehicle before any was moved."""
    quantities = [*_quantities(base, vehicle), *_entries(base, vehicle)]
    return {"quantities": quantities, "choices": _choices(vehicle)}


def _quantities(base: Vehicle, vehicle: Vehicle) -> Iterator[dict[str, Any]]:
    there = paths(base)
    for path in [*there, *([] if NOMINAL in there else [NOMINAL])]:
        name = path.rpartition(".")[2]
        optional = path == NOMINAL and vehicle.thrust.nominal is None
        value = None if optional else value_at(vehicle, path)
        given = None if path not in there else value_at(base, path)
        low, high, scale = _range(base, path, name, given)
        if given is not None and math.isfinite(given):
            low = min(low, given) if given > 0 or scale == "linear" else low
            high = max(high, given)
        yield {
            "path": path,
            "name": name,
            "value": "inf" if value == math.inf else value,
            "unit": unit_at(base, path),
            "from": low,
            "to": high,
            "scale": scale,
            "may_be_rigid": name in SPRINGS or name in ("bending_stiffness", "shear_stiffness"),
        }


def _entries(base: Vehicle, vehicle: Vehicle) -> Iterator[dict[str, Any]]:
    """The values in tables, each named by its station, and damping ratios."""
    there = entries(base)
    for path in there if len(there) <= ENTRIES else ():
        place, index = path.rsplit("[", 1)[0], int(path[:-1].rsplit("[", 1)[1])
        if place == "damping.ratios":
            name, low, high, scale = f"mode {index + 1}", 0.0, max(0.1, 4 * value_at(base, path)), "linear"
        else:
            x = value_at(vehicle, f"{place.removesuffix('value')}x[{index}]")
            name = f"at {x:.6g}{' m' if vehicle.units == 'SI' else ''}"
            given = value_at(base, path)
            low, high, scale = (given / 10, 10 * given, "log") if given > 0 else (0.0, 1.0, "linear")
        yield {
            "path": path,
            "name": name,
            "value": value_at(vehicle, path),
            "unit": unit_at(base, path),
            "from": low,
            "to": high,
            "scale": scale,
            "may_be_rigid": False,
            "entry": True,
        }


def _range(base: Vehicle, path: str, name: str, value: float | None) -> tuple[float, float, str]:
    """Ends of a slider, and whether it is logarithmic."""
    scales, length = base.scales, base.length
    if path == "stage.split":
        return 0.02, 0.98 * base.boundaries[2] / length, "linear"
    if path.startswith(("joint", "support")) and name in SPRINGS:
        unit = scales.thrust * length ** SPRINGS[name]
        return unit, 1e5 * unit, "log"
    if name in ("station", "forward_end", "aft_end"):
        return 0.0, length, "linear"
    if name in ("tangency", "scale"):
        return 0.0, 2.0, "linear"
    if name == "nominal":
        return 0.0, 2.0 * (value or 50.0 * scales.thrust), "linear"
    if name == "fill":
        return 0.0, 1.0, "linear"
    if value and math.isfinite(value):
        if name.endswith("stiffness"):
            return value / 100, 100 * value, "log"
        return (value / 4, 4 * value, "log") if value > 0 else (4 * value, -4 * value, "linear")
    wide = {
        "shear_stiffness": 1e4 * scales.thrust,
        "bending_stiffness": 100 * scales.bending_stiffness,
        "internal_damping": 0.1 * scales.time,
        "external_damping": 10 * scales.mass_per_length / scales.time,
        "foundation_stiffness": 1e4 * scales.thrust / length**2,
        "rotary_inertia_per_length": 0.01 * scales.mass_per_length * length**2,
        "rotary_inertia": 0.1 * base.mass * length**2,
        "rotational_damping": 0.1 * scales.thrust * length * scales.time,
        "shear_damping": 10 * scales.thrust / length * scales.time,
        "mass": base.mass,
        "lag": 0.5 * scales.time,
        "delay": 0.5 * scales.time,
    }.get(name, 1.0)
    return (1e-4 * wide, wide, "log") if value == math.inf else (0.0, wide, "linear")


def _choices(vehicle: Vehicle) -> list[dict[str, Any]]:
    """Words that the page offers to replace, each with its options."""
    parts: list[tuple[str, Part, tuple[str, ...]]] = [("support", vehicle.support, ("nose", "tail"))]
    parts += [(f"joint[{n}]", joint, ("shear_axis",)) for n, joint in enumerate(vehicle.joints)]
    of_thrust = ("line", "axial_force", *(("along", "axial_term") if vehicle.shears else ()))
    parts.append(("thrust", vehicle.thrust, of_thrust))
    return [
        {"path": f"{prefix}.{name}", "name": name, "value": _word(vehicle, part, name), "options": list(CHOICES[name])}
        for prefix, part, names in parts
        for name in names
    ]


def _word(vehicle: Vehicle, part: Part, name: str) -> str:
    value = getattr(part, name)
    if isinstance(part, Thrust) and name == "axial_force":
        return str(vehicle.axial_force)
    return value if isinstance(value, str) else "springs"
