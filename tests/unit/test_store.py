"""Maps on disk: nothing solved is lost, and a resumed map is the map."""

import numpy as np
import pytest
import xarray
import zarr

import beal
from beal.study.store import VARIABLES

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


def test_processes_and_one_process_give_the_same_bits(undisturbed):
    assert same(beal.stability_map(VEHICLE, AXES, workers=2), undisturbed)


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
        if len(writes) > 2 + len(VARIABLES) + 3:  # two axes, one whole block, half of the next
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
