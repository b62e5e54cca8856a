"""What a force does over time."""

from typing import Annotated, Literal

from pydantic import Field, FiniteFloat, model_validator

from beal.vehicle.base import Part, si
from beal.vehicle.stations import NOT_NEGATIVE, POSITIVE

Seconds = Annotated[FiniteFloat, si("s")]
AngularFrequency = Annotated[FiniteFloat, si("rad/s"), POSITIVE]


class Sine(Part):
    """amplitude * sin(angular_frequency * t + phase)."""

    kind: Literal["sine"]
    amplitude: Annotated[FiniteFloat, si("N")]
    angular_frequency: AngularFrequency
    phase: Annotated[FiniteFloat, si("rad")] = 0.0


class Step(Part):
    """0 before ``start``, amplitude from then on."""

    kind: Literal["step"]
    amplitude: Annotated[FiniteFloat, si("N")]
    start: Annotated[Seconds, NOT_NEGATIVE] = 0.0


class Pulse(Part):
    """amplitude from ``start`` for ``duration``, 0 elsewhere."""

    kind: Literal["pulse"]
    amplitude: Annotated[FiniteFloat, si("N")]
    start: Annotated[Seconds, NOT_NEGATIVE] = 0.0
    duration: Annotated[Seconds, POSITIVE]


class Gust(Part):
    """amplitude/2 * (1 - cos(2 pi (t - start)/duration)) from ``start`` for ``duration``, 0 elsewhere.

    The 1-cosine gust of airworthiness rules, as the force that it makes.
    """

    kind: Literal["gust"]
    amplitude: Annotated[FiniteFloat, si("N")]
    start: Annotated[Seconds, NOT_NEGATIVE] = 0.0
    duration: Annotated[Seconds, POSITIVE]


class Chirp(Part):
    """A sine whose angular frequency runs from ``first`` to ``last`` in ``duration`` and stays there.

    amplitude * sin(first t + (last - first) t^2/(2 duration) + phase); afterwards the phase goes on at ``last``.

    Parameters
    ----------
    amplitude : float
        In N.
    first, last : float
        In rad/s; the sweep is linear in time and may go down.
    duration : float
        Of the sweep, in s.
    phase : float
        In rad.
    """

    kind: Literal["chirp"]
    amplitude: Annotated[FiniteFloat, si("N")]
    first: AngularFrequency
    last: AngularFrequency
    duration: Annotated[Seconds, POSITIVE]
    phase: Annotated[FiniteFloat, si("rad")] = 0.0


class Noise(Part):
    """Stationary Gaussian noise of a given spectrum, the same for the same seed.

    A sum of sines sqrt(2 S_k dw) sin(w_k t + phase_k) (Shinozuka & Jan 1972): each interval of the spectrum is cut into
    ``lines`` bands of width dw, of which each holds one sine with the power of its band; its frequency within the band
    and its phase are drawn at random, so that the noise does not repeat. It is Gaussian as far as many lines are.

    Parameters
    ----------
    angular_frequency : sequence of float
        In rad/s, increasing; no power lies outside.
    density : sequence of float
        One-sided power spectral density S there, in N^2 s/rad, linear in between: the variance of the force is the
        integral of S over the angular frequency. A density per Hz is 2 pi times as large.
    seed : int
    lines : int
        Sines in each interval of the spectrum.
    """

    kind: Literal["noise"]
    angular_frequency: tuple[AngularFrequency, ...] = Field(min_length=2)
    density: tuple[Annotated[FiniteFloat, si("N^2*s/rad"), NOT_NEGATIVE], ...] = Field(min_length=2)
    seed: Annotated[int, Field(ge=0, le=2**53)]
    lines: Annotated[int, Field(ge=1, le=1000)] = 100

    @model_validator(mode="after")
    def _is_ordered(self) -> "Noise":
        _check_columns("angular_frequency", self.angular_frequency, "density", self.density)
        return self


class Table(Part):
    """Linear between the given times, held before the first and after the last."""

    kind: Literal["table"]
    time: tuple[Seconds, ...] = Field(min_length=2)
    value: tuple[Annotated[FiniteFloat, si("N")], ...] = Field(min_length=2)

    @model_validator(mode="after")
    def _is_ordered(self) -> "Table":
        _check_columns("time", self.time, "value", self.value)
        return self


def _check_columns(name: str, given: tuple[float, ...], other: str, values: tuple[float, ...]) -> None:
    if len(given) != len(values):
        raise ValueError(f"{name} and {other} must be equally long, found {len(given)} and {len(values)}")
    for index, (before, after) in enumerate(zip(given, given[1:], strict=False), 1):
        if after <= before:
            raise ValueError(
                f"{name} must increase from entry to entry, found {after:.12g} after {before:.12g}, at [{index}]"
            )


Signal = Annotated[Sine | Step | Pulse | Gust | Chirp | Noise | Table, Field(discriminator="kind")]
