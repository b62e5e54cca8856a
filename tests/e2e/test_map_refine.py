"""`beal map --refine`: the borders of a map, in words, as JSON and in the store."""

import pytest
import xarray

from beal.vehicle import catalog
from beal.vehicle.file import dumps

STUDY = """
model = "model.toml"
[grid]
"joint[0].rotational_stiffness" = {from = 1, to = 1e4, points = 5, spacing = "log"}
"joint[0].shear_stiffness" = {from = 1e2, to = 1e4, points = 5, spacing = "log"}
"""


@pytest.fixture
def study(written):
    written(dumps(catalog.tsto(0.6, 1.0, 1.0)))
    return written(STUDY, "study.toml")


def test_refined_points_and_cells_are_counted_and_stored(result_of, study, tmp_path):
    counted = result_of("map", study, "-o", "map.zarr", "--refine", "0.05")
    with xarray.open_zarr(tmp_path / "map.zarr", group="refined") as found:
        assert counted["refined"] == {
            "width": 0.05,
            "points": found.sizes["point"],
            "cells": found.sizes["cell"],
            "uniform_points": 21**2,
        }
        assert found.attrs["width"] == 0.05
    assert counted["points"] == 25


def test_a_map_that_is_there_is_refined_on_resumption(beal_here, study):
    assert beal_here("map", study, "-o", "map.zarr").returncode == 0
    assert "--resume" in beal_here("map", study, "-o", "map.zarr", "--refine", "0.1").stderr
    done = beal_here("map", study, "-o", "map.zarr", "--refine", "0.1", "--resume")
    assert done.returncode == 0
    assert "borders resolved to 0.1: " in done.stdout


def test_a_wrong_width_is_refused_before_anything_is_solved(beal_here, study, tmp_path):
    done = beal_here("map", study, "-o", "map.zarr", "--refine", "1.5")
    assert (done.returncode, done.stdout) == (2, "")
    assert "refine: the width must lie between" in done.stderr
    assert not (tmp_path / "map.zarr").exists()
