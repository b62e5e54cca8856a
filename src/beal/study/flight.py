"""A vehicle over its flight: as its tanks empty and its stages leave, how far is it from losing stability?"""

import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from beal.errors import ConvergenceError, ModelError
from beal.shown import Shown
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.modes import MOST_MODES, converged_modes
from beal.vehicle.file import read_timeline
from beal.vehicle.separation import attached
from beal.vehicle.timeline import Timeline
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
TOLERANCE = 1e-6  # of margins, relative; each state gives what it reached
COASTS = "coasts: no thrust, no margin"


@dataclass(frozen=True)
class FlightState:
    """A vehicle at one time of its flight.

    Parameters
    ----------
    time, thrust, mass : float
        In s, N and kg.
    stages : tuple of int
        First and last stage attached, counted from 1 at the nose.
    angular_frequency, frequency_error : tuple of float
        Of the lowest elastic modes under this thrust, ascending, and by how much each changed in the last refinement,
        in rad/s; empty where they were not found.
    critical : CriticalThrust or None
        Whatever the thrust of this time; None where it was not found.
    status : {"solved", "not_converged", "invalid"}
        Whether the numerics failed, or the vehicle was refused.
    reason : str
        Why it is not solved or has no margin, or what it would bear if it did not tumble.
    """

    time: float
    thrust: float
    mass: float
    stages: tuple[int, int]
    angular_frequency: tuple[float, ...] = ()
    frequency_error: tuple[float, ...] = ()
    critical: CriticalThrust | None = None
    status: Literal["solved", "not_converged", "invalid"] = "solved"
    reason: str = ""

    @property
    def margin(self) -> float:
        """Critical over actual thrust, less 1; nan where the vehicle coasts or is not solved."""
        if self.critical is None or not self.thrust:
            return math.nan
        borne = self.critical.critical_thrust
        return (self.critical.searched_to if borne is None else borne) / self.thrust - 1

    @property
    def at_least(self) -> bool:
        """Whether the vehicle is stable as far as was searched, so that the margin is a lower bound."""
        return self.critical is not None and self.critical.kind == "stable"


@dataclass(frozen=True)
class Flight(Shown):
    """A vehicle at all times of its timeline.

    Parameters
    ----------
    states : tuple of FlightState
    units : {"SI", "nondimensional"}
    """

    states: tuple[FlightState, ...]
    units: Literal["SI", "nondimensional"]

    @property
    def time(self) -> Array:
        """In s, shape (times,)."""
        return np.array([state.time for state in self.states])

    @property
    def thrust(self) -> Array:
        """In N, shape (times,)."""
        return np.array([state.thrust for state in self.states])

    @property
    def mass(self) -> Array:
        """In kg, shape (times,)."""
        return np.array([state.mass for state in self.states])

    @property
    def angular_frequency(self) -> Array:
        """Under the thrust of each time, in rad/s, shape (times, modes); nan where not found."""
        count = max(len(state.angular_frequency) for state in self.states)
        return np.array([state.angular_frequency or (math.nan,) * count for state in self.states])

    @property
    def critical_thrust(self) -> Array:
        """In N, shape (times,); nan where no instability was found."""
        found = [state.critical and state.critical.critical_thrust for state in self.states]
        return np.array(found, dtype=np.float64)

    @property
    def searched_to(self) -> Array:
        """Thrust up to which instability was looked for, in N, shape (times,)."""
        return np.array([state.critical and state.critical.searched_to for state in self.states], dtype=np.float64)

    @property
    def margin(self) -> Array:
        """Critical over actual thrust, less 1, shape (times,)."""
        return np.array([state.margin for state in self.states])

    @property
    def at_least(self) -> NDArray[np.bool_]:
        """Whether each margin is a lower bound, shape (times,)."""
        return np.array([state.at_least for state in self.states])


def flight(
    vehicle: Vehicle,
    timeline: Timeline | str | os.PathLike[str] | None = None,
    modes: int = 4,
    progress: Callable[[int, int], None] | None = None,
) -> Flight:
    """Frequencies, critical thrust and margin of a vehicle at every time of its flight.

    Each time is a vehicle of its own, with the propellant, the stages and the thrust of that time; how fast they
    change plays no part.

    Parameters
    ----------
    vehicle : Vehicle
    timeline : Timeline or path-like, optional
        Or a table in CSV with the columns ``time``, ``thrust``, ``fill.TANK`` and ``stages``; by default the vehicle's.
    modes : int
        Number of elastic modes whose frequencies are given.
    progress : callable, optional
        Called with the number of times solved and of all times.

    Returns
    -------
    Flight
        A time at which the numerics fail, or at which the vehicle is refused, carries a status and a reason.

    Raises
    ------
    ModelError
        If there is no timeline, or it does not suit the vehicle.

    Examples
    --------
    >>> from beal.vehicle import Stage, Tank
    >>> stage = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
    >>> tank = Tank(name="fuel", forward_end=0.0, aft_end=1.0, mass_per_length=3.0)
    >>> burn = Timeline(time=[0.0, 60.0], thrust=[20.0, 20.0], fill={"fuel": [1.0, 0.0]})
    >>> found = flight(Vehicle(stages=[stage], tanks=[tank]), burn)
    >>> found.mass.tolist(), found.margin.round(6).tolist()
    ([4.0, 1.0], [4.48446, 4.48446])
    """
    if not 1 <= modes <= MOST_MODES:
        raise ModelError(f"modes: must lie between 1 and {MOST_MODES}, found {modes}")
    vehicle = _with_timeline(vehicle, timeline)
    critical = lru_cache(maxsize=1)(partial(critical_thrust, tolerance=TOLERANCE))  # a coasting vehicle stays the same
    states: list[FlightState] = []
    prepared = _prepared(vehicle)
    for state, each in prepared:
        states.append(_solved(state, each, modes, critical))
        if progress:
            progress(len(states), len(prepared))
    return Flight(tuple(states), vehicle.units)


def vehicle_at(vehicle: Vehicle, time: float) -> Vehicle:
    """The vehicle as it flies at one time of its timeline; at a step, such as a separation, just after it.

    Parameters
    ----------
    vehicle : Vehicle
    time : float
        In s, one of the timeline's.

    Returns
    -------
    Vehicle
        Of the stages attached, with the tanks as full as they are then.

    Raises
    ------
    ModelError
        If there is no timeline, or it does not list the time.
    """
    line = vehicle.timeline
    if line is None:
        raise ModelError([("timeline", "is needed and missing; give [timeline] or leave the time out")])
    if time not in line.time:
        nearest = min(line.time, key=lambda listed: abs(listed - time))
        raise ModelError([("timeline.time", f"does not list {time:.12g}; the nearest is {nearest:.12g}")])
    index = len(line.time) - 1 - line.time[::-1].index(time)
    first, last = line.attached(index) or (1, len(vehicle.stages))
    return attached(_filled(vehicle, index), first, last)


def _with_timeline(vehicle: Vehicle, timeline: Timeline | str | os.PathLike[str] | None) -> Vehicle:
    if timeline is None or isinstance(timeline, Timeline):
        return vehicle.model_copy(update={"timeline": timeline}) if timeline else vehicle
    fields = read_timeline(timeline, vehicle.units)
    try:
        return vehicle.model_copy(update={"timeline": fields})
    except ModelError as error:
        raise ModelError(error.problems, str(timeline)) from None


def _prepared(vehicle: Vehicle) -> list[tuple[FlightState, Vehicle]]:
    """Each time of the timeline, not solved yet, with its vehicle."""
    line = vehicle.timeline
    if line is None:
        raise ModelError([("timeline", "is needed and missing; give [timeline] or a table")])
    found: list[tuple[FlightState, Vehicle]] = []
    problems: dict[tuple[str, str], str] = {}  # and the first time of each
    for index, (time, thrust) in enumerate(zip(line.time, line.thrust, strict=True)):
        first, last = line.attached(index) or (1, len(vehicle.stages))
        try:
            each = attached(_filled(vehicle, index), first, last)
            found.append((FlightState(time, thrust, each.mass, (first, last)), each))
        except ModelError as error:
            for problem in error.problems:
                problems.setdefault(problem, f"timeline.stages[{index}]")
    if problems:
        raise ModelError([(f"{place}, {path}", message) for (path, message), place in problems.items()])
    return found


def _filled(vehicle: Vehicle, index: int) -> Vehicle:
    """The vehicle with its tanks as full as the timeline says."""
    fill = vehicle.timeline.fill if vehicle.timeline else {}
    tanks = [
        tank.model_copy(update={"fill": fill[tank.name][index]}) if tank.name in fill else tank
        for tank in vehicle.tanks
    ]
    return vehicle.model_copy(update={"tanks": tanks, "timeline": None})


def _solved(
    state: FlightState, vehicle: Vehicle, modes: int, critical: Callable[[Vehicle], CriticalThrust]
) -> FlightState:
    """A state with its frequencies and its critical thrust, or the reason why not."""
    try:
        spectrum, error = converged_modes(vehicle, state.thrust, modes)
        frequencies, errors = np.sort(spectrum.angular_frequency), () if error is None else error
        state = replace(
            state, angular_frequency=tuple(map(float, frequencies)), frequency_error=tuple(map(float, errors))
        )
        found = critical(vehicle)
    except ConvergenceError as failure:
        return replace(state, status="not_converged", reason=str(failure))
    except ModelError as failure:
        return replace(state, status="invalid", reason=str(failure))
    return replace(state, critical=found, reason=_tumbling(found) if state.thrust else COASTS)


def _tumbling(found: CriticalThrust) -> str:
    """What the elastic modes of a vehicle bear that tumbles as a rigid body."""
    if found.elastic is None:
        return ""
    alone = found.elastic.critical_thrust
    borne = f"are stable up to {found.elastic.searched_to:.6g}" if alone is None else f"bear {alone:.6g}"
    return f"tumbles under any thrust; its elastic modes alone {borne}"
