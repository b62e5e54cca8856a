"""Laws of damped vehicles, whatever the vehicle."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.vehicle.parts import Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_joint, random_stages, random_vehicle

FEW = settings(max_examples=8, deadline=None, derandomize=True)
SEEDS = st.integers(0, 10**6)


def dragged(stages: list[Stage], drag: float) -> list[Stage]:
    """A drag in proportion to the mass."""
    return [stage.model_copy(update={"external_damping": drag * stage.mass_per_length}) for stage in stages]


def damped(seed: int) -> Vehicle:
    """A cantilever with losses in its stages and joints."""
    rng = np.random.default_rng(seed)
    stages = [s.model_copy(update={"internal_damping": 10 ** rng.uniform(-4, -2)}) for s in random_stages(rng)]
    joints = [random_joint(rng, 1.0, 1e4, absent=0.0) for _ in stages[1:]]
    joints = [joint.model_copy(update={"rotational_damping": 10 ** rng.uniform(-3, -1)}) for joint in joints]
    return Vehicle(stages=stages, joints=joints, support=Support(nose="clamped"))


@FEW
@given(SEEDS, st.floats(0.01, 2.0), st.floats(0.0, 15.0))
def test_roots_under_a_drag_in_proportion_to_the_mass_follow_from_the_undamped_ones(seed, drag, thrust):
    """s^2 + c s + W = 0."""
    plain = random_vehicle(np.random.default_rng(seed), absent=0.0).model_copy(
        update={"point_masses": (), "thrust": Thrust()}
    )
    vehicle = plain.model_copy(update={"stages": tuple(dragged(plain.stages, drag))})
    s = spectrum(discretise(vehicle), thrust, 4).s
    W = spectrum(discretise(plain), thrust, 8).W
    for root in s[s.imag > 0]:
        assert np.abs(root**2 + drag * root + W).min() < 1e-7 * abs(root) ** 2


@FEW
@given(SEEDS, st.floats(0.01, 2.0))
def test_a_vanishing_drag_in_proportion_to_the_mass_changes_nothing(seed, drag):
    rng = np.random.default_rng(seed)
    stages = random_stages(rng)
    joints = [random_joint(rng, 1.0, 1e6, absent=0.0) for _ in stages[1:]]
    plain = Vehicle(stages=stages, joints=joints, support=Support(nose="clamped"))
    vehicle = plain.model_copy(update={"stages": tuple(dragged(stages, drag))})
    undamped = critical_thrust(plain)
    assert vanishing_damping_limit(vehicle) == undamped
    assert critical_thrust(vehicle).critical_thrust >= undamped.critical_thrust * (1 - 1e-9)


@FEW
@given(SEEDS)
def test_the_limit_of_vanishing_damping_is_that_of_the_damped_loads(seed):
    vehicle = damped(seed)
    limit = vanishing_damping_limit(vehicle).critical_thrust
    assert limit <= critical_thrust(vehicle.undamped).critical_thrust * (1 + 1e-9)
    little = [
        vehicle.model_copy(
            update={
                "stages": tuple(
                    stage.model_copy(update={"internal_damping": share * stage.internal_damping})
                    for stage in vehicle.stages
                ),
                "joints": tuple(
                    joint.model_copy(update={"rotational_damping": share * joint.rotational_damping})
                    for joint in vehicle.joints
                ),
            }
        )
        for share in (1e-2, 1e-4)
    ]
    far, near = (abs(critical_thrust(part).critical_thrust / limit - 1) for part in little)
    assert near < max(1e-3 * far, 1e-8)  # the distance falls with the square of the damping


@FEW
@given(SEEDS, st.floats(-4, 4), st.floats(-4, 4), st.floats(-4, 4))
def test_units_do_not_matter(seed, length, mass, stiffness):
    length, mass, stiffness = (10.0**exponent for exponent in (length, mass, stiffness))
    time = (mass * length**4 / stiffness) ** 0.5
    plain = damped(seed)
    scaled = plain.model_copy(
        update={
            "stages": tuple(
                stage.model_copy(
                    update={
                        "length": length * stage.length,
                        "mass_per_length": mass * stage.mass_per_length,
                        "bending_stiffness": stiffness * stage.bending_stiffness,
                        "internal_damping": time * stage.internal_damping,
                    }
                )
                for stage in plain.stages
            ),
            "joints": tuple(
                joint.model_copy(
                    update={
                        "rotational_stiffness": stiffness / length * joint.rotational_stiffness,
                        "shear_stiffness": stiffness / length**3 * joint.shear_stiffness,
                        "rotational_damping": time * stiffness / length * joint.rotational_damping,
                    }
                )
                for joint in plain.joints
            ),
        }
    )
    one, other = critical_thrust(plain), critical_thrust(scaled)
    assert (one.kind, one.modes) == (other.kind, other.modes)
    assert other.critical_thrust == pytest.approx(stiffness / length**2 * one.critical_thrust, rel=1e-8)
    assert other.angular_frequency == pytest.approx(one.angular_frequency / time, rel=1e-7, abs=1e-7 / time)
