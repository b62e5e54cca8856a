"""Properties along a stage: one number, or a table over stations."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Field, FiniteFloat, Tag, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError, ValidationError

from beal.vehicle.base import PLAIN, TABLE, Part, si

Array = NDArray[np.float64]
POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
REACH = 1e-9  # share of the length within which a table's last station is the end


@dataclass(frozen=True, eq=False)  # so that tables are compared by their fields
class Arrays:
    """A table as arrays, and its integral from the front to each station."""

    x: Array
    value: Array
    cumulative: Array


class StationTable(Part):
    """A property over stations, linear between them; a station given twice is a step.

    Parameters
    ----------
    x : sequence of float
        Stations from the front of what the table describes, in m: from 0 on, never falling.
    value : sequence of float
        One for each station.

    Examples
    --------
    >>> taper = StationTable(x=[0.0, 2.0], value=[4.0, 2.0])
    >>> taper.at([0.5]).item(), taper.mean
    (3.5, 3.0)
    """

    x: tuple[Annotated[FiniteFloat, si("m"), NOT_NEGATIVE], ...]
    value: tuple[FiniteFloat, ...]

    @model_validator(mode="after")
    def _is_ordered(self) -> "StationTable":
        x = self.x
        if len(x) != len(self.value):
            raise misfit((), f"x and value must be equally long, found {len(x)} and {len(self.value)}", len(x))
        if len(x) < 2:
            raise misfit(("x",), f"must have at least two stations, found {len(x)}", len(x))
        if x[0] != 0:
            raise misfit(("x", 0), f"must be 0, the front, found {x[0]:.12g}", x[0])
        for n in range(1, len(x)):
            if x[n] < x[n - 1]:
                raise misfit(("x", n), f"must not be below the one before, {x[n - 1]:.12g}, found {x[n]:.12g}", x[n])
            if x[n] == x[n - 1] and (x[n] == x[max(n - 2, 0)] or x[n] == x[-1]):
                raise misfit(("x", n), f"may come twice, inside the table, for a step; found {x[n]:.12g} again", x[n])
        return self

    def misfit(self, length: float) -> str:
        """What is wrong with the stations for something of this length, empty if they suit it."""
        if abs(self.x[-1] - length) <= REACH * length:
            return ""
        return f"must end at the length, {length:.12g}, found {self.x[-1]:.12g}"

    def stretched(self, length: float) -> "StationTable":
        """The same values over another length."""
        factor = length / self.x[-1]
        return type(self)(x=(*(x * factor for x in self.x[:-1]), length), value=self.value)

    def at(self, x: Sequence[float] | Array) -> Array:
        """Values at stations, in any shape; in a step either side's."""
        return np.asarray(np.interp(x, self.arrays.x, self.arrays.value))

    def integral(self, x: Array) -> Array:
        """Integral from the front to stations, in any shape; exact."""
        stations, values = self.arrays.x, self.arrays.value
        piece = np.clip(np.searchsorted(stations, x, side="right") - 1, 0, len(stations) - 2)
        width = np.maximum(np.diff(stations), np.finfo(float).tiny)[piece]
        share = (np.clip(x, 0.0, stations[-1]) - stations[piece]) / width
        rise = (values[1:] - values[:-1])[piece]
        return np.asarray(self.arrays.cumulative[piece] + width * share * (values[piece] + share / 2 * rise))

    @property
    def mean(self) -> float:
        """Mean over the length."""
        return float(self.arrays.cumulative[-1]) / self.x[-1]

    @cached_property
    def moments(self) -> tuple[float, float, float]:
        """Integrals of the values times 1, x and x^2."""
        stations, values = self.arrays.x, self.arrays.value
        a, b, f, g = stations[:-1], stations[1:], values[:-1], values[1:]
        middle, mean = (a + b) / 2, (f + g) / 2
        powers = [(b - a) / 6 * (f * a**n + 4 * mean * middle**n + g * b**n) for n in range(3)]  # Simpson: to degree 3
        return float(powers[0].sum()), float(powers[1].sum()), float(powers[2].sum())

    @cached_property
    def arrays(self) -> "Arrays":
        """The same as arrays."""
        x, value = np.array(self.x), np.array(self.value)
        return Arrays(x, value, np.concatenate(([0.0], np.cumsum(np.diff(x) * (value[1:] + value[:-1]) / 2))))


class MassTable(StationTable):
    """Mass per length over stations, in kg/m."""

    value: tuple[Annotated[FiniteFloat, si("kg/m"), NOT_NEGATIVE], ...]


class StiffnessTable(StationTable):
    """Bending stiffness over stations, in N m^2."""

    value: tuple[Annotated[FiniteFloat, si("N*m^2"), POSITIVE], ...]


class ShearTable(StationTable):
    """Shear stiffness over stations, in N."""

    value: tuple[Annotated[FiniteFloat, si("N"), POSITIVE], ...]


class RotaryInertiaTable(StationTable):
    """Rotary inertia per length over stations, in kg m."""

    value: tuple[Annotated[FiniteFloat, si("kg*m"), NOT_NEGATIVE], ...]


class FoundationTable(StationTable):
    """Stiffness of a Winkler foundation over stations, in N/m^2."""

    value: tuple[Annotated[FiniteFloat, si("N/m^2"), NOT_NEGATIVE], ...]


class LoadTable(StationTable):
    """Share of the thrust per length over stations, in 1/m."""

    value: tuple[Annotated[FiniteFloat, si("1/m")], ...]


def form(value: Any) -> str:
    """Tag of the form in which a field is given."""
    return TABLE if isinstance(value, dict | Part) else PLAIN


MassPerLength = Annotated[
    Annotated[FiniteFloat, si("kg/m"), NOT_NEGATIVE, Tag(PLAIN)] | Annotated[MassTable, Tag(TABLE)],
    Discriminator(form),
]
BendingStiffness = Annotated[
    Annotated[float, si("N*m^2"), POSITIVE, Tag(PLAIN)] | Annotated[StiffnessTable, Tag(TABLE)],
    Discriminator(form),
]
ShearStiffness = Annotated[
    Annotated[float, si("N"), POSITIVE, Tag(PLAIN)] | Annotated[ShearTable, Tag(TABLE)],
    Discriminator(form),
]
RotaryInertiaPerLength = Annotated[
    Annotated[FiniteFloat, si("kg*m"), NOT_NEGATIVE, Tag(PLAIN)] | Annotated[RotaryInertiaTable, Tag(TABLE)],
    Discriminator(form),
]
FoundationStiffness = Annotated[
    Annotated[FiniteFloat, si("N/m^2"), NOT_NEGATIVE, Tag(PLAIN)] | Annotated[FoundationTable, Tag(TABLE)],
    Discriminator(form),
]
LoadPerLength = Annotated[
    Annotated[FiniteFloat, si("1/m"), Tag(PLAIN)] | Annotated[LoadTable, Tag(TABLE)],
    Discriminator(form),
]
Property = float | StationTable


def values(given: Property, x: Array) -> Array:
    """A property at distances from the front of its stage, in the shape of ``x``."""
    return given.at(x) if isinstance(given, StationTable) else np.full(np.shape(x), given)


def integral(given: Property, x: Array) -> Array:
    """Integral of a property from the front of its stage."""
    return given.integral(x) if isinstance(given, StationTable) else given * np.asarray(x)


def mean(given: Property) -> float:
    """Mean of a property over its stage."""
    return given.mean if isinstance(given, StationTable) else given


def misfit(location: tuple[str | int, ...], message: str, value: Any) -> ValidationError:
    """An error that keeps its place, however deep the part is nested."""
    detail: InitErrorDetails = {"type": PydanticCustomError("misfit", message), "loc": location, "input": value}
    return ValidationError.from_exception_data("table", [detail])
