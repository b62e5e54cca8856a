"""Roots s of (s^2 M + s C + K(P)) x = 0, from its inverse, in which the low modes are the large eigenvalues."""

import numpy as np

from beal.stability.pencil import Array, ComplexArray, Pencil

NEUTRAL = 1e-4  # |s| of a zero root of rigid-body motion, beside the square root of the shift
INFINITE = 1e-14  # |shift / (s - shift)| of a root at infinity


def damped_roots(pencil: Pencil, thrust: float) -> ComplexArray:
    """All roots at a thrust in order of modulus, shape (2 n,) or less by those of coordinates without inertia."""
    inverse = np.linalg.eigvals(_inverse(pencil, thrust)).astype(complex)
    s = _roots(pencil, inverse[np.abs(inverse) > INFINITE])
    return np.asarray(s[np.lexsort((s.imag, np.abs(s)))])


def damped_modes(pencil: Pencil, thrust: float, count: int) -> tuple[ComplexArray, ComplexArray]:
    """The ``count`` roots of smallest modulus with Im s >= 0, with right vectors M-normalised.

    An overdamped mode counts twice, with both of its real roots.
    """
    inverse, vectors = np.linalg.eig(_inverse(pencil, thrust))
    finite = np.abs(inverse) > INFINITE
    s, vectors = _roots(pencil, inverse[finite].astype(complex)), vectors[: len(pencil.M), finite]
    upper = np.flatnonzero(s.imag >= 0)
    nearest = upper[np.argsort(np.abs(s[upper]), kind="stable")[:count]]
    s, vectors = s[nearest], vectors[:, nearest].astype(complex)
    size = np.sqrt(np.abs(np.einsum("ij,ik,kj->j", vectors.conj(), pencil.M, vectors)))
    return s, vectors / size


def _inverse(pencil: Pencil, thrust: float) -> Array:
    """Matrix of (x, k x) whose eigenvalues are k = r / (s - r), with r^2 the pencil's shift."""
    n, r = len(pencil.M), np.sqrt(pencil.shift)
    C = np.zeros_like(pencil.M) if pencil.C is None else pencil.C
    shifted = pencil.stiffness(thrust) + r * C + pencil.shift * pencil.M
    matrix = np.zeros((2 * n, 2 * n))
    matrix[:n, n:] = np.eye(n)
    matrix[n:] = -np.linalg.solve(shifted, np.hstack((pencil.shift * pencil.M, 2 * pencil.shift * pencil.M + r * C)))
    return matrix


def _roots(pencil: Pencil, inverse: ComplexArray) -> ComplexArray:
    r = np.sqrt(pencil.shift)
    return np.asarray(r + r / inverse)
