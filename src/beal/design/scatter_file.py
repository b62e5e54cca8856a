"""The tables of a study file that say how quantities scatter (TOML)."""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, FiniteFloat

from beal.design.copula import Measure, Pair
from beal.design.distributions import Distribution
from beal.design.robust import Scenario
from beal.design.sampling import Method
from beal.errors import ModelError
from beal.study.file import SolveEntry
from beal.vehicle.base import Part, si

Number = Annotated[FiniteFloat, si("")]


class _Law(Part):
    truncate: bool = False


class Normal(_Law):
    """Mean, and standard deviation or coefficient of variation."""

    distribution: Literal["normal"]
    mean: Number
    sd: Number | None = None
    cv: Number | None = None


class Lognormal(_Law):
    """Median and coefficient of variation."""

    distribution: Literal["lognormal"]
    median: Number
    cv: Number


class Uniform(_Law):
    """Two ends."""

    distribution: Literal["uniform"]
    low: Number
    high: Number


class Triangular(_Law):
    """Two ends and the peak."""

    distribution: Literal["triangular"]
    low: Number
    mode: Number
    high: Number


class Measured(_Law):
    """Values, or a CSV file and the name of its column."""

    distribution: Literal["samples"]
    values: tuple[Number, ...] | None = None
    file: str | None = None
    column: str | None = None


LawEntry = Annotated[Normal | Lognormal | Uniform | Triangular | Measured, Field(discriminator="distribution")]


class PairEntry(Part):
    """Correlation of two quantities."""

    between: tuple[str, str]
    value: Number


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

    multiply: dict[str, Number] = Field(default_factory=dict)
    replace: dict[str, Number] = Field(default_factory=dict)


class ToleranceEntry(Part):
    """Ends of the values of a quantity."""

    low: Number
    high: Number


class ScatterEntry(Part):
    """What the files of ``beal uncertainty`` and ``beal design`` share."""

    model: str
    uncertain: dict[str, LawEntry] = Field(default_factory=dict)
    correlation: CorrelationEntry = CorrelationEntry()
    sampling: SamplingEntry = SamplingEntry()
    tolerance: dict[str, ToleranceEntry] = Field(default_factory=dict)
    scenario: dict[str, ScenarioEntry] = Field(default_factory=dict)
    solve: SolveEntry = SolveEntry()

    @property
    def tolerances(self) -> dict[str, tuple[float, float]]:
        """Ends by path."""
        return {path: (ends.low, ends.high) for path, ends in self.tolerance.items()}

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        """The named imperfections."""
        return tuple(Scenario(name, case.multiply, case.replace) for name, case in self.scenario.items())


def distributions(laws: Mapping[str, LawEntry], folder: Path) -> dict[str, Distribution]:
    """The laws by path; files of measured values are looked for in a folder.

    Raises
    ------
    ModelError
        With every problem of every law.
    """
    found, bad = {}, []
    for name, law in laws.items():
        try:
            found[name] = _distribution(law, folder)
        except ModelError as error:
            bad += [(f"uncertain.{name}.{where}", message) for where, message in error.problems]
    if bad:
        raise ModelError(bad)
    return found


def _distribution(law: LawEntry, folder: Path) -> Distribution:
    match law:
        case Normal(mean=mean, sd=sd, cv=cv):
            if (sd is None) == (cv is None):
                raise ModelError([("sd", "give either sd or cv")])
            return Distribution.normal(mean, abs(mean) * cv if cv is not None else sd or 0.0, law.truncate)
        case Lognormal(median=median, cv=cv):
            return Distribution.lognormal(median, cv, law.truncate)
        case Uniform(low=low, high=high):
            return Distribution.uniform(low, high, law.truncate)
        case Triangular(low=low, mode=mode, high=high):
            return Distribution.triangular(low, mode, high, law.truncate)
        case Measured(values=values, file=file, column=column):
            if (values is None) == (file is None) or (file is None) != (column is None):
                raise ModelError([("values", "give either values or both of file and column")])
            measured = values if values is not None else _column(folder / str(file), str(column))
            return Distribution.of_samples(measured, law.truncate)


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
