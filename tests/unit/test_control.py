"""Control laws in the model file, the closed loop and the state space: contracts and messages."""

import builtins

import numpy as np
import pytest

from beal import (
    Control,
    Force,
    Gain,
    ModelError,
    Operators,
    Sensor,
    catalog,
    closed_loop,
    discretise,
    dumps,
    loads,
    state_space,
)
from beal.control.compensator import compensator
from beal.vehicle.control import Filter
from beal.vehicle.paths import value_at
from beal.vehicle.separation import attached

MODEL = """
[[stage]]
length = 10.0
mass_per_length = 200.0
bending_stiffness = "2 MN*m^2"

[thrust]
nominal = "40 kN"

[[sensor]]
name = "imu"
station = 3.0

[control]
lag = "20 ms"
gains = [
    {sensor = "imu", quantity = "slope", gain = "0.5 rad/rad"},
    {sensor = "imu", quantity = "slope_rate", gain = "100 ms"},
]
filters = [{numerator = [1.0, 0.0, 900.0], denominator = [1.0, 30.0, 900.0]}]
"""


@pytest.fixture
def vehicle():
    return loads(MODEL)


def test_a_law_is_read_with_units_and_written_back(vehicle):
    assert vehicle.control.lag == pytest.approx(0.02)
    assert [gain.gain for gain in vehicle.control.gains] == pytest.approx([0.5, 0.1])
    assert loads(dumps(vehicle)) == vehicle


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'sensor = "imu", quantity = "slope_rate"',
            'sensor = "gyro", quantity = "slope_rate"',
            r"control.gains\[1\].sensor: must be a sensor of this vehicle \(imu\), found 'gyro'",
        ),
        ('lag = "20 ms"', "lag = -0.1", "control.lag: must be greater than or equal to 0, found -0.1"),
        ('lag = "20 ms"', "delay = -1.0", "control.delay: must be"),
        ('lag = "20 ms"', "station = 12.0", "control.station: must lie on the vehicle, 0 to 10, found 12"),
        ('"100 ms"', '"100 m"', r"control.gains\[1\].gain: .*100 m"),
        ('"slope_rate"', '"heading"', r"control.gains\[1\].quantity: must be"),
        ("[1.0, 30.0, 900.0]", "[1.0, -30.0, 900.0]", r"control.filters\[0\]: is unstable: .*found 15"),
        ("[1.0, 30.0, 900.0]", "[30.0, 0.0]", r"control.filters\[0\]: is improper: .*found 2 over 1"),
        (
            "[1.0, 30.0, 900.0]",
            "[1.0, 0.0, 0.0]",
            r"is unstable: every pole, but one at 0, must have a negative real part, found 0",
        ),
        ("[1.0, 30.0, 900.0]", "[0.0, 30.0, 900.0]", "must begin with a coefficient other than 0"),
        ("[1.0, 30.0, 900.0]", "[nan]", "finite"),
        ("lag", "leg", "control.leg: unknown key; known here: station, lag"),
    ],
)
def test_what_is_wrong_with_a_law_is_told(old, new, message):
    with pytest.raises(ModelError, match=message):
        loads(MODEL.replace(old, new, 1))


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("engine = {mass = 100, arm = 1, inertia = 120}", "control: engine: .*relative degree 1"),
        (
            "engine = {mass = 100, arm = 2, inertia = 120}",
            r"control.engine: inertia about the gimbal must be at least mass arm\^2, 400, found 120",
        ),
        ("actuator = {angular_frequency = 0, damping_ratio = 0.7}", "control.actuator.angular_frequency: must be"),
        ('engine = {mass = "3 m", arm = 1, inertia = 3}', "control.engine.mass: "),
    ],
)
def test_what_is_wrong_with_an_engine_is_told(key, message):
    with pytest.raises(ModelError, match=message):
        loads(MODEL + key)


def test_an_engine_and_its_actuator_are_read_with_units_and_written_back():
    keys = 'actuator = {angular_frequency = "5 Hz", damping_ratio = 0.7}\n'
    keys += 'engine = {mass = "120 kg", arm = "40 cm", inertia = "25 kg*m^2"}'
    found = loads(MODEL + keys)
    assert found.control.actuator.angular_frequency == pytest.approx(31.4159265)
    assert found.control.engine.moment == pytest.approx(48.0)
    assert loads(dumps(found)) == found
    assert value_at(found, "control.engine.arm") == pytest.approx(0.4)


def test_an_integrator_needs_something_to_integrate():
    steady = Filter(numerator=[1.0, 0.1], denominator=[1.0, 0.0])
    with pytest.raises(ModelError, match="an integrator after rates alone"):
        Control(gains=[Gain(sensor="imu", quantity="slope_rate", gain=1.0)], filters=[steady])
    washout = Filter(numerator=[1.0, 0.0], denominator=[1.0, 2.0])
    with pytest.raises(ModelError, match="one has a zero at 0"):
        Control(gains=[Gain(sensor="imu", quantity="slope", gain=1.0)], filters=[steady, washout])


def test_an_acceleration_that_its_own_force_changes_at_once_is_an_algebraic_loop():
    heard = [Gain(sensor="imu", quantity="acceleration", gain=0.1)]
    biproper, strict = (
        Filter(numerator=[1.0, 1.0], denominator=[1.0, 2.0]),
        Filter(numerator=[1.0], denominator=[1.0, 2.0]),
    )
    with pytest.raises(ModelError, match="algebraic loop"):
        Control(gains=heard, filters=[biproper], delay=0.1)
    with pytest.raises(ModelError, match=r"gains: .*at least 1"):
        Control(gains=[])
    assert Control(gains=heard, filters=[strict]).filters
    assert Control(gains=heard, lag=0.1).lag


def test_the_realisation_has_the_transfer_function_written():
    law = Control(
        lag=0.05,
        delay=0.1,
        delay_order=3,
        gains=[Gain(sensor="imu", quantity="slope", gain=1.0)],
        filters=[
            Filter(numerator=[2.0, 0.3, 50.0], denominator=[4.0, 3.0, 90.0]),
            Filter(numerator=[0.0, 7.0], denominator=[2.0]),
        ],
    )
    found, s = compensator(law), 1.3j
    value = (found.C @ np.linalg.solve(s * np.eye(len(found.A)) - found.A, found.B)).item() + found.D
    expected = (2 * s**2 + 0.3 * s + 50) / (4 * s**2 + 3 * s + 90) * 3.5 / (1 + 0.05 * s) * np.exp(-0.1 * s)
    assert value == pytest.approx(expected, rel=1e-9)  # the delay's approximant errs by (0.13)^7


def test_a_vehicle_without_a_law_or_a_thrust_is_refused(vehicle):
    with pytest.raises(ModelError, match="control: the vehicle has no control law"):
        closed_loop(catalog.beal(), 10.0)
    with pytest.raises(ModelError, match="thrust: give one"):
        closed_loop(vehicle.model_copy(update={"thrust": vehicle.thrust.model_copy(update={"nominal": None})}))
    with pytest.raises(ModelError, match=r"thrust: must be finite and not negative, found -1"):
        closed_loop(vehicle, -1.0)
    with pytest.raises(ModelError, match="modes: must be at least 1"):
        closed_loop(vehicle, modes=0)


def test_stages_that_part_lose_the_law():
    two = catalog.tsto(0.6, 10.0, 100.0).model_copy(
        update={
            "sensors": (Sensor(name="imu", station=0.9),),
            "control": Control(gains=[Gain(sensor="imu", quantity="slope", gain=1.0)]),
        }
    )
    assert attached(two, 1, 1).control is None


def test_drift_is_told_apart_from_instability(vehicle):
    rate_only = vehicle.control.model_copy(update={"gains": vehicle.control.gains[1:], "filters": ()})
    found = closed_loop(vehicle.model_copy(update={"control": rate_only}), modes=2)
    assert found.drift == 3  # translation twice, and the attitude, which only its rate resists
    assert not found.rigid_body_roots.any()
    acceleration = Control(lag=0.01, gains=[Gain(sensor="imu", quantity="acceleration", gain=1e-6)])
    assert closed_loop(vehicle.model_copy(update={"control": acceleration}), modes=2).drift == 2


def test_the_thrust_turns_where_the_law_says(vehicle):
    aft = closed_loop(vehicle, modes=2).roots
    moved = vehicle.control.model_copy(update={"station": 10.0})
    np.testing.assert_allclose(
        closed_loop(vehicle.model_copy(update={"control": moved}), modes=2).roots, aft, rtol=1e-10, atol=1e-12
    )
    forward = vehicle.control.model_copy(update={"station": 0.0})  # where turning it back turns the vehicle away
    assert not closed_loop(vehicle.model_copy(update={"control": forward}), modes=2).stable


def test_roots_do_not_depend_on_the_discretisation(vehicle):
    coarse = closed_loop(discretise(vehicle, basis="hermite", order=40), modes=2)
    fine = closed_loop(vehicle, modes=2)
    np.testing.assert_allclose(coarse.roots, fine.roots, atol=1e-5 * np.abs(fine.roots).max())
    assert np.isnan(coarse.error_estimate).all()
    assert fine.error_estimate.max() < 1e-7 * np.abs(fine.roots).max()


@pytest.mark.parametrize("damping", [0.0, 1e-4])
def test_a_state_space_answers_as_the_whole_vehicle_does(vehicle, damping):
    stage = vehicle.stages[0].model_copy(update={"internal_damping": damping})
    model = vehicle.model_copy(
        update={
            "stages": (stage,),
            "forces": (Force(name="gust", station=1.0, signal={"kind": "step", "amplitude": 1.0}),),
        }
    )
    outputs = [f"imu.{quantity}" for quantity in ("displacement", "rate", "acceleration", "slope", "slope_rate")]
    operators: Operators = discretise(model, order=24)
    found = state_space(operators, 4e4, ["delta", "gust", 7.0], outputs, modes=8)
    omega = 20.0
    loads_ = np.column_stack((-4e4 * operators.shape(10.0)[0], operators.shape(1.0)[0], operators.shape(7.0)[0]))
    C = 0.0 if operators.C is None else operators.C
    q = np.linalg.solve(operators.stiffness(4e4) - omega**2 * operators.M + 1j * omega * C, loads_)
    y, slope = operators.shape(3.0)[0] @ q, operators.shape(3.0, 1)[0] @ q
    expected = np.array([y, 1j * omega * y, -(omega**2) * y, slope, 1j * omega * slope])
    error = np.abs(found.frequency_response(omega) - expected) / np.abs(expected)
    assert error[[0, 3]].max() < 1e-5  # with the residual flexibility
    assert error.max() < 0.02
    assert (found.input_units, found.output_units) == (("rad", "N", "N"), ("m", "m/s", "m/s^2", "rad", "rad/s"))


def test_the_state_space_goes_to_python_control(vehicle):
    control = pytest.importorskip("control")
    found = state_space(vehicle, outputs=["imu.slope"], modes=3)
    system = found.to_control()
    assert (system.input_labels, system.output_labels) == (["delta"], ["imu_slope"])
    assert control.evalfr(system, 5j) == pytest.approx(found.frequency_response(5.0).item())


def test_without_python_control_it_is_said_what_to_install(vehicle, monkeypatch):
    found, real = state_space(vehicle), builtins.__import__

    def without(name, *rest):
        if name == "control":
            raise ModuleNotFoundError("no control", name="control")
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ModelError, match=r"install beal\[control\]"):
        found.to_control()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"inputs": ["gimbal"]}, "inputs: must be one of delta, or a station, found 'gimbal'"),
        ({"inputs": [11.0]}, "inputs: a station must lie on the vehicle, 0 to 10, found 11"),
        ({"inputs": []}, "inputs: give at least one"),
        ({"outputs": ["imu"]}, "outputs: expected SENSOR.QUANTITY, of the sensors imu and of displacement"),
        ({"outputs": ["gyro.slope"]}, "found 'gyro.slope'"),
        ({"modes": 0}, "modes: must be at least 1"),
    ],
)
def test_what_is_wrong_with_a_state_space_is_told(vehicle, options, message):
    with pytest.raises(ModelError, match=message):
        state_space(vehicle, **options)
