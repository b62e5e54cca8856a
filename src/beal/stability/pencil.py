"""The eigenvalue problem of a loaded vehicle, K(P) x = W M x with W = omega^2, and its reduction."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from beal.discretisation.operators import Operators
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

MODES = 10  # kept
CORRECTED, TWICE_CORRECTED = 4, 2  # lowest ones whose change under thrust is added; twice
MISPLACED = 1e-6  # relative error of a root of a reduced pencil from which its vectors are added
LIGHT = 1e-13  # share of the largest inertia below which a coordinate only follows; stiff joints' are all rounding
UNCOUPLED = 1e-11  # a rigid-body motion that drives the elastic coordinates less than this drives them not at all


@dataclass(frozen=True)
class Pencil:
    """K(P) = K0 + P K1, M and C without the rigid-body motions that do not act on the elastic ones.

    Parameters
    ----------
    K0, K1, M : ndarray, shape (n, n)
    rigid : int
        Number of rigid-body motions kept, the leading coordinates.
    shift : float
        A W > 0 below the elastic range, which makes K0 + shift M definite.
    C : ndarray, shape (n, n), or None
        Damping; None where there is none.
    dead : ndarray, shape (n, n), optional
        Stiffness of the loads that do not grow with the thrust, not part of K0.
    held : tuple of float
        W of the rigid-body motions on a foundation that were left out since they only follow.
    """

    K0: Array
    K1: Array
    M: Array
    rigid: int
    shift: float
    C: Array | None = None
    dead: Array | None = None
    held: tuple[float, ...] = ()

    def stiffness(self, thrust: float) -> Array:
        """K(P), shape (n, n)."""
        stiffness = self.K0 + thrust * self.K1
        return stiffness if self.dead is None else stiffness + self.dead

    def roots(self, thrust: float) -> ComplexArray:
        """All W in order of their real parts, shape (n,).

        From the inverse, 1/(W + shift), because a stiff joint's root would drown the low ones in its rounding.
        """
        root = np.sqrt(np.diag(self.M))  # reduced pencils have a diagonal M
        shifted = self.stiffness(thrust) + self.shift * self.M
        inverse = np.linalg.eigvals(root[:, None] * np.linalg.solve(shifted, np.diag(root))).astype(complex)
        roots = 1 / inverse - self.shift
        return np.asarray(roots[np.lexsort((roots.imag, roots.real))])

    def lowest(self, thrust: float, count: int) -> ComplexArray:
        """The lowest W in order of their real parts, shape (count,), in any coordinates, M diagonal or not."""
        shifted = self.stiffness(thrust) + self.shift * self.M
        inverse = np.linalg.eigvals(np.linalg.solve(shifted, self.M)).astype(complex)
        roots = 1 / inverse[np.argsort(-inverse.real)][:count] - self.shift
        return np.asarray(roots[np.argsort(roots.real)])

    def projected(self, vectors: Array) -> "Pencil":
        """The pencil in the span of ``vectors``, in coordinates that make M diagonal and K0 + shift M the identity."""
        K0, K1, M = (vectors.T @ matrix @ vectors for matrix in (self.K0, self.K1, self.M))
        inertia, rotation = scipy.linalg.eigh(M, K0 + self.shift * M)
        inertia, rotation = np.maximum(inertia[::-1], LIGHT * inertia[-1]), rotation[:, ::-1]
        K0 = np.eye(len(M)) - self.shift * np.diag(inertia)
        C, dead = (
            None if matrix is None else rotation.T @ (vectors.T @ matrix @ vectors) @ rotation
            for matrix in (self.C, self.dead)
        )
        K1, M = rotation.T @ K1 @ rotation, np.diag(inertia)
        return replace(self, K0=K0, K1=K1, M=M, C=C, dead=dead)


def pencil(operators: Operators, kept: NDArray[np.bool_] | None = None) -> Pencil:
    """The stability problem of a discretised vehicle, in the coordinates that act unless others are ``kept``."""
    kept = acting(operators) if kept is None else kept
    select = np.ix_(kept, kept)
    shift = operators.vehicle.scales.angular_frequency**2
    C, dead = (None if matrix is None else matrix[select] for matrix in (operators.C, operators.dead))
    motions = int(kept[: operators.rigid].sum())
    return Pencil(operators.K0[select], operators.K1[select], operators.M[select], motions, shift, C, dead)


def acting(operators: Operators) -> NDArray[np.bool_]:
    """Which coordinates are part of the stability problem, shape (n,).

    A rigid-body motion whose columns of K1 and C vanish on the coordinates that are kept only follows them (theory,
    section 5): it contributes zero roots for every thrust and is left out.
    """
    rigid = operators.rigid
    kept = np.arange(len(operators.M)) >= rigid
    drives = np.zeros((len(operators.M), rigid), dtype=bool)
    for matrix in (operators.K1, operators.C, operators.dead):
        if matrix is not None:
            least = UNCOUPLED * np.abs(matrix[rigid:, rigid:]).max(initial=0.0)
            drives |= np.abs(matrix[:, :rigid]) > least
    for _ in range(rigid):  # one motion may act on the elastic coordinates through another
        kept[:rigid] |= drives[kept].any(axis=0)
    return kept


def _without_followers(full: Pencil) -> Pencil:
    """The pencil without translation and rotation on a foundation in proportion to the mass, W = k/m at every thrust.

    They drive nothing that is kept; rotation may drive translation, and the double root then has one eigenvector.
    """
    while not full.rigid and len(full.held) < 2 and _only_follows(full):
        K0, K1, M = (matrix[1:, 1:] for matrix in (full.K0, full.K1, full.M))
        C, dead = (None if matrix is None else matrix[1:, 1:] for matrix in (full.C, full.dead))
        held = (*full.held, float(full.K0[0, 0] / full.M[0, 0]))
        full = replace(full, K0=K0, K1=K1, M=M, C=C, dead=dead, held=held)
    return full


def _only_follows(full: Pencil) -> bool:
    """Whether the first coordinate acts on none of the others and feels no thrust of its own."""
    columns = [(matrix, matrix[1:, 0]) for matrix in (full.M, full.K0, full.C) if matrix is not None]
    columns += [(load, load[:, 0]) for load in (full.K1, full.dead) if load is not None]
    return all(np.abs(column).max(initial=0.0) <= UNCOUPLED * np.abs(matrix).max() for matrix, column in columns)


def corrections(vehicle: Vehicle, watched: int) -> int:
    """How many of the lowest modes need their change under thrust: of stages that shear all that are watched.

    Short waves of shear feel the thrust as long ones do, while bending is the stiffer the shorter it is.
    """
    return watched if vehicle.shears else CORRECTED


def reduced(full: Pencil, modes: int = MODES, corrected: int = CORRECTED, beside: Array | None = None) -> Pencil:
    """The pencil in its lowest modes, the changes of the lowest few, ``corrected``, under thrust, and vectors beside.

    Modes of the unloaded vehicle converge slowly where thrust acts on a joint; with K^-1 K1 v and K^-1 K1^T v of the
    lowest modes v beside them, sixteen vectors do what hundreds of modes do.
    """
    full = _without_followers(full)
    static = full.K0 + full.shift * full.M
    modes = min(modes + full.rigid, len(static))
    _, vectors = scipy.linalg.eigh(full.M, static)
    vectors = vectors[:, ::-1]  # largest inertia first: the lowest modes, to full accuracy
    sides = [side for load in (full.K1, full.dead) if load is not None for side in (load, load.T)]
    sides += [] if full.C is None else [full.C]
    if modes + len(sides) * (corrected + TWICE_CORRECTED) >= len(static):
        return full.projected(vectors)
    factor = scipy.linalg.cho_factor(static)
    low = vectors[:, : full.rigid + corrected]
    first = [scipy.linalg.cho_solve(factor, K1 @ low) for K1 in sides]
    second = [scipy.linalg.cho_solve(factor, K1 @ w[:, :TWICE_CORRECTED]) for K1, w in zip(sides, first, strict=True)]
    span = np.hstack((vectors[:, :modes], *first, *second, *(() if beside is None else (beside,))))
    upper = scipy.linalg.cholesky(static)
    span = upper @ span
    size = np.linalg.norm(span, axis=0)
    left, singular, _ = np.linalg.svd(span[:, size > 0] / size[size > 0], full_matrices=False)
    independent = left[:, singular > 1e-8 * singular[0]]
    return full.projected(scipy.linalg.solve_triangular(upper, independent))


def misplaced(full: Pencil, small: Pencil, thrust: float, count: int) -> Array | None:
    """Right and left vectors of the lowest roots under a thrust that a reduced pencil has not in their places.

    Two roots that only just meet, or only just do not, need their places to a small part of their distance.
    """
    full = _without_followers(full)
    if len(small.M) >= len(full.M):
        return None
    shifted = full.stiffness(thrust) + full.shift * full.M
    feeds = np.linalg.solve(shifted, full.M)
    found, lowest = small.roots(thrust)[:count], slice(None, 2 * count)
    inverse = np.linalg.eigvals(feeds).astype(complex)
    roots = 1 / inverse[np.argsort(-np.abs(inverse))][lowest] - full.shift
    off = np.abs(roots - found[:, None]).min(axis=1) > MISPLACED * (np.abs(found) + full.shift)
    if not off.any():
        return None
    inverse, left, right = scipy.linalg.eig(feeds, left=True)
    roots = 1 / inverse - full.shift
    places = np.unique(np.abs(roots - found[off, None]).argmin(axis=1))
    vectors = np.hstack((right[:, places], np.linalg.solve(shifted.T, left[:, places].conj())))
    return np.hstack((vectors.real, vectors.imag))
