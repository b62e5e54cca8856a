"""Time histories at the sensors, and the growth that they show."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.shown import Shown

Array = NDArray[np.float64]
STILL = 2.0  # of the longest distances between turning points; after that a motion swings no more
Quantity = Literal["displacement", "rate", "acceleration", "slope", "slope_rate"]  # what a sensor reads
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
MotionPart = Literal["rigid_displacement", "elastic_displacement", "rigid_slope", "elastic_slope"]
PARTS: tuple[MotionPart, ...] = get_args(MotionPart)


@dataclass(frozen=True, eq=False)
class Response(Shown):
    """Motion of a vehicle over time.

    Parameters
    ----------
    time : ndarray, shape (k,)
        In s.
    sensors : tuple of str
        Names, in the order of the rows below.
    displacement, rate, acceleration : ndarray, shape (sensors, k)
        In m, m/s and m/s^2. At a joint's station, of the face aft of it.
    slope, slope_rate : ndarray, shape (sensors, k)
        In rad and rad/s.
    rigid_displacement, rigid_slope : ndarray, shape (sensors, k)
        The part of the rigid-body motion, in m and rad: what the straight line does that has the vehicle's momentum
        and angular momentum. The rest is elastic.
    coordinates, coordinate_rates : ndarray, shape (k, n)
        q and q' in the coordinates of the operators: ``operators.shape(x) @ coordinates.T`` is the deflection
        at x.
    thrust : float
        In N; the middle of its range where it varies.
    thrust_history : ndarray, shape (k,)
        In N.
    method : {"newmark", "exact"}
    step : float
        In s.
    mu : ndarray of complex
        The eigenvalues omega^2 of the modes that were kept, at ``thrust`` without damping, rigid-body motions
        included, in rad^2/s^2.
    units : {"SI", "nondimensional"}
    """

    time: Array
    sensors: tuple[str, ...]
    displacement: Array
    rate: Array
    acceleration: Array
    slope: Array
    slope_rate: Array
    rigid_displacement: Array
    rigid_slope: Array
    coordinates: Array
    coordinate_rates: Array
    thrust: float
    thrust_history: Array
    method: str
    step: float
    mu: NDArray[np.complex128]
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def elastic_displacement(self) -> Array:
        """Displacement without its part of rigid-body motion, in m, shape (sensors, k)."""
        return self.displacement - self.rigid_displacement

    @property
    def elastic_slope(self) -> Array:
        """Slope without its part of rigid-body motion, in rad, shape (sensors, k)."""
        return self.slope - self.rigid_slope

    def index(self, sensor: str) -> int:
        """Row of a sensor."""
        if sensor not in self.sensors:
            raise ModelError(f"sensor: must be one of {', '.join(self.sensors)}, found {sensor!r}")
        return self.sensors.index(sensor)

    def history(self, sensor: str, quantity: str = "displacement") -> Array:
        """One quantity at a sensor, or a part of its motion, shape (k,)."""
        if quantity not in (known := (*QUANTITIES, *PARTS)):
            raise ModelError(f"quantity: must be one of {', '.join(known)}, found {quantity!r}")
        values: Array = getattr(self, quantity)[self.index(sensor)]
        return values

    def trajectory(self, sensor: str) -> tuple[Array, Array]:
        """Displacement [m] and rate [m/s] of a sensor, the phase plane, shape (k,) each."""
        return self.history(sensor), self.history(sensor, "rate")


def growth_rate(response: Response, sensor: str) -> float:
    """Rate a, in 1/s, at which a sensor's displacement grows as exp(a t) over the second half.

    A motion that swings to its end is judged by the differences between successive turning points, which an offset does
    not change, a motion that does not by its size. For comparison with the real part of the eigenvalue: it
    holds once the fastest growing mode dominates, and is about 0 for a bounded motion.

    Parameters
    ----------
    response : Response
    sensor : str

    Returns
    -------
    float

    Raises
    ------
    ModelError
        If the sensor does not exist or does not move.
    """
    late = response.time >= response.time[-1] / 2
    time = response.time[late]
    displacement, rate = (history[late] for history in response.trajectory(sensor))
    if not displacement.any():
        raise ModelError(f"sensor {sensor!r}: does not move in the second half, no growth can be told")
    instants, peaks = turning_points(time, displacement, rate)
    if len(peaks) >= 4 and time[-1] - instants[-1] < STILL * np.diff(instants).max():
        time, displacement = (instants[1:] + instants[:-1]) / 2, np.diff(peaks)
    size = abs(displacement)
    time, size = time[size > 0], size[size > 0]
    weight = size / size.max()  # what other modes add changes a small logarithm most
    return float(np.polyfit(time, np.log(size), 1, w=weight)[0])


def turning_points(time: Array, displacement: Array, rate: Array) -> tuple[Array, Array]:
    """Times and displacements where a sampled motion turns back, by cubic interpolation between samples.

    Parameters
    ----------
    time, displacement, rate : ndarray, shape (k,)

    Returns
    -------
    ndarray, ndarray
        As many as the rate changes sign.

    Examples
    --------
    >>> t = np.linspace(0.0, 7.0, 50)
    >>> instants, peaks = turning_points(t, np.sin(t), np.cos(t))
    >>> np.round(instants / np.pi, 3).tolist(), np.round(peaks, 5).tolist()
    ([0.5, 1.5], [1.0, -1.0])
    """
    before = np.flatnonzero(np.sign(rate[:-1]) * np.sign(rate[1:]) < 0)  # the product of two rates may overflow
    h = time[before + 1] - time[before]
    y0, y1, v0, v1 = displacement[before], displacement[before + 1], h * rate[before], h * rate[before + 1]
    s = v0 / (v0 - v1)
    cubic = (1 + 2 * s) * (1 - s) ** 2 * y0 + s * (1 - s) ** 2 * v0 + s**2 * (3 - 2 * s) * y1 - s**2 * (1 - s) * v1
    return time[before] + s * h, cubic
