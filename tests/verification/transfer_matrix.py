"""An exact solver of its own: the beam's first-order equations, integrated from nose to tail.

The state is (w, psi, M, V): deflection, rotation of the section, bending moment and the transverse force V, of a
direction fixed in space, that the aft part exerts on the forward one. With N the axial compression, S the shear
stiffness and motions exp(lambda t)

    w' = (psi + V/S) / (1 - N/S) (Engesser) or psi + (V + N psi)/S (Haringx),   EI psi' = M,
    M' = -V - N w' + rho I lambda^2 psi,   V' = (m lambda^2 + c lambda + k) w + tangency p w',

EI and S times 1 + tau lambda, p = -N' a distributed load. The determinant F(P, lambda) of the conditions at both ends
vanishes at a root. Of beal only its description of the vehicle is used. Each segment without steps is integrated by
Gauss collocation of order 16.
"""

import math
from collections.abc import Callable, Iterator
from functools import cache

import numpy as np
from scipy.special import roots_legendre

from beal.vehicle import Stage, Vehicle
from beal.vehicle.stations import StationTable, values

STAGES, PANELS = 8, 12  # collocation points in a panel, panels in a segment
TINY = 1e-30  # complex step
CIRCLE, RADIUS = 16, 3.0  # points and radius of Cauchy's integral about omega = 0


@cache
def collocation() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gauss points c on (0, 1), integrals A of their Lagrange polynomials from 0 to each point, and weights b."""
    x, weights = roots_legendre(STAGES)
    c = (x + 1) / 2
    powers = np.arange(1, STAGES + 1)
    A = (c[:, None] ** powers / powers) @ np.linalg.inv(c[:, None] ** (powers - 1))
    return c, A, weights / 2


class TransferMatrix:
    """The characteristic function of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
    damping : float
        Factor on all damping.
    """

    def __init__(self, vehicle: Vehicle, damping: float = 1.0) -> None:
        self.vehicle, self.damping = vehicle, damping
        tables = [load.value for load in vehicle.distributed_thrusts if isinstance(load.value, StationTable)]
        steps = {x for table in tables for x in table.x}
        for start, stage in zip(vehicle.boundaries, vehicle.stages, strict=False):
            steps |= {start + x for table in stage.tables.values() for x in table.x}
        lumps, sensors = (tuple(part.station for part in parts) for parts in (vehicle.point_masses, vehicle.sensors))
        stations = {*vehicle.boundaries, *steps, *lumps, *sensors}
        self.stations = sorted(stations)

    def __call__(self, thrust: complex, root: complex) -> complex:
        """F(P, lambda)."""
        state = np.eye(4, dtype=complex)
        nose = self._end(0, state, -state[3], -state[2])
        delta = self._turned(0.0, self._slope(np.array(0.0), thrust, root) @ state)
        for lump in self._lumps(0.0):
            state = self._lump(lump, root) @ state
        for front, back in zip(self.stations, self.stations[1:], strict=False):
            for matrix in self._panels(front, back, thrust, root):
                state = matrix @ state
            inside = np.array(back * (1 - 1e-15))  # forward of lumps there
            turned = self._slope(inside, thrust, root) @ state
            delta = delta + self._turned(back, turned)
            if back in self.vehicle.boundaries[1:-1]:
                joint = self.vehicle.joints[self.vehicle.boundaries.index(back) - 1]
                state = self._joint(joint, thrust * self._compression(inside), root) @ state
            for lump in self._lumps(back):
                state = self._lump(lump, root) @ state
        return complex(np.linalg.det(np.vstack((nose, self._tail(thrust, state, turned, delta)))))

    def _turned(self, station: float, slope: np.ndarray) -> np.ndarray:
        """What the sensors at a station add to the angle of the thrust, by a law on slopes alone."""
        here = {sensor.name for sensor in self.vehicle.sensors if sensor.station == station}
        gains = self.vehicle.control.gains if self.vehicle.control else ()
        return sum(part.gain for part in gains if part.sensor in here) * slope

    def _lumps(self, station: float) -> Iterator:
        return (lump for lump in self.vehicle.point_masses if lump.station == station)

    def _compression(self, x: np.ndarray) -> np.ndarray:
        """N / P at stations; that of lumps forward of them included."""
        vehicle, x = self.vehicle, np.asarray(x)
        if vehicle.axial_force == "constant":
            loads = [(load.value, vehicle.length) for load in vehicle.distributed_thrusts]
            return vehicle.thrust.scale + 0 * x + sum(integral(p, end) - integral(p, x) for p, end in loads)
        forward = sum(lump.mass * (lump.station <= x) for lump in vehicle.point_masses) + np.zeros(np.shape(x))
        for start, stage in zip(vehicle.boundaries, vehicle.stages, strict=False):
            forward = forward + integral(stage.mass_per_length, np.clip(x - start, 0.0, stage.length))
        return vehicle.thrust.scale * forward / vehicle.mass

    def _panels(self, front: float, back: float, thrust: complex, root: complex) -> np.ndarray:
        """Transfer matrices of the panels of a segment, shape (PANELS, 4, 4)."""
        c, A, b = collocation()
        h = (back - front) / PANELS
        x = front + h * (np.arange(PANELS)[:, None] + c)
        equations = h * self._equations(x, thrust, root)
        system = np.eye(4 * STAGES) - np.einsum("ij,pjkl->pikjl", A, equations).reshape(PANELS, 4 * STAGES, -1)
        start = np.broadcast_to(np.tile(np.eye(4), (STAGES, 1)), (PANELS, 4 * STAGES, 4))
        inside = np.linalg.solve(system, start).reshape(PANELS, STAGES, 4, 4)
        return np.eye(4) + np.einsum("j,pjkl,pjlm->pkm", b, equations, inside)

    def _stage(self, x: np.ndarray) -> tuple[Stage, np.ndarray]:
        """The stage that holds stations, and their distances from its front."""
        index = self.vehicle.stage_at(float(x.mean()))
        return self.vehicle.stages[index], x - self.vehicle.boundaries[index]

    def _slope(self, x: np.ndarray, thrust: complex, root: complex) -> np.ndarray:
        """w' at stations, as a row that acts on the state, shape (..., 4)."""
        stage, y = self._stage(x)
        sheared = 1 / values(stage.shear_stiffness, y) / (1 + stage.internal_damping * self.damping * root)
        N = thrust * self._compression(x)
        row = np.zeros((*x.shape, 4), dtype=complex)
        engesser = self.vehicle.thrust.axial_term == "engesser"
        row[..., 1] = 1 / (1 - N * sheared) if engesser else 1 + N * sheared
        row[..., 3] = sheared / (1 - N * sheared) if engesser else sheared
        return row

    def _equations(self, x: np.ndarray, thrust: complex, root: complex) -> np.ndarray:
        """Matrices of the first-order equations at stations, shape (..., 4, 4)."""
        stage, y = self._stage(x)
        slope, rate = self._slope(x, thrust, root), self.damping * root
        turning = sum(load.tangency * values(load.value, x) for load in self.vehicle.distributed_thrusts) + 0 * x
        E = np.zeros((*x.shape, 4, 4), dtype=complex)
        E[..., 0, :] = slope
        E[..., 1, 2] = 1 / values(stage.bending_stiffness, y) / (1 + stage.internal_damping * rate)
        E[..., 2, :] = -thrust * self._compression(x)[..., None] * slope
        E[..., 2, 1] += values(stage.rotary_inertia_per_length, y) * root**2
        E[..., 2, 3] -= 1.0
        E[..., 3, :] = thrust * turning[..., None] * slope
        E[..., 3, 0] += values(stage.mass_per_length, y) * root**2 + values(stage.foundation_stiffness, y)
        E[..., 3, 0] += stage.external_damping * rate
        return E

    def _joint(self, joint, N: complex, root: complex) -> np.ndarray:
        """k_s s = V + N sigma and k_r turn = M on the springs, N s being shared by the faces that sigma belongs to."""
        rate = self.damping * root
        turns = 1 / (joint.rotational_stiffness + joint.rotational_damping * rate)
        slides = 1 / (joint.shear_stiffness + joint.shear_damping * rate)
        forward, aft = {"mean": (0.5, 0.5), "forward": (1, 0), "aft": (0, 1), "inertial": (0, 0)}[joint.shear_axis]
        # unknown slide s and turn t: s = slides (V + N ((forward + aft) theta + aft t)), t = turns (M - forward N s)
        left = np.array([[1, -slides * N * aft], [turns * N * forward, 1]])
        right = np.array([[0, slides * N * (forward + aft), 0, slides], [0, 0, turns, 0]])
        slide, turn = np.linalg.solve(left, right)
        moment = -N * (forward + aft) * slide
        return np.eye(4) + np.array([slide, turn, moment, np.zeros(4)])

    def _lump(self, lump, root: complex) -> np.ndarray:
        jump = np.eye(4, dtype=complex)
        jump[3, 0], jump[2, 1] = lump.mass * root**2, lump.rotary_inertia * root**2
        return jump

    def _end(self, end: int, state: np.ndarray, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
        """Conditions on the springs of an end, or on what they hold."""
        springs = zip(self.vehicle.support.stiffness[end], state[:2], (force, moment), strict=True)
        return np.array([moved if math.isinf(k) else k * moved + load for k, moved, load in springs])

    def _tail(self, thrust: complex, state: np.ndarray, slope: np.ndarray, delta: np.ndarray) -> np.ndarray:
        """Conditions under the thrust, which goes with the slope inside of a lump at the tail."""
        given = self.vehicle.thrust
        P = thrust * given.scale * given.tangency
        if given.line == "fixed":
            return self._end(1, state, state[3], state[2] + P * state[0])
        force = P * (slope if given.along == "slope" else state[1]) + thrust * given.scale * delta
        return self._end(1, state, state[3] + force, state[2])


def integral(given: float | StationTable, x: np.ndarray) -> np.ndarray:
    return given.integral(x) if isinstance(given, StationTable) else given * x


def flutter(vehicle: Vehicle, thrust: float, omega: float) -> tuple[float, float]:
    """The double root next to a guess: F = dF/dW = 0, W = omega^2, the derivative by a complex step."""
    characteristic = TransferMatrix(vehicle)

    def equations(x: np.ndarray) -> np.ndarray:
        F = characteristic(x[0], np.sqrt(-(x[1] + 1j * TINY)))
        return np.array([F.real, F.imag / TINY])

    thrust, W = newton(equations, thrust, omega**2)
    return thrust, math.sqrt(W)


def damped_flutter(vehicle: Vehicle, thrust: float, omega: float, damping: float = 1.0) -> tuple[float, float]:
    """Where i omega is a root, next to a guess; with a tiny factor on the damping, the limit of a vanishing one."""
    characteristic = TransferMatrix(vehicle, damping)

    def equations(x: np.ndarray) -> np.ndarray:
        F = characteristic(x[0], 1j * x[1])
        return np.array([F.real, F.imag / damping])

    return newton(equations, thrust, omega)


def divergence(vehicle: Vehicle, thrust: float) -> float:
    """The thrust next to a guess at which a root is zero, beside the two of W that a vehicle in flight always has.

    A law on the slope leaves it one, that of the translation.
    """
    characteristic = TransferMatrix(vehicle)
    W = RADIUS * np.exp(2j * np.pi * (np.arange(CIRCLE) + 0.5) / CIRCLE) if vehicle.free_free else np.array([0.0])
    zeros = (1 if vehicle.control else 2) if vehicle.free_free else 0

    def equation(P: float) -> float:
        return np.mean([characteristic(P, np.sqrt(-w + 0j)) / w**zeros for w in W]).real

    return newton(lambda x: np.array([equation(x[0]), x[1]]), thrust, 0.0)[0]


def frequency(vehicle: Vehicle, thrust: float, omega: float) -> float:
    """The simple root next to a guess."""
    characteristic = TransferMatrix(vehicle)
    return newton(lambda x: np.array([characteristic(thrust, 1j * x[0]).real, x[1]]), omega, 0.0)[0]


def newton(equations: Callable[[np.ndarray], np.ndarray], *guess: float) -> tuple[float, ...]:
    """The solution of two equations next to a guess."""
    x = np.array(guess)
    for _ in range(12):
        steps = np.diag(1e-5 * np.maximum(np.abs(x), 1.0))
        jacobian = [(equations(x + step) - equations(x - step)) / (2 * step.sum()) for step in steps]
        change = np.linalg.solve(np.transpose(jacobian), equations(x))
        x = x - change
        if np.all(np.abs(change) <= 1e-13 * np.maximum(np.abs(x), 1.0)):
            break
    return tuple(x.tolist())
