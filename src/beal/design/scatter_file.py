"""The tables of a study file that say how quantities scatter (TOML)."""

import csv
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, FiniteFloat

from beal.design.copula import Measure, Pair
from beal.design.distributions import Distribution
from beal.design.robust import Scenario
from beal.design.sampling import Method
from beal.errors import ModelError
from beal.study.file import Given, ModelEntry, SolveEntry, number
from beal.vehicle.base import Part

Units = Callable[[str], str]  # the unit in which the quantity at a path is kept
Scatter = tuple[dict[str, Distribution], dict[str, tuple[float, float]]]


class _Law(Part):
    truncate: bool = False


class Normal(_Law):
    """Mean, and standard deviation or coefficient of variation."""

    distribution: Literal["normal"]
    mean: Given
    sd: Given | None = None
    cv: FiniteFloat | None = None


class Lognormal(_Law):
    """Median and coefficient of variation."""

    distribution: Literal["lognormal"]
    median: Given
    cv: FiniteFloat


class Uniform(_Law):
    """Two ends."""

    distribution: Literal["uniform"]
    low: Given
    high: Given


class Triangular(_Law):
    """Two ends and the peak."""

    distribution: Literal["triangular"]
    low: Given
    mode: Given
    high: Given


class Measured(_Law):
    """Values, or a CSV file and the name of its column."""

    distribution: Literal["samples"]
    values: tuple[Given, ...] | None = None
    file: str | None = None
    column: str | None = None


LawEntry = Annotated[Normal | Lognormal | Uniform | Triangular | Measured, Field(discriminator="distribution")]


class PairEntry(Part):
    """Correlation of two quantities."""

    between: tuple[str, str]
    value: FiniteFloat


class CorrelationEntry(Part):
    """The ``[correlation]`` table."""

    measure: Measure = "spearman"
    pairs: tuple[PairEntry, ...] = ()

    def by_pair(self) -> dict[Pair, float]:
        """Correlation of each pair, none named twice."""
        if len({frozenset(pair.between) for pair in self.pairs}) < len(self.pairs):
            raise ModelError([("correlation.pairs", "names a pair twice")])
        return {pair.between: pair.value for pair in self.pairs}


class SamplingEntry(Part):
    """The ``[sampling]`` table."""

    method: Method = "sobol"
    samples: Annotated[int, Field(strict=True)] = 4096
    seed: Annotated[int, Field(ge=0, strict=True)] = 0


class ScenarioEntry(Part):
    """A ``[scenario.NAME]`` table."""

    multiply: dict[str, FiniteFloat] = Field(default_factory=dict)
    replace: dict[str, Given] = Field(default_factory=dict)


class ToleranceEntry(Part):
    """Ends of the values of a quantity."""

    low: Given
    high: Given


class ScatterEntry(ModelEntry):
    """What the files of ``beal uncertainty`` and ``beal design`` share."""

    uncertain: dict[str, LawEntry] = Field(default_factory=dict)
    correlation: CorrelationEntry = CorrelationEntry()
    sampling: SamplingEntry = SamplingEntry()
    tolerance: dict[str, ToleranceEntry] = Field(default_factory=dict)
    scenario: dict[str, ScenarioEntry] = Field(default_factory=dict)
    solve: SolveEntry = SolveEntry()

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        """The named imperfections."""
        return tuple(Scenario(name, case.multiply, case.replace) for name, case in self.scenario.items())

    def scatter(self, folder: Path, unit: Units) -> Scatter:
        """Distributions and tolerances by path; files of measured values are looked for in a folder.

        Raises
        ------
        ModelError
            With every problem of every quantity.
        """
        laws, tolerances, bad = {}, {}, []
        for path, law in self.uncertain.items():
            try:
                laws[path] = _distribution(law, folder, partial(_number, unit, path))
            except ModelError as error:
                bad += [(f"uncertain.{path}.{where}", message) for where, message in error.problems]
            except ValueError as error:
                bad.append((f"uncertain.{path}", str(error)))
        for path, ends in self.tolerance.items():
            try:
                tolerances[path] = (_number(unit, path, ends.low), _number(unit, path, ends.high))
            except ValueError as error:
                bad.append((f"tolerance.{path}", str(error)))
        if bad:
            raise ModelError(bad)
        return laws, tolerances


def _number(unit: Units, path: str, given: float | str) -> float:
    return number(given, unit(path)) if isinstance(given, str) else given


def _distribution(law: LawEntry, folder: Path, of: Callable[[float | str], float]) -> Distribution:
    match law:
        case Normal(mean=mean, sd=sd, cv=cv):
            if (sd is None) == (cv is None):
                raise ModelError([("sd", "give either sd or cv")])
            middle = of(mean)
            return Distribution.normal(middle, abs(middle) * cv if cv is not None else of(sd or 0.0), law.truncate)
        case Lognormal(median=median, cv=cv):
            return Distribution.lognormal(of(median), cv, law.truncate)
        case Uniform(low=low, high=high):
            return Distribution.uniform(of(low), of(high), law.truncate)
        case Triangular(low=low, mode=mode, high=high):
            return Distribution.triangular(of(low), of(mode), of(high), law.truncate)
        case Measured(values=values, file=file, column=column):
            if (values is None) == (file is None) or (file is None) != (column is None):
                raise ModelError([("values", "give either values or both of file and column")])
            if values is None:
                return Distribution.of_samples(_column(folder / str(file), str(column)), law.truncate)
            return Distribution.of_samples([of(value) for value in values], law.truncate)


def _column(path: Path, name: str) -> tuple[float, ...]:
    """Numbers of a column of a CSV file."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ModelError([("file", f"{path} cannot be read: {getattr(error, 'strerror', None) or error}")]) from None
    if not rows or name not in rows[0]:
        there = ", ".join(map(str, rows[0])) if rows else "none"
        raise ModelError([("column", f"{path} has no column {name!r}, found {there}")])
    try:
        return tuple(float(row[name]) for row in rows)
    except (TypeError, ValueError):
        raise ModelError([("column", f"{path}: column {name!r} must hold numbers only")]) from None
