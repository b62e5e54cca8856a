"""What the vectors of a critical point of a reduced problem leave unbalanced in the whole vehicle.

The error of a critical thrust is the product of those of its right and left vectors, of a limit of vanishing damping
also of the two that answer to the damping of these; each vector's own static deflection corrects it.
"""

from collections.abc import Iterator

import numpy as np

from beal.discretisation.linked import LinkedOperators
from beal.stability.damped import free_motions
from beal.stability.double_root import CriticalPoint, chained
from beal.stability.imaginary_root import damping_of
from beal.stability.pencil import Array, Pencil
from beal.stability.ridge import Kind


def unbalanced(
    system: LinkedOperators, kept: Array, full: Pencil, kind: Kind, point: CriticalPoint, vanishing: bool
) -> Iterator[Array]:
    """Loads that the right vectors, then the left ones, of a critical point leave.

    Parameters
    ----------
    system : LinkedOperators
        Of the whole vehicle.
    kept : ndarray, shape (n, m)
        The vectors behind the coordinates of the reduced problem.
    full : Pencil
        The reduced problem.
    kind : {"flutter", "divergence"}
    point : CriticalPoint
    vanishing : bool
        Whether the point is the limit of a vanishing damping.

    Yields
    ------
    ndarray, shape (n, k)
    """
    if full.C is None or vanishing:
        yield from _chains(system, kept, full, point, vanishing)
    elif kind == "flutter":
        yield from _oscillation(system, kept, full, point)
    else:
        yield from _drift(system, kept, full, point)


def _chains(
    system: LinkedOperators, kept: Array, full: Pencil, point: CriticalPoint, vanishing: bool
) -> Iterator[Array]:
    """K x = W M x, and (K - W M) x' = M x of a double root or C x of the limit of a vanishing damping."""
    loaded = system.stiffness(point.thrust)
    feeds = system.C if vanishing else system.M
    second = chained(full, point, damping_of(full) if vanishing else full.M)
    for stiffness, x, y in zip((loaded, loaded.T), (point.right, point.left), second, strict=True):
        size = np.array([np.linalg.norm(x), np.linalg.norm(y)])
        pair = kept @ (np.column_stack((x, y)) / size)
        loads = stiffness @ pair - point.W * (system.M @ pair)
        loads[:, 1] -= feeds @ pair[:, 0] * size[0] / size[1]
        yield loads


def _oscillation(system: LinkedOperators, kept: Array, full: Pencil, point: CriticalPoint) -> Iterator[Array]:
    """(K - W M + i omega C) x = 0, real and imaginary part."""
    omega = np.sqrt(point.W)
    u, _, vh = np.linalg.svd(full.stiffness(point.thrust) - point.W * full.M + 1j * omega * damping_of(full))
    loaded = system.stiffness(point.thrust)
    for stiffness, reduced in ((loaded, vh[-1].conj()), (loaded.T, u[:, -1].conj())):
        x = kept @ reduced
        loads = stiffness @ x - point.W * (system.M @ x) + 1j * omega * (system.C @ x)
        yield np.column_stack((loads.real, loads.imag))


def _drift(system: LinkedOperators, kept: Array, full: Pencil, point: CriticalPoint) -> Iterator[Array]:
    """K x + C x' = 0 with rates x' of the motions that meet no stiffness."""
    free = free_motions(full)
    loaded = system.stiffness(point.thrust)
    right, left = (vector / np.linalg.norm(vector) for vector in (point.right, point.left))
    yield (loaded @ (kept @ right) + system.C @ (kept @ (free @ (free.T @ right))))[:, None]
    yield (loaded.T @ (kept @ left))[:, None]
