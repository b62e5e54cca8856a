"""Gain and phase margins put a root on the axis, and agree with python-control's."""

import numpy as np
import pytest

from beal import (
    Actuator,
    Control,
    Engine,
    Filter,
    Gain,
    ModelError,
    Sensor,
    catalog,
    closed_loop,
    stability_margins,
    state_space,
)
from beal.control.compensator import compensator

THRUST = 8.0
LOW_PASS = Filter(numerator=[1.0], denominator=[0.05, 1.0])


def missile(factor=1.0, delay=0.0, damping=5e-4, station=0.6, lag=0.02, rate=0.15):
    gains = [Gain(sensor="imu", quantity="slope", gain=0.6 * factor)]
    gains += [Gain(sensor="imu", quantity="slope_rate", gain=rate * factor)] if rate else []
    law = Control(lag=lag, gains=gains, filters=[LOW_PASS] if lag else [], delay=delay, delay_order=6)
    update = {"sensors": (Sensor(name="imu", station=station),), "control": law}
    return catalog.beal(internal_damping=damping).model_copy(update=update)


@pytest.mark.parametrize("station", [0.3, 0.6, 0.8])
def test_every_margin_puts_a_root_on_the_axis(station):
    found = stability_margins(missile(station=station), THRUST, modes=3)
    assert found.phase
    for margin in found.gain:
        roots = closed_loop(missile(margin.factor, station=station), THRUST, modes=8).roots
        assert np.abs(roots - 1j * margin.angular_frequency).min() < 1e-5 * margin.angular_frequency
    for margin in found.phase:
        if margin.delay * margin.angular_frequency < 3.0:  # where the delay's approximant is as good
            roots = closed_loop(missile(delay=margin.delay, station=station), THRUST, modes=8).roots
            assert np.abs(roots - 1j * margin.angular_frequency).min() < 1e-5 * margin.angular_frequency


def test_an_undamped_mode_is_no_gain_margin():
    gains = [
        Gain(sensor="imu", quantity="slope", gain=0.6),
        Gain(sensor="imu", quantity="slope_rate", gain=0.15),
    ]
    update = {"sensors": (Sensor(name="imu", station=0.6),), "control": Control(gains=gains, lag=0.02)}
    missile = catalog.beal().model_copy(update=update)
    assert stability_margins(missile, 8.0, modes=2).gain == ()  # where Im L changes its sign L has a pole


def test_margins_with_an_integrator_an_accelerometer_and_an_engine_put_a_root_on_the_axis():
    def heavy(factor=1.0, delay=0.0):
        gains = {"slope": 0.6, "slope_rate": 0.2, "acceleration": 0.01}
        law = Control(
            gains=[Gain(sensor="imu", quantity=name, gain=factor * gain) for name, gain in gains.items()],
            filters=[Filter(numerator=[1.0, 0.2], denominator=[1.0, 0.0])],
            actuator=Actuator(angular_frequency=40.0, damping_ratio=0.7),
            engine=Engine(mass=0.05, arm=0.1, inertia=6e-4),
            delay=delay,
            delay_order=6,
        )
        return missile().model_copy(update={"control": law})

    found = stability_margins(heavy(), THRUST, modes=3)
    assert len(found.gain) > 1
    assert len(found.phase) > 3
    cases = [(heavy(margin.factor), margin.angular_frequency) for margin in found.gain]
    cases += [
        (heavy(delay=margin.delay), margin.angular_frequency)
        for margin in found.phase
        if margin.delay * margin.angular_frequency < 3.0
    ]
    for vehicle, omega in cases:
        roots = closed_loop(vehicle, THRUST, modes=8).roots
        assert np.abs(roots - 1j * omega).min() < 1e-5 * omega


def test_the_loop_is_where_the_margins_say_by_python_control():
    control = pytest.importorskip("control")
    plant = state_space(missile(), THRUST, outputs=["imu.slope", "imu.slope_rate"], modes=16).to_control()
    law = compensator(missile().control)
    loop = control.ss(law.A, law.B, -law.C, -law.D) * control.ss([], [], [], [[0.6, 0.15]]) * plant
    found = stability_margins(missile(), THRUST, modes=3)
    for gain in found.gain:
        assert control.evalfr(loop, 1j * gain.angular_frequency) == pytest.approx(-1 / gain.factor, rel=1e-3)
    for phase in found.phase:
        lagging = -np.exp(1j * np.radians(phase.degrees))
        assert control.evalfr(loop, 1j * phase.angular_frequency) == pytest.approx(lagging, rel=1e-3)


def test_margins_name_the_mode_that_they_belong_to():
    found = stability_margins(missile(), THRUST, modes=2)
    assert [margin.mode for margin in found.phase] == [0, 1, 1, 2, 2]
    assert found.smallest_gain.decibel == pytest.approx(20 * np.log10(found.smallest_gain.factor))


def test_a_loop_without_damping_and_delay_has_no_phase():
    found = stability_margins(missile(damping=0.0, lag=0.0, rate=0.0), THRUST)
    assert (found.gain, found.phase, found.smallest_gain, found.smallest_phase) == ((), (), None, None)


def test_what_is_wrong_is_told():
    with pytest.raises(ModelError, match="no control law"):
        stability_margins(catalog.beal(), 1.0)
    with pytest.raises(ModelError, match="modes: must be at least 1"):
        stability_margins(missile(), 1.0, modes=0)
