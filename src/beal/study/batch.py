"""Vehicles that differ in joint springs or tangency only, solved together on tables."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import Formulation
from beal.stability.kernels.rules import DIVERGENCE, FLUTTER, STABLE, UNDECIDED
from beal.stability.limit import default_limit
from beal.stability.scan import Found, scan
from beal.stability.table import TANGENCY, Panel, panel, reference, weights
from beal.stability.threads import one_thread
from beal.study.study import Solve
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

WORTHWHILE = 4  # vehicles from which on a table costs less than solving each by itself
PANELS = 4  # on which the thrusts up to the default limit are tabulated, each when it is needed
SOFT = 0.5  # stiffness, as a share of the stage's, below which a joint needs the first panel graded
GRADED = (1 / 64, 1 / 8)  # shares of the first panel at which it is then divided
FLOOR = 1e-12  # relative rounding of the critical thrust
TABULATED: tuple[Formulation, ...] = ("objective", "converged")


def solve_together(vehicle: Vehicle, paths: tuple[str, ...], values: Array, solve: Solve) -> Found:
    """First instability of each vehicle, where the tables decide it to the tolerance.

    Parameters
    ----------
    vehicle : Vehicle
        All but the parameters.
    paths : tuple of str
        Of the parameters, see `beal.stability.table.tabulated`.
    values : ndarray, shape (vehicles, parameters)
        Springs not negative, possibly infinite; a tangency between 0 and 2.
    solve : Solve

    Returns
    -------
    Found
        Undecided vehicles are to be solved one by one.
    """
    count = len(values)
    kind, mode = np.full(count, UNDECIDED), np.zeros(count, dtype=np.intp)
    thrust, W, error = np.full((3, count), np.nan)
    result = Found(kind, mode, thrust, W, error, np.zeros(count, dtype=bool))
    if solve.formulation not in TABULATED or vehicle.damped:  # the tables are of undamped roots
        return result
    natural = default_limit(vehicle)
    limit = solve.max_thrust or natural
    even = np.arange(math.ceil(PANELS * limit / natural) + 1) * natural / PANELS
    graded = np.concatenate(([0.0], even[1] * np.array(GRADED), even[1:]))
    soft = np.zeros(count, dtype=bool)
    for column, path in enumerate(paths):
        if path != TANGENCY:
            soft |= values[:, column] < SOFT * reference(vehicle, path)
    _search(result, np.flatnonzero(~soft), vehicle, paths, values, solve, limit, even, False)
    left = np.flatnonzero(kind == UNDECIDED)
    if len(left) >= WORTHWHILE:
        result.border[left] = False  # decided anew
        _search(result, left, vehicle, paths, values, solve, limit, graded, True)
    return result


def _search(
    result: Found,
    left: NDArray[np.intp],
    vehicle: Vehicle,
    paths: tuple[str, ...],
    values: Array,
    solve: Solve,
    limit: float,
    edges: Array,
    crowded: bool,
) -> None:
    """Fills in what is found for some vehicles on panel after panel, until none is left that was stable so far."""
    for low, high in zip(edges[:-1], edges[1:], strict=True):
        if not len(left):
            return
        with one_thread():
            tables = _panel(vehicle, paths, solve.formulation, (float(low), float(high)), crowded)
        if tables is None:
            return
        found = scan(tables, weights(vehicle, paths, values[left]))
        _settle(result, left, found, limit, solve.tolerance)
        stable = found.kind == STABLE
        result.border[left] |= found.border
        if high >= limit:
            result.kind[left[stable]] = STABLE
        left = left[stable & (high < limit)]


def _settle(result: Found, left: NDArray[np.intp], found: Found, limit: float, tolerance: float) -> None:
    """Keeps what was found within the limit and the tolerance; what lies beyond the limit is stable."""
    unstable = (found.kind == FLUTTER) | (found.kind == DIVERGENCE)
    with np.errstate(invalid="ignore"):
        beyond = unstable & (found.thrust > limit)
        error = found.error + FLOOR * found.thrust
        good = unstable & ~beyond & (error <= tolerance * found.thrust)
    result.kind[left[beyond]] = STABLE
    for kept, new in (
        (result.kind, found.kind),
        (result.mode, found.mode),
        (result.thrust, found.thrust),
        (result.W, found.W),
        (result.error, error),
    ):
        kept[left[good]] = new[good]


@lru_cache(maxsize=32)
def _panel(
    vehicle: Vehicle, paths: tuple[str, ...], formulation: Formulation, ends: tuple[float, float], soft: bool
) -> Panel | None:
    """Tables of one panel of thrusts; None where they do not apply."""
    return panel(vehicle, paths, formulation, ends, soft)
