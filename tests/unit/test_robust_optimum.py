"""The best of the worst: where it is known in closed form, and where the vertices of the box miss a cliff."""

import pytest

import beal
from beal import catalog
from beal.design.cutting import HELD

SPLIT, SLIDING = "stage.split", "joint[0].shear_stiffness"


def test_the_lightest_column_that_bears_a_thrust_within_tolerances_is_that_of_the_formula():
    """P = 20.05 EI of the softest one, and the mass is the square root of EI."""
    path = "stage[0].bending_stiffness"
    links = {"stage[0].mass_per_length": beal.Link(path, power=0.5)}
    space = beal.DesignSpace(catalog.beck(), {path: beal.Variable(0.5, 3.0)}, links)
    best, weakest = beal.robust_optimum(space, {path: (0.8, 1.1)}, "mass", 30.0)
    assert best.values[path] == pytest.approx(30 / (0.8 * 20.0509536), rel=1e-6)
    assert weakest.critical_thrust == pytest.approx(30.0, rel=1e-6)
    assert weakest.at_vertex


def test_a_cliff_that_is_worst_between_the_vertices_counts():
    """The softest shear spring that is safe is the stiffest at a third of the length, and softer to both sides."""
    vehicle = catalog.tsto(0.3323, 1e4, 182.44)  # where the vertices alone lead
    space = beal.DesignSpace(vehicle, {SLIDING: beal.Variable(180.0, 185.0)})
    factors = {SPLIT: (0.98, 1.02), SLIDING: (0.8, 1.25)}
    best, weakest = beal.robust_optimum(space, factors)
    assert len(best.case_thrusts) > len(beal.vertex_cases(factors))
    assert weakest.critical_thrust >= (1 - HELD) * min(best.case_thrusts) > 112
    assert best.values[SLIDING] > 182.5
    between = catalog.tsto(0.3323, 1e4, 0.8 * 182.44)
    assert beal.critical_thrust(between).kind == "divergence"
