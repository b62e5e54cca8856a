"""Reading and writing model files: every way in which one can be wrong is one clear error."""

import math
import os
import re

import pytest

from beal.errors import ModelError
from beal.interop.files import load
from beal.vehicle import Force, Joint, PointMass, Sensor, Stage, Table, Thrust, Vehicle, catalog, dumps, loads
from beal.vehicle.file import LARGEST_FILE

TWO_STAGES = """
title = "two-stage vehicle"
units = "nondimensional"

[[stage]]
name = "upper"
length = 0.6
mass_per_length = 1
bending_stiffness = 1.0

[[stage]]
name = "lower"
length = 0.4
mass_per_length = 1.0
bending_stiffness = 1.0

[[joint]]
rotational_stiffness = 5000.0
shear_stiffness = 5000.0
shear_axis = "mean"

[[point_mass]]
station = 0.3
mass = 0.1

[thrust]
tangency = 0.5
nominal = 90.0

[[sensor]]
name = "imu"
station = 0.12

[[force]]
station = 1.0
signal = {kind = "sine", amplitude = 0.01, angular_frequency = 2.0}
"""
STAGE = "[[stage]]\nlength = 1.0\nmass_per_length = 1.0\nbending_stiffness = 1.0\n"


def refused(message):
    return pytest.raises(ModelError, match=re.escape(message))


def test_a_model_file_becomes_the_vehicle_it_describes(tmp_path):
    (tmp_path / "model.toml").write_text(TWO_STAGES)
    assert load(tmp_path / "model.toml") == Vehicle(
        title="two-stage vehicle",
        units="nondimensional",
        stages=[
            Stage(name="upper", length=0.6, mass_per_length=1, bending_stiffness=1),
            Stage(name="lower", length=0.4, mass_per_length=1, bending_stiffness=1),
        ],
        joints=[Joint(rotational_stiffness=5000, shear_stiffness=5000)],
        point_masses=[PointMass(station=0.3, mass=0.1)],
        thrust=Thrust(tangency=0.5, nominal=90),
        sensors=[Sensor(name="imu", station=0.12)],
        forces=[Force(station=1, signal={"kind": "sine", "amplitude": 0.01, "angular_frequency": 2})],
    )


def test_a_joint_without_stiffness_or_with_an_infinite_one_is_rigid():
    vehicle = loads(STAGE * 3 + "[[joint]]\n[[joint]]\nshear_stiffness = inf\nrotational_stiffness = 'inf'")
    assert vehicle.joints == (Joint(), Joint())
    assert vehicle.joints[0].shear_stiffness == math.inf


def test_a_byte_order_mark_and_windows_line_ends_are_read(tmp_path):
    path = tmp_path / "notepad.toml"
    path.write_bytes(b"\xef\xbb\xbf" + STAGE.replace("\n", "\r\n").encode())
    assert load(path) == loads(STAGE)


def test_all_problems_are_listed_under_the_name_of_the_file(tmp_path):
    path = tmp_path / "model.toml"
    path.write_text("[[stages]]\n[fuel]\n" + STAGE.replace("1.0", "-1.0", 1) + "[[joint]]\n[thrust]\ntangent = 1")
    with pytest.raises(ModelError) as caught:
        load(path)
    known = "title, units, stage, joint, point_mass, tank, support, thrust, damping, distributed_thrust, "
    known += "axial_load, gravity, sensor, force, control, timeline"
    of_thrust = "tangency, scale, station, line, along, axial_term, axial_force, nominal, signal"
    assert str(caught.value).splitlines() == [
        f"{path}: 5 problems",
        f"  stages: unknown key; known here: {known}",
        "  stage[0].length: must be greater than 0, found -1.0",
        f"  thrust.tangent: unknown key; known here: {of_thrust}",
        f"  fuel: unknown key; known here: {known}",
        "  joint: must be one fewer than the stages, 0 (an empty [[joint]] is rigid), found 1",
    ]
    assert caught.value.problems[1] == ("stage[0].length", "must be greater than 0, found -1.0")


def test_a_python_name_alone_is_an_unknown_key():
    with refused("model: stages: unknown key; known here: title"):
        loads(STAGE + "[[stages]]")


def test_units_are_refused_in_a_nondimensional_file_and_read_in_an_si_file():
    with_unit = STAGE.replace("1.0", "'12 ft'", 1)
    assert loads(with_unit).length == pytest.approx(3.6576, rel=1e-15)
    with refused("model: stage[0].length: a nondimensional model takes plain numbers, found '12 ft'"):
        loads('units = "nondimensional"\n' + with_unit)


@pytest.mark.parametrize(("units", "found"), [("'imperial'", "'imperial'"), ("3", "3"), ("['SI']", "['SI']")])
def test_unknown_units_are_one_problem(units, found):
    with refused(f"model: units: must be 'SI' or 'nondimensional', found {found}"):
        loads(f"units = {units}\n" + STAGE.replace("1.0", "'12 ft'", 1))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty, expected at least one [[stage]]"),
        ("# nothing yet\n", "is empty, expected at least one [[stage]]"),
        ("title = 'a'", "stage: is required and missing"),
        ("stage = []", "stage: a vehicle needs at least one stage, found none"),
        ("[stage]\nlength = 1", "stage: must be a list (of tables: [[name]], not [name]), found {'length': 1}"),
        ("a = 1\nb = = 2", "is not valid TOML: Invalid value (at line 2, column 5)"),
        ("a = 1" + "0" * 5000, "is not valid TOML: Exceeds the limit"),
        ("a = " + "[" * 5000, "is not a model: lists or tables are nested too deeply"),
        (STAGE.replace("1.0", "1" + "0" * 400, 1), "stage[0].length: must be a valid number"),
        (STAGE.replace("1.0", "nan", 1), "stage[0].length: must be a number, found nan"),
    ],
)
def test_a_bad_text_is_refused(text, message):
    with refused(f"bad.toml: {message}"):
        loads(text, "bad.toml")


def test_a_missing_file_is_named(tmp_path):
    with refused(f"{tmp_path / 'none.toml'}: cannot be read: No such file or directory"):
        load(tmp_path / "none.toml")


def test_a_directory_is_refused(tmp_path):
    with refused(f"{tmp_path}: cannot be read: Is a directory"):
        load(tmp_path)


def test_a_file_without_permission_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "model.toml"
    path.write_text(STAGE)
    path.chmod(0)
    if os.access(path, os.R_OK):  # the superuser reads everything

        def denied(*_):
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr("pathlib.Path.open", denied)
    with refused(f"{path}: cannot be read: Permission denied"):
        load(path)


def test_an_impossible_file_name_is_refused():
    with refused("is not a file name: embedded null byte"):
        load("a\0b")


def test_a_binary_file_is_refused(tmp_path):
    path = tmp_path / "model.toml"
    path.write_bytes(STAGE.encode() + b"\xff\xfe\x00")
    with refused(f"{path}: is not text in UTF-8 (byte {len(STAGE)} is wrong)"):
        load(path)


def test_a_huge_file_is_refused_before_it_is_parsed(tmp_path):
    path = tmp_path / "model.toml"
    path.write_bytes(b"\xff" * (LARGEST_FILE + 1))
    with refused(f"{path}: is larger than 5 MB"):
        load(path)
    path.write_bytes(STAGE.encode() + b"#" * (LARGEST_FILE - len(STAGE)))
    assert load(path) == loads(STAGE)


def test_a_written_file_leaves_out_defaults():
    vehicle = Vehicle(
        stages=[Stage(length=1, mass_per_length=2, bending_stiffness=3)] * 2,
        joints=[Joint(shear_stiffness=4)],
        thrust=Thrust(nominal=5),
        forces=[Force(station=1, signal=Table(kind="table", time=[0, 1], value=[2, 3]))],
    )
    stage = "[[stage]]\nlength = 1.0\nmass_per_length = 2.0\nbending_stiffness = 3.0\n\n"
    assert dumps(vehicle) == (
        stage * 2 + "[[joint]]\nshear_stiffness = 4.0\n\n[thrust]\nnominal = 5.0\n\n"
        '[[force]]\nstation = 1.0\nsignal = {kind = "table", time = [0.0, 1.0], value = [2.0, 3.0]}\n'
    )


def test_a_rigid_joint_is_written_without_stiffness():
    rigid = Vehicle(stages=catalog.tsto(0.5, 1, 1).stages, joints=[Joint()])
    assert "[[joint]]\n" in dumps(rigid)
    assert "inf" not in dumps(rigid)
    assert loads(dumps(rigid)) == rigid


def test_a_title_of_quotes_line_ends_and_control_characters_reads_back():
    titled = catalog.beck().model_copy(update={"title": 'Pflüger\'s "column"\\\r\n\t\x00\x1f\x7f\x85\u2028🚀'})
    assert loads(dumps(titled)) == titled
