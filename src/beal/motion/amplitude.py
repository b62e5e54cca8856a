"""The largest motion at a sensor over thrust and force: the generalised Fig. 15 of Irani & Kavianipour (2009)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import discretise
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.motion.histories import Quantity
from beal.motion.initial import Initial
from beal.motion.solve import response
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class AmplitudeMap:
    """Largest size of a quantity at a sensor within a time, over thrust and force.

    Parameters
    ----------
    thrust : ndarray, shape (p,)
        In N.
    factor : ndarray, shape (f,)
        By which all transverse forces are multiplied.
    amplitude : ndarray, shape (p, f)
        In the quantity's unit; infinite where the motion outgrows the range of numbers.
    sensor : str
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}
    duration : float
        In s.
    """

    thrust: Array
    factor: Array
    amplitude: Array
    sensor: str
    quantity: Quantity
    duration: float


def amplitude_map(
    model: Vehicle | Operators,
    duration: float,
    thrusts: Sequence[float],
    factors: Sequence[float],
    *,
    sensor: str | None = None,
    quantity: Quantity = "displacement",
    initial: Initial | None = None,
    modes: int = 8,
    rigid_body: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> AmplitudeMap:
    """The largest motion at a sensor, for each of some thrusts and multiples of the transverse forces.

    The motion is linear in start and forces: each thrust takes two exact responses, of which every multiple is a sum.

    Parameters
    ----------
    model : Vehicle or Operators
        With at least one force and one sensor.
    duration : float
        In s.
    thrusts : sequence of float
        In N.
    factors : sequence of float
        By which all forces are multiplied.
    sensor : str, optional
        Name; by default the first.
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}
    initial : Initial, optional
        Start, the same at all forces; by default at rest.
    modes : int
        Elastic modes that are kept.
    rigid_body : bool
        Whether rigid-body motion counts.
    progress : callable, optional
        Called with the number of thrusts done and of all.

    Returns
    -------
    AmplitudeMap

    Raises
    ------
    ModelError
        If there is no force, sensor, thrust or factor, or an option of `beal.response` is out of range.

    Examples
    --------
    >>> from beal.vehicle import Force, Sensor, Sine, catalog
    >>> push = Force(station=1.0, signal=Sine(kind="sine", amplitude=0.01, angular_frequency=2.0))
    >>> beam = catalog.beal().model_copy(update={"forces": (push,), "sensors": (Sensor(name="imu", station=0.12),)})
    >>> chart = amplitude_map(beam, 2.0, thrusts=[50.0, 100.0], factors=[1.0, 2.0], modes=3)
    >>> np.round(chart.amplitude[:, 1] / chart.amplitude[:, 0], 9).tolist()
    [2.0, 2.0]
    """
    operators = discretise(model) if isinstance(model, Vehicle) else model
    vehicle = operators.vehicle
    for name, values in (("thrusts", thrusts), ("factors", factors)):
        if not len(values) or not np.isfinite(values).all():
            raise ModelError(f"{name}: must be finite numbers, at least one, found {list(values)}")
    if not vehicle.forces:
        raise ModelError("force: a map of forces needs at least one, found none; add a [[force]]")
    name = sensor or (vehicle.sensors[0].name if vehicle.sensors else "")
    unforced = replace(operators, vehicle=vehicle.model_copy(update={"forces": ()}))
    multiples, rows = np.asarray(factors, dtype=float), []
    for thrust in thrusts:
        try:
            forced = response(operators, duration, thrust, method="exact", modes=modes, rigid_body=rigid_body)
            history = np.outer(multiples, forced.history(name, quantity))
            if initial is not None:
                free = response(
                    unforced,
                    duration,
                    thrust,
                    step=forced.step,
                    method="exact",
                    initial=initial,
                    modes=modes,
                    rigid_body=rigid_body,
                )
                history += free.history(name, quantity)
            rows.append(abs(history).max(axis=1))
        except ConvergenceError:
            rows.append(np.full(len(multiples), np.inf))
        if progress:
            progress(len(rows), len(thrusts))
    return AmplitudeMap(np.asarray(thrusts, dtype=float), multiples, np.array(rows), name, quantity, duration)
