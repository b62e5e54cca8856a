"""Gauss points and integrated Legendre polynomials, computed once."""

from functools import cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

gauss = cache(legendre.leggauss)


@cache
def integrals(order: int, times: int) -> Array:
    """Legendre coefficients of P_0..P_order integrated from -1 ``times`` times, shape (order + 3, order + 1)."""
    integrated = legendre.legint(np.eye(order + 1), m=times, lbnd=-1) if times else np.eye(order + 1)
    coefficients = np.zeros((order + 3, order + 1))
    coefficients[: len(integrated)] = integrated
    return coefficients
