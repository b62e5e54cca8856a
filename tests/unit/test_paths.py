"""Reading and replacing quantities by their path."""

import math
import re

import numpy as np
import pytest

from beal.errors import ModelError
from beal.vehicle import Force, Joint, PointMass, Sensor, Stage, Vehicle, catalog, value_at, with_values
from beal.vehicle.paths import paths

TWO_STAGES = catalog.tsto(0.6, 10.0, 20.0)
THREE_STAGES = Vehicle(
    stages=[Stage(length=x, mass_per_length=1.0, bending_stiffness=1.0) for x in (1.0, 2.0, 5.0)],
    joints=[Joint(), Joint(rotational_stiffness=3.0)],
    point_masses=[PointMass(station=2.5, mass=4.0)],
    sensors=[Sensor(name="imu", station=0.5)],
    forces=[Force(station=3.0, signal={"kind": "sine", "amplitude": 6.0, "angular_frequency": 7.0})],
)


def refused(message):
    return pytest.raises(ModelError, match=re.escape(message))


def test_every_listed_path_reads_its_value():
    expected = {f"stage[{n}].{name}": 1.0 for n in range(3) for name in ("mass_per_length", "bending_stiffness")}
    for name, value in (
        ("foundation_stiffness", 0.0),
        ("rotary_inertia_per_length", 0.0),
        ("shear_stiffness", math.inf),
    ):
        expected |= {f"stage[{n}].{name}": value for n in range(3)}
    expected |= {f"stage[{n}].length": length for n, length in enumerate((1.0, 2.0, 5.0))}
    expected |= {"joint[0].rotational_stiffness": math.inf, "joint[0].shear_stiffness": math.inf}
    expected |= {"joint[1].rotational_stiffness": 3.0, "joint[1].shear_stiffness": math.inf}
    expected |= {f"stage[{n}].{name}_damping": 0.0 for n in range(3) for name in ("internal", "external")}
    expected |= {f"joint[{n}].{name}_damping": 0.0 for n in range(2) for name in ("rotational", "shear")}
    expected |= {"point_mass[0].station": 2.5, "point_mass[0].mass": 4.0, "point_mass[0].rotary_inertia": 0.0}
    expected |= {
        "thrust.tangency": 1.0,
        "thrust.scale": 1.0,
        "gravity": 0.0,
        "sensor[0].station": 0.5,
        "force[0].station": 3.0,
    }
    expected |= {"force[0].signal.amplitude": 6.0, "force[0].signal.angular_frequency": 7.0}
    expected |= {"force[0].signal.phase": 0.0, "stage.split": 0.125}
    listed = paths(THREE_STAGES)
    assert {path: value_at(THREE_STAGES, path) for path in listed} == expected
    assert len(listed) == len(expected)


@pytest.mark.parametrize("path", paths(THREE_STAGES))
def test_a_replaced_value_is_read_back_and_nothing_else_changes(path):
    value = 0.25 if path == "stage.split" else 1.5
    moved = {"stage.split": {"stage[0].length", "stage[1].length"}}.get(path, {"stage.split"})
    changed = with_values(THREE_STAGES, {path: value})
    assert value_at(changed, path) == value
    others = set(paths(THREE_STAGES)) - {path} - moved
    assert {other: value_at(changed, other) for other in others} == {o: value_at(THREE_STAGES, o) for o in others}


def test_replacing_nothing_or_the_same_values_gives_an_equal_vehicle():
    assert with_values(THREE_STAGES, {}) == THREE_STAGES
    same = {path: value_at(THREE_STAGES, path) for path in paths(THREE_STAGES) if path != "stage.split"}
    assert with_values(THREE_STAGES, same) == THREE_STAGES


def test_parts_that_do_not_change_are_shared():
    changed = with_values(THREE_STAGES, {"joint[1].shear_stiffness": 2.0})
    assert changed.stages[0] is THREE_STAGES.stages[0]
    assert changed.joints[0] is THREE_STAGES.joints[0]
    assert changed.joints[1] == Joint(rotational_stiffness=3.0, shear_stiffness=2.0)
    assert THREE_STAGES.joints[1].shear_stiffness == math.inf


def test_the_split_moves_the_first_joint_and_nothing_else():
    changed = with_values(THREE_STAGES, {"stage.split": 0.25})
    assert changed.boundaries == (0.0, 2.0, 3.0, 8.0)
    assert (changed.point_masses, changed.sensors, changed.forces) == (
        THREE_STAGES.point_masses,
        THREE_STAGES.sensors,
        THREE_STAGES.forces,
    )


def test_the_split_counts_from_the_lengths_given_beside_it():
    changed = with_values(THREE_STAGES, {"stage.split": 0.25, "stage[2].length": 1.0, "joint[0].shear_stiffness": 9.0})
    assert changed.boundaries == (0.0, 1.0, 3.0, 4.0)
    assert changed.joints[0].shear_stiffness == 9.0


def test_numbers_of_numpy_and_text_with_units_are_accepted():
    assert with_values(TWO_STAGES, {"stage.split": np.float32(0.5)}).boundaries == (0.0, 0.5, 1.0)
    assert value_at(with_values(THREE_STAGES, {"stage[0].length": "1 km"}), "stage[0].length") == 1000.0


def test_an_optional_quantity_can_be_set_but_not_read_before():
    assert value_at(with_values(TWO_STAGES, {"thrust.nominal": 90}), "thrust.nominal") == 90.0
    with refused("thrust.nominal: is not given and has no default"):
        value_at(TWO_STAGES, "thrust.nominal")


@pytest.mark.parametrize(
    ("path", "message"),
    [
        (
            "joint[0].rotational_stifness",
            "is not a quantity of this vehicle; the nearest are joint[0].rotational_stiff",
        ),
        ("joints[0].shear_stiffness", "the nearest are joint[0].shear_stiffness"),
        ("joint.shear_stiffness", "the nearest are joint[0].shear_stiffness"),
        ("thrust[0].tangency", "the nearest are thrust.tangency"),
        ("stage[0].length.x", "the nearest are stage[0].length"),
        ("stage[-1].length", "the nearest are stage[1].length"),
        ("stage[0]", "is not a quantity of this vehicle"),
        ("thrust", "is not a quantity of this vehicle"),
        ("thrust.axial_force", "is not a quantity of this vehicle"),
        ("joint[0].shear_axis", "is not a quantity of this vehicle"),
        ("title", "is not a quantity of this vehicle"),
        ("joint[1].shear_stiffness", "index out of range: this vehicle has 1 joint"),
        ("stage[2].length", "index out of range: this vehicle has 2 stages"),
        ("point_mass[0].mass", "index out of range: this vehicle has no point masses"),
    ],
)
def test_an_unknown_path_is_refused_for_reading_and_for_writing(path, message):
    with refused(f"{path}: ") as reading:
        value_at(TWO_STAGES, path)
    with refused(message) as writing:
        with_values(TWO_STAGES, {path: 1.0})
    assert str(reading.value) == str(writing.value)


def test_an_empty_path_is_refused():
    with refused("'': is not a quantity of this vehicle"):
        value_at(TWO_STAGES, "")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"stage[1].length": 0}, "stage[1].length: must be greater than 0, found 0"),
        ({"joint[0].shear_stiffness": math.nan}, "joint[0].shear_stiffness: must be a number, found nan"),
        ({"sensor[0].station": 1.5}, "sensor[0].station: must lie on the vehicle, 0 to 1, found 1.5"),
        ({"stage[0].length": "3 ft"}, "stage[0].length: a nondimensional model takes plain numbers, found '3 ft'"),
        ({"stage.split": 0.0}, "stage.split: must be a number between 0 and 1, found 0.0"),
        ({"stage.split": 1.0}, "stage.split: must be a number between 0 and 1, found 1.0"),
        ({"stage.split": math.nan}, "stage.split: must be a number between 0 and 1, found nan"),
        ({"stage.split": "half"}, "stage.split: must be a number between 0 and 1, found 'half'"),
    ],
)
def test_a_value_that_is_not_allowed_is_refused(values, message):
    with refused(message):
        with_values(TWO_STAGES, values)


def test_all_refused_values_are_reported_at_once():
    with pytest.raises(ModelError) as caught:
        with_values(THREE_STAGES, {"force[0].signal.angular_frequency": 0, "stage[1].length": -1})
    assert [path for path, _ in caught.value.problems] == ["stage[1].length", "force[0].signal.angular_frequency"]


def test_the_split_stays_before_the_end_of_the_second_stage():
    with refused("stage.split: must be a number between 0 and 0.375, found 0.4"):
        with_values(THREE_STAGES, {"stage.split": 0.4})


def test_a_single_stage_has_no_split():
    assert "stage.split" not in paths(catalog.beck())
    with refused("stage.split: needs a vehicle of two stages or more, found one stage"):
        value_at(catalog.beck(), "stage.split")
    with refused("stage.split: needs a vehicle of two stages or more, found one stage"):
        with_values(catalog.beck(), {"stage.split": 0.5})


def test_entries_of_tables_are_replaced_before_the_tables_are_stretched():
    taper = {"x": [0.0, 1.0], "value": [2.0, 1.0]}
    vehicle = Vehicle(stages=[Stage(length=1.0, mass_per_length=1.0, bending_stiffness=taper)])
    changed = with_values(vehicle, {"stage[0].length": 3.0, "stage[0].bending_stiffness.value[1]": 5.0})
    assert changed.stages[0].bending_stiffness.x == (0.0, 3.0)
    assert changed.stages[0].bending_stiffness.value == (2.0, 5.0)
    with pytest.raises(ModelError, match=r"value\[1\]: must be greater than 0, found -1"):
        with_values(vehicle, {"stage[0].bending_stiffness.value[1]": -1.0})
    with pytest.raises(ModelError, match="index out of range"):
        with_values(vehicle, {"stage[0].bending_stiffness.value[2]": 1.0})
