"""A map on dask workers is the map of this machine, also when a worker dies or Ctrl-C comes."""

import os
import signal
import subprocess
import sys
import time
from importlib.resources import files
from pathlib import Path

import pytest

from beal.errors import ModelError
from beal.study.cluster import _executor

COMMAND = Path(sys.executable).with_name("beal")
# Ctrl-C must reach it also where the tests run in the background, which ignores that.
ON_ITS_OWN = {"start_new_session": True, "preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}
STUDY = """
model = "tsto.toml"
[grid]
"joint[0].rotational_stiffness" = {from = 10, to = 1e4, points = 5, spacing = "log"}
"joint[0].shear_stiffness" = {from = 1e2, to = 1e4, points = 60, spacing = "log"}
[solve]
formulation = "as-printed"  # each point by itself: time enough to interfere
modes = 3
"""
ON_DASK = ["map", "study.toml", "-o", "dask.zarr", "--scheduler", "local", "--workers", "2"]


@pytest.fixture
def undisturbed(result_of, written, tmp_path):
    written((files("beal.vehicle.catalog") / "models" / "tsto.toml").read_text(encoding="utf-8"), "tsto.toml")
    written(STUDY, "study.toml")
    result_of("map", "study.toml", "-o", "plain.zarr", "--workers", "1")
    return contents(tmp_path / "plain.zarr")


def contents(store):
    paths = (path for path in store.rglob("*") if path.is_file() and path.suffix != ".partial")
    return {str(path.relative_to(store)): path.read_bytes() for path in paths}


def begun(folder):
    run = subprocess.Popen(
        [COMMAND, *ON_DASK], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **ON_ITS_OWN
    )
    while run.poll() is None and not [*(folder / "dask.zarr" / "status" / "c").glob("*/*")]:
        time.sleep(0.01)
    return run


def workers_of(pid):
    """The worker processes that a process has started."""
    tasks = (path.read_text().split() for path in Path(f"/proc/{pid}/task").glob("*/children"))
    children = [int(child) for task in tasks for child in task]
    return [child for child in children if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes()]


def test_a_dask_worker_that_is_killed_costs_no_block(undisturbed, tmp_path):
    with begun(tmp_path) as run:
        os.kill(workers_of(run.pid)[0], signal.SIGKILL)
        printed, message = run.communicate(timeout=60)
    assert (run.returncode, b"Traceback" in message) == (0, False)  # dask itself may say that it lost one
    assert b"300 points" in printed
    assert contents(tmp_path / "dask.zarr") == undisturbed


def test_ctrl_c_on_a_cluster_says_how_to_go_on(undisturbed, tmp_path, result_of):
    with begun(tmp_path) as run:
        os.killpg(run.pid, signal.SIGINT)  # as a terminal does: to the workers too
        message = run.communicate(timeout=60)[1].decode()
    assert run.returncode == 130
    again = "beal map study.toml -o dask.zarr --scheduler local --resume"
    assert f"beal: interrupted; {again} goes on with it\n" in message  # dask may add a word on its own closing
    assert "Traceback" not in message
    assert result_of("map", "study.toml", "-o", "dask.zarr", "--resume")["status"]["solved"] == 300
    assert contents(tmp_path / "dask.zarr") == undisturbed


class Workers:
    """What a dask client says of its workers."""

    def __init__(self, **versions):
        self.versions = versions

    def wait_for_workers(self, number, timeout):
        if not self.versions:
            raise TimeoutError

    def run(self, function, *arguments, on_error):
        return self.versions


@pytest.mark.parametrize(
    ("workers", "message"),
    [
        (Workers(), "--scheduler: has no workers"),
        (Workers(one="0.0.1"), r"its workers need beal.*\none: has beal 0\.0\.1"),
        (Workers(one=ModuleNotFoundError("beal")), "one: has no beal"),
    ],
)
def test_workers_that_cannot_solve_the_study_are_refused(workers, message):
    with pytest.raises(ModelError, match=message):
        _executor(workers)
