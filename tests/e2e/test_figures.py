"""``--figure``: what commands draw beside their answer."""

import sys
from importlib.resources import files

import numpy as np
import pytest

from beal.cli.figures import curve_figure, modes_figure, response_figure, vehicle_figure
from beal.discretisation import discretise
from beal.motion import ModeShape, response
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.spectrum import spectrum
from beal.vehicle import Damping, Sensor, catalog

COMMANDS = {
    "check": (),
    "modes": ("--count", 2, "--thrust", 120),
    "critical": (),
    "curve": ("--to", 150, "--points", 11),
    "sensitivity": (),
    "response": ("--duration", 0.5, "--initial", "mode:1:0.01"),
}
BEGINNINGS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.fixture
def tsto(written):
    return written((files("beal.vehicle.catalog") / "models" / "tsto.toml").read_text(encoding="utf-8"), "tsto.toml")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_draws_its_answer(result_of, tsto, tmp_path, command):
    found = result_of(command, tsto, *COMMANDS[command], "--figure", "drawn.png")
    assert found["figure"] == "drawn.png"
    assert (tmp_path / "drawn.png").read_bytes().startswith(BEGINNINGS["png"])
    del found["figure"]
    assert found == result_of(command, tsto, *COMMANDS[command])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["drawn.png", "tsto.toml"]


@pytest.mark.parametrize("ending", BEGINNINGS)
def test_the_ending_says_the_kind_of_figure(beal_here, tsto, tmp_path, ending):
    done = beal_here("check", tsto, "--figure", f"drawn.{ending}")
    assert (done.returncode, done.stderr) == (0, f"beal: figure written to drawn.{ending}\n")
    first = (tmp_path / f"drawn.{ending}").read_bytes()
    assert first.startswith(BEGINNINGS[ending])
    beal_here("check", tsto, "--figure", f"drawn.{ending}")
    assert (tmp_path / f"drawn.{ending}").read_bytes() == first


def test_a_table_and_a_figure_are_written_together(beal_here, tsto, tmp_path):
    done = beal_here("modes", tsto, "-o", "shapes.csv", "--figure", "shapes.pdf")
    assert done.returncode == 0
    assert (tmp_path / "shapes.csv").read_text().startswith("station,displacement_1")
    assert (tmp_path / "shapes.pdf").exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_another_ending_is_refused_with_those_that_are_known(beal_here, tsto, tmp_path, command):
    done = beal_here(command, tsto, *COMMANDS[command], "--figure", "drawn.jpeg")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "beal: drawn.jpeg: --figure: must end with one of .png, .svg, .pdf, found .jpeg\n"
    assert not (tmp_path / "drawn.jpeg").exists()


def test_a_figure_in_a_folder_that_is_not_there_is_refused(beal_here, tsto):
    done = beal_here("check", tsto, "--figure", "nowhere/drawn.png")
    assert done.returncode == 2
    assert done.stderr.startswith("beal: nowhere/drawn.png: cannot be written: No such file or directory;")


def test_a_wrong_model_leaves_no_figure(beal_here, written, tmp_path):
    assert beal_here("check", written("[[stage]]\n"), "--figure", "drawn.png").returncode == 2
    assert [path.name for path in tmp_path.iterdir()] == ["model.toml"]


def test_without_matplotlib_the_message_says_what_to_install(beal_here, tsto, monkeypatch):
    for name in [name for name in sys.modules if name.startswith(("beal.plot", "matplotlib"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    done = beal_here("check", tsto, "--figure", "drawn.png")
    assert done.returncode == 2
    assert done.stderr == "beal: --figure: needs matplotlib, which is not installed; install beal[plot]\n"


def study(tsto, *axes):
    values = '{from = 1, to = 1e4, points = 3, spacing = "log"}'
    return f'model = "{tsto}"\n[grid]\n' + "\n".join(f'"joint[0].{axis}_stiffness" = {values}' for axis in axes)


@pytest.mark.parametrize("refine", [(), ("--refine", 0.1)])
def test_a_map_is_drawn(result_of, written, tsto, tmp_path, refine):
    written(study(tsto, "rotational", "shear"), "study.toml")
    found = result_of("map", "study.toml", "-o", "map.zarr", *refine, "--figure", "map.svg")
    assert found["figure"] == "map.svg"
    assert (tmp_path / "map.svg").read_bytes().startswith(BEGINNINGS["svg"])


def test_a_map_over_one_axis_is_refused_before_it_is_computed(beal_here, written, tsto, tmp_path):
    written(study(tsto, "shear"), "study.toml")
    done = beal_here("map", "study.toml", "-o", "map.zarr", "--figure", "map.svg")
    assert done.returncode == 2
    assert done.stderr == "beal: --figure: draws maps over two axes of more than one value each, found 3\n"
    assert not (tmp_path / "map.zarr").exists()


def curves(vehicle):
    curve = thrust_curve(vehicle, to=120.0, points=11, modes=2)
    return curve_figure(vehicle, curve, critical_thrust(vehicle), critical_events(vehicle, 120.0))


def test_a_damped_vehicle_has_a_root_locus_beside_its_curves():
    vehicle = catalog.beal()
    assert [ax.get_ylabel().split()[0] for ax in curves(vehicle).axes] == ["frequency", "growth"]
    damped = vehicle.model_copy(update={"damping": Damping(ratios=[0.01])})
    drawn = [ax.get_ylabel().split()[0] for ax in curves(damped).axes]
    assert drawn == ["frequency", "growth", "imaginary", "thrust"]


def test_every_sensor_has_a_column_of_histories():
    sensors = (Sensor(name="imu", station=0.2), Sensor(name="rate gyro", station=0.7))
    vehicle = catalog.beal().model_copy(update={"sensors": sensors})
    figure = response_figure(response(vehicle, 0.5, 50.0, initial=ModeShape(1, 1e-3)), nondimensional=True)
    assert [ax.get_title(loc="left") for ax in figure.axes[:2]] == ["imu", "rate gyro"]
    assert len(figure.axes) == 6


def test_a_figure_shows_the_quantities_that_are_asked_for():
    vehicle = catalog.tsto(0.6, 5000.0, 5000.0)
    moved = response(vehicle, 0.1, 50.0, initial=ModeShape(1, 1e-3))
    figure = response_figure(moved, True, ["acceleration", "slope_rate"])
    assert [ax.get_ylabel().split()[0] for ax in figure.axes] == ["acceleration", "slope"]
    np.testing.assert_array_equal(figure.axes[0].lines[-1].get_ydata(), moved.acceleration[0])


def test_drawings_have_the_height_that_they_need():
    operators = discretise(catalog.beal())
    heights = [modes_figure(spectrum(operators, 0.0, n), operators).get_figheight() for n in (1, 2, 3)]
    assert heights[2] - heights[1] == pytest.approx(heights[1] - heights[0])
    assert vehicle_figure(catalog.beal()).get_figheight() < 2.0
