"""A vehicle some of whose quantities scatter."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import special

from beal.design.copula import Measure, Pair, probability, score_correlation
from beal.design.distributions import DRAWN, Distribution
from beal.errors import ModelError
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

DOUBLINGS = 80  # of the distance at which a value is tried
HALVINGS = 120  # until the end of what is possible is known


@dataclass(frozen=True)
class Uncertain:
    """A vehicle and the distributions of some of its quantities.

    Parameters
    ----------
    vehicle : Vehicle
        Gives all other quantities.
    distributions : mapping of path to Distribution
        Of quantities named as in the model file. One that gives weight to values that the quantity cannot have is
        refused, unless it says that it may be truncated.
    correlations : mapping of (path, path) to float
        Of pairs; all others are independent.
    measure : {"spearman", "pearson"}
        What the correlations are: of ranks, or of values.

    Raises
    ------
    ModelError
        With every quantity that does not exist or whose distribution does not fit it, or for the correlations.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> stiffness = {"stage[0].bending_stiffness": Distribution.normal(1.0, 0.5, truncate=True)}
    >>> {path: f"{cut:.2%}" for path, cut in Uncertain(catalog.beck(), stiffness).truncated.items()}
    {'stage[0].bending_stiffness': '2.28%'}
    """

    vehicle: Vehicle
    distributions: Mapping[str, Distribution]
    correlations: Mapping[Pair, float] = field(default_factory=dict)
    measure: Measure = "spearman"

    def __post_init__(self) -> None:
        problems = [] if self.distributions else [("uncertain", "needs at least one quantity, found none")]
        for path, law in self.distributions.items():
            try:
                low, high = self.possible[path]
            except ModelError as error:
                problems += [(f"uncertain.{where}", message) for where, message in error.problems]
                break
            mass = law.impossible(low, high)
            if mass > DRAWN and not law.truncate:
                problems.append((f"uncertain.{path}", _impossible(law, mass, low, high)))
        if problems:
            raise ModelError(problems)
        _ = self.scores

    @cached_property
    def possible(self) -> dict[str, tuple[float, float]]:
        """Ends of the values that each quantity can have while the others have their medians."""
        vehicle = self.vehicle
        for path, law in self.distributions.items():
            vehicle = with_values(vehicle, {path: law.median})
        return {path: _ends(vehicle, path, law.median) for path, law in self.distributions.items()}

    @cached_property
    def truncated(self) -> dict[str, float]:
        """Probability that was cut off, for each quantity where some was."""
        cut = {path: law.impossible(*self.possible[path]) for path, law in self.distributions.items()}
        return {path: mass for path, mass in cut.items() if mass > DRAWN}

    @cached_property
    def laws(self) -> dict[str, Distribution]:
        """The distributions, truncated where that is needed."""
        return {path: law.within(*self.possible[path]) for path, law in self.distributions.items()}

    @cached_property
    def scores(self) -> Array:
        """Correlation matrix of the normal scores, shape (quantities, quantities)."""
        return score_correlation(self.laws, self.correlations, self.measure)

    def values(self, cube: Array) -> Array:
        """Values of the quantities for independent uniform numbers.

        Parameters
        ----------
        cube : ndarray, shape (samples, quantities)
            Between 0 and 1.

        Returns
        -------
        ndarray, shape (samples, quantities)
        """
        cube = np.clip(cube, DRAWN, 1 - DRAWN)  # an end of the cube may be an infinite value
        if self.correlations:
            scores = special.ndtri(cube) @ np.linalg.cholesky(self.scores).T
            cube = probability(scores)
        columns = [law.quantile(column) for law, column in zip(self.laws.values(), cube.T, strict=True)]
        return np.stack(columns, axis=1)


def _impossible(law: Distribution, mass: float, low: float, high: float) -> str:
    ends = " and ".join(f"{what} {end:.6g}" for what, end in (("above", low), ("below", high)) if math.isfinite(end))
    return (
        f"possible values lie {ends}; this {law.name} distribution gives {mass:.3g} of its probability to others; "
        "choose another, or truncate = true"
    )


def _ends(vehicle: Vehicle, path: str, inside: float) -> tuple[float, float]:
    """Smallest and largest value that the vehicle accepts, taken to accept all between."""
    return _end(vehicle, path, inside, -1.0), _end(vehicle, path, inside, 1.0)


def _end(vehicle: Vehicle, path: str, inside: float, direction: float) -> float:
    scale = abs(inside) or 1.0
    good, bad = inside, inside + direction * scale
    for _ in range(DOUBLINGS):
        if not _accepts(vehicle, path, bad):
            break
        good, bad = bad, inside + 2 * (bad - inside)
    else:
        return direction * math.inf
    for _ in range(HALVINGS):
        middle = (good + bad) / 2
        if middle in (good, bad):
            break
        good, bad = (middle, bad) if _accepts(vehicle, path, middle) else (good, middle)
    return 0.0 if abs(good) < 1e-15 * scale else good


def _accepts(vehicle: Vehicle, path: str, value: float) -> bool:
    try:
        with_values(vehicle, {path: value})
    except ModelError:
        return False
    return True
