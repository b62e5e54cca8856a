"""Killed at any moment, a map loses at most the blocks in work: resumed, it is the undisturbed one, byte for byte."""

import multiprocessing
import os
import signal
import time
from pathlib import Path

import pytest

import beal
from beal.study import blocks, run

AXES = {
    "joint[0].rotational_stiffness": [10.0, 1e2, 1e3, 1e4],
    "joint[0].shear_stiffness": [100.0 * 1.1**n for n in range(20)],
}
KILLS = 8  # of each kind


def solve(out, resume=False):
    vehicle = beal.catalog.tsto(0.6, 5000.0, 5000.0)  # each point by itself, in processes
    beal.stability_map(vehicle, AXES, formulation="as-printed", modes=3, out=out, resume=resume, workers=2)


def in_its_own_group(out):
    os.setsid()
    solve(out)


def started(out):
    child = multiprocessing.get_context("fork").Process(target=in_its_own_group, args=(out,))
    child.start()
    return child


def files(out):
    """What is in the store; a writer that was killed leaves a part under another name, which nobody reads."""
    paths = (path for path in Path(out).rglob("*") if path.is_file() and path.suffix != ".partial")
    return {str(path.relative_to(out)): path.read_bytes() for path in paths}


def workers_of(pid):
    """Processes that a process has started, or none if it has ended."""
    try:
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


@pytest.fixture(scope="module", autouse=True)
def small_blocks():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(blocks, "SHORT", 0.03)
        patch.setattr(blocks, "LONG", 0.03)
        patch.setattr(run, "SMALL", 0.0)
        yield


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Files of a run that nobody kills, and the seconds that it takes."""
    out = tmp_path_factory.mktemp("undisturbed") / "map.zarr"
    start = time.monotonic()
    child = started(out)
    child.join()
    return files(out), time.monotonic() - start


@pytest.mark.parametrize("share", [(n / KILLS) ** 2 for n in range(KILLS)])
@pytest.mark.parametrize("who", ["group", "parent", "worker"])
def test_a_killed_map_is_resumed_to_the_same_bytes(tmp_path, undisturbed, who, share):
    expected, seconds = undisturbed
    out = tmp_path / "map.zarr"
    child = started(out)
    time.sleep(share * seconds)
    workers = workers_of(child.pid)
    if who == "worker" and workers:
        os.kill(workers[0], signal.SIGKILL)
        child.join()
        assert child.exitcode == 0
        assert files(out) == expected  # without being resumed: another worker takes over
        return
    child.kill()
    if who == "group":
        for pid in workers:
            os.kill(pid, signal.SIGKILL) if alive(pid) else None
    child.join()
    solve(out, resume=True)
    assert files(out) == expected
    for _ in range(100):
        if not any(map(alive, workers)):
            break
        time.sleep(0.05)
    assert not any(map(alive, workers))  # nobody goes on alone
