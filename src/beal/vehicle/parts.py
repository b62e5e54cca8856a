"""The parts of a vehicle: stages, joints, masses, supports, thrust, sensors and forces."""

import math
import sys
from typing import Annotated, Any, Literal

from pydantic import Field, FiniteFloat, model_validator

from beal.vehicle.base import Part, si

LARGEST = sys.float_info.max
POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
ShearAxis = Literal["mean", "forward", "aft", "inertial"]
End = Literal["free", "clamped", "pinned", "sliding"]


class Stage(Part):
    """A uniform Euler-Bernoulli beam, one stage of the vehicle or a piece of one.

    Parameters
    ----------
    length : float
        In m.
    mass_per_length : float
        In kg/m.
    bending_stiffness : float
        EI, in N m^2.
    internal_damping : float
        Kelvin-Voigt time constant, in s: the bending moment is EI (y'' + internal_damping * dy''/dt).
    external_damping : float
        Transverse force per length and rate, in N s/m^2.
    name : str

    Examples
    --------
    >>> Stage(length=0.6, mass_per_length=1.0, bending_stiffness=1.0).length
    0.6
    """

    name: str = ""
    length: Annotated[FiniteFloat, si("m"), POSITIVE]
    mass_per_length: Annotated[FiniteFloat, si("kg/m"), POSITIVE]
    bending_stiffness: Annotated[FiniteFloat, si("N*m^2"), POSITIVE]
    internal_damping: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0
    external_damping: Annotated[FiniteFloat, si("N*s/m^2"), NOT_NEGATIVE] = 0.0


class Joint(Part):
    """A rotational and a shear spring between two stages; an infinite stiffness is rigid.

    Parameters
    ----------
    rotational_stiffness : float
        k_r, in N m/rad.
    shear_stiffness : float
        k_s, in N/m.
    rotational_damping, shear_damping : float
        Of dashpots beside the springs, in N m s/rad and N s/m; a rigid joint does not move and its dashpots do nothing.
    shear_axis : {"mean", "forward", "aft", "inertial"}
        Direction along which the shear spring slides: the mean of both faces' slopes, one face's slope, or fixed in
        space. The last is the choice of Irani & Kavianipour (2009), whose joint does not balance moments.
    """

    name: str = ""
    rotational_stiffness: Annotated[float, si("N*m/rad"), NOT_NEGATIVE] = math.inf
    shear_stiffness: Annotated[float, si("N/m"), NOT_NEGATIVE] = math.inf
    rotational_damping: Annotated[FiniteFloat, si("N*m*s/rad"), NOT_NEGATIVE] = 0.0
    shear_damping: Annotated[FiniteFloat, si("N*s/m"), NOT_NEGATIVE] = 0.0
    shear_axis: ShearAxis = "mean"


class PointMass(Part):
    """A rigid lump at a station; at a joint it sits on the aft face.

    Parameters
    ----------
    station : float
        Distance from the nose, in m.
    mass : float
        In kg.
    rotary_inertia : float
        About the lump's own transverse axis, in kg m^2.
    """

    name: str = ""
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    mass: Annotated[FiniteFloat, si("kg"), NOT_NEGATIVE]
    rotary_inertia: Annotated[FiniteFloat, si("kg*m^2"), NOT_NEGATIVE] = 0.0


class Support(Part):
    """How the two ends are held: ``free``, ``clamped``, ``pinned`` or ``sliding`` (slope held, deflection free)."""

    nose: End = "free"
    tail: End = "free"


class Thrust(Part):
    """The thrust P at the tail and the axial force that it causes.

    Parameters
    ----------
    tangency : float
        eta: 1 for a follower force, 0 for a force fixed in space.
    axial_force : {"inertia", "constant"}, optional
        ``inertia``: N(x) = P times the share of the mass forward of x (a vehicle in flight); ``constant``: N = P
        (the nose takes the reaction). By default the first for a free-free vehicle, the second for a supported one.
    nominal : float, optional
        The thrust of normal operation, in N, used for margins and responses.
    """

    tangency: Annotated[FiniteFloat, si(""), Field(ge=0, le=2)] = 1.0
    axial_force: Literal["inertia", "constant"] | None = None
    nominal: Annotated[FiniteFloat, si("N"), POSITIVE] | None = None


class Damping(Part):
    """Damping that is known by its ratios rather than by where it comes from; adds to that of stages and joints.

    Parameters
    ----------
    ratios : sequence of float
        Share of critical damping of the elastic modes of the unloaded vehicle, in order of frequency; the last ratio
        holds for all modes above. Empty: none.

    Examples
    --------
    >>> Damping(ratios=[0.01, 0.005]).ratios
    (0.01, 0.005)
    """

    ratios: tuple[Annotated[FiniteFloat, si(""), NOT_NEGATIVE], ...] = ()


class Sensor(Part):
    """A station whose motion is read, such as the inertial measuring unit."""

    name: str
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]


class Sine(Part):
    """amplitude * sin(angular_frequency * t + phase)."""

    kind: Literal["sine"]
    amplitude: Annotated[FiniteFloat, si("N")]
    angular_frequency: Annotated[FiniteFloat, si("rad/s"), POSITIVE]
    phase: Annotated[FiniteFloat, si("rad")] = 0.0


class Step(Part):
    """0 before ``start``, amplitude from then on."""

    kind: Literal["step"]
    amplitude: Annotated[FiniteFloat, si("N")]
    start: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0


class Pulse(Part):
    """amplitude from ``start`` for ``duration``, 0 elsewhere."""

    kind: Literal["pulse"]
    amplitude: Annotated[FiniteFloat, si("N")]
    start: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0
    duration: Annotated[FiniteFloat, si("s"), POSITIVE]


class Table(Part):
    """Linear between the given times, held before the first and after the last."""

    kind: Literal["table"]
    time: tuple[Annotated[FiniteFloat, si("s")], ...] = Field(min_length=2)
    value: tuple[Annotated[FiniteFloat, si("N")], ...] = Field(min_length=2)

    @model_validator(mode="after")
    def _is_ordered(self) -> "Table":
        if len(self.time) != len(self.value):
            raise ValueError(f"time and value must be equally long, found {len(self.time)} and {len(self.value)}")
        if any(b <= a for a, b in zip(self.time, self.time[1:], strict=False)):
            raise ValueError("time must increase from entry to entry, found a repeated or a smaller one")
        return self


Signal = Annotated[Sine | Step | Pulse | Table, Field(discriminator="kind")]


class Force(Part):
    """A transverse force F(t) at a station, positive in the direction of positive deflection."""

    name: str = ""
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    signal: Signal


def known(value: Any) -> bool:
    """Whether a field of raw input is a usable number."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return number and -LARGEST <= value <= LARGEST
