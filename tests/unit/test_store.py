"""Maps on disk: nothing solved is lost, and a resumed map is the map."""

import os
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import xarray
import zarr

import beal
from beal.study import blocks, store, variables
from beal.study.map import run_study
from beal.study.study import Solve, Study
from beal.study.variables import VARIABLES

ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
VEHICLE = beal.catalog.tsto(0.6, 5000.0, 5000.0)
AXES = {ROTATIONAL: np.geomspace(1, 1e4, 30), SHEAR: np.geomspace(1e2, 1e4, 30)}


class Stop(KeyboardInterrupt):
    """What Ctrl-C raises."""


def stop_after(points):
    def progress(done, total):
        if done >= points:
            raise Stop

    return progress


def same(one, other):
    return all(np.array_equal(one[name].values, other[name].values, equal_nan=True) for name in VARIABLES)


@pytest.fixture(scope="module", autouse=True)
def small_blocks():
    """Of a hundred points."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(blocks, "SHORT", 1e-3)
        patch.setattr(blocks, "LONG", 1e-3)
        yield


@pytest.fixture(scope="module")
def undisturbed():
    return beal.stability_map(VEHICLE, AXES, workers=1)


def test_a_map_on_disk_opens_with_xarray_and_equals_the_one_in_memory(tmp_path, undisturbed):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, AXES, out=out, workers=1)
    opened = xarray.open_zarr(str(out))
    assert same(opened, undisturbed)
    assert opened[ROTATIONAL].values == pytest.approx(AXES[ROTATIONAL], rel=1e-15)
    assert opened.attrs == undisturbed.attrs
    assert opened["kind"].attrs["flag_meanings"] == "stable flutter divergence"


def test_any_workers_give_the_same_bits(undisturbed):
    assert same(beal.stability_map(VEHICLE, AXES, workers=2), undisturbed)
    with ThreadPoolExecutor(3) as threads:
        assert same(beal.stability_map(VEHICLE, AXES, executor=threads), undisturbed)


def test_an_executor_brings_its_own_workers():
    with ThreadPoolExecutor(1) as threads, pytest.raises(beal.ModelError, match="workers: an executor brings its own"):
        beal.stability_map(VEHICLE, AXES, executor=threads, workers=2)


@pytest.mark.parametrize("protocol", ["file", "local"])
def test_a_url_of_a_folder_is_that_folder(tmp_path, undisturbed, protocol):
    beal.stability_map(VEHICLE, AXES, out=f"{protocol}://{tmp_path}/map.zarr")
    assert same(xarray.open_zarr(str(tmp_path / "map.zarr")), undisturbed)


def test_a_map_at_a_url_is_resumed_to_the_same_bits(undisturbed):
    out = "memory://resumed/map.zarr"
    with pytest.raises(Stop):
        beal.stability_map(VEHICLE, AXES, out=out, progress=stop_after(300))
    with pytest.raises(beal.ModelError, match="exists already"):
        beal.stability_map(VEHICLE, AXES, out=out)
    assert same(beal.stability_map(VEHICLE, AXES, out=out, resume=True), undisturbed)


@pytest.mark.parametrize("url", ["s3://bucket/map.zarr", "nowhere://map.zarr"])
def test_a_url_that_cannot_be_opened_is_refused_with_the_reason(url):
    with pytest.raises(beal.ModelError, match=f"{url}: cannot be opened"):
        beal.stability_map(VEHICLE, AXES, out=url)


@pytest.mark.parametrize(
    "vehicle",
    [VEHICLE, beal.load(Path(__file__).parents[2] / "examples" / "sounding_rocket.toml")],
    ids=["nondimensional", "SI"],
)
def test_a_worker_finds_the_whole_study_in_the_store(tmp_path, vehicle):
    axes = {"thrust.tangency": tuple(np.linspace(0, 1, 3).tolist()), "stage[0].bending_stiffness": (0.1, 1 / 3)}
    study = Study(vehicle, axes, Solve(70.0))
    found = store.prepare(tmp_path / "map.zarr", study, False).study
    assert (found, list(found.axes)) == (study, list(study.axes))


def test_the_summary_counts_what_was_solved_before_too(tmp_path, undisturbed):
    study = Study(VEHICLE, {path: tuple(values.tolist()) for path, values in AXES.items()}, Solve())
    with pytest.raises(Stop):
        run_study(study, tmp_path / "map.zarr", progress=stop_after(300))
    summary = run_study(study, tmp_path / "map.zarr", resume=True)
    assert summary.named() == {
        "points": 900,
        "status": {"pending": 0, "solved": 900, "not_converged": 0, "invalid": 0},
        "kind": {name: int(np.sum(undisturbed["kind"] == n)) for n, name in enumerate(variables.KINDS)},
        "method": {name: int(np.sum(undisturbed["method"] == n + 1)) for n, name in enumerate(variables.METHODS[1:])},
        "lowest": float(undisturbed["critical_thrust"].min()),
        "highest": float(undisturbed["critical_thrust"].max()),
    }


def test_a_map_whose_making_was_cut_short_is_not_there(tmp_path, monkeypatch):
    out = tmp_path / "map.zarr"
    with monkeypatch.context() as patch:
        patch.setattr(zarr, "consolidate_metadata", lambda place: os.close(-1))
        with pytest.raises(beal.ModelError, match="cannot be written"):
            beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)
    assert list(tmp_path.iterdir()) == []
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out, resume=True)


def test_what_killed_programs_left_is_removed_when_it_is_old(tmp_path):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)
    old = [tmp_path / ".map.zarr.1.part", out / "status" / "c" / "0.1.partial"]
    new = [tmp_path / ".map.zarr.2.part", out / "status" / "c" / "0.2.partial"]
    for path in (*old, *new):
        path.mkdir() if path.suffix == ".part" else path.touch()
    for path in old:
        os.utime(path, (time.time() - 3600,) * 2)
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out, resume=True)
    assert [path.exists() for path in (*old, *new)] == [False, False, True, True]


def test_a_map_of_another_version_is_not_resumed(tmp_path, monkeypatch):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)
    monkeypatch.setattr(store, "version", lambda name: "99.0")
    with pytest.raises(beal.ModelError, match=r"beal_version.*was \S+, is 99\.0"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out, resume=True)


@pytest.mark.parametrize("workers", [1, 2])
def test_an_interrupted_map_resumes_to_the_same_bits(tmp_path, undisturbed, workers):
    out = tmp_path / "map.zarr"
    with pytest.raises(Stop):
        beal.stability_map(VEHICLE, AXES, out=out, workers=workers, progress=stop_after(300))
    kept = int(np.sum(xarray.open_zarr(str(out))["status"].values > 0))
    assert 300 <= kept < 900
    seen = []
    resumed = beal.stability_map(
        VEHICLE, AXES, out=out, resume=True, workers=workers, progress=lambda done, total: seen.append(done)
    )
    assert seen[0] == kept
    assert same(resumed, undisturbed)


def test_a_full_disk_keeps_what_was_solved(tmp_path, undisturbed, monkeypatch):
    out = tmp_path / "map.zarr"
    write = zarr.Array.__setitem__
    writes = []

    def full(array, *arguments):
        writes.append(1)
        if len(writes) > 2 + len(VARIABLES) + 3:  # two axes, one whole block, a third of the next
            raise OSError(28, "No space left on device")
        write(array, *arguments)

    with monkeypatch.context() as patch:
        patch.setattr(zarr.Array, "__setitem__", full)
        with pytest.raises(beal.ModelError, match=r"No space left on device.*kept.*--resume"):
            beal.stability_map(VEHICLE, AXES, out=out, workers=1)
    assert np.any(xarray.open_zarr(str(out))["status"].values > 0)
    assert same(beal.stability_map(VEHICLE, AXES, out=out, resume=True, workers=1), undisturbed)


def test_an_existing_map_is_not_overwritten(tmp_path):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)
    with pytest.raises(beal.ModelError, match="exists already"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)


def test_resuming_with_other_inputs_says_what_changed(tmp_path):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out)
    with pytest.raises(beal.ModelError, match=r"solve\.tolerance.*was 1e-06, is 0\.001"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out, resume=True, tolerance=1e-3)


@pytest.mark.parametrize("make", ["file", "folder"])
def test_what_is_not_a_map_is_not_resumed(tmp_path, make):
    out = tmp_path / "other"
    if make == "file":
        out.write_text("something else")
    else:
        out.mkdir()
    with pytest.raises(beal.ModelError, match="other"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=out, resume=True)


def test_an_output_that_cannot_be_created_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(beal.ModelError, match="cannot be written"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, out=tmp_path / "file" / "map.zarr")
