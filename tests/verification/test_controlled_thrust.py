"""The largest thrust of controlled missiles: exact values, and the first crossing that a fine sweep sees."""

import numpy as np
import pytest

from beal import Control, Filter, Gain, Sensor, catalog, closed_loop, controlled_thrust
from beal.vehicle.catalog import beal_timoshenko, park_mote

ZERO_FREQUENCY = 25.638181376802  # (9/4) j_{2/3,1}^2, whatever the gain and the sensor's place
FIRST = {  # gain, station: kind, thrust, digits behind the point that the reference has
    (0.01, 0.0): ("divergence", ZERO_FREQUENCY, 11),
    (0.1, 0.3): ("divergence", ZERO_FREQUENCY, 11),
    (0.5, 1.0): ("divergence", ZERO_FREQUENCY, 11),
    (1.0, 0.2): ("divergence", ZERO_FREQUENCY, 11),
    (1.0, 0.7): ("divergence", ZERO_FREQUENCY, 11),
    (1.0, 0.0): ("flutter", 16.9360037339, 10),
    (1.5, 0.0): ("flutter", 9.011239939, 9),
    (1.5, 0.25): ("flutter", 10.389241494, 9),
    (2.0, 0.0): ("flutter", 6.445255526, 9),
    (2.0, 0.25): ("flutter", 7.301036261, 9),
    (2.0, 0.5): ("divergence", ZERO_FREQUENCY, 11),
    (5.0, 0.0): ("flutter", 2.429479271, 9),
    (5.0, 0.25): ("flutter", 2.712472392, 9),
    (5.0, 0.5): ("flutter", 16.115860273, 9),
    (5.0, 0.75): ("divergence", ZERO_FREQUENCY, 11),
    (10.0, 0.0): ("flutter", 1.196260696, 9),
    (10.0, 0.25): ("flutter", 1.331832668, 9),
    (10.0, 0.5): ("flutter", 8.02998981, 8),
    (10.0, 0.75): ("flutter", 12.904128121, 9),
    (10.0, 1.0): ("divergence", ZERO_FREQUENCY, 11),
}
CONCENTRATED = {  # mass ratio: zero-frequency loads for the mass at these stations
    0.1: [21.73011222, 24.51713681, 26.65932821, 26.98272758, 27.45089442, 28.20199951],
    0.2: [19.35706599, 23.67083446, 27.58672073, 28.3064418, 29.18463356, 30.76581765],
    0.5: [15.80959816, 22.04024162, 29.86867883, 32.18536193, 33.99943589, 38.45727207],
    1.0: [13.54774694, 20.6631185, 32.42550293, 38.43021607, 41.11026999, 51.27636275],
    2.0: [11.9678417799, 19.48101844, 35.07716424, 50.2813252, 53.45988158, 76.9145441304],
}
STATIONS = (0.0, 0.25, 0.5, 0.75, 0.9, 1.0)
SHEARING = {
    ("engesser", 1000.0): 25.264568041,
    ("engesser", 500.0): 24.899826372,
    ("engesser", 250.0): 24.195808831,
    ("engesser", 150.0): 23.306788215,
    ("haringx", 1000.0): 25.271390256,
    ("haringx", 500.0): 24.925658136,
    ("haringx", 250.0): 24.288921956,
    ("haringx", 150.0): 23.534185479,
}


def held(vehicle, gain, station, rate=0.0, **law):
    gains = [Gain(sensor="imu", quantity=name, gain=k) for name, k in (("slope", gain), ("slope_rate", rate)) if k]
    return vehicle.model_copy(
        update={"sensors": (Sensor(name="imu", station=station),), "control": Control(gains=gains, **law)}
    )


@pytest.mark.parametrize(("gain", "station"), FIRST)
def test_the_first_instability_of_beals_controlled_missile(gain, station):
    kind, thrust, digits = FIRST[gain, station]
    found = controlled_thrust(held(catalog.beal(), gain, station))
    assert found.kind == kind
    assert found.critical_thrust == pytest.approx(thrust, abs=0.6 * 10.0**-digits + found.error_estimate)
    assert found.error_estimate < 1e-6 * thrust


def test_the_frequency_at_which_attitude_and_bending_meet():
    assert controlled_thrust(held(catalog.beal(), 1.0, 0.0)).angular_frequency == pytest.approx(
        10.8520860739, rel=1e-10
    )


def test_a_law_that_turns_the_vehicle_away_bears_nothing():
    assert controlled_thrust(held(catalog.beal(), -0.5, 0.5)).critical_thrust == 0.0


@pytest.mark.parametrize("ratio", CONCENTRATED)
def test_the_zero_frequency_load_with_a_concentrated_mass(ratio):
    for station, thrust in zip(STATIONS, CONCENTRATED[ratio], strict=True):
        found = controlled_thrust(held(park_mote(ratio, station), 0.01, 0.4))
        assert found.kind == "divergence"
        assert found.critical_thrust == pytest.approx(thrust, abs=1e-8)


@pytest.mark.parametrize(("term", "stiffness"), SHEARING)
@pytest.mark.parametrize("inertia", [0.0, 6.25e-4])
def test_the_zero_frequency_load_where_the_missile_shears(term, stiffness, inertia):
    found = controlled_thrust(held(beal_timoshenko(stiffness, inertia, term), 0.1, 0.3))
    assert found.critical_thrust == pytest.approx(SHEARING[term, stiffness], abs=1e-9)


@pytest.mark.parametrize(
    ("term", "thrust", "omega"),
    [("engesser", 16.362363959, 10.662011266), ("haringx", 16.377470807, 10.663241309)],
)
def test_attitude_and_bending_meet_where_the_missile_shears(term, thrust, omega):
    found = controlled_thrust(held(along_the_section(beal_timoshenko(500.0, 6.25e-4, term)), 1.0, 0.0))
    assert found.critical_thrust == pytest.approx(thrust, abs=1e-9)
    assert found.angular_frequency == pytest.approx(omega, rel=1e-9)


def test_along_the_axis_the_shear_strain_of_the_control_force_takes_from_the_gain():
    """The strain at the tail is -P delta/kGA, V = -P (psi + delta (1 - P/kGA)): no flutter at gain 1."""
    missile, thrust = beal_timoshenko(500.0, 6.25e-4, "engesser"), 17.5
    axis = closed_loop(held(missile, 1.0, 0.0), thrust, modes=2)
    section = closed_loop(held(along_the_section(missile), 1.0 - thrust / 500.0, 0.0), thrust, modes=2)
    np.testing.assert_allclose(axis.roots, section.roots, rtol=1e-9)
    assert axis.stable


def along_the_section(vehicle):
    return vehicle.model_copy(update={"thrust": vehicle.thrust.model_copy(update={"along": "section"})})


LOW_PASS = Filter(numerator=[1.0], denominator=[0.05, 1.0])


@pytest.mark.parametrize(
    ("gain", "rate", "station", "law"),
    [
        (0.6, 0.15, 0.6, {"lag": 0.02, "filters": [LOW_PASS]}),
        (0.6, 0.15, 0.5, {"lag": 0.02, "filters": [LOW_PASS]}),  # divergence, where lags do not matter
        (0.3, 0.15, 0.7, {"lag": 0.02, "delay": 0.05}),
        (0.0, 0.1, 0.5, {}),
    ],
)
def test_the_first_crossing_is_that_of_a_fine_sweep(gain, rate, station, law):
    vehicle = held(catalog.beal(internal_damping=5e-4), gain, station, rate, **law)
    found = controlled_thrust(vehicle, max_thrust=60.0)
    swept = [closed_loop(vehicle, share * found.critical_thrust).stable for share in (*np.linspace(0.1, 0.99, 9), 1.01)]
    assert swept == [True] * 9 + [False]
    roots = closed_loop(vehicle, found.critical_thrust).roots
    assert np.abs(roots - 1j * found.angular_frequency).min() < 1e-7 * max(found.angular_frequency, 1.0)


def test_a_law_that_feeds_an_undamped_mode_bears_nothing():
    found = controlled_thrust(held(catalog.beal(), 0.3, 0.7, lag=0.02))
    assert (found.critical_thrust, found.kind) == (0.0, "flutter")
    assert not closed_loop(held(catalog.beal(), 0.3, 0.7, lag=0.02), 0.1).stable
