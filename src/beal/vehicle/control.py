"""The control law of the model file: what is fed back, through which filters, to the angle of the thrust."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, FiniteFloat, ValidationInfo, field_validator, model_validator

from beal.vehicle.base import Misfit, Part, si
from beal.vehicle.stations import NOT_NEGATIVE, POSITIVE

Quantity = Literal["displacement", "rate", "acceleration", "slope", "slope_rate"]
UNITS: dict[str, str] = {  # of a gain, in radians for each unit of the quantity
    "displacement": "1/m",
    "rate": "s/m",
    "acceleration": "s^2/m",
    "slope": "",
    "slope_rate": "s",
}
HIGHEST_ORDER = 8  # of the Padé approximant: beyond it rounding spoils the coefficients


class Gain(Part):
    """What one sensor adds to the command: gain times quantity.

    Parameters
    ----------
    sensor : str
        Name of a sensor of the vehicle.
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}
    gain : float
        In radians for each unit of the quantity. A positive gain on the slope restores the attitude.
    """

    sensor: str
    quantity: Quantity
    gain: FiniteFloat

    @field_validator("gain", mode="before")
    @classmethod
    def _in_si(cls, value: Any, info: ValidationInfo) -> Any:
        unit = UNITS.get(info.data.get("quantity", ""))
        return value if unit is None else si(unit).func(value, info)  # type: ignore[call-arg]


class Filter(Part):
    """A transfer function, a ratio of polynomials in s: low-pass, notch, lead-lag.

    Parameters
    ----------
    numerator, denominator : sequence of float
        Coefficients of the powers of s, highest first; s in 1/s.
    """

    numerator: tuple[FiniteFloat, ...] = Field(min_length=1)
    denominator: tuple[FiniteFloat, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _is_realisable(self) -> "Filter":
        if not self.denominator[0]:
            raise ValueError("denominator must begin with a coefficient other than 0, found 0")
        if len(self.proper_numerator) > len(self.denominator):
            found = f"found {len(self.proper_numerator) - 1} over {len(self.denominator) - 1}"
            raise ValueError(f"is improper: the numerator's degree must be at most the denominator's, {found}")
        poles = np.roots(self.denominator[:-1] if self.integrates else self.denominator)
        if len(poles) and poles.real.max() >= 0:
            expected = "every pole, but one at 0, must have a negative real part"
            raise ValueError(f"is unstable: {expected}, found {poles.real.max():.6g}")
        return self

    @property
    def integrates(self) -> bool:
        """Whether it has a pole at 0."""
        return len(self.denominator) > 1 and not self.denominator[-1]

    @property
    def proper_numerator(self) -> tuple[float, ...]:
        """The numerator without leading zeros."""
        zeros = next((n for n, value in enumerate(self.numerator) if value), len(self.numerator) - 1)
        return self.numerator[zeros:]

    @property
    def relative_degree(self) -> int:
        """By how much the denominator's degree exceeds the numerator's."""
        return len(self.denominator) - len(self.proper_numerator)


class Actuator(Part):
    """An actuator of second order, 1/(1 + 2 zeta s/omega + s^2/omega^2).

    Parameters
    ----------
    angular_frequency : float
        omega, in rad/s.
    damping_ratio : float
        zeta.
    """

    angular_frequency: Annotated[FiniteFloat, si("rad/s"), POSITIVE]
    damping_ratio: Annotated[FiniteFloat, si(""), POSITIVE]

    @property
    def denominator(self) -> tuple[float, float, float]:
        """Coefficients of the powers of s, highest first."""
        return self.angular_frequency**-2, 2 * self.damping_ratio / self.angular_frequency, 1.0


class Engine(Part):
    """The engine that the actuator turns about its gimbal, at the station of the control law.

    Its mass is part of the vehicle's, as if the gimbal were locked; what is told here is what its turning adds.

    Parameters
    ----------
    mass : float
        In kg.
    arm : float
        Distance of its centre of mass aft of the gimbal, in m.
    inertia : float
        Moment of inertia about the gimbal, in kg m^2.
    """

    mass: Annotated[FiniteFloat, si("kg"), NOT_NEGATIVE]
    arm: Annotated[FiniteFloat, si("m")]
    inertia: Annotated[FiniteFloat, si("kg*m^2"), NOT_NEGATIVE]

    @model_validator(mode="after")
    def _is_a_body(self) -> "Engine":
        least = self.mass * self.arm**2
        if self.inertia < least * (1 - 1e-12):
            raise ValueError(
                f"inertia about the gimbal must be at least mass arm^2, {least:.6g}, found {self.inertia:g}"
            )
        return self

    @property
    def moment(self) -> float:
        """First moment of its mass about the gimbal, in kg m."""
        return self.mass * self.arm


class Control(Part):
    """Thrust vector control: the thrust turns by delta against the tangent at its station.

    The transverse force there is -P delta, delta being the filters and the actuator applied to the sum of the gains
    times what the sensors read.

    Parameters
    ----------
    station : float, optional
        In m from the nose; by default where the thrust acts.
    lag : float
        Time constant of the actuator, of first order, in s.
    delay : float
        Dead time, in s, as a Padé approximant.
    delay_order : int
        Of the approximant, as many poles as zeros.
    gains : sequence of Gain
    filters : sequence of Filter
        In series.
    actuator : Actuator, optional
        Of second order, beside the lag.
    engine : Engine, optional
        Whose inertia pushes the vehicle as it turns ("tail wags dog"); massless unless given.
    """

    station: Annotated[FiniteFloat, si("m"), NOT_NEGATIVE] | None = None
    lag: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0
    delay: Annotated[FiniteFloat, si("s"), NOT_NEGATIVE] = 0.0
    delay_order: int = Field(default=2, ge=1, le=HIGHEST_ORDER)
    gains: tuple[Gain, ...] = Field(min_length=1)
    filters: tuple[Filter, ...] = ()
    actuator: Actuator | None = None
    engine: Engine | None = None

    @property
    def relative_degree(self) -> int:
        """Of all that is between the sensors and the angle: how often it integrates a sudden change."""
        return sum(part.relative_degree for part in self.filters) + bool(self.lag) + 2 * bool(self.actuator)

    @model_validator(mode="after")
    def _has_no_algebraic_loop(self) -> "Control":
        measured = any(gain.quantity == "acceleration" and gain.gain for gain in self.gains)
        if measured and not self.relative_degree:
            raise ValueError(
                "must not be an algebraic loop, found an acceleration that the force it causes changes at once; "
                "give the actuator a lag, or a filter whose numerator is of lower degree than its denominator"
            )
        return self

    @model_validator(mode="after")
    def _turns_its_engine_smoothly(self) -> "Control":
        if self.engine and self.relative_degree < 2:
            raise ValueError(
                "engine: what has inertia cannot turn at once; give an actuator of second order, such as "
                f"{{angular_frequency = 30, damping_ratio = 0.7}}, found relative degree {self.relative_degree}"
            )
        return self

    @model_validator(mode="after")
    def _integrates_what_is_there(self) -> "Control":
        if not any(part.integrates for part in self.filters):
            return self
        if not any(gain.gain for gain in self.gains if gain.quantity in ("displacement", "slope")):
            raise ValueError(
                "filters: an integrator after rates alone takes back what they differentiate; feed back the slope or "
                "the displacement instead"
            )
        if any(not part.numerator[-1] for part in self.filters):
            raise ValueError("filters: one has a zero at 0, which cancels the other's integrator; leave out both")
        return self


def unheard(control: Any, sensors: Sequence[Any]) -> Iterator[Misfit]:
    """The sensors that a control law, raw or not, reads and that a vehicle does not have."""
    fields = control if isinstance(control, dict) else getattr(control, "__dict__", {})
    gains = fields.get("gains")
    known = ", ".join(str(name) for name in sensors) or "none"
    for n, gain in enumerate(gains if isinstance(gains, list | tuple) else ()):
        name = gain.get("sensor") if isinstance(gain, dict) else getattr(gain, "sensor", None)
        if isinstance(name, str) and name not in sensors:
            yield ("control", "gains", n, "sensor"), f"must be a sensor of this vehicle ({known}), found {name!r}", name
