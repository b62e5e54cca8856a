"""The critical thrust of a vehicle: found by itself, with its kind, its modes and an error estimate."""

import math
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

import numpy as np
from numpy.polynomial.legendre import leggauss
from threadpoolctl import ThreadpoolController

from beal.discretisation.axial import axial_force
from beal.discretisation.basis import segments
from beal.discretisation.build import RITZ, BasisName, Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.complete import Event, events
from beal.stability.double_root import CriticalPoint, coalescence, divergence
from beal.stability.pencil import Pencil, pencil, reduced
from beal.stability.ridge import Instability, Kind, Search, meeting_pair
from beal.stability.zero_roots import mechanism, rigid_body_root
from beal.vehicle.vehicle import Vehicle

HALF_WAVES = 5  # of the buckling shape whose thrust ends the search by default
STEPS = 36  # coarse intervals up to there
WATCHED, SPARE = 8, 3  # elastic modes watched, and kept beyond them in the reduced problem
COMPLETE_SPARE = 2
FIRST_ORDER = {"legendre": 8, "hermite": 8}
LAST_ORDER = {"legendre": 26, "hermite": 64}
FALLING = 0.3  # ratio of successive corrections below which they count as a geometric sequence
SAMPLED = 3  # times the larger of two differences that are rounding, which the error may well be
TOLERANCE = {"legendre": 1e-10, "hermite": 1e-6}


@dataclass(frozen=True)
class CriticalThrust:
    """The smallest thrust at which a vehicle loses stability.

    Parameters
    ----------
    critical_thrust : float or None
        In N; None if the vehicle is stable up to ``searched_to``.
    kind : {"flutter", "divergence", "stable"}
    modes : tuple of int or None
        The elastic modes that meet, counted from 1 in order of frequency at that thrust; a diverging mode twice; 0
        stands for a rigid-body motion.
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
    elastic : CriticalThrust or None
        For a vehicle that tumbles, whose critical thrust is 0: what its elastic modes alone would bear.
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
    elastic: "CriticalThrust | None" = None


@dataclass(frozen=True)
class _Task:
    """What a search needs to know, resolved."""

    vehicle: Vehicle
    limit: float
    steps: int
    watched: int
    formulation: Formulation
    basis: BasisName


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
        Relative error of the critical thrust to reach; by default 1e-10 for polynomials and 1e-6 for elements.
    method : {"fast", "complete"}
        The ridge scan, or all critical thrusts of the reduced problem from one eigenvalue problem.

    Returns
    -------
    CriticalThrust

    Raises
    ------
    ModelError
        If an option does not apply.
    ConvergenceError
        If the tolerance is not reached.

    Notes
    -----
    Undamped. The search looks at the lowest modes (``watched_modes``) up to ``searched_to``; an instability among
    higher modes, or one whose growth rate stays below some 1e-5 of its frequency, is not reported.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> beck = critical_thrust(catalog.beck())
    >>> beck.kind, beck.modes, round(beck.critical_thrust, 7)
    ('flutter', (1, 2), 20.0509536)
    """
    with one_thread():
        if isinstance(vehicle, Operators):
            task = _task(vehicle.vehicle, max_thrust, formulation, basis)
            return _solve(task, vehicle, method, lambda found: _settled(found, pencil(vehicle)))
        if modes is not None and formulation not in RITZ:
            raise ModelError(f"modes: applies to {' and '.join(RITZ)} only, found formulation {formulation!r}")
        task = _task(vehicle, max_thrust, formulation, basis)
        if formulation in RITZ:
            operators = discretise(vehicle, formulation, order=modes)
            return _solve(task, operators, method, lambda found: _settled(found, pencil(operators)))
        operators = discretise(vehicle, formulation, basis, FIRST_ORDER[basis])
        return _solve(task, operators, method, lambda found: _refined(task, found, tolerance or TOLERANCE[basis]))


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
    """
    with one_thread():
        operators = vehicle
        if isinstance(operators, Vehicle):
            operators = discretise(operators, formulation, order=modes if formulation in RITZ else 12)
        task = _task(operators.vehicle, max_thrust, formulation, "legendre")
        full = pencil(operators)
        small = reduced(full, task.watched + COMPLETE_SPARE)
        polished = []
        for event in events(small, task.limit, task.watched):
            point = _settled(Instability(_start(event), event.kind, event.modes), full)[0]
            polished.append(replace(event, thrust=point.thrust, W=point.W) if point.converged else event)
        return polished


def default_limit(vehicle: Vehicle) -> float:
    """Thrust, in N, at which a dead load would buckle the rigidly jointed vehicle in five half waves (WKB).

    integral of sqrt(N/EI) dx = 5 pi, with N = P n(x).
    """
    xi, weight = leggauss(8)
    phase = 0.0
    for segment in segments(vehicle):
        stations = segment.start + segment.length * (1 + xi) / 2
        stiffness = vehicle.stages[segment.stage].bending_stiffness
        phase += segment.length / 2 * float(weight @ np.sqrt(axial_force(vehicle, stations) / stiffness))
    return (HALF_WAVES * math.pi / phase) ** 2


def _task(vehicle: Vehicle, max_thrust: float | None, formulation: Formulation, basis: BasisName) -> _Task:
    natural = default_limit(vehicle)
    if max_thrust is not None and not (0 < max_thrust < math.inf):
        raise ModelError(f"max_thrust: must be a positive number, found {max_thrust}")
    limit = max_thrust or natural
    if limit > 20 * natural:
        raise ModelError(f"max_thrust: at most {20 * natural:.3g} is resolved for this vehicle, found {limit:.3g}")
    springs = sum(math.isfinite(k) for j in vehicle.joints for k in (j.rotational_stiffness, j.shear_stiffness))
    return _Task(vehicle, limit, math.ceil(STEPS * limit / natural) + 1, WATCHED + springs, formulation, basis)


Refine = Callable[[Instability], tuple[CriticalPoint, float]]


def _solve(task: _Task, operators: Operators, method: str, refine: Refine) -> CriticalThrust:
    full = pencil(operators)
    spare = SPARE if method == "fast" else COMPLETE_SPARE
    small = reduced(full, task.watched + spare)
    drift = rigid_body_root(small, task.limit)
    found = _first(task, small, method)
    watched = min(task.watched, len(small.M) - small.rigid)
    rigid_body: Literal["neutral", "tumbling", "held"]
    rigid_body = "tumbling" if drift == "tumbling" else "neutral" if _floats(operators) else "held"
    nothing = CriticalThrust(None, "stable", None, None, None, task.formulation, task.limit, watched, rigid_body)
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
        )
    if drift == "tumbling":
        zero = dict(critical_thrust=0.0, modes=(0, 0), angular_frequency=0.0, error_estimate=0.0)
        return replace(nothing, kind="divergence", elastic=result, **zero)  # type: ignore[arg-type]
    return result


def _floats(operators: Operators) -> bool:
    vehicle = operators.vehicle
    return operators.rigid > 0 or vehicle.free_free


def _first(task: _Task, small: Pencil, method: str) -> Instability | None:
    if method not in ("fast", "complete"):
        raise ModelError(f"method: must be fast or complete, found {method!r}")
    if kind := mechanism(small, task.limit):
        modes = (1, 1) if kind == "divergence" else meeting_pair(small, 0.0, 0.0)
        return Instability(_start(Event(0.0, 0.0, kind, modes, 1, 0)), kind, modes)
    if method == "fast":
        return Search(small, task.limit, task.steps, task.watched).first()
    own = rigid_body_root(small, task.limit) == "tumbling"  # a root that may come back and leave again
    for event in events(small, task.limit, task.watched):
        if event.unstable > max(event.before, own and event.kind == "divergence"):
            return Instability(_start(event), event.kind, event.modes)
    return None


def _start(event: Event) -> CriticalPoint:
    nothing = np.empty(0)
    return CriticalPoint(event.thrust, event.W, True, 0.0, nothing, nothing)


def _polish(full: Pencil, kind: Kind, thrust: float, W: float) -> CriticalPoint:
    if kind == "flutter":
        return coalescence(full, thrust, W)
    return divergence(full, thrust, rigid_body_root(reduced(full), thrust) == "neutral")


def _settled(found: Instability, full: Pencil) -> tuple[CriticalPoint, float]:
    """The critical point of one discretisation, with what rounding leaves uncertain."""
    if found.point.thrust == 0.0:  # a mechanism
        return found.point, 0.0
    point = _polish(full, found.kind, found.point.thrust, found.point.W)
    return point, point.uncertainty


def _refined(task: _Task, found: Instability, tolerance: float) -> tuple[CriticalPoint, float]:
    """The critical point as the discretisation is refined until its own estimate meets the tolerance."""
    if found.point.thrust == 0.0:
        return found.point, 0.0
    thrusts: list[float] = []
    error = math.inf
    for point in _ladder(task, found):
        thrusts.append(point.thrust)
        if len(thrusts) < 3:
            continue
        before, last = abs(thrusts[-2] - thrusts[-3]), abs(thrusts[-1] - thrusts[-2])
        error = _remaining(before, last, point.uncertainty) + point.uncertainty
        if error <= tolerance * point.thrust:
            return point, error
    raise ConvergenceError(
        f"critical thrust {point.thrust:.9g}: relative error {error / point.thrust:.1e} with the finest "
        f"discretisation, {tolerance:.1e} was asked for; ask for less"
    )


def _remaining(before: float, last: float, rounding: float) -> float:
    """Error left after two successive corrections: that of a geometric sequence, or of rounding, sampled twice."""
    if last >= FALLING * before:
        return SAMPLED * max(last, before)
    return last * last / before if last > rounding else SAMPLED * last


def _ladder(task: _Task, found: Instability) -> Iterator[CriticalPoint]:
    """The critical point in finer and finer discretisations, each started from the one before."""
    thrust, W = found.point.thrust, found.point.W
    order = FIRST_ORDER[task.basis]
    coarse = None
    while order <= LAST_ORDER[task.basis]:
        full = pencil(discretise(task.vehicle, task.formulation, task.basis, order))
        point = _polish(full, found.kind, thrust, W)
        if not point.converged:
            raise ConvergenceError(f"critical thrust near {thrust:.9g}: lost when the discretisation was refined")
        thrust, W = point.thrust, point.W
        if task.basis == "legendre":
            order += 2
            yield point
        else:
            order *= 2  # errors fall with the fourth power of the element: Richardson
            if coarse is not None:
                extrapolated = (thrust + (thrust - coarse.thrust) / 15, W + (W - coarse.W) / 15)
                yield replace(point, thrust=extrapolated[0], W=extrapolated[1])
            coarse = point


@cache
def _controller() -> ThreadpoolController:
    return ThreadpoolController()


def one_thread() -> AbstractContextManager[object]:
    """Small matrices are slower on two threads than on one."""
    return _controller().limit(limits=1, user_api="blas")
