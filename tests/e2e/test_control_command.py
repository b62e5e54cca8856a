"""``beal control`` as a user runs it."""

import pytest
import scipy.io
import xarray

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

[control]
gains = [{sensor = "imu", quantity = "slope", gain = 1.0}]
"""


@pytest.fixture
def model(written):
    return written(MODEL)


def test_the_roots_are_one_json_object(model, result_of):
    found = result_of("control", model, "--modes", 2)
    assert found["stable"]
    assert found["thrust"] == 10.0
    assert found["rigid_body_roots"] == [[0.0, 0.0], [0.0, 0.0]]
    upper = [imag for _, imag in found["roots"] if imag > 0]
    assert upper == pytest.approx([6.29797267869, 21.2865122364, 58.0224996778], rel=1e-9)
    assert found["least_damped"]["damping_ratio"] == pytest.approx(0.0, abs=1e-9)


def test_an_unstable_loop_is_said_to_grow(model, beal_here):
    printed = beal_here("control", model, "--thrust", "26").stdout
    assert "P = 26: unstable, its motion grows as exp(1.514 t); 2 zero roots of rigid-body drift" in printed


def test_roots_and_state_space_are_written(model, beal_here, tmp_path):
    done = beal_here("control", model, "-o", "roots.csv", "--state-space", "open.mat")
    assert "state space written to" in done.stderr
    assert (tmp_path / "roots.csv").read_text().startswith("real,imag,damping_ratio\n0.0,0.0,0.0\n")
    matrices = scipy.io.loadmat(tmp_path / "open.mat")
    assert matrices["A"].shape == (16, 16)
    assert [str(name[0][0]) for name in matrices["output"]] == [
        f"imu.{quantity}" for quantity in ("displacement", "rate", "slope", "slope_rate")
    ]


@pytest.mark.parametrize("options", [(), ("--over", "gain"), ("--over", "sensor[0].station", "--to", 0.9)])
def test_the_root_locus_is_drawn_beside_the_answer(model, result_of, tmp_path, options):
    found = result_of("control", model, "--figure", "locus.png", *options)
    assert found["figure"] == "locus.png"
    assert (tmp_path / "locus.png").read_bytes().startswith(b"\x89PNG")
    del found["figure"]
    assert found == result_of("control", model)


@pytest.mark.parametrize("drawn", ["nyquist", "nichols"])
def test_the_open_loop_is_drawn(written, result_of, tmp_path, drawn):
    damped = MODEL.replace("bending_stiffness = 1.0", "bending_stiffness = 1.0\ninternal_damping = 0.001")
    result_of("control", written(damped), "--figure", "open.svg", "--draw", drawn)
    assert "<svg" in (tmp_path / "open.svg").read_text(encoding="utf-8")


def test_a_map_over_thrust_and_a_station_is_told_drawn_and_written(model, result_of, beal_here, tmp_path):
    options = ["--map", "--over", "sensor[0].station", "--from", 0, "--to", 1, "--points", 3, "--max-thrust", 60]
    found = result_of("control", model, *options, "-o", "map.zarr", "--figure", "map.png")
    assert found["values"] == [0.0, 0.5, 1.0]
    assert [row[0] for row in found["border"]] == pytest.approx([16.936004, 25.638181377, 25.638181377])
    assert (tmp_path / "map.png").is_file()
    with xarray.open_zarr(tmp_path / "map.zarr") as chart:
        assert chart.stable.shape == (3, 3)
    assert "stable; up to P = 25.6382 with sensor[0].station = 0.5" in beal_here("control", model, *options).stdout
    again = beal_here("control", model, *options, "-o", "map.zarr")
    assert (again.returncode, "exists already" in again.stderr) == (2, True)


def test_margins_and_the_largest_thrust_are_told(written, result_of, beal_here):
    damped = MODEL.replace("bending_stiffness = 1.0", "bending_stiffness = 1.0\ninternal_damping = 0.001")
    model = written(damped.replace("[control]", "[control]\nlag = 0.01"))
    found = result_of("control", model, "--critical")
    assert set(found["margins"]["phase"][0]) == {"degrees", "angular_frequency", "mode", "delay"}
    assert set(found["critical"]) >= {"critical_thrust", "kind", "angular_frequency", "error_estimate"}
    assert "with the loop closed: " in beal_here("control", written(MODEL), "--critical").stdout


@pytest.mark.parametrize(
    ("change", "options", "message"),
    [
        (("[control]", "[kontrol]"), [], "kontrol: unknown key"),
        (('"slope", gain', '"acceleration", gain'), [], "control: must not be an algebraic loop"),
        (("gain = 1.0", "gain = inf"), [], "control.gains[0].gain"),
        (("nominal = 10.0", ""), [], "thrust: give one"),
        (("", ""), ["--thrust", "-3"], "thrust: must be finite and not negative, found -3"),
        (("", ""), ["--modes", "0"], "modes: must be at least 1"),
        (("", ""), ["--over", "gain"], "--over, --to, --draw: say what a figure shows"),
        (("", ""), ["--draw", "bode"], "--draw: must be one of locus, nyquist, nichols, found 'bode'"),
        (("", ""), ["--from", "1"], "--from, --max-thrust: are of a map; give --map"),
        (("", ""), ["--map"], "--over: the thrust is one axis of a map"),
        (("", ""), ["--map", "--over", "gain", "--to", "2"], "--from, --to: give both ends of the map along gain"),
        (("", ""), ["--map", "--over", "gain", "--from", "0", "--to", "2", "--points", "1"], "--points: must be at"),
        (
            ("nominal = 10.0", ""),
            ["--map", "--over", "gain", "--from", "0", "--to", "2"],
            "--max-thrust: give a positive",
        ),
        (("", ""), ["--figure", "a.png", "--over", "joint[0].shear_stiffness"], "joint[0].shear_stiffness"),
        (
            ("", ""),
            ["--figure", "a.png", "--to", "0"],
            "--to: must be a finite number other than the first, 0",
        ),
        (("", ""), ["--state-space", "open.csv"], "--state-space: must end with .mat or .nc, found .csv"),
    ],
)
def test_bad_input_is_told_in_one_message(written, beal_here, change, options, message):
    done = beal_here("control", written(MODEL.replace(*change, 1)), *options)
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("drawn", ["nyquist", "nichols"])
def test_without_thrust_nothing_is_controlled_and_nothing_breaks(written, result_of, beal_here, tmp_path, drawn):
    damped = MODEL.replace("bending_stiffness = 1.0", "bending_stiffness = 1.0\ninternal_damping = 0.001")
    model = written(damped)
    found = result_of("control", model, "--thrust", 0)
    assert found["stable"]
    assert found["rigid_body_roots"] == [[0.0, 0.0]] * 4  # nothing acts on translation and rotation
    assert "P = 0: stable; 4 zero roots" in beal_here("control", model, "--thrust", 0).stdout
    result_of("control", model, "--thrust", 0, "--draw", drawn, "--figure", "open.png")
    assert (tmp_path / "open.png").is_file()


def test_a_frequency_at_an_undamped_pole_is_left_out_of_the_plot(beal, tmp_path):
    beal("example", "tsto", "-o", "model.toml")
    gains = '[{sensor = "imu", quantity = "slope", gain = 0.5}]'
    with (tmp_path / "model.toml").open("a", encoding="utf-8") as file:
        file.write(f"\n[control]\nlag = 0.02\ngains = {gains}\n")
    done = beal("control", "model.toml", "--figure", "a.png", "--draw", "nyquist")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.png").stat().st_size > 10_000
