"""A control law is not left out without a word."""

import pytest

MODEL = """
units = "nondimensional"

[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 1.0

[thrust]
nominal = 10.0

[[sensor]]
name = "imu"
station = 0.5
"""
LAW = '[control]\ngains = [{sensor = "imu", quantity = "slope", gain = 1.0}]\n'
STUDY = 'model = "model.toml"\n[grid]\n"stage[0].length" = {from = 1, to = 2, points = 2}\n'
FLIGHT = "[timeline]\ntime = [0.0, 1.0]\nthrust = [1.0, 2.0]\n"
COMMANDS = {
    "critical": (),
    "curve": ("--to", 20, "--points", 3),
    "modes": (),
    "response": ("--duration", 0.1, "--initial", "mode:1:0.01"),
    "floquet": ("--amplitude", 1, "--angular-frequency", 44),
}
SAID = "control: the law is left out, the answer is that of the vehicle without it; beal control counts it"


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_that_leave_the_law_out_say_so(written, result_of, beal_here, command):
    options = COMMANDS[command]
    without = result_of(command, written(MODEL), *options)
    assert without.pop("notes") == []
    model = written(MODEL + LAW)
    found = result_of(command, model, *options)
    assert found.pop("notes") == [SAID]
    assert found == without
    assert beal_here(command, model, *options).stderr == f"beal: {SAID}\n"


def test_a_map_and_a_flight_say_so(written, result_of, beal_here):
    written(MODEL + LAW)
    study = written(STUDY, "study.toml")
    assert result_of("map", study, "-o", "silent.zarr")["notes"] == [SAID]
    assert SAID in beal_here("map", study, "-o", "map.zarr").stderr
    flight = written(MODEL + LAW + FLIGHT, "flight.toml")
    assert result_of("flight", flight)["notes"] == [SAID]
    assert SAID in beal_here("flight", flight).stderr


def test_the_page_of_a_run_says_so_too(written, beal_here, tmp_path):
    beal_here("response", written(MODEL + LAW), *COMMANDS["response"], "--report", "run.html")
    assert f'class="warning"><b>Take care</b><ul><li>{SAID}</li>' in (tmp_path / "run.html").read_text("utf-8")


def test_the_command_that_counts_the_law_is_silent(written, beal_here, result_of):
    model = written(MODEL + LAW)
    assert beal_here("control", model, "--modes", 2).stderr == ""
    assert "notes" not in result_of("control", model, "--modes", 2)
