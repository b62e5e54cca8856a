"""Signals over time: values, breakpoints, and the states that carry them exactly between breakpoints.

Between two breakpoints every signal solves F'' = -w^2 F: a sine with its own angular frequency w, the others,
which are straight there, with w = 0. Its state is therefore (F, F').
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beal.vehicle.parts import Pulse, Signal, Sine, Step, Table

Array = NDArray[np.float64]


def value(signal: Signal, time: ArrayLike) -> Array:
    """F(t); at a jump, the value from then on.

    Parameters
    ----------
    signal : Sine, Step, Pulse or Table
    time : array_like, shape (k,)
        In s.

    Returns
    -------
    ndarray, shape (k,)
        In N.

    Examples
    --------
    >>> value(Pulse(kind="pulse", amplitude=3.0, start=1.0, duration=1.0), [0.5, 1.0, 2.0]).tolist()
    [0.0, 3.0, 0.0]
    """
    t = np.asarray(time, dtype=float)
    match signal:
        case Sine():
            return np.asarray(signal.amplitude * np.sin(signal.angular_frequency * t + signal.phase))
        case Step():
            return np.where(t >= signal.start, signal.amplitude, 0.0)
        case Pulse():
            return np.where((t >= signal.start) & (t < signal.start + signal.duration), signal.amplitude, 0.0)
        case Table():
            return np.asarray(np.interp(t, signal.time, signal.value))


def rate(signal: Signal, time: ArrayLike) -> Array:
    """F'(t) away from breakpoints, shape (k,), in N/s."""
    t = np.asarray(time, dtype=float)
    match signal:
        case Sine():
            w = signal.angular_frequency
            return np.asarray(signal.amplitude * w * np.cos(w * t + signal.phase))
        case Table():
            slopes = np.concatenate([[0.0], np.diff(signal.value) / np.diff(signal.time), [0.0]])
            return np.asarray(slopes[np.searchsorted(signal.time, t)])
        case _:
            return np.zeros_like(t)


def breakpoints(signal: Signal) -> tuple[float, ...]:
    """Times at which the signal or its rate jumps, in s."""
    match signal:
        case Step():
            return (signal.start,)
        case Pulse():
            return (signal.start, signal.start + signal.duration)
        case Table():
            return signal.time
        case Sine():
            return ()


def angular_frequency(signal: Signal) -> float:
    """The w of F'' = -w^2 F, in rad/s; 0 for a signal that is straight between its breakpoints."""
    return signal.angular_frequency if isinstance(signal, Sine) else 0.0


def states(signal: Signal, start: Array, length: Array) -> Array:
    """F and F' just after the start of intervals that hold no breakpoint inside.

    They are carried back from the middle of each interval, so that a start which rounding has put on the
    wrong side of a breakpoint does no harm.

    Parameters
    ----------
    signal : Sine, Step, Pulse or Table
    start, length : ndarray, shape (k,)
        Of the intervals, in s.

    Returns
    -------
    ndarray, shape (2, k)

    Examples
    --------
    >>> ramp = Table(kind="table", time=[0.0, 2.0], value=[0.0, 6.0])
    >>> states(ramp, np.array([0.0, 1.0, 2.0]), np.ones(3)).tolist()
    [[0.0, 3.0, 6.0], [3.0, 3.0, 0.0]]
    """
    half, w = length / 2, angular_frequency(signal)
    force, slope = value(signal, start + half), rate(signal, start + half)
    sine_over_w = half * np.sinc(w * half / np.pi)
    return np.array(
        [
            force * np.cos(w * half) - slope * sine_over_w,
            force * w**2 * sine_over_w + slope * np.cos(w * half),
        ]
    )


def samples(signal: Signal, step: float, count: int) -> Array:
    """The signal at ``count`` times from 0, for a method that knows it at those times only.

    A jump is spread over the two times around it such that its impulse and the moment of its impulse are
    kept: the method stays of second order wherever the jump lies. Continuous signals are sampled as they are.

    Parameters
    ----------
    signal : Sine, Step, Pulse or Table
    step : float
        In s.
    count : int

    Returns
    -------
    ndarray, shape (count,)

    Examples
    --------
    >>> samples(Step(kind="step", amplitude=4.0, start=1.0), 0.5, 5).tolist()
    [0.0, 0.0, 2.0, 4.0, 4.0]
    """
    time = step * np.arange(count)
    if not isinstance(signal, Step | Pulse):
        return value(signal, time)
    around = step * np.arange(-1, count + 1)
    twice_integrated = np.zeros(count + 2)
    for sign, jump in zip((1.0, -1.0), breakpoints(signal), strict=False):
        twice_integrated += sign * signal.amplitude * np.maximum(around - jump, 0.0) ** 2 / 2
    averaged = np.diff(twice_integrated, 2) / step**2
    averaged[0] *= 2  # the first time has half an interval around it
    return np.asarray(averaged)
