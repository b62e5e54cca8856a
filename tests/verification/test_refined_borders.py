"""Refined borders of the paper's map, against bisection with the search that looks at one vehicle at a time."""

import numpy as np
import pytest

import beal
from beal.study.refined import refined_map

AXES = {
    "joint[0].rotational_stiffness": np.geomspace(1, 1e4, 9),
    "joint[0].shear_stiffness": np.geomspace(1e2, 1e4, 9),
}
WIDTH = 0.01
BISECTIONS = 10  # of a line no longer than the map: 0.001 of it, a tenth of the width


def names(split, share):
    """What comes first at a place, given as shares of the axes."""
    rotational, shear = 10 ** (4 * share[0]), 10 ** (2 + 2 * share[1])
    found = beal.critical_thrust(beal.catalog.tsto(split, rotational, shear))
    return found.kind, found.modes


def crossing(split, rng):
    """A place on a border, halfway between the ends of a short bracket on a random line."""
    while True:
        here, there = rng.random((2, 2))
        first, second = names(split, here), names(split, there)
        if first != second:
            break
    for _ in range(BISECTIONS):
        middle = (here + there) / 2
        here, there = (middle, there) if names(split, middle) == first else (here, middle)
    return (here + there) / 2


@pytest.mark.parametrize("split", [0.6, 0.2])
def test_borders_lie_where_bisection_along_random_lines_finds_them(split):
    refined = refined_map(beal.catalog.tsto(split, 1.0, 1.0), AXES, WIDTH).refined
    low, high = (np.log10(refined[end].values) / [4, 2] - [0, 1] for end in ("low", "high"))
    assert np.max(high - low) <= WIDTH * (1 + 1e-9)
    rng = np.random.default_rng(1)
    for _ in range(5):
        place = crossing(split, rng)
        away = np.maximum(low - place, place - high).max(axis=1).min()
        assert away < WIDTH / 2
