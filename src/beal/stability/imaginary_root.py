"""Where damped roots cross the imaginary axis, as well-conditioned equations solved by Newton's method.

With b, c fixed and

    [K(P) - W M + i omega C   b] [x]   [0]
    [c^T                      0] [g] = [1]        W = omega^2

g(P, omega) vanishes where i omega is a root: two real equations, one complex one. For a damping e C that goes to zero,
the root at W of the undamped vehicle moves by Re s = - e psi^T C x / (2 psi^T M x) to first order; the two equations
g = 0 and psi^T C x = 0 of the undamped matrix then are the limit.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.stability.double_root import EPS, FAR, ROUNDING, STEPS, CriticalPoint
from beal.stability.pencil import Array, ComplexArray, Pencil

Equations = tuple[Array, Array, Array]  # two equations, their derivatives, what rounding does to them


def imaginary_root(pencil: Pencil, thrust: float, W: float) -> CriticalPoint:
    """The thrust nearest to a guess at which a damped root is i omega, omega^2 = W.

    Parameters
    ----------
    pencil : Pencil
        With damping.
    thrust, W : float
        The guess.

    Returns
    -------
    CriticalPoint
        Without eigenvectors; ``converged`` is false where Newton's method did not settle.
    """
    C = damping_of(pencil)

    def equations(thrust: float, omega: float) -> Equations:
        matrix = pencil.stiffness(thrust) - omega**2 * pencil.M + 1j * omega * C
        solve = _factorised(matrix, b, c)
        g, x = solve(unit, 0)[-1], solve(unit, 0)[:-1]
        psi = solve(unit, 1)[:-1]
        g_P = -psi @ (pencil.K1 @ x)
        g_omega = psi @ ((2 * omega * pencil.M - 1j * C) @ x)
        jacobian = np.array([[g_P.real, g_omega.real], [g_P.imag, g_omega.imag]])
        # x and psi are as good as real under little damping, and the imaginary part then as precise as the damping is.
        terms = [(1.0, pencil.K0), (abs(thrust), pencil.K1), (omega**2, pencil.M)]
        turned = _size(terms, psi.imag, x) + _size(terms, psi, x.imag) + _size([(omega, C)], psi, x)
        return np.array([g.real, g.imag]), jacobian, np.array([_size(terms, psi, x), turned])

    omega = float(np.sqrt(W))
    u, _, vh = np.linalg.svd(pencil.stiffness(thrust) - W * pencil.M + 1j * omega * C)
    b, c, unit = _turned_real(u[:, -1]), _turned_real(vh[-1]), np.eye(len(u) + 1)[-1]
    point = _newton(equations, thrust, omega)
    return replace(point, W=point.W**2)


def vanishing_root(pencil: Pencil, thrust: float, W: float) -> CriticalPoint:
    """The thrust nearest to a guess at which a vanishing damping neither feeds nor drains a mode.

    Parameters
    ----------
    pencil : Pencil
        Whose damping is the direction from which zero is approached.
    thrust, W : float
        The guess.

    Returns
    -------
    CriticalPoint
    """
    C = damping_of(pencil)

    def equations(thrust: float, W: float) -> Equations:
        solve = _factorised(pencil.stiffness(thrust) - W * pencil.M, b, c)
        g, x = solve(unit, 0)[-1], solve(unit, 0)[:-1]
        psi = solve(unit, 1)[:-1]
        fed = psi @ (C @ x)
        jacobian = np.empty((2, 2))
        for column, change in enumerate((-pencil.K1, pencil.M)):  # with P and with W
            x_changed = solve(np.append(change @ x, 0.0), 0)[:-1]
            psi_changed = solve(np.append(change.T @ psi, 0.0), 1)[:-1]
            jacobian[:, column] = psi @ (change @ x), psi_changed @ (C @ x) + psi @ (C @ x_changed)
        terms = [(1.0, pencil.K0), (abs(thrust), pencil.K1), (W, pencil.M)]
        inexact = _size([(1.0, C)], psi, x) + ROUNDING * abs(W * jacobian[1, 1])
        return np.array([g, fed]), jacobian, np.array([_size(terms, psi, x), inexact])

    u, _, vt = np.linalg.svd(pencil.stiffness(thrust) - W * pencil.M)
    b, c, unit = u[:, -1], vt[-1], np.eye(len(u) + 1)[-1]
    point = _newton(equations, thrust, W)
    u, _, vt = np.linalg.svd(pencil.stiffness(point.thrust) - point.W * pencil.M)
    return replace(point, right=vt[-1], left=u[:, -1])


def damping_of(pencil: Pencil) -> Array:
    """C of a pencil that has one."""
    if pencil.C is None:
        raise ModelError("damping: a damped vehicle was expected, found one without damping")
    return pencil.C


def _turned_real(vector: ComplexArray) -> Array:
    """The real part after the turn in the complex plane that makes it largest."""
    return np.asarray((vector * np.exp(-0.5j * np.angle(np.sum(vector**2)))).real)


def _factorised(matrix: NDArray[Any], b: Array, c: Array) -> Callable[[NDArray[Any], Literal[0, 1]], NDArray[Any]]:
    """Solutions with the bordered matrix (0) or its transpose (1)."""
    bordered = np.block([[matrix, b[:, None]], [c[None, :], np.zeros((1, 1))]])
    factor = scipy.linalg.lu_factor(bordered, check_finite=False)
    return lambda right, transposed: scipy.linalg.lu_solve(factor, right, trans=transposed)


def _size(terms: Sequence[tuple[float, Array]], left: NDArray[Any], right: NDArray[Any]) -> float:
    """What rounding does to left^T (sum of terms) right, the terms being sums of squares."""
    sizes = [(weight, np.sqrt(np.abs(np.diag(matrix)))) for weight, matrix in terms]
    return ROUNDING * float(sum(w * (np.abs(left) @ size) * (size @ np.abs(right)) for w, size in sizes))


def _newton(equations: Callable[[float, float], Equations], thrust: float, W: float) -> CriticalPoint:
    """The solution of two equations next to a guess; its second unknown is kept as W."""
    here, converged = np.array([thrust, W]), False
    far = FAR * np.abs(here)
    value, jacobian, rounding = equations(*here)
    for _ in range(STEPS):
        determinant = np.linalg.det(jacobian)
        if not np.isfinite(determinant) or determinant == 0.0:
            converged = False
            break
        step = np.linalg.solve(jacobian, value)
        here = here - step
        if not np.all(np.abs(here) < far):
            converged = False
            break
        value, jacobian, rounding = equations(*here)
        if converged:  # one step past the tolerance, since convergence is quadratic
            break
        converged = bool(np.all(np.abs(step) < 1e-8 * np.abs(here)))
    uncertainty = np.inf
    if converged and here[1] > 0:
        uncertainty = float(np.abs(np.linalg.inv(jacobian)[0]) @ rounding + 4 * EPS * abs(here[0]))
    nothing = np.empty(0)
    return CriticalPoint(float(here[0]), float(here[1]), uncertainty < np.inf, uncertainty, nothing, nothing)
