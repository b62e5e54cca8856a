"""How a critical point moves when the matrices change, from the equations that it solves (see `double_root`).

With x, psi the null vectors of K(P) - W M, bordered, and a prime for the derivative with respect to a quantity,

    g' = -psi^T (K' - W M') x        g_W' = psi^T M' x + psi'^T M x + psi^T M x'

    divergence   g_P P' = -g'
    flutter      g_P P' = -g',   g_WP P' + g_WW W' = -g_W'         g_W = psi^T M x = 0

The first line of flutter is the formula for a double root, P' = -psi^T (K' - W M') x / psi^T K1 x; its frequency needs
the second. Where a root crosses the imaginary axis, K - omega^2 M + i omega C is complex and g = 0 is two equations for
P and omega (Seyranian & Mailybaev 2003).
"""

from collections.abc import Callable
from functools import partial
from typing import Any, Literal

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from beal.stability.double_root import CriticalPoint
from beal.stability.imaginary_root import damping_of
from beal.stability.pencil import Array, Pencil

Follow = Callable[[Pencil], Array]
SEMISIMPLE = 1e-7  # ratio of the second smallest singular value to the next, below which there are two null vectors


def undamped(pencil: Pencil, point: CriticalPoint, kind: str, neutral: bool = False) -> Follow:
    """Derivatives of (thrust, omega) at a coalescence or a divergence, given those of the matrices."""
    P, W = point.thrust, point.W
    bordered = _Bordered(pencil.stiffness(P) - W * pencil.M)
    x, psi = bordered.right, bordered.left
    K1, M = pencil.K1, pencil.M
    x_W, psi_W = bordered.solved(M @ x), bordered.solved(M.T @ psi, 1)
    g_P, g_WW = -psi @ K1 @ x, 2 * psi @ M @ x_W
    g_WP = -psi_W @ K1 @ x - psi @ K1 @ x_W

    def follow(change: Pencil) -> Array:
        turned = change.stiffness(P) - W * change.M
        g = -psi @ turned @ x
        g_W = psi @ change.M @ x - psi_W @ turned @ x - psi @ turned @ x_W
        if kind == "divergence":
            return np.array([-g_W / g_WP if neutral else -g / g_P, 0.0])
        thrust = -g / g_P
        return np.array([thrust, -(g_W + g_WP * thrust) / g_WW / (2 * np.sqrt(W))])

    return follow


def damped(pencil: Pencil, point: CriticalPoint) -> Follow:
    """Derivatives of (thrust, omega) where a damped root is i omega, given those of the matrices."""
    P, omega, C = point.thrust, float(np.sqrt(point.W)), damping_of(pencil)
    bordered = _Bordered(pencil.stiffness(P) - omega**2 * pencil.M + 1j * omega * C)
    x, psi = bordered.right, bordered.left
    g_P = -psi @ pencil.K1 @ x
    g_omega = psi @ (2 * omega * pencil.M - 1j * C) @ x
    jacobian = np.array([[g_P.real, g_omega.real], [g_P.imag, g_omega.imag]])

    def follow(change: Pencil) -> Array:
        g = -psi @ (change.stiffness(P) - omega**2 * change.M + 1j * omega * damping_of(change)) @ x
        return np.linalg.solve(jacobian, [-g.real, -g.imag])

    return follow


def twins(pencil: Pencil, thrust: float) -> tuple[Follow, Follow] | None:
    """The two divergences of a zero root that is double with two vectors, the slower to grow first; None elsewhere.

    Within the two null vectors X, and left ones Y, they move with the eigenvalues of -(Y^T K1 X)^-1 Y^T K' X.
    """
    u, sizes, vh = np.linalg.svd(pencil.stiffness(thrust))
    if len(sizes) < 3 or sizes[-2] > SEMISIMPLE * sizes[-3]:
        return None
    left, right = u[:, -2:], vh[-2:].T
    here = left.T @ pencil.K1 @ right

    def follow(change: Pencil, which: int) -> Array:
        moved = np.linalg.eigvals(np.linalg.solve(here, -left.T @ change.stiffness(thrust) @ right))
        return np.array([np.sort(moved.real)[which], 0.0])

    return partial(follow, which=0), partial(follow, which=1)


class _Bordered:
    """A singular matrix between its null vectors, which make it regular."""

    def __init__(self, matrix: NDArray[Any]) -> None:
        u, _, vh = np.linalg.svd(matrix)
        rows = [[matrix, u[:, -1:]], [vh[-1:], np.zeros((1, 1))]]
        self._factor: Any = scipy.linalg.lu_factor(np.block(rows))
        unit = np.eye(len(matrix) + 1)[-1]
        self.right = scipy.linalg.lu_solve(self._factor, unit)[:-1]
        self.left = scipy.linalg.lu_solve(self._factor, unit, trans=1)[:-1]

    def solved(self, right: Array, transposed: Literal[0, 1] = 0) -> Array:
        """The solution with the matrix, or its transpose, across the null vectors."""
        return np.asarray(scipy.linalg.lu_solve(self._factor, np.append(right, 0.0), trans=transposed)[:-1])
