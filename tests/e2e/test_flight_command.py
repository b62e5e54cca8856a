"""beal flight as a user runs it."""

import csv
import math
import subprocess
import sys

import pytest

STAGE = """
[[stage]]
length = "3 m"
mass_per_length = 20.0
bending_stiffness = 1e6
"""
MODEL = f"""title = "test"
{STAGE}{STAGE}
[[joint]]
rotational_stiffness = 1e6

[[tank]]
name = "LOX"
forward_end = 3.5
aft_end = 5.5
mass_per_length = 100.0
"""
TABLE = "time,thrust [kN],fill.LOX,stages\n0,30,1,1-2\n10,30,0.5,1-2\n12,0,0.5,1\n"


@pytest.fixture
def flown(written):
    written(TABLE, "ascent.csv")
    return written(MODEL + '[timeline]\nfile = "ascent.csv"\n')


def test_a_flight_is_given_as_json(result_of, flown):
    found = result_of("flight", flown, "--modes", 2)
    assert found["time"] == [0.0, 10.0, 12.0]
    assert found["thrust"] == [3e4, 3e4, 0.0]
    assert found["mass"] == pytest.approx([320.0, 220.0, 60.0])
    assert found["stages"] == ["1-2", "1-2", "1"]
    assert [[len(row) for row in found[name]] for name in ("angular_frequency", "frequency_hz")] == [[2] * 3] * 2
    assert found["frequency_hz"][2][0] == pytest.approx(22.3732854 * math.sqrt(1e6 / (20 * 3**4)) / (2 * math.pi))
    assert found["critical_thrust"][2] == pytest.approx(109.689191958738 * 1e6 / 9)
    assert found["margin"][:2] == pytest.approx([value / 3e4 - 1 for value in found["critical_thrust"][:2]])
    assert found["margin"][2] is None
    assert found["margin_is_lower_bound"] == [False] * 3
    assert (found["kind"][2], found["modes"][2], found["units"]) == ("flutter", [1, 2], "SI")
    assert found["status"] == ["solved"] * 3
    assert found["reason"] == ["", "", "coasts: no thrust, no margin"]


def test_a_flight_is_shown_as_a_table(beal_here, flown):
    shown = beal_here("flight", flown).stdout
    head = ["time [s]", "mass [kg]", "thrust [N]", "stages", "f 1 [Hz]", "f 3 [Hz]", "critical thrust [N]", "margin"]
    assert [title for title in head if title not in shown] == []
    assert "f 4" not in shown
    assert "at 12: coasts: no thrust, no margin" in shown


def test_a_margin_that_is_a_bound_is_shown_as_one(beal_here, written):
    hanging = 'units = "nondimensional"\n' + STAGE.replace('"3 m"', "3.0") + '[support]\ntail = "clamped"\n'
    hanging += (
        '[thrust]\ntangency = 0.0\nstation = 0.0\naxial_force = "constant"\n[timeline]\ntime = [0]\nthrust = [1]\n'
    )
    shown = beal_here("flight", written(hanging)).stdout
    assert "stable up to" in shown
    assert ">= " in shown
    assert "omega 1" in shown


def test_a_vehicle_that_tumbles_is_said_to(beal_here, written):
    model = MODEL + "[thrust]\ntangency = 0.5\n[timeline]\ntime = [0]\nthrust = [1]\n"
    shown = beal_here("flight", written(model)).stdout
    assert "tumbles" in shown
    assert "its elastic modes alone bear" in shown


def test_a_flight_is_written_as_csv_and_drawn(beal_here, flown, tmp_path):
    done = beal_here("flight", flown, "--csv", "flight.csv", "--figure", "flight.svg", "--modes", 2)
    assert (done.returncode, done.stderr) == (0, "beal: figure written to flight.svg\nbeal: written to flight.csv\n")
    with (tmp_path / "flight.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["angular_frequency_2"]) > float(row["angular_frequency_1"]) > 0 for row in rows] == [True] * 3
    assert [row["margin"] == "" for row in rows] == [False, False, True]
    assert [(row["mode_low"], row["mode_high"]) for row in rows][-1] == ("1", "2")
    assert (tmp_path / "flight.svg").read_text().startswith("<?xml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ascent.csv", "flight.csv", "flight.svg", "model.toml"]


def test_a_figure_of_every_kind_is_one(beal_here, flown, tmp_path):
    starts = {"png": b"\x89PNG", "pdf": b"%PDF"}
    for ending, start in starts.items():
        assert beal_here("flight", flown, "--figure", f"flight.{ending}").returncode == 0
        assert (tmp_path / f"flight.{ending}").read_bytes().startswith(start)


def test_another_timeline_takes_the_place_of_the_model_s(result_of, flown, written):
    written("time,thrust,fill.LOX\n0,5,0\n", "other.csv")
    assert result_of("flight", flown, "--timeline", "other.csv")["mass"] == pytest.approx([120.0])


@pytest.mark.parametrize(
    ("arguments", "table", "expected"),
    [
        ((), None, ["timeline: is needed and missing"]),
        (("--timeline", "nowhere.csv"), None, ["nowhere.csv: cannot be read: No such file"]),
        (("--timeline", "ascent.csv"), "time\n0\n", ["ascent.csv", "timeline.thrust: is required and missing"]),
        (("--timeline", "ascent.csv"), "time,thrust\n0,\n", ["timeline.thrust[0]", "found ''"]),
        (
            ("--timeline", "ascent.csv"),
            "time,thrust,fill.fuel,stages\n5,nan,1,1\n4,1,1,1-3\n",
            ["4 problems", "time[1]", "thrust[0]", "fill.fuel: must be a tank of this vehicle (LOX)", "stages[1]"],
        ),
        (("--timeline", "ascent.csv", "--modes", "0"), TABLE, ["modes: must lie between 1 and 40, found 0"]),
        (
            ("--timeline", "ascent.csv", "--figure", "a.txt"),
            TABLE,
            ["a.txt: --figure: must end with one of .png, .svg, .pdf, found .txt"],
        ),
        (("--timeline", "ascent.csv", "--csv", "no/where.csv"), TABLE, ["no/where.csv: cannot be written"]),
    ],
)
def test_bad_input_is_refused_with_the_place_and_the_reason(beal_here, written, arguments, table, expected):
    if table is not None:
        written(table, "ascent.csv")
    done = beal_here("flight", written(MODEL), *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert [text for text in expected if text not in done.stderr] == []


def test_a_time_that_does_not_converge_is_shown_and_the_exit_code_is_3(beal_here, flown, monkeypatch):
    from beal.errors import ConvergenceError
    from beal.study import flight

    def fails(vehicle, tolerance):
        raise ConvergenceError("lost")

    monkeypatch.setattr(flight, "critical_thrust", fails)
    done = beal_here("flight", flown)
    assert done.returncode == 3
    assert "not converged" in done.stdout
    assert "at 0, 10, 12: lost" in done.stdout


WITHOUT_MATPLOTLIB = """
import sys
class Absent:
    def find_spec(self, name, *rest):
        if name == "matplotlib":
            raise ModuleNotFoundError("No module named 'matplotlib'", name="matplotlib")
sys.meta_path.insert(0, Absent())
sys.argv[1:] = ["flight", "model.toml", "--figure", "flight.png"]
from beal.cli import main
main()
"""


def test_without_matplotlib_a_figure_is_refused_with_the_remedy(flown, tmp_path):
    done = subprocess.run([sys.executable, "-c", WITHOUT_MATPLOTLIB], cwd=tmp_path, capture_output=True, text=True)
    message = "beal: --figure: needs matplotlib, which is not installed; install beal[plot]\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", message)
