"""A vehicle as the rows of a station table, which reads back to the same vehicle."""

import math
from collections.abc import Iterator

from beal.interop.cells import KEPT, Cell
from beal.interop.stations import LABEL, OPTIONAL, PROPERTIES, REQUIRED
from beal.interop.tables import between
from beal.vehicle.file import dumps_rest
from beal.vehicle.parts import Stage
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


def station_rows(vehicle: Vehicle) -> list[list[Cell]]:
    """Rows of a station table that reads back to the vehicle.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    list of list

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> for row in station_rows(catalog.beck())[-3:]:
    ...     print(row)
    ['x', 'mass_per_length', 'bending_stiffness']
    [0.0, 1.0, 1.0]
    [1.0, 1.0, 1.0]
    """
    vehicle = vehicle.without_tanks
    names = [name for name in PROPERTIES if name in REQUIRED or _is_given(vehicle, name)]
    units = {"x": "m", **{name: PROPERTIES[name] for name in names}}
    head = [f"{name} [{unit}]" if vehicle.units == "SI" else name for name, unit in units.items()]
    rest = ([] if vehicle.title else ['title = ""']) + dumps_rest(vehicle, {"stage": ["length", *names]}).splitlines()
    bodies = [
        list(_body(stage, names, start, end))
        for stage, start, end in zip(vehicle.stages, vehicle.boundaries, vehicle.boundaries[1:], strict=False)
    ]
    stepped = any(a[0] == b[0] for body in bodies for a, b in zip(body, body[1:], strict=False))
    rows: list[list[Cell]] = [[f"{KEPT} {line}"] for line in rest]
    rows.append([*head, *([LABEL] if stepped else [])])
    return rows + [[*row, *([number] if stepped else [])] for number, body in enumerate(bodies, 1) for row in body]


def _is_given(vehicle: Vehicle, name: str) -> bool:
    return any(mean(getattr(stage, name)) != OPTIONAL[name] for stage in vehicle.stages)


def _body(stage: Stage, names: list[str], start: float, end: float) -> Iterator[list[Cell]]:
    """Stations of a stage and its properties there; two rows where one of them steps."""
    stations = sorted({0.0, *(x for name in names if name in stage.tables for x in stage.tables[name].x[:-1])})
    before: list[Cell] = []
    for front, back in zip(stations, [*stations[1:], stage.length], strict=True):
        ends = [between(getattr(stage, name), front, back) for name in names]
        ahead: list[Cell] = [start + front, *(_cell(values[0]) for values in ends)]
        if ahead != before:
            yield ahead
        before = [end if back == stage.length else start + back, *(_cell(values[1]) for values in ends)]
        yield before


def _cell(value: float) -> Cell:
    """Spreadsheets have no infinite numbers."""
    return value if value < math.inf else "inf"
