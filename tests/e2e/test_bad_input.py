"""Every command on bad input: exit code 2 and a message that says where, what and what was expected."""

import sys

import pytest

from beal.study import cluster

STAGE = "[[stage]]\nlength = 1.0\nmass_per_length = 1.0\nbending_stiffness = 1.0\n"
PLAIN = 'units = "nondimensional"\n'
GOOD = PLAIN + STAGE
TWO = PLAIN + 2 * STAGE + "[[joint]]\nrotational_stiffness = 10.0\n"
JOINTLESS = PLAIN + 2 * STAGE
WITH_SENSOR = GOOD + '[[sensor]]\nname = "imu"\nstation = 0.5\n'


def refusal(done):
    """The message of a command that refused its input."""
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    return done.stderr


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["is empty", "[[stage]]"]),
        ("[[stage", ["not valid TOML"]),
        (GOOD + "colour = 1\n", ["stage[0].colour", "unknown key", "mass_per_length"]),
        (STAGE.replace("length = 1.0", 'length = "3 kg"', 1), ["stage[0].length", "3 kg", "converts to m"]),
        (GOOD.replace("length = 1.0", 'length = "3 m"', 1), ["stage[0].length", "plain numbers"]),
        (GOOD.replace("bending_stiffness = 1.0", "bending_stiffness = -1.0"), ["stage[0].bending_stiffness", "-1.0"]),
        (TWO.replace("10.0", "-10.0"), ["joint[0].rotational_stiffness", "-10.0", "greater than or equal to 0"]),
        (JOINTLESS, ["joint", "one fewer than the stages, 1", "found 0"]),
        (WITH_SENSOR.replace("0.5", "1.5"), ["sensor[0].station", "on the vehicle, 0 to 1", "1.5"]),
        (GOOD.replace("length = 1.0", "length = nan", 1), ["stage[0].length", "nan"]),
        (GOOD.replace("length = 1.0", "length = inf", 1), ["stage[0].length", "finite"]),
        (GOOD + "[thrust]\ntangency = 3.0\n", ["thrust.tangency", "3.0", "2"]),
        (GOOD + '[support]\nnose = "welded"\n', ["support.nose", "clamped", "welded"]),
    ],
)
def test_a_wrong_model_is_refused_with_the_place_and_what_was_expected(beal, written, text, expected):
    message = refusal(beal("critical", written(text)))
    assert [part for part in ["model.toml", *expected] if part not in message] == []


def test_all_errors_of_a_model_are_reported_at_once(beal, written):
    wrong = TWO.replace("10.0", "-10.0").replace("length = 1.0", "length = nan", 1) + "[thrust]\ncolour = 1\n"
    message = refusal(beal("check", written(wrong)))
    paths = ["stage[0].length", "joint[0].rotational_stiffness", "thrust.colour"]
    assert "3 problems" in message
    assert [path for path in paths if path not in message] == []


def test_check_reports_errors_as_json_too(beal, written, strict):
    done = beal("check", written(GOOD + "[thrust]\ntangency = 3.0\nnominal = -1\n"), "--json")
    assert done.returncode == 2
    assert [error["path"] for error in strict(done.stdout)["errors"]] == ["thrust.tangency", "thrust.nominal"]
    assert "thrust.tangency" in done.stderr


def test_a_missing_model_is_refused(beal):
    assert "nowhere.toml: cannot be read: No such file" in refusal(beal("critical", "nowhere.toml"))


def test_a_folder_is_no_model(beal, tmp_path):
    assert "cannot be read: Is a directory" in refusal(beal("critical", tmp_path))


def test_numbers_beyond_all_arithmetic_leave_no_traceback(beal, written):
    model = written(
        'units = "nondimensional"\n[[stage]]\nlength = 0.6\nmass_per_length = 1\nbending_stiffness = 1\n'
        "[[stage]]\nlength = 0.4\nmass_per_length = 1\nbending_stiffness = 1\n"
        "[[joint]]\nrotational_stiffness = 1e300\nshear_stiffness = 1e4\n"
    )
    done = beal("critical", model)
    assert done.returncode == 3
    assert "too large or too far apart" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_model_that_may_not_be_read_is_refused(beal):
    # Root may read what any permission forbids; a path through a file, nobody.
    assert "cannot be read: Not a directory" in refusal(beal("modes", "/dev/null/model.toml"))


def test_a_huge_file_is_no_model(beal, written):
    assert "larger than 5 MB" in refusal(beal("check", written("# filler\n" * 1_200_000)))


def test_a_binary_file_is_no_model(beal, tmp_path):
    (tmp_path / "model.toml").write_bytes(bytes(range(256)))
    assert "not text in UTF-8" in refusal(beal("check", "model.toml"))


@pytest.mark.parametrize("command", [("modes",), ("critical",), ("curve", "--to", "1")])
def test_an_unknown_formulation_is_refused_with_the_known_ones(beal, written, command):
    message = refusal(beal(command[0], written(TWO), *command[1:], "--formulation", "wrong"))
    assert "formulation: must be one of objective, converged, corrected-ritz, as-printed, found 'wrong'" in message


def test_a_paper_formulation_is_refused_with_the_reason_where_it_does_not_apply(beal, written):
    clamped = written(TWO + '[support]\nnose = "clamped"\n')
    message = refusal(beal("critical", clamped, "--formulation", "as-printed"))
    assert "free ends, found clamped nose and free tail" in message


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("modes", "--count", "0"), "count: must lie between 1 and 40, found 0"),
        (("modes", "--count", "1000000000"), "count: must lie between 1 and 40"),
        (("modes", "--count", "many"), "Invalid value for '--count'"),
        (("modes", "--thrust", "nan"), "thrust: must be a finite number, found nan"),
        (("modes", "--thrust", "1", "--loaded"), "--thrust: is given beside --loaded"),
        (("modes", "--loaded"), "thrust.nominal: is needed by --loaded"),
        (("critical", "--max-thrust", "-1"), "max_thrust: must be a positive number, found -1"),
        (("critical", "--max-thrust", "nan"), "max_thrust: must be a positive number, found nan"),
        (("critical", "--max-thrust", "1e9"), "max_thrust: at most"),
        (("critical", "--modes", "6"), "modes: applies to corrected-ritz and as-printed only"),
        (("critical", "--modes", "0", "--formulation", "as-printed"), "order: must be at least 1, found 0"),
        (("critical", "--growth", "1e4"), "thrust: must lie below the critical one, found 10000"),
        (("critical", "--colour"), "No such option: --colour"),
        (("curve", "--to", "-3"), "to: must be a positive thrust, found -3"),
        (("curve", "--to", "3", "--points", "1"), "points: must be at least 2, found 1"),
        (("curve", "--to", "3", "--modes", "0"), "modes: must lie between 1 and"),
        (("curve",), "Missing option '--to'"),
        (("response", "--duration", "0"), "duration: must be positive and finite, found 0"),
        (("response", "--duration", "1", "--method", "euler"), "method: must be one of newmark, exact, found 'euler'"),
        (
            ("response", "--duration", "1", "--initial", "mode:1:1", "--quantity", "jerk"),
            "--quantity: must be one of displacement, rate, acceleration, slope, slope_rate, rigid_displacement,",
        ),
        (
            ("response", "--duration", "1", "--initial", "mode:1:1", "--as", "envelope", "--quantity", "acceleration"),
            "--quantity: must be one of displacement, rate, slope, found 'acceleration'",
        ),
        (("response", "--duration", "1", "--as", "sound"), "--as: must be one of histories, envelope, spectrum, found"),
        (("response", "--duration", "1", "--report", "a.pdf"), "--report: must end with .html, found .pdf"),
        (("amplitude", "--duration", "1", "--thrust", "5:1:3"), "--thrust: must be a number, or a grid"),
        (("amplitude", "--duration", "1", "--thrust", "5", "--figure", "a.png"), "--figure: draws a map over grids"),
        (("response", "--duration", "1", "--thrust", "much"), "--thrust: expected a number, ramp:FROM:TO:TIME, pulsat"),
        (("response", "--duration", "1", "--thrust", "ramp:1:2"), "expected a number, ramp:FROM:TO:TIME"),
        (("response", "--duration", "1", "--thrust", "ramp:1:2:x"), "CSV file, found 'ramp:1:2:x'"),
        (("response", "--duration", "1", "--thrust", "pulsating:-1:2:3"), "its mean not negative"),
        (("response", "--duration", "1", "--thrust", "pulsating:2:1:0"), "angular frequency must be positive, found 0"),
        (("response", "--duration", "1", "--thrust", "none.csv"), "none.csv: cannot be read: No such file"),
        (("response", "--duration", "1"), "initial: nothing moves the vehicle"),
        (("response", "--duration", "1", "--initial", "jump"), "expected mode:NUMBER:AMPLITUDE or release"),
        (("response", "--duration", "1", "--initial", "mode:first:1"), "with numbers, found 'mode:first:1'"),
        (
            ("response", "--duration", "1", "--thrust", "1", "--initial", "mode:1:nan"),
            "initial: amplitude must be finite",
        ),
        (("response", "--duration", "1", "--initial", "mode:1:1"), "thrust: give one, or set thrust.nominal"),
    ],
)
def test_a_wrong_option_is_refused(beal_here, written, arguments, expected):
    model = TWO + '[[sensor]]\nname = "imu"\nstation = 0.5\n'
    message = refusal(beal_here(arguments[0], written(model), *arguments[1:]))
    assert expected in " ".join(message.replace("│", " ").split())


def test_a_response_without_sensors_is_refused(beal, written):
    message = refusal(beal("response", written(GOOD), "--duration", "1", "--thrust", "1", "--initial", "mode:1:1"))
    assert "sensor: a response is read at sensors, found none" in message


def test_an_unknown_command_is_refused(beal):
    assert "No such command 'fly'" in refusal(beal("fly"))


def test_an_unknown_example_is_refused_with_the_known_ones(beal):
    assert "NAME: must be one of beck, beal, pflueger, tsto, generic_small_launcher, found 'saturn'" in refusal(
        beal("example", "saturn")
    )


def test_an_example_does_not_overwrite_a_model(beal, written, tmp_path):
    assert "exists already" in refusal(beal("example", "beck", "-o", written("mine")))
    assert (tmp_path / "model.toml").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("output", [".", "nowhere/out.csv", "/dev/null/out.csv", "/proc/out.csv", "model.toml/out.csv"])
@pytest.mark.parametrize(
    "command",
    [
        ("curve", "model.toml", "--to", "1", "--points", "2"),
        ("response", "model.toml", "--duration", "0.1", "--thrust", "1", "--initial", "mode:1:1"),
    ],
    ids=["curve", "response"],
)
def test_an_output_that_cannot_be_written_is_refused(beal, written, tmp_path, command, output):
    written(WITH_SENSOR)
    assert f"{output}: cannot be written" in refusal(beal(*command, "-o", output))
    assert [path.name for path in tmp_path.iterdir()] == ["model.toml"]


def test_an_example_that_cannot_be_written_is_refused(beal):
    assert "/dev/null/out.toml: cannot be written" in refusal(beal("example", "beck", "-o", "/dev/null/out.toml"))


def test_a_failed_run_leaves_no_output(beal, written, tmp_path):
    refusal(beal("curve", written(GOOD), "--to", "-1", "-o", "curve.csv"))
    assert [path.name for path in tmp_path.iterdir()] == ["model.toml"]


STUDY = 'model = "model.toml"\n[grid]\n"joint[0].rotational_stiffness" = {values = [1.0, 10.0]}\n'


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["study.toml"]),
        (STUDY.replace("model.toml", "nowhere.toml"), ["nowhere.toml", "cannot be read"]),
        (STUDY.replace("joint[0]", "joint[3]"), ["joint[3].rotational_stiffness", "1 joint"]),
        (STUDY.replace("rotational_stiffness", "colour"), ["joint[0].colour", "not a quantity"]),
        (STUDY.replace("[1.0, 10.0]", "[]"), ["joint[0].rotational_stiffness", "at least one value"]),
        (STUDY.replace("values = [1.0, 10.0]", "from = 1"), ["joint[0].rotational_stiffness", "from, to and points"]),
        (STUDY + '[solve]\nformulation = "wrong"\n', ["solve.formulation", "as-printed"]),
        (STUDY + "[solve]\ncolour = 1\n", ["solve.colour", "unknown key"]),
    ],
)
def test_a_wrong_study_is_refused(beal_here, written, tmp_path, text, expected):
    written(TWO)
    message = refusal(beal_here("map", written(text, "study.toml"), "-o", "map.zarr"))
    assert [part for part in expected if part not in message] == []
    assert not (tmp_path / "map.zarr").exists()


@pytest.mark.parametrize("output", ["model.toml", "nowhere/map.zarr", "/dev/null/map.zarr", "/proc/map.zarr", "."])
def test_a_map_that_cannot_be_written_is_refused(beal_here, written, output):
    written(TWO)
    message = refusal(beal_here("map", written(STUDY, "study.toml"), "-o", output))
    assert f"{output}: " in message


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["--scheduler", "here"], ["--scheduler: must be local or an address", "'here'"]),
        (["--scheduler", "tcp://127.0.0.1:1", "--workers", "2"], ["--workers: a scheduler has its own workers"]),
        (["--scheduler", "tcp://127.0.0.1:1"], ["--scheduler: none answers at tcp://127.0.0.1:1"]),
    ],
)
def test_a_scheduler_that_is_none_is_refused(beal_here, written, tmp_path, monkeypatch, options, expected):
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    written(TWO)
    message = refusal(beal_here("map", written(STUDY, "study.toml"), "-o", "map.zarr", *options))
    assert [part for part in expected if part not in message] == []
    assert not (tmp_path / "map.zarr").exists()


def test_a_scheduler_without_dask_names_the_extra(beal_here, written, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    written(TWO)
    message = refusal(beal_here("map", written(STUDY, "study.toml"), "-o", "map.zarr", "--scheduler", "local"))
    assert "install beal[cluster]" in message


@pytest.mark.parametrize("output", ["model.toml", "model.toml/out", "/dev/null/out", "/proc/out"])
def test_a_reproduction_that_cannot_be_written_is_refused(beal, written, output):
    written(GOOD)
    assert output in refusal(beal("reproduce", "-o", output, "--points", "4"))


def test_a_reproduction_on_too_coarse_a_grid_is_refused(beal, tmp_path):
    assert "--points" in refusal(beal("reproduce", "-o", "out", "--points", "2"))
    assert not (tmp_path / "out").exists()
