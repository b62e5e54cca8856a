"""A study: a vehicle, the axes of a grid over its quantities, and how each point is solved."""

import hashlib
import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field

import numpy as np

from beal.discretisation.build import FORMULATIONS, RITZ, Formulation, check_ritz
from beal.errors import ModelError
from beal.stability.table import tabulated
from beal.vehicle.file import dumps
from beal.vehicle.links import Link, with_links
from beal.vehicle.paths import value_at, with_values
from beal.vehicle.vehicle import Vehicle

POINTS = 10_000_000_000  # beyond this a grid is more likely a mistake than a plan
SHOWN = 10_000  # values of an axis that the inputs list; of a longer one they hold the ends and a hash


@dataclass(frozen=True)
class Solve:
    """How each point is solved.

    Parameters
    ----------
    max_thrust : float or None
        Thrust to search to, in N; by default that of `beal.critical_thrust` for each vehicle.
    tolerance : float
        Relative error of the critical thrust to reach.
    formulation : str
    modes : int or None
        Number of modes of the Ritz formulations.
    """

    max_thrust: float | None = None
    tolerance: float = 1e-6
    formulation: Formulation = "objective"
    modes: int | None = None


@dataclass(frozen=True)
class Study:
    """A grid of vehicles.

    Parameters
    ----------
    vehicle : Vehicle
    axes : mapping of str to tuple of float
        Values of each quantity, named by its path in the model; the first axis varies slowest.
    solve : Solve
    links : mapping of str to Link
        By the path of a quantity that follows one of the axes.
    """

    vehicle: Vehicle
    axes: Mapping[str, tuple[float, ...]]
    solve: Solve
    links: Mapping[str, Link] = field(default_factory=dict)

    def __post_init__(self) -> None:
        problems = []
        for path, values in self.axes.items():
            if not values:
                problems.append((f"grid.{path}", "needs at least one value, found none"))
            elif not all(isinstance(value, int | float) and not math.isnan(value) for value in values):
                problems.append((f"grid.{path}", "values must be numbers, found something else"))
        if not self.axes:
            problems.append(("grid", "needs at least one axis, found none"))
        if math.prod(self.shape) > POINTS:
            problems.append(("grid", f"at most {POINTS} points, found {math.prod(self.shape)}"))
        if self.solve.formulation not in FORMULATIONS:
            choices = ", ".join(FORMULATIONS)
            problems.append(("solve.formulation", f"must be one of {choices}, found {self.solve.formulation!r}"))
        if self.solve.modes is not None and self.solve.formulation not in RITZ:
            problems.append(("solve.modes", f"applies to {' and '.join(RITZ)} only, found {self.solve.formulation}"))
        if self.solve.max_thrust is not None and not 0 < self.solve.max_thrust < math.inf:
            problems.append(("solve.max_thrust", f"must be a positive number, found {self.solve.max_thrust}"))
        if not 1e-13 <= self.solve.tolerance < 1:
            problems.append(("solve.tolerance", f"must lie between 1e-13 and 1, found {self.solve.tolerance}"))
        for path, link in self.links.items():
            if path in self.axes:
                problems.append((f"links.{path}", "is an axis and linked to one; keep one of the two"))
            if link.of not in self.axes:
                problems.append((f"links.{path}", f"follows {link.of}, which is not an axis"))
        if problems:
            raise ModelError(problems)
        for path in self.links:
            value_at(self.vehicle, path)
        for path, axis in self.axes.items():
            self._can_vary(path, (axis[0], axis[len(axis) // 2], axis[-1]))
        if self.solve.formulation in RITZ:  # else every point would be invalid, for the same reason
            check_ritz(self.vehicle, self.solve.formulation)

    def _can_vary(self, path: str, some: tuple[float, ...]) -> None:
        """Refuses an axis if none of some of its values makes a vehicle; single ones may be invalid points."""
        refusals = []
        for value in some:
            try:
                with_values(self.vehicle, {path: value})
            except ModelError as error:
                refusals.append(error)
            else:
                return
        raise refusals[0]

    @property
    def shape(self) -> tuple[int, ...]:
        """Points along each axis."""
        return tuple(len(values) for values in self.axes.values())

    def at(self, values: Iterable[float]) -> Vehicle:
        """The vehicle with a value on each axis, on the grid or off it."""
        named = dict(zip(self.axes, map(float, values), strict=True))
        return with_values(self.vehicle, with_links(named, self.links))

    def tabulated(self, path: str) -> bool:
        """Whether vehicles that differ on this axis alone share a table."""
        return tabulated(self.vehicle, path) and all(link.of != path for link in self.links.values())

    @property
    def inputs(self) -> dict[str, str]:
        """Everything that the result depends on, each part as text, so that two studies can be compared."""
        parts = {"model": dumps(self.vehicle)}
        parts |= {f"grid.{path}": _text(values) for path, values in self.axes.items()}
        parts |= {f"links.{path}": json.dumps(asdict(link)) for path, link in self.links.items()}
        return parts | {f"solve.{name}": json.dumps(value) for name, value in asdict(self.solve).items()}

    @property
    def digest(self) -> str:
        """SHA-256 of the inputs."""
        return hashlib.sha256(json.dumps(self.inputs, sort_keys=True).encode()).hexdigest()


def _text(values: tuple[float, ...]) -> str:
    if len(values) <= SHOWN:
        return json.dumps(values)
    digest = hashlib.sha256(np.array(values).tobytes()).hexdigest()
    return f"{len(values)} values from {float(values[0])} to {float(values[-1])}, SHA-256 {digest}"


def spaced(start: float, stop: float, points: int, spacing: str) -> tuple[float, ...]:
    """Evenly spaced values, linearly or in their logarithm, both ends included and exact."""
    space = np.geomspace if spacing == "log" else np.linspace
    return tuple(float(value) for value in space(start, stop, points))
