"""What a timeline refuses, inline and as a table, and what it says of a vehicle."""

import math
import re

import pytest

from beal.errors import ModelError
from beal.interop.files import load
from beal.vehicle import Joint, Stage, Tank, Timeline, Vehicle, dumps, loads
from beal.vehicle.file import read_timeline
from beal.vehicle.summary import summary

BURN = {
    "time": [0.0, 60.0, 60.0],
    "thrust": [9.0, 9.0, 0.0],
    "fill": {"LOX": [1.0, 0.2, 0.2]},
    "stages": ["1-2", "1", "1"],
}
STAGE = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
TANK = Tank(name="LOX", forward_end=0.2, aft_end=0.8, mass_per_length=2.0)
MODEL = """
[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 1.0

[[tank]]
name = "LOX"
forward_end = 0.2
aft_end = 0.8
mass_per_length = 2.0
"""


def problems(call, *args, **fields):
    with pytest.raises(ModelError) as caught:
        call(*args, **fields)
    return caught.value.problems


def test_a_timeline_says_which_stages_are_attached():
    assert [Timeline(**BURN).attached(n) for n in range(3)] == [(1, 2), (1, 1), (1, 1)]
    assert Timeline(time=[0.0], thrust=[1.0]).attached(0) is None


def test_equal_timelines_have_equal_hashes():
    assert Timeline(**BURN) == Timeline(**BURN)
    assert hash(Timeline(**BURN)) == hash(Timeline(**BURN))


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"time": [0.0, 2.0, 1.0]}, [("time[2]", "must not be below the one before, 2, found 1")]),
        ({"time": [0.0, 0.0, 0.0]}, [("time[2]", "may come twice, for a step; found 0 again")]),
        ({"time": [0.0, math.nan, 1.0]}, [("time[1]", "must be a number, found nan")]),
        ({"time": "0"}, [("time", "must be a list (of tables: [[name]], not [name]), found '0'")]),
        ({"thrust": [9.0, 9.0]}, [("thrust", "must have one entry for each of the 3 times, found 2")]),
        (
            {"thrust": [9.0, -9.0, math.inf]},
            [
                ("thrust[1]", "must be greater than or equal to 0, found -9.0"),
                ("thrust[2]", "must be a finite number, found inf"),
            ],
        ),
        ({"fill": {"LOX": [1.0]}}, [("fill.LOX", "must have one entry for each of the 3 times, found 1")]),
        ({"fill": {"LOX": [1.0, 1.1, 0.0]}}, [("fill.LOX[1]", "must be less than or equal to 1, found 1.1")]),
        ({"fill": [1.0]}, [("fill", "must be a table, found [1.0]")]),
        (
            {"stages": ["1-2", "2-1", "0"]},
            [
                (f"stages[{n}]", f"must be stages from the nose, such as 1-3 or 2, found {text!r}")
                for n, text in ((1, "2-1"), (2, "0"))
            ],
        ),
        ({"stages": ["1-2"]}, [("stages", "must have one entry for each of the 3 times, found 1")]),
        ({"speed": [1.0]}, [("speed", "unknown key; known here: time, thrust, fill, stages")]),
    ],
)
def test_a_timeline_refuses(change, expected):
    assert problems(Timeline, **BURN | change) == expected


def test_all_problems_of_a_timeline_are_reported_at_once_with_those_of_the_vehicle():
    wrong = {"time": [0.0, 2.0, 1.0], "thrust": [1.0], "fill": {"fuel": [0.0, 0.5, -0.5]}, "stages": ["1", "1-3", "x"]}
    assert problems(Vehicle, stages=[STAGE], tanks=[TANK], joints=[Joint()], timeline=wrong) == [
        ("timeline.fill.fuel[2]", "must be greater than or equal to 0, found -0.5"),
        ("timeline.time[2]", "must not be below the one before, 2, found 1"),
        ("timeline.thrust", "must have one entry for each of the 3 times, found 1"),
        ("timeline.stages[2]", "must be stages from the nose, such as 1-3 or 2, found 'x'"),
        ("joint", "must be one fewer than the stages, 0 (an empty [[joint]] is rigid), found 1"),
        ("timeline.fill.fuel", "must be a tank of this vehicle (LOX), found 'fuel'"),
        ("timeline.stages[1]", "must lie on the vehicle, stages 1-1, found '1-3'"),
    ]


def test_a_timeline_in_a_model_file_takes_units_and_is_written_again():
    vehicle = loads(MODEL + '[timeline]\ntime = [0, "2 min"]\nthrust = ["3 kN", 0]\nfill = {LOX = [1, 0.5]}\n')
    assert vehicle.timeline == Timeline(time=[0.0, 120.0], thrust=[3000.0, 0.0], fill={"LOX": [1.0, 0.5]})
    assert loads(dumps(vehicle)) == vehicle
    assert 'fill = {"LOX" = [1.0, 0.5]}' in dumps(vehicle)
    assert summary(vehicle)["timeline"] == {"times": 2, "from": 0.0, "to": 120.0}


def written(folder, table, model=MODEL):
    (folder / "ascent.csv").write_text(table, encoding="utf-8")
    (folder / "model.toml").write_text(model + '[timeline]\nfile = "ascent.csv"\n')
    return folder / "model.toml"


def test_a_table_is_read_from_where_the_model_file_is(tmp_path):
    table = "# an ascent\ntime [min], thrust [kN], fill.LOX, stages\n\n0, 3, 1, 1\n2, 0, 0.5, 1-1\n"
    expected = Timeline(time=[0.0, 120.0], thrust=[3000.0, 0.0], fill={"LOX": [1.0, 0.5]}, stages=["1", "1-1"])
    assert load(written(tmp_path, table)).timeline == expected


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        (
            "",
            [
                (
                    "timeline.file, ascent.csv",
                    "needs a row of names (time, thrust, fill.TANK or stages), and a row for each time",
                )
            ],
        ),
        ("time\n0\n", [("timeline.thrust", "is required and missing")]),
        ("time,thrust\n", [("timeline.time", "must hold at least one time, found none")]),
        (
            "time,thrust,mach,time\n0,1,2,3\n0,1,2,3,4\n",
            [
                ("timeline.file, ascent.csv, row 3", "has 5 cells, more than the 4 names"),
                (
                    "timeline.file, ascent.csv, row 1",
                    "'mach' is no column here: time, thrust, fill.TANK or stages",
                ),
                ("timeline.file, ascent.csv, row 1", "'time' comes twice"),
            ],
        ),
        (
            "time [kg],thrust [parsec N],fill.LOX [lb]\n0,1,1\n",
            [
                ("timeline.file, ascent.csv, time [kg]", "converts to s"),
                ("timeline.file, ascent.csv, thrust [parsec N]", "converts to N"),
                ("timeline.file, ascent.csv, fill.LOX [lb]", "a pure number"),
            ],
        ),
        (
            "time,thrust,fill.LOX\n0,,1\n1,nan,x\n0.5,1\n",
            [
                ("timeline.thrust[0]", "found ''"),
                ("timeline.thrust[1]", "found 'nan'"),
                ("timeline.fill.LOX[1]", "found 'x'"),
                ("timeline.fill.LOX[2]", "found ''"),
                ("timeline.time[2]", "must not be below the one before, 1, found 0.5"),
            ],
        ),
        (
            "time,thrust,fill.fuel\n0,1,1\n",
            [("timeline.fill.fuel", "must be a tank of this vehicle (LOX), found 'fuel'")],
        ),
    ],
)
def test_a_wrong_table_is_refused_with_every_problem(tmp_path, table, expected):
    found = problems(load, written(tmp_path, table))
    assert [path for path, _ in found] == [path for path, _ in expected]
    assert [text for (_, message), (_, text) in zip(found, expected, strict=True) if text not in message] == []


def test_a_wrong_table_and_a_wrong_model_are_reported_together(tmp_path):
    path = written(tmp_path, "time,thrust,mach\n0,1,2\n", MODEL.replace("length = 1.0", "length = -1.0", 1))
    assert [place for place, _ in problems(load, path)] == ["timeline.file, ascent.csv, row 1", "stage[0].length"]


def test_a_missing_table_is_refused_by_its_name(tmp_path):
    path = written(tmp_path, "")
    (tmp_path / "ascent.csv").unlink()
    with pytest.raises(ModelError, match=re.escape("timeline.file, ascent.csv: cannot be read: No such file")):
        load(path)


@pytest.mark.parametrize("text", ['file = "ascent.csv"\ntime = [0.0]', "file = 3"])
def test_the_name_of_a_table_stands_alone(text):
    with pytest.raises(ModelError, match="must be the name of a file and nothing beside it, found file"):
        loads(MODEL + f"[timeline]\n{text}\n")


def test_a_nondimensional_table_has_no_units(tmp_path):
    (tmp_path / "ascent.csv").write_text("time [s],thrust\n0,1\n")
    with pytest.raises(ModelError, match="a nondimensional model takes plain numbers"):
        read_timeline(tmp_path / "ascent.csv", "nondimensional")


def test_a_binary_table_is_refused(tmp_path):
    (tmp_path / "ascent.csv").write_bytes(b"time\xff")
    with pytest.raises(ModelError, match=r"is not text in UTF-8 \(byte 4 is wrong\): expected a table in CSV"):
        read_timeline(tmp_path / "ascent.csv", "SI")
