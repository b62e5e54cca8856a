"""The closed loop at one thrust: its roots, and whether it is stable."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from beal.control.compensator import Array
from beal.control.loop import Loop, loop, roots
from beal.discretisation import Operators, discretise
from beal.errors import ConvergenceError, ModelError
from beal.shown import Shown
from beal.stability.pencil import ComplexArray
from beal.stability.spectrum import exponents
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

ORDERS = (14, 20, 28, 40, 56)
LARGEST = 1200  # coordinates beyond which a discretisation is not refined further
GOOD, POOR = 1e-9, 1e-4  # change of a root, beside it or the reference frequency, at which to stop and to give up
UNPAIRED = 1e-6  # sum of imaginary parts, beside the largest root, that a pair of which one half is missing leaves
GROWING = 1e-8  # Re s, beside |s|, from which a root counts as growing


@dataclass(frozen=True)
class ClosedLoop(Shown):
    """Roots of a vehicle under a thrust with its control law.

    Parameters
    ----------
    thrust : float
        In N.
    roots : ndarray of complex, shape (k,)
        Those of smallest modulus, in rad/s: of the rigid-body motions, of as many elastic modes as were asked for, and
        one for each state of filters, actuator and delay. In order of modulus.
    drift : int
        How many of them, the leading ones, are zero at every thrust: two of the free translation, two of the free
        rotation where nothing acts on the attitude, one of a motion that rates alone resist.
    error_estimate : ndarray, shape (k,)
        How much each root changed in the last refinement, in rad/s; nan for operators, which are not refined.
    units : {"SI", "nondimensional"}
    """

    thrust: float
    roots: ComplexArray
    drift: int
    error_estimate: Array
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def rigid_body_roots(self) -> ComplexArray:
        """Those of the drift, zeros."""
        return self.roots[: self.drift]

    @property
    def stable(self) -> bool:
        """Whether no root grows, those of the rigid-body drift aside."""
        moving = self.roots[self.drift :]
        return not bool(np.any(moving.real > GROWING * np.abs(moving)))

    @property
    def least_damped(self) -> complex:
        """The root that is closest to growing or grows most for its modulus, with Im s >= 0, in rad/s."""
        moving, ratio = self.roots[self.drift :], self.damping_ratio[self.drift :]
        return complex(moving[np.argmin(ratio - 1e-12 * (moving.imag >= 0))])

    @property
    def damping_ratio(self) -> Array:
        """-Re s/|s| of each root, 0 where s = 0."""
        size = np.abs(self.roots)
        return np.asarray(np.where(size > 0, -self.roots.real, 0.0) / np.where(size > 0, size, 1.0))


def closed_loop(model: Vehicle | Operators, thrust: float | None = None, modes: int = 6) -> ClosedLoop:
    """Roots of a vehicle under a thrust with its control law closed.

    Solves s^2 M q + s C q + K(P) q = -P b delta, delta = H(s) (g0 + s g1 + s^2 g2) q, as one eigenvalue problem with
    the states of filters, actuator and Padé delay.

    Parameters
    ----------
    model : Vehicle or Operators
        With a control law; a vehicle is discretised more and more finely until its roots no longer change.
    thrust : float, optional
        P, in N; by default the vehicle's nominal thrust.
    modes : int
        Number of elastic modes whose roots are given. An instability in a faster root does not show.

    Returns
    -------
    ClosedLoop

    Raises
    ------
    ModelError
        If there is no control law or no thrust, or a number is out of range.
    ConvergenceError
        If so many modes do not converge.

    References
    ----------
    Beal, T. R., 1965. Dynamic stability of a flexible missile under constant and pulsating thrusts. AIAA Journal, 3(3),
    486-494.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> law = Control(gains=[Gain(sensor="imu", quantity="slope", gain=1.0)])
    >>> missile = catalog.beal().model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.5),), "control": law})
    >>> found = closed_loop(missile, thrust=10.0, modes=2)
    >>> found.stable, found.drift, found.roots.imag[found.roots.imag > 0].round(6).tolist()
    (True, 2, [6.297973, 21.286512, 58.0225])
    """
    vehicle = model if isinstance(model, Vehicle) else model.vehicle
    thrust = thrust_of(vehicle, thrust)
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    with one_thread():
        if isinstance(model, Operators):
            closed = loop(model)
            s = lowest_roots(closed, thrust, modes)
            return ClosedLoop(thrust, s, closed.drift(thrust), np.full(len(s), np.nan), vehicle.units)
        before, best = np.empty(0, dtype=complex), np.inf
        for closed in refinements(vehicle, modes):
            s = lowest_roots(closed, thrust, modes)
            if len(before):
                error = np.abs(s[:, None] - before).min(axis=1)
                change = float(np.max(error / np.maximum(np.abs(s), closed.speed)))
                if change < best:
                    best, found = change, ClosedLoop(thrust, s, closed.drift(thrust), error, vehicle.units)
                if best < GOOD:
                    return found
            before = s
    if best > POOR:
        raise ConvergenceError(f"modes: the roots of {modes} modes do not converge; ask for fewer")
    return found


def thrust_of(vehicle: Vehicle, thrust: float | None) -> float:
    """The thrust given, or the nominal one.

    Raises
    ------
    ModelError
        If there is none, or it is no positive number.
    """
    thrust = vehicle.thrust.nominal if thrust is None else thrust
    if thrust is None:
        raise ModelError("thrust: give one, or set thrust.nominal in the model")
    if not 0 <= thrust < np.inf:
        raise ModelError(f"thrust: must be finite and not negative, found {thrust}")
    return float(thrust)


def refinements(vehicle: Vehicle, modes: int) -> Iterator[Loop]:
    """The loop in finer and finer discretisations, those that hold enough modes."""
    for order in ORDERS:
        operators = discretise(vehicle, order=order)
        if len(operators.M) - operators.rigid >= modes:
            yield loop(operators)
        if len(operators.M) > LARGEST:
            return


def lowest_roots(closed: Loop, thrust: float, modes: int) -> ComplexArray:
    """Roots of smallest modulus, the constantly zero ones first and exact."""
    count = 2 * (closed.operators.rigid + modes) + len(closed.compensator.A)
    s = _undamped(closed, thrust) if closed.static else roots(*closed.matrices(thrust), closed.speed)
    drift = 2 * (len(closed.operators.M) - len(closed.kept))
    s = np.concatenate((np.zeros(drift, dtype=complex), s))
    s[: closed.drift(thrust)] = 0.0
    split = np.abs(s[:count].imag.sum()) > UNPAIRED * np.abs(s[:count]).max()
    return np.asarray(s[: count + split])


def _undamped(closed: Loop, thrust: float) -> ComplexArray:
    """Pairs s, -s from their square, so that what neither grows nor decays is on the axis exactly."""
    select = np.ix_(closed.kept, closed.kept)
    M, K = closed.operators.M[select], closed.closed().stiffness(thrust)[select]
    shift = closed.speed**2
    inverse = np.linalg.eigvals(np.linalg.solve(K + shift * M, M)).astype(complex)
    s = exponents(np.asarray(1 / inverse - shift))
    return np.stack((-s, s), axis=1)[np.argsort(np.abs(s))].ravel()
