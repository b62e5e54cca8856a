"""Where the segments of a stage with tables end: at the kinks and steps that polynomials would notice."""

import heapq
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.parts import Stage
from beal.vehicle.stations import StationTable, mean

Array = NDArray[np.float64]

FEW = 11  # segments of a stage in dense matrices, at most
ALL = 1_000_000
# A step of relative height s inside a segment of length h leaves an error of some s^2 (h/L)^4 n^-5 in the critical
# thrust, a kink by the relative slope k one of (k h)^2 (h/L)^4 n^-7; n = 8 at the least.
LEAST = 1e-3  # share of a table's largest value that others are measured by at least
STRAIGHT = 1e-9  # relative change that is rounding
STEP_TO_KINK = 30.0
NOTICED = 1e-6  # (h/L)^4 (kinks + STEP_TO_KINK steps), which is some 1e-12 of the thrust
# The follower thrust of a stage that shears acts on the shear strain at a point. No square then: the root of the above
# times EI/(kGA L^2) n^-2.5, which this leaves at some 1e-10.
NOTICED_IN_SHEAR = 1e-15


@lru_cache(maxsize=256)
def cuts(stage: Stage, length: float, few: int) -> tuple[float, ...]:
    """Stations, from the front of the stage, that cut it into segments, at most ``few``.

    Parameters
    ----------
    stage : Stage
    length : float
        Of the vehicle, which the shapes' waves are measured by, in m.
    few : int

    Returns
    -------
    tuple of float
        In order.
    """
    stations, kinks, steps = _bends(stage)
    noticed = _noticed(stage, length)
    ends = {0.0, stage.length}
    open_segments = [_worst(0.0, stage.length, stations, kinks, steps, length)]
    while len(ends) <= few:
        severity, station, front, back = heapq.heappop(open_segments)
        if -severity <= noticed:
            break
        ends.add(station)
        for a, b in ((front, station), (station, back)):
            heapq.heappush(open_segments, _worst(a, b, stations, kinks, steps, length))
    return tuple(sorted(ends))[1:-1]


def _noticed(stage: Stage, length: float) -> float:
    """What may stay inside a segment."""
    shear = mean(stage.bending_stiffness) / (mean(stage.shear_stiffness) * length**2)
    return min(NOTICED, NOTICED_IN_SHEAR / shear**2) if 0 < shear < np.inf else NOTICED


def _worst(
    front: float, back: float, stations: Array, kinks: Array, steps: Array, length: float
) -> tuple[float, float, float, float]:
    """What polynomials notice of what is inside a segment, with a minus sign, and the station that contributes most."""
    inside = slice(np.searchsorted(stations, front, side="right"), np.searchsorted(stations, back))
    x = stations[inside]
    if not len(x):
        return 0.0, front, front, back
    size = (back - front) ** 2 * kinks[inside] ** 2 + STEP_TO_KINK * steps[inside] ** 2
    central = np.minimum(x - front, back - x)  # of equal ones the middle one
    return -float(size.sum() * ((back - front) / length) ** 4), float(x[np.argmax(size * central)]), front, back


def _bends(stage: Stage) -> tuple[Array, Array, Array]:
    """Stations inside the stage with what bends there, of all its tables."""
    each = [bends(table) for table in stage.tables.values()]
    stations, kinks, steps = (np.concatenate(parts) for parts in zip(*each, strict=True))
    order = np.argsort(stations)
    return stations[order], kinks[order], steps[order]


def bends(table: StationTable) -> tuple[Array, Array, Array]:
    """Stations inside a table where it bends, the relative changes of slope there [1/m], and relative steps."""
    x, value = table.arrays.x, table.arrays.value
    first = np.flatnonzero(np.append(True, np.diff(x) > 0))  # of a station given twice
    last = np.append(first[1:], len(x)) - 1
    slope = (value[first[1:]] - value[last[:-1]]) / np.diff(x[first])
    size = np.maximum(np.abs(value[first]), np.abs(value[last]))[1:-1]
    size = np.maximum(size, LEAST * np.abs(value).max())
    kinks = np.abs(np.diff(slope)) / size
    steps = np.abs(value[last] - value[first])[1:-1] / size
    found = (kinks * x[-1] > STRAIGHT) | (steps > STRAIGHT)
    return x[first][1:-1][found], kinks[found], steps[found]
