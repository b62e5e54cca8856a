"""Quantities of a vehicle by their path in the model file, such as ``joint[0].rotational_stiffness``."""

import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from functools import cache
from numbers import Real
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import ValidationError

from beal.errors import ModelError
from beal.vehicle.base import Part, problems, unit_of
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle, metres

SPLIT = "stage.split"
_STEP = re.compile(r"(\w+)(?:\[([0-9]{1,9})\])?")


def paths(vehicle: Vehicle) -> list[str]:
    """Paths of all quantities of a vehicle that have a value and can be replaced.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    list of str
        In the order of the model file, then ``stage.split`` where there are two stages or more. Not those of `entries`.

    Examples
    --------
    >>> from beal.vehicle.catalog import beck
    >>> paths(beck())[:3]
    ['stage[0].length', 'stage[0].mass_per_length', 'stage[0].bending_stiffness']
    """
    return [*_paths(vehicle, ""), *([SPLIT] if len(vehicle.stages) > 1 else [])]


def entries(vehicle: Vehicle) -> list[str]:
    """Paths of the values in the tables of the stages, and of the damping ratios.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    list of str

    Examples
    --------
    >>> from beal.vehicle import Stage
    >>> taper = {"x": [0.0, 1.0], "value": [2.0, 1.0]}
    >>> entries(Vehicle(stages=[Stage(length=1.0, mass_per_length=1.0, bending_stiffness=taper)]))
    ['stage[0].bending_stiffness.value[0]', 'stage[0].bending_stiffness.value[1]']
    """
    found = [
        f"stage[{stage}].{name}.value[{n}]"
        for stage, part in enumerate(vehicle.stages)
        for name, table in part.tables.items()
        for n in range(len(table.value))
    ]
    return [*found, *(f"damping.ratios[{n}]" for n in range(len(vehicle.damping.ratios)))]


def value_at(vehicle: Vehicle, path: str) -> float:
    """Value of the quantity at a path.

    Parameters
    ----------
    vehicle : Vehicle
    path : str
        As in the model file, or ``stage.split``: the first stage's share of the whole length.

    Returns
    -------
    float
        In SI units, or non-dimensional where the vehicle is.

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or it is not given.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> value_at(tsto(0.6, 10.0, 20.0), "joint[0].shear_stiffness")
    20.0
    """
    if path == SPLIT:
        _check_split(vehicle)
        return vehicle.stages[0].length / vehicle.length
    value: Any = vehicle
    for step in _resolved(vehicle, path):
        value = value[step] if isinstance(step, int) else getattr(value, step)
    if value is None:
        raise ModelError([(path, "is not given and has no default")])
    return float(value)


def unit_at(vehicle: Vehicle, path: str) -> str:
    """Unit of the quantity at a path; empty where it is a pure number or the vehicle is nondimensional.

    Examples
    --------
    >>> from beal.vehicle import Stage
    >>> unit_at(Vehicle(stages=[Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)]), "stage[0].length")
    'm'
    """
    if path == SPLIT or vehicle.units != "SI":
        return ""
    part: Any = vehicle
    for step in _resolved(vehicle, path):
        if isinstance(step, int):
            part = part[step]
        else:
            field = type(part).model_fields[step]
            part = getattr(part, step)
    return unit_of(field.annotation, field.metadata)


def with_values(vehicle: Vehicle, values: Mapping[str, float | str]) -> Vehicle:
    """Vehicle with some quantities replaced; only the parts that change are checked again.

    Parameters
    ----------
    vehicle : Vehicle
    values : mapping of path to number
        ``stage.split`` moves the first joint and keeps the total length of the first two stages; the stations of
        masses, tanks, sensors and forces stay; lengths given beside it are set first. Tables are stretched with the
        lengths that they describe; of their `entries` each may be replaced. In SI, text with a unit is accepted as in
        the model file.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If a path is not one of the vehicle's, or a value is not allowed there.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> with_values(tsto(0.6, 10.0, 20.0), {"stage.split": 0.2}).boundaries
    (0.0, 0.2, 1.0)
    """
    others = {path: value for path, value in values.items() if path != SPLIT}
    if SPLIT in values and any(path.endswith("].length") for path in others):
        return with_values(with_values(vehicle, others), {SPLIT: values[SPLIT]})
    single = {path: value for path, value in values.items() if path.endswith("]")}
    if single and len(single) < len(values):  # before the tables are stretched
        rest = {path: value for path, value in values.items() if path not in single}
        return with_values(with_values(vehicle, single), rest)
    tree: dict[str | int, Any] = {}
    for path, value in others.items():
        *parents, name = _resolved(vehicle, path)
        branch = tree
        for step in parents:
            branch = branch.setdefault(step, {})
        branch[name] = value
    if SPLIT in values:
        first, second = _split(vehicle, values[SPLIT])
        stages = tree.setdefault("stages", {})
        stages.setdefault(0, {})["length"] = first
        stages.setdefault(1, {})["length"] = second
    _stretch(vehicle, tree)
    try:
        return Vehicle.model_validate(_merged(vehicle, tree), context={"units": vehicle.units})
    except ValidationError as error:
        raise ModelError(problems(error, Vehicle)) from None


def _stretch(vehicle: Vehicle, tree: dict[str | int, Any]) -> None:
    """Tables follow the lengths of what they describe."""
    total = 0.0
    for index, stage in enumerate(vehicle.stages):
        branch = tree.get("stages", {}).get(index, {})
        length = metres(branch, "length") if "length" in branch else stage.length
        total += length
        if length > 0 and length != stage.length:
            branch |= {name: table.stretched(length) for name, table in stage.tables.items()}
    for index, tank in enumerate(vehicle.tanks):
        branch = tree.get("tanks", {}).get(index, {})
        forward, aft = (metres(branch if end in branch else tank, end) for end in ("forward_end", "aft_end"))
        if isinstance(tank.mass_per_length, StationTable) and aft - forward > 0 and aft - forward != tank.length:
            branch["mass_per_length"] = tank.mass_per_length.stretched(aft - forward)
    for index, load in enumerate(vehicle.distributed_thrusts):
        if isinstance(load.value, StationTable) and load.value.misfit(total) and total > 0:
            loads = tree.setdefault("distributed_thrusts", {})
            loads.setdefault(index, {})["value"] = load.value.stretched(total)


def _split(vehicle: Vehicle, share: float | str) -> tuple[float, float]:
    """Lengths of the first two stages."""
    _check_split(vehicle)
    both = vehicle.boundaries[2]
    first = share * vehicle.length if isinstance(share, Real) else 0.0
    if not 0 < first < both:
        limit = both / vehicle.length
        raise ModelError([(SPLIT, f"must be a number between 0 and {limit:.6g}, found {share!r}")])
    return first, both - first


def _check_split(vehicle: Vehicle) -> None:
    if len(vehicle.stages) < 2:
        raise ModelError([(SPLIT, "needs a vehicle of two stages or more, found one stage")])


def _merged(value: Any, tree: dict[str | int, Any]) -> Any:
    """Raw input for the validator: what changes as dictionaries, the rest as the parts that exist already."""
    if isinstance(value, tuple):
        changed = ((item, tree.get(n, {})) for n, item in enumerate(value))
        return tuple((_merged(item, to) if to else item) if isinstance(to, dict) else to for item, to in changed)
    fields = {}
    kind: type[Part] = type(value)
    for name, key in _keys(kind).items():
        item = getattr(value, name)
        branch = tree.get(name)
        if name in tree:
            item = _merged(item, branch) if isinstance(branch, dict) else branch
        fields[key] = item
    return fields


def _resolved(vehicle: Vehicle, path: str) -> tuple[str | int, ...]:
    """Steps by attribute name and index from the vehicle to a quantity."""
    steps: list[str | int] = []
    value: Any = vehicle
    for key, index in _steps(path):
        owner, name = value, _names(type(value)).get(key) if isinstance(value, Part) else None
        if name is None:
            raise _unknown(vehicle, path)
        steps.append(name)
        value = getattr(owner, name)
        if isinstance(value, tuple):
            if index is None:
                raise _unknown(vehicle, path)
            if index >= len(value):
                raise ModelError([(path, f"index out of range: this vehicle has {_count(len(value), key)}")])
            steps.append(index)
            value = value[index]
        elif index is not None:
            raise _unknown(vehicle, path)
    if not (steps and _is_quantity(type(owner), key, value)):
        raise _unknown(vehicle, path)
    return tuple(steps)


def _unknown(vehicle: Vehicle, path: str) -> ModelError:
    there = paths(vehicle)
    near = get_close_matches(path, there, n=3) or there[:3]
    return ModelError([(path or "''", f"is not a quantity of this vehicle; the nearest are {', '.join(near)}")])


def _count(number: int, key: str) -> str:
    plural = "" if number == 1 else "es" if key.endswith("s") else "s"
    return f"{number or 'no'} {key.replace('_', ' ')}{plural}"


@cache
def _steps(path: str) -> tuple[tuple[str, int | None], ...]:
    """``stage[1].length`` as (("stage", 1), ("length", None)); empty where the path has another form."""
    found = [_STEP.fullmatch(step) for step in path.split(".")]
    if not all(found):
        return ()
    return tuple((match[1], int(match[2]) if match[2] else None) for match in found if match)


def _paths(part: Part, prefix: str) -> Iterator[str]:
    for name, key in _keys(type(part)).items():
        value = getattr(part, name)
        if isinstance(value, Part):
            yield from _paths(value, f"{prefix}{key}.")
        elif isinstance(value, tuple):
            for index, item in enumerate(value):
                if isinstance(item, Part):
                    yield from _paths(item, f"{prefix}{key}[{index}].")
        elif isinstance(value, float):
            yield prefix + key


@cache
def _keys(part: type[Part]) -> dict[str, str]:
    """Key in the model file of each field."""
    return {name: field.alias or name for name, field in part.model_fields.items()}


@cache
def _names(part: type[Part]) -> dict[str, str]:
    return {key: name for name, key in _keys(part).items()}


def _is_quantity(part: type[Part], key: str, value: Any) -> bool:
    return isinstance(value, float) or (value is None and key in _optional_numbers(part))


@cache
def _optional_numbers(part: type[Part]) -> set[str]:
    """Keys of the numbers that may be left out."""
    return {key for name, key in _keys(part).items() if _takes_number(part.model_fields[name].annotation)}


def _takes_number(annotation: Any) -> bool:
    if get_origin(annotation) in (Annotated, Union, UnionType):
        return any(map(_takes_number, get_args(annotation)))
    return annotation is float
