"""How a grid is cut: into blocks of about one cost, which depend on the study alone."""

import math

import numpy as np
import pytest

import beal
from beal.study.blocks import ENOUGH, LONG, MOST, Blocks, blocks, seconds, together
from beal.study.study import Solve, Study

ROTATIONAL, SHEAR, SPLIT = "joint[0].rotational_stiffness", "joint[0].shear_stiffness", "stage.split"
MASS = "stage[0].mass_per_length"
VEHICLE = beal.catalog.tsto(0.6, 5000.0, 5000.0)


def study(formulation="objective", **points):
    ranges = {ROTATIONAL: (1, 1e4), SHEAR: (1e2, 1e4), SPLIT: (0.2, 0.8), MASS: (1, 2)}
    names = {"rotational": ROTATIONAL, "shear": SHEAR, "split": SPLIT, "mass": MASS}
    axes = {names[name]: tuple(np.linspace(*ranges[names[name]], n)) for name, n in points.items()}
    return Study(VEHICLE, axes, Solve(formulation=formulation))


GRIDS = [
    study(shear=7),
    study(rotational=100, shear=100),
    study(rotational=1000, shear=3000),
    study(rotational=10, split=30, shear=20),
    study(split=20, mass=30),
    study("as-printed", rotational=50, shear=50),
]
every_grid = pytest.mark.parametrize("grid", GRIDS, ids=lambda grid: "x".join(map(str, grid.shape)))


@every_grid
def test_blocks_cover_a_grid_once(grid):
    cut = blocks(grid)
    seen = np.zeros(grid.shape, dtype=int)
    for index in range(len(cut)):
        seen[cut[index]] += 1
        assert seen[cut[index]].size == cut.points[index]
    assert np.all(seen == 1)
    assert cut.points.shape == (len(cut),)


@every_grid
def test_blocks_are_short_and_enough_to_share(grid):
    cut = blocks(grid)
    assert seconds(grid) / len(cut) <= 1.3 * LONG
    assert len(cut) >= min(ENOUGH, seconds(grid) / 0.1) / 2


def test_a_block_holds_few_values_of_what_is_not_a_spring():
    assert blocks(study(rotational=100, split=50, shear=100)).sizes == (100, 2, 100)
    assert blocks(study(split=50, rotational=2000, shear=2000)).sizes[0] == 1


def test_springs_on_few_other_values_are_solved_together():
    assert together(study(rotational=100, shear=100))
    assert not together(study(rotational=100, shear=100, formulation="as-printed"))
    assert not together(study(rotational=3, split=100))


def test_a_huge_grid_has_no_more_blocks_than_a_folder_bears():
    huge = study(split=10_000, mass=10_000)
    cut = blocks(huge)
    assert MOST / 2 < len(cut) <= 1.1 * MOST
    assert math.prod(cut.sizes) * len(cut) < 1.1 * 1e8


def test_a_block_knows_its_place():
    cut = Blocks((5, 7), (2, 4))
    assert cut.counts == (3, 2)
    assert cut[5] == (slice(4, 5), slice(4, 7))
    assert cut.points.tolist() == [8, 6, 8, 6, 4, 3]
