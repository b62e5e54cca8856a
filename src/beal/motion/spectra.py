"""What a time history says at a glance: how large it is over time, and at which frequencies."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.motion.histories import Quantity, Response, turning_points

Array = NDArray[np.float64]
RATE_OF: dict[str, Quantity] = {"displacement": "rate", "rate": "acceleration", "slope": "slope_rate"}
FEWEST = 8  # samples in a spectrum


def envelope(
    response: Response, sensor: str, quantity: Literal["displacement", "rate", "slope"] = "displacement"
) -> tuple[Array, Array]:
    """Amplitude over time: half of the distance between successive turning points, at the times midway.

    Parameters
    ----------
    response : Response
    sensor : str
    quantity : {"displacement", "rate", "slope"}
        Those whose own rate is known, which tells where they turn.

    Returns
    -------
    time, amplitude : ndarray
        In s, and in the quantity's unit; empty for a motion that turns less than twice.

    Raises
    ------
    ModelError
        If there is no such sensor or quantity.

    Examples
    --------
    >>> import beal
    >>> column = beal.catalog.beck().model_copy(update={"sensors": (beal.Sensor(name="tip", station=1.0),)})
    >>> motion = beal.response(column, 20.0, 0.0, initial=beal.ModeShape(1, amplitude=0.01))
    >>> time, amplitude = envelope(motion, "tip")
    >>> amplitude.round(5).min(), amplitude.round(5).max()
    (np.float64(0.01), np.float64(0.01))
    """
    if quantity not in RATE_OF:
        raise ModelError(f"quantity: must be one of {', '.join(RATE_OF)}, found {quantity!r}")
    history, rate = response.history(sensor, quantity), response.history(sensor, RATE_OF[quantity])
    instants, peaks = turning_points(response.time, history, rate)
    return (instants[1:] + instants[:-1]) / 2, abs(np.diff(peaks)) / 2


def amplitude_spectrum(response: Response, sensor: str, quantity: Quantity = "displacement") -> tuple[Array, Array]:
    """Amplitude over angular frequency, such that a lasting sine peaks with its amplitude.

    The straight line through the history is taken off, and Hann's window keeps strong lines from leaking: a line is
    four bins of 2 pi/duration wide, and between two bins its peak lacks up to 15 %.

    Parameters
    ----------
    response : Response
    sensor : str
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}

    Returns
    -------
    angular_frequency, amplitude : ndarray, shape ((k + 1) // 2,)
        In rad/s from 0 to pi/step, and in the quantity's unit.

    Raises
    ------
    ModelError
        If there is no such sensor or quantity, or the history is too short.

    Examples
    --------
    >>> import beal
    >>> column = beal.catalog.beck().model_copy(update={"sensors": (beal.Sensor(name="tip", station=1.0),)})
    >>> motion = beal.response(column, 20 * 2 * np.pi / 3.5160153, 0.0, initial=beal.ModeShape(1, amplitude=0.01))
    >>> frequency, amplitude = amplitude_spectrum(motion, "tip")
    >>> round(float(frequency[amplitude.argmax()]), 3), round(float(amplitude.max()), 3)
    (3.516, 0.01)
    """
    history = response.history(sensor, quantity)
    if len(history) < FEWEST:
        raise ModelError(f"spectrum: needs at least {FEWEST} samples, found {len(history)}; lengthen the duration")
    from scipy.signal import detrend  # takes longer to import than most commands to answer

    history = detrend(history[:-1])  # a motion that fills the duration with whole periods then falls on bins
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(len(history)) / len(history))
    amplitude = 2 * abs(np.fft.rfft(window * history)) / window.sum()
    bins = np.arange(len(amplitude), dtype=np.float64)
    return np.asarray(2 * np.pi / (len(history) * response.step) * bins), np.asarray(amplitude)
