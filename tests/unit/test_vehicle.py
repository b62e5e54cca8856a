"""What a vehicle refuses, what it derives, and the catalog."""

import json
import math
import re

import numpy as np
import pytest

from beal.errors import ModelError
from beal.units import to_si
from beal.vehicle import Force, Joint, PointMass, Sensor, Sine, Stage, Support, Table, Thrust, Vehicle, catalog
from beal.vehicle.summary import summary

BEAM = Stage(length=2.0, mass_per_length=3.0, bending_stiffness=5.0)
SLUG = Stage(length=1.0, mass_per_length=6.0, bending_stiffness=7.0)


def rocket(**parts):
    return Vehicle(stages=[BEAM, SLUG], joints=[Joint()], **parts)


def refused(*lines):
    """The error whose lines hold these texts, in order."""
    return pytest.raises(ModelError, match="(?s)" + ".*\n".join(re.escape(line) for line in lines))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": 0.0}, "length: must be greater than 0, found 0.0"),
        ({"length": math.inf}, "length: must be a finite number, found inf"),
        ({"length": math.nan}, "length: must be a number, found nan"),
        ({"length": True}, "length: must be a number, found a boolean"),
        ({"length": 10**400}, "length: must be a valid number"),
        ({"length": "3 kg"}, "length: expected a number, or a number with a unit that converts to m, found '3 kg'"),
        ({"mass": 1.0}, "mass: unknown key; known here: name, length, mass_per_length, bending_stiffness"),
    ],
)
def test_a_stage_refuses(change, message):
    with refused(message):
        Stage(**{"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": 1.0} | change)


def test_all_problems_are_reported_at_once_each_with_its_path():
    good = {"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": 1.0}
    with refused(
        "stage[1].length: must be greater than 0, found -1",
        "joint[0].rotational_stiffness: must be greater than or equal to 0, found -2",
        "support.nose: must be 'free', 'clamped', 'pinned' or 'sliding', found 'glued'",
        "thrust.tangency: must be less than or equal to 2, found 3",
        "joint: must be one fewer than the stages, 1 (an empty [[joint]] is rigid), found 2",
    ) as caught:
        Vehicle(
            stage=[good, good | {"length": -1}],
            joint=[{"rotational_stiffness": -2}, {}],
            support={"nose": "glued"},
            thrust={"tangency": 3},
        )
    assert [path for path, _ in caught.value.problems] == [
        "stage[1].length",
        "joint[0].rotational_stiffness",
        "support.nose",
        "thrust.tangency",
        "joint",
    ]


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"point_masses": [PointMass(station=3.1, mass=1)]}, "point_mass[0].station: must lie on the vehicle, 0 to 3"),
        ({"sensors": [Sensor(name="a", station=4)]}, "sensor[0].station: must lie on the vehicle, 0 to 3, found 4"),
        (
            {"forces": [{"station": np.int64(5), "signal": {"kind": "step", "amplitude": 1}}]},
            "force[0].station: must lie on the vehicle",
        ),
        ({"sensors": [Sensor(name="a", station=1)] * 2}, "sensor[1].name: must be unique, found 'a' again"),
        ({"stages": []}, "stage: a vehicle needs at least one stage, found none"),
        ({"stages": 3}, "stage: must be a list (of tables: [[name]], not [name]), found 3"),
        ({"thrust": 3}, "thrust: must be a table, found 3"),
        (
            {"forces": [{"station": 1, "signal": {"kind": "saw"}}]},
            "force[0].signal: kind must be one of 'sine', 'step'",
        ),
        ({"forces": [{"station": 1, "signal": {}}]}, "force[0].signal: kind is required and missing, found {}"),
        (
            {"forces": [{"station": 1, "signal": {"kind": "step"}}]},
            "force[0].signal.amplitude: is required and missing",
        ),
    ],
)
def test_a_vehicle_refuses(parts, message):
    with refused(message):
        Vehicle(**{"stages": [BEAM, SLUG], "joints": [Joint()]} | parts)


def test_stations_with_units_are_checked_against_the_length_even_beside_another_problem():
    stage = {"length": "10 ft", "mass_per_length": 1.0, "bending_stiffness": 1.0}
    mass = {"station": "11 ft", "mass": 1.0}
    with refused("point_mass[0].station: must lie on the vehicle, 0 to 3.048, found 3.3528"):
        Vehicle(stage=[stage], point_mass=[mass])
    with refused("title: must be", "point_mass[0].station: must lie on the vehicle"):
        Vehicle(stage=[stage], point_mass=[mass], title=3)


def test_a_station_at_the_tail_lies_on_the_vehicle_despite_rounding():
    stages = [Stage(length=x, mass_per_length=1.0, bending_stiffness=1.0) for x in (0.7, 0.1)]
    vehicle = Vehicle(stages=stages, joints=[Joint()], sensors=[Sensor(name="tail", station=0.8)])
    assert vehicle.length < vehicle.sensors[0].station


@pytest.mark.parametrize("length", [1e-170, 1e170])
def test_a_size_beyond_the_range_of_numbers_is_refused(length):
    with refused("stage: lengths, masses and stiffnesses leave the range of numbers"):
        Vehicle(stages=[Stage(length=length, mass_per_length=1.0, bending_stiffness=1.0)])


@pytest.mark.parametrize(
    ("time", "value", "message"),
    [
        ([0, 1, 1], [0, 0, 0], "time must increase from entry to entry"),
        ([0, 1], [0, 0, 0], "time and value must be equally long, found 2 and 3"),
    ],
)
def test_a_tabulated_signal_refuses(time, value, message):
    with refused(message):
        Table(kind="table", time=time, value=value)


def test_parts_are_frozen():
    with pytest.raises(ValueError, match="frozen"):
        BEAM.length = 3.0


def test_a_copy_is_checked_and_forgets_what_was_derived():
    vehicle = rocket()
    assert vehicle.length == 3.0
    assert vehicle.model_copy(update={"stages": [SLUG, SLUG]}).length == 2.0
    with refused("joint: must be one fewer than the stages"):
        vehicle.model_copy(update={"stages": [SLUG]})


def test_mass_properties_of_two_stages_and_a_point_mass_agree_with_hand_calculation():
    vehicle = rocket(point_masses=[PointMass(station=0.0, mass=3.0, rotary_inertia=0.5)])
    assert vehicle.mass == 6 + 6 + 3
    assert vehicle.centre_of_mass == pytest.approx((6 * 1 + 6 * 2.5) / 15, rel=1e-15)
    about_centre = 6 * (4 / 12 + 0.4**2) + 6 * (1 / 12 + 1.1**2) + 0.5 + 3 * 1.4**2
    assert vehicle.moment_of_inertia == pytest.approx(about_centre, rel=1e-14)


def test_the_axial_force_follows_the_support_unless_given():
    assert rocket().axial_force == "inertia"
    assert rocket(support=Support(nose="clamped")).axial_force == "constant"
    assert rocket(thrust=Thrust(axial_force="constant")).axial_force == "constant"


def test_a_station_on_a_joint_belongs_to_the_stage_aft_of_it():
    vehicle = rocket()
    assert [vehicle.stage_at(x) for x in (0.0, 1.999, 2.0, 3.0)] == [0, 0, 1, 1]


def test_the_summary_gives_nondimensional_groups_and_is_plain_json():
    vehicle = Vehicle(
        stages=[BEAM, SLUG],
        joints=[Joint(rotational_stiffness=10.0)],
        thrust=Thrust(nominal=5.0),
        forces=[Force(station=1.0, signal=Sine(kind="sine", amplitude=1.0, angular_frequency=2.0))],
    )
    resolved = json.loads(json.dumps(summary(vehicle), allow_nan=False))
    groups = resolved["nondimensional"]
    assert groups["joints"] == [{"rotational_stiffness": pytest.approx(6.0), "shear_stiffness": "rigid"}]
    assert groups["nominal_thrust"] == pytest.approx(9.0)
    assert groups["thrust_scale"] == pytest.approx(5 / 9)
    assert groups["time_scale"] == pytest.approx(math.sqrt(3 * 81 / 5))
    assert resolved["joints"][0] == {
        "name": "",
        "station": 2.0,
        "shear_axis": "mean",
        "rotational_stiffness": 10.0,
        "shear_stiffness": "rigid",
        "rotational_damping": 0.0,
        "shear_damping": 0.0,
    }
    assert [(stage["from"], stage["to"], stage["mass"]) for stage in resolved["stages"]] == [(0, 2, 6), (2, 3, 6)]


def test_the_shear_stiffness_is_made_nondimensional_with_the_cube_of_the_length():
    vehicle = Vehicle(stages=[BEAM, SLUG], joints=[Joint(shear_stiffness=10.0)])
    assert summary(vehicle)["nondimensional"]["joints"][0]["shear_stiffness"] == pytest.approx(10 * 27 / 5)


@pytest.mark.parametrize("vehicle", [catalog.beck(), catalog.beal(), catalog.pflueger(0.5), catalog.tsto(0.3, 1, 2)])
def test_the_catalog_is_nondimensional_with_unit_scales(vehicle):
    scales = vehicle.scales
    assert vehicle.units == "nondimensional"
    assert (scales.length, scales.mass_per_length, scales.bending_stiffness) == (1.0, 1.0, 1.0)


def test_catalog_vehicles_are_held_and_loaded_as_published():
    assert catalog.beck().support == catalog.pflueger(1.0).support == Support(nose="clamped")
    assert catalog.beal().free_free
    assert catalog.pflueger(0.3).point_masses == (PointMass(station=1.0, mass=0.3),)
    two_stage = catalog.tsto(0.6, 10, 20, shear_axis="inertial")
    assert two_stage.joints == (Joint(rotational_stiffness=10, shear_stiffness=20, shear_axis="inertial"),)
    assert two_stage.sensors == (Sensor(name="imu", station=0.12),)


@pytest.mark.parametrize("split", [0.0, 1.0, -0.1, math.nan])
def test_a_split_off_the_vehicle_is_refused(split):
    with refused("split: must lie between 0 and 1"):
        catalog.tsto(split, 1.0, 1.0)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("12 ft", "m", 3.6576),
        ("1e3mm", "m", 1.0),
        ("2 lbf*in^2", "N*m^2", 2 * 4.4482216152605 * 0.0254**2),
        ("5 (lbf in)/(rad)", "N*m/rad", 5 * 4.4482216152605 * 0.0254),
        ("3 lb/ft", "kg/m", 3 * 0.45359237 / 0.3048),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("1 Hz", "rad/s", 2 * math.pi),
        ("2 kHz", "rad/s", 4e3 * math.pi),
        ("90 deg", "rad", math.pi / 2),
        ("inf", "N/m", math.inf),
        ("0.5", "", 0.5),
    ],
)
def test_a_unit_is_converted(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["", "12", "1,5 m", "m", "5±1 m", "5 m;", "9**9**9**9 m", "9⁹⁹⁹⁹ m", "nan m", "5 kg", "5 fot", "((" * 999]
)
def test_text_that_is_not_one_length_is_refused(text):
    with pytest.raises(ValueError, match="expected a number, or a number with a unit that converts to m, found"):
        to_si(text, "m")
