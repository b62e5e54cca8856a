"""``beal response`` and ``beal amplitude``: views of a motion, reports, and a thrust that varies by the model file."""

import csv

import numpy as np
import pytest
import xarray

MODEL = """
units = "nondimensional"
[support]
nose = "clamped"
[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 1.0
[thrust]
nominal = 5.0
{thrust}
[[sensor]]
name = "tip"
station = 1.0
[[force]]
station = 1.0
signal = {{kind = "sine", amplitude = 0.01, angular_frequency = 2.0}}
{more}
"""
SWING = ("--duration", 20, "--initial", "mode:1:0.01")


@pytest.fixture
def model(written):
    return lambda thrust="", more="": written(MODEL.format(thrust=thrust, more=more))


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_a_spectrum_peaks_at_the_modes_frequency(model, result_of, tmp_path):
    found = result_of("response", model(), *SWING, "--thrust", 0, "--as", "spectrum", "-o", "lines.csv")
    omega, amplitude = np.array(found["angular_frequency"]), np.array(found["sensors"]["tip"]["displacement"])
    assert omega[amplitude.argmax()] == pytest.approx(3.516, abs=2 * np.pi / 20)
    written = rows(tmp_path / "lines.csv")
    assert [float(row["tip_displacement"]) for row in written] == pytest.approx(amplitude.tolist())


def test_an_envelope_is_the_amplitude_over_time(model, result_of, tmp_path):
    found = result_of("response", model(), *SWING, "--thrust", 22, "--as", "envelope", "-o", "growth.nc")
    amplitude = np.array(found["sensors"]["tip"]["displacement"])
    late = slice(len(amplitude) // 2, int(0.9 * len(amplitude)))
    rate = np.polyfit(np.array(found["time"])[late], np.log(amplitude[late]), 1)[0]
    assert rate == pytest.approx(found["growth_rate"], rel=0.02)
    with xarray.open_dataset(tmp_path / "growth.nc") as data:
        assert set(data.data_vars) == {"displacement", "rate", "slope"}


@pytest.mark.parametrize("view", ["histories", "envelope", "spectrum"])
def test_every_view_is_drawn(model, result_of, tmp_path, view):
    result_of("response", model(), *SWING, "--as", view, "--figure", "motion.svg")
    assert "<svg" in (tmp_path / "motion.svg").read_text(encoding="utf-8")


def test_the_signal_of_the_thrust_is_followed_by_responses_and_left_out_elsewhere(model, result_of, beal_here):
    pulsating = model('signal = {kind = "sine", amplitude = 2.5, angular_frequency = 8.4, phase = 1.5707963267948966}')
    found = result_of("response", pulsating, *SWING, "--method", "exact")
    assert result_of("response", pulsating, *SWING, "--thrust", 5)["thrust_history"][3] == 5.0
    done = beal_here("critical", pulsating)
    assert "the signal of the thrust is left out here; beal response follows it" in done.stderr
    same = result_of("response", model(), *SWING, "--method", "exact", "--thrust", "pulsating:5:2.5:8.4")
    assert found["sensors"]["tip"]["displacement"] == pytest.approx(same["sensors"]["tip"]["displacement"], rel=1e-9)
    assert found["growth_rate"] is None


def test_a_table_of_thrust_lies_beside_the_model(model, result_of, tmp_path):
    (tmp_path / "thrust.csv").write_text("time,value\n0,0\n10,5\n", encoding="utf-8")
    found = result_of("response", model('signal = {kind = "table", file = "thrust.csv"}'), *SWING)
    assert (found["thrust_history"][0], found["thrust_history"][-1]) == (5.0, 10.0)


def test_a_signal_needs_a_nominal_thrust(written, beal_here):
    text = MODEL.format(thrust='signal = {kind = "step", amplitude = 1}', more="").replace("nominal = 5.0", "")
    done = beal_here("response", written(text), *SWING)
    assert done.returncode == 2
    assert "thrust: signal: is added to the nominal thrust, which is missing" in done.stderr


def test_a_control_law_that_does_not_count_is_said_to_be_left_out(model, beal_here):
    law = '[control]\ngains = [{sensor = "tip", quantity = "slope", gain = 0.1}]'
    for command in (["critical"], ["modes"], ["response", *SWING], ["curve", "--to", 8, "--points", 3]):
        done = beal_here(command[0], model(more=law), *command[1:])
        assert "the control law is left out here; beal control closes the loop" in done.stderr
        assert done.returncode == 0
    assert "left out" not in beal_here("control", model(more=law)).stderr


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (["response", *SWING], "Amplitude of the elastic motion"),
        (["floquet", "--amplitude", 1, "--angular-frequency", 8.4], "Multipliers of a period"),
        (["floquet", "--amplitude", "0:1:3", "--angular-frequency", "8:9:3"], "Growth rate over frequency and amp"),
        (["control"], "Roots from no gain"),
    ],
)
def test_a_report_is_one_page_that_needs_nothing_else(model, result_of, tmp_path, command, words):
    law = '[control]\nlag = 0.01\ngains = [{sensor = "tip", quantity = "slope_rate", gain = 0.01}]'
    more = law if command == ["control"] else ""
    found = result_of(command[0], model(more=more), *command[1:], "--report", "page.html")
    assert found["report"] == "page.html"
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert words in page
    assert f"beal {command[0]}" in page  # the line that made it
    assert "bending_stiffness = 1.0" in page
    assert not any(f'{name}="http' in page for name in ("src", "href"))


def test_the_largest_motion_is_mapped_over_thrust_and_force(model, result_of, beal_here, tmp_path):
    options = ["--duration", 5, "--thrust", "0:10:3", "--force", "1:2:2"]
    found = result_of("amplitude", model(), *options, "-o", "map.csv", "--figure", "map.png")
    amplitude = np.array(found["amplitude"])
    assert amplitude.shape == (3, 2)
    assert amplitude[:, 1] == pytest.approx(2 * amplitude[:, 0])
    assert [float(row["largest_displacement"]) for row in rows(tmp_path / "map.csv")] == amplitude.ravel().tolist()
    assert (tmp_path / "map.png").is_file()
    assert "largest displacement at tip within 5: " in beal_here("amplitude", model(), *options).stdout


def test_a_vehicle_whose_attitude_diverges_is_not_called_stable(written, result_of):
    free = MODEL.format(thrust="tangency = 1.2", more="").replace('nose = "clamped"', 'nose = "free"')
    below, beyond = (
        result_of("response", written(free), "--duration", 15, "--thrust", thrust, "--method", "exact")
        for thrust in (25.0, 27.0)  # 25.638 is the critical one, of the rigid-body motion
    )
    assert below["growth_rate"] == 0.0
    time, slope = (np.array(row) for row in (beyond["time"], beyond["sensors"]["tip"]["slope"]))
    late = len(time) // 2
    rate = np.log(slope[-1] / slope[late]) / (time[-1] - time[late])
    assert beyond["growth_rate"] == pytest.approx(rate, rel=1e-3)
    elastic = result_of("response", written(free), "--duration", 1, "--thrust", 27, "--elastic")["growth_rate"]
    assert elastic == 0.0
