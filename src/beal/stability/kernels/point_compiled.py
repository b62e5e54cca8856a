"""Points of D on a vehicle's own patch: where a ridge reaches zero, and where it is lowest; compiled."""

import numpy as np

from beal.stability.kernels.compiled import compiled
from beal.stability.kernels.rules import NEWTON, ROUNDING


@compiled
def combine(w, tables, out):
    """sum over subsets of w tables, two at a time, shape (len(out),)."""
    for g in range(len(out)):
        out[g] = w[0] * tables[0, g] + w[1] * tables[1, g]
    for s in range(2, len(w), 2):
        for g in range(len(out)):
            out[g] += w[s] * tables[s, g] + w[s + 1] * tables[s + 1, g]


@compiled
def critical(edges, patches, coarser, low, high, patch, rows, w, P, W, i):
    """Root of D = D_W = 0, or of D(P, 0) = 0 for i = 0, next to a guess: thrust, W, error, whether it converged."""
    q, sign = -1, 1.0 - 2.0 * (i & 1)
    for _ in range(NEWTON):
        q, D, D_P, D_W, D_WW, D_WP, _ = on_patch(edges, patches, low, high, patch, rows, w, P, W, q)
        if q < 0:
            break
        if i == 0:
            step_P, step_W = D / D_P, 0.0
        else:
            determinant = D_P * D_WW - D_W * D_WP
            step_P, step_W = (D * D_WW - D_W * D_W) / determinant, (D_P * D_W - D_WP * D) / determinant
        P -= step_P
        W -= step_W
        if abs(step_P) < 1e-8 * abs(P) and abs(step_W) <= 1e-7 * abs(W):
            error = uncertainty(patch)
            combine(w, coarser[q], patch.ravel())
            error += abs(derivatives(patch, rows, low, high, edges[q], edges[q + 1], P, W)[0])
            return P, W, error / abs(D_P), sign * D_P < 0 and (i == 0 or sign * D_WW < 0)
    return P, W, np.inf, False


@compiled
def bottom(edges, patches, low, high, patch, rows, w, P, W, i):
    """The lowest point of a ridge next to a guess: thrust, W, height, uncertainty of the height."""
    q, sign = -1, 1.0 - 2.0 * (i & 1)
    for _ in range(NEWTON):
        q, D, D_P, D_W, D_WW, D_WP, D_PP = on_patch(edges, patches, low, high, patch, rows, w, P, W, q)
        if q < 0:
            break
        if i == 0:
            step_P, step_W = D_P / D_PP, 0.0
        else:
            determinant = D_PP * D_WW - D_WP * D_WP
            step_P, step_W = (D_P * D_WW - D_W * D_WP) / determinant, (D_PP * D_W - D_WP * D_P) / determinant
        if abs(step_P) < 1e-7 * abs(P) and abs(step_W) <= 1e-6 * abs(W):
            if i and sign * D_WW >= 0:
                break
            return P, W, sign * D, uncertainty(patch)
        P -= step_P
        W -= step_W
    return np.inf, W, 0.0, 0.0


@compiled
def on_patch(edges, patches, low, high, patch, rows, w, P, W, own):
    """The patch that holds a point, -1 off the panel, and the derivatives there; ``patch`` holds that of ``own``."""
    if not inside(edges, low, high, P, W):
        return -1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    q = patch_of(edges, W)
    if q != own:
        combine(w, patches[q], patch.ravel())
    D, D_P, D_W, D_WW, D_WP, D_PP = derivatives(patch, rows, low, high, edges[q], edges[q + 1], P, W)
    return q, D, D_P, D_W, D_WW, D_WP, D_PP


@compiled
def uncertainty(patch):
    """Of D: rounding, and what the series leaves out, which is less than its last terms."""
    n, m = patch.shape
    total = last = 0.0
    for p in range(n):
        for j in range(m):
            total += abs(patch[p, j])
        last += abs(patch[p, m - 1])
    for j in range(m):
        last += abs(patch[n - 1, j])
    return ROUNDING * total + last


@compiled
def inside(edges, low, high, P, W):
    """Whether a point is on the panel, or near it in thrust."""
    return W >= 0 and edges[-1] >= W and abs(P - low) <= 2 * (high - low)


@compiled
def patch_of(edges, W):
    """The patch that holds W."""
    q = 0
    while q < len(edges) - 2 and edges[q + 1] < W:
        q += 1
    return q


@compiled
def derivatives(patch, rows, low, high, bottom, top, P, W):
    """D, D_P, D_W, D_WW, D_WP and D_PP of a vehicle from its patch; ``rows`` is room for three of its rows."""
    to_x, to_y = 2 / (high - low), 2 / (top - bottom)
    x, y = to_x * (P - low) - 1, to_y * (W - bottom) - 1
    n, m = patch.shape
    for j in range(m):
        rows[0, j] = rows[1, j] = rows[2, j] = 0.0
    t, t_, d, d_, e, e_ = 1.0, x, 0.0, 1.0, 0.0, 0.0  # T_p, T_p' and T_p'' and their successors
    for p in range(n):
        for j in range(m):
            rows[0, j] += t * patch[p, j]
            rows[1, j] += d * patch[p, j]
            rows[2, j] += e * patch[p, j]
        t, t_, d, d_, e, e_ = t_, 2 * x * t_ - t, d_, 2 * t_ + 2 * x * d_ - d, e_, 4 * d_ + 2 * x * e_ - e
    D = D_P = D_W = D_WW = D_WP = D_PP = 0.0
    t, t_, d, d_, e, e_ = 1.0, y, 0.0, 1.0, 0.0, 0.0
    for j in range(m):
        D += t * rows[0, j]
        D_P += t * rows[1, j]
        D_W += d * rows[0, j]
        D_WW += e * rows[0, j]
        D_WP += d * rows[1, j]
        D_PP += t * rows[2, j]
        t, t_, d, d_, e, e_ = t_, 2 * y * t_ - t, d_, 2 * t_ + 2 * y * d_ - d, e_, 4 * d_ + 2 * y * e_ - e
    return D, to_x * D_P, to_y * D_W, to_y * to_y * D_WW, to_x * to_y * D_WP, to_x * to_x * D_PP
