"""Beal's missile with directional control: exact values, and the differential equation itself."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from beal import Actuator, Control, Engine, Filter, Gain, Sensor, catalog, closed_loop
from beal.control.compensator import pade


def missile(gain, station, vehicle=None, more=(), **law):
    gains = [Gain(sensor="imu", quantity="slope", gain=gain), *more]
    update = {"sensors": (Sensor(name="imu", station=station),), "control": Control(gains=gains, **law)}
    return (vehicle or catalog.beal()).model_copy(update=update)


@pytest.mark.parametrize(
    ("thrust", "gain", "station", "frequencies"),
    [
        (10.0, 1.0, 0.5, [6.29797267869, 21.2865122364, 58.0224996778]),
        (10.0, 1.0, 0.0, [7.67405461072, 16.5428955273, 62.1868953124]),
        (5.0, 0.1, 0.75, [1.56369915269, 21.8532298763, 60.7750116946]),
    ],
)
def test_frequencies_of_attitude_and_bending(thrust, gain, station, frequencies):
    found = closed_loop(missile(gain, station), thrust, modes=2)
    assert found.stable
    assert found.drift == 2
    np.testing.assert_allclose(found.roots.imag[found.roots.imag > 0], frequencies, rtol=2e-11)


def test_a_rigid_vehicle_swings_at_the_root_of_six_times_thrust_and_gain():
    found = closed_loop(missile(1e-4, 0.5), 1.0, modes=1)
    assert found.roots.imag.max() > 20
    assert np.abs(found.roots[3].imag) == pytest.approx(np.sqrt(6e-4), rel=0.02)  # bending moves it little


def test_a_negative_gain_turns_the_vehicle_away():
    assert not closed_loop(missile(-0.5, 0.5), 0.01).stable


HEAVY = Engine(mass=0.1, arm=0.2, inertia=0.006)
LAWS = [
    {"lag": 0.02},
    {"lag": 0.05, "more": [Gain(sensor="imu", quantity="slope_rate", gain=0.2)]},
    {"lag": 0.03, "more": [Gain(sensor="imu", quantity="acceleration", gain=0.02)]},
    {"more": [Gain(sensor="imu", quantity="rate", gain=0.02), Gain(sensor="imu", quantity="displacement", gain=0.3)]},
    {"delay": 0.02, "delay_order": 3, "filters": [Filter(numerator=[1.0, 0.0, 400.0], denominator=[1.0, 20.0, 400.0])]},
    {
        "filters": [
            Filter(numerator=[0.1, 1.0], denominator=[0.01, 1.0]),
            Filter(numerator=[3.0], denominator=[0.5, 3.0]),
        ]
    },
    {"filters": [Filter(numerator=[1.0, 0.4], denominator=[1.0, 0.0])], "lag": 0.02},
    {"filters": [Filter(numerator=[0.3], denominator=[2.0, 0.0])]},
    {"actuator": Actuator(angular_frequency=30.0, damping_ratio=0.6), "delay": 0.01},
    {"actuator": Actuator(angular_frequency=40.0, damping_ratio=0.5), "engine": HEAVY},
    {
        "actuator": Actuator(angular_frequency=50.0, damping_ratio=0.8),
        "engine": HEAVY,
        "more": [Gain(sensor="imu", quantity=name, gain=0.03) for name in ("slope_rate", "acceleration")],
    },
]


@pytest.mark.parametrize("law", LAWS)
def test_every_root_solves_the_differential_equation(law):
    """Newton's step from each root towards that of the boundary value problem, integrated from the nose, is nothing."""
    vehicle, thrust = missile(0.7, 0.35, **law), 12.0
    found = closed_loop(vehicle, thrust, modes=3)
    for s in found.roots[found.drift :]:
        step = 1e-5 * abs(s)
        here, ahead = (unbalanced(vehicle, thrust, z) for z in (s, s + step))
        assert abs(here * step / (ahead - here)) < 1e-7 * max(abs(s), 1.0)


def unbalanced(vehicle, thrust, s):
    """Determinant of what bends and pushes the tail, of the two solutions that are free at the nose."""
    control, station = vehicle.control, vehicle.sensors[0].station
    transfer = np.prod([np.polyval(part.numerator, s) / np.polyval(part.denominator, s) for part in control.filters])
    transfer /= 1 + control.lag * s
    push, turn = thrust, 0.0  # force against y, and couple against y', for an angle of 1
    if control.actuator:
        relative = s / control.actuator.angular_frequency
        transfer /= 1 + 2 * control.actuator.damping_ratio * relative + relative**2
    if engine := control.engine:
        push += engine.mass * engine.arm * s**2
        turn += engine.inertia * s**2 + engine.mass * engine.arm * thrust  # of the unit mass
    if control.delay:
        numerator, denominator = pade(control.delay, control.delay_order)
        transfer *= np.polyval(numerator, s) / np.polyval(denominator, s)

    def field(x, y):  # y'''' + (P x y')' + s^2 y = 0
        return np.array([y[1], y[2], y[3], -thrust * (x * y[2] + y[1]) - s**2 * y[0]])

    rows = []
    for start in ([1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]):
        options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}
        forward = solve_ivp(field, (0.0, station), np.array(start, dtype=complex), **options).y[:, -1]
        end = solve_ivp(field, (station, 1.0), forward, **options).y[:, -1]
        reads = {"displacement": (0, 0), "rate": (0, 1), "acceleration": (0, 2), "slope": (1, 0), "slope_rate": (1, 1)}
        e = sum(part.gain * forward[reads[part.quantity][0]] * s ** reads[part.quantity][1] for part in control.gains)
        rows.append([end[2] + turn * transfer * e, end[3] - push * transfer * e])
    return np.linalg.det(np.array(rows))
