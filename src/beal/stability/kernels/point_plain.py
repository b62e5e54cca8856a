"""Points of D on the vehicles' own patches: where a ridge reaches zero, and where it is lowest; on arrays."""

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from beal.stability.kernels.rules import NEWTON, ROUNDING
from beal.stability.pencil import Array
from beal.stability.table import Panel

Integers = NDArray[np.intp]
Booleans = NDArray[np.bool_]
Step = Callable[[Array, Array, Array, Array, Array, Array], tuple[Array, Array]]


def critical(panel: Panel, weights: Array, P: Array, W: Array, i: int) -> tuple[Array, Array, Array, Booleans]:
    """Roots of D = D_W = 0, or of D(P, 0) = 0 for i = 0, next to guesses: thrust, W, error, whether they converged."""
    sign = 1.0 - 2.0 * (i & 1)

    def step(D: Array, D_P: Array, D_W: Array, D_WW: Array, D_WP: Array, _: Array) -> tuple[Array, Array]:
        if i == 0:
            return D / D_P, np.zeros_like(D)
        determinant = D_P * D_WW - D_W * D_WP
        return (D * D_WW - D_W * D_W) / determinant, (D_P * D_W - D_WP * D) / determinant

    P, W, (D, D_P, D_W, D_WW, D_WP, D_PP), good = _newton(panel, weights, P, W, step, 1e-8)
    step_P, step_W = step(D, D_P, D_W, D_WW, D_WP, D_PP)
    q = _patch_of(panel, W)
    P, W = P - step_P, W - step_W
    rounding = _uncertainty(panel, weights, q)
    shift = np.abs(_derivatives(panel, weights, panel.coarser, q, P, W)[0])
    good &= (sign * D_P < 0) & ((i == 0) | (sign * D_WW < 0))
    return P, W, (shift + rounding) / np.abs(D_P), good


def bottom(panel: Panel, weights: Array, P: Array, W: Array, i: int) -> tuple[Array, Array, Array, Array]:
    """The lowest points of ridges next to guesses: thrust, W, height, rounding of the height."""
    sign = 1.0 - 2.0 * (i & 1)

    def step(D: Array, D_P: Array, D_W: Array, D_WW: Array, D_WP: Array, D_PP: Array) -> tuple[Array, Array]:
        if i == 0:
            return D_P / D_PP, np.zeros_like(D)
        determinant = D_PP * D_WW - D_WP * D_WP
        return (D_P * D_WW - D_W * D_WP) / determinant, (D_PP * D_W - D_WP * D_P) / determinant

    P, W, values, good = _newton(panel, weights, P, W, step, 1e-7)
    good &= (i == 0) | (sign * values[3] < 0)
    rounding = _uncertainty(panel, weights, _patch_of(panel, W))
    return np.where(good, P, np.inf), W, sign * values[0], rounding


def _newton(
    panel: Panel, weights: Array, P: Array, W: Array, step: Step, tolerance: float
) -> tuple[Array, Array, Array, Booleans]:
    """Newton's method until a step is small, which is not taken: thrust, W, derivatives there, whether it is."""
    P, W = P.copy(), W.copy()
    values, good = np.full((6, len(P)), np.nan), np.zeros(len(P), dtype=bool)
    going = np.arange(len(P))
    low, high = panel.thrusts[0], panel.thrusts[-1]
    for _ in range(NEWTON):
        p, w = P[going], W[going]
        going = going[(w >= 0) & (panel.edges[-1] >= w) & (np.abs(p - low) <= 2 * (high - low))]
        if not len(going):
            break
        p, w = P[going], W[going]
        values[:, going] = _derivatives(panel, weights[going], panel.patches, _patch_of(panel, w), p, w)
        step_P, step_W = step(*values[:, going])
        small = (np.abs(step_P) < tolerance * np.abs(p)) & (np.abs(step_W) <= 10 * tolerance * np.abs(w))
        good[going[small]] = True
        going, step_P, step_W = going[~small], step_P[~small], step_W[~small]
        P[going] -= step_P
        W[going] -= step_W
    return P, W, values, good


def _patch_of(panel: Panel, W: Array) -> Integers:
    return np.clip(np.searchsorted(panel.edges, W) - 1, 0, len(panel.edges) - 2)


def _own(weights: Array, patches: Array, q: Integers) -> Array:
    """Each vehicle's own coefficients on a patch, shape (vehicles, coefficients)."""
    own = np.empty((len(weights), patches.shape[2]))
    for patch in np.unique(q):
        here = q == patch
        own[here] = weights[here] @ patches[patch]
    return own


def _uncertainty(panel: Panel, weights: Array, q: Integers) -> Array:
    """Of D: rounding, and what the series leaves out, which is less than its last terms."""
    terms = np.abs(_own(weights, panel.patches, q)).reshape(
        len(q), panel.degree + 1, panel.patches.shape[2] // (panel.degree + 1)
    )
    share = np.full(terms.shape[1:], ROUNDING)
    share[-1], share[:, -1] = 1.0, 1.0
    return np.einsum("vpw,pw->v", terms, share)


def _derivatives(panel: Panel, weights: Array, patches: Array, q: Integers, P: Array, W: Array) -> Array:
    """D, D_P, D_W, D_WW, D_WP and D_PP of each vehicle on a patch, shape (6, vehicles)."""
    low, high, bottom, top = panel.thrusts[0], panel.thrusts[-1], panel.edges[q], panel.edges[q + 1]
    to_x, to_y = 2 / (high - low), 2 / (top - bottom)
    own = _own(weights, patches, q).reshape(len(q), panel.degree + 1, patches.shape[2] // (panel.degree + 1))
    in_P = _basis(to_x * (P - low) - 1, own.shape[1])
    in_W = _basis(to_y * (W - bottom) - 1, own.shape[2])
    rows = np.einsum("dvp,vpw->dvw", in_P, own)
    D, D_W, D_WW = np.einsum("vw,dvw->dv", rows[0], in_W)
    D_P, D_WP = np.einsum("vw,dvw->dv", rows[1], in_W[:2])
    D_PP = np.einsum("vw,vw->v", rows[2], in_W[0])
    return np.array((D, to_x * D_P, to_y * D_W, to_y**2 * D_WW, to_x * to_y * D_WP, to_x**2 * D_PP))


def _basis(x: Array, count: int) -> Array:
    """Chebyshev polynomials and their first two derivatives, shape (3, vehicles, count)."""
    values = chebyshev.chebvander(x, count - 1)
    one = np.eye(count)
    first = values[:, :-1] @ chebyshev.chebder(one)
    second = values[:, :-2] @ chebyshev.chebder(one, 2)
    return np.stack((values, first, second))
