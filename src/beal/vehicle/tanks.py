"""Tanks: propellant that adds mass to the stages it lies in, and nothing else."""

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Annotated

import numpy as np
from pydantic import Discriminator, Field, FiniteFloat, Tag, model_validator

from beal.vehicle.base import PLAIN, TABLE, Part, si
from beal.vehicle.parts import Stage
from beal.vehicle.stations import NOT_NEGATIVE, POSITIVE, REACH, Array, MassTable, Property, StationTable, form, misfit


class ContentTable(StationTable):
    """Mass per length of propellant over stations, in kg/m; none where a dome closes the tank."""

    value: tuple[Annotated[FiniteFloat, si("kg/m"), NOT_NEGATIVE], ...]


Content = Annotated[
    Annotated[FiniteFloat, si("kg/m"), POSITIVE, Tag(PLAIN)] | Annotated[ContentTable, Tag(TABLE)],
    Discriminator(form),
]


class Tank(Part):
    """Propellant that thrust has settled: a column that fills the tank from its aft end, without stiffness.

    It moves with the stages that it lies in and adds to their mass per length; it has no rotary inertia and does not
    slosh. Tanks may reach over several stages and may overlap, as those with a common bulkhead do.

    Parameters
    ----------
    name : str
        Unique, as the timeline speaks of it.
    forward_end, aft_end : float
        In m from the nose.
    mass_per_length : float or table
        Of the full tank, in kg/m; x counts from the forward end.
    fill : float
        Share of the mass of the full tank, 0 to 1.

    Examples
    --------
    >>> tank = Tank(name="LOX", forward_end=1.0, aft_end=3.0, mass_per_length=50.0, fill=0.25)
    >>> tank.mass, tank.surface
    (25.0, 2.5)
    """

    name: str
    forward_end: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    aft_end: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    mass_per_length: Content
    fill: Annotated[FiniteFloat, si(""), Field(ge=0, le=1)] = 1.0

    @model_validator(mode="after")
    def _has_a_length(self) -> "Tank":
        if self.aft_end <= self.forward_end:
            message = f"must lie aft of forward_end, {self.forward_end:.12g}, found {self.aft_end:.12g}"
            raise misfit(("aft_end",), message, self.aft_end)
        table = self.mass_per_length
        if isinstance(table, StationTable) and (wrong := table.misfit(self.length)):
            raise misfit(("mass_per_length", "x"), wrong, table.x[-1])
        return self

    @property
    def length(self) -> float:
        """From end to end, in m."""
        return self.aft_end - self.forward_end

    @property
    def mass(self) -> float:
        """Of what is in it, in kg."""
        full = self.mass_per_length
        return self.fill * (full.moments[0] if isinstance(full, StationTable) else full * self.length)

    @property
    def surface(self) -> float:
        """Station of the propellant's surface, in m from the nose."""
        full = self.mass_per_length
        if isinstance(full, StationTable):
            return self.forward_end + _reached(full, 1.0 - self.fill)
        return self.aft_end - self.fill * self.length

    @property
    def profile(self) -> tuple[Array, Array]:
        """Stations, in m from the nose, and mass per length of the full tank, linear in between."""
        x, value = _profile(self.mass_per_length, self.length)
        return self.forward_end + x, value


def laden(stages: Sequence[Stage], tanks: Sequence[Tank]) -> tuple[Stage, ...]:
    """Stages with what is in the tanks added to their mass per length.

    Parameters
    ----------
    stages : sequence of Stage
        From the nose.
    tanks : sequence of Tank

    Returns
    -------
    tuple of Stage
        A stage without propellant is the same object; surfaces and ends of tanks are steps of a table.

    Examples
    --------
    >>> stage = Stage(length=2.0, mass_per_length=1.0, bending_stiffness=1.0)
    >>> tank = Tank(name="fuel", forward_end=0.0, aft_end=1.0, mass_per_length=8.0, fill=0.5)
    >>> laden([stage], [tank])[0].mass_per_length
    MassTable(x=(0.0, 0.5, 0.5, 1.0, 1.0, 2.0), value=(1.0, 1.0, 9.0, 9.0, 1.0, 1.0))
    """
    ends = list(accumulate((stage.length for stage in stages), initial=0.0))
    margin = REACH * ends[-1]
    found = []
    for stage, front, back in zip(stages, ends, ends[1:], strict=False):
        inside = [t for t in tanks if t.fill and t.surface < back - margin and t.aft_end > front + margin]
        found.append(_laden(stage, front, inside, margin) if inside else stage)
    return tuple(found)


def _laden(stage: Stage, front: float, tanks: Sequence[Tank], margin: float) -> Stage:
    own = _profile(stage.mass_per_length, stage.length)
    profiles = [(0.0, stage.length, *own)]
    for tank in tanks:
        stations, value = tank.profile
        profiles.append((tank.surface - front, tank.aft_end - front, stations - front, value))
    edges = np.sort(np.concatenate([np.append(x[x > start], start) for start, _, x, _ in profiles]))
    edges = edges[(edges > margin) & (edges < stage.length - margin)]
    edges = np.concatenate(([0.0], edges[np.diff(edges, prepend=0.0) > margin], [stage.length]))
    total = sum((_sides(edges, *profile) for profile in profiles), np.zeros((len(edges) - 1, 2))).ravel()
    x = np.column_stack((edges[:-1], edges[1:])).ravel()
    kept = np.append(True, (np.diff(x) > 0) | ~np.isclose(total[1:], total[:-1], rtol=1e-12, atol=0.0))
    table = MassTable(x=tuple(x[kept].tolist()), value=tuple(total[kept].tolist()))
    return stage.model_copy(update={"mass_per_length": table})


def _profile(given: Property, length: float) -> tuple[Array, Array]:
    """Stations from the front, and values there, linear in between."""
    if isinstance(given, StationTable):
        return given.arrays.x, given.arrays.value
    return np.array([0.0, length]), np.array([given, given])


def _sides(edges: Array, start: float, end: float, x: Array, value: Array) -> Array:
    """Values just inside both ends of the intervals between edges, 0 outside start to end, shape (intervals, 2)."""
    middle = (edges[1:] + edges[:-1]) / 2
    found = np.zeros((len(middle), 2))
    inside = (middle > start) & (middle < end)
    piece = np.clip(np.searchsorted(x, middle[inside], side="right") - 1, 0, len(x) - 2)
    slope = (value[piece + 1] - value[piece]) / (x[piece + 1] - x[piece])
    for side, at in enumerate((edges[:-1], edges[1:])):
        found[inside, side] = value[piece] + slope * (at[inside] - x[piece])
    return found


def _reached(table: StationTable, share: float) -> float:
    """Where the integral from the front reaches a share of the whole."""
    x, value, cumulative = table.arrays.x, table.arrays.value, table.arrays.cumulative
    target = share * cumulative[-1]
    piece = min(int(np.searchsorted(cumulative, target, side="right")) - 1, len(x) - 2)
    rest, slope = target - cumulative[piece], (value[piece + 1] - value[piece]) / (x[piece + 1] - x[piece])
    if rest <= 0:
        return float(x[piece])
    at_target = math.sqrt(max(value[piece] ** 2 + 2 * slope * rest, 0.0))
    return float(x[piece] + 2 * rest / (value[piece] + at_target))
