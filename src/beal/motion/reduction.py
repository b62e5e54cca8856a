"""The lowest modes of a vehicle under its thrust, as a small set of equations with exactly those roots."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, eigvals, ordqz

from beal.discretisation.operators import Operators

Array = NDArray[np.float64]
APART = 1.01  # ratio of |mu| above which two modes may be separated; closer ones are kept or left out together


@dataclass(frozen=True)
class ReducedEquations:
    """q = X p with p'' + D p' + A p = W^T f, the roots of A being the lowest ones of the loaded vehicle undamped.

    Parameters
    ----------
    A : ndarray, shape (k, k)
        Stiffness in coordinates p, in rad^2/s^2.
    X : ndarray, shape (n, k)
        The invariant subspace, M-orthonormal.
    W : ndarray, shape (n, k)
        The left invariant subspace, W^T M X = 1.
    mu : ndarray of complex, shape (k,)
        Eigenvalues of A in ascending order of modulus, in rad^2/s^2: omega^2 of the stable modes.
    rigid : int
        How many of the leading ones belong to rigid-body motions.
    D : ndarray, shape (k, k), or None
        Damping in coordinates p, in 1/s; None where there is none.
    """

    A: Array
    X: Array
    W: Array
    mu: NDArray[np.complex128]
    rigid: int
    D: Array | None


def reduce(operators: Operators, thrust: float, modes: int, rigid_body: bool = True) -> ReducedEquations:
    """Equations of the lowest elastic modes, and the rigid-body ones, of the vehicle under a thrust.

    X spans the right and W the left invariant subspace of M^-1 K(P) that belongs to the eigenvalues of
    smallest modulus. Within it nothing is approximated: roots, and the part of any motion that lies in it,
    are those of the full equations, at a coalescence too, where eigenvectors do not exist. What is left out
    are the higher modes; a damping that couples them with those that are kept acts among the latter alone.

    Parameters
    ----------
    operators : Operators
    thrust : float
        P, in N.
    modes : int
        Elastic modes to keep, or a few more where the next one is close by; all where there are fewer.
    rigid_body : bool
        Whether the rigid-body motions are kept.

    Returns
    -------
    ReducedEquations
    """
    rigid = operators.rigid if rigid_body else 0
    shift, nu, V = free_modes(operators)
    if not rigid_body:
        nu, V = nu[operators.rigid :], V[:, operators.rigid :]
    mass = np.diag(nu)
    stiffness = np.eye(len(nu)) + thrust * V.T @ operators.K1 @ V
    if operators.dead is not None:
        stiffness += V.T @ operators.dead @ V
    mu = np.asarray(eigvals(stiffness, mass), dtype=np.complex128) - shift
    mu = mu[np.argsort(abs(mu), kind="stable")]
    keep = min(rigid + modes, len(mu))
    while keep < len(mu) and abs(mu[keep]) < APART * abs(mu[keep - 1]):
        keep += 1
    limit = math.sqrt(abs(mu[keep - 1] * mu[keep])) if keep < len(mu) else math.inf
    right = _graded(_invariant(stiffness, mass, shift, limit, keep), nu)
    left = _graded(_invariant(stiffness.T, mass, shift, limit, keep), nu)
    left = np.asarray(np.linalg.solve(left.T @ mass @ right, left.T), dtype=np.float64).T
    A = left.T @ stiffness @ right - shift * np.eye(keep)
    X, W = V @ right, V @ left
    D = None if operators.C is None else W.T @ operators.C @ X
    return ReducedEquations(A, X, W, mu[:keep], rigid, D)


def free_modes(operators: Operators) -> tuple[float, Array, Array]:
    """Modes of the vehicle without thrust in ascending order, the rigid-body motions first.

    They solve M v = nu (K0 + s M) v: in this form the low modes are the large eigenvalues, and so the
    accurate ones.

    Parameters
    ----------
    operators : Operators

    Returns
    -------
    shift : float
        s, in rad^2/s^2.
    nu : ndarray, shape (n,)
        1/(omega^2 + s).
    V : ndarray, shape (n, n)
        Modes in columns, with V^T (K0 + s M) V = 1 and V^T M V = diag(nu).
    """
    shift = operators.vehicle.scales.angular_frequency**2
    nu, V = np.empty(len(operators.M)), np.zeros_like(operators.M)
    for block in (slice(0, operators.rigid), slice(operators.rigid, None)):
        M = operators.M[block, block]
        if len(M):
            values, vectors = eigh(M, operators.K0[block, block] + shift * M)
            nu[block], V[block, block] = values[::-1], vectors[:, ::-1]
    return shift, nu, V


def _invariant(stiffness: Array, mass: Array, shift: float, limit: float, keep: int) -> Array:
    """Orthonormal basis of the deflating subspace of stiffness - (mu + shift) mass with |mu| < limit."""
    if math.isinf(limit):
        return np.eye(keep)
    *_, vectors = ordqz(stiffness, mass, sort=lambda a, b: abs(a - shift * b) < limit * abs(b), output="real")
    return np.asarray(vectors[:, :keep])


def _graded(basis: Array, nu: Array) -> Array:
    """The basis turned such that it is M-orthonormal and as close to the free modes as it can be."""
    values, rotation = np.linalg.eigh(basis.T @ (nu[:, None] * basis))
    return np.asarray(basis @ (rotation / np.sqrt(values))[:, ::-1])
