"""All critical thrusts of a vehicle, in order."""

import math

import pytest

import beal


def test_dead_loads_buckle_one_mode_after_the_other():
    column = beal.Vehicle(
        stages=[beal.Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)],
        support=beal.Support(nose="pinned", tail="pinned"),
        thrust=beal.Thrust(tangency=0.0),
    )
    found = beal.critical_events(column, max_thrust=100.0)
    assert [(event.kind, event.modes, event.unstable) for event in found] == [
        ("divergence", (1, 1), 1),
        ("divergence", (2, 2), 2),
        ("divergence", (3, 3), 3),
    ]
    assert [event.thrust for event in found] == pytest.approx([(n * math.pi) ** 2 for n in (1, 2, 3)], rel=1e-9)


def test_sub_tangential_thrust_diverges_recovers_and_flutters():
    # Beck's column with tangency 0.4: Kounadis' window between divergence and flutter.
    column = beal.catalog.beck().model_copy(update={"thrust": beal.Thrust(tangency=0.4)})
    found = beal.critical_events(column, max_thrust=20.0)
    assert [(event.kind, event.change) for event in found] == [
        ("divergence", "destabilises"),
        ("divergence", "restabilises"),
        ("flutter", "destabilises"),
    ]
    assert [event.thrust for event in found] == pytest.approx([5.29241059646, 15.8615912, 16.4038640268], rel=1e-8)
