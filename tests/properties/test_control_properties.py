"""What is said of closed loops in the frequency domain, by simulations over time of random ones."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import block_diag, expm
from scipy.signal import tf2ss

from beal import Actuator, Control, Engine, Filter, Gain, Sensor, closed_loop, discretise
from beal.control.compensator import pade
from beal.discretisation.basis import Combined
from beal.motion.reduction import free_modes
from properties.vehicles import random_vehicle, with_random_damping

MODES = 5
QUANTITIES = {"displacement": (0, 0), "rate": (0, 1), "acceleration": (0, 2), "slope": (1, 0), "slope_rate": (1, 1)}


def controlled(rng):
    """A damped vehicle with up to three gains, filters, a lag or a servo, a delay, and now and then a heavy engine."""
    vehicle = with_random_damping(rng, random_vehicle(rng, softest=10.0, stiffest=1e4, absent=0.0))
    sensors = tuple(Sensor(name=f"s{n}", station=rng.uniform(0.0, vehicle.length)) for n in range(2))
    names = rng.choice(list(QUANTITIES), size=rng.integers(1, 4), replace=False)
    gains = [Gain(sensor=f"s{rng.integers(2)}", quantity=name, gain=rng.normal() / 10) for name in names]
    filters = [Filter(numerator=[rng.uniform(0.5, 2), 1.0], denominator=[rng.uniform(0.01, 0.2), 1.0])]
    filters += [Filter(numerator=[1.0, 0.0, 400.0], denominator=[1.0, 12.0, 400.0])] if rng.random() < 0.5 else []
    law = {"filters": filters, "delay": rng.uniform(0.005, 0.05) if rng.random() < 0.5 else 0.0, "gains": gains}
    if rng.random() < 0.5:
        law["lag"] = rng.uniform(0.01, 0.1)
    else:
        law["actuator"] = Actuator(angular_frequency=rng.uniform(20.0, 80.0), damping_ratio=rng.uniform(0.4, 1.0))
        law["engine"] = Engine(mass=0.02, arm=0.05, inertia=1e-4)
    return vehicle.model_copy(update={"sensors": sensors, "control": Control(**law)})


def few_modes(vehicle):
    """A vehicle that has no more than its lowest modes: a law may well feed the others, which are not watched."""
    full = discretise(vehicle, basis="hermite", order=6)
    V = free_modes(full)[2][:, : full.rigid + MODES]
    M, K0, K1, C = (V.T @ matrix @ V for matrix in (full.M, full.K0, full.K1, full.C))
    basis = Combined(full.basis.basis, full.basis.transformation @ V)
    return replace(full, M=M, K0=K0, K1=K1, C=C, basis=basis)


def simulated(operators, thrust):
    """A of x' = A x: the law in blocks of its own, one after the other."""
    vehicle, law = operators.vehicle, operators.vehicle.control
    blocks = [(part.numerator, part.denominator) for part in law.filters]
    blocks += [((1.0,), (law.lag, 1.0))] if law.lag else []
    if law.actuator:
        omega, zeta = law.actuator.angular_frequency, law.actuator.damping_ratio
        blocks.append(((omega**2,), (1.0, 2 * zeta * omega, omega**2)))
    blocks += [pade(law.delay, law.delay_order)] if law.delay else []
    systems = [tf2ss(*block) for block in blocks]
    A = block_diag(*(system[0] for system in systems))
    starts = np.cumsum([0, *(len(system[0]) for system in systems)])
    B, C, D = np.zeros(len(A)), np.zeros(len(A)), 1.0  # of what reaches the next block
    for (_, b, c, d), low, high in zip(systems, starts, starts[1:], strict=False):
        A[low:high] += np.outer(b[:, 0], C)
        B[low:high] = b[:, 0] * D
        C = d[0, 0] * C
        C[low:high] += c[0]
        D *= d[0, 0]
    n, tail, station = (
        len(operators.M),
        operators.shape(vehicle.length)[0],
        {s.name: s.station for s in vehicle.sensors},
    )
    read = np.zeros((3, n))
    for gain in law.gains:
        space, time = QUANTITIES[gain.quantity]
        read[time] += gain.gain * operators.shape(station[gain.sensor], space)[0]
    push, swing = thrust * tail, np.zeros(n)
    if engine := law.engine:
        slope = operators.shape(vehicle.length, 1)[0]
        accelerated = thrust / vehicle.mass if vehicle.axial_force == "inertia" else 0.0
        push = push + engine.mass * engine.arm * accelerated * slope
        swing = engine.mass * engine.arm * tail + engine.inertia * slope
    # M q'' = -C q' - K q - push delta - swing delta'', delta = C z + D e, delta'' = C A (A z + B e) as C B = D = 0.
    fed = C @ A @ B if engine else 0.0
    left = operators.M + fed * np.outer(swing, read[2])
    K, damping = operators.stiffness(thrust), operators.C
    motion = np.hstack(
        (
            -K - np.outer(push * D + swing * fed, read[0]),
            -damping - np.outer(push * D + swing * fed, read[1]),
            -np.outer(push, C) - np.outer(swing, C @ A @ A if engine else 0.0 * C),
        )
    )
    left = left + D * np.outer(push, read[2])
    motion = np.linalg.solve(left, motion)
    law_rows = np.hstack((np.outer(B, read[0]), np.outer(B, read[1]), A)) + np.outer(B, read[2] @ motion)
    return np.vstack((np.hstack((np.zeros((n, n)), np.eye(n), np.zeros((n, len(A))))), motion, law_rows))


@pytest.mark.parametrize("seed", range(20))
def test_a_closed_loop_grows_or_decays_as_its_fastest_root_says(seed):
    rng = np.random.default_rng([2026, seed])
    while True:
        operators, thrust = few_modes(controlled(rng)), rng.uniform(1.0, 12.0)
        found = closed_loop(operators, thrust, MODES)
        s = found.roots[found.drift :]
        s = s[np.argsort(-s.real)]
        apart = s[0].real - s[s.real < s[0].real - 1e-9 * abs(s[0])][0].real
        if found.drift == 0 and found.stable == bool(seed % 2) and abs(s[0].real) > 1e-2 and apart > 1e-2:
            break
    step, A = 0.05, simulated(operators, thrust)
    before, growth = expm(A * step), 0.0
    for _ in range(16):  # doubling the time, its size kept apart
        before, growth = before @ before, 2 * growth
        size = np.abs(before).max()
        before, growth = before / size, growth + np.log(size)
        step *= 2
    x = np.random.default_rng(seed).normal(size=len(A))
    late, later = before @ x, before @ (before @ x)
    rate = (growth + np.log(np.linalg.norm(later) / np.linalg.norm(late))) / step
    assert rate == pytest.approx(s[0].real, rel=1e-2, abs=1e-4)
    assert (rate > 0) == (not found.stable)
