"""Vehicles that differ in their joints' springs only, solved together on tables of their characteristic function."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import Formulation
from beal.stability.limit import default_limit
from beal.stability.scan import DIVERGENCE, FLUTTER, STABLE, UNDECIDED, scan
from beal.stability.table import Degrees, Spring, Table, tables
from beal.stability.threads import one_thread
from beal.study.study import Solve
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

WORTHWHILE = 12  # vehicles from which on a table costs less than solving each by itself
PANELS = 4  # on which the thrusts up to the default limit are tabulated, each when it is needed
DEGREES = (Degrees(14, 20, 14), Degrees(12, 16, 12))  # the second for the error estimate
FLOOR = 1e-12  # relative rounding of the critical thrust
TABULATED: tuple[Formulation, ...] = ("objective", "converged")


def solve_springs(
    vehicle: Vehicle, springs: tuple[Spring, ...], stiffnesses: Array, solve: Solve
) -> tuple[NDArray[np.intp], Array]:
    """First instability of each vehicle, where the tables decide it to the tolerance.

    Parameters
    ----------
    vehicle : Vehicle
        All but the springs.
    springs : tuple of (joint, name)
    stiffnesses : ndarray, shape (vehicles, springs)
        Not negative, possibly infinite.
    solve : Solve

    Returns
    -------
    kind : ndarray of int, shape (vehicles,)
        As in `beal.stability.scan`; undecided vehicles are to be solved one by one.
    values : ndarray, shape (4, vehicles)
        Critical thrust, lower mode, angular frequency, error estimate.
    """
    kind = np.full(len(stiffnesses), UNDECIDED)
    values = np.full((4, len(stiffnesses)), np.nan)
    if solve.formulation not in TABULATED:
        return kind, values
    natural = default_limit(vehicle)
    limit = solve.max_thrust or natural
    left = np.arange(len(stiffnesses))
    for panel in range(int(np.ceil(PANELS * limit / natural))):
        with one_thread():
            pair = _pair(vehicle, springs, solve.formulation, panel, natural / PANELS)
            if pair is None or not len(left):
                break
            found = scan(*pair, stiffnesses[left])
        error = found.error + FLOOR * found.thrust
        settled = (found.kind == FLUTTER) | (found.kind == DIVERGENCE)
        beyond = settled & (found.thrust > limit)
        good = settled & ~beyond & (error <= solve.tolerance * found.thrust)
        kind[left[good]] = found.kind[good]
        values[:, left[good]] = np.array((found.thrust, found.ridge, np.sqrt(found.W), error))[:, good]
        last = pair[0].high >= limit
        kind[left[beyond | ((found.kind == STABLE) & last)]] = STABLE
        left = left[(found.kind == STABLE) & (not last)]
    return kind, values


@lru_cache(maxsize=32)
def _pair(
    vehicle: Vehicle, springs: tuple[Spring, ...], formulation: Formulation, panel: int, width: float
) -> tuple[Table, Table] | None:
    """Tables of one panel of thrusts in two discretisations; None where they do not apply."""
    edges = panel * width, (panel + 1) * width
    pair = [tables(vehicle, springs, formulation, edges, degrees) for degrees in DEGREES]
    return None if pair[0] is None or pair[1] is None else (pair[0], pair[1])
