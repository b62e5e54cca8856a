"""Every critical thrust of a reduced pencil at once, without a step in thrust that could pass one over.

With A(P) = A0 + P A1 similar to M^-1 K(P), the operator X -> A^2 X - 2 A X A^T + X (A^T)^2 maps antisymmetric
matrices to antisymmetric ones and has the eigenvalues (W_i - W_j)^2, i < j. It is singular exactly where two roots
coincide, and quadratic in P: all such thrusts are the eigenvalues of one quadratic eigenvalue problem, a form of the
two-parameter problem of Jarlebring, Kvaal & Michiels (2011). Divergence is the linear problem det(K0 + P K1) = 0.
"""

from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np
import scipy.linalg

from beal.stability.double_root import coalescence, divergence
from beal.stability.pencil import Array, Pencil
from beal.stability.ridge import Kind, meeting_pair
from beal.stability.zero_roots import ZERO, rigid_body_root

NEARLY_REAL = 3e-2  # relative imaginary part of a thrust up to which a real critical point is looked for beside it
SAME = 1e-9
NEXT = 3e-2  # relative distance up to which a polished thrust is that of its guess
ALL_BUT_ZERO = 1e-3  # |W| of two roots that meet, below this share of the shift, beside a zero root


@dataclass(frozen=True)
class Event:
    """A thrust at which the stability of the vehicle changes, or another mode becomes unstable.

    Parameters
    ----------
    thrust : float
        In N.
    W : float
        omega^2 there, in rad^2/s^2.
    kind : {"flutter", "divergence"}
    modes : tuple of int
        Elastic modes that meet, counted from 1 in order of frequency at this thrust (0: a rigid-body root).
    unstable : int
        Number of roots s with a positive real part just above the thrust, two in flutter and one in divergence; 0
        means that the vehicle is stable again.
    before : int
        The same just below.
    """

    thrust: float
    W: float
    kind: Kind
    modes: tuple[int, int]
    unstable: int
    before: int

    @property
    def change(self) -> Literal["destabilises", "restabilises"]:
        """Whether the number of unstable roots grows or falls with thrust."""
        return "destabilises" if self.unstable > self.before else "restabilises"


def events(pencil: Pencil, limit: float, watched: int) -> list[Event]:
    """All critical thrusts of a reduced pencil from 0 to a limit, in order.

    Parameters
    ----------
    pencil : Pencil
        Reduced, with diagonal M; the cost grows with the sixth power of its size.
    limit : float
    watched : int
        Number of elastic modes whose meetings count; the higher ones of a reduced pencil are not converged.

    Returns
    -------
    list of Event
    """
    neutral = rigid_body_root(pencil, limit) == "neutral"
    candidates = [(P, "flutter") for P in _double_roots(pencil, limit)]
    if not neutral:
        candidates += [(P, "divergence") for P in zero_roots(pencil, limit)]
    found: list[tuple[float, float, Kind]] = []
    for thrust, kind in candidates:
        for point in _polished(pencil, thrust, kind, watched, neutral):
            fresh = all(abs(point[0] - other[0]) > SAME * limit or point[2] != other[2] for other in found)
            if fresh and 0 < point[0] <= limit:
                found.append(point)
    found.sort()
    between = np.array([0.0, *(point[0] for point in found), limit])
    midway = (between[1:] + between[:-1]) / 2
    counts = [_unstable(pencil, P, watched, neutral) for P in midway]
    result = []
    for n, (thrust, W, kind) in enumerate(found):
        if counts[n] != counts[n + 1]:  # else two roots cross without coupling
            if kind == "divergence":
                below = min(_negative(pencil, P) for P in midway[n : n + 2])
                modes = (below + 1 - (0 if neutral else pencil.rigid),) * 2
            else:
                modes = meeting_pair(pencil, thrust * (1 - 1e-6), W)
            result.append(Event(thrust, W, kind, modes, counts[n + 1], counts[n]))
    return result


def _double_roots(pencil: Pencil, limit: float) -> Array:
    """Real parts of all nearly real thrusts in (0, limit] at which two roots coincide."""
    root = np.sqrt(np.diag(pencil.M))
    A0, A1 = pencil.stiffness(0.0) / np.outer(root, root), limit * pencil.K1 / np.outer(root, root)
    n = len(root)
    pairs = np.array(list(combinations(range(n), 2)))
    i, j = pairs.T
    size = np.sqrt(
        np.abs(np.diag(A0)[i]) + np.abs(np.diag(A0)[j]) + pencil.shift
    )  # grades the problem like the low roots
    select = np.zeros((n * n, len(pairs)))
    select[i * n + j, np.arange(len(pairs))] = 1 / size
    select[j * n + i, np.arange(len(pairs))] = -1 / size
    unit = np.eye(n)

    def operator(left: Array, right: Array) -> Array:
        """Half of the symmetric bilinear form behind the square of X -> left X - X right^T."""
        square = left @ right + right @ left
        return 0.5 * (np.kron(square, unit) + np.kron(unit, square)) - np.kron(left, right) - np.kron(right, left)

    Q = [select.T @ matrix @ select / 2 for matrix in (operator(A0, A0), 2 * operator(A0, A1), operator(A1, A1))]
    return nearly_real(_quadratic_eigenvalues(*Q), limit)


def _quadratic_eigenvalues(Q0: Array, Q1: Array, Q2: Array) -> Array:
    """All finite p with det(Q0 + p Q1 + p^2 Q2) = 0, through the companion form for 1/p."""
    n = len(Q0)
    zero, unit = np.zeros((n, n)), np.eye(n)
    left = np.block([[-Q1, -Q2], [unit, zero]])
    right = np.block([[Q0, zero], [zero, unit]])
    alpha, beta = scipy.linalg.eigvals(left, right, homogeneous_eigvals=True)
    return np.asarray(beta[np.abs(alpha) > 1e-12 * np.abs(beta)] / alpha[np.abs(alpha) > 1e-12 * np.abs(beta)])


def zero_roots(pencil: Pencil, limit: float) -> Array:
    """All nearly real thrusts in (0, limit] at which K(P) is singular."""
    alpha, beta = scipy.linalg.eigvals(-limit * pencil.K1, pencil.stiffness(0.0), homogeneous_eigvals=True)
    finite = np.abs(alpha) > 1e-12 * np.abs(beta)
    return nearly_real(beta[finite] / alpha[finite], limit)


def nearly_real(shares: Array, limit: float) -> Array:
    near = np.abs(shares.imag) <= NEARLY_REAL * np.abs(shares)
    inside = (shares.real > SAME) & (shares.real <= 1 + NEARLY_REAL)
    return np.sort(shares[near & inside].real) * limit


def _polished(pencil: Pencil, thrust: float, kind: str, watched: int, neutral: bool) -> list[tuple[float, float, Kind]]:
    """Critical points next to an approximate thrust: (thrust, W, kind)."""
    points: list[tuple[float, float, Kind]] = []
    if kind == "divergence" or neutral:  # a root that meets the zero one of a rigid-body motion diverges
        point = divergence(pencil, thrust, neutral)
        if point.converged and abs(point.thrust - thrust) < NEXT * thrust:
            points.append((point.thrust, 0.0, "divergence"))
    if kind == "divergence":
        return points
    low = pencil.roots(thrust)[: watched + pencil.rigid + 1]
    closest = np.argsort(np.abs(np.diff(low)) / (np.abs(low[1:]) + np.abs(low[:-1]) + pencil.shift))[:2]
    for i in closest:
        point = coalescence(pencil, thrust, float((low[i] + low[i + 1]).real / 2))
        drifts = neutral and abs(point.W) < ALL_BUT_ZERO * pencil.shift
        if point.converged and not drifts and abs(point.thrust - thrust) < NEXT * thrust:
            points.append((point.thrust, point.W, "flutter"))
    return points


def _negative(pencil: Pencil, thrust: float) -> int:
    """Number of roots below zero."""
    return int(np.sum(pencil.roots(thrust).real < -ZERO * pencil.shift))


def _unstable(pencil: Pencil, thrust: float, watched: int, neutral: bool) -> int:
    """Number of exponents s = sqrt(-W) in the right half plane: two of a complex pair W, one of a negative W."""
    low = pencil.roots(thrust)[: watched + pencil.rigid]
    if neutral:
        low = np.delete(low, np.abs(low).argmin())
    split = np.abs(low.imag) > 1e-6 * np.abs(low)
    return int(np.sum(split)) + int(np.sum(~split & (low.real < -ZERO * pencil.shift)))
