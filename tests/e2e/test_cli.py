"""Every command on good input: what it says, in words and as JSON."""

import csv
import math
import os
import re
import subprocess
import sys
from importlib.metadata import version
from importlib.resources import files

import numpy as np
import pytest
import xarray

from beal.cli.output import emit, new_file
from beal.discretisation import FORMULATIONS
from beal.errors import ModelError
from beal.interop.files import load
from beal.report.numbers import digits, quantity
from beal.vehicle import Thrust, catalog
from beal.vehicle.file import dumps, loads

COMMANDS = [
    "check",
    "modes",
    "critical",
    "curve",
    "flight",
    "control",
    "floquet",
    "explore",
    "sensitivity",
    "design",
    "map",
    "uncertainty",
    "response",
    "amplitude",
    "reproduce",
    "verify",
    "convert",
    "example",
]
HEAVY = {"numpy", "scipy", "pydantic", "xarray", "zarr", "matplotlib", "pint"}
SI_BEAM = """
title = "beam"
[[stage]]
length = "20 m"
mass_per_length = "500 kg/m"
bending_stiffness = "2e8 N*m^2"
[thrust]
nominal = "30 MN"
"""
# An actual uniform beam of L = 20 m, EI = 2e8 N m^2, m = 500 kg/m: EI/L^2 = 500 kN, sqrt(EI/(m L^4)) = 1.58113883 rad/s
SI_SCALE, SI_RATE = 5e5, 1.5811388300841898


def example(name):
    return (files("beal.vehicle.catalog") / "models" / f"{name}.toml").read_text(encoding="utf-8")


@pytest.fixture
def tsto(written):
    return written(example("tsto"), "tsto.toml")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(beal_here, command):
    done = beal_here(command, "--help")
    assert done.returncode == 0
    assert f"beal {command} " in done.stdout
    assert "--json" in done.stdout


def test_the_help_of_the_command_lists_all_commands_and_nothing_else(beal):
    listed = re.findall(r"^│ ([a-z]+) ", beal("--help").stdout, re.MULTILINE)
    assert listed == COMMANDS


def test_the_help_names_all_formulations(beal):
    words = set(re.findall(r"[a-z-]+", beal("critical", "--help").stdout))
    assert set(FORMULATIONS) <= words


def test_the_version_is_that_of_the_package(beal):
    assert beal("--version").stdout == f"beal {version('beal')}\n"


def test_help_imports_nothing_heavy():
    code = "import sys; import beal.cli.app; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "typer" in loaded
    assert HEAVY & set(loaded) == set()


def test_check_gives_the_resolved_model(result_of, tsto):
    resolved = result_of("check", tsto)
    assert (resolved["length"], resolved["mass"], resolved["centre_of_mass"]) == pytest.approx((1.0, 1.0, 0.5))
    assert resolved["nondimensional"]["nominal_thrust"] == 90.0


def test_a_title_that_the_terminal_cannot_show_is_no_error(beal, written, monkeypatch):
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    assert "Pfl\\xfcger's column: flutters" in beal("critical", written(example("pflueger"))).stdout


def test_check_shows_units_in_si_alone(beal, written, tsto):
    assert "length: 20 m\n" in beal("check", written(SI_BEAM)).stdout
    assert "length: 1\n" in beal("check", tsto).stdout


def test_modes_are_those_of_the_free_beam(result_of, written):
    # Roots of cos(z) cosh(z) = 1, squared: textbook values.
    found = result_of("modes", written(example("beal")), "--count", 3)
    assert found["angular_frequency"] == pytest.approx([22.3732854, 61.6728229, 120.9033916], rel=1e-8)
    assert found["rigid_body_modes"] == 2
    assert found["thrust"] == 0
    assert max(found["error_estimate"]) < 1e-6
    assert "frequency_hz" not in found


def test_modes_in_si_come_in_hertz_too(result_of, written):
    found = result_of("modes", written(SI_BEAM), "--count", 2)
    assert found["angular_frequency"] == pytest.approx([22.3732854 * SI_RATE, 61.6728229 * SI_RATE], rel=1e-8)
    assert found["frequency_hz"] == pytest.approx([w / 6.283185307179586 for w in found["angular_frequency"]])


def test_high_modes_are_converged(result_of, written):
    # The n-th root of cos(z) cosh(z) = 1 is (n + 1/2) pi to rounding from n = 12 on.
    found = result_of("modes", written(example("beal")), "--count", 40)
    exact = [((n + 0.5) * 3.141592653589793) ** 2 for n in range(12, 41)]
    errors = [abs(found["angular_frequency"][n - 1] - w) for n, w in zip(range(12, 41), exact, strict=True)]
    assert max(errors) < 1e-5
    assert all(e < 1e-5 for e in found["error_estimate"])


@pytest.mark.parametrize(
    ("command", "modes"), [(["modes"], 2), (["curve", "--to", "3"], 2), (["critical", "--figure", "z.png"], None)]
)
def test_of_a_vehicle_with_few_modes_all_are_shown(result_of, written, command, modes):
    name, *options = command
    found = result_of(name, written(dumps(catalog.ziegler())), *options)
    assert modes is None or np.shape(found["angular_frequency"])[-1] == modes


def test_frequencies_that_do_not_converge_are_not_given(beal_here, written, monkeypatch):
    monkeypatch.setattr("beal.stability.modes.ORDERS", (10, 14))
    done = beal_here("modes", written(example("beal")), "--count", 8, "--json")
    assert (done.returncode, done.stdout) == (3, "")
    assert "8 frequencies do not converge; ask for fewer" in done.stderr


def test_loaded_modes_are_those_at_the_nominal_thrust(result_of, tsto):
    loaded, given = result_of("modes", tsto, "--loaded"), result_of("modes", tsto, "--thrust", 90)
    assert loaded == given
    assert loaded["angular_frequency"][0] < result_of("modes", tsto)["angular_frequency"][0]


def test_modes_of_a_fluttering_vehicle_show_growth(result_of, tsto):
    growth = result_of("modes", tsto, "--thrust", 120)["growth_rate"]
    assert sorted(growth)[-1] == pytest.approx(13.0908265, rel=1e-6)
    assert sum(growth) == pytest.approx(0.0, abs=1e-6)


def test_critical_gives_the_contract_and_the_margin(result_of, tsto):
    found = result_of("critical", tsto)
    assert found["critical_thrust"] == pytest.approx(106.437231, abs=1e-6)
    assert found["angular_frequency"] == pytest.approx(22.8073, abs=1e-4)
    assert (found["kind"], found["modes"], found["formulation"]) == ("flutter", [1, 2], "objective")
    assert found["margin"] == pytest.approx(106.437231 / 90 - 1, abs=1e-7)
    assert (found["rigid_body"], found["elastic"]) == ("neutral", None)
    assert found["searched_to"] > 500
    assert 0 < found["error_estimate"] < 1e-6
    assert found["watched_modes"] >= 8


@pytest.mark.parametrize(("formulation", "value"), [("corrected-ritz", 109.528403), ("as-printed", 109.615937)])
def test_critical_follows_the_formulation(result_of, tsto, formulation, value):
    assert result_of("critical", tsto, "--formulation", formulation)["critical_thrust"] == pytest.approx(
        value, abs=1e-6
    )


def test_critical_follows_the_size_of_the_ritz_basis(result_of, tsto):
    smaller = result_of("critical", tsto, "--formulation", "corrected-ritz", "--modes", 6)
    assert smaller["critical_thrust"] != pytest.approx(109.528403, abs=1e-3)


def test_all_critical_thrusts_come_in_order(result_of, tsto):
    events = result_of("critical", tsto, "--all")["events"]
    assert [event["modes"] for event in events] == [[1, 2], [3, 4]]
    assert [event["unstable"] for event in events] == [2, 4]
    assert {event["change"] for event in events} == {"destabilises"}
    assert events[0]["thrust"] == pytest.approx(106.437231, abs=1e-6)


def test_standard_output_holds_one_json_object_and_nothing_else(beal, strict, tsto):
    done = beal("critical", tsto, "--json")
    assert (done.returncode, done.stderr, done.stdout.count("\n")) == (0, "", 1)
    assert strict(done.stdout)["kind"] == "flutter"


def test_the_complete_method_agrees(result_of, tsto):
    assert result_of("critical", tsto, "--complete")["critical_thrust"] == pytest.approx(106.437231, abs=1e-6)


def test_the_verdict_is_one_sentence_with_its_evidence(beal, tsto):
    verdict, searched, joints = beal("critical", tsto).stdout.splitlines()
    assert verdict == (
        "two-stage vehicle: flutters at P L^2/EI = 106.437231: modes 1 and 2 meet at an angular frequency of 22.8073; "
        "margin +18.26 % over the nominal thrust 90"
    )
    assert "10 lowest elastic modes up to 555.035" in searched
    assert joints == "joints: shear axis mean"


def test_the_verdict_in_si_has_units_and_the_nondimensional_value(beal, result_of, written):
    model = written(SI_BEAM)
    verdict = beal("critical", model).stdout.splitlines()[0]
    assert verdict == (
        "beam: flutters at 54.8445960 MN (P L^2/EI = 109.689192): modes 1 and 2 meet at 5.80631 Hz (36.4821 rad/s); "
        "margin +82.82 % over the nominal thrust 30 MN"
    )
    assert result_of("critical", model)["critical_thrust"] == pytest.approx(109.689191958738 * SI_SCALE, rel=1e-9)


def test_a_paper_formulation_says_that_its_joint_is_inertial(beal, tsto):
    assert "shear axis inertial" in beal("critical", tsto, "--formulation", "converged").stdout


def test_a_stable_vehicle_is_said_to_be_stable_as_far_as_was_searched(beal, result_of, tsto):
    assert "stable up to 50, as far as was searched" in beal("critical", tsto, "--max-thrust", 50).stdout
    found = result_of("critical", tsto, "--max-thrust", 50)
    assert (found["kind"], found["critical_thrust"], found["margin"], found["searched_to"]) == (
        "stable",
        None,
        None,
        50,
    )


def test_a_vehicle_that_tumbles_says_so_and_gives_its_elastic_load(beal, result_of, written):
    model = written(example("beal") + "[thrust]\ntangency = 0.5\n")
    found = result_of("critical", model)
    assert (found["critical_thrust"], found["rigid_body"]) == (0, "tumbling")
    assert found["elastic"]["critical_thrust"] is None or found["elastic"]["critical_thrust"] > 0
    assert "tumbles as a rigid body under any thrust" in beal("critical", model).stdout


def test_curve_starts_at_rest_and_ends_where_asked(result_of, tsto):
    found = result_of("curve", tsto, "--to", 120, "--points", 7, "--modes", 2)
    assert found["thrust"] == pytest.approx([0, 20, 40, 60, 80, 100, 120])
    assert found["angular_frequency"][0] == pytest.approx([22.3534997, 61.2367290], rel=1e-7)
    assert found["growth_rate"][5] == pytest.approx([0, 0], abs=1e-6)
    assert max(found["growth_rate"][6]) == pytest.approx(13.0908265, rel=1e-6)


def test_curve_writes_the_same_numbers_as_csv(result_of, tsto, tmp_path):
    found = result_of("curve", tsto, "--to", 120, "--points", 3, "--modes", 2, "-o", "curve.csv")
    with (tmp_path / "curve.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["thrust", "angular_frequency_1", "angular_frequency_2", "growth_rate_1", "growth_rate_2"]
    columns = [
        found["thrust"],
        *zip(*found["angular_frequency"], strict=True),
        *zip(*found["growth_rate"], strict=True),
    ]
    assert [[float(x) for x in row] for row in rows] == [list(row) for row in zip(*columns, strict=True)]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["curve.csv", tsto]


def test_critical_gives_the_transient_growth_below_it(beal_here, result_of, tsto):
    found = result_of("critical", tsto, "--growth", 90)["transient_growth"]
    assert (found["thrust"], found["growth"]) == (90, pytest.approx(21.1982, rel=1e-5))
    assert found["lower_bound"] < found["growth"] < found["upper_bound"]
    assert (
        "under a thrust of 90 the energy of a motion may grow 21.2-fold"
        in beal_here("critical", tsto, "--growth", 90).stdout
    )
    assert "transient_growth" not in result_of("critical", tsto)


def test_response_gives_the_histories_of_each_sensor(result_of, tsto):
    found = result_of("response", tsto, "--duration", 0.1, "--step", 0.001, "--initial", "mode:1:0.01")
    imu = found["sensors"]["imu"]
    assert len(found["time"]) == len(imu["displacement"]) == len(imu["rate"]) == len(imu["slope"]) == 101
    assert (found["method"], found["step"], found["thrust"]) == ("newmark", pytest.approx(0.001), 90)
    assert imu["rate"][0] == pytest.approx(0, abs=1e-12)
    assert 0 < abs(imu["displacement"][0]) <= 0.01
    assert found["growth_rate"] == pytest.approx(0, abs=1e-6)


def test_a_motion_in_the_first_mode_is_back_after_its_period(result_of, written):
    model = written(example("beal") + '[[sensor]]\nname = "nose"\nstation = 0.0\n')
    period = 2 * math.pi / 22.3732854
    arguments = ("response", model, "--duration", period, "--thrust", 0, "--method", "exact")
    nose = result_of(*arguments, "--initial", "mode:1:0.01")["sensors"]["nose"]["displacement"]
    assert (nose[0], nose[-1], min(nose)) == pytest.approx((0.01, 0.01, -0.01), rel=1e-6)


def test_both_methods_give_the_same_motion(result_of, tsto):
    arguments = ("response", tsto, "--duration", 0.5, "--step", 0.0005, "--initial", "release:0.01:1.0")
    newmark, exact = (
        result_of(*arguments, "--method", method)["sensors"]["imu"]["displacement"] for method in ("newmark", "exact")
    )
    # Newmark's period error is (w h)^2/12, about 1e-4 for the highest mode that matters here (w = 100).
    assert newmark == pytest.approx(exact, abs=2e-3 * max(map(abs, exact)))


def test_response_shows_the_rigid_and_the_elastic_part_apart(result_of, written):
    gust = '\n[[force]]\nstation = 1.0\nsignal = {kind = "gust", amplitude = 0.1, duration = 0.2}\n'
    model = written(example("tsto") + gust)
    free = result_of("response", model, "--duration", 0.5, "--thrust", 20)["sensors"]["imu"]
    assert set(free) == {
        *("displacement", "rate", "acceleration", "slope", "slope_rate"),
        *("rigid_displacement", "elastic_displacement", "rigid_slope", "elastic_slope"),
    }
    bent = result_of("response", model, "--duration", 0.5, "--thrust", 20, "--elastic")["sensors"]["imu"]
    assert bent["displacement"] == pytest.approx(free["elastic_displacement"], abs=1e-6 * max(free["displacement"]))
    assert not any(bent["rigid_displacement"])
    assert max(map(abs, free["rigid_displacement"])) > 5 * max(map(abs, bent["displacement"]))


@pytest.mark.parametrize(
    ("thrust", "ends"),
    [("ramp:20:60:0.2", (20, 60)), ("pulsating:50:5:0.5", (55, 55)), ("burn.csv", (30, 10))],
)
def test_response_takes_a_thrust_that_varies(beal_here, result_of, written, tsto, thrust, ends):
    written("time, thrust\n0, 30\n0.05, 70\n0.2, 10\n", "burn.csv")
    arguments = ("response", tsto, "--duration", 0.2, "--thrust", thrust, "--initial", "mode:1:0.01")
    found = result_of(*arguments)
    assert (found["thrust_history"][0], found["thrust_history"][-1]) == pytest.approx(ends, rel=1e-3)
    assert found["growth_rate"] is None
    assert beal_here(*arguments).stdout.startswith("P from ")


def test_a_thrust_with_a_gap_is_refused(beal_here, written, tsto):
    written("time, thrust\n0, 30\n0.05,\n0.2, 10\n", "burn.csv")
    done = beal_here("response", tsto, "--duration", 0.2, "--thrust", "burn.csv", "--initial", "mode:1:0.01")
    assert (done.returncode, done.stdout) == (2, "")
    assert "thrust: its table must be numbers, found [0.0, 0.05, 0.2] and [30.0, '', 10.0]" in done.stderr


def test_response_writes_all_that_a_sensor_reads(beal_here, tsto, tmp_path):
    beal_here("response", tsto, "--duration", 0.1, "--initial", "mode:1:0.01", "-o", "out.csv")
    with (tmp_path / "out.csv").open() as file:
        header = next(csv.reader(file))
    assert header[:6] == [
        "time",
        *(f"imu_{q}" for q in ("displacement", "rate", "acceleration", "slope", "slope_rate")),
    ]


def test_response_above_the_critical_thrust_grows(beal, tsto):
    done = beal("response", tsto, "--duration", 1, "--thrust", 120, "--method", "exact", "-o", "histories.csv")
    assert "unstable, its motion grows as exp(13.09 t)" in done.stdout
    assert done.stderr == "beal: histories written to histories.csv\n"


def test_map_counts_what_it_wrote(result_of, written, tsto, tmp_path):
    study = f'model = "{tsto}"\n[grid]\n"stage.split" = {{values = [0.2, 0.6]}}\n'
    study += '"joint[0].rotational_stiffness" = {from = 1, to = 1e4, points = 2, spacing = "log"}\n'
    counted = result_of("map", written(study, "study.toml"), "-o", "map.zarr")
    with xarray.open_zarr(tmp_path / "map.zarr") as found:
        assert dict(found.sizes) == {"stage.split": 2, "joint[0].rotational_stiffness": 2}
        assert (counted["lowest"], counted["highest"]) == (found.critical_thrust.min(), found.critical_thrust.max())
    assert (counted["points"], counted["status"]["solved"]) == (4, 4)
    assert counted["kind"] == {"stable": 0, "flutter": 2, "divergence": 2}
    assert counted["method"] == {"tables": 0, "single": 4}


def test_map_says_how_many_points_were_solved_one_by_one(beal_here, written, tsto):
    study = f'model = "{tsto}"\n[grid]\n"stage.split" = {{values = [0.2, 0.6, 1.5]}}\n'
    assert (
        "; 1 invalid; 3 solved one by one\n" in beal_here("map", written(study, "study.toml"), "-o", "map.zarr").stdout
    )


@pytest.mark.parametrize(
    ("command", "needed", "slow"),
    [
        ("map study.toml -o map.zarr", "beal.study.map", {"scipy.signal"}),
        ("critical model.toml", "beal.stability.critical", {"scipy.signal", "scipy.stats", "zarr", "beal.motion"}),
        ("response model.toml --duration 1", "beal.motion.solve", {"scipy.signal", "scipy.stats", "zarr"}),
    ],
)
def test_commands_do_without_slow_imports(written, tsto, tmp_path, command, needed, slow):
    written(f'model = "{tsto}"\n[grid]\n"stage.split" = {{values = [0.2]}}\n', "study.toml")
    script = "import sys; from beal.cli import main; sys.argv[0] = 'beal'; main()"
    script = f"import atexit, sys; atexit.register(lambda: print(*sorted(sys.modules), sep='\\n')); {script}"
    arguments = [sys.executable, "-c", script, *command.replace("model.toml", tsto).split()]
    printed = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True).stdout.splitlines()
    assert needed in printed
    assert {"xarray", "pandas", "distributed", "matplotlib", *slow} & set(printed) == set()


def test_the_server_of_the_explorer_leaves_computing_to_its_processes():
    code = "import sys; import beal.web.serve; print(*sorted(sys.modules))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "uvicorn" in loaded
    assert {"numpy", "beal.vehicle", "beal.web.worker"} & set(loaded) == set()


@pytest.mark.parametrize("name", ["beck", "beal", "pflueger", "tsto"])
def test_examples_are_the_vehicles_of_the_catalog(name):
    vehicles = {
        "beck": catalog.beck(),
        "beal": catalog.beal(),
        "pflueger": catalog.pflueger(0.5),
        "tsto": catalog.tsto(0.6, 5000.0, 5000.0),
    }
    read = loads(example(name))
    assert read.model_copy(update={"forces": (), "thrust": Thrust()}) == vehicles[name]
    assert "#" in example(name)


@pytest.mark.parametrize("name", ["beck", "beal", "pflueger", "tsto"])
def test_examples_say_their_critical_thrust(result_of, written, name):
    said = float(re.search(r"flutters at P = ([0-9.]+)\.\n", example(name), re.IGNORECASE)[1])
    assert result_of("critical", written(example(name)))["critical_thrust"] == pytest.approx(said, abs=1e-6)


def test_example_prints_what_it_writes(beal, tmp_path):
    assert beal("example", "tsto", "-o", "new.toml").returncode == 0
    assert beal("example", "tsto").stdout == (tmp_path / "new.toml").read_text(encoding="utf-8")
    assert load(tmp_path / "new.toml").title == "two-stage vehicle"


def test_digits_are_those_that_the_error_supports():
    assert digits(106.43723149, 1e-12) == "106.437231"
    assert digits(106.43723149, 0.3) == "106"
    assert digits(0.0012345678, 1e-6) == "0.00123"
    assert digits(100.0, 1e-4) == "100.000"
    assert quantity(1234567.0, "N", 100.0) == "1.235 MN"
    assert quantity(0.0, "N", 0.0) == "0 N"


def test_a_file_that_is_not_finished_leaves_the_old_one(tmp_path):
    target = tmp_path / "table.csv"
    target.write_text("old", encoding="utf-8")
    writing = new_file(target)
    file = writing.__enter__()
    file.write("new")
    writing.__exit__(KeyboardInterrupt, KeyboardInterrupt(), None)
    assert [(path.name, path.read_text(encoding="utf-8")) for path in tmp_path.iterdir()] == [("table.csv", "old")]


def test_a_link_is_followed(tmp_path):
    (tmp_path / "link.csv").symlink_to(tmp_path / "table.csv")
    with new_file(tmp_path / "link.csv") as file:
        file.write("new")
    assert (tmp_path / "link.csv").is_symlink()
    assert (tmp_path / "table.csv").read_text(encoding="utf-8") == "new"


def test_what_is_not_finite_is_null_in_json(capsys, strict):
    emit({"list": (1.0, math.inf), "array": np.array([math.nan, 2.0]), "number": np.float64(-math.inf), "none": None})
    assert strict(capsys.readouterr().out) == {"list": [1, None], "array": [None, 2], "number": None, "none": None}


def test_what_is_no_regular_file_is_not_replaced(tmp_path):
    pipe = tmp_path / "pipe.csv"  # stands for any device: as root, the real ones would be lost with the guard
    os.mkfifo(pipe)
    with pytest.raises(ModelError, match="not a regular file"), new_file(pipe):
        pass
    assert pipe.is_fifo()


def test_critical_tells_the_load_without_damping_and_the_limit_of_vanishing_damping(beal, result_of, written):
    model = written(
        'units = "nondimensional"\nsupport.nose = "clamped"\n[[stage]]\nlength = 1\nmass_per_length = 1\n'
        "bending_stiffness = 1\ninternal_damping = 0.01\n"
    )
    text = beal("critical", model).stdout
    assert "flutters at P L^2/EI = 10.9661117: mode 1 begins to grow at an angular frequency of 5.39971" in text
    assert "without its damping: flutters at P L^2/EI = 20.0509536: modes 1 and 2 meet" in text
    assert "in the limit of vanishing damping: flutters at P L^2/EI = 10.9388493: mode 1 begins to grow" in text
    found = result_of("critical", model, "--all")
    beside = [found[name]["critical_thrust"] for name in ("undamped", "vanishing_damping")]
    assert [found["critical_thrust"], *beside] == pytest.approx([10.96611165947, 20.0509536190, 10.9388493456])
    assert found["events"][0]["modes"] == [1, 1]


def test_critical_says_where_only_damping_bears_the_dead_loads(beal, result_of, written):
    model = written(
        'units = "nondimensional"\nsupport.nose = "clamped"\n[[stage]]\nlength = 1\nmass_per_length = 1\n'
        "bending_stiffness = 1\nexternal_damping = 10\n[[axial_load]]\nstation = 1\nforce = 21\ntangency = 1\n"
    )
    assert "without its damping: its dead loads alone make it unstable" in beal("critical", model).stdout
    found = result_of("critical", model)
    assert found["critical_thrust"] == pytest.approx(3.26885935, rel=1e-8)
    assert found["undamped"] is None
    assert found["vanishing_damping"] is None
