"""All values of a parameter at which a root may cross the imaginary axis, without a step that could pass one over.

Of x' = (A0 + p A1) x two roots add up to zero, as i omega and -i omega do, where the map X -> A X + X A^T of
antisymmetric X is singular (the bialternate product; Guckenheimer, Myers & Sturmfels 1997), and one is zero where A is.
Both are linear in p: all such p are eigenvalues.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.linalg import eigh

from beal.control.compensator import Array
from beal.control.loop import Loop
from beal.stability.complete import REFERENCE, inverse_roots
from beal.stability.pairs import matrix, pairs

SPARE = 3  # modes kept beyond those watched
INDEPENDENT = 1e-6  # share of a static deflection that the modes lack, above which it is kept beside them
UNREAD = 1e-12  # a state that nothing else depends on has a column smaller than this share of the largest


def crossings(zero: Array, slope: Array, limit: float) -> Array:
    """Every p in (0, limit] at which A0 + p A1 may have a root on the imaginary axis, in ascending order.

    Parameters
    ----------
    zero, slope : ndarray, shape (n, n)
        A0 and A1; the cost grows with the sixth power of n.
    limit : float

    Returns
    -------
    ndarray
        Also the p at which two real roots differ in sign alone.

    Examples
    --------
    >>> still, fed = np.array([[-2.0, 1.0], [-1.0, 0.0]]), np.array([[1.0, 0.0], [0.0, 0.0]])
    >>> crossings(still, fed, 5.0).round(9).tolist()  # an oscillator whose damping 2 - p goes to zero
    [2.0]
    """
    zero, slope = _read(zero, slope)
    at, change = zero + REFERENCE * limit * slope, limit * slope
    one = np.eye(len(zero))
    every = pairs(np.ones(len(zero), dtype=bool), diagonal=False)
    summed = [matrix(every, every, -1, (A, one), (one, A)) for A in (at, change)]
    return np.sort(np.concatenate((inverse_roots(at, change, limit), inverse_roots(summed[0], summed[1], limit))))


def condensed(closed: Loop, modes: int) -> Loop:
    """The loop in the lowest modes and the static deflections under the control force and from what sensors read.

    Parameters
    ----------
    closed : Loop
    modes : int

    Returns
    -------
    Loop
        In coordinates of unit modal mass.
    """
    kept, operators = closed.kept, closed.operators
    select = np.ix_(kept, kept)
    M, static = operators.M[select], operators.K0[select] + closed.speed**2 * operators.M[select]
    V = eigh(M, static)[1][:, ::-1][:, : int(np.sum(kept < operators.rigid)) + modes + SPARE]
    for row in (closed.b, closed.w, *closed.g):
        deflection = np.linalg.solve(static, row[kept])
        rest = deflection - V @ (V.T @ static @ deflection)
        size = np.sqrt(rest @ static @ rest)
        if size > INDEPENDENT * np.sqrt(deflection @ static @ deflection):  # never so of a row of zeros
            V = np.column_stack((V, rest / size))
    inertia, turn = np.linalg.eigh(V.T @ M @ V)
    V = V @ (turn / np.sqrt(inertia))

    def within(matrix: Array | None) -> Any:
        return None if matrix is None else V.T @ matrix[select] @ V

    small = {name: within(getattr(operators, name)) for name in ("M", "K0", "K1", "C", "dead")}
    small_operators = replace(operators, rigid=0, **small)
    b, w, g = closed.b[kept] @ V, closed.w[kept] @ V, closed.g[:, kept] @ V
    return replace(closed, operators=small_operators, b=b, w=w, g=g, kept=np.arange(V.shape[1]))


def first_order(closed: Loop) -> tuple[Array, Array]:
    """A0 and A1 of x' = (A0 + P A1) x, in coordinates as large as their rates over their frequencies.

    Parameters
    ----------
    closed : Loop
        Condensed.

    Returns
    -------
    zero, slope : ndarray, shape (n, n)
    """
    E, zero, slope = closed.affine
    size = np.ones(len(E))
    size[: len(closed.kept)] = np.sqrt(np.abs(np.diag(closed.operators.K0)) + closed.speed**2)
    zero, slope = (np.linalg.solve(E, A) * np.outer(size, 1 / size) for A in (zero, slope))
    return zero, slope


def _read(zero: Array, slope: Array) -> tuple[Array, Array]:
    """Without the states on which nothing depends, which are the drift."""
    largest = max(np.abs(zero).max(), np.abs(slope).max())
    unread = np.maximum(np.abs(zero).max(axis=0), np.abs(slope).max(axis=0)) < UNREAD * largest
    if not unread.any():
        return zero, slope
    index = np.flatnonzero(~unread)
    return _read(zero[np.ix_(index, index)], slope[np.ix_(index, index)])
