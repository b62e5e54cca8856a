"""The best design: the largest critical thrust or margin, or the least mass that bears a thrust."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from beal.design.cases import AS_DESIGNED, Case
from beal.design.ranges import thrust_asked
from beal.design.search import Climb, climbed
from beal.design.variables import DesignSpace
from beal.design.worth import Objective, Seen, Task
from beal.discretisation.build import RITZ, Formulation, discretise
from beal.errors import ConvergenceError, ModelError
from beal.stability.complete import Event
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.vehicle.paths import value_at
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]

CONFIRMED, REACHED = 1e-8, 1e-7  # relative error of the confirming search, share of a target that may be missed
ELEMENTS, AGREED = 16, 1e-4  # in each stage, whose error is about 1e-5, and the difference allowed
STEPS_BACK = 12  # designs of a search that are tried, the best first, where the evidence does not agree
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
        Of the case that counts, from the complete search in the polynomial basis.
    second : CriticalThrust or None
        The same in another discretisation, 16 cubic elements a stage; None for the Ritz formulations, whose
        modes are part of what they say.
    active : tuple of Event
        The instabilities that come first, those within 1e-5 of the critical thrust.
    objective : {"critical_thrust", "margin", "mass"}
    start : float
        The objective where the best of the searches began.
    starts, evaluations : int
        Searches, and designs looked at by all of them.
    margin : float or None
        Critical over nominal thrust, less 1; None without a nominal thrust.
    cliff : bool
        Whether less than 1e-3 of the space away the critical thrust was seen to fall by more than 2 %: another
        instability comes first there. It may be so where nobody looked.
    case : str
        Name of the case that counts, whose are ``critical``, ``second``, ``active`` and ``margin``.
    case_thrusts : tuple of float
        Critical thrust of each case, in N.
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
    margin: float | None
    cliff: bool
    case: str
    case_thrusts: tuple[float, ...]


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
    factor: float | None = None,
    cases: Sequence[Case] = (),
    quantile: float = 0.0,
) -> Optimum:
    """The design with the largest critical thrust or margin, or the least mass at which it reaches a target.

    Every step maximises t over a trust region under the linear bounds and P_e + g_e d >= t for each instability e on
    the lists of all, with the derivatives g_e: so modes that tie at the optimum are held together, instead of taking
    turns. A step is kept if the complete list of the new vehicle is better and a sweep of all coordinates finds no
    flutter that the list overlooks. A rejected step, over a cliff, leaves a plane that the next one does not cross;
    other starts, Sobol' points of the space, get round what stops a search. The result is the best of local searches:
    a lower bound on the optimum, never a proof that nothing is better.

    Parameters
    ----------
    space : DesignSpace
    objective : {"critical_thrust", "margin", "mass"}
        The margin is the critical over the nominal thrust, less 1; both may depend on the design.
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
    factor : float, optional
        For the mass: the critical thrust to reach as a multiple of the nominal one.
    cases : sequence of Case
        What a design may turn out as, a `Scenario` or one of `tolerance_cases`, `sample_cases` and `flight_cases`:
        the weakest of them counts, instead of the design itself.
    quantile : float
        Share of the cases that may be weaker than the one that counts.

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
    task = _task(space, objective, target, factor, cases, quantile, formulation, modes)
    if starts < 1 or iterations < 1:
        raise ModelError([("starts", f"at least one search of one step, found {starts} of {iterations}")])
    if start and (missing := sorted(set(space.variables) - set(start))):
        raise ModelError([("start", f"needs a value for each variable; {', '.join(missing)} missing")])
    found: list[Climb] = []
    for number, place in enumerate(_starts(space, start, starts), start=1):
        if climb := climbed(task, place, iterations):
            found.append(climb)
        if progress:
            progress(number, starts)
    if not found:
        raise ModelError([("start", "no vehicle that could be solved at any start")])
    best = max(found, key=lambda climb: climb.worth)
    return _confirmed(task, best, starts, sum(climb.evaluations for climb in found))


def _task(
    space: DesignSpace,
    objective: Objective,
    target: float | None,
    factor: float | None,
    cases: Sequence[Case],
    quantile: float,
    formulation: Formulation,
    modes: int | None,
) -> Task:
    """What is asked, or a refusal of what contradicts itself."""
    if objective not in ("critical_thrust", "margin", "mass"):
        raise ModelError([("objective", f"must be critical_thrust, margin or mass, found {objective!r}")])
    if (objective == "mass") != (target is not None or factor is not None):
        raise ModelError([("target", "goes with the objective mass, and only with it")])
    task = Task(space, objective, target, factor, tuple(cases) or (AS_DESIGNED,), quantile, formulation, modes)
    vehicles = [case.applied(space.vehicle) for case in task.cases]
    if objective == "mass":
        for vehicle in vehicles:
            thrust_asked(vehicle, target, factor)
    elif objective == "margin":
        for vehicle in vehicles:
            task.asked(vehicle)
    if not 0 <= quantile < 1:
        raise ModelError([("quantile", f"must lie between 0 and 1, found {quantile:g}")])
    return task


def _starts(space: DesignSpace, start: Mapping[str, float] | None, starts: int) -> list[Array]:
    given = start or {path: _own(space, path) for path in space.variables}
    points = qmc.Sobol(len(space.variables), scramble=False).random(2 ** math.ceil(math.log2(starts) + 1))
    return [space.nearest(place) for place in (space.shares(given), *points[1:starts])]


def _own(space: DesignSpace, path: str) -> float:
    """The vehicle's own value, brought within the bounds."""
    one = space.variables[path]
    return min(max(value_at(space.vehicle, path), one.low), one.high)


def _confirmed(task: Task, best: Climb, starts: int, evaluations: int) -> Optimum:
    """The best design of a search for which all evidence agrees: on the very edge of a cliff it may not."""
    for seen in reversed(best.trail[-STEPS_BACK:]):
        try:
            return _with_evidence(task, seen, best, starts, evaluations)
        except ConvergenceError as error:
            doubt = error
    raise doubt


def _with_evidence(task: Task, seen: Seen, best: Climb, starts: int, evaluations: int) -> Optimum:
    """A design as the complete search and another discretisation see it."""
    vehicle = task.space.at(seen.place)
    vehicles = [case.applied(vehicle) for case in task.cases]
    search = partial(
        critical_thrust, formulation=task.formulation, modes=task.modes, tolerance=CONFIRMED, method="complete"
    )
    criticals = [search(each) for each in vehicles]
    thrusts = [math.inf if found.critical_thrust is None else found.critical_thrust for found in criticals]
    weakest = int(np.argsort(np.array(thrusts) / seen.asked, kind="stable")[seen.left_out])
    thrust, asked = thrusts[weakest], seen.asked[weakest]
    if thrust == math.inf:
        raise ConvergenceError("the complete search finds no instability of the best design")
    if (swept := task.swept(seen)).first < seen.first:
        early = swept.events[swept.counted[0]][0]
        raise ConvergenceError(f"best design: modes {early.modes} only just meet near {early.thrust:.9g}")
    if task.objective == "mass" and thrust < asked * (1 - REACHED):
        raise ModelError([("target", f"out of reach: {asked:.9g} asked for, {thrust:.9g} is the nearest found")])
    second = None
    if task.formulation not in RITZ:
        second = critical_thrust(discretise(vehicles[weakest], task.formulation, "hermite", ELEMENTS))
        if second.critical_thrust is None or abs(second.critical_thrust / thrust - 1) > AGREED:
            raise ConvergenceError(
                f"best design: critical thrust {thrust:.9g} in polynomials, {second.critical_thrust} in cubic elements"
            )
    nominal = vehicles[weakest].thrust.nominal
    return Optimum(
        task.space.values(seen.place),
        vehicle,
        vehicle.mass,
        criticals[weakest],
        second,
        tuple(event for event in seen.events[weakest] if event.thrust < thrust * (1 + TIE)),
        task.objective,
        abs(best.start) - (task.objective == "margin"),
        starts,
        evaluations,
        thrust / nominal - 1 if nominal else None,
        best.cliff or seen is not best.trail[-1],
        task.cases[weakest].name,
        tuple(thrusts),
    )
