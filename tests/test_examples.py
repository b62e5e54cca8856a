"""What the README and the examples show is what happens."""

import json
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

import beal
from test_manual import PAGES as MANUAL

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")}
NAMES = (
    *("clusters", "control", "design", "explorer", "flight", "interop", "maps", "model", "motion", "notebook"),
    *("pulsating", "sensitivity", "uncertainty", "design_study", "paper_question"),
)
CLUSTERS, CONTROL, DESIGN, EXPLORER, FLIGHT, INTEROP, MAPS, MODEL, MOTION, NOTEBOOK, *LATER = (
    PAGES.get(name, "") for name in NAMES
)
PULSATING, SENSITIVITY, UNCERTAINTY, STUDY, QUESTION = LATER
BEAL = [str(Path(sys.executable).with_name("beal"))]

PRINTED = {
    "critical_thrust.py": "k_r L/EI =    10: divergence at P L^2/EI = 63.245852, modes (1, 1)",
    "figures.py": "flutter of mode 1 at P L^2/EI = 80.12708",
    "imu_response.py": "P L^2/EI = 128: largest deflection",
    "overview.py": "flutter at P L^2/EI = 86.652119, modes (1, 2)",
}


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def blocks(language, page=README):
    return re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL)


@pytest.fixture
def readme_folder(tmp_path):
    (tmp_path / "two_stages.toml").write_text(blocks("toml")[0])
    return tmp_path


def test_every_console_command_of_the_readme_prints_what_is_shown(readme_folder):
    for block in blocks("console"):
        command, _, shown = block.partition("\n")
        words = shlex.split(command.removeprefix("$ "))
        printed = run([*BEAL, *words[1:]], readme_folder)
        assert words[0] == "beal"
        assert without_rounding(printed) == without_rounding(shown)


def without_rounding(text):
    """The relative error that rounding leaves differs between machines; everything else must be the same."""
    return re.sub(r"relative error about \S+", "relative error about ...", text).strip()


def test_the_python_of_the_readme_prints_what_it_says(readme_folder):
    for block in blocks("python"):
        expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
        assert run([sys.executable, "-c", block], readme_folder).strip() == expected


STAND_IN = """
import distributed
class SLURMCluster(distributed.LocalCluster):
    def __init__(self, cores, processes, memory, walltime):
        super().__init__(n_workers=2, threads_per_worker=1, dashboard_address=None)
    def scale(self, n=2, jobs=None):  # closing asks for none
        return super().scale(n)
"""


@pytest.fixture
def cluster_folder(readme_folder):
    (readme_folder / "joints.toml").write_text(blocks("toml", CLUSTERS)[0])
    (readme_folder / "dask_jobqueue.py").write_text(STAND_IN)  # a queue of jobs, on this machine
    return readme_folder


def test_every_page_of_the_docs_is_executed():
    assert sorted(PAGES) == sorted([*NAMES, *MANUAL, "verification"])
    assert set(re.findall(r"^```(\w+)$", FLIGHT, re.MULTILINE)) == {"toml", "csv", "console", "python"}
    assert set(re.findall(r"^```(\w+)$", CONTROL, re.MULTILINE)) == {"toml", "console", "python"}
    assert set(re.findall(r"^```(\w+)$", EXPLORER, re.MULTILINE)) == {"sh", "python"}
    assert set(re.findall(r"^```(\w+)$", DESIGN, re.MULTILINE)) == {"python", "text"}
    assert set(re.findall(r"^```(\w+)$", MODEL, re.MULTILINE)) == {"toml", "console"}
    assert "```" not in PAGES["verification"]  # all of it is output of beal verify
    assert set(re.findall(r"^```(\w+)$", PULSATING, re.MULTILINE)) == {"console", "python"}
    assert set(re.findall(r"^```(\w+)$", UNCERTAINTY, re.MULTILINE)) == {"toml", "console", "python"}
    assert set(re.findall(r"^```(\w+)$", MAPS, re.MULTILINE)) == {"toml", "console"}
    assert set(re.findall(r"^```(\w+)$", MOTION, re.MULTILINE)) == {"toml", "console", "python", "text"}
    assert set(re.findall(r"^```(\w+)$", NOTEBOOK, re.MULTILINE)) == {"python"}
    assert set(re.findall(r"^```(\w+)$", CLUSTERS, re.MULTILINE)) == {"toml", "console", "sh", "python"}
    assert set(re.findall(r"^```(\w+)$", INTEROP, re.MULTILINE)) == {"console", "python", "csv"}

    assert set(re.findall(r"^```(\w+)$", SENSITIVITY, re.MULTILINE)) == {"console", "python"}
    assert set(re.findall(r"^```(\w+)$", STUDY, re.MULTILINE)) == {"toml", "console"}
    assert "```" not in QUESTION  # its numbers are tested one by one


def test_the_command_of_the_page_on_uncertainty_prints_what_is_shown(tmp_path):
    for name, block in zip(("jointed", "scatter"), blocks("toml", UNCERTAINTY), strict=True):
        (tmp_path / f"{name}.toml").write_text(block)
    (block,) = blocks("console", UNCERTAINTY)
    command, _, shown = block.partition("\n")
    assert run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], tmp_path) == shown


def test_the_command_of_the_page_on_design_studies_prints_what_is_shown(tmp_path):
    for name, block in zip(("jointed", "joint"), blocks("toml", STUDY), strict=True):
        (tmp_path / f"{name}.toml").write_text(block)
    (block,) = blocks("console", STUDY)
    command, _, shown = block.partition("\n")
    assert run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], tmp_path) == shown
    page = (tmp_path / "joint.html").read_text(encoding="utf-8")
    assert page.count("<figure") == 3  # map, sensitivities, scatter
    assert "How stiff must the joint be" in page
    assert "&quot;joint[0].rotational_stiffness&quot; = {low = 1.0, high = 1e3" in page


def test_the_python_of_the_page_on_uncertainty_prints_what_it_says(tmp_path):
    (block,) = blocks("python", UNCERTAINTY)
    assert run([sys.executable, "-c", block], tmp_path).strip() == re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]


@pytest.fixture
def interop_folder(readme_folder):
    shutil.copy(EXAMPLES / "plain_stick.bdf", readme_folder)
    (readme_folder / "stations.csv").write_text(blocks("csv", INTEROP)[0])
    return readme_folder


def test_the_commands_of_the_page_on_other_programs_print_what_is_shown(interop_folder):
    for block in blocks("console", INTEROP):
        for shown in re.findall(r"^\$ .*\n(?:[^$].*\n)*", block, re.MULTILINE):
            command, _, expected = shown.partition("\n")
            words = shlex.split(command.removeprefix("$ "))
            assert words[0] == "beal"
            assert without_errors(run([*BEAL, *words[1:]], interop_folder)) == without_errors(expected)


def without_errors(text):
    """The error estimates that rounding leaves differ between machines."""
    return re.sub(r" *[\d.]+e-\d+ │", "│", text).strip()


@pytest.mark.parametrize("block", blocks("python", INTEROP))
def test_the_python_of_the_page_on_other_programs_prints_what_it_says(interop_folder, block):
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    assert run([sys.executable, "-c", block], interop_folder).strip() == expected


def test_the_vehicle_of_the_page_on_the_model_file_is_as_shown(tmp_path):
    (tmp_path / "sounder.toml").write_text(blocks("toml", MODEL)[0])
    for block in blocks("console", MODEL):
        command, _, shown = block.partition("\n")
        printed = run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], tmp_path)
        assert without_rounding(printed) == without_rounding(shown)


FORMS = [("engesser", "slope"), ("haringx", "slope")]
FORMS += [(term, along) for term in ("engesser", "haringx") for along in ("slope", "section")]


def test_the_columns_that_shear_of_the_page_on_the_model_file_are_true():
    for row in re.findall(r"^\| (1000|100|25) \| (.*) \|$", MODEL, re.MULTILINE):
        for column, (cell, (term, along)) in enumerate(zip(row[1].split("|"), FORMS, strict=True)):
            if cell.strip():
                stage = beal.Stage(
                    length=1.0,
                    mass_per_length=1.0,
                    bending_stiffness=1.0,
                    shear_stiffness=float(row[0]),
                    rotary_inertia_per_length=0.0025,
                )
                vehicle = beal.Vehicle(
                    units="nondimensional",
                    stages=[stage],
                    support=beal.Support(nose="clamped"),
                    point_masses=[beal.PointMass(station=1.0, mass=0.5)] if column > 1 else [],
                    thrust=beal.Thrust(along=along, axial_term=term),
                )
                assert f"{beal.critical_thrust(vehicle).critical_thrust:.6f}" == cell.strip()


def test_the_maps_of_the_page_on_maps_are_as_shown(readme_folder):
    (readme_folder / "study.toml").write_text(blocks("toml", MAPS)[0])
    for block in blocks("console", MAPS):
        command, _, shown = block.partition("\n")
        assert run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], readme_folder).strip() == shown.strip()


@pytest.mark.parametrize("block", blocks("console", PULSATING), ids=["point", "chart"])
def test_the_commands_of_the_page_on_pulsating_thrust_print_what_is_shown(readme_folder, block):
    command, _, shown = block.partition("\n")
    assert run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], readme_folder) == shown


def test_the_python_of_the_page_on_pulsating_thrust_prints_what_it_says(readme_folder):
    (block,) = blocks("python", PULSATING)
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    assert run([sys.executable, "-c", block], readme_folder).strip() == expected


def test_the_explorer_of_its_page_answers_as_it_says(readme_folder):
    (opened,), (asked,) = blocks("sh", EXPLORER), blocks("python", EXPLORER)
    command = [*BEAL, *shlex.split(opened)[1:], "--no-browser", "--json"]
    with subprocess.Popen(command, cwd=readme_folder, stdout=subprocess.PIPE, text=True) as server:
        address = json.loads(server.stdout.readline())["address"]
        try:
            printed = run([sys.executable, "-c", asked.replace("http://127.0.0.1:8050/", address)], readme_folder)
        finally:
            server.send_signal(signal.SIGINT)
        assert server.wait(timeout=20) == 130
    assert printed.strip() == re.findall(r"#\s*(.+)$", asked, re.MULTILINE)[-1]


@pytest.fixture
def flight_folder(tmp_path):
    (tmp_path / "launcher.toml").write_text(blocks("toml", FLIGHT)[0])
    (tmp_path / "ascent.csv").write_text(blocks("csv", FLIGHT)[0])
    return tmp_path


def test_the_flight_of_the_page_on_flights_is_as_shown(flight_folder):
    (block,) = blocks("console", FLIGHT)
    command, _, shown = block.partition("\n")
    printed = run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], flight_folder)
    assert [line.rstrip() for line in printed.splitlines()] == shown.splitlines()
    assert {"flight.csv", "flight.png"} < {path.name for path in flight_folder.iterdir()}


def test_the_python_of_the_page_on_flights_prints_what_it_says(flight_folder):
    (block,) = blocks("python", FLIGHT)
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    assert run([sys.executable, "-c", block], flight_folder).strip() == expected


def test_the_inline_timeline_of_the_page_on_flights_is_understood(flight_folder):
    model, inline = blocks("toml", FLIGHT)
    (flight_folder / "launcher.toml").write_text(model.partition("[timeline]")[0] + inline)
    assert "188.7" in run([*BEAL, "flight", "launcher.toml"], flight_folder)


@pytest.fixture
def control_folder(tmp_path):
    (tmp_path / "missile.toml").write_text(blocks("toml", CONTROL)[0])
    return tmp_path


@pytest.mark.parametrize("block", blocks("console", CONTROL))
def test_the_commands_of_the_page_on_the_control_loop_print_what_is_shown(control_folder, block):
    command, _, shown = block.partition("\n")
    printed = run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], control_folder)
    assert [line.rstrip() for line in printed.splitlines()] == shown.splitlines()


def test_the_largest_thrusts_of_the_page_on_the_control_loop_are_true():
    for gain, *cells in re.findall(r"^\| ([\d.]+) \|" + r" ([\d.]+) \|" * 5, CONTROL, re.MULTILINE):
        for station, cell in zip((0.0, 0.25, 0.5, 0.75, 1.0), cells, strict=True):
            law = beal.Control(gains=[beal.Gain(sensor="imu", quantity="slope", gain=float(gain))])
            sensors = (beal.Sensor(name="imu", station=station),)
            vehicle = beal.catalog.beal().model_copy(update={"sensors": sensors, "control": law})
            assert f"{beal.controlled_thrust(vehicle).critical_thrust:.6f}" == cell


@pytest.mark.parametrize("block", blocks("python", CONTROL))
def test_the_python_of_the_page_on_the_control_loop_prints_what_it_says(control_folder, block):
    expected = "\n".join(re.findall(r"^# (.+)$", block, re.MULTILINE))
    assert run([sys.executable, "-c", block], control_folder).strip() == expected


@pytest.mark.parametrize("block", blocks("python", NOTEBOOK))
def test_the_python_of_the_page_on_notebooks_prints_what_it_says(tmp_path, block):
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    assert run([sys.executable, "-c", block], tmp_path).strip() == expected


@pytest.fixture
def motion_folder(tmp_path):
    (tmp_path / "gust.toml").write_text(blocks("toml", MOTION)[0])
    return tmp_path


@pytest.mark.parametrize("block", blocks("console", MOTION))
def test_the_commands_of_the_page_on_motion_print_what_is_shown(motion_folder, block):
    command, _, shown = block.partition("\n")
    assert run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], motion_folder).strip() == shown.strip()


@pytest.mark.parametrize(("block", "shown"), list(zip(blocks("python", MOTION), blocks("text", MOTION), strict=True)))
def test_the_python_of_the_page_on_motion_prints_what_is_shown(motion_folder, block, shown):
    assert run([sys.executable, "-c", block], motion_folder).strip() == shown.strip()


@pytest.mark.parametrize(("block", "shown"), list(zip(blocks("python", DESIGN), blocks("text", DESIGN), strict=True)))
def test_the_python_of_the_page_on_design_prints_what_is_shown(tmp_path, block, shown):
    assert run([sys.executable, "-c", block], tmp_path).strip() == shown.strip()


@pytest.mark.parametrize("block", blocks("console", CLUSTERS))
def test_a_map_on_local_dask_workers_prints_what_is_shown(cluster_folder, block):
    command, _, shown = block.partition("\n")
    words = shlex.split(command.removeprefix("$ "))
    assert words[0] == "beal"
    assert run([*BEAL, *words[1:]], cluster_folder).strip() == shown.strip()


@pytest.mark.parametrize("block", blocks("sh", CLUSTERS))
def test_a_map_on_a_scheduler_of_its_own_is_made(cluster_folder, block):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        script = block.replace("8786", str(free.getsockname()[1])).replace(
            "scheduler --port", "scheduler --no-dashboard --port"
        )
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    shell = subprocess.Popen(
        ["bash", "-e", "-c", script],
        cwd=cluster_folder,
        env=os.environ | {"PATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    try:
        assert shell.stdout.readline() == "joints.zarr: 1600 points: 0 stable, 1237 flutter, 363 divergence\n"
        assert shell.wait(timeout=60) == 0
    finally:
        os.killpg(shell.pid, signal.SIGTERM)  # the scheduler and its workers
        shell.stdout.close()


@pytest.mark.parametrize("block", blocks("python", CLUSTERS), ids=["executor", "queue"])
def test_the_python_of_the_cluster_page_prints_what_it_says(cluster_folder, block):
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    (cluster_folder / "script.py").write_text(block)
    assert run([sys.executable, "script.py"], cluster_folder).strip() == expected


@pytest.mark.parametrize("formulation", ["as-printed", "corrected-ritz", "converged", "objective"])
def test_the_table_of_formulations_in_the_readme_is_right(readme_folder, formulation):
    shown = re.search(rf"\| `{formulation}` \| ([\d.]+) \|", README)
    printed = run([*BEAL, "critical", "two_stages.toml", "--formulation", formulation], readme_folder)
    value = re.search(r"= ([\d.]+):", printed)
    assert f"{float(value[1]):.2f}" == shown[1]


@pytest.mark.parametrize("script", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.name)
def test_an_example_runs_and_prints_its_answer(tmp_path, script):
    picture = tmp_path / "picture.png"
    assert PRINTED[script.name] in run([sys.executable, str(script), str(picture)], tmp_path)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_benchmark_runs(tmp_path):
    printed = run([sys.executable, str(ROOT / "benchmarks" / "critical_thrust.py"), "4"], tmp_path)
    assert "times the plain way's points per second" in printed


@pytest.mark.parametrize("model", ["two_stages.toml", "sounding_rocket.toml"])
@pytest.mark.parametrize("command", ["check", "modes", "critical"])
def test_an_example_model_is_understood_by_every_command(model, command):
    assert run([*BEAL, command, str(EXAMPLES / model)], EXAMPLES)


def test_the_example_study_gives_a_map(tmp_path):
    run([*BEAL, "map", str(EXAMPLES / "joint_map.toml"), "-o", str(tmp_path / "map.zarr")], tmp_path)
    assert (tmp_path / "map.zarr" / "critical_thrust").is_dir()


def test_the_command_of_the_page_on_sensitivities_prints_what_is_shown(readme_folder):
    (block,) = blocks("console", SENSITIVITY)
    command, _, shown = block.partition("\n")
    printed = run([*BEAL, *shlex.split(command.removeprefix("$ "))[1:]], readme_folder)
    assert [line.rstrip() for line in printed.splitlines()] == [line.rstrip() for line in shown.splitlines()]


def test_the_python_of_the_page_on_sensitivities_prints_what_it_says(readme_folder):
    (block,) = blocks("python", SENSITIVITY)
    expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
    assert run([sys.executable, "-c", block], readme_folder).strip() == expected
