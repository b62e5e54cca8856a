"""The study file: which model, which axes, how to solve (TOML)."""

import math
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import Field, FiniteFloat, PlainValidator, ValidationError, model_validator

from beal.discretisation import Formulation
from beal.errors import ModelError
from beal.interop.files import load
from beal.study.study import Solve, Study, spaced
from beal.units import to_si
from beal.vehicle.base import Part, problems, si
from beal.vehicle.file import read_toml
from beal.vehicle.links import Link
from beal.vehicle.paths import unit_at
from beal.vehicle.vehicle import Vehicle

MAX_AXIS = 1_000_000


def _number_or_text(value: Any) -> float | str:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise ValueError("must be a number, or a number with a unit")
    if isinstance(value, float) and math.isnan(value):
        raise ValueError("must be a number, found nan")
    return value


Given = Annotated[float | str, PlainValidator(_number_or_text)]  # its unit is known only with the model


class AxisEntry(Part):
    """``{from, to, points, spacing}`` or ``{values}``."""

    start: Given | None = Field(alias="from", default=None)
    stop: Given | None = Field(alias="to", default=None)
    points: Annotated[int, Field(ge=1, le=MAX_AXIS, strict=True)] | None = None
    spacing: Literal["linear", "log"] = "linear"
    values: tuple[Given, ...] | None = None

    @model_validator(mode="after")
    def _is_one_of_two(self) -> "AxisEntry":
        ends = (self.start, self.stop, self.points)
        if (self.values is None) == any(end is None for end in ends) or (
            self.values is not None and any(end is not None for end in ends)
        ):
            raise ValueError("give either values or all of from, to and points")
        return self

    def resolved(self, unit: str) -> tuple[float, ...]:
        """The values along the axis of a quantity that is kept in a unit."""
        if self.values is not None:
            return tuple(number(value, unit) for value in self.values)
        start, stop = (number(end or 0.0, unit) for end in (self.start, self.stop))
        if not (math.isfinite(start) and math.isfinite(stop)):
            raise ValueError(f"from and to must be finite, found {start} and {stop}")
        if self.spacing == "log" and min(start, stop) <= 0:
            raise ValueError(f"a log axis needs positive ends, found from {start:g} to {stop:g}")
        return spaced(start, stop, self.points or 0, self.spacing)


def number(given: float | str, unit: str) -> float:
    """A value of a study file in the unit in which its quantity is kept; ValueError where it has another dimension."""
    return to_si(given, unit) if isinstance(given, str) else float(given)


class SolveEntry(Part):
    """The ``[solve]`` table."""

    max_thrust: Annotated[FiniteFloat, si("N"), Field(gt=0)] | None = None
    tolerance: Annotated[FiniteFloat, Field(gt=0, lt=1)] = 1e-6
    formulation: Formulation = "objective"
    modes: Annotated[int, Field(ge=1, strict=True)] | None = None

    @property
    def solve(self) -> Solve:
        """As the library has it."""
        return Solve(self.max_thrust, self.tolerance, self.formulation, self.modes)


class LinkEntry(Part):
    """``{of, factor, power}``."""

    of: str
    factor: Annotated[FiniteFloat, si("")] = 1.0
    power: FiniteFloat = 1.0

    @property
    def link(self) -> Link:
        """As the library has it."""
        return Link(self.of, self.factor, self.power)


class ModelEntry(Part):
    """What all study files have."""

    model: str


E = TypeVar("E", bound=ModelEntry)


class StudyEntry(ModelEntry):
    """The whole file."""

    grid: dict[str, AxisEntry]
    links: dict[str, LinkEntry] = Field(default_factory=dict)
    solve: SolveEntry = SolveEntry()


def read_study(path: str | Path, kind: type[E]) -> tuple[E, Vehicle]:
    """A study file as its tables, and the model that it names, whose path is taken relative to it.

    Parameters
    ----------
    path : str or Path
    kind : type of Part
        With a ``model``.

    Returns
    -------
    Part
    Vehicle

    Raises
    ------
    ModelError
        With every problem of the file, or of the model.
    """
    try:
        entry = kind.model_validate(read_toml(path))
    except ValidationError as error:
        raise ModelError([(f"{path}: {where}", message) for where, message in problems(error, kind)]) from None
    return entry, load(Path(path).parent / entry.model)


def load_study(path: str | Path) -> Study:
    """Reads a study file; the model's path is taken relative to it.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Study

    Raises
    ------
    ModelError
        With every problem of the file, or of the model that it names.
    """
    entry, vehicle = read_study(path, StudyEntry)
    axes, bad = {}, []
    for name, axis in entry.grid.items():
        unit = unit_at(vehicle, name)
        try:
            axes[name] = axis.resolved(unit)
        except ValueError as error:
            bad.append((f"{path}: grid.{name}", str(error)))
    if bad:
        raise ModelError(bad)
    return Study(vehicle, axes, entry.solve.solve, {path: link.link for path, link in entry.links.items()})
