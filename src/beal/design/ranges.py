"""Inverse design: the values of one quantity that keep the critical thrust at a target or above."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.build import Formulation
from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import critical_thrust
from beal.stability.kernels.rules import STABLE
from beal.stability.table import SPRING_PATH, reference
from beal.study.solve import solve_points
from beal.study.study import Solve, Study
from beal.study.variables import STATUS
from beal.vehicle.links import Link
from beal.vehicle.paths import value_at
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
Edge = Literal["end", "crossing", "jump", "unsolved"]

BEYOND = 1.27  # times the target: searched to, so that an edge tells a jump from a crossing
HALVINGS = 28  # of a cell of the scan: to 4e-9 of it
METHODS: tuple[Literal["fast", "complete"], ...] = ("fast", "complete")  # the quick one may step over a cliff
LOOSE = 1e-6  # relative error allowed at a border, where roots meet
JUMP = 1e-4  # change of the thrust over such a width, as a share of the target, that no slope explains


@dataclass(frozen=True)
class AllowedInterval:
    """Values over which the target holds.

    Parameters
    ----------
    low, high : float
        The outermost values at which it was seen to hold; infinite for a rigid joint.
    low_edge, high_edge : {"end", "crossing", "jump", "unsolved"}
        What bounds the interval there: the range asked for; the critical thrust falling through the target; the
        critical thrust falling at once, where another instability comes first; a vehicle that could not be solved.
    low_kind, high_kind : str
        Which instability comes first just outside, "" at an end of the range.
    """

    low: float
    high: float
    low_edge: Edge
    high_edge: Edge
    low_kind: str = ""
    high_kind: str = ""


@dataclass(frozen=True)
class AllowedRange:
    """The values of a quantity at which a vehicle bears a thrust.

    Parameters
    ----------
    path : str
    target : float
        Critical thrust asked for, in N.
    intervals : tuple of AllowedInterval
        In ascending order; empty where the target is out of reach.
    best_value, best_thrust : float
        The largest critical thrust of the scan and where it is; infinite if it lies beyond what was searched,
        a quarter above the target.
    points : int
        Of the scan.
    unsolved : int
        Points of the scan that could not be solved and do not count as allowed.
    """

    path: str
    target: float
    intervals: tuple[AllowedInterval, ...]
    best_value: float
    best_thrust: float
    points: int
    unsolved: int

    @property
    def sufficient(self) -> float | None:
        """The least value from which on the target holds up to the end of the range; None if it does not."""
        last = self.intervals[-1] if self.intervals else None
        return last.low if last and last.high_edge == "end" else None


def allowed_range(
    vehicle: Vehicle,
    path: str,
    low: float,
    high: float,
    target: float | None = None,
    factor: float | None = None,
    spacing: Literal["linear", "log"] = "linear",
    points: int = 101,
    formulation: Formulation = "objective",
    modes: int | None = None,
    links: Mapping[str, Link] | None = None,
) -> AllowedRange:
    """All values of a quantity between two ends that keep the critical thrust at a target or above.

    The critical thrust need not rise or fall with the quantity, and it jumps where another kind of instability or
    another pair of modes comes first. So the range is scanned, each change of the answer is halved down to 4e-9 of a
    cell, and the complete search confirms both sides of it. Missed is what lies between two neighbours of the scan that
    give the same answer, such as a gap narrower than a cell; give more points where that matters.

    Parameters
    ----------
    vehicle : Vehicle
    path : str
        Of the quantity, such as ``joint[0].rotational_stiffness``, ``stage.split`` or ``stage[1].bending_stiffness``.
    low, high : float
        Ends of the range. For a spring of a joint, ``high`` may be infinite: the scan is then even in its compliance,
        from a hinge or slide to a rigid joint.
    target : float, optional
        Thrust that the vehicle has to bear, in N.
    factor : float, optional
        The same, as a multiple of the vehicle's nominal thrust.
    spacing : {"linear", "log"}
        Of the scan; of no account where ``high`` is infinite.
    points : int
        Of the scan.
    formulation, modes
        As for `beal.critical_thrust`.
    links : mapping of str to Link, optional
        By the path of a quantity that follows this one.

    Returns
    -------
    AllowedRange

    Raises
    ------
    ModelError
        If the ends, the target or the path do not fit.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> spring = "joint[0].rotational_stiffness"
    >>> found = allowed_range(tsto(0.6, 10.0, 1e4), spring, 0.0, float("inf"), target=90.0, points=21)
    >>> [(round(interval.low, 4), interval.high, interval.low_edge) for interval in found.intervals]
    [(11.0238, inf, 'jump')]
    """
    goal = thrust_asked(vehicle, target, factor)
    value_at(vehicle, path)
    place = _Place(vehicle, path, low, high, spacing)
    if points < 2:
        raise ModelError([("points", f"must be 2 or more, found {points}")])
    ends = (low, high)
    study = Study(vehicle, {path: ends}, Solve(BEYOND * goal, 1e-8, formulation, modes), links or {})
    scan = np.linspace(0.0, 1.0, points)
    thrust = _scanned(study, place(scan))
    holds = thrust >= goal
    edges = _edges(study, place, scan, holds, goal)
    best = int(np.nanargmax(np.where(np.isnan(thrust), -1.0, thrust)))
    return AllowedRange(
        path,
        goal,
        tuple(_intervals(edges, ends, holds)),
        float(place(scan[best])),
        float(thrust[best]),
        points,
        int(np.isnan(thrust).sum()),
    )


def thrust_asked(vehicle: Vehicle, target: float | None, factor: float | None) -> float:
    """The thrust that a vehicle has to bear, given in N or as a multiple of its nominal thrust."""
    if (target is None) == (factor is None):
        raise ModelError([("target", "give either a target thrust or a factor on the nominal thrust")])
    nominal = vehicle.thrust.nominal
    if target is None and nominal is None:
        raise ModelError([("factor", "needs the vehicle's nominal thrust, thrust.nominal; found none")])
    goal = target if target is not None else (factor or 0.0) * (nominal or 0.0)
    if not 0 < goal < math.inf:
        raise ModelError([("target", f"must be a positive thrust, found {goal:g}")])
    return goal


class _Place:
    """From shares of the range to values of the quantity."""

    def __init__(self, vehicle: Vehicle, path: str, low: float, high: float, spacing: str) -> None:
        if not low < high:
            raise ModelError([(path, f"contradictory bounds: from {low:g} to {high:g}; the first must be the lower")])
        if not math.isfinite(low):
            raise ModelError([(path, f"the lower end must be finite, found {low:g}")])
        if math.isinf(high) and not SPRING_PATH.fullmatch(path):
            raise ModelError([(path, "the upper end may be infinite for the springs of joints only")])
        if spacing not in ("linear", "log"):
            raise ModelError([("spacing", f"must be linear or log, found {spacing!r}")])
        if spacing == "log" and low <= 0 and math.isfinite(high):
            raise ModelError([(path, f"a log spacing needs positive ends, found {low:g} to {high:g}")])
        self.low, self.high, self.spacing = low, high, spacing
        self.unit = reference(vehicle, path) if math.isinf(high) else 1.0

    def __call__(self, share: Array | float) -> Array:
        low, high = self.low, self.high
        if math.isinf(high):  # even in the compliance 1/(1 + k/unit)
            with np.errstate(divide="ignore"):
                return (low + self.unit) / np.subtract(1, share) - self.unit
        inside = low * (high / low) ** share if self.spacing == "log" else low + (high - low) * share
        return np.clip(inside, low, high)


def _scanned(study: Study, values: Array) -> Array:
    """Critical thrust, infinite where none was found and NaN where it is unknown; by the quick search where it can."""
    found = solve_points(study, values[:, None])
    thrust = np.where(found["kind"] == STABLE, math.inf, found["critical_thrust"])
    thrust[found["status"] != STATUS.index("solved")] = math.nan
    for point in np.flatnonzero(found["status"] == STATUS.index("not_converged")):
        thrust[point], _ = _searched(study, values[point], "complete")
    return thrust


def _searched(study: Study, value: Array | float, method: Literal["fast", "complete"]) -> tuple[float, str]:
    """Critical thrust and kind of one vehicle."""
    how = study.solve
    try:
        found = critical_thrust(
            study.at([float(value)]), how.max_thrust, how.formulation, modes=how.modes, tolerance=LOOSE, method=method
        )
    except ConvergenceError:
        return (math.nan, "") if method == "complete" else _searched(study, value, "complete")
    except ModelError:
        return math.nan, ""
    return math.inf if found.critical_thrust is None else found.critical_thrust, found.kind


@dataclass(frozen=True)
class _Change:
    """Where the answer changes: a value at which the target holds, what bounds it, the instability beyond."""

    value: float
    edge: Edge
    kind: str


def _edges(study: Study, place: _Place, scan: Array, holds: NDArray[np.bool_], goal: float) -> list[_Change]:
    """Halves every cell of the scan over which the answer changes."""
    cells = np.flatnonzero(holds[1:] != holds[:-1])
    found = []
    for cell in cells:
        ends = (scan[cell + 1], scan[cell]) if holds[cell + 1] else (scan[cell], scan[cell + 1])
        for method in METHODS:
            good, bad = _halved(study, place, goal, ends, method)
            (above, _), (below, kind) = (_searched(study, place(share), "complete") for share in (good, bad))
            if above >= goal and not below >= goal:
                break
        edge: Edge = "unsolved" if math.isnan(below) else "jump" if above - below > JUMP * goal else "crossing"
        found.append(_Change(float(place(good)), edge, kind))
    return found


def _halved(
    study: Study, place: _Place, goal: float, ends: tuple[float, float], method: Literal["fast", "complete"]
) -> tuple[float, float]:
    """Neighbouring shares of the range at which the target holds and does not."""
    good, bad = ends
    for _ in range(HALVINGS):
        middle = (good + bad) / 2
        if _searched(study, place(middle), method)[0] >= goal:
            good = middle
        else:
            bad = middle
    return good, bad


def _intervals(edges: list[_Change], ends: tuple[float, float], holds: NDArray[np.bool_]) -> list[AllowedInterval]:
    changes = list(edges)
    if holds[0]:
        changes.insert(0, _Change(ends[0], "end", ""))
    if holds[-1]:
        changes.append(_Change(ends[1], "end", ""))
    return [
        AllowedInterval(first.value, last.value, first.edge, last.edge, first.kind, last.kind)
        for first, last in zip(changes[::2], changes[1::2], strict=True)
    ]
