"""Critical points of many vehicles at once, brought to full accuracy on their own matrices.

The bordered systems of `beal.stability.double_root`, stacked. The vehicles share a discretisation and differ in their
joints' springs, each a diagonal entry of the stiffness; rows and columns are scaled by 1/sqrt(1 + k/k_ref), so that a
rigid joint is as good as a soft one.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.stability.pencil import Array, Pencil

STEPS = 2  # from the seven digits or so of a table to all


@dataclass(frozen=True)
class SpringPencil:
    """The pencil of the vehicles without their springs, and where the springs enter.

    Parameters
    ----------
    pencil : Pencil
    columns : ndarray of int, shape (springs,)
        The coordinate that each spring acts on.
    references : ndarray, shape (springs,)
        k_ref of each: its entry in the stiffness is k/k_ref.
    """

    pencil: Pencil
    columns: NDArray[np.intp]
    references: Array


def polished(
    springs: SpringPencil, stiffnesses: Array, P: Array, W: Array, flutter: NDArray[np.bool_]
) -> tuple[Array, Array]:
    """Thrust and W of coalescences (where ``flutter``) or divergences next to good guesses.

    Parameters
    ----------
    springs : SpringPencil
    stiffnesses : ndarray, shape (vehicles, springs)
    P, W : ndarray, shape (vehicles,)
    flutter : ndarray of bool, shape (vehicles,)

    Returns
    -------
    P, W : ndarray, shape (vehicles,)
    """
    n = len(springs.pencil.M)
    relative = stiffnesses / springs.references
    scale = np.ones((len(P), n))
    scale[:, springs.columns] = 1 / np.sqrt(1 + relative)
    outer = scale[:, :, None] * scale[:, None, :]
    spring = np.zeros((len(P), n))
    spring[:, springs.columns] = 1 - scale[:, springs.columns] ** 2  # (k/k_ref) / (1 + k/k_ref), infinity included
    fixed = outer * springs.pencil.K0
    fixed[:, np.arange(n), np.arange(n)] += spring
    K1, M = outer * springs.pencil.K1, outer * springs.pencil.M
    b = c = None
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            A = fixed + P[:, None, None] * K1 - W[:, None, None] * M
            if b is None or c is None:
                b, c = _null_vectors(A)
            step_P, step_W = _step(A, K1, M, b, c, flutter)
            P, W = P - step_P, W - step_W
    return P, np.where(flutter, W, 0.0)


def _null_vectors(A: Array) -> tuple[Array, Array]:
    """Nearly left and right null vectors of nearly singular matrices, by a step of inverse iteration."""
    start = np.cos(np.arange(1.0, A.shape[-1] + 1))[:, None]  # nothing special, so not orthogonal to them
    solutions = [np.linalg.solve(matrix, np.broadcast_to(start, (*A.shape[:-1], 1))) for matrix in (A.mT, A)]
    left, right = ((x / np.linalg.norm(x, axis=1, keepdims=True))[..., 0] for x in solutions)
    return left, right


def _step(A: Array, K1: Array, M: Array, b: Array, c: Array, flutter: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Newton step of g = g_W = 0, or of g(P, 0) = 0."""
    count, n, _ = A.shape
    bordered = np.zeros((count, n + 1, n + 1))
    bordered[:, :n, :n], bordered[:, :n, n], bordered[:, n, :n] = A, b, c
    inverse = np.linalg.inv(bordered)
    x, psi = inverse[:, :n, n], inverse[:, n, :n]
    g = inverse[:, n, n]

    def product(matrix: Array, vector: Array) -> Array:
        return np.einsum("vij,vj->vi", matrix, vector)

    Mx, K1x = product(M, x), product(K1, x)
    x_W, x_P = product(inverse[:, :n, :n], Mx), -product(inverse[:, :n, :n], K1x)
    g_P, g_W = -np.sum(psi * K1x, 1), np.sum(psi * Mx, 1)
    g_WW = 2 * np.sum(psi * product(M, x_W), 1)
    g_WP = np.sum(psi * (product(M, x_P) - product(K1, x_W)), 1)
    determinant = g_P * g_WW - g_W * g_WP
    step_P = np.where(flutter, (g * g_WW - g_W**2) / determinant, g / g_P)
    step_W = np.where(flutter, (g_P * g_W - g_WP * g) / determinant, 0.0)
    return step_P, step_W
