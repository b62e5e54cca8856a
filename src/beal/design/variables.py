"""What may be changed in a design: quantities with bounds, others that follow them, and linear constraints."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from beal.design.derivatives import STEP
from beal.errors import ModelError
from beal.vehicle.links import Link, with_links
from beal.vehicle.paths import value_at, with_values
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Variable:
    """A quantity that may be chosen.

    Parameters
    ----------
    low, high : float
        Bounds.
    spacing : {"linear", "log"}
        In which the search takes its steps.
    """

    low: float
    high: float
    spacing: Literal["linear", "log"] = "linear"

    def value(self, share: float) -> float:
        """What a share of the way from bound to bound comes to."""
        if self.spacing == "log":
            return float(self.low * (self.high / self.low) ** share)
        return float(self.low + (self.high - self.low) * share)

    def share(self, value: float) -> float:
        """The share at a value."""
        low, high, there = (math.log(x) if self.spacing == "log" else x for x in (self.low, self.high, value))
        return (there - low) / (high - low)


@dataclass(frozen=True)
class LinearBound:
    """A bound on a sum of variables, each times a coefficient.

    Parameters
    ----------
    coefficients : mapping of str to float
        By the path of the variable, of linear spacing.
    low, high : float
        Equal for an equation.
    """

    coefficients: Mapping[str, float]
    low: float = -math.inf
    high: float = math.inf


@dataclass(frozen=True)
class DesignSpace:
    """The vehicles among which a design is chosen.

    Parameters
    ----------
    vehicle : Vehicle
        Gives every quantity that is neither a variable nor linked to one.
    variables : mapping of str to Variable
        By path.
    links : mapping of str to Link
        By the path of the quantity that follows.
    bounds : sequence of LinearBound

    Raises
    ------
    ModelError
        If a path is unknown, bounds contradict each other, or no design meets them all.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> spring = "joint[0].rotational_stiffness"
    >>> space = DesignSpace(tsto(0.6, 10.0, 1e4), {spring: Variable(1.0, 1e4, "log")})
    >>> space.at([0.5]).joints[0].rotational_stiffness
    100.0
    """

    vehicle: Vehicle
    variables: Mapping[str, Variable]
    links: Mapping[str, Link] = field(default_factory=dict)
    bounds: Sequence[LinearBound] = ()

    def __post_init__(self) -> None:
        problems = [] if self.variables else [("variables", "needs at least one, found none")]
        for path in (*self.variables, *self.links):
            value_at(self.vehicle, path)
        for path, one in self.variables.items():
            if not (math.isfinite(one.low) and math.isfinite(one.high) and one.low < one.high):
                problems.append((path, f"contradictory bounds: from {one.low:g} to {one.high:g}"))
            elif one.spacing == "log" and one.low <= 0:
                problems.append((path, f"a log spacing needs positive bounds, found {one.low:g} to {one.high:g}"))
        for path, link in self.links.items():
            if path in self.variables:
                problems.append((path, "is a variable and linked to one; keep one of the two"))
            if link.of not in self.variables:
                problems.append((path, f"is linked to {link.of}, which is not a variable"))
        for number, bound in enumerate(self.bounds):
            for path in bound.coefficients:
                if path not in self.variables or self.variables[path].spacing == "log":
                    problems.append((f"bounds[{number}]", f"needs variables of linear spacing, found {path}"))
            if bound.low > bound.high:
                problems.append((f"bounds[{number}]", f"contradictory: from {bound.low:g} to {bound.high:g}"))
        if problems:
            raise ModelError(problems)
        self.nearest(np.full(len(self.variables), 0.5))

    def at(self, shares: Sequence[float] | Array) -> Vehicle:
        """The vehicle at a point of the unit cube, whose sides are the variables from bound to bound."""
        return with_values(self.vehicle, with_links(self.values(shares), self.links))

    def values(self, shares: Sequence[float] | Array) -> dict[str, float]:
        """The variables there, by path."""
        return {path: one.value(share) for (path, one), share in zip(self.variables.items(), shares, strict=True)}

    def coordinates(self, shares: Array) -> "list[Coordinate]":
        """The sides of the unit cube at a point."""
        return [Coordinate(self, shares, number) for number in range(len(self.variables))]

    def shares(self, values: Mapping[str, float]) -> Array:
        """The point of the unit cube with these values."""
        return np.clip([one.share(values[path]) for path, one in self.variables.items()], 0.0, 1.0)

    def rows(self) -> tuple[Array, Array]:
        """A and b of all linear bounds as A shares <= b."""
        rows, limits = [np.empty((0, len(self.variables)))], [np.empty(0)]
        for bound in self.bounds:
            weights = np.array([bound.coefficients.get(path, 0.0) for path in self.variables])
            low, high = (np.array([getattr(one, end) for one in self.variables.values()]) for end in ("low", "high"))
            row, offset = weights * (high - low), float(weights @ low)
            for sign, limit in ((1.0, bound.high), (-1.0, bound.low)):
                if math.isfinite(limit):
                    rows.append(sign * row[None])
                    limits.append(np.array([sign * (limit - offset)]))
        return np.concatenate(rows), np.concatenate(limits)

    def nearest(self, shares: Array) -> Array:
        """The point that meets all linear bounds and is nearest, in the sum of the distances."""
        A, b = self.rows()
        n = len(shares)
        moved = np.vstack((np.hstack((np.eye(n), -np.eye(n))), np.hstack((-np.eye(n), -np.eye(n)))))
        table = np.vstack((moved, np.hstack((A, np.zeros((len(A), n))))))
        limits = np.concatenate((shares, -shares, b))
        cost = np.repeat([0.0, 1.0], n)
        found = linprog(cost, table, limits, bounds=[(0, 1)] * n + [(0, None)] * n)
        if found.x is None:
            raise ModelError([("bounds", "contradictory: no design within the bounds of the variables meets them all")])
        return np.asarray(found.x[:n])


@dataclass(frozen=True)
class Coordinate:
    """One side of a space's unit cube at a point, as what matrices are differentiated with respect to.

    What is linked to the variable moves with it.

    Parameters
    ----------
    space : DesignSpace
    shares : ndarray, shape (variables,)
    number : int
        Of the variable.
    """

    space: DesignSpace
    shares: Array
    number: int

    @property
    def path(self) -> str:
        """Of the variable."""
        return list(self.space.variables)[self.number]

    @property
    def value(self) -> float:
        """Between 0 and 1."""
        return float(self.shares[self.number])

    @property
    def step(self) -> float:
        """By which the variable changes about as much as a quantity on its own would."""
        one = self.space.variables[self.path]
        if one.spacing == "log":
            return STEP / math.log(one.high / one.low)
        return STEP * abs(self.space.values(self.shares)[self.path]) / (one.high - one.low) or STEP

    def moved(self, distance: float) -> Vehicle:
        """The vehicle a distance away, which may lie beyond the bounds."""
        shares = np.array(self.shares)
        shares[self.number] += distance
        return self.space.at(shares)
