"""The study file: which model, which axes, how to solve (TOML)."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, FiniteFloat, ValidationError, model_validator

from beal.discretisation import Formulation
from beal.errors import ModelError
from beal.interop.files import load
from beal.study.study import Solve, Study, spaced
from beal.vehicle.base import Part, problems, si
from beal.vehicle.file import read_toml
from beal.vehicle.links import Link

MAX_AXIS = 1_000_000


class AxisEntry(Part):
    """``{from, to, points, spacing}`` or ``{values}``."""

    start: Annotated[FiniteFloat, si("")] | None = Field(alias="from", default=None)
    stop: Annotated[FiniteFloat, si("")] | None = Field(alias="to", default=None)
    points: Annotated[int, Field(ge=1, le=MAX_AXIS, strict=True)] | None = None
    spacing: Literal["linear", "log"] = "linear"
    values: tuple[Annotated[float, si("")], ...] | None = None

    @model_validator(mode="after")
    def _is_one_of_two(self) -> "AxisEntry":
        ends = (self.start, self.stop, self.points)
        if (self.values is None) == any(end is None for end in ends) or (
            self.values is not None and any(end is not None for end in ends)
        ):
            raise ValueError("give either values or all of from, to and points")
        if self.values is None and self.spacing == "log" and min(self.start or 0, self.stop or 0) <= 0:
            raise ValueError(f"a log axis needs positive ends, found from {self.start} to {self.stop}")
        return self

    def resolved(self) -> tuple[float, ...]:
        """The values along the axis."""
        if self.values is not None:
            return self.values
        return spaced(self.start or 0.0, self.stop or 0.0, self.points or 0, self.spacing)


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


class StudyEntry(Part):
    """The whole file."""

    model: str
    grid: dict[str, AxisEntry]
    links: dict[str, LinkEntry] = Field(default_factory=dict)
    solve: SolveEntry = SolveEntry()


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
    raw = read_toml(path)
    try:
        entry = StudyEntry.model_validate(raw)
    except ValidationError as error:
        raise ModelError([(f"{path}: {where}", message) for where, message in problems(error, StudyEntry)]) from None
    vehicle = load(Path(path).parent / entry.model)
    axes = {name: axis.resolved() for name, axis in entry.grid.items()}
    return Study(vehicle, axes, entry.solve.solve, {path: link.link for path, link in entry.links.items()})
