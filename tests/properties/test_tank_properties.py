"""A tank is mass along the stages, however it is described."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beal.discretisation.axial import axial_force
from beal.stability.critical import critical_thrust
from beal.stability.modes import converged_modes
from beal.vehicle.parts import Joint, Stage
from beal.vehicle.tanks import Tank
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicle

FEW = settings(max_examples=8, deadline=None, derandomize=True)
SEEDS = st.integers(0, 10**6)


def tanked(seed: int) -> Vehicle:
    """A vehicle of uniform stages with one or two tanks, which may overlap."""
    rng = np.random.default_rng(seed)
    vehicle = random_vehicle(rng, softest=1.0, absent=0.0)
    tanks = []
    for n in range(rng.integers(1, 3)):
        forward = rng.uniform(0.0, 0.7)
        aft = rng.uniform(forward + 0.1, 1.0)
        mass = 10 ** rng.uniform(-0.5, 1.0)
        tanks.append(Tank(name=f"{n}", forward_end=forward, aft_end=aft, mass_per_length=mass, fill=rng.uniform(0, 1)))
    return vehicle.model_copy(update={"tanks": tanks})


def cut(vehicle: Vehicle) -> Vehicle:
    """The same vehicle without tanks: uniform stages rigidly joined where a tank's surface or end lies."""
    stages: list[Stage] = []
    joints: list[Joint] = []
    surfaces = [x for tank in vehicle.tanks for x in (tank.surface, tank.aft_end)]
    for n, stage in enumerate(vehicle.stages):
        front, back = vehicle.boundaries[n : n + 2]
        inner = sorted(x for x in surfaces if front + 1e-9 < x < back - 1e-9)
        for a, b in zip([front, *inner], [*inner, back], strict=True):
            inside = [t.mass_per_length for t in vehicle.tanks if t.surface < (a + b) / 2 < t.aft_end]
            mass = stage.mass_per_length + sum(inside)
            stages.append(stage.model_copy(update={"length": b - a, "mass_per_length": mass}))
            joints.append(Joint())
        joints[-1:] = vehicle.joints[n : n + 1]
    return vehicle.model_copy(update={"stages": stages, "joints": joints, "tanks": ()})


def assert_same(one: Vehicle, other: Vehicle) -> None:
    for name in ("mass", "centre_of_mass", "moment_of_inertia"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-12)
    x = np.linspace(0.0, 1.0, 51)
    np.testing.assert_allclose(axial_force(one, x), axial_force(other, x), rtol=1e-9, atol=1e-12)
    frequencies = [converged_modes(vehicle, 0.0, 4)[0].angular_frequency for vehicle in (one, other)]
    np.testing.assert_allclose(*frequencies, rtol=1e-8)
    found, expected = (result.elastic or result for result in map(critical_thrust, (one, other)))
    assert (found.kind, found.modes) == (expected.kind, expected.modes)
    assert found.critical_thrust == pytest.approx(expected.critical_thrust, rel=1e-8)


@FEW
@given(SEEDS)
def test_a_filled_tank_is_a_vehicle_of_more_stages(seed):
    vehicle = tanked(seed)
    assert_same(vehicle, cut(vehicle))


@FEW
@given(SEEDS)
def test_an_empty_tank_changes_nothing(seed):
    vehicle = tanked(seed)
    empty = vehicle.model_copy(update={"tanks": [t.model_copy(update={"fill": 0.0}) for t in vehicle.tanks]})
    dry = vehicle.model_copy(update={"tanks": ()})
    assert empty.mass == dry.mass
    assert critical_thrust(empty) == critical_thrust(dry)


@FEW
@given(SEEDS, st.floats(0.1, 0.9))
def test_two_tanks_one_behind_the_other_are_one(seed, share):
    whole = tanked(seed)
    first, *rest = whole.tanks
    middle = first.surface + share * (first.aft_end - first.surface)
    halves = [
        first.model_copy(update={"forward_end": first.surface, "aft_end": middle, "fill": 1.0}),
        first.model_copy(update={"name": "aft", "forward_end": middle, "fill": 1.0}),
    ]
    split = whole.model_copy(update={"tanks": [*rest, *halves]})
    assert_same(whole, split)
