"""The ridge scan over many vehicles, compiled: one vehicle after another, each on the panel's tables.

All of D along a line of W is a few products of the tables, which the compiler turns into vector instructions; what is
found there is followed with a few dozen numbers. `beal.stability.kernels.scan_plain` is the same search on arrays.
"""

import numpy as np

from beal.stability.kernels.compiled import compiled
from beal.stability.kernels.point_compiled import bottom, combine, critical
from beal.stability.kernels.rules import (
    BORDER,
    CLEAR,
    DIP,
    DIVERGENCE,
    FLAT,
    FLUTTER,
    FOUND,
    HALVINGS,
    NARROW,
    NEAR,
    RIDGES,
    SLACK,
    SMALL,
    STABLE,
    UNCLEAR,
    UNDECIDED,
)


@compiled
def scan(panel, weights, kind, ridge, found):
    """First instability of each vehicle on a panel; fills in ``kind``, ``ridge`` and ``found``.

    Parameters
    ----------
    panel : Panel
    weights : ndarray, shape (vehicles, subsets)
    kind, ridge : ndarray of int, shape (vehicles,)
    found : ndarray, shape (vehicles, 4)
        Thrust, W, error estimate, and whether on a border.
    """
    thrusts, W, nodes, series, edges, patches, coarser, degree = panel  # whole, it would be counted at every use
    grid, low, high = len(W), thrusts[0], thrusts[-1]
    patch = np.empty((degree + 1, patches.shape[2] // (degree + 1)))
    rows = np.empty((3, patch.shape[1]))
    flat = np.empty(4 * grid)
    lines = flat.reshape(4, grid)
    own = np.empty((len(series), 4 * grid))
    left, right, result = np.empty((3, RIDGES)), np.empty((3, RIDGES)), np.empty(5)
    scale, cells, ahead = np.empty(RIDGES), np.empty(RIDGES, dtype=np.int64), np.empty(HALVINGS + 1)
    for v in range(len(weights)):
        w = weights[v]
        kind[v], ridge[v] = UNDECIDED, 0
        found[v, :] = np.nan
        found[v, 3] = 0.0
        combine(w, nodes[0], flat)
        count, sound = state(lines, W, cells, left)
        if not sound or not positive(left, count):
            continue
        scale[:] = 0.0
        expanded, halvings, outcome, here = False, 0, CLEAR, low
        for k in range(1, len(thrusts)):
            depth = 1
            ahead[0] = thrusts[k]
            while depth and halvings < HALVINGS:
                there = ahead[depth - 1]
                if depth == 1:
                    combine(w, nodes[k], flat)
                else:
                    if not expanded:
                        for p in range(len(own)):
                            combine(w, series[p], own[p])
                        expanded = True
                    series_at(own, 2 * (there - low) / (high - low) - 1, flat)
                above, sound = state(lines, W, cells, right)
                for i in range(count):
                    scale[i] = max(scale[i], abs(left[1, i]))
                if sound and quiet(left, count, right, above, there - here):
                    outcome = CLEAR
                elif sound:
                    outcome = between(
                        edges,
                        patches,
                        coarser,
                        low,
                        high,
                        patch,
                        rows,
                        w,
                        left,
                        count,
                        here,
                        right,
                        above,
                        there,
                        scale,
                        result,
                    )
                    if outcome != UNCLEAR:
                        found[v, 3] = max(found[v, 3], result[4])
                else:
                    outcome = UNCLEAR
                if outcome == CLEAR:
                    left, right = right, left
                    count, here = above, there
                    depth -= 1
                elif outcome == FOUND:
                    break
                else:
                    halvings = halvings + 1 if there - here > NARROW * (high - low) else HALVINGS
                    ahead[depth] = (here + there) / 2
                    depth += 1
            if outcome != CLEAR:
                break
        if outcome == CLEAR:
            kind[v] = STABLE
        elif outcome == FOUND:
            kind[v] = FLUTTER if result[3] else DIVERGENCE
            ridge[v] = max(int(result[3]), 1)
            found[v, :3] = result[:3]


@compiled
def series_at(coefficients, x, out):
    """Chebyshev series at x of rows of coefficients."""
    for g in range(len(out)):
        out[g] = coefficients[0, g] + x * coefficients[1, g]
    before, now = 1.0, x
    for p in range(2, len(coefficients)):
        before, now = now, 2 * x * now - before
        for g in range(len(out)):
            out[g] += now * coefficients[p, g]


@compiled
def state(lines, W, cells, ridges):
    """Fills in W, height and slope of each ridge at a thrust: their number, and whether they make sense."""
    D, D_W, D_P, D_WP = lines[0], lines[1], lines[2], lines[3]
    ridges[0, 0], ridges[1, 0], ridges[2, 0] = 0.0, D[0], D_P[0]
    first = 1
    if D_W[0] > 0:  # behind a divergence the first extremum has gone to W < 0
        ridges[0, 1], ridges[1, 1], ridges[2, 1] = -1.0, 1.0, 0.0
        first = 2
    count = first
    for g in range(len(W) - 1):
        if (D_W[g] < 0) != (D_W[g + 1] < 0):
            if count == RIDGES:
                return count, False
            cells[count] = g
            count += 1
    for i in range(first, count):  # the extremum of the cubic in its cell
        g = cells[i]
        h = W[g + 1] - W[g]
        a, b, rise = h * D_W[g], h * D_W[g + 1], D[g + 1] - D[g]
        A, B = 3 * (a + b) - 6 * rise, 6 * rise - 4 * a - 2 * b
        q = -0.5 * (B + np.copysign(np.sqrt(max(B * B - 4 * A * a, 0.0)), B))
        t = a / q
        t = t if 0 <= t <= 1 else q / A
        sign = 1.0 - 2.0 * (i & 1)
        ridges[0, i] = W[g] + t * h
        ridges[1, i] = sign * cubic(t, D[g], a, D[g + 1], b)
        ridges[2, i] = sign * cubic(t, D_P[g], h * D_WP[g], D_P[g + 1], h * D_WP[g + 1])
    return count, (D[0] > 0) <= (D_W[0] < 0)


@compiled
def cubic(t, a, da, b, db):
    """The cubic with values a, b and slopes da, db at the ends of [0, 1]."""
    return a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (da + db - 2 * (b - a))))


@compiled
def positive(ridges, count):
    """Whether all heights are."""
    for i in range(count):
        if not ridges[1, i] > 0:
            return False
    return True


@compiled
def quiet(left, count, right, above, step):
    """Whether plainly no ridge comes near zero between two thrusts: a cubic lies within its control points."""
    if count != above:
        return False
    for i in range(count):
        a, b, da, db = left[1, i], right[1, i], step * left[2, i], step * right[2, i]
        slack = SLACK * (abs(da) + abs(db) + abs(b - a))
        if not 0 < DIP * min(a, b) < min(a + da / 3, b - db / 3) - slack:
            return False
    for i in range(2, count):
        if left[0, i - 1] >= right[0, i] or right[0, i - 1] >= left[0, i]:
            return False
    return True


@compiled
def between(edges, patches, coarser, low, high, patch, rows, w, left, count, here, right, above, there, scale, result):
    """What happens between two thrusts; fills in thrust, W, error, ridge of the first instability, and border."""
    result[0], result[4] = np.inf, 0.0
    if above < count - 1:
        return UNCLEAR
    both, step = min(count, above), there - here
    for i in range(both, above):
        if right[1, i] <= 0:
            return UNCLEAR
    for i in range(2, both):  # a ridge that passes the place of its neighbour: two extrema have merged
        if left[0, i - 1] >= right[0, i] or right[0, i - 1] >= left[0, i]:
            return UNCLEAR
    for i in range(both):
        if right[0, i] < 0:  # gone to W < 0, and unseen whether through flutter
            return UNCLEAR
        a, b, da, db = left[1, i], right[1, i], step * left[2, i], step * right[2, i]
        small = SMALL * max(scale[i], abs(b))
        share, value = lowest(a, da, b, db)
        end, height, slope = there, b, db
        if b > small:
            if value - SLACK * (abs(da) + abs(db) + abs(b - a)) > DIP * min(a, b):
                continue
            guess, at = here + share * step, (1 - share) * left[0, i] + share * right[0, i]
            end, at, height, rounding = bottom(edges, patches, low, high, patch, rows, w, guess, at, i)
            if not here < end < there or abs(height - value) > NEAR * min(a, b):
                return UNCLEAR
            flat = max(FLAT * scale[i], rounding)
            if height > -flat:
                if height < flat:  # it touches zero: a tongue opens next to this vehicle
                    result[4] = 1.0
                continue
            da, slope = (end - here) * left[2, i], 0.0  # a tongue, open before its deepest point
        else:
            at = right[0, i]
        share = zero(a, da, height, slope) if height < 0 else 1.0
        guess = here + share * (end - here)
        if guess - NEAR * step > result[0]:
            continue
        at = (1 - share) * left[0, i] + share * at
        P, at, error, good = critical(edges, patches, coarser, low, high, patch, rows, w, guess, at, i)
        if not good or P <= here or abs(P - guess) > NEAR * step:
            return UNCLEAR
        if P > end:
            if min(height, value) < -small:
                return UNCLEAR
            continue  # just behind the end, whose height is zero to the interpolation's error
        if abs(P - result[0]) < BORDER * P:
            result[4] = 1.0
        if P < result[0]:
            result[0], result[1], result[2], result[3] = P, at, error, i
    return FOUND if result[0] < np.inf else CLEAR


@compiled
def lowest(a, da, b, db):
    """Where the cubic with values a, b and slopes da, db at the ends of [0, 1] is lowest, and how low."""
    share, value = (0.0, a) if a < b else (1.0, b)
    A, B = 3 * (da + db) - 6 * (b - a), 6 * (b - a) - 4 * da - 2 * db
    square = B * B - 4 * A * da
    if square > 0:
        q = -0.5 * (B + np.copysign(np.sqrt(square), B))
        for t in (q / A if A != 0 else -1.0, da / q if q != 0 else -1.0):
            if 0 < t < 1:
                other = cubic(t, a, da, b, db)
                if other < value:
                    share, value = t, other
    return share, value


@compiled
def zero(a, da, b, db):
    """A zero of such a cubic with a > 0 > b, by Newton's method between brackets."""
    second, third = 3 * (b - a) - 2 * da - db, da + db - 2 * (b - a)
    low, high, t = 0.0, 1.0, a / (a - b)
    for _ in range(20):
        value = a + t * (da + t * (second + t * third))
        low, high = (t, high) if value > 0 else (low, t)
        slope = da + t * (2 * second + t * 3 * third)
        new = t - value / slope if slope != 0 else -1.0
        new = new if low < new < high else 0.5 * (low + high)
        if abs(new - t) < 1e-6:
            return new
        t = new
    return t
