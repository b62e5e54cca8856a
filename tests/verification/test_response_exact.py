"""Responses against closed forms, and Newmark's method against the exact one."""

import math

import numpy as np
import pytest

from beal.discretisation import discretise
from beal.motion import ModeShape, Release, Response, growth_rate, response
from beal.motion.exact import exact
from beal.motion.newmark import newmark
from beal.motion.signals import samples, terms
from beal.vehicle.parts import Force, Joint, Sensor, Stage, Thrust
from beal.vehicle.signals import Chirp, Gust, Noise, Pulse, Sine, Step, Table
from beal.vehicle.vehicle import Vehicle

MASS, OMEGA = 2.0, 3.0
SINE = Sine(kind="sine", amplitude=1.5, angular_frequency=2.0, phase=0.4)
RESONANT = Sine(kind="sine", amplitude=1.5, angular_frequency=OMEGA)
STEP = Step(kind="step", amplitude=1.5, start=0.737)
PULSE = Pulse(kind="pulse", amplitude=1.5, start=0.737, duration=1.1)
GUST = Gust(kind="gust", amplitude=1.5, start=0.737, duration=1.1)
CHIRP = Chirp(kind="chirp", amplitude=1.5, first=0.5, last=20.0, duration=4.0, phase=0.4)
NOISE = Noise(kind="noise", angular_frequency=[0.5, 5.0], density=[0.3, 0.1], seed=3, lines=40)
TABLE = Table(kind="table", time=(0.5, 1.013, 2.0), value=(0.0, 2.0, -1.0))


def step_response(t, start):
    s = np.maximum(t - start, 0.0)
    return (1 - np.cos(OMEGA * s)) / (MASS * OMEGA**2)


def ramp_response(t, start):
    s = np.maximum(t - start, 0.0)
    return (s - np.sin(OMEGA * s) / OMEGA) / (MASS * OMEGA**2)


def sine_response(t):
    w, a = SINE.angular_frequency, SINE.amplitude / MASS / (OMEGA**2 - SINE.angular_frequency**2)
    start, rate = a * math.sin(SINE.phase), a * w * math.cos(SINE.phase)
    return a * np.sin(w * t + SINE.phase) - start * np.cos(OMEGA * t) - rate / OMEGA * np.sin(OMEGA * t)


def table_response(t):
    slopes = np.concatenate([[0.0], np.diff(TABLE.value) / np.diff(TABLE.time), [0.0]])
    return sum(kink * ramp_response(t, start) for kink, start in zip(np.diff(slopes), TABLE.time, strict=True))


def gust(t):
    return 1.5 / 2 * (1 - np.cos(2 * math.pi * (t - 0.737) / 1.1)) * ((t > 0.737) & (t < 1.837))


def chirp(t):
    return 1.5 * np.sin(np.where(t < 4.0, 0.5 * t + 19.5 * t**2 / 8, 0.5 * 4 + 19.5 * 2 + 20.0 * (t - 4.0)) + 0.4)


def quadrature(force, breaks):
    """Duhamel's integral at increasing times, by Gauss's rule on short panels between them and the breaks."""

    def displacement(t):
        nodes = np.unique(np.concatenate([np.linspace(0, t[-1], 1401), t, np.clip(breaks, 0, t[-1])]))
        x, w = np.polynomial.legendre.leggauss(6)
        half = np.diff(nodes)[:, None] / 2
        s = nodes[:-1, None] + half * (1 + x)
        inside = [np.cumsum((half * w * force(s) * f(OMEGA * s)).sum(axis=1)) for f in (np.cos, np.sin)]
        cosine, sine = (np.concatenate([[0.0], part])[np.searchsorted(nodes, t)] for part in inside)
        return (np.sin(OMEGA * t) * cosine - np.cos(OMEGA * t) * sine) / (MASS * OMEGA)

    return displacement


def noise_response(t):
    """The sum of the closed forms of its sines."""
    total = np.zeros_like(t)
    for term in terms(NOISE):
        w, a = term.angular_frequency, term.amplitude / MASS / (OMEGA**2 - term.angular_frequency**2)
        start, rate = a * math.sin(term.phase), a * w * math.cos(term.phase)
        total += a * np.sin(w * t + term.phase) - start * np.cos(OMEGA * t) - rate / OMEGA * np.sin(OMEGA * t)
    return total


CLOSED_FORMS = [
    pytest.param(SINE, sine_response, id="sine"),
    pytest.param(
        RESONANT,
        lambda t: RESONANT.amplitude / (2 * MASS * OMEGA**2) * (np.sin(OMEGA * t) - OMEGA * t * np.cos(OMEGA * t)),
        id="resonant sine",
    ),
    pytest.param(STEP, lambda t: 1.5 * step_response(t, 0.737), id="step"),
    pytest.param(PULSE, lambda t: 1.5 * (step_response(t, 0.737) - step_response(t, 1.837)), id="pulse"),
    pytest.param(TABLE, table_response, id="table"),
    pytest.param(GUST, quadrature(gust, [0.737, 1.837]), id="gust"),
    pytest.param(CHIRP, quadrature(chirp, [4.0]), id="chirp"),
    pytest.param(NOISE, noise_response, id="noise"),
]


@pytest.mark.parametrize(("signal", "expected"), CLOSED_FORMS)
@pytest.mark.parametrize("step", [0.05, 0.7, 7.0])
def test_exact_oscillator_follows_the_closed_form_whatever_the_step(signal, expected, step):
    count = round(7.0 / step)
    at_rest = np.zeros(1), np.zeros(1)
    q, _ = exact(np.array([[OMEGA**2]]), np.array([[1 / MASS]]), [signal], at_rest, step, count)
    np.testing.assert_allclose(q[:, 0], expected(step * np.arange(count + 1)), atol=1e-11)


@pytest.mark.parametrize(("signal", "expected"), CLOSED_FORMS)
def test_exact_rate_is_the_derivative_of_the_closed_form(signal, expected):
    step, small = 0.25, 1e-4
    at_rest = np.zeros(1), np.zeros(1)
    _, rate = exact(np.array([[OMEGA**2]]), np.array([[1 / MASS]]), [signal], at_rest, step, 24)
    t = step * np.arange(1, 25)
    difference = (expected(t + small) - expected(t - small)) / (2 * small)
    np.testing.assert_allclose(rate[1:, 0], difference, atol=1e-7)  # small**2 times the third derivative


@pytest.mark.parametrize(("signal", "expected"), CLOSED_FORMS)
@pytest.mark.parametrize(
    ("beta", "gamma", "order"), [(1 / 4, 1 / 2, 2), (1 / 6, 1 / 2, 2), (0.0, 1 / 2, 2), (0.36, 0.7, 1)]
)
def test_newmark_converges_at_its_order_wherever_a_jump_lies(signal, expected, beta, gamma, order):
    errors = []
    for count in (1000, 2000, 4000, 8000):
        step = 7.0 / count
        load = samples(signal, step, count + 1)[:, None] / MASS
        at_rest = np.zeros(1), np.zeros(1)
        q, _, _ = newmark(np.eye(1), np.array([[OMEGA**2]]), load, at_rest, step, beta, gamma)
        errors.append(np.linalg.norm(q[:, 0] - expected(step * np.arange(count + 1))) / math.sqrt(count))
    slope = -np.polyfit(np.arange(4), np.log2(errors), 1)[0]
    assert order - 0.1 < slope < order + 0.1


def test_exact_solves_a_defective_system():
    """q1'' + q1 + q2 = 0 and q2'' + q2 = 0: q2 = cos t drives q1 = -t sin(t)/2 in resonance."""
    stiffness, start = np.array([[1.0, 1.0], [0.0, 1.0]]), (np.array([0.0, 1.0]), np.zeros(2))
    q, rate = exact(stiffness, np.zeros((2, 0)), [], start, 0.3, 100)
    t = 0.3 * np.arange(101)
    np.testing.assert_allclose(q, np.column_stack([-t * np.sin(t) / 2, np.cos(t)]), atol=1e-11)
    np.testing.assert_allclose(rate[:, 0], -(np.sin(t) + t * np.cos(t)) / 2, atol=1e-11)


@pytest.mark.parametrize("coupling", [0.4, 3.0])
def test_growth_of_a_circulatory_pair_is_that_of_its_eigenvalue(coupling):
    """q'' + [[4, c], [-c, 4.5]] q = 0 flutters for c > 1/4."""
    stiffness = np.array([[4.0, coupling], [-coupling, 4.5]])
    growth = max(abs(np.emath.sqrt(-np.linalg.eigvals(stiffness)).real))
    start, step = (np.array([1.0, 0.0]), np.zeros(2)), 0.02
    count = round(30 / growth / step)
    q, rate = exact(stiffness, np.zeros((2, 0)), [], start, step, count)
    motion = Response(
        time=step * np.arange(count + 1),
        sensors=("first",),
        displacement=q.T[:1],
        rate=rate.T[:1],
        acceleration=0 * q.T[:1],
        slope=0 * q.T[:1],
        slope_rate=0 * q.T[:1],
        rigid_displacement=0 * q.T[:1],
        rigid_slope=0 * q.T[:1],
        coordinates=q,
        coordinate_rates=rate,
        thrust=0.0,
        thrust_history=np.zeros(count + 1),
        method="exact",
        step=step,
        mu=np.linalg.eigvals(stiffness).astype(complex),
    )
    assert growth_rate(motion, "first") == pytest.approx(growth, rel=1e-3)


def test_force_of_the_tail_flies_a_free_vehicle_away():
    """Centre: F t^2/(2 m). Attitude: moment F L/2 over inertia m L^2/12, hence 3 F t^2/(m L)."""
    force, mass = 0.3, 2.0
    beam = uniform_beam(
        mass_per_length=mass,
        forces=[Force(station=1.0, signal=Step(kind="step", amplitude=force))],
        sensors=[Sensor(name=f"s{i}", station=x) for i, x in enumerate(GAUSS)],
    )
    motion = response(beam, duration=3.0, thrust=0.0, step=0.1, modes=1, method="exact")
    centre = WEIGHTS @ motion.displacement
    attitude = 12 * (WEIGHTS * (GAUSS - 0.5)) @ motion.displacement
    np.testing.assert_allclose(centre, force * motion.time**2 / (2 * mass), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(attitude, 3 * force * motion.time**2 / mass, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("method", ["exact", "newmark"])
def test_the_rigid_body_part_of_a_flight_is_the_line_with_its_momentum_and_the_rest_has_none(method):
    force, mass, stations = 0.3, 2.0, (*GAUSS, 0.0, 0.3, 1.0)
    beam = uniform_beam(
        mass_per_length=mass,
        forces=[Force(station=1.0, signal=Step(kind="step", amplitude=force))],
        sensors=[Sensor(name=f"s{i}", station=x) for i, x in enumerate(stations)],
    )
    motion = response(beam, duration=1.0, thrust=0.0, modes=4, method=method)
    line = force * motion.time**2 / mass * (0.5 + 3 * (np.array(stations)[:, None] - 0.5))
    np.testing.assert_allclose(motion.rigid_displacement, line, atol=1e-9)
    np.testing.assert_allclose(motion.rigid_slope[0], 3 * force * motion.time**2 / mass, atol=1e-9)
    elastic = motion.elastic_displacement[: len(GAUSS)]
    for moment in (WEIGHTS, WEIGHTS * GAUSS):
        np.testing.assert_allclose(moment @ elastic, 0.0, atol=1e-9 * abs(elastic).max())
    np.testing.assert_allclose(motion.rigid_slope + motion.elastic_slope, motion.slope)
    assert abs(motion.elastic_slope).max() > 1e-3 * abs(motion.rigid_slope).max()


def test_follower_thrust_pushes_the_centre_of_mass_against_the_slope_of_the_tail():
    thrust = 60.0
    beam = uniform_beam(sensors=[Sensor(name=f"s{i}", station=x) for i, x in enumerate([*GAUSS, 1.0])])
    motion = response(
        beam, duration=0.5, thrust=thrust, step=0.001, modes=8, method="exact", initial=ModeShape(1, 0.01)
    )
    centre = WEIGHTS @ motion.displacement[:-1]
    acceleration = np.diff(centre, 2) / motion.step**2
    largest = abs(acceleration).max()
    np.testing.assert_allclose(acceleration, -thrust * motion.slope[-1, 1:-1], atol=1e-4 * largest)  # h^2 w^2/12


def test_free_vibration_of_a_uniform_beam_follows_its_analytic_mode():
    """Free-free beam, cosh(l) cos(l) = 1 (Blevins 1979, Table 8-1): the mode swings as cos(l^2 t)."""
    root = 7.853204624095838
    beam = uniform_beam(sensors=[Sensor(name="imu", station=0.12)])
    ratio = (math.cosh(root) - math.cos(root)) / (math.sinh(root) - math.sin(root))
    x = root * 0.12
    shape = (math.cosh(x) + math.cos(x) - ratio * (math.sinh(x) + math.sin(x))) / 2
    motion = response(
        discretise(beam, order=14),
        duration=1.0,
        thrust=0.0,
        step=0.01,
        modes=3,
        method="exact",
        initial=ModeShape(2, amplitude=0.05, at="nose"),
    )
    np.testing.assert_allclose(motion.displacement[0], 0.05 * shape * np.cos(root**2 * motion.time), atol=1e-10)


def test_newmark_with_constant_mean_acceleration_keeps_the_energy_of_free_vibration():
    beam = discretise(uniform_beam(sensors=[Sensor(name="imu", station=0.0)]))
    motion = response(beam, duration=5.0, thrust=0.0, initial=Release(0.01))
    kinetic = np.einsum("ki,ij,kj->k", motion.coordinate_rates, beam.M, motion.coordinate_rates)
    potential = np.einsum("ki,ij,kj->k", motion.coordinates, beam.K0, motion.coordinates)
    np.testing.assert_allclose(kinetic + potential, potential[0], rtol=1e-8)


def test_newmark_converges_to_the_exact_response_of_a_fluttering_vehicle():
    vehicle = discretise(paper_vehicle())
    options = {"duration": 0.4, "thrust": 128.0, "initial": Release(0.01)}
    errors = []
    for step in (4e-4, 2e-4, 1e-4):
        truth = response(vehicle, method="exact", step=step, **options)
        motion = response(vehicle, method="newmark", step=step, modes=12, **options)
        errors.append(np.linalg.norm(motion.displacement - truth.displacement) * math.sqrt(step))
    assert 1.9 < math.log2(errors[0] / errors[1]) < 2.1
    assert 1.9 < math.log2(errors[1] / errors[2]) < 2.1


def test_paper_vehicle_stays_bounded_below_its_critical_thrust():
    """Irani & Kavianipour (2009), Fig. 13: P = 90 of 106.4, over 100 periods of the first mode."""
    start = 0.01
    period = 2 * math.pi / math.sqrt(151.9197)
    motion = response(
        paper_vehicle(), duration=100 * period, thrust=90.0, initial=ModeShape(1, start), rigid_body=False
    )
    assert motion.mu[0].real == pytest.approx(151.92, rel=1e-4)
    early, late = np.array_split(abs(motion.displacement[0]), 2)
    assert early.max() < 5 * start
    assert late.max() == pytest.approx(early.max(), rel=0.01)
    assert abs(growth_rate(motion, "imu")) < 1e-3


@pytest.mark.parametrize("method", ["newmark", "exact"])
@pytest.mark.parametrize("rigid_body", [False, True])
def test_paper_vehicle_flutters_above_its_critical_thrust_at_the_rate_of_its_eigenvalue(method, rigid_body):
    """Irani & Kavianipour (2009), Fig. 14: P = 128."""
    vehicle = discretise(paper_vehicle())
    roots = np.emath.sqrt(-np.linalg.eigvals(np.linalg.solve(vehicle.M, vehicle.stiffness(128.0))))
    growth = max(abs(roots.real))
    motion = response(vehicle, duration=2.0, thrust=128.0, method=method, initial=Release(0.01), rigid_body=rigid_body)
    assert growth_rate(motion, "imu") == pytest.approx(growth, rel=1e-3)


@pytest.mark.filterwarnings("ignore::beal.motion.steps.AliasingWarning")
def test_modes_left_out_hardly_matter_to_a_released_vehicle():
    """The eight and twelve lowest modes give the same motion to a share of 1e-3 of the nose's deflection."""
    vehicle = discretise(paper_vehicle())
    options = {"duration": 1.0, "thrust": 90.0, "step": 0.01, "method": "exact", "initial": Release(0.01)}
    all_modes = response(vehicle, modes=99, **options).displacement
    for modes, share in ((8, 1e-3), (12, 3e-4)):
        assert abs(response(vehicle, modes=modes, **options).displacement - all_modes).max() < share * 0.01


GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(20)
GAUSS, WEIGHTS = (GAUSS + 1) / 2, WEIGHTS / 2


def uniform_beam(mass_per_length=1.0, **parts):
    return Vehicle(
        stages=[Stage(length=1.0, mass_per_length=mass_per_length, bending_stiffness=1.0)],
        units="nondimensional",
        **parts,
    )


def paper_vehicle():
    forward, aft = (Stage(length=length, mass_per_length=1.0, bending_stiffness=1.0) for length in (0.6, 0.4))
    return Vehicle(
        stages=[forward, aft],
        joints=[Joint(rotational_stiffness=5000.0, shear_stiffness=5000.0)],
        thrust=Thrust(nominal=90.0),
        sensors=[Sensor(name="imu", station=0.12)],
        units="nondimensional",
    )
