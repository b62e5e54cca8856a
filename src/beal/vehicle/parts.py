"""The parts of a vehicle: stages, joints, masses, supports, thrust, sensors and forces."""

import math
import sys
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, FiniteFloat, Tag, model_validator

from beal.units import to_si
from beal.vehicle.base import PLAIN, TABLE, Part, si
from beal.vehicle.signals import Signal
from beal.vehicle.stations import (
    NOT_NEGATIVE,
    POSITIVE,
    BendingStiffness,
    FoundationStiffness,
    LoadPerLength,
    MassPerLength,
    Property,
    RotaryInertiaPerLength,
    ShearStiffness,
    StationTable,
    form,
    misfit,
)

LARGEST = sys.float_info.max
ShearAxis = Literal["mean", "forward", "aft", "inertial"]
HeldEnd = Literal["free", "clamped", "pinned", "sliding"]
HELD = {"free": (0.0, 0.0), "clamped": (math.inf, math.inf), "pinned": (math.inf, 0.0), "sliding": (0.0, math.inf)}
ALONG = (  # what varies along a stage
    "mass_per_length",
    "bending_stiffness",
    "shear_stiffness",
    "rotary_inertia_per_length",
    "foundation_stiffness",
)


class Stage(Part):
    """A beam, one stage of the vehicle or a piece of one.

    Without a shear stiffness its sections stay normal to the axis (Euler-Bernoulli); with one they turn against it by
    the shear strain y' - psi, psi being the section's rotation (Timoshenko). With an infinite bending stiffness the
    stage is rigid but for shear, and may be massless.

    Every property along the stage is a number or a table ``{x = [...], value = [...]}``: x counts from the front of the
    stage to its end, values are linear in between, and an x given twice is a step.

    Parameters
    ----------
    length : float
        In m.
    mass_per_length : float or table
        In kg/m.
    bending_stiffness : float or table
        EI, in N m^2.
    shear_stiffness : float or table
        kGA, in N; infinite unless given.
    rotary_inertia_per_length : float or table
        rho I, in kg m, which turns with the sections.
    internal_damping : float
        Kelvin-Voigt time constant, in s: the bending moment is EI (psi' + internal_damping * dpsi'/dt), the shear
        force likewise.
    external_damping : float
        Transverse force per length and rate, in N s/m^2.
    foundation_stiffness : float or table
        Of a Winkler foundation: transverse force per length and deflection, in N/m^2.
    name : str

    Examples
    --------
    >>> Stage(length=0.6, mass_per_length=1.0, bending_stiffness={"x": [0.0, 0.6], "value": [2.0, 1.0]}).mass
    0.6
    """

    name: str = ""
    length: Annotated[FiniteFloat, si("m"), POSITIVE]
    mass_per_length: MassPerLength
    bending_stiffness: BendingStiffness
    shear_stiffness: ShearStiffness = math.inf
    rotary_inertia_per_length: RotaryInertiaPerLength = 0.0
    internal_damping: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0
    external_damping: Annotated[FiniteFloat, si("N*s/m^2"), NOT_NEGATIVE] = 0.0
    foundation_stiffness: FoundationStiffness = 0.0

    @model_validator(mode="after")
    def _tables_reach_its_end(self) -> "Stage":
        for name, table in self.tables.items():
            if wrong := table.misfit(self.length):
                raise misfit((name, "x"), wrong, table.x[-1])
        mass = self.mass_per_length
        massless = 0 in mass.value if isinstance(mass, StationTable) else mass == 0
        if massless and self.bending_stiffness != math.inf:
            raise misfit(("mass_per_length",), "must be positive where the stage bends, found 0", 0.0)
        return self

    @cached_property
    def tables(self) -> dict[str, StationTable]:
        """The properties that are tables, by name."""
        given: dict[str, Property] = {name: getattr(self, name) for name in ALONG}
        return {name: value for name, value in given.items() if isinstance(value, StationTable)}

    @property
    def mass(self) -> float:
        """In kg."""
        return self.mass_moments[0]

    @property
    def mass_moments(self) -> tuple[float, float, float]:
        """Integrals of m, m x and m x^2, x from the front of the stage, in kg, kg m and kg m^2."""
        mass, length = self.mass_per_length, self.length
        if isinstance(mass, StationTable):
            return mass.moments
        return mass * length, mass * length**2 / 2, mass * length**3 / 3


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


class ElasticEnd(Part):
    """Springs between an end and the ground; an infinite stiffness holds it, zero leaves it free.

    Parameters
    ----------
    translation : float
        Against deflection, in N/m.
    rotation : float
        Against slope, in N m/rad.
    """

    translation: Annotated[float, si("N/m"), NOT_NEGATIVE] = 0.0
    rotation: Annotated[float, si("N*m/rad"), NOT_NEGATIVE] = 0.0


End = Annotated[Annotated[HeldEnd, Tag(PLAIN)] | Annotated[ElasticEnd, Tag(TABLE)], Discriminator(form)]


class Support(Part):
    """How the two ends are held: ``free``, ``clamped``, ``pinned``, ``sliding`` (slope held), or by springs.

    Parameters
    ----------
    nose, tail : {"free", "clamped", "pinned", "sliding"} or ElasticEnd
    """

    nose: End = "free"
    tail: End = "free"

    @property
    def stiffness(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Of nose and tail against deflection and slope, in N/m and N m/rad; infinite where held."""
        return _stiffness(self.nose), _stiffness(self.tail)


def _stiffness(end: HeldEnd | ElasticEnd) -> tuple[float, float]:
    return (end.translation, end.rotation) if isinstance(end, ElasticEnd) else HELD[end]


class Thrust(Part):
    """The thrust P, where it acts, and the axial force that it causes.

    Parameters
    ----------
    tangency : float
        eta: 1 for a follower force, 0 for a force fixed in space.
    scale : float
        Share of P that acts here; 0 leaves the distributed thrusts alone.
    station : float, optional
        Where it acts, in m from the nose; by default at the tail.
    line : {"moving", "fixed"}
        ``moving``: the line of action goes through the station and turns with the tangent by ``tangency``. ``fixed``:
        it stays the axis of the undeformed vehicle, as on a rigid plate under a fixed jet (Reut's column); the moment
        about the station is then ``tangency`` times that of the whole offset.
    along : {"slope", "section"}
        What the thrust turns with where the stage shears: the tangent of the axis, or the normal of its cross-section
        (an engine bolted to a bulkhead). At a bare free end the two coincide.
    axial_term : {"engesser", "haringx"}
        Direction of the axial force in a section that shears: along the tangent of the axis (Engesser), the choice of
        most finite elements, or along the normal of the section (Haringx), as in springs and rubber bearings.
    axial_force : {"inertia", "constant"}, optional
        ``inertia``: N(x) = P times the share of the mass forward of x (a vehicle in flight); ``constant``: N = P
        forward of where it acts (the nose takes the reaction). By default the first for a free-free vehicle, the
        second for a supported one.
    nominal : float, optional
        The thrust of normal operation, in N, used for margins and responses.
    signal : Signal, optional
        What a response adds to the nominal thrust over time, in N, as of a force; all else speaks of constant thrust.
    """

    tangency: Annotated[FiniteFloat, si(""), Field(ge=0, le=2)] = 1.0
    scale: Annotated[FiniteFloat, si(""), NOT_NEGATIVE] = 1.0
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE] | None = None
    line: Literal["moving", "fixed"] = "moving"
    along: Literal["slope", "section"] = "slope"
    axial_term: Literal["engesser", "haringx"] = "engesser"
    axial_force: Literal["inertia", "constant"] | None = None
    nominal: Annotated[FiniteFloat, si("N"), POSITIVE] | None = None
    signal: Signal | None = None

    @model_validator(mode="after")
    def _varies_about_a_thrust(self) -> "Thrust":
        if self.signal is not None and self.nominal is None:
            raise ValueError("signal: is added to the nominal thrust, which is missing; give nominal")
        return self


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


class DistributedThrust(Part):
    """A tangential load along the vehicle, towards the nose, that grows with the thrust P (Leipholz, Hauger).

    Parameters
    ----------
    value : float or table
        Load per length over P, in 1/m; x counts from the nose to the tail.
    tangency : float
        1 for a load that follows the tangents, 0 for one fixed in space.
    """

    value: LoadPerLength
    tangency: Annotated[FiniteFloat, si(""), Field(ge=0, le=2)] = 1.0


class AxialLoad(Part):
    """A dead load along the axis, the same at every thrust, such as drag at the nose.

    Parameters
    ----------
    station : float
        In m from the nose.
    force : float
        Towards the nose, as thrust acts, in N; drag is negative.
    tangency : float
        0 for a force fixed in space, 1 for one that turns with the vehicle, as drag does.
    """

    name: str = ""
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    force: Annotated[FiniteFloat, si("N")]
    tangency: Annotated[FiniteFloat, si(""), Field(ge=0, le=2)] = 0.0


class Sensor(Part):
    """A station whose motion is read, such as the inertial measuring unit."""

    name: str
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]


class Force(Part):
    """A transverse force F(t) at a station, positive in the direction of positive deflection."""

    name: str = ""
    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE]
    signal: Signal


def number(value: Any, unit: str) -> float:
    """A quantity of raw input; nan, which fails every comparison, where it is not one."""
    try:
        value = to_si(value, unit) if isinstance(value, str) else value
    except ValueError:
        return math.nan
    given = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if given and -LARGEST <= value <= LARGEST else math.nan
