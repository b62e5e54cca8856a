"""The table of the page on the paper's question: every number in it, and that no small step is better."""

import re
from itertools import product
from pathlib import Path

import pytest

import beal
from beal import catalog

PAGE = (Path(__file__).parents[2] / "docs" / "paper_question.md").read_text(encoding="utf-8")
FORMULATIONS = {"objective": None, "converged": None, "corrected-ritz": 8, "as-printed": 8}
ROWS = {
    name: [float(cell) for cell in re.findall(r"[\d.]+", rest)]
    for name, rest in re.findall(r"^\| `([a-z-]+)` \|((?: [\d.]+ \|){7})$", PAGE, re.MULTILINE)
}
RANGES = ((0.2, 0.8), (1.0, 1e4), (1e2, 1e4))
STEP = 0.01  # of each quantity


def bears(place, name, method="fast"):
    found = beal.critical_thrust(catalog.tsto(*place), None, name, modes=FORMULATIONS[name], method=method)
    return found.critical_thrust


def test_the_table_is_whole():
    assert list(ROWS) == list(FORMULATIONS)


@pytest.mark.parametrize("name", FORMULATIONS)
def test_a_design_bears_what_the_page_says(name):
    place, told = ROWS[name][:3], ROWS[name][3:]
    for other, value in zip(FORMULATIONS, told, strict=True):
        assert bears(place, other, "complete") == pytest.approx(value, abs=5e-4)
    if FORMULATIONS[name] is None:
        elements = beal.discretise(catalog.tsto(*place), name, "hermite", 24)
        second = beal.critical_thrust(elements).critical_thrust
        assert second == pytest.approx(bears(place, name), rel=1e-4)


@pytest.mark.parametrize("name", FORMULATIONS)
def test_no_small_step_from_a_design_is_better(name):
    place, best = ROWS[name][:3], ROWS[name][3 + list(FORMULATIONS).index(name)]
    for steps in product((-STEP, 0.0, STEP), repeat=3):
        moved = [min(max(x * (1 + d), low), high) for x, d, (low, high) in zip(place, steps, RANGES, strict=True)]
        assert bears(moved, name) < best * (1 + 2e-3)  # the rounding of the page
