"""Signals over time: values, breakpoints, and the small systems that carry them exactly between breakpoints.

Between two breakpoints a signal is the first entry of the state z of a linear system z' = G z: two entries for a sine
or a straight line, three for a gust. A chirp is carried by its Taylor series, over intervals that are short enough for
it; noise is a sum of sines.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beal.vehicle.signals import Chirp, Gust, Noise, Pulse, Signal, Sine, Step, Table

Array = NDArray[np.float64]
TERMS = 18  # of a chirp's Taylor series about the middle of an interval of 1 rad: 2e-16 at its ends


def value(signal: Signal, time: ArrayLike) -> Array:
    """F(t); at a jump, the value from then on.

    Parameters
    ----------
    signal : Signal
    time : array_like, shape (k,)
        In s.

    Returns
    -------
    ndarray, shape (k,)
        In N.

    Examples
    --------
    >>> from beal.vehicle.signals import Pulse
    >>> value(Pulse(kind="pulse", amplitude=3.0, start=1.0, duration=1.0), [0.5, 1.0, 2.0]).tolist()
    [0.0, 3.0, 0.0]
    """
    t = np.asarray(time, dtype=float)
    match signal:
        case Step():
            return np.where(t >= signal.start, signal.amplitude, 0.0)
        case Pulse():
            return np.where((t >= signal.start) & (t < signal.start + signal.duration), signal.amplitude, 0.0)
        case Table():
            return np.asarray(np.interp(t, signal.time, signal.value))
        case Noise():
            return np.asarray(sum((value(sine, t) for sine in terms(signal)), np.zeros_like(t)))
        case _:
            return np.asarray(state(signal, t)[0])


def terms(signal: Signal) -> tuple[Signal, ...]:
    """The signals whose sum it is: the sines of noise, else itself.

    Examples
    --------
    >>> from beal.vehicle.signals import Noise
    >>> noise = Noise(kind="noise", angular_frequency=[2.0, 4.0], density=[0.0, 3.0], seed=1)
    >>> round(sum(sine.amplitude**2 / 2 for sine in terms(noise)), 9)  # the variance
    3.0
    """
    if not isinstance(signal, Noise):
        return (signal,)
    spectrum = np.array(signal.angular_frequency)
    shares = np.arange(signal.lines) / signal.lines
    width = np.repeat(np.diff(spectrum) / signal.lines, signal.lines)
    lower = (spectrum[:-1, None] + np.diff(spectrum)[:, None] * shares).ravel()
    power = np.interp(lower + width / 2, spectrum, signal.density) * width
    place, turn = np.random.default_rng(signal.seed).random((2, len(width)))
    columns = (np.sqrt(2 * power), lower + place * width, 2 * math.pi * turn)
    return tuple(
        Sine(kind="sine", amplitude=amplitude, angular_frequency=w, phase=phase)
        for amplitude, w, phase in zip(*(column.tolist() for column in columns), strict=True)
    )


def breakpoints(signal: Signal) -> tuple[float, ...]:
    """Times at which the signal or one of its derivatives jumps, in s."""
    match signal:
        case Step():
            return (signal.start,)
        case Pulse() | Gust():
            return (signal.start, signal.start + signal.duration)
        case Chirp():
            return (signal.duration,)
        case Table():
            return signal.time
        case Sine() | Noise():
            return ()


def highest_frequency(signal: Signal) -> float:
    """The highest angular frequency of a signal that swings, in rad/s; 0 for one that does not."""
    match signal:
        case Sine():
            return signal.angular_frequency
        case Gust():
            return 2 * math.pi / signal.duration
        case Chirp():
            return max(signal.first, signal.last)
        case Noise():
            return signal.angular_frequency[-1]
        case _:
            return 0.0


def longest_interval(signal: Signal) -> float:
    """Over how long its system carries a signal, in s, breakpoints apart."""
    return 1.0 / _pace(signal) if isinstance(signal, Chirp) else math.inf


def generator(signal: Signal) -> Array:
    """The G of z' = G z, in 1/s, for any signal but noise.

    Parameters
    ----------
    signal : Signal

    Returns
    -------
    ndarray, shape (n, n)
    """
    w = highest_frequency(signal)
    match signal:
        case Sine():
            return np.array([[0.0, w], [-w, 0.0]])
        case Gust():
            return np.array([[0.0, w, 0.0], [0.0, 0.0, w], [0.0, -w, 0.0]])
        case Chirp():
            return np.diag(_pace(signal) * np.arange(1.0, TERMS), 1)
        case _:
            return np.array([[0.0, 1.0], [0.0, 0.0]])


def state(signal: Signal, time: ArrayLike) -> Array:
    """The z of z' = G z away from breakpoints, its first entry being the force, for any signal but noise.

    Parameters
    ----------
    signal : Signal
    time : array_like, shape (k,)
        In s.

    Returns
    -------
    ndarray, shape (n, k)
        In N: F and F'/w of a sine, F, F'/w and F''/w^2 of a gust, the terms F^(j)/(j! pace^j) of a chirp; F and F' of
        the others, the latter in N/s.

    Examples
    --------
    >>> from beal.vehicle.signals import Table
    >>> ramp = Table(kind="table", time=[0.0, 2.0], value=[0.0, 6.0])
    >>> state(ramp, [1.0, 3.0]).tolist()
    [[3.0, 6.0], [3.0, 0.0]]
    """
    t, w = np.asarray(time, dtype=float), highest_frequency(signal)
    match signal:
        case Sine():
            angle = w * t + signal.phase
            return signal.amplitude * np.array([np.sin(angle), np.cos(angle)])
        case Gust():
            angle = w * (t - signal.start)
            blows = (t >= signal.start) & (t <= signal.start + signal.duration)
            return signal.amplitude / 2 * blows * np.array([1 - np.cos(angle), np.sin(angle), np.cos(angle)])
        case Chirp():
            return _taylor(signal, t)
        case Table():
            slopes = np.concatenate([[0.0], np.diff(signal.value) / np.diff(signal.time), [0.0]])
            return np.array([value(signal, t), slopes[np.searchsorted(signal.time, t)]])
        case _:
            return np.array([value(signal, t), np.zeros_like(t)])


def _pace(chirp: Chirp) -> float:
    """How fast a chirp changes, in rad/s: its frequency, or the root of the rate of its frequency."""
    return max(chirp.first, chirp.last, math.sqrt(abs(chirp.last - chirp.first) / chirp.duration))


def _taylor(chirp: Chirp, t: Array) -> Array:
    """Taylor terms of y = exp(i angle): as y' = i angle' y, (j + 1) y_(j+1) = i (angle' y_j + angle'' y_(j-1))."""
    bend = (chirp.last - chirp.first) / chirp.duration * (t < chirp.duration)
    swept = np.minimum(t, chirp.duration)
    angle = chirp.phase + chirp.first * t + (chirp.last - chirp.first) * swept * (t - swept / 2) / chirp.duration
    rate = chirp.first + (chirp.last - chirp.first) * swept / chirp.duration
    pace = _pace(chirp)
    y = np.zeros((TERMS, *t.shape), dtype=complex)
    y[0] = chirp.amplitude * np.exp(1j * angle)
    for j in range(TERMS - 1):
        y[j + 1] = 1j * (rate / pace * y[j] + (bend / pace**2 * y[j - 1] if j else 0.0)) / (j + 1)
    return np.asarray(y.imag)


def samples(signal: Signal, step: float, count: int) -> Array:
    """The signal at ``count`` times from 0, for a method that knows it at those times only.

    A jump is spread over the two times around it such that its impulse and the moment of its impulse are
    kept: the method stays of second order wherever the jump lies. Continuous signals are sampled as they are.

    Parameters
    ----------
    signal : Signal
    step : float
        In s.
    count : int

    Returns
    -------
    ndarray, shape (count,)

    Examples
    --------
    >>> from beal.vehicle.signals import Step
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
