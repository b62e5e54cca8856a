"""The first instability of an undamped pencil, found along the ridges of its characteristic function.

While the vehicle is stable, D(P, .) = det(K(P) - W M) has real roots only, and one extremum between neighbours.
(-1)^i D at that extremum, the height E_i(P) of the ridge between roots i and i + 1, is a smooth function of the
thrust whose first simple zero is the coalescence of the two; where they cross without coupling it touches zero and
stays positive. D(P, 0) plays the same part for divergence. A tongue of flutter that is too narrow for any sweep of
eigenvalues is a shallow dip of a smooth curve: cubic Hermite interpolation between coarse thrusts shows it, and
intervals in which it dips are looked at again.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from beal.errors import ConvergenceError
from beal.stability.double_root import CriticalPoint, coalescence, divergence
from beal.stability.kernels.rules import BORDER, DIP, FLAT
from beal.stability.pencil import Array, ComplexArray, Pencil
from beal.stability.zero_roots import ZERO, rigid_body_root, zero_roots

Kind = Literal["flutter", "divergence"]

REAL = 1e-4  # relative imaginary part up to which rounding may split a pair of real roots that nearly meet
SOFT = 4.0 ** np.arange(-6, 0)  # shares of the first coarse interval, for joints much softer than the stages
NARROW = 1e-7  # share of the thrust searched below which an interval is not divided further
BLIND = (1e-5, 1e-3)  # shares of a critical thrust within which rounding may hide a root that is all but zero


@dataclass(frozen=True)
class Instability:
    """The first critical point.

    Parameters
    ----------
    point : CriticalPoint
    kind : {"flutter", "divergence"}
    modes : tuple of int
        The elastic modes that meet, counted from 1; 0 stands for a rigid-body root.
    border : bool
        Whether another instability comes at practically the same thrust.
    """

    point: CriticalPoint
    kind: Kind
    modes: tuple[int, int]
    border: bool = False


@dataclass(frozen=True)
class State:
    """What is known of the pencil at one thrust.

    Parameters
    ----------
    thrust : float
    roots : ndarray, shape (n,)
        W in order of the real parts.
    real : bool
        Whether the watched roots are real to rounding; only then the ridges are known.
    stable : bool
    ridges, heights, slopes : ndarray, shape (ridges,)
        W of each ridge, the height there and its derivative with respect to thrust. First W = 0 for divergence.
    """

    thrust: float
    roots: ComplexArray
    real: bool
    stable: bool
    ridges: Array
    heights: Array
    slopes: Array


class Search:
    """Looks for the first instability of a reduced pencil up to a thrust.

    Parameters
    ----------
    pencil : Pencil
        Reduced: few coordinates, diagonal M.
    limit : float
        The thrust to search to.
    steps : int
        Coarse intervals of thrust to begin with.
    watched : int
        Number of elastic modes between which coalescence is looked for.
    """

    def __init__(self, pencil: Pencil, limit: float, steps: int, watched: int) -> None:
        self.pencil, self.limit, self.steps = pencil, limit, steps
        self._drift = rigid_body_root(pencil, limit)
        self._lowest = int(self._drift == "tumbling")  # the root that must not turn negative
        self._pairs = min(watched + pencil.rigid, len(pencil.M)) - 1
        self._sign = (-1.0) ** np.arange(self._pairs + 1)
        self._scale = np.ones(self._pairs + 1)
        self._scale = self._scales(limit, steps)

    def _scales(self, limit: float, steps: int) -> Array:
        """Heights of the ridges at the start, or a little later for those between zero roots, which have none there."""
        start = self.state(0.0)
        low = np.append(0.0, start.roots[: self._pairs + 1].real)
        apart = np.diff(low) > REAL * (np.abs(low[1:]) + ZERO * self.pencil.shift)
        scale = np.abs(start.heights) if start.real else np.zeros(self._pairs + 1)
        for thrust in (1e-3 * limit, limit / steps):
            height = np.abs(self.state(thrust).heights)
            if len(height):
                scale = np.where((~apart | (scale == 0)) & (scale <= FLAT * height), height, scale)
        return np.where(scale > 0, scale, 1.0)  # 0 between roots that stay zero

    def state(self, thrust: float) -> State:
        """Roots and ridges at one thrust."""
        roots = self.pencil.roots(thrust)
        low = roots[: self._pairs + 1]
        nothing = np.empty(0)
        if np.any(np.abs(low.imag) > REAL * np.abs(low.real) + ZERO * self.pencil.shift):
            return State(thrust, roots, False, False, nothing, nothing, nothing)
        ridges = np.append(0.0, _ridges(roots, self._pairs))
        delta = 1e-6 * self.limit
        before, here, after = (self._sign * self._determinants(thrust + d, ridges) for d in (-delta, 0.0, delta))
        heights, slopes = here / self._scale, (after - before) / (2 * delta * self._scale)
        if self._drift:  # D(P, 0) carries the rigid-body root and says nothing of the elastic ones
            heights[0], slopes[0] = 1.0, 0.0
        driven = np.delete(roots, np.abs(roots).argmin()) if self._drift == "neutral" else roots[self._lowest :]
        diverged = driven[0].real < -ZERO * self.pencil.shift
        stable = bool(np.all(heights > -FLAT)) and not diverged
        return State(thrust, roots, True, stable, ridges, heights, slopes)

    def _determinants(self, thrust: float, W: Array) -> Array:
        return np.asarray(np.linalg.det(self.pencil.stiffness(thrust) - W[:, None, None] * self.pencil.M))

    def first(self) -> Instability | None:
        """The first instability, or None up to the limit.

        Raises
        ------
        ConvergenceError
            If an unstable interval was bracketed but its critical point could not be resolved.
        """
        left = self.state(0.0)
        even = np.linspace(0.0, self.limit, self.steps + 1)[1:]
        for thrust in np.sort(np.concatenate((even[0] * SOFT, even, self._between_divergences()))):
            right = self.state(float(thrust))
            if found := self._within(left, right):
                return found
            left = right
        return None

    def _between_divergences(self) -> Array:
        """Thrusts between neighbouring ones at which a root is zero, which all are known: no interval is too narrow."""
        thrusts = np.array([]) if self._drift else zero_roots(self.pencil, self.limit)
        between = (thrusts[1:] + thrusts[:-1]) / 2
        return np.asarray(between[between < self.limit])

    def _within(self, left: State, right: State) -> Instability | None:
        """The first instability between a stable state and another one."""
        narrow = right.thrust - left.thrust < NARROW * self.limit
        if right.stable:
            dip = None if narrow else _dip(left, right)
            if dip is None:
                return None
            return self._halves(left, self.state(dip), right)
        for guess in self._guesses(left, right):
            if found := self._confirmed(left, right, *guess):
                return found
        if narrow:
            raise ConvergenceError(
                f"an instability between thrusts {left.thrust:.9g} and {right.thrust:.9g} could not be resolved; "
                "use the complete search"
            )
        return self._halves(left, self.state((left.thrust + right.thrust) / 2), right)

    def _halves(self, left: State, middle: State, right: State) -> Instability | None:
        return self._within(left, middle) or (self._within(middle, right) if middle.stable else None)

    def _guesses(self, left: State, right: State) -> Iterator[tuple[Kind, float, float]]:
        """(kind, thrust, W) of critical points that would explain an unstable state, the likeliest first."""
        span = right.thrust - left.thrust
        if right.real:
            below = [int(ridge) for ridge in np.flatnonzero(right.heights < -FLAT)]
            shares = [(_first_zero(left, right, ridge), ridge) for ridge in below]
            for share, ridge in sorted(shares):
                W = (1 - share) * left.ridges[ridge] + share * right.ridges[ridge]
                yield ("divergence" if ridge == 0 else "flutter"), left.thrust + share * span, W
            first, last = left.roots[int(self._drift != "")].real, right.roots[self._lowest].real
            if last < 0 and first > ZERO * self.pencil.shift:
                yield "divergence", left.thrust + span * first / (first - last), 0.0
            return
        split = np.flatnonzero(right.roots[:-1].imag != 0)
        for i in split[:1]:
            before, after = ((state.roots[i + 1] - state.roots[i]) ** 2 for state in (left, right))
            share = before.real / (before.real - after.real)
            if 0 < share < 1:
                means = [(state.roots[i + 1] + state.roots[i]).real / 2 for state in (left, right)]
                yield "flutter", left.thrust + share * span, (1 - share) * means[0] + share * means[1]

    def _confirmed(self, left: State, right: State, kind: Kind, thrust: float, W: float) -> Instability | None:
        """The instability next to a guess, if it lies in the interval and nothing comes before it."""
        neutral = kind == "divergence" and self._drift == "neutral"
        point = (
            divergence(self.pencil, thrust, neutral) if kind == "divergence" else coalescence(self.pencil, thrust, W)
        )
        inside = left.thrust < point.thrust <= right.thrust
        if not (point.converged and inside):
            return None
        if kind == "divergence" and not neutral:
            point = self._lowest_divergence(point)
        # A root that meets a zero one, or is all but zero, is lost in rounding closer by, and so is any next to a step.
        room = (point.thrust - left.thrust) / 2
        blind = [share * point.thrust for share in (BLIND if kind == "divergence" else BLIND[:1])]
        margins = [margin for each in blind for margin in (min(each, room), each)]
        before = next(filter(None, (self._turns(point, kind, margin) for margin in margins)), None)
        if before is None or (left.thrust < before.thrust and self._within(left, before)):
            return None
        lowest = self._lowest + 1 - (0 if self._drift == "neutral" else self.pencil.rigid)
        modes = (lowest, lowest) if kind == "divergence" else meeting_pair(self.pencil, before.thrust, point.W)
        return Instability(point, kind, modes, _on_border(before, point))

    def _turns(self, point: CriticalPoint, kind: Kind, margin: float) -> State | None:
        """The state before a critical point, if it is stable and that behind it is not."""
        before, after = self.state(point.thrust - margin), self.state(point.thrust + margin)
        negative = after.roots[self._lowest].real < 0  # else the tumbling root has come back to zero
        return before if before.stable and not after.stable and (negative or kind == "flutter") else None

    def _lowest_divergence(self, point: CriticalPoint) -> CriticalPoint:
        """The first of the divergences that all but tie with one: K(P) is linear in P, all its zeros are known."""
        thrusts = scipy.linalg.eigvals(self.pencil.stiffness(point.thrust), -self.pencil.K1) + point.thrust
        near = thrusts[np.abs(thrusts - point.thrust) < BLIND[-1] * point.thrust]
        first = divergence(self.pencil, float(near.real.min())) if len(near) > 1 else point
        return first if first.converged and 0 < first.thrust < point.thrust else point


def meeting_pair(pencil: Pencil, thrust: float, W: float) -> tuple[int, int]:
    """The neighbouring modes closest to W at a thrust, elastic ones counted from 1, a rigid-body root as 0."""
    roots = pencil.roots(thrust)
    first = int(np.argmin(np.abs(roots[1:] - W) + np.abs(roots[:-1] - W))) + 1 - pencil.rigid
    first += sum(held < W for held in pencil.held)
    return first, first + 1


def _on_border(before: State, point: CriticalPoint) -> bool:
    """Whether a ridge beside that of a critical point reaches zero at practically the same thrust."""
    heights = before.heights + (point.thrust - before.thrust) * before.slopes
    near = heights < BORDER * point.thrust * np.abs(before.slopes)
    near[np.argmin(np.abs(before.ridges - point.W))] = False
    return bool(near.any())


def _ridges(roots: ComplexArray, pairs: int) -> Array:
    """W of the extremum of D between neighbours of the lowest roots: sum over j of 1/(W_j - W) = 0, shape (pairs,).

    The two neighbours are taken exactly, the others as constant over one step.
    """
    low, high = roots[:pairs].real, roots[1 : pairs + 1].real
    middle, half = (low + high) / 2, (high - low) / 2
    others = np.ones((pairs, len(roots)), dtype=bool)
    index = np.arange(pairs)
    others[index, index] = others[index, index + 1] = False
    W = middle
    for _ in range(6):
        distance = np.where(others, roots - W[:, None], 1.0)
        near = np.abs(distance) < 1e-300
        rest = np.where(others & ~near, (1 / np.where(near, 1.0, distance)).real, 0.0).sum(axis=1)
        W = middle - rest * half**2 / (1 + np.sqrt(1 + (rest * half) ** 2))
    return W


def _cubic(left: State, right: State, ridge: int | slice) -> tuple[Array, Array, Array, Array]:
    """Coefficients in t = share of the interval of the cubic through heights and slopes, lowest power first."""
    span = right.thrust - left.thrust
    a, b = left.heights[ridge], right.heights[ridge]
    da, db = span * left.slopes[ridge], span * right.slopes[ridge]
    return a, da, 3 * (b - a) - 2 * da - db, 2 * (a - b) + da + db


def _first_zero(left: State, right: State, ridge: int) -> float:
    """Share of the interval at which a ridge first falls to zero."""
    coefficients = [float(c) for c in _cubic(left, right, ridge)]
    zeros = np.roots(coefficients[::-1])
    inside = [z.real for z in zeros if abs(z.imag) < 1e-9 and 0 < z.real <= 1]
    return min(inside, default=left.heights[ridge] / (left.heights[ridge] - right.heights[ridge]))


def _dip(left: State, right: State) -> float | None:
    """Thrust of the deepest dip of a ridge inside an interval that deserves another look, if any."""
    c0, c1, c2, c3 = _cubic(left, right, slice(None))
    t: NDArray[np.float64] = np.linspace(0.02, 0.98, 49)[:, None]
    depth = (c0 + t * (c1 + t * (c2 + t * c3))) / np.maximum(np.minimum(left.heights, right.heights), FLAT)
    row, ridge = np.unravel_index(np.argmin(depth), depth.shape)
    if depth[row, ridge] > DIP or min(left.heights[ridge], right.heights[ridge]) < FLAT:
        return None
    return float(left.thrust + t[row, 0] * (right.thrust - left.thrust))
