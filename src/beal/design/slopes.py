"""How the thrusts of instability move with the quantities of a design."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.build import Formulation, discretise
from beal.stability.complete import Event
from beal.stability.pencil import Pencil, pencil
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

STEP = 1e-6  # of the unit cube: matrices are smooth, so that only rounding counts


def slopes(
    events: Sequence[Event],
    vehicle: Callable[[Array], Vehicle],
    place: Array,
    order: int,
    formulation: Formulation = "objective",
) -> Array:
    """Derivatives of the thrusts of events with respect to the coordinates of a design.

    At a double root of K(P) x = W M x, or a zero one, with the left and right vectors u and x,

        dP = - u^T (dK - W dM) x / u^T K1 x

    since u^T M x vanishes at a double root and dW at a zero one. dK and dM are central differences of the matrices.

    Parameters
    ----------
    events : sequence of Event
        Of the vehicle at ``place``.
    vehicle : callable
        From coordinates to a vehicle.
    place : ndarray, shape (n,)
        In the unit cube, left by half a step to either side at its faces.
    order : int
        Of the discretisation.
    formulation : str

    Returns
    -------
    ndarray, shape (events, n)
        In N per unit.
    """

    def matrices(where: Array) -> Pencil:
        return pencil(discretise(vehicle(where), formulation, order=order))

    here = matrices(place)
    vectors = []
    for event in events:
        U, _, X = np.linalg.svd(here.stiffness(event.thrust) - event.W * here.M)
        vectors.append((U[:, -1], X[-1]))
    found = np.empty((len(events), len(place)))
    for axis, side in enumerate(np.eye(len(place)) * STEP):
        ends = [np.clip(place + sign * side, 0.0, 1.0) for sign in (-1.0, 1.0)]
        low, high = map(matrices, ends)
        for row, (event, (u, x)) in enumerate(zip(events, vectors, strict=True)):
            dK = high.stiffness(event.thrust) - low.stiffness(event.thrust)
            change = u @ (dK - event.W * (high.M - low.M)) @ x
            found[row, axis] = -change / (u @ here.K1 @ x) / (ends[1] - ends[0])[axis]
    return found
