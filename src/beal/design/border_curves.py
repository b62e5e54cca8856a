"""Where the critical thrust of a vehicle may pass a target, or jump across it, as both springs of a joint vary.

With the compliances a = k_ref/k of the two springs, the characteristic function of `beal.stability.table` is

    D(P, W; a_r, a_s) = d0 a_r a_s + d1 a_s + d2 a_r + d3

up to a positive factor, and the curves on which an instability arrives at a thrust are

    divergence at the target    D(P, 0) = 0                a_s is a fraction of a_r
    flutter at the target       D = D_W = 0                a quadratic in a_r for each W
    first divergence below it   D = D_P = 0 at W = 0       a quadratic in a_r for each thrust
    first flutter below it      D = D_W = D_P = 0          a curve in the plane of thrust and W

The quadratics are followed in the plane of a_r and of W or thrust, since W or thrust hardly changes along some. For the
last, three linear equations give (a_r a_s, a_s, a_r, 1) as the vector v of 3 x 3 minors, a product where v0 v3 = v1 v2.
"""

from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from beal.design.border_contour import Contour
from beal.design.border_surface import Surface
from beal.stability.pencil import Array

REACH = 1e5  # springs up to this many times their reference, and down to one over it
WAVES = 48  # values of W for each patch at which a curve is looked for
THRUSTS = 24  # the same for each panel of thrusts
STEP = 0.08  # between neighbours on a curve, of ln k
ROUNDS = 36  # of halving, at the ends of a curve
MOST = 4000  # points of a curve: more are needed only where it is lost in rounding
TURN, LOOKS = 0.2, 8  # in radians, between neighbours that have no springs; halvings to look for some between them
SINGLE = (2, 1)  # place in d of the rotational and of the shear compliance alone
NOTHING = 1e-9  # share of D that is rounding

Kind = Literal["flutter", "divergence"]
Edge = Literal["crossing", "jump"]


class Curve(NamedTuple):
    """Neighbouring points at which an instability arrives.

    Parameters
    ----------
    kind, edge : str
    parameters : ndarray, shape (n, 1) or (n, 2)
        Of the points: ln k_r/k_ref, W, thrust, or thrust and W.
    middle : callable
        Parameters between neighbours on the curve.
    points : callable
        Points at parameters.
    at : Points
    """

    kind: Kind
    edge: Edge
    parameters: Array
    middle: "Middle"
    points: "Locate"
    at: "Points"


class Points(NamedTuple):
    """Where instabilities arrive.

    Parameters
    ----------
    place : ndarray, shape (n, 2)
        ln k/k_ref of the rotational and of the shear spring; NaN where no springs give this instability.
    angle : ndarray, shape (n, 2)
        Arctangent of the compliances k_ref/k, whether springs or not.
    thrust, W : ndarray, shape (n,)
    """

    place: Array
    angle: Array
    thrust: Array
    W: Array


Middle = Callable[[Array, Array], Array]
System = Callable[[Array], "Pair | Triple"]
Locate = Callable[[Array], Points]


def normal(surface: Surface, at: Points) -> Array:
    """Gradient of D in ln k, shape (n, 2), across any of the curves."""
    d, a = surface(at.thrust, at.W), np.exp(-at.place.T)
    return -np.stack((a[0] * (d[0] * a[1] + d[2]), a[1] * (d[0] * a[0] + d[1])), axis=1)


def value(surface: Surface, at: Points, in_thrust: int = 0, in_W: int = 0) -> Array:
    """Derivative of D of some orders, shape (n,)."""
    d, a = surface(at.thrust, at.W, in_thrust, in_W), np.exp(-at.place.T)
    return np.asarray(d[0] * a[0] * a[1] + d[1] * a[1] + d[2] * a[0] + d[3], dtype=np.float64)


def curves(surface: Surface, target: float) -> list[Curve]:
    """All curves on which an instability arrives at the target, or first arrives at a thrust below it."""
    reach = np.log(REACH)
    waves = _between(surface.panels[-1].edges, WAVES)[1:]
    thrusts = _between(surface.ends, THRUSTS)[1:]

    def diverging(springs: Array) -> Points:
        thrust, still = np.full(len(springs), target), np.zeros(len(springs))
        d, a = surface(thrust, still), np.exp(-springs[:, 0])
        return _points(a, np.ones(len(a)), -(d[3] + d[2] * a), d[1] + d[0] * a, thrust, still)

    def fluttering(at: Array) -> Pair:
        thrust = np.full(len(at), target)
        return Pair(surface(thrust, at[:, 0]), surface(thrust, at[:, 0], in_W=1), at[:, 1], thrust, at[:, 0])

    def touching(at: Array) -> Pair:
        still = np.zeros(len(at))
        return Pair(surface(at[:, 0], still), surface(at[:, 0], still, in_thrust=1), at[:, 1], at[:, 0], still)

    springs = np.linspace(-reach, reach, 2 * THRUSTS)
    found: list[Curve] = []
    contours: list[tuple[Kind, Edge, System, Array, Array]] = [
        ("flutter", "crossing", fluttering, waves, springs),
        ("flutter", "jump", lambda at: Triple(surface, at), thrusts, waves[::2]),
    ]
    if _coupled(surface, thrusts):
        found += _traced("divergence", "crossing", springs[:, None], _mean, diverging)
        contours.append(("divergence", "jump", touching, thrusts, springs))
    else:
        for spring in (0, 1):
            for edge, thrust in _straight(surface, thrusts, spring):
                found += _traced("divergence", edge, springs[:, None], _mean, _at_any_other(surface, thrust, spring))
    for kind, edge, system, across, up in contours:
        contour = Contour(_left(system))
        for line in contour.lines(across, up):
            found += _traced(kind, edge, line, contour.middle, _located(system))
    return found


def _left(system: System) -> Callable[[Array], Array]:
    return lambda at: system(at).left


def _located(system: System) -> Locate:
    return lambda at: system(at).points()


def _coupled(surface: Surface, thrusts: Array) -> bool:
    """Whether each spring matters to divergence by the other one: not where the joint slides along a fixed direction.

    D(P, 0) is then a product of factors with one spring each.
    """
    d = surface(thrusts, np.zeros(len(thrusts)))
    return bool(np.any(np.abs(d[0] * d[3] - d[1] * d[2]) > NOTHING * np.max(np.abs(d), axis=0) ** 2))


def _straight(surface: Surface, thrusts: Array, spring: int) -> list[tuple[Edge, float]]:
    """The target, and thrusts below it at which the compliance -d3/d of divergence, by itself, is extreme."""
    own = SINGLE[spring]

    def change(thrust: Array) -> Array:
        d, slope = (surface(thrust, np.zeros(len(thrust)), order) for order in (0, 1))
        return np.asarray(d[3] * slope[own] - d[own] * slope[3], dtype=np.float64)

    d = surface(thrusts, np.zeros(len(thrusts)))
    if np.all(np.abs(d[own]) <= NOTHING * np.abs(d).max(axis=0)):
        return []
    signs = np.sign(change(thrusts))
    ends = [(thrusts[n], thrusts[n + 1]) for n in np.flatnonzero(signs[1:] != signs[:-1])]
    extremes = [float(brentq(lambda P: change(np.array([P]))[0], *pair)) for pair in ends]
    return [("crossing", float(thrusts[-1])), *(("jump", extreme) for extreme in extremes)]


def _at_any_other(surface: Surface, thrust: float, spring: int) -> Locate:
    def points(others: Array) -> Points:
        d = surface(np.full(len(others), thrust), np.zeros(len(others)))
        one, other = np.ones(len(others)), np.exp(-others[:, 0])
        if spring == 0:
            return _points(-d[3], d[2], other, one, thrust * one, 0 * one)
        return _points(other, one, -d[3], d[1], thrust * one, 0 * one)

    return points


def _between(edges: Array, count: int) -> Array:
    inside = edges[:-1, None] + np.diff(edges)[:, None] * np.arange(count) / count
    return np.append(inside.ravel(), edges[-1])


def _mean(here: Array, there: Array) -> Array:
    return (here + there) / 2


def _points(rotational: Array, one: Array, shear: Array, other: Array, thrust: Array, W: Array) -> Points:
    """From compliances as fractions to places, as far as the springs reach."""
    fractions = np.stack((rotational, shear), axis=1), np.stack((one, other), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = -np.log(fractions[0] / fractions[1])
        angle = np.arctan(fractions[0] / fractions[1])
    place[~np.all(np.abs(place) <= np.log(REACH) * (1 + 1e-12), axis=1)] = np.nan
    return Points(place, angle, thrust, W)


class Pair:
    """Two bilinear equations for a given a_r: what is left of the second once the first has given a_s."""

    def __init__(self, D: Array, other: Array, springs: Array, thrust: Array, W: Array) -> None:
        self.a, self.thrust, self.W = np.exp(-springs), thrust, W
        self.upper, self.lower = D[3] + D[2] * self.a, D[1] + D[0] * self.a
        self.left = self.upper * (other[1] + other[0] * self.a) - self.lower * (other[3] + other[2] * self.a)

    def points(self) -> Points:
        return _points(self.a, np.ones(len(self.a)), -self.upper, self.lower, self.thrust, self.W)


class Triple:
    """D = D_W = D_P = 0 by the minors v."""

    def __init__(self, surface: Surface, at: Array) -> None:
        self.thrust, self.W = at.T
        rows = np.stack([surface(self.thrust, self.W, *orders) for orders in ((0, 0), (0, 1), (1, 0))])
        rows = np.moveaxis(rows / np.abs(rows).max(axis=1, keepdims=True), 2, 0)
        self.v = np.array([(-1) ** i * np.linalg.det(np.delete(rows, i, axis=2)) for i in range(4)])
        self.left = self.v[0] * self.v[3] - self.v[1] * self.v[2]

    def points(self) -> Points:
        v = self.v
        return _points(v[2], v[3], v[1], v[3], self.thrust, self.W)


def _traced(kind: Kind, edge: Edge, parameters: Array, middle: Middle, points: Locate) -> list[Curve]:
    """Curves through the points that exist, with neighbours no farther apart than STEP and ends found by halving."""
    at = points(parameters)
    for turn in range(ROUNDS):
        wanted = np.flatnonzero(_open(at, turn))
        if not len(wanted) or len(parameters) > MOST:
            break
        between = middle(parameters[wanted], parameters[wanted + 1])
        parameters = np.insert(parameters, wanted + 1, between, axis=0)
        new = points(between)
        at = Points(*(np.insert(old, wanted + 1, more, axis=0) for old, more in zip(at, new, strict=True)))
    there = ~np.isnan(at.place[:, 0])
    apart = np.max(np.abs(np.diff(at.place, axis=0)), axis=1) > 2 * STEP
    breaks = np.flatnonzero(~there[1:] | ~there[:-1] | apart) + 1
    runs = [run for run in np.split(np.arange(len(there)), breaks) if there[run[0]] and len(run) > 1]
    return [Curve(kind, edge, parameters[run], middle, points, Points(*(part[run] for part in at))) for run in runs]


def _open(at: Points, turn: int) -> NDArray[np.bool_]:
    """Where two neighbours need a point between them: far apart, at an end, or perhaps passing springs unseen."""
    there = ~np.isnan(at.place[:, 0])
    apart = np.max(np.abs(np.diff(at.place, axis=0)), axis=1)
    turned = np.diff(at.angle, axis=0)
    quick = np.max(np.abs(turned - np.pi * np.round(turned / np.pi)), axis=1) > TURN
    neither = ~there[1:] & ~there[:-1] & quick & (turn < LOOKS)
    return (there[1:] & there[:-1] & (apart > STEP)) | (there[1:] != there[:-1]) | neither
