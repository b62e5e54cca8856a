"""Properties along a stage as rows of stations, and back."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from beal.vehicle.stations import Property, StationTable

STRAIGHT = 1e-12  # of the largest value: a station that is off the line between others by no more is left out
Point = tuple[float, float]


def along(stations: Sequence[float], values: Sequence[float]) -> float | dict[str, Any]:
    """A property over stations, as a model file has it.

    Parameters
    ----------
    stations : sequence of float
        From any origin, never falling; a station given twice is a step.
    values : sequence of float
        One for each station.

    Returns
    -------
    float or dict

    Examples
    --------
    >>> along([3.0, 4.0, 5.0], [7.0, 7.0, 7.0])
    7.0
    >>> along([3.0, 4.0, 5.0, 5.0, 6.0], [1.0, 2.0, 3.0, 5.0, 5.0])
    {'x': [0.0, 2.0, 2.0, 3.0], 'value': [1.0, 3.0, 5.0, 5.0]}
    """
    if len(set(values)) == 1:
        return values[0]
    near = STRAIGHT * max(map(abs, values))
    points = [(x - stations[0], value) for x, value in zip(stations, values, strict=True)]
    kept = [point for part in _smooth(points, near) for point in _bends(part, near)]
    x, value = zip(*kept, strict=True)
    return {"x": list(x), "value": list(value)}


def _smooth(points: list[Point], near: float) -> Iterator[list[Point]]:
    """Parts between steps; a station that is given twice without one is given once."""
    part = [points[0]]
    for x, value in points[1:]:
        if x > part[-1][0]:
            part.append((x, value))
        elif abs(value - part[-1][1]) > near:
            yield part
            part = [(x, value)]
    yield part


def _bends(points: list[Point], near: float) -> Iterator[Point]:
    """Ends and bends of a line: between those that are kept, all others are as near to it as said."""
    (x, value), low, high = points[0], float("-inf"), float("inf")  # of the slopes that pass near all others
    yield points[0]
    for before, point in zip(points, points[1:], strict=False):
        run = point[0] - x
        if not low <= (point[1] - value) / run <= high:
            yield before
            (x, value), low, high = before, float("-inf"), float("inf")
            run = point[0] - x
        low, high = max(low, (point[1] - near - value) / run), min(high, (point[1] + near - value) / run)
    if len(points) > 1:
        yield points[-1]


def between(given: Property, front: float, back: float) -> tuple[float, float]:
    """A property just behind one station and just before the next, between which it is linear.

    Parameters
    ----------
    given : float or StationTable
    front, back : float
        From the front of the stage.

    Returns
    -------
    tuple of float

    Examples
    --------
    >>> between(StationTable(x=[0.0, 1.0, 1.0, 3.0], value=[1.0, 2.0, 5.0, 7.0]), 1.0, 2.0)
    (5.0, 6.0)
    """
    if not isinstance(given, StationTable):
        return given, given
    x, value = given.arrays.x, given.arrays.value
    after = int(np.searchsorted(x, (front + back) / 2))
    there = np.interp((front, back), x[after - 1 : after + 1], value[after - 1 : after + 1])
    return float(there[0]), float(there[1])
