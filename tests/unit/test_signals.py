"""What signals refuse, and a force over time that is a file of its own."""

import math
import re

import pytest

from beal.errors import ModelError
from beal.interop.files import load
from beal.vehicle import Chirp, Gust, Noise, Table, dumps, loads

MODEL = """
[[stage]]
length = 2.0
mass_per_length = 3.0
bending_stiffness = 4.0

[[force]]
station = 1.0
signal = {signal}
"""
TABLE = '{kind = "table", file = "push.csv"}'


def model(signal):
    return MODEL.replace("{signal}", signal)


@pytest.mark.parametrize(
    ("kind", "fields", "message"),
    [
        (Gust, {"amplitude": 1.0, "duration": 0.0}, "duration: must be greater than 0, found 0.0"),
        (Chirp, {"amplitude": 1.0, "first": 0.0, "last": 1.0, "duration": 1.0}, "first: must be greater than 0"),
        (Chirp, {"amplitude": 1.0, "first": 1.0, "last": math.inf, "duration": 1.0}, "last: must be a finite number"),
        (
            Noise,
            {"angular_frequency": [1, 2], "density": [1, 1], "seed": -1},
            "seed: must be greater than or equal to 0",
        ),
        (Noise, {"angular_frequency": [1, 2], "density": [1, -1], "seed": 1}, r"density\[1\]: must be greater than or"),
        (
            Noise,
            {"angular_frequency": [0, 2], "density": [1, 1], "seed": 1},
            r"angular_frequency\[0\]: must be greater",
        ),
        (
            Noise,
            {"angular_frequency": [2, 2], "density": [1, 1], "seed": 1},
            "must increase .* found 2 after 2, at .1.",
        ),
        (Noise, {"angular_frequency": [1], "density": [1], "seed": 1}, "angular_frequency: .* at least 2 items"),
        (Noise, {"angular_frequency": [1, 2], "density": [1, 2, 3], "seed": 1}, "equally long, found 2 and 3"),
        (Noise, {"angular_frequency": [1, 2], "density": [1, 1], "seed": 1, "lines": 0}, "lines: must be greater than"),
        (Noise, {"angular_frequency": [1, 2], "density": [1, 1]}, "seed: is required and missing"),
        (Table, {"time": [0, 2, 1], "value": [0, 0, 0]}, r"time must increase .*, found 1 after 2, at \[2\]"),
        (Table, {"time": [0, math.nan], "value": [0, 0]}, r"time\[1\]: must be a number, found nan"),
        (Table, {"time": [0, 1], "value": [0, math.nan]}, r"value\[1\]: must be a number, found nan"),
    ],
)
def test_a_signal_refuses(kind, fields, message):
    with pytest.raises(ModelError, match=message):
        kind(kind=kind.__name__.lower(), **fields)


def test_the_units_of_a_spectrum_are_converted():
    vehicle = loads(
        model('{kind = "noise", angular_frequency = ["1 Hz", "2 Hz"], density = ["2 N^2/Hz", 1], seed = 4}')
    )
    noise = vehicle.forces[0].signal
    assert noise.angular_frequency == pytest.approx((2 * math.pi, 4 * math.pi))
    assert noise.density == pytest.approx((2 / (2 * math.pi), 1))


@pytest.mark.parametrize(
    "signal",
    [
        '{kind = "noise", angular_frequency = [1.0, 2.0], density = [1.0, 0.0], seed = 12345678901}',
        '{kind = "chirp", amplitude = 2.0, first = 1.0, last = 0.5, duration = 3.0}',
        '{kind = "gust", amplitude = -2.0, start = 1.0, duration = 3.0}',
    ],
)
def test_a_signal_is_written_and_read_back(signal):
    vehicle = loads(model(signal))
    assert loads(dumps(vehicle)) == vehicle


def written(folder, table, signal=TABLE):
    (folder / "push.csv").write_text(table)
    (folder / "model.toml").write_text(model(signal))
    return folder / "model.toml"


def test_a_table_of_a_force_is_a_file_beside_the_model(tmp_path):
    vehicle = load(written(tmp_path, "# measured\ntime [ms], value [kN]\n0, 1\n500, -2.5\n\n2000, 0\n"))
    assert vehicle.forces[0].signal == Table(kind="table", time=[0.0, 0.5, 2.0], value=[1000.0, -2500.0, 0.0])


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("time,value\n0,1\n1,\n2,3\n", "force[0].signal.value[1]: expected a number"),
        ("time,value\n0,1\n1,nan\n2,3\n", "force[0].signal.value[1]: expected a number"),
        ("time,value\n0,1\n,2\n2,3\n", "force[0].signal.time[1]: expected a number"),
        ("time,value\n0,1\n2,2\n1,3\n", "force[0].signal: time must increase from entry to entry, found 1 after 2"),
        ("time,value\n0,1\n", "force[0].signal.time: "),
        ("time\n0\n1\n", "force[0].signal.value: is required and missing"),
        (
            "time,value,gust\n0,1,2\n1,2,3\n",
            "force[0].signal.file, push.csv, row 1: 'gust' is no column here: time and",
        ),
        ("time,value [m]\n0,1\n1,2\n", "force[0].signal.file, push.csv, value [m]: expected a number"),
        ("time,value\n0,1,7\n1,2\n", "force[0].signal.file, push.csv, row 2: has 3 cells, more than the 2 names"),
        ("", "force[0].signal.file, push.csv: needs a row of names (time and value)"),
    ],
)
def test_a_wrong_table_of_a_force_is_refused_by_its_place(tmp_path, table, message):
    with pytest.raises(ModelError, match=re.escape(message)):
        load(written(tmp_path, table))


def test_a_missing_table_and_a_wrong_model_are_reported_together(tmp_path):
    path = written(tmp_path, "")
    (tmp_path / "push.csv").unlink()
    path.write_text(path.read_text().replace("length = 2.0", "length = -2.0"))
    with pytest.raises(ModelError) as refused:
        load(path)
    assert [place for place, _ in refused.value.problems] == ["force[0].signal.file, push.csv", "stage[0].length"]


@pytest.mark.parametrize(
    "signal", ['{kind = "table", file = "push.csv", time = [0.0, 1.0]}', '{kind = "table", file = 3}']
)
def test_the_name_of_a_table_stands_alone(tmp_path, signal):
    with pytest.raises(ModelError, match="must be the name of a file and nothing beside it, found kind, file"):
        load(written(tmp_path, "time,value\n0,1\n1,2\n", signal))


def test_only_a_table_is_a_file(tmp_path):
    with pytest.raises(ModelError, match="unknown key"):
        load(written(tmp_path, "time,value\n0,1\n1,2\n", '{kind = "step", amplitude = 1.0, file = "push.csv"}'))
