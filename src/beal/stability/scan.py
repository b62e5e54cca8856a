"""The ridge scan for many vehicles at once, on tables of their characteristic function.

The search of `beal.stability.ridge`, with arrays over vehicles instead of one pencil. It answers only where every
check passes; the others are left to the search that looks at one vehicle at a time.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from beal.stability.pencil import Array
from beal.stability.polish import polished
from beal.stability.ridge import DIP, FLAT
from beal.stability.table import Table

Integers = NDArray[np.intp]
Booleans = NDArray[np.bool_]

INTERVALS = (9, 45, 225)  # of thrust on a panel, for what is still undecided with fewer
GRID = 96  # values of W between which extrema of D are separated, evenly spaced in sqrt(omega)
RIDGES = 6  # extrema that are followed
NEWTON = 12
MARGIN = 1e-6  # share of the critical thrust by which the state before it is checked

STABLE, FLUTTER, DIVERGENCE, UNDECIDED = 0, 1, 2, 3


@dataclass(frozen=True)
class Found:
    """First instability of each vehicle on a panel.

    Parameters
    ----------
    kind : ndarray of int, shape (vehicles,)
        0 none on the panel, 1 flutter, 2 divergence, 3 undecided.
    ridge : ndarray of int, shape (vehicles,)
        Lower of the modes that meet, counted from 1.
    thrust, W, error : ndarray, shape (vehicles,)
    """

    kind: Integers
    ridge: Integers
    thrust: Array
    W: Array
    error: Array


@dataclass(frozen=True)
class _Nodes:
    """Ridges at thrusts, arrays of shape (vehicles, thrusts, ridges); the first ridge is W = 0."""

    W: Array
    heights: Array
    slopes: Array
    sound: Booleans  # (vehicles, thrusts): whether the extrema are those of a function with real roots only


def scan(table: Table, coarser: Table, stiffnesses: Array) -> Found:
    """First instabilities on a panel of vehicles with given springs.

    Parameters
    ----------
    table, coarser : Table
        The same vehicle in two discretisations; the difference is the error estimate.
    stiffnesses : ndarray, shape (vehicles, springs)

    Returns
    -------
    Found
    """
    found = _scan(table, coarser, stiffnesses, INTERVALS[0])
    for intervals in INTERVALS[1:]:
        open_ = np.flatnonzero(found.kind == UNDECIDED)
        again = _scan(table, coarser, stiffnesses[open_], intervals)
        for name, values in vars(again).items():
            getattr(found, name)[open_] = values
    return found


def _scan(table: Table, coarser: Table, stiffnesses: Array, intervals: int) -> Found:
    count = len(stiffnesses)
    rows = np.arange(count)
    found = Found(np.full(count, UNDECIDED), np.zeros(count, dtype=np.intp), *np.full((3, count), np.nan))
    weights = table.weights(stiffnesses)
    thrusts = np.linspace(table.low, table.high, intervals + 1)
    nodes = _nodes(table, weights, np.broadcast_to(thrusts, (count, intervals + 1)))
    unclear = _dips(nodes, np.diff(thrusts)) | _leaps(nodes)
    eventful = np.any(nodes.heights[:, 1:] < -FLAT, axis=2) | ~nodes.sound[:, 1:] | unclear
    first = np.argmax(eventful, axis=1)
    quiet = ~eventful.any(axis=1)
    found.kind[nodes.sound[:, 0] & quiet] = STABLE
    vehicles = np.flatnonzero(nodes.sound[:, 0] & ~quiet & ~unclear[rows, first])
    if not len(vehicles):
        return found
    interval = first[vehicles]
    share, ridge = _crossings(nodes, thrusts, vehicles, interval)
    left, right = thrusts[interval], thrusts[interval + 1]
    ends = nodes.W[vehicles, interval, ridge], nodes.W[vehicles, interval + 1, ridge]
    P, W = left + share * (right - left), (1 - share) * ends[0] + share * ends[1]
    P, W, converged = _newton(table, weights[vehicles], P, W, ridge > 0)
    before = np.column_stack((left, P - MARGIN * np.abs(P)))
    checked = _nodes(table, weights[vehicles], before)
    unclear = _dips(checked, np.diff(before)) | _leaps(checked)
    clear = np.all(checked.heights[:, 1] > -FLAT, axis=1) & checked.sound[:, 1] & ~unclear[:, 0]
    P, W, error = _polished(table, coarser, stiffnesses[vehicles], P, W, ridge > 0)
    good = converged & clear & (left <= P) & (right >= P) & (share <= 1) & np.isfinite(error)
    kept = vehicles[good]
    found.kind[kept] = np.where(ridge[good] > 0, FLUTTER, DIVERGENCE)
    found.ridge[kept] = np.maximum(ridge[good], 1)
    found.thrust[kept], found.W[kept], found.error[kept] = P[good], W[good], error[good]
    return found


def _in_W(table: Table, weights: Array, thrusts: Array, derivative: int = 0) -> Array:
    """Chebyshev coefficients in W at thrusts (vehicles, k), shape (vehicles, k, degree + 1)."""
    x = 2 * (thrusts - table.low) / (table.high - table.low) - 1
    degree = table.coefficients.shape[1] - 1
    basis = chebyshev.chebvander(x, degree)
    if derivative:
        basis = basis[..., :-1] @ chebyshev.chebder(np.eye(degree + 1), derivative).reshape(degree, -1)
        basis = basis * 2 / (table.high - table.low)
    vehicles = np.tensordot(weights, table.coefficients, 1)
    return np.einsum("vkp,vpw->vkw", basis, vehicles)


def _nodes(table: Table, weights: Array, thrusts: Array) -> _Nodes:
    """Ridges of all vehicles at thrusts, shape (vehicles, k)."""
    c, c_P = _in_W(table, weights, thrusts), _in_W(table, weights, thrusts, 1)
    d, dd = (chebyshev.chebder(c, m, axis=-1) for m in (1, 2))
    x = 2 * np.linspace(0.0, 1.0, GRID) ** 4 - 1
    slope = d @ chebyshev.chebvander(x, d.shape[-1] - 1).T
    turn = slope[..., 1:] * slope[..., :-1] < 0
    passed = np.cumsum(turn, axis=-1)
    W = np.zeros((*thrusts.shape, RIDGES + 1))
    heights, slopes = np.ones_like(W), np.zeros_like(W)
    heights[..., 0], slopes[..., 0] = _value(c, -np.ones(thrusts.shape)), _value(c_P, -np.ones(thrusts.shape))
    sound = (heights[..., 0] > 0) <= (slope[..., 0] < 0)
    # behind a divergence the first extremum has gone to W < 0 and the count begins at the second
    offset = (slope[..., 0] > 0).astype(int)
    top = passed[..., -1] + offset
    for ridge in range(1, RIDGES + 1):
        cell = np.argmax(passed >= (ridge - offset)[..., None], axis=-1)
        there = (ridge <= top) & (ridge > offset)
        a, b = x[cell], x[cell + 1]
        fa, fb = (np.take_along_axis(slope, (cell + i)[..., None], -1)[..., 0] for i in (0, 1))
        z = np.where(there, a - fa * (b - a) / np.where(fb == fa, 1.0, fb - fa), 0.0)
        for _ in range(4):
            curvature = _value(dd, z)
            step = _value(d, z) / np.where(curvature == 0, 1.0, curvature)
            z = np.where(there, np.clip(z - step, a, b), 0.0)
        sign = (-1.0) ** ridge
        sound &= ~there | (sign * _value(dd, z) <= 0)
        W[..., ridge] = np.where(there, table.top * (1 + z) / 2, np.nan)
        heights[..., ridge] = np.where(there, sign * _value(c, z), 1.0)
        slopes[..., ridge] = np.where(there, sign * _value(c_P, z), 0.0)
    scale = np.maximum(np.abs(heights[:, :1]), np.abs(heights[:, -1:]) * 1e-3) + np.finfo(float).tiny
    return _Nodes(W, heights / scale, slopes / scale, sound)


def _value(coefficients: NDArray[np.floating], x: Array) -> Array:
    """Chebyshev series along the last axis at one x each (Clenshaw)."""
    b1 = b2 = np.zeros_like(x)
    for c in np.moveaxis(coefficients, -1, 0)[:0:-1]:
        b1, b2 = c + 2 * x * b1 - b2, b1
    return coefficients[..., 0] + x * b1 - b2


def _dips(nodes: _Nodes, steps: Array) -> Booleans:
    """Intervals in which a ridge that is positive at both ends may dip to zero between, (vehicles, intervals)."""
    a, b = nodes.heights[:, :-1], nodes.heights[:, 1:]
    da, db = (steps[..., None] * slopes for slopes in (nodes.slopes[:, :-1], nodes.slopes[:, 1:]))
    lower = np.minimum(a, b)
    deepest = lower
    for t in np.linspace(0.1, 0.9, 9):
        value = a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (2 * (a - b) + da + db)))
        deepest = np.minimum(deepest, value)
    return np.any((deepest < DIP * lower) & (lower > 0), axis=2)


def _leaps(nodes: _Nodes) -> Booleans:
    """Intervals in which a ridge passes the place of its neighbour, (vehicles, intervals): two extrema have merged."""
    old, new = nodes.W[:, :-1], nodes.W[:, 1:]
    return np.any((new[..., :-1] >= old[..., 1:]) | (new[..., 1:] <= old[..., :-1]), axis=2)


def _crossings(nodes: _Nodes, thrusts: Array, vehicles: Integers, interval: Integers) -> tuple[Array, Integers]:
    """Where in its interval each vehicle's first ridge falls through zero, and which: (share, ridge)."""
    a, b = nodes.heights[vehicles, interval], nodes.heights[vehicles, interval + 1]
    step = np.diff(thrusts)[interval][:, None]
    da, db = step * nodes.slopes[vehicles, interval], step * nodes.slopes[vehicles, interval + 1]
    low, high = np.zeros_like(a), np.ones_like(a)
    for _ in range(30):
        t = (low + high) / 2
        value = a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (2 * (a - b) + da + db)))
        low, high = np.where(value > 0, t, low), np.where(value > 0, high, t)
    share = np.where((b < -FLAT) & (a > 0), high, 2.0)
    ridge = np.argmin(share, axis=1)
    return np.take_along_axis(share, ridge[:, None], 1)[:, 0], ridge


def _derivatives(table: Table, weights: Array, P: Array, W: Array) -> Array:
    """D, D_P, D_W, D_WW and D_WP, shape (5, vehicles)."""
    c, c_P = (_in_W(table, weights, P[:, None], m)[:, 0] for m in (0, 1))
    x, scale = 2 * W / table.top - 1, 2 / table.top
    d, dd, d_P = chebyshev.chebder(c, 1, axis=-1), chebyshev.chebder(c, 2, axis=-1), chebyshev.chebder(c_P, 1, axis=-1)
    return np.array(
        [_value(c, x), _value(c_P, x), scale * _value(d, x), scale**2 * _value(dd, x), scale * _value(d_P, x)]
    )


def _newton(table: Table, weights: Array, P: Array, W: Array, flutter: Booleans) -> tuple[Array, Array, Booleans]:
    """Roots of D = D_W = 0 for flutter, of D(P, 0) = 0 for divergence."""
    converged = np.zeros(len(P), dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(NEWTON):
            D, D_P, D_W, D_WW, D_WP = _derivatives(table, weights, P, W)
            determinant = D_P * D_WW - D_W * D_WP
            step_P = np.where(flutter, (D * D_WW - D_W**2) / determinant, D / D_P)
            step_W = np.where(flutter, (D_P * D_W - D_WP * D) / determinant, 0.0)
            P, W = P - step_P, W - step_W
            converged = (np.abs(step_P) < 1e-9 * np.abs(P)) & (np.abs(step_W) <= 1e-7 * np.abs(W))
            P, W = np.where(np.isfinite(P), P, table.low), np.where(np.isfinite(W), W, 0.0)
            if converged.all():
                break
    inside = (table.low < P) & (table.high > P) & (W >= 0) & (table.top > W)
    return P, W, converged & inside


def _polished(
    table: Table, coarser: Table, stiffnesses: Array, P: Array, W: Array, flutter: Booleans
) -> tuple[Array, Array, Array]:
    """Critical points of the matrices behind the table, and how far those of the coarser ones are from them."""
    coarse, _ = polished(coarser.springs, stiffnesses, P, W, flutter)
    P, W = polished(table.springs, stiffnesses, P, W, flutter)
    return P, W, np.abs(P - coarse)
