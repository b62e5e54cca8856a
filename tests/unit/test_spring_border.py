"""The border of the springs of a joint that bear a thrust."""

import json
import math

import numpy as np
import pytest

from beal import Damping, Joint, ModelError, Stage, Support, Vehicle, catalog, critical_thrust, plot, spring_border
from beal.vehicle.paths import with_values

ROTATION, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
ASIDE = 1e-6


def thrust(vehicle, rotational, shear, **how):
    placed = with_values(vehicle, {ROTATION: rotational, SHEAR: shear})
    how = {"tolerance": 1e-8, "method": "complete"} | how
    found = critical_thrust(placed, 200.0, **how).critical_thrust
    return math.inf if found is None else found


def beside(piece, n):
    """Springs to the left and to the right of a piece, square to it in the logarithms."""
    x, y = np.log(piece.rotational_stiffness), np.log(piece.shear_stiffness)
    along = np.array([x[n + 1] - x[n - 1], y[n + 1] - y[n - 1]])
    left = np.array([-along[1], along[0]]) / np.hypot(*along) * ASIDE
    return [np.exp(np.array([x[n], y[n]]) + sign * left) for sign in (1, -1)]


@pytest.fixture(scope="module")
def border():
    return spring_border(catalog.tsto(0.6, 10.0, 1e4), target=90.0)


def test_the_target_is_borne_on_the_left_of_each_piece_and_not_on_the_right(border):
    vehicle = border.vehicle
    assert {(piece.kind, piece.edge) for piece in border.pieces} == {("flutter", "crossing"), ("divergence", "jump")}
    for piece in border.pieces:
        soft = np.flatnonzero((piece.rotational_stiffness < 1e3) & (piece.shear_stiffness < 1e4))
        for n in soft[5:-5:20]:
            left, right = beside(piece, n)
            inside, outside = thrust(vehicle, *left), thrust(vehicle, *right)
            assert inside >= border.target > outside
            assert outside == pytest.approx(piece.critical_thrust[n], rel=1e-5 if piece.edge == "crossing" else 1e-2)
            assert (inside - outside > 1.0) == (piece.edge == "jump")


def test_the_border_of_a_crossing_is_exact(border):
    (piece,) = (piece for piece in border.pieces if piece.edge == "crossing")
    for n in range(5, len(piece.critical_thrust), 40):
        springs = piece.rotational_stiffness[n], piece.shear_stiffness[n]
        assert thrust(border.vehicle, *springs) == pytest.approx(90.0, rel=1e-8)
        elements = thrust(border.vehicle, *springs, basis="hermite", method="fast", tolerance=1e-6)
        assert elements == pytest.approx(90.0, rel=2e-6)


def test_the_least_stiffness_is_that_of_the_scan_of_one_quantity(border):
    assert border.least("rotational_stiffness", at=1e4) == pytest.approx(11.0238324, rel=1e-7)
    rigid = border.least("shear_stiffness", at=math.inf)
    assert thrust(border.vehicle, math.inf, rigid) == pytest.approx(90.0, rel=1e-7)
    assert border.least("shear_stiffness", at=5.0) is None


def test_every_change_of_a_grid_is_explained_by_a_piece(border):
    assert border.unexplained == 0
    soft = spring_border(catalog.tsto(0.6, 10.0, 1e4), target=40.0)
    assert soft.unexplained == 0
    assert len(soft.pieces) == 4


def test_a_clamped_column_with_a_joint_has_a_border_too():
    half = Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
    support = Support(nose="clamped")
    column = Vehicle(stages=(half, half), joints=(Joint(),), support=support, units="nondimensional")
    border = spring_border(column, target=15.0)
    assert border.unexplained == 0
    least = border.least("rotational_stiffness", at=math.inf)
    assert thrust(column, least, math.inf) == pytest.approx(15.0, rel=1e-6)


def test_the_record_is_one_json_object(border):
    record = json.loads(json.dumps(border.record))
    assert record["target"] == 90.0
    assert len(record["pieces"][0]["critical_thrust"]) == len(border.pieces[0].critical_thrust)


def test_cliffs_are_drawn_unlike_crossings(border):
    ax = plot.spring_border(border)
    assert {text.get_text() for text in ax.get_legend().get_texts()} == {"flutter, crossing", "divergence, cliff"}
    assert {line.get_linestyle() for line in ax.lines} == {"-", "--"}


@pytest.mark.parametrize(
    ("changes", "how", "message"),
    [
        ({}, {"target": 150.0}, r"no springs of joint\[0\] bear 150; the best found is 109\.498"),
        ({}, {"target": 90.0, "joint": 1}, r"joint\[1\]: there is no such joint; the vehicle has 1"),
        ({}, {"target": 90.0, "formulation": "as-printed"}, "needs objective or converged, found as-printed"),
        ({}, {}, "give either a target thrust or a factor"),
        ({"damping": Damping(ratios=(0.01,))}, {"target": 90.0}, "found damping"),
    ],
)
def test_what_has_no_border_is_refused(changes, how, message):
    with pytest.raises(ModelError, match=message):
        spring_border(catalog.tsto(0.6, 10.0, 1e4).model_copy(update=changes), **how)


def test_a_spring_that_does_not_exist_is_refused(border):
    with pytest.raises(ModelError, match="must be rotational_stiffness or shear_stiffness, found 'k_r'"):
        border.least("k_r", at=1.0)
    with pytest.raises(ModelError, match="must be a positive stiffness, found 0"):
        border.least("shear_stiffness", at=0.0)
