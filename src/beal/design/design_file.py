"""The study file of ``beal design``: a question, what may be chosen, and what has to be borne (TOML)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, FiniteFloat

from beal.design.cases import Case, sample_cases, vertex_cases
from beal.design.copula import Measure, Pair
from beal.design.distributions import Distribution
from beal.design.ranges import thrust_asked
from beal.design.robust import Scenario, box_around
from beal.design.scatter_file import SamplingEntry, ScatterEntry
from beal.design.uncertain import Uncertain
from beal.design.variables import DesignSpace, LinearBound, Variable
from beal.design.worth import Objective
from beal.errors import ModelError
from beal.study.file import Given, LinkEntry, number, read_study
from beal.study.study import Solve
from beal.vehicle.base import Part, si
from beal.vehicle.paths import unit_at, value_at
from beal.vehicle.vehicle import Vehicle

CASES = 32  # vehicles drawn, of which the search counts the weakest but for a share
NEAR = (0.5, 2.0)  # medians of factors; others were meant as values


class QuestionEntry(Part):
    """The ``[design]`` table."""

    question: str = ""
    objective: Objective = "critical_thrust"
    target: Annotated[FiniteFloat, si("N")] | None = None
    factor: FiniteFloat | None = None
    starts: Annotated[int, Field(ge=1, strict=True)] = 4
    keep: Annotated[float, Field(gt=0, lt=1)] = 0.95
    robust: Literal["worst", "quantile"] | None = None
    quantile: Annotated[float, Field(gt=0, lt=1)] = 0.05


class VariableEntry(Part):
    """Bounds of a variable."""

    low: Given
    high: Given
    spacing: Literal["linear", "log"] = "linear"

    def variable(self, unit: str) -> Variable:
        """As the library has it, of a quantity that is kept in a unit."""
        return Variable(number(self.low, unit), number(self.high, unit), self.spacing)


class ConstraintEntry(Part):
    """A ``[[constraint]]``."""

    coefficients: dict[str, FiniteFloat]
    low: float = -math.inf
    high: float = math.inf


class MapEntry(Part):
    """The ``[map]`` table."""

    axes: Annotated[tuple[str, ...], Field(min_length=1, max_length=2)] | None = None
    points: Annotated[int, Field(ge=2, le=1001, strict=True)] = 31


class DesignEntry(ScatterEntry):
    """The whole file."""

    design: QuestionEntry = QuestionEntry()
    variables: dict[str, VariableEntry]
    links: dict[str, LinkEntry] = Field(default_factory=dict)
    constraint: tuple[ConstraintEntry, ...] = ()
    map: MapEntry = MapEntry()


@dataclass(frozen=True)
class DesignStudy:
    """A question of design.

    Parameters
    ----------
    space : DesignSpace
    objective : {"critical_thrust", "margin", "mass"}
    target : float or None
        Critical thrust to reach at the least mass, in N.
    question : str
        In words.
    starts : int
        Searches.
    keep : float
        Share of the design's critical thrust that the ranges around it keep.
    cases : tuple of Case
        What the design may turn out as, of which the weakest counts; empty where the design itself does.
    quantile : float
        Share of the cases that may be weaker.
    axes : tuple of str
        One or two variables of the map; empty for those whose ranges are narrowest.
    points : int
        Of the map along each of two axes.
    laws : mapping of path to Distribution
        Of factors on the quantities as designed.
    correlations, measure
        As for `Uncertain`.
    sampling : SamplingEntry
    tolerances : mapping of path to (float, float)
        Ends of factors on the quantities as designed.
    scenarios : tuple of Scenario
    solve : Solve
    text : str
        The file.
    """

    space: DesignSpace
    objective: Objective
    target: float | None
    question: str
    starts: int
    keep: float
    cases: tuple[Case, ...]
    quantile: float
    axes: tuple[str, ...]
    points: int
    laws: Mapping[str, Distribution]
    correlations: Mapping[Pair, float]
    measure: Measure
    sampling: SamplingEntry
    tolerances: Mapping[str, tuple[float, float]]
    scenarios: tuple[Scenario, ...]
    solve: Solve
    text: str

    def scattered(self, vehicle: Vehicle) -> Uncertain | None:
        """A vehicle of the space with its scatter, where the study has any."""
        if not self.laws:
            return None
        laws = {path: law.times(value_at(vehicle, path)) for path, law in self.laws.items()}
        return Uncertain(vehicle, laws, self.correlations, self.measure)

    def box(self, vehicle: Vehicle) -> dict[str, tuple[float, float]]:
        """Ends of the quantities of a vehicle of the space that have tolerances."""
        return box_around(vehicle, self.tolerances)


def load_design(path: str | Path) -> DesignStudy:
    """Reads a study file; the paths of the model and of measured values are taken relative to it.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    DesignStudy

    Raises
    ------
    ModelError
        With the problems of the file, or of the model that it names.
    """
    entry, vehicle = read_study(path, DesignEntry)
    try:
        return _study(entry, vehicle, Path(path).parent, Path(path).read_text(encoding="utf-8"))
    except ModelError as error:
        raise ModelError(error.problems, str(path)) from None
    except ValueError as error:
        raise ModelError([("variables", str(error))], str(path)) from None


def _study(entry: DesignEntry, vehicle: Vehicle, folder: Path, text: str) -> DesignStudy:
    asked, drawn = entry.design, entry.sampling
    variables = {path: one.variable(unit_at(vehicle, path)) for path, one in entry.variables.items()}
    links = {path: link.link for path, link in entry.links.items()}
    bounds = [LinearBound(each.coefficients, each.low, each.high) for each in entry.constraint]
    space = DesignSpace(vehicle, variables, links, bounds)
    target = None
    if asked.objective == "mass":
        target = thrust_asked(vehicle, asked.target, asked.factor)
    elif (asked.target, asked.factor) != (None, None):
        raise ModelError([("design.target", f"goes with the objective mass, not with {asked.objective}")])
    if unknown := [axis for axis in entry.map.axes or () if axis not in variables]:
        raise ModelError([("map.axes", f"must be variables, found {', '.join(unknown)}")])
    laws, tolerances = entry.scatter(folder, lambda path: "")  # factors
    study = DesignStudy(
        space,
        asked.objective,
        target,
        asked.question,
        asked.starts,
        asked.keep,
        (),
        0.0,
        entry.map.axes or (),
        entry.map.points,
        laws,
        entry.correlation.by_pair(),
        entry.correlation.measure,
        drawn,
        tolerances,
        entry.scenarios,
        entry.solve.solve,
        text,
    )
    middle = _checked(study)
    if asked.robust == "worst":
        if not (tolerances or entry.scenario):
            raise ModelError([("design.robust", "worst needs [tolerance] or [scenario.NAME], found neither")])
        return replace(study, cases=(*vertex_cases(tolerances), *entry.scenarios))
    if asked.robust == "quantile":
        uncertain = study.scattered(middle)
        if uncertain is None:
            raise ModelError([("design.robust", "quantile needs [uncertain], found none")])
        cases = sample_cases(uncertain, CASES, drawn.seed)
        return replace(study, cases=cases, quantile=asked.quantile)
    return study


def _checked(study: DesignStudy) -> Vehicle:
    """The vehicle in the middle; what could not be answered after the search is refused before it."""
    bad, middle = [], study.space.at(study.space.nearest(np.full(len(study.space.variables), 0.5)))
    for path, law in study.laws.items():
        if not NEAR[0] <= law.median <= NEAR[1]:
            bad.append((f"uncertain.{path}", _factor(f"a median between {NEAR[0]} and {NEAR[1]}", law.median)))
    for path, (low, high) in study.tolerances.items():
        if not low <= 1 <= high or not low < high:
            bad.append((f"tolerance.{path}", _factor("low up to 1 and high from 1 on", f"{low:g} to {high:g}")))
    for table, paths in (("uncertain", study.laws), ("tolerance", study.tolerances)):
        for path in paths:
            value = value_at(middle, path)
            if not 0 < value < math.inf:
                bad.append((f"{table}.{path}", f"is {value:g}, of which a factor says nothing"))
    if bad:
        raise ModelError(bad)
    study.scattered(middle)
    for case in study.scenarios:
        case.applied(middle)
    return middle


def _factor(needed: str, found: object) -> str:
    return f"is a factor on the quantity as designed: needs {needed}, found {found}"
