"""Motion under a thrust that varies in time: closed forms, another integrator, and the balance of energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import airy

from beal.discretisation import discretise
from beal.discretisation.basis import Combined
from beal.errors import ModelError
from beal.motion import ModeShape, PulsatingThrust, Release, ThrustTable, response
from beal.motion.collocation import VaryingEquations, collocation
from beal.motion.exact import exact
from beal.motion.newmark import newmark_varying
from beal.motion.reduction import free_modes
from beal.vehicle import Damping, Force, Gust, Sensor, Step, catalog

TIME = 0.1 * np.arange(101)
PULSATING = PulsatingThrust(60.0, 30.0, angular_frequency=9.0, phase=0.4)


def unforced(time):
    return np.zeros((*time.shape, 1))


def airy_oscillator(time):
    """q'' + (4 + 3 t) q = 0 with q(0) = 1, q'(0) = 1/2, in Airy functions of x = -(4 + 3 t)/3^(2/3)."""
    k = 3 ** (1 / 3)
    a, a_rate, b, b_rate = airy(-4.0 / k**2)
    first, second = np.linalg.solve([[a, b], [-k * a_rate, -k * b_rate]], [1.0, 0.5])
    a, a_rate, b, b_rate = airy(-(4.0 + 3.0 * time) / k**2)
    return first * a + second * b, -k * (first * a_rate + second * b_rate)


@pytest.mark.parametrize("step", [0.02, 0.1, 1.0])
def test_collocation_follows_airys_functions_under_a_ramp(step):
    equations = VaryingEquations(np.array([[4.0]]), np.array([[1.0]]), None, lambda t: 3 * t, unforced, [])
    count = round(10 / step)
    q, rate = collocation(equations, (np.array([1.0]), np.array([0.5])), step, count)
    expected, expected_rate = airy_oscillator(step * np.arange(count + 1))
    np.testing.assert_allclose(q[:, 0], expected, atol=1e-11)
    np.testing.assert_allclose(rate[:, 0], expected_rate, atol=1e-10)


def test_newmark_is_of_second_order_under_a_ramp():
    errors = []
    for count in (500, 1000, 2000):
        time = np.linspace(0.0, 10.0, count + 1)
        start = (np.array([1.0]), np.array([0.5]))
        matrices = (np.array([[4.0]]), np.array([[1.0]]), 3 * time)
        q, _, _ = newmark_varying(*matrices, np.zeros((count + 1, 1)), start, time[1], 0.25, 0.5, None)
        errors.append(abs(q[:, 0] - airy_oscillator(time)[0]).max())
    assert [math.log2(a / b) for a, b in zip(errors, errors[1:], strict=False)] == pytest.approx([2, 2], abs=0.05)


def test_collocation_agrees_with_an_explicit_integrator_on_any_system():
    """Dormand & Prince's eighth-order method, damped, circulatory and forced, over a kink of the stiffness."""
    rng = np.random.default_rng(5)
    A, B, D = np.diag([4.0, 30.0, 90.0]), rng.normal(size=(3, 3)), 0.1 * rng.normal(size=(3, 3))
    table, shape = ThrustTable([0.0, 1.234, 3.0], [0.0, 4.0, 1.0]), rng.normal(size=3)

    def force(t):
        return np.sin(7 * t)[..., None] * shape

    equations = VaryingEquations(A, B, D, table.at, force, table.breakpoints)
    start = (rng.normal(size=3), rng.normal(size=3))
    q, rate = collocation(equations, start, 0.1, 40)

    def slope(t, y):
        K = A + float(table.at(t)) * B
        return np.concatenate([y[3:], force(np.asarray(t)) - D @ y[3:] - K @ y[:3]])

    state = np.concatenate(start)
    for a, b in ((0.0, 1.234), (1.234, 3.0), (3.0, 4.0)):
        state = solve_ivp(slope, (a, b), state, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    np.testing.assert_allclose(np.concatenate([q[-1], rate[-1]]), state, atol=1e-10)


def test_collocation_under_a_constant_thrust_is_the_exact_solution():
    A, start = np.array([[4.0, 1.0], [-2.0, 9.0]]), (np.array([1.0, 0.0]), np.array([0.0, 1.0]))
    push = Step(kind="step", amplitude=2.0, start=0.7371)
    shape = np.array([[1.0], [-1.0]])
    found = exact(A, shape, [push], start, 0.1, 100)

    def force(t):
        return np.where(t >= push.start, push.amplitude, 0.0)[..., None] * shape[:, 0]

    equations = VaryingEquations(A, np.eye(2), None, lambda t: 0 * t, force, [push.start])
    for one, other in zip(found, collocation(equations, start, 0.1, 100), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-10)


def launcher(**parts):
    gust = Force(station=0.1, signal=Gust(kind="gust", amplitude=0.5, start=0.05, duration=0.2))
    parts = {"damping": Damping(ratios=[0.01]), "forces": (gust,)} | parts
    return catalog.tsto(0.6, 5000.0, 5000.0).model_copy(update=parts)


@pytest.mark.parametrize("thrust", [PULSATING, ThrustTable([0.1, 0.5, 0.6], [20.0, 100.0, 40.0])])
def test_the_work_of_a_varying_thrust_and_the_other_loads_is_the_change_of_energy(thrust):
    """Powers by the trapezoidal rule: what is missing falls with h^2. Nothing couples with modes left out."""
    full = discretise(launcher())
    V = free_modes(full)[2][:, : full.rigid + 6]
    M, K0, K1, C = (V.T @ matrix @ V for matrix in (full.M, full.K0, full.K1, full.C))
    basis = Combined(full.basis.basis, full.basis.transformation @ V)
    operators = replace(full, M=M, K0=K0, K1=K1, C=C, basis=basis)
    missing = []
    for step in (4e-4, 2e-4):
        motion = response(operators, 1.0, thrust, step=step, method="exact", initial=Release(0.01), modes=6)
        q, rate = motion.coordinates, motion.coordinate_rates
        energy = np.einsum("ki,ij,kj->k", rate, operators.M, rate) + np.einsum("ki,ij,kj->k", q, operators.K0, q)
        s = motion.time - 0.05
        push = 0.25 * (1 - np.cos(2 * np.pi * s / 0.2)) * ((s > 0) & (s < 0.2))
        power = push * (rate @ operators.shape(0.1)[0]) - np.einsum("ki,ij,kj->k", rate, operators.C, rate)
        power -= motion.thrust_history * np.einsum("ki,ij,kj->k", rate, operators.K1, q)
        work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * step)])
        missing.append(abs((energy - energy[0]) / 2 - work).max() / energy.max())
    assert missing[1] < 1e-3
    assert math.log2(missing[0] / missing[1]) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("thrust", [PULSATING, ThrustTable([0.1, 0.3], [20.0, 100.0])])
def test_newmark_converges_to_the_accurate_motion_of_a_vehicle(thrust):
    operators, errors = discretise(launcher()), []
    for step in (4e-4, 2e-4, 1e-4):
        truth, motion = (
            response(operators, 0.4, thrust, step=step, method=method, initial=Release(0.01), modes=6)
            for method in ("exact", "newmark")
        )
        errors.append(abs(motion.displacement - truth.displacement).max())
    assert [math.log2(a / b) for a, b in zip(errors, errors[1:], strict=False)] == pytest.approx([2, 2], abs=0.15)


@pytest.mark.parametrize("thrust", [PulsatingThrust(70.0, 0.0, 3.0), ThrustTable([0.0, 1.0], [70.0, 70.0])])
@pytest.mark.parametrize("method", ["newmark", "exact"])
def test_a_thrust_that_could_vary_and_does_not_is_a_constant_one(thrust, method):
    options = {"initial": ModeShape(1, 0.01), "method": method, "step": 5e-4, "modes": 6}
    varying, constant = (response(launcher(), 0.3, p, **options) for p in (thrust, 70.0))
    for name in ("displacement", "slope_rate", "acceleration"):
        expected = getattr(constant, name)
        np.testing.assert_allclose(getattr(varying, name), expected, atol=1e-9 * abs(expected).max())


@pytest.mark.parametrize("method", ["newmark", "exact"])
def test_acceleration_is_the_derivative_of_the_rate_under_a_varying_thrust(method):
    motion = response(launcher(), 0.3, PULSATING, step=2e-4, initial=Release(0.01), modes=3, method=method)
    difference = np.gradient(motion.rate, motion.step, axis=1)[:, 1:-1]
    np.testing.assert_allclose(motion.acceleration[:, 1:-1], difference, atol=1e-3 * abs(difference).max())


def test_the_modes_of_the_middle_thrust_are_enough_for_a_wide_range_of_thrusts():
    """Eight modes of the vehicle under P = 50 against twelve, the thrust running from 0 to 100."""
    operators = discretise(launcher(forces=()))
    thrust = ThrustTable([0.0, 1.0], [0.0, 100.0])
    few, more = (
        response(operators, 1.0, thrust, step=8e-4, method="exact", initial=Release(0.01), modes=modes)
        for modes in (8, 12)
    )
    largest = abs(more.displacement).max()
    assert abs(few.displacement - more.displacement).max() < 1e-3 * largest


def test_a_pulsating_thrust_throws_a_vehicle_into_resonance_that_its_mean_does_not():
    """Twice the lowest frequency: the motion grows although both extremes of the thrust are stable."""
    sensors = (Sensor(name="tip", station=1.0),)
    column = catalog.beck().model_copy(update={"sensors": sensors})
    first = math.sqrt(response(column, 0.1, 8.0, initial=ModeShape(1, 0.01)).mu[0].real)
    for frequency, grows in ((2 * first, True), (2.7 * first, False)):
        thrust = PulsatingThrust(8.0, 4.0, frequency)
        motion = response(column, 40.0, thrust, step=0.02, modes=3, initial=ModeShape(1, 0.01), method="exact")
        assert (abs(motion.displacement[0, -200:]).max() > 0.1) == grows


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PulsatingThrust(-5.0, 6.0, 1.0), "its mean not negative, found -5.0 .+- 6.0"),
        (lambda: PulsatingThrust(math.nan, 0.0, 1.0), "must be finite, its mean not negative"),
        (lambda: PulsatingThrust(5.0, 1.0, 0.0), "its angular frequency must be positive, found 0.0"),
        (lambda: ThrustTable([0.0, 1.0], [1.0]), "needs a value for each time, found 1 for 2"),
        (lambda: ThrustTable([], []), "needs a value for each time, found 0 for 0"),
        (lambda: ThrustTable([0.0, 2.0, 1.0], [1.0, 1.0, 1.0]), "its times must be finite and increase"),
        (lambda: ThrustTable([0.0, math.nan], [1.0, 1.0]), "its times must be finite and increase"),
        (lambda: ThrustTable([0.0, 1.0], [1.0, -1.0]), "must be finite and not negative"),
        (lambda: ThrustTable([0.0, 1.0], [1.0, math.nan]), "must be finite and not negative"),
        (lambda: ThrustTable([0.0, 1.0], [1.0, ""]), "must be numbers, found .0.0, 1.0. and .1.0, ''."),
    ],
)
def test_a_varying_thrust_refuses(make, message):
    with pytest.raises(ModelError, match=message):
        make()
