"""The vehicle: all its parts, checked against each other."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, FiniteFloat, model_validator

from beal.shown import Shown
from beal.vehicle.base import Misfit, Part, refusal, si, together
from beal.vehicle.control import Control, unheard
from beal.vehicle.parts import (
    AxialLoad,
    Damping,
    DistributedThrust,
    Force,
    Joint,
    PointMass,
    Sensor,
    Stage,
    Support,
    Thrust,
    number,
)
from beal.vehicle.stations import StationTable, mean
from beal.vehicle.tanks import Tank, laden
from beal.vehicle.timeline import Timeline, strangers

# Parts that sit somewhere: key in the model file, field, and their stations.
PLACED = (
    ("point_mass", "point_masses", ("station",)),
    ("tank", "tanks", ("forward_end", "aft_end")),
    ("axial_load", "axial_loads", ("station",)),
    ("sensor", "sensors", ("station",)),
    ("force", "forces", ("station",)),
)


@dataclass(frozen=True)
class Scales:
    """Reference length [m], mass per length [kg/m] and bending stiffness [N m^2] of the non-dimensional form.

    Irani & Kavianipour (2009), Eq. (6): the whole length, and the properties of the first stage that bends, their mean
    where they vary. Where none does, the whole mass over the length, and what shears or the springs are worth.
    """

    length: float
    mass_per_length: float
    bending_stiffness: float

    @property
    def thrust(self) -> float:
        """EI/L^2, in N."""
        return self.bending_stiffness / self.length**2

    @property
    def time(self) -> float:
        """sqrt(m L^4/EI), in s."""
        return math.sqrt(self.mass_per_length * self.length**4 / self.bending_stiffness)

    @property
    def angular_frequency(self) -> float:
        """1/time, in rad/s."""
        return 1.0 / self.time


class Vehicle(Part, Shown):
    """A flexible vehicle: stages from nose to tail, the joints between them, masses, supports and loads.

    Parameters
    ----------
    stages : sequence of Stage
        From nose (x = 0) to tail (x = L).
    joints : sequence of Joint
        One fewer than the stages, in order.
    point_masses : sequence of PointMass
    tanks : sequence of Tank
    support : Support
    thrust : Thrust
    damping : Damping
    distributed_thrusts : sequence of DistributedThrust
    axial_loads : sequence of AxialLoad
    gravity : float
        Along the axis from nose to tail, in m/s^2. Only a vehicle whose ends take the reaction bears its weight; in
        flight gravity accelerates all parts alike.
    sensors : sequence of Sensor
    forces : sequence of Force
    control : Control, optional
        Thrust vector control, see `beal.closed_loop`; what is said of the vehicle elsewhere is without it.
    timeline : Timeline, optional
        Of a flight, see `beal.flight`.
    title : str
    units : {"SI", "nondimensional"}

    Raises
    ------
    ModelError
        With every problem and its path.

    Examples
    --------
    >>> beam = Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
    >>> Vehicle(stages=[beam, beam], joints=[Joint(rotational_stiffness=10.0)]).length
    1.0
    """

    title: str = ""
    units: Literal["SI", "nondimensional"] = "SI"
    stages: tuple[Stage, ...] = Field(alias="stage")
    joints: tuple[Joint, ...] = Field(alias="joint", default=())
    point_masses: tuple[PointMass, ...] = Field(alias="point_mass", default=())
    tanks: tuple[Tank, ...] = Field(alias="tank", default=())
    support: Support = Support()
    thrust: Thrust = Thrust()
    damping: Damping = Damping()
    distributed_thrusts: tuple[DistributedThrust, ...] = Field(alias="distributed_thrust", default=())
    axial_loads: tuple[AxialLoad, ...] = Field(alias="axial_load", default=())
    gravity: Annotated[FiniteFloat, si("m/s^2")] = 0.0
    sensors: tuple[Sensor, ...] = Field(alias="sensor", default=())
    forces: tuple[Force, ...] = Field(alias="force", default=())
    control: Control | None = None
    timeline: Timeline | None = None

    @model_validator(mode="wrap")
    @classmethod
    def _fits_together(cls, data: Any, handler: Any) -> "Vehicle":
        vehicle: Vehicle = together(cls, data, handler, _misfits)
        with np.errstate(over="ignore", invalid="ignore"):  # of tables that leave the range of numbers
            if misfits := list(vehicle._unsuited_loads()):
                raise refusal(cls, misfits)
            if not vehicle._in_range():
                message = "lengths, masses and stiffnesses leave the range of numbers: use units of the vehicle's size"
                raise refusal(cls, [(("stage",), message, vehicle.length)])
        return vehicle

    @cached_property
    def boundaries(self) -> tuple[float, ...]:
        """Stations of the stages' ends, from 0 to the length, in m."""
        return tuple(accumulate((stage.length for stage in self.stages), initial=0.0))

    @property
    def length(self) -> float:
        """Whole length, in m."""
        return self.boundaries[-1]

    @cached_property
    def laden(self) -> tuple[Stage, ...]:
        """The stages with what is in the tanks added to their mass per length: what moves and is accelerated."""
        return laden(self.stages, self.tanks) if self.tanks else self.stages

    @property
    def without_tanks(self) -> "Vehicle":
        """The same vehicle now: what is in the tanks as mass of its stages, and no timeline."""
        if not self.tanks and self.timeline is None:
            return self
        return self.model_copy(update={"stages": self.laden, "tanks": (), "timeline": None})

    @property
    def mass(self) -> float:
        """Total mass, in kg."""
        return sum(stage.mass for stage in self.laden) + sum(p.mass for p in self.point_masses)

    @property
    def centre_of_mass(self) -> float:
        """Station of the centre of mass, in m."""
        stages = zip(self.laden, self.boundaries, strict=False)
        moment = sum(x * stage.mass + stage.mass_moments[1] for stage, x in stages)
        return (moment + sum(p.mass * p.station for p in self.point_masses)) / self.mass

    @property
    def moment_of_inertia(self) -> float:
        """Pitch inertia of the rigid vehicle about its centre of mass, in kg m^2."""
        centre = self.centre_of_mass
        inertia = sum(p.rotary_inertia + p.mass * (p.station - centre) ** 2 for p in self.point_masses)
        inertia += sum(mean(stage.rotary_inertia_per_length) * stage.length for stage in self.stages)
        for stage, x in zip(self.laden, self.boundaries, strict=False):
            mass, first, second = stage.mass_moments
            front = x - centre
            inertia += second + 2 * front * first + front**2 * mass
        return inertia

    @property
    def free_free(self) -> bool:
        """Whether neither end is held."""
        return not any(stiffness for end in self.support.stiffness for stiffness in end)

    @property
    def founded(self) -> bool:
        """Whether an elastic foundation holds any stage."""
        return any(mean(stage.foundation_stiffness) for stage in self.stages)

    @cached_property
    def shears(self) -> bool:
        """Whether any stage has a finite shear stiffness."""
        return any(mean(stage.shear_stiffness) < math.inf for stage in self.stages)

    @cached_property
    def deforms(self) -> bool:
        """Whether any stage bends or shears; else there are no more modes than springs."""
        return self.shears or any(mean(stage.bending_stiffness) < math.inf for stage in self.stages)

    @cached_property
    def turns_inertia(self) -> bool:
        """Whether any stage has rotary inertia."""
        return any(mean(stage.rotary_inertia_per_length) for stage in self.stages)

    @property
    def axial_force(self) -> Literal["inertia", "constant"]:
        """The axial force law in force, the default resolved."""
        return self.thrust.axial_force or ("inertia" if self.free_free else "constant")

    @cached_property
    def damped(self) -> bool:
        """Whether anything in it dissipates energy; the dashpot of a rigid joint does not."""
        springs = [(j.rotational_stiffness, j.rotational_damping) for j in self.joints]
        springs += [(j.shear_stiffness, j.shear_damping) for j in self.joints]
        dashpots = (damping for stiffness, damping in springs if math.isfinite(stiffness))
        losses = (c for s in self.stages for c in (s.internal_damping, s.external_damping))
        return any(dashpots) or any(losses) or any(self.damping.ratios)

    @property
    def undamped(self) -> "Vehicle":
        """The vehicle without its damping."""
        if not self.damped:
            return self
        stages = [s.model_copy(update={"internal_damping": 0.0, "external_damping": 0.0}) for s in self.stages]
        joints = [j.model_copy(update={"rotational_damping": 0.0, "shear_damping": 0.0}) for j in self.joints]
        return self.model_copy(update={"stages": tuple(stages), "joints": tuple(joints), "damping": Damping()})

    @property
    def scales(self) -> Scales:
        """Reference quantities of the non-dimensional form."""
        for stage in self.laden:
            if math.isfinite(stiffness := mean(stage.bending_stiffness)):
                return Scales(self.length, mean(stage.mass_per_length), stiffness)
        return Scales(self.length, self.mass / self.length, next(self._other_stiffnesses(), math.nan))

    def _other_stiffnesses(self) -> Iterator[float]:
        """What is neither rigid nor absent beside bending, in N m^2."""
        length = self.length
        given = [mean(stage.shear_stiffness) * length**2 for stage in self.stages]
        given += [joint.rotational_stiffness * length for joint in self.joints]
        given += [rotation * length for _, rotation in self.support.stiffness]
        given += [joint.shear_stiffness * length**3 for joint in self.joints]
        given += [translation * length**3 for translation, _ in self.support.stiffness]
        return (stiffness for stiffness in given if 0 < stiffness < math.inf)

    def _unsuited_loads(self) -> Iterator[Misfit]:
        for index, load in enumerate(self.distributed_thrusts):
            if isinstance(load.value, StationTable) and (wrong := load.value.misfit(self.length)):
                yield ("distributed_thrust", index, "value", "x"), wrong, load.value.x[-1]
        if not self.thrust.scale and not self.distributed_thrusts:
            yield ("thrust", "scale"), "must be positive where there is no distributed thrust, found 0", 0.0
        if math.isnan(self.scales.bending_stiffness):
            yield ("stage",), "some stage must bend or shear, or some joint or end be elastic, found a rigid body", None

    def _in_range(self) -> bool:
        try:
            values = (self.scales.thrust, self.scales.time, self.mass * self.length**2)
        except (OverflowError, ZeroDivisionError):
            return False
        return all(0 < value < math.inf for value in values)

    def stage_at(self, station: float) -> int:
        """Index of the stage that holds a station; a joint's station belongs to the stage aft of it."""
        inner = self.boundaries[1:-1]
        tolerance = 1e-12 * self.length
        return sum(station >= x - tolerance for x in inner)


def _misfits(data: dict[str, Any]) -> Iterator[Misfit]:
    """(location, message, input) of what does not fit together in raw input, as far as it can be judged."""
    stages = _parts(data, "stage", "stages")
    joints = _parts(data, "joint", "joints")
    if data.get("stage", data.get("stages")) in ([], ()):
        yield ("stage",), "a vehicle needs at least one stage, found none", None
    elif stages and len(joints) != len(stages) - 1:
        message = (
            f"must be one fewer than the stages, {len(stages) - 1} (an empty [[joint]] is rigid), found {len(joints)}"
        )
        yield ("joint",), message, len(joints)
    lengths = [metres(stage, "length") for stage in stages]
    total = sum(lengths) if lengths and all(x > 0 for x in lengths) else math.inf
    for alias, name, fields in PLACED:
        for index, part in enumerate(_parts(data, alias, name)):
            for field in fields:
                station = metres(part, field)
                if station > total * (1 + 1e-12):
                    message = f"must lie on the vehicle, 0 to {total:.12g}, found {station:.12g}"
                    yield (alias, index, field), message, station
    for name in ("thrust", "control"):
        station = metres(_field(data, name), "station")
        if station > total * (1 + 1e-12):
            message = f"must lie on the vehicle, 0 to {total:.12g}, found {station:.12g}"
            yield (name, "station"), message, station
    for alias, name in (("tank", "tanks"), ("sensor", "sensors")):
        names = [_field(part, "name") for part in _parts(data, alias, name)]
        for index, given in enumerate(names):
            if isinstance(given, str) and given in names[:index]:
                yield (alias, index, "name"), f"must be unique, found {given!r} again", given
    yield from unheard(data.get("control"), [_field(part, "name") for part in _parts(data, "sensor", "sensors")])
    tanks = [_field(tank, "name") for tank in _parts(data, "tank", "tanks")]
    yield from strangers(data.get("timeline"), tanks, len(stages))


def _parts(data: dict[str, Any], alias: str, name: str) -> list[Any]:
    parts = data.get(alias, data.get(name, ()))
    return list(parts) if isinstance(parts, list | tuple) else []


def _field(part: Any, name: str) -> Any:
    return part.get(name) if isinstance(part, dict) else getattr(part, name, None)


def metres(part: Any, name: str) -> float:
    """A length of raw input; nan, which fails every comparison, where it is not one."""
    return number(_field(part, name), "m")
