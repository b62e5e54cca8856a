"""Flutter that the search of a reduced problem cannot see, where modes only just meet: what an optimum drives to."""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from beal.discretisation.build import Formulation, discretise
from beal.stability.complete import Event
from beal.stability.pencil import pencil
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

STEPS = 160  # of thrust
LOWEST = 11  # roots watched
CLOSE = 0.03  # relative difference of two roots, squared, from which they are followed to where they are closest
COMPLEX = -1e-9  # the same of two roots that have met: growth of some 1e-5 of the frequency
SHORT = 1e-3  # share of the thrust before the critical one at which the sweep stops


def overlooked(vehicle: Vehicle, to: float, order: int, formulation: Formulation = "objective") -> Event | None:
    """Flutter below a thrust, from all coordinates of a discretisation.

    Of neighbouring roots of K(P) x = W M x the squared difference is smooth in P, through the thrust at which they meet
    and on, where it is negative. Its least values are followed to the bottom, so a flutter narrower than a step is seen
    unless the roots part within a step from where they are far from each other.

    Parameters
    ----------
    vehicle : Vehicle
    to : float
        In N, thrust up to which another search found nothing.
    order : int
        Of the discretisation.
    formulation : str

    Returns
    -------
    Event or None
        Where the first such pair is deepest in flutter.
    """
    full = pencil(discretise(vehicle, formulation, order=order))

    def difference(thrust: float) -> Array:
        found = full.lowest(thrust, LOWEST)
        return np.asarray((np.diff(found) ** 2).real / np.abs(found[1:]) ** 2)

    thrusts = np.linspace(0.0, to * (1 - SHORT), STEPS + 1)[1:]
    table = np.array([difference(float(thrust)) for thrust in thrusts])
    for n, pair in np.argwhere(table < CLOSE):
        around = table[max(n - 1, 0) : n + 2, pair]
        if table[n, pair] > around.min():
            continue
        ends = (float(thrusts[max(n - 1, 0)]), float(thrusts[min(n + 1, STEPS - 1)]))
        of_pair = partial(_of_pair, difference, int(pair))
        least = minimize_scalar(of_pair, bounds=ends, method="bounded", options={"xatol": 1e-9 * to})
        if least.fun < COMPLEX:
            place = float(least.x)
            modes = int(pair) + 1, int(pair) + 2
            return Event(place, float(full.lowest(place, LOWEST)[pair].real), "flutter", modes, 2, 0)
    return None


def _of_pair(difference: Callable[[float], Array], pair: int, thrust: float) -> float:
    return float(difference(thrust)[pair])
