"""The critical thrust of a vehicle as its damping vanishes, which is not that of the undamped vehicle.

A damping e C with e -> 0 moves the simple root W of the undamped vehicle by Re s = - e f / 2, f = y^T C x / y^T M x,
with the left and right vectors y, x (Bolotin 1963; Kirillov 2013). Where circulatory forces act f may be negative:
the limit is the first thrust at which that happens to any mode, or else the undamped critical thrust.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import scipy.linalg

from beal.discretisation.build import Formulation, discretise
from beal.errors import ModelError
from beal.stability.critical import COMPLETE_SPARE, MOST_DAMPED, CriticalThrust, critical_thrust
from beal.stability.damped import CLOSEST, FLUTTER, GROWING, Crossing, closest_mode, crossings, distinct, unloaded
from beal.stability.double_root import CriticalPoint
from beal.stability.imaginary_root import damping_of, vanishing_root
from beal.stability.large import Reduction, is_large
from beal.stability.pencil import Array, Pencil, pencil, reduced
from beal.stability.refine import default_tolerance, first_order, ladder, refined
from beal.stability.ridge import Instability, Kind
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

RIGID = 1e-4  # |W| of a rigid-body root, beside the shift


def vanishing_damping_limit(
    vehicle: Vehicle,
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    tolerance: float | None = None,
) -> CriticalThrust:
    """The limit of the critical thrust as all damping of a vehicle goes to zero in its given ratios.

    Not larger than that of the undamped vehicle, however small the damping is, and often much smaller. Computed from
    the undamped modes, not with a small damping.

    Parameters
    ----------
    vehicle : Vehicle
        With damping, of which only the ratios count.
    max_thrust : float, optional
        Thrust to search to, in N, by default as for `beal.critical_thrust`.
    formulation : {"objective", "converged"}
    tolerance : float, optional
        Relative error to reach.

    Returns
    -------
    CriticalThrust
        With the undamped vehicle's kind, modes and thrust where the limit is the same; else flutter of one mode, named
        twice. The limit is 0 where a damping feeds a mode under any thrust, or under the dead loads alone.

    Raises
    ------
    ModelError
        If the vehicle has no damping, its dead loads alone make it unstable without, or an option does not apply.
    ConvergenceError
        If the tolerance is not reached.

    Notes
    -----
    Of the elastic modes. Rigid-body motions that a drag turns away at any thrust show in `beal.critical_thrust`.

    References
    ----------
    Bolotin, V. V., 1963. Nonconservative problems of the theory of elastic stability. Pergamon.
    Kirillov, O. N., 2013. Nonconservative stability problems of modern physics. De Gruyter.

    Examples
    --------
    >>> from beal.vehicle import Stage, Support
    >>> stage = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0, internal_damping=0.1)
    >>> round(vanishing_damping_limit(Vehicle(stages=[stage], support=Support(nose="clamped"))).critical_thrust, 7)
    10.9388493
    """
    if not vehicle.damped:
        raise ModelError("damping: the limit of vanishing damping needs a vehicle with some, found none")
    undamped = critical_thrust(vehicle.undamped, max_thrust, formulation, tolerance=tolerance)
    elastic = undamped.elastic or undamped
    if elastic.critical_thrust == 0.0:  # a mechanism
        return undamped
    with one_thread():
        limit = elastic.critical_thrust or elastic.searched_to
        large = Reduction(vehicle, formulation, vanishing=True) if is_large(vehicle) else None
        operators = (
            large.operators if large else discretise(vehicle, formulation, order=first_order(vehicle, "legendre"))
        )
        watched = min(elastic.watched_modes, MOST_DAMPED)
        full = pencil(operators)
        plain = reduced(replace(full, C=None), watched + COMPLETE_SPARE)
        small = reduced(full, watched + COMPLETE_SPARE)
        parted = len(plain.held) == 2 and not small.held
        found = _parted(plain, limit) if parted else _first_fed(small, plain, limit, watched)
        if found is None:
            return undamped
        thrust, W, mode = found
        nothing = np.empty(0)
        guess = Instability(CriticalPoint(thrust, W, True, 0.0, nothing, nothing), FLUTTER, (mode, mode))
        steps = large.points if large else partial(ladder, vehicle, formulation, "legendre", polish=_polish)
        point, error = refined(guess, steps(guess), tolerance or default_tolerance(vehicle, "legendre"))
    first = replace(
        elastic,
        critical_thrust=point.thrust,
        kind="flutter",
        modes=(mode, mode),
        angular_frequency=float(np.sqrt(point.W)),
        error_estimate=error,
        watched_modes=watched,
        border=False,
    )
    return first if undamped.elastic is None else replace(undamped, elastic=first)


def _polish(full: Pencil, kind: Kind, thrust: float, W: float) -> CriticalPoint:
    return vanishing_root(full, thrust, W)


def _first_fed(small: Pencil, plain: Pencil, limit: float, watched: int) -> tuple[float, float, int] | None:
    """Thrust, W and number of the mode that a vanishing damping first feeds, below a limit where all roots are real."""
    found: list[Crossing] = []
    for thrust in crossings(small, limit, vanishing=True):
        W, drained = _drained(small, thrust, watched)
        for root in W[np.argsort(np.abs(drained) / np.sqrt(W))[:CLOSEST]]:
            point = vanishing_root(small, thrust, float(root))
            if point.converged:
                found.append((point.thrust, point.W, FLUTTER))
    found = distinct(found, limit)
    ends = np.array([0.0, *(thrust for thrust, _, _ in found), limit])
    for start, middle in enumerate((ends[1:] + ends[:-1]) / 2):
        W, drained = _drained(small, middle, watched)
        worst = int(np.argmin(drained / np.sqrt(W)))
        if drained[worst] < -GROWING * np.sqrt(W[worst]):
            if start:
                thrust, W_fed, _ = found[start - 1]
                return thrust, W_fed, closest_mode(plain, thrust, W_fed, limit)
            mode = closest_mode(plain, middle, float(W[worst]), limit)
            return 0.0, unloaded(plain, mode), mode
    return None


def _parted(plain: Pencil, limit: float) -> tuple[float, float, int]:
    """The same where damping couples translation and rotation of one frequency on a foundation: nothing is borne.

    Under thrust the two roots have one eigenvector x, and move by the square root of -i e omega psi^T C x, which feeds
    one of them unless it vanishes.
    """
    W = min(plain.held)
    return 0.0, W, closest_mode(plain, 0.0, W, limit)


def _drained(small: Pencil, thrust: float, watched: int) -> tuple[Array, Array]:
    """W of the lowest elastic modes and f = y^T C x / y^T M x of each, shape (watched,)."""
    root = np.sqrt(np.diag(small.M))
    shifted = small.stiffness(thrust) + small.shift * small.M
    inverse, left, right = scipy.linalg.eig(root[:, None] * np.linalg.solve(shifted, np.diag(root)), left=True)
    W = np.asarray(1 / inverse.real - small.shift)
    scaled = damping_of(small) / np.outer(root, root)
    f = np.einsum("ij,ik,kj->j", left.conj(), scaled, right) / np.einsum("ij,ij->j", left.conj(), right)
    floor = RIGID * small.shift if small.rigid else 0.0
    elastic = np.flatnonzero(floor < W)
    lowest = elastic[np.argsort(W[elastic])[:watched]]
    return W[lowest], f.real[lowest]
