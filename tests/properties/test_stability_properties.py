"""Laws that critical thrusts and frequencies obey whatever the vehicle."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beal.discretisation.build import discretise
from beal.stability.critical import CriticalThrust, critical_events, critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle.parts import Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicle

FEW = settings(max_examples=12, deadline=None, derandomize=True)
SEEDS = st.integers(0, 10**6)
SHARES = st.floats(0.1, 0.9)
FACTORS = st.floats(-6, 6).map(lambda exponent: 10.0**exponent)


def drawn(seed: int, **options: float) -> Vehicle:
    return random_vehicle(np.random.default_rng(seed), absent=0.0, **options)


def loads(vehicle: Vehicle) -> CriticalThrust:
    """The critical thrust, of a vehicle that tumbles that of its elastic modes."""
    found = critical_thrust(vehicle)
    return found.elastic or found


def roots(vehicle: Vehicle, thrust: float, count: int = 3) -> np.ndarray:
    return spectrum(discretise(vehicle, order=16), thrust, count).W


def assert_same(one: CriticalThrust, other: CriticalThrust, thrust: float = 1.0, omega: float = 1.0) -> None:
    assert (one.kind, one.modes, one.rigid_body) == (other.kind, other.modes, other.rigid_body)
    assert other.critical_thrust == pytest.approx(thrust * one.critical_thrust, rel=1e-9)
    # a double root is good to the square root of the thrust's precision, and less where it lies near zero
    assert other.angular_frequency == pytest.approx(omega * one.angular_frequency, rel=1e-6)


@FEW
@given(SEEDS, SHARES)
def test_rigid_joint_inside_a_stage_changes_nothing(seed, share):
    whole = drawn(seed)
    first, *rest = whole.stages
    halves = [first.model_copy(update={"length": first.length * part}) for part in (share, 1 - share)]
    split = whole.model_copy(update={"stages": (*halves, *rest), "joints": (Joint(), *whole.joints)})
    assert_same(loads(whole), loads(split))


@FEW
@given(SEEDS, FACTORS, FACTORS, FACTORS)
def test_units_do_not_matter(seed, length, mass, stiffness):
    plain = drawn(seed)
    scaled = plain.model_copy(
        update={
            "stages": [
                Stage(
                    length=s.length * length,
                    mass_per_length=s.mass_per_length * mass,
                    bending_stiffness=s.bending_stiffness * stiffness,
                )
                for s in plain.stages
            ],
            "joints": [
                j.model_copy(
                    update={
                        "rotational_stiffness": j.rotational_stiffness * stiffness / length,
                        "shear_stiffness": j.shear_stiffness * stiffness / length**3,
                    }
                )
                for j in plain.joints
            ],
            "point_masses": [
                PointMass(
                    station=p.station * length,
                    mass=p.mass * mass * length,
                    rotary_inertia=p.rotary_inertia * mass * length**3,
                )
                for p in plain.point_masses
            ],
        }
    )
    omega = math.sqrt(stiffness / mass) / length**2
    assert_same(loads(plain), loads(scaled), stiffness / length**2, omega)


@FEW
@given(SEEDS)
def test_doubled_masses_leave_the_load_and_halve_the_squared_frequencies(seed):
    light = drawn(seed)
    heavy = light.model_copy(
        update={
            "stages": [s.model_copy(update={"mass_per_length": 2 * s.mass_per_length}) for s in light.stages],
            "point_masses": [
                p.model_copy(update={"mass": 2 * p.mass, "rotary_inertia": 2 * p.rotary_inertia})
                for p in light.point_masses
            ],
        }
    )
    found = loads(light)
    assert_same(found, loads(heavy), 1.0, 0.5**0.5)
    half = found.critical_thrust / 2
    np.testing.assert_allclose(2 * roots(heavy, half), roots(light, half), rtol=1e-7)


@FEW
@given(SEEDS)
def test_reversed_vehicle_vibrates_and_buckles_alike_under_a_dead_load(seed):
    forward = drawn(seed, held=1.0)
    support, axes = Support(nose="clamped", tail="pinned"), {"forward": "aft", "aft": "forward"}
    forward = forward.model_copy(update={"support": support, "thrust": Thrust(tangency=0.0)})
    backward = forward.model_copy(
        update={
            "stages": forward.stages[::-1],
            "joints": [
                j.model_copy(update={"shear_axis": axes.get(j.shear_axis, j.shear_axis)}) for j in forward.joints[::-1]
            ],
            "point_masses": [
                p.model_copy(update={"station": max(forward.length - p.station, 0.0)}) for p in forward.point_masses
            ],
            "support": Support(nose="pinned", tail="clamped"),
        }
    )
    np.testing.assert_allclose(roots(backward, 0.0), roots(forward, 0.0), rtol=1e-8)
    assert_same(loads(forward), loads(backward))


@FEW
@given(SEEDS)
def test_unloaded_vehicle_vibrates_freely(seed):
    operators = discretise(drawn(seed), order=12)
    np.testing.assert_allclose(operators.M, operators.M.T, atol=1e-12 * np.abs(operators.M).max())
    np.testing.assert_allclose(operators.K0, operators.K0.T, atol=1e-12 * np.abs(operators.K0).max())
    modes = spectrum(operators, 0.0, 5)
    assert np.all(modes.W.real > 0)
    assert np.abs(modes.growth_rate).max() < 1e-9 * modes.angular_frequency.max()
    energy = np.einsum("ij,ik,kj->j", modes.shapes.conj(), operators.K0, modes.shapes)
    np.testing.assert_allclose(energy, modes.W, rtol=1e-9)  # Rayleigh's quotient


@FEW
@given(SEEDS)
def test_joint_of_1e12_is_rigid(seed):
    vehicle = drawn(seed)
    stiff, rigid = (
        vehicle.model_copy(
            update={
                "joints": [
                    Joint(rotational_stiffness=k, shear_stiffness=k, shear_axis=j.shear_axis) for j in vehicle.joints
                ]
            }
        )
        for k in (1e12, math.inf)
    )
    assert_same(loads(stiff), loads(rigid))


@FEW
@given(st.floats(0.0, 0.99))
def test_free_vehicle_with_less_than_full_tangency_tumbles(tangency):
    stage = Stage(length=1, mass_per_length=1, bending_stiffness=1)
    found = critical_thrust(Vehicle(stages=[stage], thrust=Thrust(tangency=tangency)))
    assert (found.critical_thrust, found.kind, found.modes) == (0.0, "divergence", (0, 0))
    assert found.rigid_body == "tumbling"
    assert found.elastic is not None
    assert found.elastic.critical_thrust > 0


@pytest.mark.parametrize("method", ["fast", "complete"])
def test_modes_that_cross_without_coupling_do_not_flutter(method):
    # Symmetric and antisymmetric modes of a symmetric column do not couple under a dead load. A soft joint in the
    # middle makes the antisymmetric mode the lower one at first, but the symmetric one is the first to buckle.
    half = Stage(length=0.5, mass_per_length=1, bending_stiffness=1)
    column = Vehicle(
        stages=[half, half],
        joints=[Joint(shear_stiffness=6.0)],
        support=Support(nose="pinned", tail="pinned"),
        thrust=Thrust(tangency=0.0),
    )
    operators = discretise(column, order=14)
    found = critical_thrust(column, method=method)
    low, high = (
        (operators.shape([0.2, 0.8]) @ spectrum(operators, thrust, 2).shapes.real).prod(axis=0) > 0
        for thrust in (0.0, 0.9 * found.critical_thrust)
    )
    assert found.kind == "divergence"
    assert (low.tolist(), high.tolist()) == ([False, True], [True, False])  # symmetric or not: they did cross
    assert [event.kind for event in critical_events(column, 1.01 * found.critical_thrust)] == ["divergence"]
