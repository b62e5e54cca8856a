"""What a design space and an optimisation refuse, and the least mass at a target."""

import pytest

from beal import DesignSpace, LinearBound, Link, ModelError, Variable, optimise
from beal.vehicle import catalog

STIFFNESS, MASS = "stage[0].bending_stiffness", "stage[0].mass_per_length"


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"variables": {}}, "needs at least one, found none"),
        ({"variables": {STIFFNESS: Variable(2.0, 1.0)}}, "contradictory bounds: from 2 to 1"),
        ({"variables": {STIFFNESS: Variable(0.0, 1.0, "log")}}, "log spacing needs positive bounds"),
        ({"variables": {"stage[0].stiffness": Variable(1.0, 2.0)}}, "is not a quantity of this vehicle"),
        ({"variables": {MASS: Variable(1.0, 2.0)}, "links": {MASS: Link(MASS)}}, "is a variable and linked to one"),
        ({"variables": {MASS: Variable(1.0, 2.0)}, "links": {STIFFNESS: Link("x")}}, "linked to x, which is not a"),
        ({"variables": {MASS: Variable(1.0, 2.0)}, "bounds": [LinearBound({MASS: 1.0}, 3.0)]}, "meets them all"),
        ({"variables": {MASS: Variable(1.0, 2.0)}, "bounds": [LinearBound({MASS: 1.0}, 2.0, 1.0)]}, "contradictory: "),
        ({"variables": {MASS: Variable(1.0, 2.0)}, "bounds": [LinearBound({"x": 1.0})]}, "of linear spacing, found x"),
    ],
)
def test_contradictory_spaces_are_refused(asked, message):
    with pytest.raises(ModelError, match=message):
        DesignSpace(catalog.beck(), **asked)


def space():
    return DesignSpace(catalog.beck(), {MASS: Variable(0.5, 2.0)}, {STIFFNESS: Link(MASS, power=2.0)})


def test_the_least_mass_that_bears_a_thrust_is_exact():
    best = optimise(space(), "mass", target=2 * 20.050953617, iterations=20)  # P grows with EI = m^2
    assert best.mass == pytest.approx(2**0.5, rel=1e-6)
    assert best.critical.critical_thrust >= 2 * 20.050953617 * (1 - 1e-7)


def test_a_target_out_of_reach_names_the_nearest_thrust():
    with pytest.raises(ModelError, match=r"out of reach: 100 asked for, 80\.2038\d* is the nearest found"):
        optimise(space(), "mass", target=100.0, iterations=20)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"objective": "cost"}, "must be critical_thrust, margin or mass, found 'cost'"),
        ({"objective": "mass"}, "goes with the objective mass"),
        ({"target": 3.0}, "goes with the objective mass"),
        ({"objective": "mass", "target": -3.0}, "must be a positive thrust, found -3"),
        ({"starts": 0}, "at least one search of one step"),
        ({"start": {}, "iterations": 0}, "at least one search of one step"),
        ({"start": {"x": 1.0}}, r"needs a value for each variable; stage\[0\].mass_per_length missing"),
    ],
)
def test_options_that_contradict_each_other_are_refused(asked, message):
    with pytest.raises(ModelError, match=message):
        optimise(space(), **asked)
