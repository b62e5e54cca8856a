"""Inverse design: which values of a quantity keep the critical thrust at a target."""

import math

import pytest
from scipy.optimize import brentq

from beal import ModelError, allowed_range, critical_thrust
from beal.vehicle import catalog
from beal.vehicle.paths import with_values

ROTATION = "joint[0].rotational_stiffness"


def thrust(vehicle, **values):
    return critical_thrust(with_values(vehicle, values), tolerance=1e-8, method="complete").critical_thrust


def test_every_interval_of_the_joints_place_is_found_and_no_more():
    vehicle = catalog.tsto(0.6, 30.0, 500.0)
    found = allowed_range(vehicle, "stage.split", 0.1, 0.9, target=90.0, points=17)
    first, second = found.intervals
    assert (first.low_edge, first.high_edge, second.low_edge) == ("end", "crossing", "crossing")
    for guess in (first.high, second.low, second.high):
        root = brentq(lambda x: thrust(vehicle, **{"stage.split": x}) - 90.0, guess - 1e-3, guess + 1e-3, xtol=1e-8)
        assert guess == pytest.approx(root, abs=1e-7)


def test_a_cliff_is_told_from_a_crossing():
    vehicle = catalog.tsto(0.6, 10.0, 1e4)
    found = allowed_range(vehicle, ROTATION, 1.0, 100.0, target=90.0, spacing="log", points=9)
    (interval,) = found.intervals
    assert (interval.low_edge, interval.low_kind) == ("jump", "divergence")
    assert found.sufficient == interval.low
    below, above = (thrust(vehicle, **{ROTATION: interval.low * (1 + share)}) for share in (-1e-7, 1e-7))
    assert below < 82 < 101 < above


def test_a_stiffer_joint_may_be_worse():
    vehicle = catalog.tsto(0.6, 10.0, 1e4)
    found = allowed_range(vehicle, ROTATION, 0.0, math.inf, target=109.8, points=21, formulation="as-printed", modes=8)
    assert [interval.high_edge for interval in found.intervals] == ["crossing"]
    assert found.sufficient is None
    assert found.intervals[0].high == pytest.approx(4256.496, rel=1e-6)


def test_a_rigid_joint_ends_the_range_of_a_spring():
    found = allowed_range(catalog.tsto(0.6, 10.0, 1e4), ROTATION, 0.0, math.inf, target=70.0, points=11)
    assert found.intervals[-1].high == math.inf
    assert found.intervals[-1].high_edge == "end"


def test_a_target_out_of_reach_comes_with_the_best_there_is():
    found = allowed_range(catalog.tsto(0.6, 10.0, 1e4), ROTATION, 0.0, math.inf, target=150.0, points=11)
    assert found.intervals == ()
    assert found.sufficient is None
    assert found.best_value == math.inf
    assert found.best_thrust == pytest.approx(108.0325016541, rel=1e-9)


def test_a_factor_on_the_nominal_thrust_is_a_target():
    vehicle = with_values(catalog.tsto(0.6, 10.0, 1e4), {"thrust.nominal": 50.0})
    assert allowed_range(vehicle, ROTATION, 1.0, 2.0, factor=1.5, points=2).target == 75.0


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"low": 2.0, "high": 1.0, "target": 90.0}, "contradictory bounds: from 2 to 1"),
        ({"low": -math.inf, "high": 1.0, "target": 90.0}, "lower end must be finite"),
        ({"low": 0.0, "high": 1.0, "target": 90.0, "spacing": "log"}, "log spacing needs positive ends"),
        ({"low": 1.0, "high": 2.0, "target": 90.0, "spacing": "cubic"}, "must be linear or log, found 'cubic'"),
        ({"low": 1.0, "high": 2.0}, "give either a target thrust or a factor"),
        ({"low": 1.0, "high": 2.0, "target": 90.0, "factor": 1.5}, "give either a target thrust or a factor"),
        ({"low": 1.0, "high": 2.0, "factor": 1.5}, r"needs the vehicle's nominal thrust"),
        ({"low": 1.0, "high": 2.0, "target": -1.0}, "must be a positive thrust, found -1"),
        ({"low": 1.0, "high": 2.0, "target": 90.0, "points": 1}, "must be 2 or more, found 1"),
    ],
)
def test_what_cannot_be_asked_is_refused(asked, message):
    with pytest.raises(ModelError, match=message):
        allowed_range(catalog.tsto(0.6, 10.0, 1e4), ROTATION, **asked)


def test_an_unknown_quantity_and_an_endless_length_are_refused():
    vehicle = catalog.tsto(0.6, 10.0, 1e4)
    with pytest.raises(ModelError, match="is not a quantity of this vehicle"):
        allowed_range(vehicle, "joint[0].rotation", 1.0, 2.0, target=90.0)
    with pytest.raises(ModelError, match="may be infinite for the springs of joints only"):
        allowed_range(vehicle, "stage[0].length", 1.0, math.inf, target=90.0)
