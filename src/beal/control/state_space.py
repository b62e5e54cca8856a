"""The vehicle under its thrust as matrices that guidance engineers can take away."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from beal.control.closed import thrust_of
from beal.control.compensator import Array
from beal.control.loop import READINGS, turned
from beal.discretisation import Operators, discretise
from beal.errors import ModelError
from beal.motion.reduction import ReducedEquations, reduce
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import control

DELTA, ACCELERATION = "delta", "delta_acceleration"
SIGNALS = ("states", "inputs", "outputs")
UNITS = {"displacement": "m", "rate": "m/s", "acceleration": "m/s^2", "slope": "rad", "slope_rate": "rad/s"}
DEFAULT = ("displacement", "rate", "slope", "slope_rate")


@dataclass(frozen=True)
class StateSpace:
    """x' = A x + B u, y = C x + D u of a vehicle under a thrust, its control loop open.

    Parameters
    ----------
    A : ndarray, shape (n, n)
    B : ndarray, shape (n, inputs)
    C : ndarray, shape (outputs, n)
    D : ndarray, shape (outputs, inputs)
    states, inputs, outputs : tuple of str
    input_units, output_units : tuple of str
    thrust : float
        In N.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    input_units: tuple[str, ...]
    output_units: tuple[str, ...]
    thrust: float

    def frequency_response(self, angular_frequency: float) -> Array:
        """C (i omega - A)^-1 B + D at an angular frequency in rad/s, complex, shape (outputs, inputs)."""
        resolvent = np.linalg.solve(1j * angular_frequency * np.eye(len(self.A)) - self.A, self.B)
        return np.asarray(self.C @ resolvent + self.D)

    def to_control(self) -> "control.StateSpace":
        """The same for python-control, with the names of states, inputs and outputs, a dot in them as ``_``.

        Raises
        ------
        ModelError
            If python-control is not installed.
        """
        names = {what: [name.replace(".", "_") for name in getattr(self, what)] for what in SIGNALS}
        return python_control().ss(self.A, self.B, self.C, self.D, **names)


def python_control() -> Any:
    """The package control.

    Raises
    ------
    ModelError
        If it is not installed.
    """
    try:
        import control
    except ModuleNotFoundError as error:
        if not str(error.name).startswith("control"):
            raise
        raise ModelError("python-control is needed and not installed; install beal[control]") from None
    return control


def state_space(
    model: Vehicle | Operators,
    thrust: float | None = None,
    inputs: Sequence[str | float] = (DELTA,),
    outputs: Sequence[str] | None = None,
    modes: int = 6,
) -> StateSpace:
    """The lowest modes of a vehicle under a thrust as a state space, with the residual flexibility of the others.

    The states are coordinates p of the rigid-body motions and of the lowest modes under this thrust, and their rates:
    p'' + D p' + A p = W^T f. The modes left out follow their loads as at rest: what they add to displacements and
    slopes is in D, so that the static response is that of all modes.

    Parameters
    ----------
    model : Vehicle or Operators
    thrust : float, optional
        P, in N; by default the vehicle's nominal thrust.
    inputs : sequence of str or float
        ``"delta"``, the angle by which the thrust turns at the station of the control law, or else where it acts;
        ``"delta_acceleration"``, its second derivative, by which an engine's inertia pushes; the name of a force of the
        vehicle; or a station in m, for a transverse force there.
    outputs : sequence of str, optional
        Such as ``"imu.slope_rate"``: a sensor's name and displacement, rate, acceleration, slope or slope_rate; by
        default all but accelerations at all sensors.
    modes : int
        Elastic modes that are kept, or a few more where the next one is close by.

    Returns
    -------
    StateSpace

    Raises
    ------
    ModelError
        If a name is not known, or nothing is to be read.

    Notes
    -----
    Rates and accelerations lack what the modes left out would add, which takes the rates of the inputs.

    Examples
    --------
    >>> from beal.vehicle import Sensor, catalog
    >>> column = catalog.beck().model_copy(update={"sensors": (Sensor(name="tip", station=1.0),)})
    >>> found = state_space(column, thrust=0.0, inputs=[1.0], outputs=["tip.displacement"], modes=2)
    >>> found.A.shape, round(float(found.frequency_response(0.0)[0, 0].real), 9)  # L^3/(3 EI)
    ((4, 4), 0.333333333)
    """
    with one_thread():
        operators = discretise(model, order=_order(model, modes)) if isinstance(model, Vehicle) else model
        vehicle = operators.vehicle
        thrust = thrust_of(vehicle, thrust)
        if modes < 1:
            raise ModelError(f"modes: must be at least 1, found {modes}")
        if not inputs:
            raise ModelError("inputs: give at least one, found none")
        loads = [_load(operators, name, thrust) for name in inputs]
        outputs = tuple(outputs) if outputs is not None else _all_outputs(vehicle)
        readings = [_reading(vehicle, name) for name in outputs]
        reduced = reduce(operators, thrust, modes)
        f = np.array([row for row, _, _ in loads]).T
        A, B = _dynamics(reduced, f)
        C, D = _observed(operators, reduced, readings, f, thrust)
    count = len(reduced.A)
    names = [f"p{n}" for n in range(1, count + 1)]
    return StateSpace(
        A=A,
        B=B,
        C=C,
        D=D,
        states=(*names, *(f"{name}_rate" for name in names)),
        inputs=tuple(name for _, name, _ in loads),
        outputs=outputs,
        input_units=tuple(_unit(vehicle, unit) for _, _, unit in loads),
        output_units=tuple(_unit(vehicle, UNITS[quantity]) for _, quantity in readings),
        thrust=thrust,
    )


def _order(vehicle: Vehicle, modes: int) -> int:
    """Degree of the polynomials that resolves the lowest modes, in each of the segments."""
    return max(14, 2 * modes + 8) if len(vehicle.stages) < 4 else 10


def _unit(vehicle: Vehicle, unit: str) -> str:
    return unit if vehicle.units == "SI" else ""


def _load(operators: Operators, name: str | float, thrust: float) -> tuple[Array, str, str]:
    """The load on the coordinates for a unit of an input, the input's name and unit."""
    vehicle = operators.vehicle
    if name == DELTA:
        return -thrust * turned(operators)[0], name, "rad"
    if name == ACCELERATION:
        if vehicle.control is None or vehicle.control.engine is None:
            raise ModelError(f"inputs: {name} needs an engine with inertia, control.engine, found none")
        return -turned(operators)[1], name, "rad/s^2"
    if isinstance(name, str):
        stations = [force.station for force in vehicle.forces if force.name == name]
        if not stations:
            known = ", ".join([DELTA, *(force.name for force in vehicle.forces if force.name)])
            raise ModelError(f"inputs: must be one of {known}, or a station, found {name!r}")
        return operators.shape(stations[0])[0], name, "N"
    if not 0 <= name <= vehicle.length:
        raise ModelError(f"inputs: a station must lie on the vehicle, 0 to {vehicle.length:.12g}, found {name}")
    return operators.shape(name)[0], f"force at {name:g}", "N"


def _all_outputs(vehicle: Vehicle) -> tuple[str, ...]:
    return tuple(f"{sensor.name}.{quantity}" for sensor in vehicle.sensors for quantity in DEFAULT)


def _reading(vehicle: Vehicle, name: str) -> tuple[float, str]:
    """Station and quantity of an output."""
    sensor, _, quantity = name.rpartition(".")
    stations = {part.name: part.station for part in vehicle.sensors}
    if sensor not in stations or quantity not in READINGS:
        known, quantities = ", ".join(stations) or "none", ", ".join(READINGS)
        expected = f"SENSOR.QUANTITY, of the sensors {known} and of {quantities}"
        raise ModelError(f"outputs: expected {expected}, found {name!r}")
    return stations[sensor], quantity


def _dynamics(reduced: ReducedEquations, f: Array) -> tuple[Array, Array]:
    count = len(reduced.A)
    resisting = np.zeros_like(reduced.A) if reduced.D is None else reduced.D
    A = np.block([[np.zeros((count, count)), np.eye(count)], [-reduced.A, -resisting]])
    return A, np.vstack((np.zeros((count, f.shape[1])), reduced.W.T @ f))


def _observed(
    operators: Operators, reduced: ReducedEquations, readings: list[tuple[float, str]], f: Array, thrust: float
) -> tuple[Array, Array]:
    """C and D: what sensors read of the coordinates, and what they read of the loads at once."""
    count = len(reduced.A)
    A, B = _dynamics(reduced, f)
    residual = _residual(operators, reduced, f, thrust)
    C, D = np.zeros((len(readings), 2 * count)), np.zeros((len(readings), f.shape[1]))
    for row, (station, quantity) in enumerate(readings):
        space, time = READINGS[quantity]  # type: ignore[index]
        reads = operators.shape(station, space)[0]
        if time < 2:
            C[row, time * count : (time + 1) * count] = reads @ reduced.X
        else:
            C[row], D[row] = reads @ reduced.X @ A[count:], reads @ reduced.X @ B[count:]
        if time == 0:
            D[row] = reads @ residual
    return C, D


def _residual(operators: Operators, reduced: ReducedEquations, f: Array, thrust: float) -> Array:
    """Static deflection of the modes left out under the loads, shape (n, inputs).

    K x = f - M X W^T f in their own subspace, where K + s M X W^T M is K and has an inverse.
    """
    M, X, W = operators.M, reduced.X, reduced.W
    left_out = f - M @ X @ (W.T @ f)
    shift = np.abs(reduced.mu).max()
    x = np.linalg.solve(operators.stiffness(thrust) + 2 * shift * M @ X @ W.T @ M, left_out)
    return np.asarray(x - X @ (W.T @ M @ x))
