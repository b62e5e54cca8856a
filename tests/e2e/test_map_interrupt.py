"""Ctrl-C during a map keeps what is done, and --resume finishes it."""

import os
import signal
import subprocess
import sys
import time
from importlib.resources import files
from pathlib import Path

import pytest
import xarray

COMMAND = Path(sys.executable).with_name("beal")
# Ctrl-C must reach it also where the tests run in the background, which ignores that.
ON_ITS_OWN = {"start_new_session": True, "preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}
STUDY = """
model = "tsto.toml"
[grid]
"joint[0].rotational_stiffness" = {from = 10, to = 1e4, points = 5, spacing = "log"}
"joint[0].shear_stiffness" = {from = 1e2, to = 1e4, points = 256, spacing = "log"}
[solve]
formulation = "as-printed"  # each point by itself: time enough to interrupt between blocks
modes = 3
"""
POINTS = 5 * 256


@pytest.mark.parametrize("workers", [1, 2])
def test_an_interrupted_map_is_resumed(beal, result_of, written, tmp_path, workers):
    written((files("beal.vehicle.catalog") / "models" / "tsto.toml").read_text(encoding="utf-8"), "tsto.toml")
    arguments = ["map", written(STUDY, "study.toml"), "-o", "map.zarr", "--workers", str(workers)]
    output = tmp_path / "map.zarr"
    with subprocess.Popen(
        [COMMAND, *arguments], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **ON_ITS_OWN
    ) as run:
        while run.poll() is None and not done_blocks(output):
            time.sleep(0.01)
        os.killpg(run.pid, signal.SIGINT)  # as a terminal does: to the workers too
        printed, message = (text.decode() for text in run.communicate(timeout=60))
    assert (run.returncode, printed) == (130, "")
    assert message == "beal: interrupted; beal map study.toml -o map.zarr --resume goes on with it\n"
    kept = {path: path.stat().st_mtime_ns for path in done_blocks(output)}
    assert kept

    assert beal(*arguments).returncode == 2  # not without being asked to go on
    assert result_of(*arguments, "--resume")["status"]["solved"] == POINTS
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert len(kept) < len(done_blocks(output))
    with xarray.open_zarr(output) as found:
        assert set(found.status.values.ravel().tolist()) == {1}


def done_blocks(output):
    """The chunks of the status array that are there: one for each block that is finished."""
    return [path for path in (output / "status" / "c").glob("*/*") if path.name.isdigit()]
