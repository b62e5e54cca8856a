"""The ridge scan over many vehicles on arrays: the plain twin of `beal.stability.kernels.scan_compiled`.

All vehicles are looked at on all coarse thrusts at once; most show at a glance where they first may lose stability.
Those intervals are settled for all vehicles together, halved where that is not clear.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from beal.stability.kernels.point_plain import Booleans, Integers, bottom, critical
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
from beal.stability.pencil import Array
from beal.stability.table import Panel

TOGETHER = 4096  # vehicles, to bound the memory
CACHED = 64  # vehicles whose lines of D fit the cache


@dataclass
class State:
    """Ridges of vehicles at one thrust each, the first at W = 0.

    Parameters
    ----------
    W, heights, slopes : ndarray, shape (vehicles, RIDGES)
    count : ndarray of int, shape (vehicles,)
    sound : ndarray of bool, shape (vehicles,)
        Whether the ridges make sense.
    """

    W: Array
    heights: Array
    slopes: Array
    count: Integers
    sound: Booleans

    def of(self, index: Integers) -> "State":
        """Those of some vehicles."""
        return State(*(part[index] for part in vars(self).values()))

    def put(self, index: Integers, other: "State") -> None:
        """Replaces those of some vehicles."""
        for name, part in vars(self).items():
            part[index] = getattr(other, name)


@dataclass
class Front:
    """Vehicles that are not settled yet, and the interval of thrust in which each is looked at.

    Parameters
    ----------
    vehicle : ndarray of int, shape (k,)
    node : ndarray of int, shape (k,)
        The coarse thrust that is to be reached.
    here : ndarray, shape (k,)
        The thrust up to which all is quiet.
    left : State
        There.
    ahead : ndarray, shape (k, HALVINGS + 1)
        Thrusts still to be reached, the nearest last.
    depth : ndarray of int, shape (k,)
        The nearest one's place in ``ahead``; 0 for the node itself.
    halvings : ndarray of int, shape (k,)
    scale : ndarray, shape (k, RIDGES)
        Greatest height of each ridge so far.
    """

    vehicle: Integers
    node: Integers
    here: Array
    left: State
    ahead: Array
    depth: Integers
    halvings: Integers
    scale: Array

    def only(self, index: Integers) -> "Front":
        """Some of them."""
        parts = {name: part[index] for name, part in vars(self).items() if name != "left"}
        return Front(left=self.left.of(index), **parts)


def scan(panel: Panel, weights: Array, kind: Integers, mode: Integers, found: Array) -> None:
    """First instability of each vehicle on a panel; fills in ``kind``, ``mode`` and ``found``.

    Parameters
    ----------
    panel : Panel
    weights : ndarray, shape (vehicles, subsets)
    kind, mode : ndarray of int, shape (vehicles,)
    found : ndarray, shape (vehicles, 4)
        Thrust, W, error estimate, and whether on a border.
    """
    kind[:], mode[:], found[:, :3], found[:, 3] = UNDECIDED, 0, np.nan, 0.0
    with np.errstate(all="ignore"):
        for start in range(0, len(weights), TOGETHER):
            part = slice(start, start + TOGETHER)
            _scan(panel, weights[part], kind[part], mode[part], found[part])


def _scan(panel: Panel, weights: Array, kind: Integers, mode: Integers, found: Array) -> None:
    nodes = _at_nodes(panel, weights)
    last = len(panel.thrusts)
    pairs = np.arange(len(weights) * last).reshape(len(weights), last)
    step = np.full(len(weights) * (last - 1), panel.thrusts[1] - panel.thrusts[0])
    calm = _quiet(nodes.of(pairs[:, :-1].ravel()), nodes.of(pairs[:, 1:].ravel()), step).reshape(-1, last - 1)
    front = _start(panel, nodes, calm)
    while True:
        kind[front.vehicle[front.node == last]] = STABLE
        front = front.only(np.flatnonzero((front.node < last) & (front.halvings < HALVINGS)))
        if not len(front.vehicle):
            return
        there = front.ahead[np.arange(len(front.vehicle)), front.depth]
        right = nodes.of(front.vehicle * last + front.node)
        off = np.flatnonzero(front.depth > 0)
        right.put(off, _state(_lines(panel, weights[front.vehicle[off]], there[off]), panel.W))
        front.scale = np.maximum(front.scale, np.where(_there(front.left), np.abs(front.left.heights), 0.0))
        outcome = np.where(_quiet(front.left, right, there - front.here), CLEAR, UNCLEAR)
        open_ = np.flatnonzero(right.sound & (outcome == UNCLEAR))
        result = _between(panel, weights[front.vehicle[open_]], front.only(open_), right.of(open_), there[open_])
        outcome[open_] = result.outcome
        where = front.vehicle[open_]
        found[where, 3] = np.maximum(found[where, 3], result.border)
        hit = result.outcome == FOUND
        found[where[hit], :3] = result.values[hit]
        kind[where[hit]] = np.where(result.ridge[hit] > 0, FLUTTER, DIVERGENCE)
        mode[where[hit]] = np.maximum(result.ridge[hit], 1)
        _halve(front, np.flatnonzero(outcome == UNCLEAR), there, NARROW * (panel.thrusts[-1] - panel.thrusts[0]))
        _advance(front, np.flatnonzero(outcome == CLEAR), there, right)
        _to_next(front, panel, nodes, calm)
        front = front.only(np.flatnonzero(outcome != FOUND))


def _at_nodes(panel: Panel, weights: Array) -> State:
    """Ridges of all vehicles at all coarse thrusts, the thrusts varying faster."""
    tables = panel.nodes.transpose(1, 0, 2).reshape(weights.shape[1], -1)
    parts = [weights[start : start + CACHED] @ tables for start in range(0, len(weights), CACHED)]
    states = [vars(_state(part.reshape(len(part) * len(panel.thrusts), -1), panel.W)).values() for part in parts]
    return State(*(np.concatenate(part) for part in zip(*states, strict=True)))


def _start(panel: Panel, nodes: State, calm: Booleans) -> Front:
    """All vehicles that are stable at the first thrust, in their first intervals that are not quiet."""
    last = len(panel.thrusts)
    vehicle = np.arange(len(calm))
    vehicle = vehicle[nodes.sound[::last] & np.all(nodes.heights[::last] > 0, axis=1)]
    node = _next(calm, vehicle, np.zeros_like(vehicle))
    ahead = np.empty((len(vehicle), HALVINGS + 1))
    ahead[:, 0] = panel.thrusts[np.minimum(node, last - 1)]
    greatest = np.maximum.accumulate(np.abs(nodes.heights).reshape(len(calm), last, -1), axis=1)
    return Front(
        vehicle,
        node,
        panel.thrusts[node - 1],
        nodes.of(vehicle * last + node - 1),
        ahead,
        np.zeros_like(vehicle),
        np.zeros_like(vehicle),
        greatest[vehicle, node - 1],
    )


def _halve(front: Front, index: Integers, there: Array, narrow: float) -> None:
    """Takes the middle of an interval as the next thrust to reach."""
    here, there = front.here[index], there[index]
    front.halvings[index] = np.where(there - here > narrow, front.halvings[index] + 1, HALVINGS)
    front.depth[index] += 1
    front.ahead[index, np.minimum(front.depth[index], HALVINGS)] = (here + there) / 2


def _advance(front: Front, index: Integers, there: Array, right: State) -> None:
    """Goes on from the ends of intervals that are clear; depth -1 marks that the node is reached."""
    front.left.put(index, right.of(index))
    front.here[index] = there[index]
    front.depth[index] -= 1


def _to_next(front: Front, panel: Panel, nodes: State, calm: Booleans) -> None:
    """From nodes that are reached to the next intervals that are not quiet."""
    last = len(panel.thrusts)
    index = np.flatnonzero(front.depth < 0)
    before = front.node[index]
    node = _next(calm, front.vehicle[index], before)
    front.node[index], front.depth[index] = node, 0
    front.here[index] = panel.thrusts[node - 1]
    front.ahead[index, 0] = panel.thrusts[np.minimum(node, last - 1)]
    front.left.put(index, nodes.of(front.vehicle[index] * last + node - 1))


def _next(calm: Booleans, vehicles: Integers, node: Integers) -> Integers:
    """The node at the end of each vehicle's next interval that is not quiet; the number of nodes if there is none."""
    intervals = np.arange(calm.shape[1])
    waiting = ~calm[vehicles] & (intervals >= node[:, None])
    return np.where(waiting.any(axis=1), np.argmax(waiting, axis=1) + 1, calm.shape[1] + 1)


def _lines(panel: Panel, weights: Array, thrusts: Array) -> Array:
    """Lines of D and its derivatives, each vehicle at a thrust of its own, shape (vehicles, 4 grid)."""
    low, high = panel.thrusts[0], panel.thrusts[-1]
    basis = chebyshev.chebvander(2 * (thrusts - low) / (high - low) - 1, panel.degree)
    return np.einsum("vp,vs,psg->vg", basis, weights, panel.series, optimize=True)


def _state(lines: Array, grid: Array) -> State:
    """Ridges from lines of D, D_W, D_P and D_WP, shape (k, 4 grid)."""
    count = len(lines)
    D, D_W, D_P, D_WP = lines.reshape(count, 4, len(grid)).transpose(1, 0, 2)
    negative = D_W < 0
    row, g = np.nonzero(negative[:, 1:] != negative[:, :-1])
    first = np.where(D_W[:, 0] > 0, 2, 1)  # behind a divergence the first extremum has gone to W < 0
    found = np.bincount(row, minlength=count)
    ridge = np.arange(len(row)) - np.repeat(np.cumsum(found) - found, found) + first[row]
    fits = ridge < RIDGES
    row, g, ridge = row[fits], g[fits], ridge[fits]
    h = grid[g + 1] - grid[g]
    a, b = h * D_W[row, g], h * D_W[row, g + 1]
    rise = D[row, g + 1] - D[row, g]
    A, B = 3 * (a + b) - 6 * rise, 6 * rise - 4 * a - 2 * b
    q = -0.5 * (B + np.copysign(np.sqrt(np.maximum(B * B - 4 * A * a, 0.0)), B))
    t = a / q
    t = np.where((t >= 0) & (t <= 1), t, q / A)
    sign = 1.0 - 2.0 * (ridge & 1)
    W, heights, slopes = np.full((count, RIDGES), np.nan), np.ones((count, RIDGES)), np.zeros((count, RIDGES))
    W[:, 0], heights[:, 0], slopes[:, 0] = 0.0, D[:, 0], D_P[:, 0]
    W[first == 2, 1] = -1.0
    W[row, ridge] = grid[g] + t * h
    heights[row, ridge] = sign * _cubic(t, D[row, g], a, D[row, g + 1], b)
    slopes[row, ridge] = sign * _cubic(t, D_P[row, g], h * D_WP[row, g], D_P[row, g + 1], h * D_WP[row, g + 1])
    sound = ((D[:, 0] > 0) <= (D_W[:, 0] < 0)) & (first + found <= RIDGES)
    return State(W, heights, slopes, np.minimum(first + found, RIDGES), sound)


def _cubic(t: Array, a: Array, da: Array, b: Array, db: Array) -> Array:
    """Cubics with values a, b and slopes da, db at the ends of [0, 1]."""
    return a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (da + db - 2 * (b - a))))


def _there(state: State) -> Booleans:
    return np.arange(RIDGES) < state.count[:, None]


def _merged(left: State, right: State) -> Booleans:
    """Whether a ridge passes the place of its neighbour, shape (vehicles,)."""
    a, b = left.W[:, 1:], right.W[:, 1:]
    return np.any((a[:, :-1] >= b[:, 1:]) | (b[:, :-1] >= a[:, 1:]), axis=1)


def _quiet(left: State, right: State, step: Array) -> Booleans:
    """Whether plainly no ridge comes near zero between two thrusts: a cubic lies within its control points."""
    a, b = left.heights, right.heights
    da, db = step[..., None] * left.slopes, step[..., None] * right.slopes
    slack = SLACK * (np.abs(da) + np.abs(db) + np.abs(b - a))
    lower = np.minimum(a, b)
    high = (lower > 0) & (np.minimum(a + da / 3, b - db / 3) - slack > DIP * lower)
    return right.sound & (left.count == right.count) & np.all(high | ~_there(left), axis=1) & ~_merged(left, right)


class Between(NamedTuple):
    """What happens to vehicles in an interval: outcome, border and ridge, and thrust, W and error, (vehicles, 3)."""

    outcome: Integers
    border: Booleans
    ridge: Integers
    values: Array


def _between(panel: Panel, weights: Array, front: Front, right: State, there: Array) -> Between:
    left, here, scale = front.left, front.here, front.scale
    vehicles, step = len(weights), there - here
    border, best = np.zeros(vehicles, dtype=bool), np.zeros(vehicles, dtype=np.intp)
    values = np.full((vehicles, 3), np.nan)
    values[:, 0] = np.inf
    new = _there(right) & ~_there(left)
    unclear = (right.count < left.count - 1) | np.any(new & (right.heights <= 0), axis=1) | _merged(left, right)
    both = _there(left) & _there(right)
    unclear |= np.any(both & (right.W < 0), axis=1)
    a, b = left.heights, right.heights
    da, db = step[:, None] * left.slopes, step[:, None] * right.slopes
    share, lowest = _lowest(a, da, b, db)
    small = SMALL * np.maximum(scale, np.abs(b))
    high = b > small
    slack = SLACK * (np.abs(da) + np.abs(db) + np.abs(b - a))
    suspicious = both & ~(high & (lowest - slack > DIP * np.minimum(a, b)))
    for i in np.flatnonzero(suspicious.any(axis=0)):
        v = np.flatnonzero(suspicious[:, i] & ~unclear)
        end, height, W = there[v].copy(), b[v, i].copy(), right.W[v, i].copy()
        da_i, db_i = da[v, i].copy(), db[v, i].copy()
        dips = np.flatnonzero(high[v, i])
        d = v[dips]
        guess = here[d] + share[d, i] * step[d]
        at = (1 - share[d, i]) * left.W[d, i] + share[d, i] * right.W[d, i]
        end[dips], W[dips], height[dips], rounding = bottom(panel, weights[d], guess, at, int(i))
        poor = ~((here[d] < end[dips]) & (end[dips] < there[d]))
        poor |= ~(np.abs(height[dips] - lowest[d, i]) <= NEAR * np.minimum(a, b)[d, i])
        unclear[d[poor]] = True
        flat = np.maximum(FLAT * scale[d, i], rounding)
        border[d[~poor & (np.abs(height[dips]) < flat)]] = True  # it touches zero: a tongue opens next to this vehicle
        da_i[dips], db_i[dips] = (end[dips] - here[d]) * left.slopes[d, i], 0.0
        go = np.ones(len(v), dtype=bool)
        go[dips] = ~poor & ~(height[dips] > -flat)
        part = np.where(height < 0, _zero(a[v, i], da_i, height, db_i), 1.0)
        guess = here[v] + part * (end - here[v])
        go &= ~(guess - NEAR * step[v] > values[v, 0])
        v, guess, part, end, height, W = v[go], guess[go], part[go], end[go], height[go], W[go]
        P, at, error, good = critical(panel, weights[v], guess, (1 - part) * left.W[v, i] + part * W, int(i))
        bad = ~good | (here[v] >= P) | (np.abs(P - guess) > NEAR * step[v])
        bad |= (end < P) & (np.minimum(height, lowest[v, i]) < -small[v, i])
        unclear[v[bad]] = True
        ok = ~bad & (end >= P)
        v, P, at, error = v[ok], P[ok], at[ok], error[ok]
        border[v] |= np.abs(P - values[v, 0]) < BORDER * P
        sooner = values[v, 0] > P
        v = v[sooner]
        values[v], best[v] = np.column_stack((P, at, error))[sooner], i
    outcome = np.where(unclear, UNCLEAR, np.where(values[:, 0] < np.inf, FOUND, CLEAR))
    return Between(outcome, border & ~unclear, best, values)


def _lowest(a: Array, da: Array, b: Array, db: Array) -> tuple[Array, Array]:
    """Where the cubics with values a, b and slopes da, db at the ends of [0, 1] are lowest, and how low."""
    share, lowest = np.where(a < b, 0.0, 1.0), np.minimum(a, b)
    A, B = 3 * (da + db) - 6 * (b - a), 6 * (b - a) - 4 * da - 2 * db
    q = -0.5 * (B + np.copysign(np.sqrt(B * B - 4 * A * da), B))
    for t in (q / A, da / q):
        other = _cubic(t, a, da, b, db)
        lower = (t > 0) & (t < 1) & (other < lowest)
        share, lowest = np.where(lower, t, share), np.where(lower, other, lowest)
    return share, lowest


def _zero(a: Array, da: Array, b: Array, db: Array) -> Array:
    """A zero of such cubics with a > 0 > b, by Newton's method between brackets."""
    second, third = 3 * (b - a) - 2 * da - db, da + db - 2 * (b - a)
    low, high, t = np.zeros_like(a), np.ones_like(a), a / (a - b)
    for _ in range(20):
        value = a + t * (da + t * (second + t * third))
        low, high = np.where(value > 0, t, low), np.where(value > 0, high, t)
        new = t - value / (da + t * (2 * second + t * 3 * third))
        new = np.where((low < new) & (new < high), new, 0.5 * (low + high))
        settled = np.abs(new - t) < 1e-6
        t = new
        if settled.all():
            break
    return t
