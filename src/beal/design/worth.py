"""What a design is worth: what destabilises it in every case that counts, against a thrust, and its mass."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beal.design.branches import branch, slopes
from beal.design.cases import AS_DESIGNED, Case
from beal.design.derivatives import mass, slope
from beal.design.overlooked import overlooked
from beal.design.sensitivity import guess
from beal.design.variables import DesignSpace
from beal.discretisation.build import Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.complete import Event
from beal.stability.critical import critical_events
from beal.stability.limit import default_limit
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
Objective = Literal["critical_thrust", "margin", "mass"]

ORDER = 12  # of the matrices whose changes give the slopes, see `critical_events`
WATCHED = 1.5  # times the ratio that counts: events up to there may come first after a step
MISSED = 20.0  # price of a target missed by its whole, in masses of the space's vehicle


class Cut(NamedTuple):
    """An instability at a place, as a ratio to the thrust that is asked for, and how it changes from there."""

    place: Array
    ratio: float
    slope: Array


@dataclass(frozen=True)
class Seen:
    """A design and what destabilises it.

    Parameters
    ----------
    place : ndarray, shape (variables,)
        In the unit cube of the space.
    mass : float
    events : tuple of tuple of Event
        Of each case, in order of thrust.
    asked : tuple of float
        The thrust that each case is measured by.
    left_out : int
        Number of the weakest cases that do not count.
    """

    place: Array
    mass: float
    events: tuple[tuple[Event, ...], ...]
    asked: tuple[float, ...]
    left_out: int

    @property
    def ratios(self) -> Array:
        """The first instability of each case over the thrust asked for; infinite where there is none."""
        firsts = [events[0].thrust if events else math.inf for events in self.events]
        return np.array(firsts) / self.asked

    @property
    def counted(self) -> list[int]:
        """The cases that count, the weakest first."""
        return np.argsort(self.ratios, kind="stable")[self.left_out :].tolist()

    @property
    def first(self) -> float:
        """The ratio of the weakest case that counts."""
        return float(self.ratios[self.counted[0]])


@dataclass(frozen=True)
class Task:
    """What is asked of a design.

    Parameters
    ----------
    space : DesignSpace
    objective : {"critical_thrust", "margin", "mass"}
    target : float or None
        For the mass, in N.
    factor : float or None
        The same, on the nominal thrust.
    cases : sequence of Case
    quantile : float
        Share of the cases that may be weaker.
    formulation : str
    modes : int or None
    """

    space: DesignSpace
    objective: Objective = "critical_thrust"
    target: float | None = None
    factor: float | None = None
    cases: Sequence[Case] = (AS_DESIGNED,)
    quantile: float = 0.0
    formulation: Formulation = "objective"
    modes: int | None = None

    def asked(self, vehicle: Vehicle) -> float:
        """The thrust by which a case's vehicle is measured: 1 N, its nominal thrust, or what it has to bear."""
        if self.objective == "critical_thrust" or self.target is not None:
            return self.target or 1.0
        nominal = vehicle.thrust.nominal
        if not nominal:
            raise ModelError([("thrust.nominal", "is needed for a margin or a factor and missing")])
        return nominal * (self.factor or 1.0)

    def seen(self, place: Array) -> Seen | None:
        """The design at a place; None where a case cannot be solved."""
        try:
            vehicle = self.space.at(place)
            vehicles = [case.applied(vehicle) for case in self.cases]
            events = tuple(self._events(each) for each in vehicles)
            asked = tuple(map(self.asked, vehicles))
        except (ModelError, ConvergenceError):
            return None
        found = Seen(place, vehicle.mass, events, asked, int(self.quantile * len(vehicles)))
        return found if math.isfinite(found.first) else None

    def _events(self, vehicle: Vehicle) -> tuple[Event, ...]:
        for limit in (default_limit(vehicle), self.asked(vehicle) if self.objective == "mass" else 0.0):
            found = critical_events(vehicle, limit, self.formulation, self.modes) if limit else []
            if events := tuple(event for event in found if event.unstable > event.before and event.thrust > 0):
                return events
        return ()

    def swept(self, seen: Seen) -> Seen:
        """The same with flutter of modes that only just meet, which the lists overlook."""
        if self.space.vehicle.damped:
            return seen
        vehicle, events = self.space.at(seen.place), list(seen.events)
        for number in seen.counted:
            if events[number]:
                to = events[number][0].thrust
                early = overlooked(self.cases[number].applied(vehicle), to, self.modes or ORDER, self.formulation)
                events[number] = (early,) if early else events[number]
        return replace(seen, events=tuple(events))

    def worth(self, seen: Seen | None) -> float:
        """The ratio, or minus the mass and the price of what is missed: larger is better."""
        if seen is None:
            return -math.inf
        if self.objective != "mass":
            return seen.first
        return -seen.mass - MISSED * self.space.vehicle.mass * max(0.0, 1 - seen.first)

    def cuts(self, seen: Seen, up_to: float = WATCHED) -> list[Cut]:
        """The instabilities of the cases that count, up to a multiple of the ratio that counts, with their slopes."""
        found = []
        for number in seen.counted:
            events = [each for each in seen.events[number] if each.thrust <= up_to * seen.first * seen.asked[number]]
            if events:
                found += self._cuts(seen, number, events)
        return found

    def _cuts(self, seen: Seen, number: int, events: Sequence[Event]) -> list[Cut]:
        case, asked = self.cases[number].applied, seen.asked[number]
        how = partial(discretise, formulation=self.formulation, order=self.modes or ORDER)

        def build(vehicle: Vehicle) -> Operators:
            return how(case(vehicle))

        here = build(self.space.at(seen.place))
        branches = [branch(here, *guess(event)) for event in events]
        sides = self.space.coordinates(seen.place)
        thrusts = np.array([slopes(side, branches, build, here).fine[:, 0] for side in sides])
        thrusts[np.isnan(thrusts)] = 0.0  # no plane tells of a jump, such as that of the first damping
        measures = np.array([slope(side, lambda vehicle: self.asked(case(vehicle))) for side in sides])
        return [
            Cut(seen.place, event.thrust / asked, (row - event.thrust / asked * measures) / asked)
            for event, row in zip(events, thrusts.T, strict=True)
        ]

    def mass_slopes(self, place: Array) -> Array:
        """Derivatives of the mass over the coordinates."""
        return np.array([slope(side, mass) for side in self.space.coordinates(place)])
