"""The quantities of a vehicle as sliders: what each may reasonably be."""

import math
from collections.abc import Iterator
from typing import Any

from beal.vehicle.paths import entries, paths, unit_at, value_at
from beal.vehicle.vehicle import Vehicle

NOMINAL = "thrust.nominal"
ENTRIES = 200  # of tables, beyond which a page is too long to be of use
SPRINGS = {"rotational_stiffness": 1, "shear_stiffness": -1, "translation": -1, "rotation": 1}  # EI/L^2 L^n


def sliders(base: Vehicle, vehicle: Vehicle) -> Iterator[dict[str, Any]]:
    """A slider for each quantity of a vehicle.

    Parameters
    ----------
    base : Vehicle
        Before any slider was moved: the ranges are its.
    vehicle : Vehicle
        As it is now: the values are its.

    Yields
    ------
    dict
        ``path``, ``name``, ``value`` (``"inf"`` where it is infinite), ``unit``, ``from``, ``to``, ``scale``
        (``"log"`` or ``"linear"``) and ``may_be_rigid``.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> {slider["path"]: slider["to"] for slider in sliders(*[tsto(0.6, 10.0, 10.0)] * 2)}["stage.split"]
    0.98
    """
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


def entry_sliders(base: Vehicle, vehicle: Vehicle) -> Iterator[dict[str, Any]]:
    """Sliders for the values in tables, each named by its station, and for damping ratios.

    Parameters
    ----------
    base, vehicle : Vehicle
        As for `sliders`.

    Yields
    ------
    dict
        As `sliders`, and ``entry``; none where there are more than 200.
    """
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
