"""What a small change would newly bring about: the change told against vehicles on both sides of the cliff."""

import pytest

import beal
from beal import catalog
from beal.vehicle.paths import value_at, with_values
from verification.test_optimal_becks_columns import AREAS, NEAR, columns

SPRING = "joint[0].rotational_stiffness"


def after(vehicle, path, change):
    moved = with_values(vehicle, {path: (1 + change) * value_at(vehicle, path)})
    return beal.critical_thrust(moved, tolerance=1e-7)


def test_a_divergence_that_a_softer_joint_brings_about_is_told():
    vehicle = catalog.tsto(0.6, 11.1, 1e4)
    found = beal.sensitivity(vehicle, [SPRING, "joint[0].shear_stiffness"])
    (touch,) = found.touches
    assert (found.status, touch.kind, touch.modes) == ("near a cliff", "divergence", (1, 1))
    assert touch.nearest == touch.changes[0] < 0
    assert after(vehicle, SPRING, 0.97 * touch.nearest).kind == "flutter"
    beyond = after(vehicle, SPRING, 1.03 * touch.nearest)
    assert beyond.kind == "divergence"
    assert beyond.critical_thrust == pytest.approx(touch.thrust, rel=1e-2)


def test_a_flutter_of_modes_that_nearly_touch_is_told():
    space = columns(2)
    vehicle = space.at(space.shares(dict(zip(AREAS, NEAR[2], strict=True))))
    found = beal.sensitivity(vehicle, AREAS[:1])
    touch = min(found.touches, key=lambda each: abs(each.nearest))
    assert (touch.kind, touch.modes) == ("flutter", (2, 3))
    assert found.critical.critical_thrust > 86.0
    assert after(vehicle, AREAS[0], 0.8 * touch.nearest).critical_thrust > 86.0
    assert after(vehicle, AREAS[0], 1.2 * touch.nearest).critical_thrust == pytest.approx(touch.thrust, rel=1e-2)


@pytest.mark.parametrize("vehicle", [catalog.beck(), catalog.tsto(0.6, 20.0, 1e4)], ids=["column", "joint"])
def test_a_vehicle_far_from_cliffs_is_smooth(vehicle):
    found = beal.sensitivity(vehicle, ["stage[0].mass_per_length"])
    assert (found.status, found.touches) == ("smooth", ())
