"""Gauss points and integrated Legendre polynomials, computed once."""

from functools import cache, lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEW_POINTS = 48  # come again for every segment, as Gauss points and ends do

gauss = cache(legendre.leggauss)


@cache
def integrals(order: int, times: int) -> Array:
    """Legendre coefficients of P_0..P_order integrated from -1 ``times`` times, shape (order + 3, order + 1)."""
    series = legendre.legint(np.eye(order + 1), m=times, lbnd=-1) if times else np.eye(order + 1)
    coefficients = np.zeros((order + 3, order + 1))
    coefficients[: len(series)] = series
    return coefficients


def integrated(order: int, times: int, t: Array) -> Array:
    """P_0..P_order integrated from -1 ``times`` times, at t in [-1, 1], shape (len(t), order + 1)."""
    return _few_integrated(order, times, tuple(t)) if len(t) <= FEW_POINTS else _integrated(order, times, t)


@lru_cache(maxsize=256)
def _few_integrated(order: int, times: int, t: tuple[float, ...]) -> Array:
    return _integrated(order, times, np.array(t))


def _integrated(order: int, times: int, t: Array) -> Array:
    return legendre.legvander(t, order + 2) @ integrals(order, times)
