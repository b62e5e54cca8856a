"""Where a small change of a vehicle would newly bring about an instability, below its critical thrust.

Two modes that come close and part again meet once a quantity has moved far enough: the square of the difference of
their roots is smooth in all quantities, through zero where they meet and on, where it is negative. So is the lowest
root where it nearly vanishes. To first order that is known from the derivatives of the roots.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from beal.stability.pencil import ComplexArray, Pencil, reduced
from beal.stability.ridge import Kind

Array = NDArray[np.float64]

STEPS = 160  # of thrust
LOWEST = 6  # modes looked at
SHORT = 1e-3  # share of the thrust before the critical one at which the sweep stops


@dataclass(frozen=True)
class Touch:
    """An instability that is not there, but would be below the critical thrust after a small change.

    Parameters
    ----------
    thrust : float
        In N, at which it would begin.
    kind : {"flutter", "divergence"}
    modes : tuple of int
        Those that come close, counted from 1; the one whose frequency nearly vanishes twice.
    changes : tuple of float
        Relative change of each parameter alone, in their order, at which it begins: to first order, and nan for those
        of value 0 or infinity.
    """

    thrust: float
    kind: Kind
    modes: tuple[int, int]
    changes: tuple[float, ...]

    @property
    def nearest(self) -> float:
        """The smallest change in size; nan where none is known."""
        known = [change for change in self.changes if change == change]
        return min(known, key=abs, default=float("nan"))


@dataclass(frozen=True)
class Dip:
    """A least value of a gap: (W2 - W1)^2 of neighbouring roots, or the lowest W.

    Parameters
    ----------
    thrust : float
        In N.
    modes : tuple of int
    gap : float
    roots : tuple of float
        The W between which the gap is.
    """

    thrust: float
    modes: tuple[int, int]
    gap: float
    roots: tuple[float, ...]

    @property
    def kind(self) -> Kind:
        """Of the instability that begins where the gap closes."""
        return "divergence" if len(self.roots) == 1 else "flutter"

    def slope(self, full: Pencil, change: Pencil) -> float:
        """Derivative of the gap with respect to a quantity, given those of the matrices."""
        slopes = [_root_slope(full, self.thrust, W, change) for W in self.roots]
        if len(slopes) == 1:
            return slopes[0]
        return 2 * (self.roots[1] - self.roots[0]) * (slopes[1] - slopes[0])


def dips(full: Pencil, to: float) -> Iterator[Dip]:
    """All dips up to a thrust, looked for in the reduced problem and followed to the bottom in all coordinates.

    None of damped vehicles, and of those whose rigid-body motions act.
    """
    if full.C is not None or full.rigid:
        return
    small = reduced(full)
    thrusts = np.linspace(0.0, to * (1 - SHORT), STEPS + 1)
    table = np.array([_gaps(small.roots(float(thrust))[:LOWEST]) for thrust in thrusts])
    inside = (table[1:-1] < table[:-2]) & (table[1:-1] < table[2:]) & (table[1:-1] > 0)
    for n, mode in np.argwhere(inside).tolist():
        ends = (float(thrusts[n]), float(thrusts[n + 2]))
        least = minimize_scalar(partial(_gap, full, mode), bounds=ends, method="bounded", options={"xatol": 1e-9 * to})
        roots = full.lowest(float(least.x), LOWEST).real[max(mode - 1, 0) : mode + 1]
        yield Dip(float(least.x), (mode or 1, mode + 1), float(least.fun), tuple(roots.tolist()))


def touch(full: Pencil, dip: Dip, values: Sequence[float], changes: Sequence[Pencil | None]) -> Touch:
    """What it takes to close a gap, given the values of quantities and how the matrices change with each."""
    found = []
    for value, change in zip(values, changes, strict=True):
        slope = value * dip.slope(full, change) if change is not None and value else 0.0
        found.append(-dip.gap / slope if slope else float("nan"))
    return Touch(dip.thrust, dip.kind, dip.modes, tuple(found))


def _gaps(roots: ComplexArray) -> Array:
    """The lowest root, and the squares of the differences of neighbouring ones."""
    return np.concatenate((roots[:1].real, (np.diff(roots) ** 2).real))


def _gap(full: Pencil, mode: int, thrust: float) -> float:
    return float(_gaps(full.lowest(thrust, LOWEST))[mode])


def _root_slope(full: Pencil, thrust: float, W: float, change: Pencil) -> float:
    """W' = y^T (K' - W M') x / y^T M x."""
    u, _, vh = scipy.linalg.svd(full.stiffness(thrust) - W * full.M)
    y, x = u[:, -1], vh[-1]
    return float(y @ (change.stiffness(thrust) - W * change.M) @ x / (y @ full.M @ x))
