"""The discretised vehicle: matrices that are affine in the thrust, and the shapes behind the coordinates."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beal.discretisation.basis import Basis
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Operators:
    """Matrices of M q'' + C q' + (K0 + P K1) q = sum of F(t) phi(x_F).

    Parameters
    ----------
    vehicle : Vehicle
        What was discretised.
    M, K0, K1 : ndarray, shape (n, n)
        Mass, stiffness of the structure, and stiffness per thrust (not symmetric for a follower force).
    rigid : int
        Number of leading coordinates that are rigid-body motions: they strain nothing and are M-orthogonal to the rest.
    basis : Basis
        The shapes of the coordinates.
    C : ndarray, shape (n, n), or None
        Damping, symmetric; None where there is none.
    dead : ndarray, shape (n, n), optional
        Stiffness of the loads that do not grow with the thrust.
    """

    vehicle: Vehicle
    M: Array
    K0: Array
    K1: Array
    rigid: int
    basis: Basis
    C: Array | None = None
    dead: Array | None = None

    def stiffness(self, thrust: float) -> Array:
        """K(P) = K0 + P K1, and that of dead loads, shape (n, n)."""
        stiffness = self.K0 + thrust * self.K1
        return stiffness if self.dead is None else stiffness + self.dead

    def shape(self, stations: ArrayLike, derivative: int = 0, side: Literal["aft", "forward"] = "aft") -> Array:
        """Rows that read the motion at stations: the deflection (or its derivative) there is ``shape(x) @ q``.

        Parameters
        ----------
        stations : array_like, shape (k,)
            In m, from the nose.
        derivative : int
            0 deflection, 1 slope, 2 curvature (of a stage that shears, how fast its sections' rotation changes).
        side : {"aft", "forward"}
            Which face is read where a station is that of a joint.

        Returns
        -------
        ndarray, shape (k, n)
        """
        return self.basis.at(np.atleast_1d(np.asarray(stations, dtype=float)), derivative, side)
