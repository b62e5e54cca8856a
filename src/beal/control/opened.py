"""The loop broken before filters and actuator: L, of which 1 + L = 0 gives the roots of the closed one."""

from dataclasses import replace

import numpy as np
from scipy.linalg import solve

from beal.control.closed import refinements, thrust_of
from beal.control.compensator import Array
from beal.control.crossings import condensed
from beal.control.loop import Loop, law_of, loop
from beal.control.state_space import StateSpace
from beal.discretisation import Operators
from beal.errors import ModelError
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

DECADES, EACH = (-2.0, 1.0), 400  # below the slowest pole and beyond the fastest of modes; points of a decade
BESIDE = np.sinh(np.linspace(-6.0, 6.0, 121))  # points beside a resonance, in its half widths
UNDAMPED = 1e-9  # of the frequency, nearer than which to a pole L has no value


def open_loop(model: Vehicle | Operators, thrust: float | None = None, modes: int = 6) -> StateSpace:
    """The control loop of a vehicle, broken before its filters and actuator.

    Parameters
    ----------
    model : Vehicle or Operators
        With a control law.
    thrust : float, optional
        P, in N; by default the vehicle's nominal thrust.
    modes : int
        Number of elastic modes that are exact; more are kept for what they add.

    Returns
    -------
    StateSpace
        Of L, one input and one output: from what goes into the filters to minus the sum of gains times readings that
        comes back. Wherever else the loop were broken, L would be the same.

    Raises
    ------
    ModelError
        If there is no control law or no thrust, or a number is out of range.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> law = Control(lag=0.02, gains=[Gain(sensor="imu", quantity="slope", gain=0.5)])
    >>> missile = catalog.beal().model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.5),), "control": law})
    >>> L = open_loop(missile, thrust=0.01)
    >>> value = L.frequency_response(0.1)[0, 0]  # of a rigid body 6 P K/(m L^2 s^2), after a lag
    >>> round(float(abs(value)) * 0.1**2 / (6 * 0.01 * 0.5), 3)
    1.0
    """
    with one_thread():
        small, thrust = broken(model, thrust, modes)
        A, B, C, D = opened(small, thrust)
    vehicle, n = small.operators.vehicle, len(small.kept)
    names = [f"p{k}" for k in range(1, n + 1)]
    states = (*names, *(f"{name}_rate" for name in names), *(f"z{k}" for k in range(1, len(A) - 2 * n + 1)))
    unit = ("rad",) if vehicle.units == "SI" else ("",)
    return StateSpace(A, B, C, np.array([[D]]), states, ("sensed",), ("returned",), unit, unit, thrust)


def broken(model: Vehicle | Operators, thrust: float | None, modes: int) -> tuple[Loop, float]:
    """The loop in few coordinates, in which as many modes as asked for are exact, and the thrust."""
    vehicle = model if isinstance(model, Vehicle) else model.vehicle
    law_of(vehicle)
    thrust = thrust_of(vehicle, thrust)
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    closed = next(refinements(model, 2 * modes)) if isinstance(model, Vehicle) else loop(model)
    return condensed(closed, 3 * modes), thrust


def opened(closed: Loop, thrust: float) -> tuple[Array, Array, Array, float]:
    """L = C (s - A)^-1 B + D: from what goes into filters and actuator to minus what the sensors then give back.

    Parameters
    ----------
    closed : Loop
        Condensed.
    thrust : float
        In N.

    Returns
    -------
    A, B, C : ndarray, shapes (n, n), (n, 1), (1, n)
    D : float
    """
    law, n = closed.compensator, len(closed.kept)
    E, A = replace(closed, g=np.zeros_like(closed.g)).matrices(thrust)
    force = -thrust * law.D * closed.b - law.acceleration[1] * closed.w
    B = np.concatenate((np.zeros(n), force, law.B[:, 0]))[:, None]
    A, B = np.asarray(solve(E, A)), np.asarray(solve(E, B))
    g0, g1, g2 = closed.g
    none = np.zeros(len(law.A))
    C = -np.concatenate((g0, g1, none))[None] - g2 @ A[n : 2 * n]
    return A, B, C, -float(g2 @ B[n : 2 * n, 0])


def frequencies(loop: StateSpace) -> Array:
    """Where to look at a loop: evenly over its decades, close together beside its resonances, and not at a pole."""
    poles = np.linalg.eigvals(loop.A)
    size = np.abs(poles)[np.abs(poles) > 1e-6 * np.abs(poles).max()]
    swings = poles[poles.imag > 0]
    top = swings.imag.max(initial=size.min())
    low, high = np.log10(size.min()) + DECADES[0], np.log10(top) + DECADES[1]
    even = np.logspace(low, high, round((high - low) * EACH))
    width = np.maximum(np.abs(swings.real), 1e-4 * swings.imag)
    near = (swings.imag[:, None] + width[:, None] * BESIDE).ravel()
    omega = np.unique(np.concatenate((even, near[(near > even[0]) & (near < even[-1])])))
    apart = np.abs(1j * omega[:, None] - poles).min(axis=1)
    return np.asarray(omega[apart > UNDAMPED * omega])
