"""What stays when stages leave a vehicle."""

import re

import pytest

from beal.errors import ModelError
from beal.stability.modes import converged_modes
from beal.vehicle import (
    AxialLoad,
    DistributedThrust,
    Force,
    Joint,
    PointMass,
    Sensor,
    Stage,
    Support,
    Tank,
    Thrust,
    Vehicle,
)
from beal.vehicle.separation import attached

STAGES = [
    Stage(name=name, length=x, mass_per_length=x, bending_stiffness=1.0)
    for name, x in (("a", 1.0), ("b", 2.0), ("c", 4.0))
]
SIGNAL = {"kind": "step", "amplitude": 1.0}
PLACES = (0.5, 1.0, 2.0, 3.0, 5.0, 7.0)
DOMES = {"x": [0.0, 0.5, 1.0], "value": [0.0, 1.0, 1.0]}
VEHICLE = Vehicle(
    stages=STAGES,
    joints=[Joint(rotational_stiffness=3.0), Joint(rotational_stiffness=5.0)],
    point_masses=[PointMass(station=x, mass=x) for x in PLACES],
    sensors=[Sensor(name=f"{x}", station=x) for x in PLACES],
    forces=[Force(name=f"{x}", station=x, signal=SIGNAL) for x in PLACES],
    axial_loads=[AxialLoad(name=f"{x}", station=x, force=-0.01) for x in PLACES],
    tanks=[
        Tank(name="A", forward_end=0.0, aft_end=1.0, mass_per_length=DOMES),
        Tank(name="B", forward_end=1.0, aft_end=3.0, mass_per_length=7.0),
        Tank(name="C", forward_end=4.0, aft_end=7.0, mass_per_length=9.0),
    ],
    thrust=Thrust(nominal=1.0),
    timeline={"time": [0.0], "thrust": [1.0], "stages": ["3"]},
)


def alone(*tanks, **parts):
    return Vehicle(stages=STAGES, joints=[Joint()] * 2, tanks=tanks, **parts)


def test_all_stages_attached_are_the_vehicle():
    assert attached(VEHICLE, 1, 3) is VEHICLE


@pytest.mark.parametrize(
    ("span", "names", "joints", "kept", "tanks"),
    [
        ((1, 2), "ab", [3.0], {0.5: 0.5, 1.0: 1.0, 2.0: 2.0}, {"A": (0.0, 1.0), "B": (1.0, 3.0)}),
        ((2, 3), "bc", [5.0], {1.0: 0.0, 2.0: 1.0, 3.0: 2.0, 5.0: 4.0, 7.0: 6.0}, {"B": (0.0, 2.0), "C": (3.0, 6.0)}),
        ((2, 2), "b", [], {1.0: 0.0, 2.0: 1.0}, {"B": (0.0, 2.0)}),
    ],
)
def test_stages_keep_what_sits_on_them(span, names, joints, kept, tanks):
    left = attached(VEHICLE, *span)
    assert "".join(stage.name for stage in left.stages) == names
    assert [joint.rotational_stiffness for joint in left.joints] == joints
    assert {p.mass: p.station for p in left.point_masses} == kept
    for parts in (left.sensors, left.forces, left.axial_loads):
        assert {float(part.name): part.station for part in parts} == kept
    assert {tank.name: (tank.forward_end, tank.aft_end) for tank in left.tanks} == tanks
    assert (left.thrust, left.timeline) == (Thrust(nominal=1.0), None)


def test_what_is_left_is_the_vehicle_that_one_would_describe():
    lone = Vehicle(stages=STAGES[1:2], tanks=[Tank(name="B", forward_end=0.0, aft_end=2.0, mass_per_length=7.0)])
    left = attached(VEHICLE.model_copy(update={"point_masses": (), "axial_loads": ()}), 2, 2)
    one, other = (converged_modes(vehicle, 0.0, 3)[0].angular_frequency.tolist() for vehicle in (lone, left))
    assert one == pytest.approx(other, rel=1e-12)
    assert left.mass == lone.mass == 4.0 + 14.0


@pytest.mark.parametrize(("station", "expected"), [(None, None), (2.0, 1.0), (1.0, 0.0), (3.0, None), (7.0, None)])
def test_thrust_acts_at_its_station_or_at_the_new_tail(station, expected):
    assert attached(alone(thrust=Thrust(station=station)), 2, 2).thrust.station == expected


def test_a_tank_on_both_sides_must_be_empty():
    tank = Tank(name="fuel", forward_end=0.5, aft_end=2.0, mass_per_length=1.0)
    with pytest.raises(ModelError, match=re.escape("tank[0]: 'fuel' holds propellant on both sides of a separation")):
        attached(alone(tank), 2, 3)
    assert attached(alone(tank.model_copy(update={"fill": 0.0})), 2, 3).tanks == ()
    assert attached(alone(tank), 3, 3).tanks == ()


def test_a_tank_that_ends_at_a_separation_up_to_rounding_is_on_one_side():
    tank = Tank(name="fuel", forward_end=1.0 - 1e-13, aft_end=3.0 + 1e-13, mass_per_length=1.0)
    assert attached(alone(tank), 2, 2).tanks[0].forward_end == 0.0
    assert attached(alone(tank), 1, 1).tanks == ()


@pytest.mark.parametrize(
    ("vehicle", "span", "message"),
    [
        (VEHICLE, (1, 4), "stages: must lie on the vehicle, stages 1-3, found 1-4"),
        (VEHICLE, (0, 2), "found 0-2"),
        (VEHICLE, (3, 2), "found 3-2"),
        (alone(support=Support(nose="clamped")), (1, 2), "support: stages leave only a vehicle whose ends are free"),
        (alone(distributed_thrusts=[DistributedThrust(value=1.0)]), (1, 2), "distributed_thrust: what of it stays"),
    ],
)
def test_what_cannot_be_meant_is_refused(vehicle, span, message):
    with pytest.raises(ModelError, match=re.escape(message)):
        attached(vehicle, *span)
