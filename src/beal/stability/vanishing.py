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
from beal.stability.critical import COMPLETE_SPARE, CriticalThrust, critical_thrust
from beal.stability.damped import CLOSEST, FLUTTER, GROWING, Crossing, closest_mode, crossings, distinct
from beal.stability.double_root import CriticalPoint
from beal.stability.imaginary_root import damping_of, vanishing_root
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
        twice. The limit is 0 where a damping feeds a mode under any thrust.

    Raises
    ------
    ModelError
        If the vehicle has no damping, or an option does not apply.
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
        operators = discretise(vehicle, formulation, order=first_order(vehicle, "legendre"))
        plain = reduced(pencil(replace(operators, C=None)), elastic.watched_modes + COMPLETE_SPARE)
        small = reduced(pencil(operators), elastic.watched_modes + COMPLETE_SPARE)
        found = _first_fed(small, limit, elastic.watched_modes)
        if found is None:
            return undamped
        thrust, W = found
        mode = closest_mode(plain, thrust, W, limit)
        nothing = np.empty(0)
        guess = Instability(CriticalPoint(thrust, W, True, 0.0, nothing, nothing), FLUTTER, (mode, mode))
        steps = partial(ladder, vehicle, formulation, "legendre", polish=_polish)
        point, error = refined(guess, steps(guess), tolerance or default_tolerance(vehicle, "legendre"))
    first = replace(
        elastic,
        critical_thrust=point.thrust,
        kind="flutter",
        modes=(mode, mode),
        angular_frequency=float(np.sqrt(point.W)),
        error_estimate=error,
        border=False,
    )
    return first if undamped.elastic is None else replace(undamped, elastic=first)


def _polish(full: Pencil, kind: Kind, thrust: float, W: float) -> CriticalPoint:
    return vanishing_root(full, thrust, W)


def _first_fed(small: Pencil, limit: float, watched: int) -> tuple[float, float] | None:
    """Thrust and W at which a vanishing damping first feeds a mode, below a limit up to which all roots are real."""
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
            return found[start - 1][:2] if start else (0.0, float(W[worst]))
    return None


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
