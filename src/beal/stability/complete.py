"""Every critical thrust of a reduced pencil at once, without a step in thrust that could pass one over.

With A = M^-1 K(P), the operator X -> A^2 X - 2 A X A^T + X (A^T)^2 maps antisymmetric matrices to antisymmetric ones
and has the eigenvalues (W_i - W_j)^2, i < j. It is singular exactly where two roots coincide. Applied in two steps and
freed of the inverses of M,

    M X K^T - K X M = M Y M        X antisymmetric
    M Y K^T - K Y M = 0            Y symmetric

is linear in K and so in the thrust: all such thrusts are the eigenvalues of one matrix, a form of the two-parameter
problem of Jarlebring, Kvaal & Michiels (2011). Coordinates without mass are allowed; their pairs with each other, which
meet no equation, are left out. Divergence is the linear problem det(K0 + P K1) = 0.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from beal.stability.double_root import coalescence, divergence
from beal.stability.pairs import Pairs, matrix, pairs
from beal.stability.pencil import Array, Pencil
from beal.stability.ridge import Kind, meeting_pair
from beal.stability.zero_roots import SAME, ZERO, nearly_real, rigid_body_root, zero_roots

REFERENCE = 0.37  # share of the limit about which the thrusts are expanded: none that a vehicle would prefer
MASSLESS = 1e-10  # share of the largest inertia below which a coordinate only follows the others
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
    inertia = pencil.shift * np.diag(pencil.M)
    heavy = inertia > MASSLESS * inertia.max()
    M, size = np.diag(np.where(heavy, inertia, 0.0)), np.maximum(inertia, inertia[heavy].min())
    of_X, of_Y = pairs(heavy, diagonal=False), pairs(heavy, diagonal=True)

    def operator(K: Array, M_Y_M: Array) -> Array:
        """Both lines on both unknowns; the thrust changes K alone."""
        fed = np.zeros((len(of_X[0]),) * 2)
        return np.block(
            [
                [matrix(of_Y, of_X, -1, (M, K), (-K, M)), -M_Y_M],
                [fed, matrix(of_X, of_Y, 1, (M, K), (-K, M))],
            ]
        )

    def scales(entries: Pairs) -> tuple[Array, Array]:
        """Of the entries of u_i u_j^T for M-normalised modes, and of W_i - W_j, as the coordinates have them."""
        a, b = (size[index] for index in entries)
        return 1 / np.sqrt(a * b), 1 / a + 1 / b

    (X, X_apart), (Y, Y_apart) = scales(of_X), scales(of_Y)
    scale = np.outer(np.concatenate((Y / Y_apart, X / X_apart**2)), np.concatenate((X, Y * Y_apart)))
    masses = np.diag(M)[of_Y[0]] * np.diag(M)[of_Y[1]]
    at = scale * operator(pencil.stiffness(REFERENCE * limit), np.diag(masses))
    change = scale * operator(limit * pencil.K1, np.zeros((len(masses),) * 2))
    return inverse_roots(at, change, limit)


def inverse_roots(at: Array, change: Array, limit: float) -> Array:
    """Real parts of all nearly real thrusts P in (0, limit] with ``at + (P/limit - REFERENCE) change`` singular."""
    inverse = np.linalg.eigvals(np.linalg.solve(at, -change)).astype(complex)
    return nearly_real(REFERENCE + 1 / inverse[np.abs(inverse) > SAME], limit)


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
