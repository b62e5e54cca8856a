"""Derivatives of the critical thrust and its frequency with respect to every quantity of a vehicle."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

from beal.design.branches import Flown, Slopes, Status, branch, builder, no_slopes, slopes, tied
from beal.design.derivatives import Quantity, bare, changes, quantities_of
from beal.design.touches import Touch, dips, touch
from beal.discretisation.build import Formulation
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.shown import Shown
from beal.stability.complete import Event
from beal.stability.critical import CriticalThrust, critical_events, critical_thrust
from beal.stability.double_root import CriticalPoint
from beal.stability.pencil import acting, pencil
from beal.stability.ridge import Kind
from beal.stability.threads import one_thread
from beal.study.flight import vehicle_at
from beal.vehicle.vehicle import Vehicle

NEAR = 5e-2  # relative distance of another critical thrust within which it is told
ROUNDING = 1e-9  # elasticity that counts as none
LEAST, JUMP = 1e-3, 1e-2  # of the first step from zero, and the relative change of the thrust that no slope explains
TIE = 1e-6  # below which two count as one

Differentiability = Literal["smooth", "near a switch", "near a cliff", "tie"]


@dataclass(frozen=True)
class Parameter:
    """What one quantity does to a critical thrust.

    Parameters
    ----------
    path : str
    value : float
    derivative : float
        Of the critical thrust; nan where there is none. At an infinite stiffness it is 0.
    elasticity : float
        Percent of critical thrust per percent of the quantity.
    frequency_derivative, frequency_elasticity : float
        The same of the angular frequency there.
    status : {"exact", "one-sided", "differenced", "not differentiable"}
        ``one-sided``: the quantity is at its bound. ``differenced``: from critical points on one side, since there the
        vehicle gets a coordinate or a segment that it does not have here. ``not differentiable``: the least damping
        of an undamped vehicle makes its critical thrust jump, as do what sets a diverging vehicle adrift and what
        begins to hold a free one; and a formulation of two equal stages allows no change of one.
    error : float
        How much a formula of lower order changes the derivative.
    compliance_derivative : float, optional
        With respect to 1/value at 0, of an infinite stiffness.
    below, above : float
        Derivatives when the quantity falls and grows, which differ where two instabilities tie.
    """

    path: str
    value: float
    derivative: float
    elasticity: float
    frequency_derivative: float
    frequency_elasticity: float
    status: Status
    error: float
    compliance_derivative: float | None
    below: float
    above: float


@dataclass(frozen=True)
class Rival:
    """Another critical thrust close to the smallest.

    Parameters
    ----------
    event : Event
    distance : float
        Relative to the smallest.
    derivatives : tuple of float
        Of its thrust, in the order of the parameters.
    """

    event: Event
    distance: float
    derivatives: tuple[float, ...]


@dataclass(frozen=True)
class Sensitivity(Shown):
    """Derivatives of a critical thrust.

    Parameters
    ----------
    critical : CriticalThrust
        The one that is differentiated; of a vehicle that tumbles, that of its elastic modes.
    parameters : tuple of Parameter
    status : {"smooth", "near a switch", "near a cliff", "tie"}
        Whether another critical thrust is within 5 %, so that the derivatives hold for small changes only; whether 5 %
        of a quantity would newly bring about one below; or whether another is within 1e-6: then the smallest has a
        kink and each side its own derivative, ``below`` and ``above`` of its parameter.
    rivals : tuple of Rival
    units : {"SI", "nondimensional"}
    touches : tuple of Touch
        What 5 % of a quantity would newly bring about; of damped vehicles nobody looked.
    """

    critical: CriticalThrust
    parameters: tuple[Parameter, ...]
    status: Differentiability
    rivals: tuple[Rival, ...]
    units: Literal["SI", "nondimensional"]
    touches: tuple[Touch, ...] = ()

    @property
    def ranked(self) -> tuple[Parameter, ...]:
        """The parameters with an effect, the largest elasticity first."""
        there = [each for each in self.parameters if abs(each.elasticity) > ROUNDING]
        return tuple(sorted(there, key=lambda each: -abs(each.elasticity)))

    def __getitem__(self, path: str) -> Parameter:
        return {each.path: each for each in self.parameters}[path]


def sensitivity(
    vehicle: Vehicle,
    paths: Iterable[str] | None = None,
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    time: float | None = None,
    critical: CriticalThrust | None = None,
    modes: int | None = None,
) -> Sensitivity:
    """Exact derivatives of the critical thrust and its frequency with respect to quantities of a vehicle.

    A double root W of K(P) x = W M x with left vector y moves by

        P' = - y^T (K' - W M') x / (y^T K1 x)

    a divergence by the same with W = 0; a damped root on the imaginary axis and the frequency follow from the
    equations that they solve.

    Parameters
    ----------
    vehicle : Vehicle
    paths : iterable of str, optional
        By default all that the vehicle has and that may have an effect.
    max_thrust : float, optional
        In N, as for `critical_thrust`.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
    time : float, optional
        In s: of the vehicle as it flies at a time of its timeline.
    critical : CriticalThrust, optional
        The vehicle's, if it is known.
    modes : int, optional
        Number of modes of the last two formulations.

    Returns
    -------
    Sensitivity

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or no critical thrust that could be differentiated.

    Notes
    -----
    The critical thrust is the smallest of many. Where another instability overtakes it, it has a kink; where a pair of
    modes begins or ceases to meet, it jumps. The attribute ``rivals`` tells what is close above, ``touches`` what a
    small change of an undamped vehicle would newly bring about below, to first order.

    Source: Seyranian & Mailybaev (2003), Multiparameter stability theory with mechanical applications.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> found = sensitivity(catalog.beck(), ["stage[0].bending_stiffness", "stage[0].length"])
    >>> [round(each.elasticity, 9) for each in found.parameters]
    [1.0, -2.0]
    """
    quantities = quantities_of(vehicle, paths)
    flown = partial(_flown, time=time)
    now = flown(bare(vehicle))
    discretised = builder(now, formulation, modes)
    with one_thread():
        found = differentiable(critical or critical_thrust(now, max_thrust, formulation, modes=modes))
        rivals = _rivals(now, found, formulation, modes)
        operators = discretised(now)
        same = tied(operators, branch(operators, *guess(found)))
        branches = (*same, *(branch(operators, *guess(each)) for each in rivals))
        rows = [
            no_slopes(branches)
            if each.value == 0 and _jumps(each, flown, found, formulation, modes)
            else slopes(each, branches, lambda moved: discretised(flown(moved)), operators)
            for each in quantities
        ]
        close = _touches(quantities, lambda moved: discretised(flown(moved)), operators, same[0].point.thrust)
    told = tuple(
        Rival(event, event.thrust / same[0].point.thrust - 1, tuple(float(row.fine[n, 0]) for row in rows))
        for n, event in enumerate(rivals, start=len(same))
    )
    level = list(range(1, len(same)))
    level += [
        n for n, each in enumerate(told, start=len(same)) if each.distance < TIE and each.event.change == "destabilises"
    ]
    parameters = tuple(
        _parameter(each.path, each.value, row, same[0].point, level) for each, row in zip(quantities, rows, strict=True)
    )
    status: Differentiability = "tie" if level else "near a cliff" if close else "near a switch" if told else "smooth"
    return Sensitivity(found, parameters, status, told, vehicle.units, close)


def _touches(
    quantities: Sequence[Quantity], build: Callable[[Vehicle], Operators], here: Operators, to: float
) -> tuple[Touch, ...]:
    """The instabilities that a change of one of the quantities by 5 % would newly bring about."""
    problem = partial(pencil, kept=acting(here))
    full = problem(here)
    there = list(dips(full, to))
    if not there:
        return ()
    moves = [next(changes(each, build, here), None) for each in quantities]
    kept = [None if move is None or move.operators[0].C is not None else move.of(problem)[0] for move in moves]
    close = (touch(full, dip, [each.value for each in quantities], kept) for dip in there)
    return tuple(each for each in close if abs(each.nearest) < NEAR)


def guess(found: CriticalThrust | Event) -> tuple[Kind, float, float]:
    """Kind, thrust and angular frequency of a critical point."""
    if isinstance(found, Event):
        return found.kind, found.thrust, math.sqrt(max(found.W, 0.0))
    return found.kind, found.critical_thrust or 0.0, found.angular_frequency or 0.0  # type: ignore[return-value]


def differentiable(found: CriticalThrust) -> CriticalThrust:
    """The critical thrust, or that of the elastic modes alone; refused where there is none."""
    found = found.elastic or found
    if found.critical_thrust is None:
        raise ModelError(f"critical thrust: stable up to {found.searched_to:.6g}, there is nothing to differentiate")
    if found.critical_thrust == 0:
        raise ModelError("critical thrust: unstable at any thrust, there is nothing to differentiate")
    return found


def _flown(vehicle: Vehicle, time: float | None) -> Vehicle:
    return vehicle if time is None else vehicle_at(vehicle, time)


def _jumps(
    quantity: Quantity, flown: Flown, found: CriticalThrust, formulation: Formulation, modes: int | None
) -> bool:
    """Whether the least of a quantity lets another instability come first, as a foundation does that holds nothing."""
    try:
        moved = flown(quantity.moved(LEAST * quantity.step))
        there = critical_thrust(moved, None, formulation, modes=modes, tolerance=JUMP)
    except (ModelError, ConvergenceError):
        return False
    there = there.elastic or there
    here = found.critical_thrust or 0.0
    return there.critical_thrust is None or abs(there.critical_thrust - here) > JUMP * here


def _rivals(vehicle: Vehicle, found: CriticalThrust, formulation: Formulation, modes: int | None) -> list[Event]:
    """The changes of stability next above a critical thrust."""
    thrust = found.critical_thrust or 0.0
    events = critical_events(vehicle, (1 + NEAR) * thrust, formulation, modes)
    others = [event for event in events if event.thrust >= thrust * (1 - TIE)]
    same = min(others, key=lambda event: (abs(event.thrust - thrust), event.kind != found.kind), default=None)
    return [event for event in others if event is not same]


def _parameter(path: str, value: float, row: Slopes, point: CriticalPoint, level: list[int]) -> Parameter:
    """The first branch's derivatives as those of a parameter; of the smallest of all that tie, one to each side."""
    slope, frequency = map(float, row.fine[0])
    compliance = slope if math.isinf(value) else None
    if math.isfinite(compliance or math.nan):
        slope = frequency = 0.0
    omega = math.sqrt(max(point.W, 0.0))
    all_slopes = [slope, *(0.0 if math.isinf(value) else float(row.fine[n, 0]) for n in level)]
    finite = 0.0 if math.isinf(value) else value
    return Parameter(
        path,
        value,
        slope,
        slope * finite / point.thrust,
        frequency,
        frequency * finite / omega if omega else 0.0,
        row.status,
        float(abs(row.fine[0, 0] - row.coarse[0, 0])),
        compliance,
        max(all_slopes),
        min(all_slopes),
    )
