"""How a motion starts: in the shape of a mode, let go from a static deflection, or as sampled."""

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.motion.reduction import free_modes

Array = NDArray[np.float64]
STATIONS = 401  # among which the largest deflection is looked for
TIED = 1e-9  # relative difference of two largest deflections, of which the foremost counts


class Initial(Protocol):
    """Anything that gives the coordinates q and their rates at time 0."""

    def coordinates(self, operators: Operators) -> tuple[Array, Array]:
        """q and q' at time 0, shape (n,) each."""


@dataclass(frozen=True)
class ModeShape:
    """At rest in the shape of an elastic mode of the vehicle without thrust.

    Parameters
    ----------
    number : int
        Of the mode, from 1.
    amplitude : float
        Deflection, in m, with its sign.
    at : {"largest", "nose"}
        Where the deflection is ``amplitude``: where it is largest, or at the nose.

    Examples
    --------
    >>> from beal.discretisation import discretise
    >>> from beal.vehicle import catalog
    >>> beam = discretise(catalog.beal())
    >>> q, rate = ModeShape(2, amplitude=0.01).coordinates(beam)
    >>> round(float(beam.shape(0.0)[0] @ q), 6)
    0.01
    """

    number: int
    amplitude: float
    at: Literal["largest", "nose"] = "largest"

    def coordinates(self, operators: Operators) -> tuple[Array, Array]:
        """q and q' of the mode at rest, shape (n,) each."""
        elastic = len(operators.M) - operators.rigid
        if not 1 <= self.number <= elastic:
            raise ModelError(f"initial: mode number must lie in 1 to {elastic}, found {self.number}")
        if self.at not in ("largest", "nose"):
            raise ModelError(f'initial: at must be "largest" or "nose", found {self.at!r}')
        vehicle = operators.vehicle
        mode = free_modes(operators)[2][:, operators.rigid + self.number - 1]
        stations = np.union1d(np.linspace(0.0, vehicle.length, STATIONS), vehicle.boundaries)
        deflection = np.concatenate([operators.shape(stations, side=side) @ mode for side in ("aft", "forward")])
        size = abs(deflection)
        largest = deflection[np.argmax(size > (1 - TIED) * size.max())]
        reference = largest if self.at == "largest" else deflection[0]
        if abs(reference) < 1e-9 * abs(largest):
            raise ModelError('initial: the nose is a node of this mode; give the amplitude at = "largest"')
        return mode * (_finite("amplitude", self.amplitude) / reference), np.zeros_like(mode)


@dataclass(frozen=True)
class Release:
    """Let go from the static shape under a transverse force at one station, without thrust.

    A free vehicle does not stand still under a single force; the shape is then the one that it has in the
    frame that accelerates with it, where its own inertia balances the force (inertia relief). The rigid-body
    motion starts from zero: ``deflection`` counts from the mass-weighted line through the vehicle.

    Parameters
    ----------
    deflection : float
        At the station, in m.
    station : float
        Where the force acts, in m from the nose. For a vehicle held at the nose, give the tail's.

    Examples
    --------
    >>> from beal.discretisation import discretise
    >>> from beal.vehicle import catalog
    >>> column = discretise(catalog.beck())  # x^2 (3 - x) / 2 under a force at the tip
    >>> q, rate = Release(1.0, station=1.0).coordinates(column)
    >>> round(float(column.shape(0.5)[0] @ q), 6)
    0.3125
    """

    deflection: float
    station: float = 0.0

    def coordinates(self, operators: Operators) -> tuple[Array, Array]:
        """q and q' of the static shape at rest, shape (n,) each."""
        length = operators.vehicle.length
        if not 0 <= self.station <= length:
            raise ModelError(f"initial: station must lie on the vehicle, 0 to {length:.12g}, found {self.station}")
        elastic = slice(operators.rigid, None)
        load = operators.shape(self.station)[0, elastic]
        q = np.zeros(len(operators.M))
        try:
            q[elastic] = cho_solve(cho_factor(operators.K0[elastic, elastic]), load)
            if operators.dead is not None:
                q[elastic] = np.linalg.solve(operators.stiffness(0.0)[elastic, elastic], load)
        except LinAlgError:
            raise ModelError(
                "initial: no static shape exists, a joint folds or slides without stiffness; "
                "give a mode shape or samples"
            ) from None
        compliance = load @ q[elastic]
        if compliance <= 1e-12 * length**3 / operators.vehicle.scales.bending_stiffness:
            raise ModelError(
                f"initial: the vehicle is held at station {self.station}; give another, such as {length:.12g}"
            )
        return q * (_finite("deflection", self.deflection) / compliance), np.zeros_like(q)


@dataclass(frozen=True, eq=False)
class Samples:
    """Deflection, and rate if not zero, as sampled along the vehicle.

    The rigid-body motions and the lowest modes, no more than there are samples, are fitted by least squares.

    Parameters
    ----------
    station : array_like, shape (k,)
        In m.
    deflection : array_like, shape (k,)
        In m.
    rate : array_like, shape (k,), optional
        In m/s.

    Examples
    --------
    >>> from beal.discretisation import discretise
    >>> from beal.vehicle import catalog
    >>> beam = discretise(catalog.beal())
    >>> q, rate = Samples([0.0, 0.5, 1.0], [0.0, 0.1, 0.2]).coordinates(beam)
    >>> round(float(beam.shape(0.3)[0] @ q), 6)
    0.06
    """

    station: ArrayLike
    deflection: ArrayLike
    rate: ArrayLike | None = None

    def coordinates(self, operators: Operators) -> tuple[Array, Array]:
        """q and q' that fit the samples, shape (n,) each."""
        station, deflection = (
            np.atleast_1d(self.station).astype(float),
            np.atleast_1d(self.deflection).astype(float),
        )
        rate = np.zeros_like(station) if self.rate is None else np.atleast_1d(self.rate).astype(float)
        if not station.shape == deflection.shape == rate.shape or station.ndim != 1:
            raise ModelError(
                "initial: station, deflection and rate must be equally long lists, "
                f"found shapes {station.shape}, {deflection.shape} and {rate.shape}"
            )
        if not np.isfinite([station, deflection, rate]).all():
            raise ModelError("initial: station, deflection and rate must be finite, found NaN or infinity")
        length = operators.vehicle.length
        if station.min() < 0 or station.max() > length:
            raise ModelError(f"initial: stations must lie on the vehicle, 0 to {length:.12g}, found {station.tolist()}")
        _, nu, modes = free_modes(operators)
        modes = (modes / np.sqrt(nu))[:, : len(station)]  # of equal size, all of them
        fit = np.linalg.lstsq(operators.shape(station) @ modes, np.column_stack([deflection, rate]), rcond=1e-10)
        q, q_rate = (modes @ fit[0]).T
        return q, q_rate


@dataclass(frozen=True, eq=False)
class State:
    """Coordinates and their rates as they are, such as those with which a motion before has ended.

    Parameters
    ----------
    q, q_rate : ndarray, shape (n,)
        In the coordinates of the operators.

    Examples
    --------
    >>> from beal.discretisation import discretise
    >>> from beal.vehicle import catalog
    >>> beam = discretise(catalog.beal())
    >>> q, rate = State(*ModeShape(1, 0.01).coordinates(beam)).coordinates(beam)
    >>> rate.any()
    np.False_
    """

    q: Array
    q_rate: Array

    def coordinates(self, operators: Operators) -> tuple[Array, Array]:
        """q and q', shape (n,) each."""
        size = len(operators.M)
        if not np.shape(self.q) == np.shape(self.q_rate) == (size,):
            raise ModelError(
                f"initial: needs {size} coordinates and as many rates, found {np.shape(self.q)} and "
                f"{np.shape(self.q_rate)}; take the operators that they belong to"
            )
        return self.q, self.q_rate


def _finite(name: str, number: float) -> float:
    if not np.isfinite(number):
        raise ModelError(f"initial: {name} must be finite, found {number}")
    return number
