"""What a response refuses, how a motion starts, and the pieces that it is made of."""

import math
from contextlib import nullcontext

import numpy as np
import pytest
from scipy.linalg import expm

from beal.discretisation import discretise
from beal.errors import ConvergenceError, ModelError
from beal.motion import (
    AliasingWarning,
    CoarseStepWarning,
    ModeShape,
    Release,
    Response,
    Samples,
    growth_rate,
    response,
    signals,
)
from beal.motion.histories import turning_points
from beal.motion.newmark import largest_step, newmark
from beal.motion.reduction import reduce
from beal.vehicle import (
    Chirp,
    Force,
    Gust,
    Joint,
    Noise,
    Pulse,
    Sensor,
    Sine,
    Stage,
    Step,
    Support,
    Table,
    Thrust,
    Vehicle,
    catalog,
)

IMU = Sensor(name="imu", station=0.12)
SINE = Sine(kind="sine", amplitude=2.0, angular_frequency=3.0, phase=0.5)
STEP = Step(kind="step", amplitude=2.0, start=1.0)
PULSE = Pulse(kind="pulse", amplitude=2.0, start=1.0, duration=0.5)
GUST = Gust(kind="gust", amplitude=3.0, start=1.0, duration=1.0)
CHIRP = Chirp(kind="chirp", amplitude=2.0, first=3.0, last=11.0, duration=2.0, phase=0.3)
NOISE = Noise(kind="noise", angular_frequency=[2.0, 10.0, 30.0], density=[0.0, 2.0, 0.0], seed=7)
TABLE = Table(kind="table", time=(1.0, 2.0, 4.0), value=(5.0, 7.0, -1.0))


def beam(**parts):
    parts = {"sensors": (IMU,), "thrust": Thrust(nominal=50.0)} | parts
    return catalog.beal().model_copy(update=parts)


def largest(operators, q):
    return abs(operators.shape(np.linspace(0, operators.vehicle.length, 2001)) @ q).max()


@pytest.mark.parametrize(
    ("signal", "time", "expected"),
    [
        (SINE, [0.0, 1.0], [2 * math.sin(0.5), 2 * math.sin(3.5)]),
        (STEP, [0.999, 1.0, 9.0], [0.0, 2.0, 2.0]),
        (PULSE, [0.999, 1.0, 1.499, 1.5], [0.0, 2.0, 2.0, 0.0]),
        (TABLE, [0.0, 1.0, 1.5, 3.0, 9.0], [5.0, 5.0, 6.0, 3.0, -1.0]),
    ],
)
def test_signal_has_its_value(signal, time, expected):
    np.testing.assert_allclose(signals.value(signal, time), expected, atol=1e-15)


@pytest.mark.parametrize(
    ("signal", "expected"),
    [
        (SINE, ()),
        (STEP, (1.0,)),
        (PULSE, (1.0, 1.5)),
        (GUST, (1.0, 2.0)),
        (CHIRP, (2.0,)),
        (NOISE, ()),
        (TABLE, (1.0, 2.0, 4.0)),
    ],
)
def test_signal_breaks_where_it_or_its_rate_jumps(signal, expected):
    assert signals.breakpoints(signal) == expected


@pytest.mark.parametrize("signal", [SINE, STEP, PULSE, GUST, CHIRP, TABLE])
@pytest.mark.parametrize("middle", [1.2, 1.75, 3.1])
def test_the_system_of_a_signal_carries_it_forth_and_back(signal, middle):
    half = min(0.2, signals.longest_interval(signal) / 2)
    for elapsed in (-half, half / 3, half):
        carried = expm(signals.generator(signal) * elapsed) @ signals.state(signal, middle)
        assert carried[0] == pytest.approx(float(signals.value(signal, middle + elapsed)), abs=1e-13)


@pytest.mark.parametrize("signal", [GUST, CHIRP])
def test_a_gust_and_a_chirp_are_what_their_formulas_say(signal):
    time = np.array([0.9, 1.3, 1.7, 2.6])
    gust = 1.5 * (1 - np.cos(2 * math.pi * (time - 1.0))) * (time > 1) * (time < 2)
    angle = np.where(time < 2.0, 3 * time + 8 * time**2 / 4, 3 * 2 + 8 + 11 * (time - 2)) + 0.3  # 3 to 11 rad/s in 2 s
    np.testing.assert_allclose(signals.value(signal, time), gust if signal is GUST else 2 * np.sin(angle), atol=1e-14)


def test_noise_has_the_power_of_its_spectrum_band_by_band():
    """Variance of the sines up to w: the integral of the density, within the power of one line."""
    assert len({term.amplitude for term in signals.terms(NOISE)}) > 100
    frequencies = np.array([term.angular_frequency for term in signals.terms(NOISE)])
    power = np.array([term.amplitude**2 / 2 for term in signals.terms(NOISE)])
    for w, expected in ((2.0, 0.0), (6.0, 2.0), (10.0, 8.0), (30.0, 8.0 + 20.0)):
        assert power[frequencies <= w].sum() == pytest.approx(expected, rel=1e-12)
    assert power[frequencies <= 20.0].sum() == pytest.approx(8 + 15, abs=1.1 * power.max())


def test_noise_is_the_same_for_its_seed_and_has_its_variance_over_time():
    time = np.linspace(0.0, 2000.0, 200001)
    other = NOISE.model_copy(update={"seed": 8})
    np.testing.assert_array_equal(signals.value(NOISE, time[:9]), signals.value(NOISE, time[:9]))
    assert abs(signals.value(NOISE, time[:9]) - signals.value(other, time[:9])).max() > 0.1
    force = signals.value(NOISE, time)
    assert np.var(force) == pytest.approx(28.0, rel=0.03)
    assert np.mean(force**4) == pytest.approx(3 * np.var(force) ** 2, rel=0.1)  # as of a Gaussian


@pytest.mark.parametrize("start", [0.0, 0.03, 0.1, 0.314159, 0.95])
@pytest.mark.parametrize("duration", [0.05, 0.47])
def test_samples_keep_the_impulse_of_a_pulse_and_its_moment(start, duration):
    """By the trapezoidal rule; the moment only to second order where the pulse starts in the first step."""
    pulse = Pulse(kind="pulse", amplitude=3.0, start=start, duration=duration)
    step, count = 0.1, 41
    sampled, time = signals.samples(pulse, step, count), step * np.arange(count)
    assert np.trapezoid(sampled, time) == pytest.approx(3.0 * duration, rel=1e-12)
    moment = 3.0 * duration * (start + duration / 2)
    tolerance = 1e-12 if start >= step else 3.0 * duration * step**2 / 2
    assert np.trapezoid(sampled * time, time) == pytest.approx(moment, abs=tolerance)


def test_newmark_starts_from_the_acceleration_of_the_first_load():
    """A free unit mass under a constant force: constant mean acceleration is exact."""
    q, rate, acceleration = newmark(np.eye(1), np.zeros((1, 1)), np.full((5, 1), 3.0), (np.ones(1), np.ones(1)), 0.5)
    t = 0.5 * np.arange(5)
    np.testing.assert_allclose(q[:, 0], 1 + t + 1.5 * t**2, rtol=1e-14)
    np.testing.assert_allclose(rate[:, 0], 1 + 3 * t, rtol=1e-14)
    np.testing.assert_allclose(acceleration, 3.0, rtol=1e-14)


def test_newmark_takes_any_mass_matrix():
    mass, stiffness = np.array([[3.0, 1.0], [1.0, 2.0]]), np.array([[5.0, -1.0], [2.0, 4.0]])
    load, start = np.ones((50, 2)), (np.array([0.1, 0.2]), np.zeros(2))
    q, _, acceleration = newmark(mass, stiffness, load, start, 0.1)
    np.testing.assert_allclose(acceleration @ mass.T + q @ stiffness.T, load, atol=1e-13)


@pytest.mark.parametrize("gamma", [0.5, 0.6])
@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_newmark_is_stable_up_to_its_largest_step(gamma, factor):
    frequency = 4.0
    step = factor * largest_step(frequency, 0.1, gamma)
    motion = newmark(
        np.eye(1), np.full((1, 1), frequency**2), np.zeros((4001, 1)), (np.ones(1), np.ones(1)), step, 0.1, gamma
    )
    grows = abs(motion[0][-100:]).max() > 100 * abs(motion[0][:100]).max()
    assert grows == (factor > 1)


def test_newmark_with_enough_beta_has_no_largest_step():
    assert largest_step(1e6, 0.25, 0.5) == math.inf


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"gamma": 0.4}, "gamma: must be at least 1/2, found 0.4; below, the method has negative damping"),
        ({"gamma": math.nan}, "gamma: must be at least 1/2, found nan"),
        ({"beta": -0.1}, "beta: must not be negative, found -0.1"),
        ({"duration": 0.0}, "duration: must be positive and finite, found 0.0"),
        ({"duration": math.nan}, "duration: must be positive and finite, found nan"),
        ({"step": 0.0}, "step: must be positive and no longer than the duration, 1, found 0.0"),
        ({"step": 2.0}, "step: must be positive and no longer than the duration, 1, found 2.0"),
        ({"step": 1e-7}, "step: at most 1000000 steps are taken, found 10000000; shorten the duration or lengthen"),
        ({"method": "euler"}, "method: must be one of newmark, exact, found 'euler'"),
        ({"modes": 0}, "modes: must be at least 1, found 0"),
        ({"thrust": -1.0}, "thrust: must be finite and not negative, found -1.0"),
        ({"thrust": math.nan}, "thrust: must be finite and not negative, found nan"),
        ({"beta": 0.0, "step": 0.01}, "step: with beta = 0 and gamma = 0.5 it must be shorter than .*keep fewer modes"),
        ({"initial": None}, "initial: nothing moves the vehicle; add a .*force.* or give an initial deflection"),
    ],
)
def test_a_response_refuses(options, message):
    with pytest.raises(ModelError, match=message):
        response(beam(), **({"duration": 1.0, "initial": Release(0.01)} | options))


def test_a_response_without_a_sensor_says_how_to_add_one():
    with pytest.raises(ModelError, match=r'found none; add one, such as \[\[sensor\]\] name = "imu" station = 0.12'):
        response(beam(sensors=()), duration=1.0, initial=Release(0.01))


def test_a_response_without_a_thrust_says_where_to_give_it():
    with pytest.raises(ModelError, match=r"thrust: give one, or set thrust\.nominal in the model"):
        response(beam(thrust=Thrust()), duration=1.0, initial=Release(0.01))


def test_the_nominal_thrust_is_the_default():
    assert response(beam(), duration=0.1, initial=Release(0.01)).thrust == 50.0


def test_a_coarse_newmark_step_warns():
    with pytest.warns(CoarseStepWarning, match="longer than a tenth of the shortest period of interest"):
        response(beam(), duration=1.0, step=0.02, initial=Release(0.01))


@pytest.mark.parametrize("method", ["newmark", "exact"])
def test_an_aliasing_step_warns_with_the_highest_frequency_kept(method):
    highest = math.sqrt(response(beam(), duration=0.1, initial=Release(0.01)).mu[-1].real)
    message = (
        f"aliased: the highest frequency kept is {highest:.4g} rad/s, .*shorten it to {math.pi / highest:.3g} or keep"
    )
    for step, warns in ((1.02 * math.pi / highest, True), (0.98 * math.pi / highest, False)):
        with pytest.warns(AliasingWarning, match=message) if warns else nullcontext():
            response(beam(), duration=100 * step, step=step, initial=Release(0.01), method=method)


@pytest.mark.parametrize("modes", [4, 12, 20])
def test_the_default_step_follows_the_highest_frequency_kept(modes):
    """And is no longer than it takes to follow the four lowest modes, nor shorter than either asks for."""
    motion = response(beam(), duration=0.5, initial=Release(0.01), modes=modes)
    highest, fourth = math.sqrt(motion.mu[-1].real), math.sqrt(motion.mu[5].real)
    assert motion.step == pytest.approx(min(math.pi / highest, 2 * math.pi / fourth / 40), rel=0.02)


def test_a_fast_sine_force_shortens_the_default_step():
    fast = Force(station=1.0, signal=Sine(kind="sine", amplitude=1.0, angular_frequency=5000.0))
    assert response(beam(forces=(fast,)), duration=0.01).step == pytest.approx(2 * math.pi / 5000 / 40, rel=0.2)


def test_the_step_divides_the_duration():
    motion = response(beam(), duration=1.0, step=0.003, modes=5, initial=Release(0.01), method="exact")
    assert (len(motion.time), motion.step) == (335, pytest.approx(1 / 334))
    assert motion.time[-1] == pytest.approx(1.0, rel=1e-14)
    rounded_up = 0.1 + 0.2
    assert (
        len(response(beam(), duration=rounded_up, step=0.1, modes=1, initial=Release(0.01), method="exact").time) == 4
    )


def test_a_motion_beyond_all_numbers_is_a_failure_of_the_numerics():
    with pytest.raises(
        ConvergenceError, match=r"the motion outgrew the range of numbers in step .* shorten the duration"
    ):
        response(beam(), duration=200.0, thrust=160.0, step=0.02, modes=2, initial=Release(0.01), method="exact")


def test_a_response_is_linear_in_the_forces_and_adds_them():
    both = (Force(station=1.0, signal=SINE), Force(station=1.0, signal=TABLE))
    options = {"duration": 5.0, "method": "exact", "step": 0.01, "modes": 3}
    together = response(beam(forces=both), **options).displacement
    apart = sum(response(beam(forces=(force,)), **options).displacement for force in both)
    np.testing.assert_allclose(together, apart, atol=1e-9 * abs(apart).max())


@pytest.mark.parametrize("method", ["newmark", "exact"])
def test_sensors_read_displacement_slope_and_their_derivatives(method):
    sensors = (IMU, Sensor(name="tail", station=1.0))
    motion = response(
        beam(sensors=sensors), duration=0.5, step=5e-4, modes=5, initial=ModeShape(1, 0.01), method=method
    )
    operators = discretise(beam(sensors=sensors))
    assert motion.sensors == ("imu", "tail")
    np.testing.assert_allclose(motion.displacement, operators.shape([0.12, 1.0]) @ motion.coordinates.T)
    np.testing.assert_allclose(motion.slope, operators.shape([0.12, 1.0], 1) @ motion.coordinates.T)
    pairs = [(motion.displacement, motion.rate), (motion.rate, motion.acceleration), (motion.slope, motion.slope_rate)]
    for quantity, derivative in pairs:
        difference = np.gradient(quantity, motion.step, axis=1)[:, 1:-1]
        np.testing.assert_allclose(derivative[:, 1:-1], difference, atol=1e-3 * abs(derivative).max())
    displacement, rate = motion.trajectory("tail")
    np.testing.assert_array_equal(displacement, motion.displacement[1])
    np.testing.assert_array_equal(rate, motion.rate[1])
    with pytest.raises(ModelError, match="sensor: must be one of imu, tail, found 'nose'"):
        motion.trajectory("nose")


@pytest.mark.parametrize("thrust", [0.0, 90.0, 106.437231, 128.0])
def test_reduced_equations_have_the_lowest_roots_of_the_full_ones(thrust):
    operators = discretise(catalog.tsto(0.6, 5000.0, 5000.0))
    reduced = reduce(operators, thrust, modes=6)
    full = np.linalg.eigvals(np.linalg.solve(operators.M, operators.stiffness(thrust)))
    full = full[np.argsort(abs(full))][:8]
    assert reduced.A.shape == (8, 8)
    for values in (full, np.linalg.eigvals(reduced.A)):  # near 106.44 two of them meet: their mean is well-conditioned
        assert values[np.argsort(abs(values))][2:4].sum() == pytest.approx(reduced.mu[2:4].sum(), rel=1e-7)
        assert np.sort(abs(values))[4:] == pytest.approx(abs(reduced.mu[4:]), rel=1e-7)
    product = operators.stiffness(thrust) @ reduced.X
    np.testing.assert_allclose(operators.M @ reduced.X @ reduced.A, product, atol=1e-6)
    left_product = reduced.W.T @ operators.stiffness(thrust)
    np.testing.assert_allclose(reduced.A @ reduced.W.T @ operators.M, left_product, atol=1e-6)
    np.testing.assert_allclose(reduced.W.T @ operators.M @ reduced.X, np.eye(8), atol=1e-12)


def test_reduction_does_not_part_a_pair_of_modes():
    """P = 128 turns modes 1 and 2 into a conjugate pair: one mode asked for, both kept."""
    assert len(reduce(discretise(catalog.tsto(0.6, 5000.0, 5000.0)), 128.0, modes=1).A) == 4


def test_reduction_without_rigid_body_motion_keeps_the_elastic_roots():
    operators = discretise(beam())
    kept, dropped = reduce(operators, 90.0, 5), reduce(operators, 90.0, 5, rigid_body=False)
    assert dropped.mu == pytest.approx(kept.mu[2:], rel=1e-10)


@pytest.mark.parametrize("number", [1, 2, 5])
def test_mode_shape_has_its_amplitude_where_asked(number):
    operators = discretise(catalog.tsto(0.6, 5000.0, 5000.0))
    q, rate = ModeShape(number, -0.02).coordinates(operators)
    assert largest(operators, q) == pytest.approx(0.02, rel=1e-4)
    assert not rate.any()
    assert not q[:2].any()
    at_nose = ModeShape(number, -0.02, at="nose").coordinates(operators)[0]
    assert operators.shape(0.0)[0] @ at_nose == pytest.approx(-0.02)


def test_release_is_the_deflection_of_a_free_beam_under_a_force_that_its_inertia_balances():
    """EI y'''' = -(4 - 6 x) F/(m L): the nose pushed by F accelerates as 4 - 6 x; y is free of momentum."""
    operators = discretise(beam())
    q, _ = Release(0.01).coordinates(operators)
    x = np.linspace(0, 1, 201)
    bending = np.polynomial.Polynomial([0, 1, -2, 1])  # y'' = x - 2 x^2 + x^3, from y'''' = 6 x - 4
    y = bending.integ(2)
    line = np.polynomial.Polynomial.fit([0, 1], [0, 1], 1).convert()
    weights_x, weights = np.polynomial.legendre.leggauss(8)
    nodes = (weights_x + 1) / 2
    mean = weights @ y(nodes) / 2
    tilt = 12 * (weights * (nodes - 0.5)) @ y(nodes) / 2
    elastic = y(x) - mean - tilt * (line(x) - 0.5)
    np.testing.assert_allclose(operators.shape(x) @ q, 0.01 * elastic / elastic[0], atol=1e-12)


def test_samples_bring_back_the_shape_that_was_sampled():
    operators = discretise(beam())
    shape, _ = Release(0.01, station=0.4).coordinates(operators)
    shape = shape + np.eye(len(shape))[0] * 0.3
    x = np.linspace(0.0, 1.0, 40)
    deflection = operators.shape(x) @ shape
    q, rate = Samples(x, deflection, rate=-2 * deflection).coordinates(operators)
    np.testing.assert_allclose(operators.shape(x) @ q, deflection, atol=1e-12)
    np.testing.assert_allclose(rate, -2 * q, atol=1e-9)


@pytest.mark.parametrize(
    ("initial", "message"),
    [
        (ModeShape(0, 0.1), "mode number must lie in 1 to"),
        (ModeShape(99, 0.1), "mode number must lie in 1 to .*found 99"),
        (ModeShape(1, math.nan), "amplitude must be finite, found nan"),
        (ModeShape(1, 0.1, at="tail"), 'at must be "largest" or "nose", found \'tail\''),
        (Release(math.inf), "deflection must be finite, found inf"),
        (Release(0.1, station=1.1), "station must lie on the vehicle, 0 to 1, found 1.1"),
        (Samples([0.0, 1.0], [0.0]), "must be equally long lists"),
        (Samples([0.0, 1.0], [0.0, math.nan]), "must be finite, found NaN"),
        (Samples([0.0, 1.1], [0.0, 0.1]), "stations must lie on the vehicle, 0 to 1"),
    ],
)
def test_an_initial_motion_refuses(initial, message):
    with pytest.raises(ModelError, match=message):
        initial.coordinates(discretise(beam()))


@pytest.mark.parametrize(("initial", "message"), [(ModeShape(1, 0.1, at="nose"), "node"), (Release(0.1), "held")])
def test_a_held_nose_cannot_be_deflected(initial, message):
    with pytest.raises(ModelError, match=message):
        initial.coordinates(discretise(beam(support=Support(nose="clamped"))))


def test_a_vehicle_with_a_free_hinge_has_no_static_shape():
    stage = Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
    hinged = Vehicle(stages=[stage, stage], joints=[Joint(rotational_stiffness=0.0)], units="nondimensional")
    with pytest.raises(ModelError, match="a joint folds or slides without stiffness"):
        Release(0.1).coordinates(discretise(hinged))


def history(displacement, rate, time):
    return Response(
        time=time,
        sensors=("imu",),
        displacement=displacement[None],
        rate=rate[None],
        acceleration=0 * rate[None],
        slope=0 * rate[None],
        slope_rate=0 * rate[None],
        rigid_displacement=0 * rate[None],
        rigid_slope=0 * rate[None],
        coordinates=np.zeros((len(time), 0)),
        coordinate_rates=np.zeros((len(time), 0)),
        thrust=0.0,
        thrust_history=0 * time,
        method="exact",
        step=time[1],
        mu=np.zeros(0, dtype=complex),
    )


@pytest.mark.parametrize(("growth", "frequency"), [(0.3, 5.0), (-0.3, 5.0), (3.0, 5.0), (0.7, 0.0), (0.0, 5.0)])
@pytest.mark.parametrize("offset", [0.0, 0.5])
def test_growth_rate_is_that_of_the_exponent_whatever_the_offset(growth, frequency, offset):
    time = np.linspace(0.0, 20.0, 4001)
    root = complex(growth, frequency)
    motion = np.exp(root * time)
    offset = offset if frequency else 0.0
    found = growth_rate(history(motion.real + offset, (root * motion).real, time), "imu")
    assert found == pytest.approx(growth, abs=2e-5 * max(1.0, abs(growth)))


def test_turning_points_lie_between_coarse_samples():
    """Twelve samples to a period; parabolas through the samples and their rates would be off by 1e-3."""
    time = np.arange(0.0, 40.0, 2 * math.pi / 12.34)
    instants, peaks = turning_points(time, np.cos(time), -np.sin(time))
    np.testing.assert_allclose(instants, math.pi * np.arange(1, 13), atol=2e-2)
    np.testing.assert_allclose(abs(peaks), 1.0, atol=2e-4)


def test_growth_rate_of_two_beating_modes_is_about_zero():
    time = np.linspace(0.0, 200.0, 40001)
    motion = np.cos(2 * time) + 0.4 * np.cos(7.3 * time)
    rate = -2 * np.sin(2 * time) - 0.4 * 7.3 * np.sin(7.3 * time)
    assert abs(growth_rate(history(motion, rate, time), "imu")) < 1e-3


def test_growth_rate_needs_a_motion():
    with pytest.raises(ModelError, match="sensor 'imu': does not move in the second half"):
        growth_rate(history(np.zeros(100), np.zeros(100), np.arange(100.0)), "imu")
