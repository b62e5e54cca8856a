"""The weakest vehicle within tolerances, and vehicles with named imperfections."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, minimize
from scipy.stats import qmc

from beal.design.distributions import Distribution
from beal.design.sampling import Progress, solve_values
from beal.design.uncertain import Uncertain
from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.study.study import Solve
from beal.vehicle.paths import value_at, with_values
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

MOST_VERTICES = 12  # quantities up to which every vertex of the box is tried
INSIDE = 512  # points within the box
STARTS = 2  # lowest points from which the search goes on
STEPS = 60  # of each


@dataclass(frozen=True)
class WorstCase:
    """The lowest critical thrust that was found in a box.

    Parameters
    ----------
    critical_thrust : float
        In N; infinite if all vehicles are stable to the thrust searched to.
    values : dict of path to float
        Where.
    at_vertex : bool
        Whether every quantity is at an end of its range there.
    lowest_vertex : float
        Critical thrust of the weakest vertex, infinite as above.
    evaluations : int
    """

    critical_thrust: float
    values: dict[str, float]
    at_vertex: bool
    lowest_vertex: float
    evaluations: int


def box_around(vehicle: Vehicle, factors: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Ends of quantities, given those of factors on a vehicle's values."""
    values = {path: value_at(vehicle, path) for path in factors}
    return {path: (low * values[path], high * values[path]) for path, (low, high) in factors.items()}


@dataclass(frozen=True)
class Scenario:
    """A named imperfection.

    Parameters
    ----------
    name : str
    multiply : mapping of path to float
        Factors on quantities: 0.7 for a joint that lost three bolts of ten.
    replace : mapping of path to float or text with a unit
        Values in place of those of the model.
    """

    name: str
    multiply: Mapping[str, float] = field(default_factory=dict)
    replace: Mapping[str, float | str] = field(default_factory=dict)

    def applied(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle with the imperfection."""
        if not self.multiply and not self.replace:
            raise ModelError([(f"scenario.{self.name}", "changes nothing; give multiply or replace")])
        if both := sorted(set(self.multiply) & set(self.replace)):
            raise ModelError([(f"scenario.{self.name}", f"{both[0]} is both multiplied and replaced")])
        try:
            factors = {path: factor * value_at(vehicle, path) for path, factor in self.multiply.items()}
            return with_values(vehicle, {**self.replace, **factors})
        except ModelError as error:
            where = f"scenario.{self.name}"
            raise ModelError([(f"{where}.{path}", message) for path, message in error.problems]) from None


def worst_case(
    vehicle: Vehicle,
    tolerances: Mapping[str, tuple[float, float]],
    solve: Solve | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> WorstCase:
    """Lowest critical thrust while each quantity lies anywhere between two values.

    All vertices of the box (of more than twelve quantities the scattered points only), 512 points scattered within it,
    and a simplex search from the two lowest. It is an upper bound of the true minimum: a weak spot narrower than the
    distance between the points can be missed.

    Parameters
    ----------
    vehicle : Vehicle
    tolerances : mapping of path to (float, float)
    solve, workers, progress
        As in `beal.sample`.

    Returns
    -------
    WorstCase

    Raises
    ------
    ModelError
        If a quantity does not exist, or its range is not one of possible values.
    ConvergenceError
        If a vehicle cannot be solved.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> found = worst_case(catalog.tsto(0.5, 2.0, 1e4), {"joint[0].rotational_stiffness": (1.0, 3.0)})
    >>> found.values, found.at_vertex
    ({'joint[0].rotational_stiffness': 1.0}, True)
    """
    laws = {}
    for path, (low, high) in tolerances.items():
        try:
            laws[path] = Distribution.uniform(low, high)
        except ModelError as error:
            raise ModelError([(f"tolerance.{path}.{where}", message) for where, message in error.problems]) from None
    box = Uncertain(vehicle, laws)
    ends = np.array(list(tolerances.values()), dtype=float)
    vertices = len(ends) <= MOST_VERTICES
    corners = np.array(list(product((0.0, 1.0), repeat=len(ends)))) if vertices else np.empty((0, len(ends)))
    cube = np.concatenate((corners, qmc.Sobol(len(ends), seed=0).random(INSIDE)))
    evaluations = 0

    def thrusts(points: Array, report: Progress | None = None) -> Array:
        nonlocal evaluations
        evaluations += len(points)
        found, _, _ = solve_values(box, ends[:, 0] + points * np.diff(ends).T, solve, workers, report)
        if failed := int(np.isnan(found).sum()):
            raise ConvergenceError(f"{failed} of {len(found)} vehicles in the box could not be solved")
        return found

    def thrust_at(point: Array) -> float:
        return float(thrusts(point[None])[0])

    found = thrusts(cube, progress)
    lowest = int(np.argmin(found))
    best, point = float(found[lowest]), cube[lowest]
    for start in np.argsort(found)[:STARTS] if np.isfinite(best) else ():
        result = minimize(
            thrust_at,
            np.array(cube[start]),
            method="Nelder-Mead",
            bounds=Bounds(0.0, 1.0),
            options={"maxfev": STEPS},
        )
        if result.fun < best:
            best, point = float(result.fun), result.x
    values = dict(zip(tolerances, (ends[:, 0] + point * np.diff(ends)[:, 0]).tolist(), strict=True))
    at_vertex = bool(np.isin(point, (0.0, 1.0)).all())
    return WorstCase(best, values, at_vertex, float(found[: len(corners)].min(initial=np.inf)), evaluations)


def scenarios(
    vehicle: Vehicle, cases: Sequence[Scenario], solve: Solve | None = None
) -> list[tuple[str, CriticalThrust]]:
    """Critical thrust of a vehicle as it should be, and with each imperfection.

    Parameters
    ----------
    vehicle : Vehicle
    cases : sequence of Scenario
    solve : Solve, optional

    Returns
    -------
    list of (str, CriticalThrust)
        The first is ``as designed``.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> lost = Scenario("bolts lost", multiply={"joint[0].rotational_stiffness": 0.7})
    >>> [f"{name}: {found.critical_thrust:.2f}" for name, found in scenarios(catalog.tsto(0.5, 2.0, 1e4), [lost])]
    ['as designed: ...', 'bolts lost: ...']
    """
    how = solve or Solve()
    vehicles = {"as designed": vehicle, **{case.name: case.applied(vehicle) for case in cases}}
    return [
        (name, critical_thrust(each, how.max_thrust, how.formulation, modes=how.modes, tolerance=how.tolerance))
        for name, each in vehicles.items()
    ]
