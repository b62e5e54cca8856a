"""The vehicles that one design may turn out as: within tolerances, drawn at random, with imperfections, in flight."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Protocol

from scipy.stats import qmc

from beal.design.uncertain import Uncertain
from beal.errors import ModelError
from beal.study.flight import vehicle_at
from beal.vehicle.paths import value_at, with_values
from beal.vehicle.vehicle import Vehicle

MOST_TOLERANCES = 8  # quantities, of 257 cases


class Case(Protocol):
    """What a design may turn out as, such as a `Scenario`."""

    @property
    def name(self) -> str:
        """What it is called."""
        ...

    def applied(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle that a design becomes."""
        ...


@dataclass(frozen=True)
class Scattered:
    """A design whose quantities come out otherwise than asked for.

    Parameters
    ----------
    name : str
    factors, offsets : mapping of path to float
    """

    name: str
    factors: Mapping[str, float] = field(default_factory=dict)
    offsets: Mapping[str, float] = field(default_factory=dict)

    def applied(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle as it comes out."""
        moved = {path: factor * value_at(vehicle, path) for path, factor in self.factors.items()}
        moved |= {path: value_at(vehicle, path) + offset for path, offset in self.offsets.items()}
        return with_values(vehicle, moved) if moved else vehicle


@dataclass(frozen=True)
class Flying:
    """A design at a time of its flight, whose thrust then is its nominal one.

    Parameters
    ----------
    name : str
    time, thrust : float
        In s and N.
    """

    name: str
    time: float
    thrust: float

    def applied(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle as it flies."""
        return with_values(vehicle_at(vehicle, self.time), {"thrust.nominal": self.thrust})


AS_DESIGNED = Scattered("as designed")


def tolerance_cases(
    relative: Mapping[str, float] | None = None, absolute: Mapping[str, float] | None = None
) -> tuple[Case, ...]:
    """A design as asked for and at every vertex of a box of tolerances around it.

    Parameters
    ----------
    relative : mapping of path to float
        Half width of each quantity's interval as a share of its value.
    absolute : mapping of path to float
        The same in the quantity's own unit.

    Returns
    -------
    tuple of Case
        The first is the design itself.

    Raises
    ------
    ModelError
        If there is no tolerance or more than eight, one is not positive, or a quantity has two.

    Examples
    --------
    >>> [case.name for case in tolerance_cases({"stage[0].bending_stiffness": 0.1})]
    ['as designed', 'stage[0].bending_stiffness -10%', 'stage[0].bending_stiffness +10%']
    """
    relative, absolute = relative or {}, absolute or {}
    widths = [(path, width, True) for path, width in relative.items()]
    widths += [(path, width, False) for path, width in absolute.items()]
    problems = [(f"tolerance.{path}", "is given both ways") for path in relative if path in absolute]
    problems += [
        (f"tolerance.{path}", f"must be positive, found {width:g}") for path, width, _ in widths if not width > 0
    ]
    if not 1 <= len(widths) <= MOST_TOLERANCES:
        problems.append(("tolerance", f"needs 1 to {MOST_TOLERANCES} quantities, found {len(widths)}"))
    if problems:
        raise ModelError(problems)
    cases: list[Case] = [AS_DESIGNED]
    for signs in product((-1, 1), repeat=len(widths)):
        moved = [(path, sign * width, share) for sign, (path, width, share) in zip(signs, widths, strict=True)]
        name = ", ".join(f"{path} {by:+.6g}" if not share else f"{path} {by:+.6g}%" for path, by, share in _told(moved))
        factors = {path: 1 + by for path, by, share in moved if share}
        cases.append(Scattered(name, factors, {path: by for path, by, share in moved if not share}))
    return tuple(cases)


def vertex_cases(factors: Mapping[str, tuple[float, float]]) -> tuple[Case, ...]:
    """A design as asked for and at every vertex of a box of factors on its quantities.

    Parameters
    ----------
    factors : mapping of path to (float, float)

    Returns
    -------
    tuple of Case
        The first is the design itself.

    Raises
    ------
    ModelError
        If there are more than eight quantities.

    Examples
    --------
    >>> [case.name for case in vertex_cases({"stage[0].length": (0.9, 1.2)})]
    ['as designed', 'stage[0].length x 0.9', 'stage[0].length x 1.2']
    """
    if len(factors) > MOST_TOLERANCES:
        raise ModelError([("tolerance", f"at most {MOST_TOLERANCES} quantities, found {len(factors)}")])
    cases = [dict(zip(factors, corner, strict=True)) for corner in product(*factors.values())] if factors else []
    names = [", ".join(f"{path} x {factor:g}" for path, factor in case.items()) for case in cases]
    return (AS_DESIGNED, *(Scattered(name, case) for name, case in zip(names, cases, strict=True)))


def sample_cases(uncertain: Uncertain, samples: int = 16, seed: int = 0) -> tuple[Case, ...]:
    """Designs as they come out at random, each quantity scattered about what is asked for as about its median.

    Parameters
    ----------
    uncertain : Uncertain
        Whose medians must be finite and not zero, like the vehicle's own values.
    samples : int
        Points of a scrambled Sobol' sequence.
    seed : int
        The same seed gives the same cases.

    Returns
    -------
    tuple of Case

    Raises
    ------
    ModelError
        If there is no sample, or a median or value is zero or infinite.

    Examples
    --------
    >>> from beal.design.distributions import Distribution
    >>> from beal.vehicle.catalog import beck
    >>> stiffness = {"stage[0].bending_stiffness": Distribution.uniform(0.9, 1.1)}
    >>> first, *_ = sample_cases(Uncertain(beck(), stiffness))
    >>> 0.9 < first.applied(beck()).stages[0].bending_stiffness < 1.1
    True
    """
    if samples < 1:
        raise ModelError([("samples", f"must be at least 1, found {samples}")])
    medians = {path: law.median for path, law in uncertain.laws.items()}
    values = {path: (value_at(uncertain.vehicle, path), median) for path, median in medians.items()}
    if bad := {path: pair for path, pair in values.items() if 0 in pair or math.inf in pair}:
        told = "needs a value and a median that are finite and not zero, found {:g} and {:g}"
        raise ModelError([(f"uncertain.{path}", told.format(*pair)) for path, pair in bad.items()])
    cube = qmc.Sobol(len(medians), seed=seed).random_base2(math.ceil(math.log2(samples)))[:samples]
    rows = uncertain.values(cube) / list(medians.values())
    return tuple(
        Scattered(f"sample {number}", dict(zip(medians, row.tolist(), strict=True))) for number, row in enumerate(rows)
    )


def flight_cases(vehicle: Vehicle) -> tuple[Case, ...]:
    """A design at every time of its timeline at which it is under thrust, whose thrust then is its nominal one.

    Parameters
    ----------
    vehicle : Vehicle
        With a timeline.

    Returns
    -------
    tuple of Case

    Raises
    ------
    ModelError
        If there is no timeline, or no thrust in it.

    Examples
    --------
    >>> from beal.vehicle import Timeline
    >>> from beal.vehicle.catalog import beal
    >>> burn = Timeline(time=[0.0, 60.0, 70.0], thrust=[20.0, 20.0, 0.0])
    >>> [case.name for case in flight_cases(beal().model_copy(update={"timeline": burn}))]
    ['t = 0', 't = 60']
    """
    line = vehicle.timeline
    if line is None:
        raise ModelError([("timeline", "is needed and missing")])
    under_thrust = {time: thrust for time, thrust in zip(line.time, line.thrust, strict=True) if thrust > 0}
    if not under_thrust:
        raise ModelError([("timeline.thrust", "needs a time under thrust, found none")])
    return tuple(Flying(f"t = {time:g}", time, thrust) for time, thrust in under_thrust.items())


def _told(moved: list[tuple[str, float, bool]]) -> list[tuple[str, float, bool]]:
    """Shares as percent."""
    return [(path, 100 * by if share else by, share) for path, by, share in moved]
