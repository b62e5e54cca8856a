"""From a question to its vehicle, and from a vehicle to what the page shows of it."""

import base64
import binascii
import json
import math
import re
import tomllib
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
from beal.vehicle.paths import with_values
from beal.vehicle.sliders import entry_sliders, sliders
from beal.vehicle.summary import summary
from beal.vehicle.vehicle import Vehicle
from beal.web.questions import Dropped, Question

STAGES = 60  # beyond this an answer takes seconds
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
    quantities = [*sliders(base, vehicle), *entry_sliders(base, vehicle)]
    return {"quantities": quantities, "choices": _choices(vehicle)}


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
