"""Thrusts that vary in time."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beal.errors import ModelError
from beal.motion import signals
from beal.vehicle.signals import Signal

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PulsatingThrust:
    """P(t) = mean + amplitude cos(angular_frequency t + phase).

    Parameters
    ----------
    mean, amplitude : float
        In N; with an amplitude beyond the mean the thrust pulls now and then.
    angular_frequency : float
        In rad/s.
    phase : float
        In rad.

    Raises
    ------
    ModelError
        If a number is out of range.

    Examples
    --------
    >>> PulsatingThrust(90.0, 5.0, angular_frequency=2.0).at([0.0, np.pi / 2]).tolist()
    [95.0, 85.0]
    """

    mean: float
    amplitude: float
    angular_frequency: float
    phase: float = 0.0

    def __post_init__(self) -> None:
        if not np.isfinite([self.mean, self.amplitude, self.phase]).all() or self.mean < 0:
            raise ModelError(f"thrust: must be finite, its mean not negative, found {self.mean} +- {self.amplitude}")
        if not 0 < self.angular_frequency < math.inf:
            raise ModelError(f"thrust: its angular frequency must be positive, found {self.angular_frequency}")

    def at(self, time: ArrayLike) -> Array:
        """P at times, in N, shape (k,)."""
        angle = self.angular_frequency * np.asarray(time, dtype=float) + self.phase
        return np.asarray(self.mean + self.amplitude * np.cos(angle))

    @property
    def middle(self) -> float:
        """The middle of its range, in N."""
        return self.mean

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which its rate jumps, in s."""
        return ()

    @property
    def highest_frequency(self) -> float:
        """In rad/s; 0 where it does not swing."""
        return self.angular_frequency


@dataclass(frozen=True)
class ThrustTable:
    """Linear between the given times, held before the first and after the last; two of them are a ramp.

    Parameters
    ----------
    time : sequence of float
        In s, increasing.
    thrust : sequence of float
        In N.

    Raises
    ------
    ModelError
        If the two do not fit together or a number is out of range.

    Examples
    --------
    >>> ThrustTable([0.0, 2.0], [0.0, 100.0]).at([1.0, 3.0]).tolist()
    [50.0, 100.0]
    """

    time: Sequence[float]
    thrust: Sequence[float]

    def __post_init__(self) -> None:
        try:
            time, thrust = np.asarray(self.time, dtype=float), np.asarray(self.thrust, dtype=float)
        except ValueError:
            raise ModelError(f"thrust: its table must be numbers, found {self.time} and {self.thrust}") from None
        if time.ndim != 1 or time.shape != thrust.shape or not time.size:
            raise ModelError(f"thrust: needs a value for each time, found {thrust.size} for {time.size}")
        if not np.isfinite(time).all() or (np.diff(time) <= 0).any():
            raise ModelError(f"thrust: its times must be finite and increase, found {self.time}")
        if not (np.isfinite(thrust) & (thrust >= 0)).all():
            raise ModelError(f"thrust: must be finite and not negative, found {self.thrust}")
        object.__setattr__(self, "time", tuple(time.tolist()))
        object.__setattr__(self, "thrust", tuple(thrust.tolist()))

    def at(self, time: ArrayLike) -> Array:
        """P at times, in N, shape (k,)."""
        return np.asarray(np.interp(np.asarray(time, dtype=float), self.time, self.thrust))

    @property
    def middle(self) -> float:
        """The middle of its range, in N."""
        return (min(self.thrust) + max(self.thrust)) / 2

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which its rate jumps, in s."""
        return tuple(self.time)

    @property
    def highest_frequency(self) -> float:
        """In rad/s; 0 where it does not swing."""
        return 0.0


@dataclass(frozen=True)
class SignalThrust:
    """P(t) = mean + a signal, as ``thrust.signal`` of the model file says.

    Parameters
    ----------
    mean : float
        In N.
    signal : Signal
        In N.

    Examples
    --------
    >>> from beal.vehicle.signals import Step
    >>> SignalThrust(90.0, Step(kind="step", amplitude=-5.0, start=1.0)).at([0.0, 2.0]).tolist()
    [90.0, 85.0]
    """

    mean: float
    signal: Signal

    def at(self, time: ArrayLike) -> Array:
        """P at times, in N, shape (k,)."""
        return np.asarray(self.mean + signals.value(self.signal, time))

    @property
    def middle(self) -> float:
        """The mean thrust, in N."""
        return self.mean

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which it or one of its rates jumps, in s."""
        return signals.breakpoints(self.signal)

    @property
    def highest_frequency(self) -> float:
        """In rad/s."""
        return signals.highest_frequency(self.signal)


ThrustHistory = PulsatingThrust | ThrustTable | SignalThrust
