"""An engine that turns about its gimbal, against the same engine as a stage of its own on a hinge."""

import math

import numpy as np
import pytest

from beal import Actuator, Control, Engine, Gain, Joint, Sensor, Stage, Vehicle, closed_loop, discretise, state_space

MASS, LENGTH, THRUST = 40.0, 1.2, 30e3  # of the engine, a uniform rod that hangs from the tail of a rocket


def rocket(hinge):
    """A tapering rocket, the gimbal at 10 m as a joint that is rigid or a hinge."""
    body = {"mass_per_length": {"x": [0.0, 10.0], "value": [60.0, 90.0]}, "bending_stiffness": 4e5}
    engine = Engine(mass=MASS, arm=LENGTH / 2, inertia=MASS * LENGTH**2 / 3)
    servo = Actuator(angular_frequency=40.0, damping_ratio=0.7)
    gains = [Gain(sensor="imu", quantity="slope", gain=0.5)]
    return Vehicle(
        stages=[
            Stage(length=10.0, **body),
            Stage(length=LENGTH, mass_per_length=MASS / LENGTH, bending_stiffness=math.inf),
        ],
        joints=[Joint(rotational_stiffness=hinge)],
        sensors=[Sensor(name="imu", station=3.0), Sensor(name="tail", station=9.0)],
        control=Control(station=10.0, actuator=servo, engine=engine, gains=gains),
    )


@pytest.mark.parametrize("hinge", [1e3, 1e6])
@pytest.mark.parametrize("omega", [2.0, 17.0, 60.0, 140.0])
def test_the_angle_of_the_engine_does_what_a_couple_in_its_hinge_does(hinge, omega):
    # A couple between engine and rocket turns the engine by delta; what moves then per delta is the same.
    hung = discretise(rocket(hinge), order=16)
    turned = (hung.shape(10.0 + LENGTH, 1) - hung.shape(10.0, 1, side="forward"))[0]
    q = np.linalg.solve(hung.stiffness(THRUST) - omega**2 * hung.M, turned)
    by_couple = hung.shape([3.0, 9.0]) @ q / (turned @ q)
    inputs, outputs = ["delta", "delta_acceleration"], ["imu.displacement", "tail.displacement"]
    plant = state_space(discretise(rocket(math.inf), order=16), THRUST, inputs, outputs, modes=14)
    response = plant.frequency_response(omega)
    np.testing.assert_allclose(response @ [1.0, -(omega**2)], by_couple, rtol=2e-6)


def test_an_engine_without_mass_changes_nothing():
    vehicle = rocket(math.inf)
    light = vehicle.control.model_copy(update={"engine": Engine(mass=0.0, arm=1.0, inertia=0.0)})
    none = vehicle.control.model_copy(update={"engine": None})
    found = [closed_loop(vehicle.model_copy(update={"control": law}), THRUST, modes=4).roots for law in (light, none)]
    np.testing.assert_array_equal(*found)
