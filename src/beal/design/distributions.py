"""How a quantity scatters: distributions by their inverse, whole or cut to the values that are possible."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from beal.errors import ModelError

Array = NDArray[np.float64]
Check = tuple[str, bool, str]  # what, whether it is good, what is wrong if not

FEWEST = 8  # measured values that make a distribution
DRAWN = 2.0**-53  # a probability below the resolution of the random numbers is never drawn


@dataclass(frozen=True)
class Distribution:
    """The distribution of one quantity, made by the class methods.

    Parameters
    ----------
    name : str
    law : scipy.stats frozen distribution
        Continuous.
    truncate : bool
        Whether to cut off what is impossible for the quantity, in place of refusing it.

    Examples
    --------
    >>> Distribution.lognormal(median=2.0, cv=0.1).quantile(0.5).item()
    2.0
    """

    name: str
    law: Any
    truncate: bool = False

    @classmethod
    def normal(cls, mean: float, sd: float, truncate: bool = False) -> "Distribution":
        """Normal, by mean and standard deviation."""
        _check(_finite(mean=mean, sd=sd), (("sd", sd > 0, f"must be positive, found {sd}"),))
        return cls("normal", stats.norm(mean, sd), truncate)

    @classmethod
    def lognormal(cls, median: float, cv: float, truncate: bool = False) -> "Distribution":
        """Lognormal, by median and coefficient of variation: sigma^2 = ln(1 + cv^2)."""
        given = {"median": median, "cv": cv}
        _check(_finite(**given), [(key, value > 0, f"must be positive, found {value}") for key, value in given.items()])
        return cls("lognormal", stats.lognorm(math.sqrt(math.log1p(cv**2)), scale=median), truncate)

    @classmethod
    def uniform(cls, low: float, high: float, truncate: bool = False) -> "Distribution":
        """Uniform between two values."""
        _check(_finite(low=low, high=high), (("high", high > low, f"must be above low = {low}, found {high}"),))
        return cls("uniform", stats.uniform(low, high - low), truncate)

    @classmethod
    def triangular(cls, low: float, mode: float, high: float, truncate: bool = False) -> "Distribution":
        """Triangular, with its peak at the mode."""
        ordered = (
            ("high", high > low, f"must be above low = {low}, found {high}"),
            ("mode", low <= mode <= high, f"must lie between low = {low} and high = {high}, found {mode}"),
        )
        _check(_finite(low=low, mode=mode, high=high), ordered)
        return cls("triangular", stats.triang((mode - low) / (high - low), low, high - low), truncate)

    @classmethod
    def of_samples(cls, values: Sequence[float] | Array, truncate: bool = False) -> "Distribution":
        """As measured: linear between the sorted values, which stand at equal steps of probability."""
        sample = np.sort(np.asarray(values, dtype=float).ravel())
        enough = len(sample) >= FEWEST
        _check(
            (("values", bool(np.isfinite(sample).all()), "must be finite numbers, found something else"),),
            (("values", enough, f"needs at least {FEWEST} measured values, found {len(sample)}"),)
            + ((("values", sample[-1] > sample[0], "must differ, found one value only"),) if enough else ()),
        )
        return cls("samples", _Measured(sample), truncate)

    def quantile(self, probability: float | Array) -> Array:
        """Value that is not exceeded with a probability."""
        return np.asarray(self.law.ppf(probability), dtype=float)

    @cached_property
    def median(self) -> float:
        """Value exceeded as often as not."""
        return float(self.law.ppf(0.5))

    def times(self, factor: float) -> "Distribution":
        """The distribution of a multiple."""
        return Distribution(self.name, _Multiple(self.law, factor), self.truncate)

    def impossible(self, low: float, high: float) -> float:
        """Probability of values below or above what is possible."""
        return float(self.law.cdf(low) + self.law.sf(high))

    def within(self, low: float, high: float) -> "Distribution":
        """The same, given that the value lies between two ends."""
        if self.impossible(low, high) == 0:
            return self
        return Distribution(self.name, _Cut(self.law, low, high), self.truncate)


@dataclass(frozen=True)
class _Multiple:
    """The distribution of a positive multiple."""

    law: Any
    factor: float

    def ppf(self, probability: float | Array) -> Array:
        return np.asarray(self.factor * self.law.ppf(probability))

    def cdf(self, value: float) -> float:
        return float(self.law.cdf(value / self.factor))

    def sf(self, value: float) -> float:
        return float(self.law.sf(value / self.factor))


@dataclass(frozen=True)
class _Measured:
    """Piecewise linear distribution through sorted values."""

    values: Array

    @property
    def _levels(self) -> Array:
        return np.linspace(0.0, 1.0, len(self.values))

    def ppf(self, probability: float | Array) -> Array:
        return np.asarray(np.interp(probability, self._levels, self.values))

    def cdf(self, value: float) -> float:
        return float(np.interp(value, self.values, self._levels))

    def sf(self, value: float) -> float:
        return 1.0 - self.cdf(value)


@dataclass(frozen=True)
class _Cut:
    """A distribution given that the value lies between two ends."""

    law: Any
    low: float
    high: float

    def ppf(self, probability: float | Array) -> Array:
        first, last = self.law.cdf(self.low), self.law.cdf(self.high)
        return np.clip(self.law.ppf(first + np.asarray(probability) * (last - first)), self.low, self.high)

    def cdf(self, value: float) -> float:
        first, last = self.law.cdf(self.low), self.law.cdf(self.high)
        return float((np.clip(self.law.cdf(value), first, last) - first) / (last - first))

    def sf(self, value: float) -> float:
        return 1.0 - self.cdf(value)


def _finite(**values: float) -> Sequence[Check]:
    return [(key, math.isfinite(value), f"must be a finite number, found {value}") for key, value in values.items()]


def _check(*rounds: Sequence[Check]) -> None:
    """Raises every problem of the first round that has one."""
    for checks in rounds:
        if bad := [(key, message) for key, good, message in checks if not good]:
            raise ModelError(bad)
