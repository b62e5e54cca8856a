"""Mass against critical thrust: closed forms, a search by brute force, what is left out and what is drawn."""

import json

import matplotlib
import numpy as np
import pytest

import beal
from beal import DesignSpace, Joint, Link, Stage, Support, Variable, Vehicle
from beal.report.records import front_record
from beal.vehicle import catalog
from beal.vehicle.paths import with_values

matplotlib.use("Agg")
BECK = 20.050953617
AREAS = [f"stage[{n}].mass_per_length" for n in range(2)]
STIFFNESS = [f"stage[{n}].bending_stiffness" for n in range(2)]


def uniform():
    variables = {AREAS[0]: Variable(0.5, 2.0)}
    return DesignSpace(catalog.beck(), variables, {STIFFNESS[0]: Link(AREAS[0], power=2.0)})


def test_the_front_of_a_uniform_column_is_a_parabola():
    front = beal.pareto(uniform(), points=4)
    assert front.mass[[0, -1]] == pytest.approx([0.5, 2.0], rel=1e-6)
    assert front.critical_thrust == pytest.approx(BECK * front.mass**2, rel=1e-8)
    assert np.diff(front.critical_thrust) == pytest.approx(BECK * 3.75 / 3, rel=1e-5)
    assert not front.cliff.any()


def test_the_front_of_a_column_of_two_parts_is_that_of_all_columns():
    half = Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
    column = Vehicle(stages=(half, half), joints=(Joint(),), support=Support(nose="clamped"), units="nondimensional")
    links = {stiff: Link(area, power=2.0) for stiff, area in zip(STIFFNESS, AREAS, strict=True)}
    space = DesignSpace(column, dict.fromkeys(AREAS, Variable(0.5, 2.0)), links)
    front = beal.pareto(space, points=3)

    def thrust(front_area):  # at mass 1; it grows with the square of the mass
        areas = (front_area, 2.0 - front_area)
        values = {AREAS[n]: areas[n] for n in (0, 1)} | {STIFFNESS[n]: areas[n] ** 2 for n in (0, 1)}
        return beal.critical_thrust(with_values(column, values)).critical_thrust

    best = max(thrust(area) for area in np.linspace(0.93, 1.03, 11))
    assert front.critical_thrust[1:-1] == pytest.approx(best * front.mass[1:-1] ** 2, rel=1e-4)
    assert np.all(np.diff(front.mass) > 0)
    assert np.all(np.diff(front.critical_thrust) > 0)


def test_a_front_is_drawn_and_told():
    front = beal.pareto(uniform(), points=2)
    ax = beal.plot.pareto_front(front)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("mass", "critical thrust $P L^2/EI$")
    assert len(ax.get_lines()[1].get_xdata()) == 2
    told = json.loads(json.dumps(front_record(front)))
    assert [point["cliff"] for point in told["points"]] == [False, False]
    assert told["points"][1]["mass"] == pytest.approx(2.0)


def test_a_front_needs_two_ends():
    with pytest.raises(beal.ModelError, match="must be 2 or more, found 1"):
        beal.pareto(uniform(), points=1)
