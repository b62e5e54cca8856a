"""The best design: the largest critical thrust, or the least mass that bears a thrust."""

import math
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.stats import qmc

from beal.design.overlooked import overlooked
from beal.design.slopes import slopes
from beal.design.variables import DesignSpace
from beal.discretisation.build import RITZ, Formulation, discretise
from beal.errors import ConvergenceError, ModelError
from beal.stability.complete import Event
from beal.stability.critical import CriticalThrust, critical_events, critical_thrust
from beal.stability.limit import default_limit
from beal.vehicle.paths import value_at
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
Objective = Literal["critical_thrust", "mass"]
Progress = Callable[[int, int], None]

ORDER = 12  # of the matrices whose changes give the slopes, see `critical_events`
WATCHED = 1.5  # times the critical thrust: events up to there may come first after a step
FIRST_STEP, LEAST_STEP, GROWN, SHRUNK = 0.1, 1e-7, 2.0, 0.4  # of the trust region, in the unit cube
MISSED = 20.0  # price of a target missed by its whole, in masses of the space's vehicle
CLIFFS = 12  # rejected steps remembered
GAIN = 1e-4  # share of the worth below which a search does not begin anew
ELEMENTS, AGREED = 16, 1e-4  # in each stage, whose error is about 1e-5, and the difference allowed
TIE = 1e-5  # share of the thrust within which events count as tied


@dataclass(frozen=True)
class Optimum:
    """The best design found.

    Parameters
    ----------
    values : dict of str to float
        The variables, by path.
    vehicle : Vehicle
    mass : float
        Of the vehicle, in kg.
    critical : CriticalThrust
        From the complete search in the polynomial basis.
    second : CriticalThrust or None
        The same in another discretisation, 16 cubic elements a stage; None for the Ritz formulations, whose
        modes are part of what they say.
    active : tuple of Event
        The instabilities that come first, those within 1e-5 of the critical thrust.
    objective : {"critical_thrust", "mass"}
    start : float
        The objective where the best of the searches began.
    starts, evaluations : int
        Searches, and vehicles solved by all of them.
    """

    values: dict[str, float]
    vehicle: Vehicle
    mass: float
    critical: CriticalThrust
    second: CriticalThrust | None
    active: tuple[Event, ...]
    objective: Objective
    start: float
    starts: int
    evaluations: int


def optimise(
    space: DesignSpace,
    objective: Objective = "critical_thrust",
    target: float | None = None,
    start: Mapping[str, float] | None = None,
    starts: int = 1,
    formulation: Formulation = "objective",
    modes: int | None = None,
    iterations: int = 100,
    progress: Progress | None = None,
) -> Optimum:
    """The design with the largest critical thrust, or the least mass at which it reaches a target.

    Every step maximises t over a trust region under the linear bounds and P_e + g_e d >= t for each instability e on
    the list of all, with the derivatives g_e: so modes that tie at the optimum are held together, instead of taking
    turns. A step is kept if the complete list of the new vehicle is better and a sweep of all coordinates finds no
    flutter that the list overlooks. A rejected step, over a cliff, leaves a plane that the next one does not cross;
    other starts, Sobol' points of the space, get round what stops a search. The result is the best of local searches:
    a lower bound on the optimum, never a proof that nothing is better.

    Parameters
    ----------
    space : DesignSpace
    objective : {"critical_thrust", "mass"}
    target : float, optional
        For the mass: critical thrust to reach, in N.
    start : mapping of str to float, optional
        Values of the variables for the first search; by default those of the space's vehicle.
    starts : int
        Searches.
    formulation, modes
        As for `beal.critical_thrust`.
    iterations : int
        Of each search, at most.
    progress : callable, optional
        Called with the searches done and their number.

    Returns
    -------
    Optimum

    Raises
    ------
    ModelError
        If the target is out of reach (the message has the nearest thrust found), or options contradict each other.
    ConvergenceError
        If the complete search or the second discretisation does not confirm the result.

    Examples
    --------
    >>> from beal.design.variables import DesignSpace, Variable
    >>> from beal.vehicle.catalog import beck
    >>> best = optimise(DesignSpace(beck(), {"stage[0].bending_stiffness": Variable(0.5, 2.0)}))
    >>> best.values, round(best.critical.critical_thrust, 5)
    ({'stage[0].bending_stiffness': 2.0}, 40.10191)
    """
    if objective not in ("critical_thrust", "mass"):
        raise ModelError([("objective", f"must be critical_thrust or mass, found {objective!r}")])
    if (objective == "mass") != (target is not None):
        raise ModelError([("target", "goes with the objective mass, and only with it")])
    if target is not None and not 0 < target < math.inf:
        raise ModelError([("target", f"must be a positive thrust, found {target:g}")])
    if starts < 1 or iterations < 1:
        raise ModelError([("starts", f"at least one search of one step, found {starts} of {iterations}")])
    task = _Task(space, objective, target, formulation, modes)
    if start and (missing := sorted(set(space.variables) - set(start))):
        raise ModelError([("start", f"needs a value for each variable; {', '.join(missing)} missing")])
    best: tuple[float, Array, float] | None = None
    for number, place in enumerate(_starts(space, start, starts)):
        found = _climbed(task, place, iterations)
        if found and (best is None or found[0] > best[0]):
            best = found
        if progress:
            progress(number + 1, starts)
    if best is None:
        raise ModelError([("start", "no vehicle that could be solved at any start")])
    return _confirmed(task, best, starts)


class _Task:
    """What a design is worth, and a count of the vehicles looked at."""

    def __init__(
        self,
        space: DesignSpace,
        objective: Objective,
        target: float | None,
        formulation: Formulation,
        modes: int | None,
    ) -> None:
        self.space, self.objective, self.target = space, objective, target
        self.formulation, self.modes = formulation, modes
        self.evaluations = 0

    def events(self, place: Array) -> list[Event] | None:
        """What destabilises the vehicle, in order of thrust; None where it cannot be solved."""
        self.evaluations += 1
        try:
            vehicle = self.space.at(place)
            for limit in (default_limit(vehicle), self.target or 0.0):
                found = critical_events(vehicle, limit, self.formulation, self.modes) if limit else []
                if events := [event for event in found if event.unstable > event.before and event.thrust > 0]:
                    return events
        except (ModelError, ConvergenceError):
            return None
        return []

    def overlooked(self, place: Array, to: float) -> Event | None:
        """Flutter before the first event of the list."""
        if self.space.vehicle.damped:
            return None
        return overlooked(self.space.at(place), to, self.modes or ORDER, self.formulation)

    def worth(self, place: Array, events: list[Event] | None) -> float:
        """The critical thrust, or minus the mass and the price of what is missed: larger is better."""
        if not events:
            return -math.inf
        thrust = events[0].thrust
        if self.target is None:
            return thrust
        return -self.space.at(place).mass - MISSED * self.space.vehicle.mass * max(0.0, 1 - thrust / self.target)


def _starts(space: DesignSpace, start: Mapping[str, float] | None, starts: int) -> list[Array]:
    given = start or {path: _own(space, path) for path in space.variables}
    points = qmc.Sobol(len(space.variables), scramble=False).random(2 ** math.ceil(math.log2(starts) + 1))
    return [space.nearest(place) for place in (space.shares(given), *points[1:starts])]


def _own(space: DesignSpace, path: str) -> float:
    """The vehicle's own value, brought within the bounds."""
    one = space.variables[path]
    return min(max(value_at(space.vehicle, path), one.low), one.high)


def _climbed(task: _Task, place: Array, iterations: int) -> tuple[float, Array, float] | None:
    """Worth, place and first worth of a search."""
    events = task.events(place)
    if events and (early := task.overlooked(place, events[0].thrust)):
        events = [early]
    worth = first = task.worth(place, events)
    if not events:
        return None
    radius, here, cliffs, since = FIRST_STEP, None, deque[_Cut](maxlen=CLIFFS), worth
    for _ in range(iterations):
        if here is None:
            here = _cuts(task, place, [event for event in events if event.thrust < WATCHED * events[0].thrust])
        trial = _step(task, place, here, cliffs, radius)
        seen = task.events(trial)
        value = task.worth(trial, seen)
        if value > worth and seen and (early := task.overlooked(trial, seen[0].thrust)):
            seen = [early]
            value = task.worth(trial, seen)
        if value > worth and seen:
            place, events, worth, here = trial, seen, value, None
            radius = min(GROWN * radius, 0.5)
            continue
        radius *= SHRUNK
        if seen:
            cliffs.extend(_cuts(task, trial, seen[:1]))
        if radius < LEAST_STEP:
            if worth <= since * (1 + math.copysign(GAIN, since)):
                break
            radius, since = FIRST_STEP, worth
            cliffs.clear()
    return worth, place, first


class _Cut(NamedTuple):
    """An instability at a place and how its thrust changes from there."""

    place: Array
    thrust: float
    slope: Array


def _cuts(task: _Task, place: Array, events: Sequence[Event]) -> list[_Cut]:
    found = slopes(events, task.space.at, place, task.modes or ORDER, task.formulation)
    return [_Cut(place, event.thrust, slope) for event, slope in zip(events, found, strict=True)]


def _step(task: _Task, place: Array, here: Sequence[_Cut], cliffs: Sequence[_Cut], radius: float) -> Array:
    """Where a linear programme over a box around the place leads.

    An instability that a rejected step met is a plane that the next one does not cross; the place itself, where it does
    not come first, stays on the right side of it.
    """
    n, space, target = len(place), task.space, task.target
    first = here[0].thrust
    thrust = [cut.thrust for cut in here]
    thrust += [max(cut.thrust + float(cut.slope @ (place - cut.place)), first) for cut in cliffs]
    slope = np.array([cut.slope for cut in (*here, *cliffs)])
    A, b = space.rows()
    within = [(max(-radius, -x), min(radius, 1 - x)) for x in place.tolist()]
    unit = target or first
    if target is None:  # maximise t with P_e + g_e d >= t
        cost, last = np.append(np.zeros(n), -1.0), 1.0
    else:  # least mass, and a price on what is missed
        mass = _mass_slopes(space, place)
        cost, last = np.append(mass / space.vehicle.mass, MISSED), -1.0
    rows = np.column_stack((-slope / unit, np.full(len(slope), last)))
    table = np.vstack((rows, np.column_stack((A, np.zeros(len(A))))))
    limits = np.concatenate((np.array(thrust) / unit - 1, b - A @ place))
    found = linprog(cost, table, limits, bounds=[*within, (None if target is None else 0, None)])
    return place if found.x is None else np.clip(place + found.x[:n], 0.0, 1.0)


def _mass_slopes(space: DesignSpace, place: Array) -> Array:
    step = 1e-6 * np.eye(len(place))
    return np.array([(space.at(place + row).mass - space.at(place - row).mass) / 2e-6 for row in step])


def _confirmed(task: _Task, best: tuple[float, Array, float], starts: int) -> Optimum:
    """The result with its evidence: the complete search, and another discretisation."""
    _, place, first = best
    vehicle = task.space.at(place)
    critical = critical_thrust(vehicle, None, task.formulation, modes=task.modes, tolerance=1e-8, method="complete")
    thrust = critical.critical_thrust
    if thrust is None:
        raise ConvergenceError("the complete search finds no instability of the best design")
    if early := task.overlooked(place, thrust):
        raise ConvergenceError(f"best design: modes {early.modes} only just meet near {early.thrust:.9g}")
    if task.target is not None and thrust < task.target * (1 - 1e-7):
        raise ModelError([("target", f"out of reach: {task.target:.9g} asked for, {thrust:.9g} is the nearest found")])
    second = None
    if task.formulation not in RITZ:
        second = critical_thrust(discretise(vehicle, task.formulation, "hermite", ELEMENTS))
        if second.critical_thrust is None or abs(second.critical_thrust / thrust - 1) > AGREED:
            raise ConvergenceError(
                f"best design: critical thrust {thrust:.9g} in polynomials, {second.critical_thrust} in cubic elements"
            )
    events = task.events(place) or []
    active = tuple(event for event in events if event.thrust < thrust * (1 + TIE))
    values, mass = task.space.values(place), vehicle.mass
    return Optimum(
        values, vehicle, mass, critical, second, active, task.objective, abs(first), starts, task.evaluations
    )
