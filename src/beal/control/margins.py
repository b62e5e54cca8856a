"""Gain and phase margins: how far the loop, broken at the actuator, is from a root on the imaginary axis.

With e the sum of gains times readings that goes into filters and actuator and -L e the one that then comes back,
1 + L = 0 at the roots. Where the phase of L(i omega) is 180 degrees, L(s) - L(-s) vanishes; where its modulus is 1,
L(s) L(-s) - 1 does. Both are zeros of a state space and so eigenvalues: no grid of frequencies can miss one beside a
lightly damped mode.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.linalg import block_diag, eigvals

from beal.control.compensator import Array
from beal.control.loop import Loop
from beal.control.opened import broken, opened
from beal.discretisation import Operators
from beal.shown import Shown
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

LEAST = 1e-8  # of |L| where a gain margin is told; below, L vanishes
REAL = 1e-6  # |Im L| beside |L| of a zero of Im L; at an undamped mode, a pole, the secant method ends too
AXIS = 1e-3  # |Re s| beside |s| of a zero that may lie on the axis; the secant method decides
RIGID = 1e-3  # frequency of a rigid-body motion, beside the reference frequency
STEPS, CLOSE, APART = 30, 1e-13, 1e-6  # of the secant method, and relative distance below which two are one


@dataclass(frozen=True)
class GainMargin:
    """All gains times ``factor`` put a root on the imaginary axis.

    Parameters
    ----------
    factor : float
    angular_frequency : float
        Of that root, in rad/s.
    mode : int
        The elastic mode of the open loop that is nearest in frequency, from 1; 0 is a rigid-body motion.
    """

    factor: float
    angular_frequency: float
    mode: int

    @property
    def decibel(self) -> float:
        """20 log10 of the factor."""
        return 20 * math.log10(self.factor)


@dataclass(frozen=True)
class PhaseMargin:
    """A lag by ``degrees`` more puts a root on the imaginary axis.

    Parameters
    ----------
    degrees : float
        Between -180 and 180; negative where a lead does it.
    angular_frequency : float
        Of that root, in rad/s.
    mode : int
        As of a gain margin.
    """

    degrees: float
    angular_frequency: float
    mode: int

    @property
    def delay(self) -> float:
        """The dead time that does it, in s."""
        return math.radians(self.degrees % 360) / self.angular_frequency


@dataclass(frozen=True)
class Margins(Shown):
    """Where the loop of a vehicle, broken at the actuator, meets -1.

    Parameters
    ----------
    thrust : float
        In N.
    gain : tuple of GainMargin
    phase : tuple of PhaseMargin
        In order of frequency, as many as there are.
    units : {"SI", "nondimensional"}
    """

    thrust: float
    gain: tuple[GainMargin, ...]
    phase: tuple[PhaseMargin, ...]
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def smallest_gain(self) -> GainMargin | None:
        """The gain margin nearest to the factor 1, up or down."""
        return min(self.gain, key=lambda margin: abs(margin.decibel), default=None)

    @property
    def smallest_phase(self) -> PhaseMargin | None:
        """The smallest phase margin, lag or lead."""
        return min(self.phase, key=lambda margin: abs(margin.degrees), default=None)


def stability_margins(model: Vehicle | Operators, thrust: float | None = None, modes: int = 6) -> Margins:
    """Gain and phase margins of the control loop, at every frequency where there is one.

    Parameters
    ----------
    model : Vehicle or Operators
        With a control law.
    thrust : float, optional
        P, in N; by default the vehicle's nominal thrust.
    modes : int
        Number of elastic modes that are looked at; margins above the last one's frequency are left out.

    Returns
    -------
    Margins
        Without any where neither vehicle nor law has damping or delay: the loop then has no phase but 0 and 180
        degrees.

    Raises
    ------
    ModelError
        If there is no control law or no thrust, or a number is out of range.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> gains = [Gain(sensor="imu", quantity=name, gain=0.1) for name in ("slope", "slope_rate")]
    >>> missile = catalog.beal(internal_damping=1e-3).model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.7),), "control": Control(gains=gains, lag=0.02)})
    >>> found = stability_margins(missile, thrust=5.0)
    >>> [(margin.mode, round(margin.degrees, 2)) for margin in found.phase]
    [(0, 65.85), (1, -120.21), (1, 64.97)]
    """
    with one_thread():
        small, thrust = broken(model, thrust, modes)
        units = small.operators.vehicle.units
        if small.static or not thrust:
            return Margins(thrust, (), (), units)
        A, B, C, D = opened(small, thrust)
        frequencies, top = _frequencies(small, thrust, modes)

        def L(omega: float) -> complex:
            return complex((C @ np.linalg.solve(1j * omega * np.eye(len(A)) - A, B)).item() + D)

        both, series = block_diag(A, -A), np.block([[A, -B @ C], [np.zeros_like(A), -A]])
        real = _zeros(both, np.vstack((B, B)), np.hstack((C, C)), 0.0)
        unit = _zeros(series, np.vstack((D * B, B)), np.hstack((C, -D * C)), D**2 - 1)
        crossed = [(omega, L(omega)) for omega in _settled(lambda w: L(w).imag, real, top)]
        met = [(omega, L(omega)) for omega in _settled(lambda w: abs(L(w)) - 1, unit, top)]
    gain = [
        GainMargin(-1 / value.real, omega, _nearest(frequencies, omega))
        for omega, value in crossed
        if value.real < -LEAST and abs(value.imag) < REAL * abs(value)
    ]
    phase = [PhaseMargin(math.degrees(np.angle(-value)), omega, _nearest(frequencies, omega)) for omega, value in met]
    return Margins(thrust, tuple(gain), tuple(phase), units)


def _frequencies(closed: Loop, thrust: float, modes: int) -> tuple[Array, float]:
    """Of the open loop: 0 for the rigid-body motions and those of the elastic modes; and up to where these reach."""
    W = np.linalg.eigvals(closed.operators.stiffness(thrust))  # of unit modal mass
    elastic = np.sort(np.sqrt(np.abs(W)))
    elastic = elastic[elastic > RIGID * closed.speed]
    return np.concatenate(([0.0], elastic[:modes])), float(np.sqrt(elastic[modes - 1] * elastic[modes]))


def _nearest(frequencies: Array, omega: float) -> int:
    return int(np.abs(frequencies - omega).argmin())


def _zeros(A: Array, B: Array, C: Array, D: float) -> list[float]:
    """Frequencies near which C (s - A)^-1 B + D vanishes on the imaginary axis."""
    system = np.block([[A, B], [C, np.array([[D]])]])
    s = eigvals(system, np.diag([*np.ones(len(A)), 0.0])).astype(complex)
    s = s[np.isfinite(s)]
    return sorted(s.imag[(s.imag > 0) & (np.abs(s.real) < AXIS * np.abs(s))].tolist())


def _settled(function: Callable[[float], float], near: list[float], top: float) -> list[float]:
    """Zeros of a function by the secant method from points near to them, each once, in ascending order."""
    found: list[float] = []
    for start in (omega for omega in near if omega < top):
        last, omega = start, start * (1 + 1e-7)
        before, value = function(last), function(omega)
        for _ in range(STEPS):
            if value == before or abs(omega - last) < CLOSE * omega:
                break
            last, omega, before = omega, omega - value * (omega - last) / (value - before), value
            value = function(omega)
        if abs(omega - start) < AXIS * start and not any(abs(omega - other) < APART * omega for other in found):
            found.append(omega)
    return found
