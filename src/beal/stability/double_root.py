"""Critical points as well-conditioned equations, solved by Newton's method with a bordered matrix.

With b, c fixed and

    [K(P) - W M   b] [x]   [0]
    [c^T          0] [g] = [1]

g(P, W) vanishes where the pencil is singular. A coalescence is g = g_W = 0, a divergence g(P, 0) = 0: simple roots of
smooth equations, good to the precision of the matrices, where the eigenvalues themselves are good to its square root
only (Griewank & Reddien 1984).
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from beal.stability.pencil import Array, Pencil

STEPS = 30
FAR = 100.0  # times the guess: Newton's method has lost its way
EPS = float(np.finfo(float).eps)
ROUNDING = 60 * float(np.finfo(float).eps)  # covers 99 % of what changes with the order of the sums


@dataclass(frozen=True)
class CriticalPoint:
    """A thrust and a W = omega^2 at which the pencil is critical.

    Parameters
    ----------
    thrust, W : float
    converged : bool
    uncertainty : float
        What rounding of the matrices may change in the thrust, to first order.
    right, left : ndarray, shape (n,)
        The eigenvectors.
    """

    thrust: float
    W: float
    converged: bool
    uncertainty: float
    right: Array
    left: Array


@dataclass(frozen=True)
class _Bordered:
    """g and its derivatives at one (P, W)."""

    g: float
    g_P: float
    g_W: float
    g_WW: float
    g_WP: float
    right: Array
    left: Array
    right_W: Array


def _bordered(pencil: Pencil, thrust: float, W: float, b: Array, c: Array) -> _Bordered:
    n = len(b)
    matrix = np.zeros((n + 1, n + 1))
    matrix[:n, :n] = pencil.stiffness(thrust) - W * pencil.M
    matrix[:n, n], matrix[n, :n] = b, c
    factor = scipy.linalg.lu_factor(matrix, check_finite=False)
    unit = np.eye(n + 1)[n]
    x = scipy.linalg.lu_solve(factor, unit)
    psi = scipy.linalg.lu_solve(factor, unit, trans=1)[:n]
    g, x = float(x[n]), x[:n]
    Mx, K1x = pencil.M @ x, pencil.K1 @ x
    x_W = scipy.linalg.lu_solve(factor, np.append(Mx, 0.0))[:n]
    x_P = -scipy.linalg.lu_solve(factor, np.append(K1x, 0.0))[:n]
    return _Bordered(
        g,
        g_P=-float(psi @ K1x),
        g_W=float(psi @ Mx),
        g_WW=2 * float(psi @ (pencil.M @ x_W)),
        g_WP=float(psi @ (pencil.M @ x_P) - psi @ (pencil.K1 @ x_W)),
        right=x,
        left=psi,
        right_W=x_W,
    )


def _borders(pencil: Pencil, thrust: float, W: float) -> tuple[Array, Array]:
    """Borders near the null vectors, which keep the bordered matrix regular."""
    u, _, vt = np.linalg.svd(pencil.stiffness(thrust) - W * pencil.M)
    return u[:, -1], vt[-1]


def coalescence(pencil: Pencil, thrust: float, W: float) -> CriticalPoint:
    """The double root W of K(P) x = W M x nearest to a guess.

    Parameters
    ----------
    pencil : Pencil
    thrust, W : float
        The guess.

    Returns
    -------
    CriticalPoint
        With ``converged`` false where Newton's method did not settle.
    """
    b, c = _borders(pencil, thrust, W)
    here = _bordered(pencil, thrust, W, b, c)
    far = FAR * abs(thrust), FAR * (abs(W) + pencil.shift)
    converged = False
    for _ in range(STEPS):
        determinant = here.g_P * here.g_WW - here.g_W * here.g_WP
        if determinant == 0.0 or not np.isfinite(determinant):
            break
        step_P = (here.g * here.g_WW - here.g_W**2) / determinant
        step_W = (here.g_P * here.g_W - here.g_WP * here.g) / determinant
        thrust, W = thrust - step_P, W - step_W
        if not (abs(thrust) < far[0] and abs(W) < far[1]):
            converged = False
            break
        here = _bordered(pencil, thrust, W, b, c)
        if converged:  # one step past the tolerance, since convergence is quadratic
            break
        converged = abs(step_P) < 1e-9 * abs(thrust) and abs(step_W) < 1e-7 * abs(W)
    return _point(pencil, thrust, W, converged, here, here.right, here.g_P)


def divergence(pencil: Pencil, thrust: float, neutral: bool = False) -> CriticalPoint:
    """The thrust nearest to a guess at which a root W passes through zero.

    Parameters
    ----------
    pencil : Pencil
    thrust : float
        The guess.
    neutral : bool
        Whether a rigid-body motion keeps W = 0 a root at every thrust; the condition is then g_W(P, 0) = 0.

    Returns
    -------
    CriticalPoint
    """
    b, c = _borders(pencil, thrust, 0.0)
    here = _bordered(pencil, thrust, 0.0, b, c)
    far = FAR * abs(thrust)
    converged = False
    for _ in range(STEPS):
        value, slope = (here.g_W, here.g_WP) if neutral else (here.g, here.g_P)
        if slope == 0.0 or not np.isfinite(slope):
            break
        step = value / slope
        thrust -= step
        if not abs(thrust) < far:
            converged = False
            break
        here = _bordered(pencil, thrust, 0.0, b, c)
        if converged:
            break
        converged = abs(step) < 1e-9 * abs(thrust)
    change, slope = (here.right_W, here.g_WP) if neutral else (here.right, here.g_P)
    return _point(pencil, thrust, 0.0, converged, here, change, slope)


def chained(pencil: Pencil, point: CriticalPoint, feeds: Array) -> tuple[Array, Array]:
    """Second vectors, (K - W M) x' = F x and its transpose, right and left, shape (n,); F = M at a double root."""
    n = len(point.right)
    matrix = np.zeros((n + 1, n + 1))
    matrix[:n, :n] = pencil.stiffness(point.thrust) - point.W * pencil.M
    matrix[:n, n] = point.left / np.linalg.norm(point.left)
    matrix[n, :n] = point.right / np.linalg.norm(point.right)
    factor = scipy.linalg.lu_factor(matrix)
    right = scipy.linalg.lu_solve(factor, np.append(feeds @ point.right, 0.0))
    left = scipy.linalg.lu_solve(factor, np.append(feeds @ point.left, 0.0), trans=1)
    return right[:n], left[:n]


def _point(
    pencil: Pencil, thrust: float, W: float, converged: bool, at: _Bordered, change: Array, slope: float
) -> CriticalPoint:
    magnitude = _terms(pencil.stiffness(0.0)) + abs(thrust) * _terms(pencil.K1) + abs(W) * _terms(pencil.M)
    rounding = ROUNDING * float(np.abs(at.left) @ magnitude @ np.abs(change))
    uncertainty = rounding / abs(slope) + 4 * EPS * abs(thrust) if slope else np.inf
    return CriticalPoint(float(thrust), float(W), converged, float(uncertainty), at.right, at.left)


def _terms(matrix: Array) -> Array:
    """Size of the terms whose sum a matrix entry is, which may cancel in it: that of the diagonal, as if of squares."""
    size = np.sqrt(np.abs(np.diag(matrix)))
    return np.maximum(np.abs(matrix), np.outer(size, size))
