"""The vehicle with its control law as one first-order system, affine in the thrust.

M q'' + C q' + K(P) q = - P b delta - w delta''
                                          b: deflection where the thrust turns, times the share of P there
                                          w: what the engine's inertia pushes as it turns
e = g0 q + g1 q' + g2 q''                 sums of gain times what the sensors read
z' = A z + B e,  delta = C z + D e        filters, actuator and delay; D = 0 where there is a g2
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from beal.control.compensator import Array, Compensator, compensator
from beal.discretisation.axial import acceleration
from beal.discretisation.basis import ROTATION, SLOPE
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.stability.pencil import UNCOUPLED, ComplexArray
from beal.vehicle.control import Control, Quantity
from beal.vehicle.vehicle import Vehicle

READINGS: dict[Quantity, tuple[int, int]] = {  # derivatives in space and in time
    "displacement": (0, 0),
    "rate": (0, 1),
    "acceleration": (0, 2),
    "slope": (1, 0),
    "slope_rate": (1, 1),
}
Indices = NDArray[np.intp]
INFINITE = 1e-14  # of the inverse of a root at infinity, beside that of the reference frequency


@dataclass(frozen=True)
class Loop:
    """E x' = (A0 + P A1) x in x = (q, q', z), without the rigid-body motions that only follow.

    Parameters
    ----------
    operators : Operators
        The vehicle without its control law.
    compensator : Compensator
    b, w : ndarray, shape (n,)
    g : ndarray, shape (3, n)
        Rows g0, g1 and g2.
    kept : ndarray of int
        The coordinates that are part of it.
    """

    operators: Operators
    compensator: Compensator
    b: Array
    w: Array
    g: Array
    kept: Indices

    @property
    def speed(self) -> float:
        """The reference frequency, in rad/s."""
        return self.operators.vehicle.scales.angular_frequency

    @property
    def static(self) -> bool:
        """Whether nothing dissipates and nothing delays: roots come in pairs s, -s."""
        return not len(self.compensator.A) and not self.g[1].any() and self.operators.C is None

    @property
    def zero_roots(self) -> int:
        """Roots that are zero at every thrust: two of a motion that only follows, and those of the others."""
        return 2 * (len(self.operators.M) - len(self.kept)) + self.resting

    def drift(self, thrust: float) -> int:
        """Roots that are zero at a thrust; without any nothing acts on a free vehicle but an engine's inertia."""
        if thrust or self.w.any() or self.operators.dead is not None:
            return self.zero_roots
        law = self.operators.vehicle.control
        return 2 * self.operators.rigid + (sum(part.integrates for part in law.filters) if law else 0)

    @cached_property
    def resting(self) -> int:
        """Zero roots of the motions that are kept: one of a drift that rates alone resist, two of a free one."""
        count = 0
        for motion in self.kept[self.kept < self.operators.rigid]:
            stiff, viscous = _columns(self.operators, self.g[:1]), _columns(self.operators, self.g[1:2], rates=True)
            if not _acts(stiff, int(motion), self.kept):
                count += 1 if _acts(viscous, int(motion), self.kept) else 2
        return count

    def closed(self) -> Operators:
        """The operators with a law that neither dissipates nor delays in their stiffness."""
        fed = self.compensator.D * np.outer(self.b, self.g[0])
        return replace(self.operators, K1=self.operators.K1 + fed)

    def matrices(self, thrust: float) -> tuple[Array, Array]:
        """E and A(P), shape (2 n + k, 2 n + k) for n coordinates kept and k states of the compensator."""
        E, A0, A1 = self.affine
        return E, A0 + thrust * A1

    @cached_property
    def affine(self) -> tuple[Array, Array, Array]:
        """E, A0 and A1."""
        kept, law = self.kept, self.compensator
        M, K1 = (matrix[np.ix_(kept, kept)] for matrix in (self.operators.M, self.operators.K1))
        K0 = self.operators.stiffness(0.0)[np.ix_(kept, kept)]
        C = np.zeros_like(M) if self.operators.C is None else self.operators.C[np.ix_(kept, kept)]
        b, w, (g0, g1, g2) = self.b[kept, None], self.w[kept, None], self.g[:, None, kept]
        n, k = len(kept), len(law.A)
        zero, none = np.zeros((n, n)), np.zeros((n, k))
        turning, at_once = law.acceleration
        wg = [at_once * w @ g for g in (g0, g1, g2)]
        E = np.block([[np.eye(n), zero, none], [zero, M + wg[2], none], [none.T, -law.B @ g2, np.eye(k)]])
        A0 = np.block(
            [[zero, np.eye(n), none], [-K0 - wg[0], -C - wg[1], -w @ turning], [law.B @ g0, law.B @ g1, law.A]]
        )
        A1 = np.zeros_like(A0)
        A1[n : 2 * n] = np.hstack((-K1 - law.D * b @ g0, -law.D * b @ g1, -b @ law.C))
        return E, A0, A1


def loop(operators: Operators) -> Loop:
    """The loop that a vehicle's control law closes.

    Parameters
    ----------
    operators : Operators

    Returns
    -------
    Loop

    Raises
    ------
    ModelError
        If the vehicle has no control law, or no thrust turns.
    """
    vehicle = operators.vehicle
    control = law_of(vehicle)
    b, w = turned(operators)
    stations = {sensor.name: sensor.station for sensor in vehicle.sensors}
    g = np.zeros((3, len(operators.M)))
    for part in control.gains:
        space, time = READINGS[part.quantity]
        g[time] += part.gain * operators.shape(stations[part.sensor], space)[0]
    kept = np.arange(operators.rigid, len(operators.M))
    columns = [*_columns(operators, g), *_columns(operators, g[:0], rates=True)]
    for _ in range(operators.rigid):  # one motion may act on the others through another
        others = [motion for motion in range(operators.rigid) if motion not in kept]
        kept = np.sort(np.append(kept, [motion for motion in others if _acts(columns, motion, kept)])).astype(int)
    return Loop(operators, compensator(control), b, w, g, kept)


def turned(operators: Operators) -> tuple[Array, Array]:
    """What the angle delta of the thrust and its second derivative do: b and w of a load - P b delta - w delta''.

    The engine turns by phi = y' + delta about its gimbal at y. With S and J the first and the second moment of its mass
    about there its kinetic energy is that of a locked one and (S y_t + J y'_t) delta_t + J delta_t^2/2. Under the axial
    acceleration a it hangs like a pendulum, with the energy S a phi^2/2, of which S a y' delta is new; the weight of a
    vehicle that is held, and what drag takes from a, are left out.

    Parameters
    ----------
    operators : Operators

    Returns
    -------
    b, w : ndarray, shape (n,)

    References
    ----------
    Greensite, A. L., 1970. Analysis and Design of Space Vehicle Flight Control Systems. Spartan, chapter 2.
    """
    vehicle = operators.vehicle
    control = vehicle.control
    station = np.array([turning_station(vehicle, control)])
    deflection = operators.shape(station)[0]
    b = vehicle.thrust.scale * deflection
    if control is None or control.engine is None:
        return b, np.zeros_like(b)
    engine = control.engine
    turn = operators.basis.at(station, ROTATION if vehicle.thrust.along == "section" else SLOPE, "aft")[0]
    return b + engine.moment * acceleration(vehicle) * turn, engine.moment * deflection + engine.inertia * turn


def law_of(vehicle: Vehicle) -> Control:
    """The control law of a vehicle.

    Raises
    ------
    ModelError
        If it has none, or no thrust that could turn.
    """
    if vehicle.control is None:
        raise ModelError(
            "control: the vehicle has no control law; add [control] with gains such as "
            '[{sensor = "imu", quantity = "slope", gain = 0.5}]'
        )
    if not vehicle.thrust.scale:
        raise ModelError("thrust.scale: a control law turns the thrust at its station, found a share of 0")
    return vehicle.control


def turning_station(vehicle: Vehicle, control: Control | None) -> float:
    """Where the thrust turns, in m: as the law says, or where the thrust acts, which is the tail by default."""
    given = (control.station if control else None, vehicle.thrust.station, vehicle.length)
    return next(station for station in given if station is not None)


def roots(E: Array, A: Array, speed: float) -> ComplexArray:
    """All finite s of s E x = A x in order of modulus, from the inverse, in which the slow ones are large.

    Parameters
    ----------
    E, A : ndarray, shape (n, n)
    speed : float
        A frequency of the size of the slow ones, in rad/s.

    Returns
    -------
    ndarray of complex, shape (n,) or less by the roots at infinity

    Examples
    --------
    >>> roots(np.diag([1.0, 0.0]), np.diag([-3.0, 1.0]), 1.0).real.tolist()
    [-3.0]
    """
    inverse = np.linalg.eigvals(np.linalg.solve(A - speed * E, speed * E)).astype(complex)
    s = speed + speed / inverse[np.abs(inverse) > INFINITE]
    return np.asarray(s[np.lexsort((s.imag, np.abs(s)))])


def _columns(operators: Operators, readings: Array, rates: bool = False) -> list[Array]:
    """What a motion acts through: the loads that it changes, or what resists its rate, and what sensors read of it."""
    given = [operators.C] if rates else [operators.K1, operators.dead]
    return [*(matrix for matrix in given if matrix is not None), *(row[None] for row in readings)]


def _acts(matrices: list[Array], motion: int, kept: Indices) -> bool:
    """Whether a motion acts on the coordinates that are kept."""
    for matrix in matrices:
        column = matrix[:, motion] if len(matrix) == 1 else matrix[kept, motion]
        if np.abs(column).max(initial=0.0) > UNCOUPLED * np.abs(matrix).max(initial=0.0):
            return True
    return False
