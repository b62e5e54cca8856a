"""The critical thrust of a vehicle: found by itself, with its kind, its modes and an error estimate."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from beal.discretisation.build import RITZ, BasisName, Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.complete import Event, events
from beal.stability.damped import damped_events, fed_modes, highest_frequency, unloaded, unstable_roots
from beal.stability.dead_loads import check_dead_loads
from beal.stability.double_root import CriticalPoint
from beal.stability.kernels.rules import BORDER
from beal.stability.large import Reduction, is_large
from beal.stability.limit import default_limit
from beal.stability.pencil import CORRECTED, Pencil, corrections, misplaced, pencil, reduced
from beal.stability.refine import LEAST_TOLERANCE, default_tolerance, first_order, ladder, refined, settled
from beal.stability.ridge import Instability, Search, meeting_pair
from beal.stability.threads import one_thread
from beal.stability.zero_roots import FIRST, mechanism, rigid_body_root
from beal.vehicle.vehicle import Vehicle

STEPS = 36  # coarse intervals up to the default limit
WATCHED, SPARE = 8, 3  # elastic modes watched, and kept beyond them in the reduced problem
COMPLETE_SPARE = 2
MOST_DAMPED = 14  # elastic modes of a damped vehicle watched: the time grows with the sixth power


@dataclass(frozen=True)
class CriticalThrust(Shown):
    """The smallest thrust at which a vehicle loses stability.

    Parameters
    ----------
    critical_thrust : float or None
        In N; None if the vehicle is stable up to ``searched_to``.
    kind : {"flutter", "divergence", "stable"}
    modes : tuple of int or None
        The elastic modes that meet, counted from 1 in order of frequency at that thrust; a diverging mode twice; 0
        stands for a rigid-body motion. Damped flutter is that of one mode, named twice: the mode of the same vehicle
        without damping that is closest in frequency at that thrust.
    angular_frequency : float or None
        At the critical thrust, in rad/s.
    error_estimate : float or None
        Of the critical thrust, in N: discretisation and rounding; of the ``corrected-ritz`` and ``as-printed``
        formulations, whose few modes are part of the definition, rounding alone.
    formulation : str
    searched_to : float
        Thrust up to which instability was looked for, in N.
    watched_modes : int
        Number of elastic modes that were looked at; what happens among higher ones is not seen.
    rigid_body : {"neutral", "tumbling", "held"}
        Whether a thrust drives the rigid-body attitude away (``tumbling``), leaves it alone, or the supports hold it.
    border : bool
        Whether another kind of instability, or another pair of modes, comes at practically the same thrust (relative
        difference 1e-6), so that ``kind`` and ``modes`` are those of one side of a border.
    elastic : CriticalThrust or None
        For a vehicle that tumbles, whose critical thrust is 0: what its elastic modes alone would bear.
    units : {"SI", "nondimensional"}
    """

    critical_thrust: float | None
    kind: Literal["flutter", "divergence", "stable"]
    modes: tuple[int, int] | None
    angular_frequency: float | None
    error_estimate: float | None
    formulation: str
    searched_to: float
    watched_modes: int
    rigid_body: Literal["neutral", "tumbling", "held"]
    border: bool = False
    elastic: "CriticalThrust | None" = None
    units: Literal["SI", "nondimensional"] = "SI"


@dataclass(frozen=True)
class _Task:
    """What a search needs to know, resolved."""

    limit: float
    steps: int
    watched: int
    formulation: Formulation


def critical_thrust(
    vehicle: Vehicle | Operators,
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    basis: BasisName = "legendre",
    modes: int | None = None,
    tolerance: float | None = None,
    method: Literal["fast", "complete"] = "fast",
) -> CriticalThrust:
    """The smallest thrust at which the vehicle flutters or diverges.

    Parameters
    ----------
    vehicle : Vehicle or Operators
        For operators their own discretisation is kept and the error estimate covers rounding alone.
    max_thrust : float, optional
        Thrust to search to, in N; by default the one at which a dead load of the same axial force would buckle the
        rigidly jointed vehicle in five half waves.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
        See `beal.discretise`.
    basis : {"legendre", "hermite"}
    modes : int, optional
        Number of modes of the Ritz formulations; refused for the others.
    tolerance : float, optional
        Relative error of the critical thrust to reach; by default 1e-10 for polynomials (1e-9 where
        stages shear, 1e-8 with damping ratios) and 1e-6 for elements, or up to 1e-7 where modes that only just meet
        leave more to rounding: the error estimate says so.
    method : {"fast", "complete"}
        The ridge scan, or all critical thrusts of the reduced problem from one eigenvalue problem. Of a damped vehicle
        always the latter.

    Returns
    -------
    CriticalThrust

    Raises
    ------
    ModelError
        If an option does not apply, or the dead loads alone make the vehicle unstable.
    ConvergenceError
        If the tolerance is not reached.

    Notes
    -----
    The search looks at the lowest modes (``watched_modes``) up to ``searched_to``; an instability among
    higher modes, or one whose growth rate stays below some 1e-5 of its frequency, is not reported. Vehicles of a
    dozen segments and more go by sparse matrices and a reduction, in a time about proportional to their size; of those
    with many soft joints the lowest 32 modes are looked at, of damped ones at most 14. Damping ratios couple everything
    with everything: vehicles that have them go by dense matrices whatever their size.

    A foundation in proportion to the mass lends the translation and the rotation of a free vehicle one frequency.
    Rotation under a follower thrust then drives translation in resonance, in proportion to time, as it lets a vehicle
    without a foundation drift: neither counts as an instability. The least other foundation may flutter early.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> beck = critical_thrust(catalog.beck())
    >>> beck.kind, beck.modes, round(beck.critical_thrust, 7)
    ('flutter', (1, 2), 20.0509536)
    """
    with one_thread():
        if isinstance(vehicle, Operators):
            task = _task(vehicle.vehicle, max_thrust, formulation)
            return _solve(task, vehicle, method, lambda found: settled(found, pencil(vehicle)))
        if modes is not None and formulation not in RITZ:
            raise ModelError(f"modes: applies to {' and '.join(RITZ)} only, found formulation {formulation!r}")
        task = _task(vehicle, max_thrust, formulation)
        if formulation in RITZ:
            operators = discretise(vehicle, formulation, order=modes)
            return _solve(task, operators, method, lambda found: settled(found, pencil(operators)))
        least = 0.0 if tolerance else LEAST_TOLERANCE
        tolerance = tolerance or default_tolerance(vehicle, basis)
        if basis == "legendre" and is_large(vehicle):
            large = Reduction(vehicle, formulation)
            task = replace(task, watched=_watched(large))
            return _solve(
                task, large.operators, method, lambda found: refined(found, large.points(found), tolerance, least)
            )
        operators = discretise(vehicle, formulation, basis, first_order(vehicle, basis))
        points = partial(ladder, vehicle, formulation, basis)
        return _solve(task, operators, method, lambda found: refined(found, points(found), tolerance, least))


def critical_events(
    vehicle: Vehicle | Operators,
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    modes: int | None = None,
) -> list[Event]:
    """All thrusts at which roots become unstable or stable again, in order of thrust.

    Parameters
    ----------
    vehicle : Vehicle or Operators
    max_thrust : float, optional
        In N, by default as for `critical_thrust`.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
    modes : int, optional
        Number of modes of the Ritz formulations.

    Returns
    -------
    list of Event
        From one eigenvalue problem, so none is skipped for the size of a step.

    Raises
    ------
    ModelError
        If an option does not apply, or the dead loads alone make the vehicle unstable.
    """
    with one_thread():
        large = None
        operators = vehicle
        if isinstance(operators, Vehicle):
            if formulation not in RITZ and is_large(operators):
                large = Reduction(operators, formulation)
                operators = large.operators
            else:
                order = modes if formulation in RITZ else max(12, first_order(operators, "legendre"))
                operators = discretise(operators, formulation, order=order)
        task = _task(operators.vehicle, max_thrust, formulation)
        full = pencil(operators)
        watched = _watched(large) if large else task.watched
        small = reduced(full, watched + COMPLETE_SPARE)
        if full.C is None:
            check_dead_loads(small, task.limit)
            found = events(small, task.limit, watched)
            first = found[0].thrust if found else task.limit
            beside = misplaced(full, small, first, watched + small.rigid)
            if beside is not None:
                found = events(reduced(full, watched + COMPLETE_SPARE, beside=beside), task.limit, watched)
        else:
            undamped = _without_damping(operators, watched)
            check_dead_loads(undamped, task.limit, small, highest_frequency(undamped, watched))
            found = damped_events(small, undamped, task.limit, watched)
        if large:
            large.refine()
        polished = []
        for event in found:
            guess = Instability(_start(event.thrust, event.W), event.kind, event.modes)
            point = large.corrected(guess) if large else settled(guess, full)[0]
            polished.append(replace(event, thrust=point.thrust, W=point.W) if point.converged else event)
        return polished


def _task(vehicle: Vehicle, max_thrust: float | None, formulation: Formulation) -> _Task:
    natural = default_limit(vehicle)
    if max_thrust is not None and not (0 < max_thrust < math.inf):
        raise ModelError(f"max_thrust: must be a positive number, found {max_thrust}")
    limit = max_thrust or natural
    if limit > 20 * natural:
        raise ModelError(f"max_thrust: at most {20 * natural:.3g} is resolved for this vehicle, found {limit:.3g}")
    springs = sum(math.isfinite(k) for j in vehicle.joints for k in (j.rotational_stiffness, j.shear_stiffness))
    watched = WATCHED + springs
    if vehicle.damped:
        watched = min(watched, MOST_DAMPED)
    return _Task(limit, math.ceil(STEPS * limit / natural) + 1, watched, formulation)


def _watched(large: Reduction) -> int:
    return min(large.watched, MOST_DAMPED) if large.system.vehicle.damped else large.watched


Refine = Callable[[Instability], tuple[CriticalPoint, float]]


def _solve(task: _Task, operators: Operators, method: str, refine: Refine) -> CriticalThrust:
    if method not in ("fast", "complete"):
        raise ModelError(f"method: must be fast or complete, found {method!r}")
    full = pencil(operators)
    spare = SPARE if method == "fast" else COMPLETE_SPARE
    cheap = method == "fast" and full.C is None  # the other searches grow with the sixth power of the size
    corrected = corrections(operators.vehicle, task.watched) if cheap else CORRECTED
    small = reduced(full, task.watched + spare, corrected)
    drift: str
    if full.C is None:
        drift = rigid_body_root(small, task.limit)
        check_dead_loads(small, task.limit)
        found = _first(task, small, method)
        reached = found.point.thrust if found else task.limit
        beside = misplaced(full, small, reached, task.watched + small.rigid)
        if beside is not None:
            small = reduced(full, task.watched + spare, corrected, beside)
            found = _first(task, small, method)
    else:
        drift, found = _first_damped(task, small, _without_damping(operators, task.watched))
    watched = min(task.watched, len(small.M) - small.rigid)
    rigid_body: Literal["neutral", "tumbling", "held"]
    floats = operators.rigid > 0 or (operators.vehicle.free_free and not operators.vehicle.founded)
    rigid_body = "tumbling" if drift == "tumbling" else "neutral" if floats else "held"
    units = operators.vehicle.units
    nothing = CriticalThrust(
        None, "stable", None, None, None, task.formulation, task.limit, watched, rigid_body, units=units
    )
    result = nothing
    if found:
        point, error = refine(found)
        omega = math.sqrt(max(point.W, 0.0))
        result = replace(
            nothing,
            critical_thrust=point.thrust,
            kind=found.kind,
            modes=found.modes,
            angular_frequency=omega,
            error_estimate=error,
            border=found.border,
        )
    if drift == "tumbling":
        return replace(
            nothing,
            critical_thrust=0.0,
            kind="divergence",
            modes=(0, 0),
            angular_frequency=0.0,
            error_estimate=0.0,
            elastic=result,
        )
    return result


def _first(task: _Task, small: Pencil, method: str) -> Instability | None:
    if kind := mechanism(small, task.limit):
        modes = (1, 1) if kind == "divergence" else meeting_pair(small, 0.0, 0.0)
        return Instability(_start(0.0, 0.0), kind, modes)
    if method == "fast":
        return Search(small, task.limit, task.steps, task.watched).first()
    own = rigid_body_root(small, task.limit) == "tumbling"  # a root that may come back and leave again
    return _first_of(events(small, task.limit, task.watched), own)


def _first_damped(task: _Task, small: Pencil, undamped: Pencil) -> tuple[str, Instability | None]:
    """Where the rigid-body motion goes under the first thrust, and the first instability of a damped pencil."""
    if mechanism(undamped, task.limit):
        return "", _first(task, undamped, "fast")
    top = highest_frequency(undamped, task.watched)
    check_dead_loads(undamped, task.limit, small, top)
    found = damped_events(small, undamped, task.limit, task.watched)
    first = found[0].thrust if found else task.limit
    drift: str = rigid_body_root(undamped, task.limit)
    own = 0
    if small.rigid:
        early = min(FIRST * task.limit, first / 2)
        own = unstable_roots(small, early, top) - 2 * len(fed_modes(small, undamped, early, task.limit, top))
    if fed := fed_modes(small, undamped, first / 2, task.limit, top):  # from the first thrust on
        start = _start(0.0, unloaded(undamped, fed[0]))
        return "tumbling" if own else drift, Instability(start, "flutter", (fed[0], fed[0]))
    return "tumbling" if own else drift, _first_of(found, own)


def _first_of(found: list[Event], own: int) -> Instability | None:
    """The first instability beside a rigid-body motion that has so many unstable roots of its own."""
    for event in found:
        if event.unstable > max(event.before, own if event.kind == "divergence" else 0):
            border = sum(abs(other.thrust - event.thrust) < BORDER * event.thrust for other in found) > 1
            return Instability(_start(event.thrust, event.W), event.kind, event.modes, border)
    return None


def _without_damping(operators: Operators, watched: int) -> Pencil:
    """The reduced pencil of a damped vehicle that has lost its damping."""
    return reduced(pencil(replace(operators, C=None)), watched + COMPLETE_SPARE)


def _start(thrust: float, W: float) -> CriticalPoint:
    """A point to be polished, without eigenvectors."""
    nothing = np.empty(0)
    return CriticalPoint(thrust, W, True, 0.0, nothing, nothing)
