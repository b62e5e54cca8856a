"""What ``beal response --show`` reads off the motion."""

import csv

import numpy as np
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
START = ("--initial", "mode:1:0.01", "--duration", 4)


@pytest.fixture
def model(written):
    return written(MODEL)


def columns_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return {name: list(column) for name, *column in zip(*csv.reader(file), strict=True)}


def test_a_spectrum_peaks_at_the_frequency_of_the_mode_that_swings(model, result_of, tmp_path):
    first = result_of("modes", model, "--count", 1, "--thrust", 10)["angular_frequency"][0]
    found = result_of("response", model, *START, "--show", "spectrum", "-o", "lines.csv", "--figure", "lines.svg")
    frequency = np.array(found["spectrum"]["angular_frequency"])
    assert set(found["spectrum"]["sensors"]["imu"]) == {"elastic_displacement", "elastic_slope"}
    amplitude = np.array(found["spectrum"]["sensors"]["imu"]["elastic_displacement"])
    assert abs(frequency[amplitude.argmax()] - first) <= frequency[1]
    table = columns_of(tmp_path / "lines.csv")
    assert list(table) == ["angular_frequency", "imu_elastic_displacement", "imu_elastic_slope"]
    np.testing.assert_array_equal(np.array(table["imu_elastic_displacement"], dtype=float), amplitude)


def test_an_envelope_of_one_mode_is_flat(model, result_of, tmp_path):
    found = result_of("response", model, *START, "--thrust", 0, "--elastic", "--show", "envelope", "-o", "size.csv")
    size = found["envelope"]["imu"]["displacement"]
    largest = max(map(abs, found["sensors"]["imu"]["displacement"]))
    np.testing.assert_allclose(size["amplitude"], largest, rtol=1e-6)
    table = columns_of(tmp_path / "size.csv")
    assert set(table["sensor"]) == {"imu"}
    assert list(map(float, table["time"])) == size["time"]


def test_the_largest_line_is_told(model, beal_here):
    assert "strongest line at" in beal_here("response", model, *START, "--show", "spectrum").stdout
    assert "amplitude at" in beal_here("response", model, *START, "--elastic", "--show", "envelope").stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--show", "phase"), "--show: must be one of history, envelope, spectrum, found 'phase'"),
        (("--show", "envelope"), "--show envelope: a vehicle that flies drifts away; give --elastic"),
        (("--show", "envelope", "--elastic", "--quantity", "acceleration"), "--quantity: must be one of displacement,"),
        (("--quantity", "jerk"), "--quantity: must be one of displacement, rate"),
        (("--show", "spectrum", "-o", "a.nc"), "--output: envelopes and spectra are written as .csv, found .nc"),
        (("--show", "spectrum", "--step", 1, "--method", "exact"), "spectrum: needs at least 8 samples, found 5"),
    ],
)
@pytest.mark.filterwarnings("ignore:the output is aliased")
def test_what_cannot_be_read_is_refused(model, beal_here, tmp_path, options, message):
    done = beal_here("response", model, *START, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["model.toml"]
