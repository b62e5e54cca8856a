"""From a vehicle, its thrust, its forces and a start to time histories."""

import math
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.motion.histories import Response
from beal.motion.initial import Initial
from beal.motion.integrate import Problem, by_newmark, without_error_of_the_step
from beal.motion.newmark import check_parameters
from beal.motion.reduction import ReducedEquations, reduce
from beal.motion.steps import check_step, frequencies, step_count
from beal.motion.thrusts import SignalThrust, ThrustHistory
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

Method = Literal["newmark", "exact"]


def response(
    model: Vehicle | Operators,
    duration: float,
    thrust: float | ThrustHistory | None = None,
    *,
    step: float | None = None,
    method: Method = "newmark",
    initial: Initial | None = None,
    modes: int = 12,
    rigid_body: bool = True,
    beta: float = 0.25,
    gamma: float = 0.5,
) -> Response:
    """Motion of a vehicle under its thrust and its transverse forces, read at its sensors.

    Solves M q'' + C q' + (K0 + P K1) q = sum of F(t) phi(x_F) in the lowest undamped modes of the loaded vehicle; where
    the thrust varies, of the vehicle under the middle of its range.

    Parameters
    ----------
    model : Vehicle or Operators
    duration : float
        In s.
    thrust : float, PulsatingThrust, ThrustTable or SignalThrust, optional
        P, in N; by default the vehicle's nominal thrust and, if it has one, the signal of its thrust.
    step : float, optional
        In s; shortened such that the duration is a whole number of steps. By default a fortieth of the
        shortest period among the four lowest elastic modes and the forces, and no more than half of the
        shortest among all modes that are kept.
    method : {"newmark", "exact"}
        ``exact`` has no error of the step, which then only spaces the output: by the matrix exponential, or under a
        varying thrust by collocation of eighth order to 1e-11 of the motion.
    initial : Initial, optional
        ``ModeShape``, ``Release`` or ``Samples``; by default at rest, which needs a force.
    modes : int
        Elastic modes that are kept.
    rigid_body : bool
        Whether the vehicle's rigid-body motion is part of the response. Under a follower thrust it drifts
        with the elastic motion but, with joints that balance moments, does not act back on it.
    beta, gamma : float
        Of Newmark's method.

    Returns
    -------
    Response

    Raises
    ------
    ModelError
        If there is nothing to read or nothing moves, or an option is out of range.
    ConvergenceError
        If the motion outgrows the range of floating-point numbers.

    Warns
    -----
    CoarseStepWarning
        If Newmark's step is longer than a tenth of the shortest period of interest.
    AliasingWarning
        If the step takes fewer than two values from a period of the highest frequency that is kept.

    Notes
    -----
    The quasi-static deflection of the modes left out under F(t) is missing. Twelve modes of two equal stages read
    at the tail, where a step force acts, lack 0.04 % of the largest elastic deflection. An instability in a mode
    beyond ``modes`` does not show.

    Examples
    --------
    >>> from beal.motion import Release
    >>> from beal.vehicle import Sensor, catalog
    >>> column = catalog.beck().model_copy(update={"sensors": (Sensor(name="tip", station=1.0),)})
    >>> bent = Release(0.01, station=1.0)  # mostly the first mode, which is back after its period
    >>> motion = response(column, duration=2 * np.pi / 3.5160153, thrust=0.0, initial=bent)
    >>> round(float(motion.displacement[0, -1]), 3)
    0.01
    """
    operators = discretise(model) if isinstance(model, Vehicle) else model
    vehicle = operators.vehicle
    _check_options(duration, step, method, modes)
    _check_content(vehicle, initial)
    check_parameters(beta, gamma)
    if thrust is None and vehicle.thrust.signal is not None:
        thrust = SignalThrust(_thrust(vehicle, None), vehicle.thrust.signal)
    varying = thrust if isinstance(thrust, ThrustHistory) else None
    middle = thrust.middle if isinstance(thrust, ThrustHistory) else _thrust(vehicle, thrust)
    reduced = reduce(operators, middle, modes, rigid_body)
    found = frequencies(reduced, vehicle, varying.highest_frequency if varying else 0.0)
    count = step_count(duration, step, found)
    step = duration / count
    check_step(step, found, (beta, gamma) if method == "newmark" else None)
    start = (0.0 * reduced.mu.real, 0.0 * reduced.mu.real)
    if initial is not None:
        q, rate = initial.coordinates(operators)
        start = reduced.W.T @ operators.M @ q, reduced.W.T @ operators.M @ rate
    problem = Problem(
        reduced,
        shapes=reduced.W.T @ operators.shape([force.station for force in vehicle.forces]).T,
        loads=[force.signal for force in vehicle.forces],
        start=start,
        B=reduced.W.T @ operators.K1 @ reduced.X,
        thrust=varying,
    )
    if method == "exact":
        motion = without_error_of_the_step(problem, step, count)
    else:
        motion = by_newmark(problem, step, count, beta, gamma)
    return _read(operators, reduced, motion, (middle, varying), method, step)


def _read(
    operators: Operators,
    reduced: ReducedEquations,
    motion: tuple[Array, Array, Array],
    thrust: tuple[float, ThrustHistory | None],
    method: str,
    step: float,
) -> Response:
    """The histories at the sensors from those of the reduced coordinates and their derivatives."""
    sensors = operators.vehicle.sensors
    stations = [sensor.station for sensor in sensors]
    q, q_rate, q_acceleration = (p @ reduced.X.T for p in motion)
    deflection, slope = (operators.shape(stations, derivative) for derivative in (0, 1))
    rigid = slice(operators.rigid)
    time = step * np.arange(len(q), dtype=float)
    middle, varying = thrust
    return Response(
        time=time,
        sensors=tuple(sensor.name for sensor in sensors),
        displacement=deflection @ q.T,
        rate=deflection @ q_rate.T,
        acceleration=deflection @ q_acceleration.T,
        slope=slope @ q.T,
        slope_rate=slope @ q_rate.T,
        rigid_displacement=deflection[:, rigid] @ q[:, rigid].T,
        rigid_slope=slope[:, rigid] @ q[:, rigid].T,
        coordinates=q,
        coordinate_rates=q_rate,
        thrust=middle,
        thrust_history=np.full_like(time, middle) if varying is None else varying.at(time),
        method=method,
        step=step,
        mu=reduced.mu,
        units=operators.vehicle.units,
    )


def _check_options(duration: float, step: float | None, method: str, modes: int) -> None:
    if not 0 < duration < math.inf:
        raise ModelError(f"duration: must be positive and finite, found {duration}")
    if step is not None and not 0 < step <= duration:
        raise ModelError(f"step: must be positive and no longer than the duration, {duration:g}, found {step}")
    if method not in get_args(Method):
        raise ModelError(f"method: must be one of {', '.join(get_args(Method))}, found {method!r}")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")


def _check_content(vehicle: Vehicle, initial: Initial | None) -> None:
    if not vehicle.sensors:
        raise ModelError(
            "sensor: a response is read at sensors, found none; "
            f'add one, such as [[sensor]] name = "imu" station = {0.12 * vehicle.length:g}'
        )
    if initial is None and not vehicle.forces:
        raise ModelError("initial: nothing moves the vehicle; add a [[force]] or give an initial deflection")


def _thrust(vehicle: Vehicle, thrust: float | None) -> float:
    thrust = vehicle.thrust.nominal if thrust is None else thrust
    if thrust is None:
        raise ModelError("thrust: give one, or set thrust.nominal in the model")
    if not 0 <= thrust < math.inf:
        raise ModelError(f"thrust: must be finite and not negative, found {thrust}")
    return thrust
