"""Margins, and designs of which the weakest of several vehicles counts."""

import numpy as np
import pytest

import beal
from beal import DesignSpace, Distribution, Link, ModelError, Scenario, Uncertain, Variable, optimise
from beal.design.worth import Task
from beal.vehicle import catalog
from beal.vehicle.paths import with_values

BECK = 20.050953617
STIFFNESS, MASS, NOMINAL = "stage[0].bending_stiffness", "stage[0].mass_per_length", "thrust.nominal"
SPRING, FITTING = "joint[0].rotational_stiffness", "point_mass[0].mass"


def space(nominal=1.0, **links):
    """Beck's column with EI = m^2."""
    column = catalog.beck().model_copy(update={"thrust": beal.Thrust(nominal=nominal)})
    return DesignSpace(column, {MASS: Variable(0.5, 4.0)}, {STIFFNESS: Link(MASS, power=2.0), **links})


def test_the_largest_margin_is_where_the_nominal_thrust_grows_least():
    best = optimise(space(**{NOMINAL: Link(MASS, factor=5.0, power=3.0)}), "margin")  # P / P_nominal ~ 1/m
    assert best.values[MASS] == pytest.approx(0.5, abs=1e-9)
    assert best.margin == pytest.approx(BECK / 2.5 - 1, rel=1e-8)


def test_the_least_mass_at_a_factor_follows_the_nominal_thrust():
    best = optimise(space(**{NOMINAL: Link(MASS, factor=BECK)}), "mass", factor=2.0)  # m^2 = 2 m
    assert best.mass == pytest.approx(2.0, rel=1e-6)
    assert best.margin == pytest.approx(1.0, rel=1e-6)


def test_the_least_margin_of_a_flight_is_that_of_the_flight():
    tank = beal.Tank(name="fuel", forward_end=0.1, aft_end=0.6, mass_per_length=3.0)
    burn = beal.Timeline(time=[0.0, 5.0, 10.0], thrust=[30.0, 40.0, 20.0], fill={"fuel": [1.0, 0.5, 0.0]})
    vehicle = catalog.tsto(0.6, 20.0, 1000.0).model_copy(update={"tanks": (tank,), "timeline": burn})
    stiff = "stage[0].bending_stiffness", "stage[1].bending_stiffness"
    pool = beal.LinearBound(dict.fromkeys(stiff, 1.0), 2.0, 2.0)
    chosen = DesignSpace(vehicle, dict.fromkeys(stiff, Variable(0.2, 1.8)), bounds=[pool])
    best = optimise(chosen, "margin", cases=beal.flight_cases(vehicle), iterations=6)
    margins = beal.flight(best.vehicle).margin
    assert best.margin == pytest.approx(margins.min(), rel=1e-7)
    assert best.case == f"t = {burn.time[int(margins.argmin())]:g}"
    assert best.margin > beal.flight(vehicle).margin.min() + 0.1


def test_a_column_within_tolerances_is_stiffer_by_the_tolerance():
    best = optimise(space(), "mass", target=2 * BECK, cases=beal.tolerance_cases({STIFFNESS: 0.1}))
    assert best.mass == pytest.approx((2 / 0.9) ** 0.5, rel=1e-6)
    assert best.case == "stage[0].bending_stiffness -10%"
    assert np.array(best.case_thrusts) == pytest.approx(np.array([2 / 0.9, 2.0, 2.2 / 0.9]) * BECK, rel=1e-6)


def test_an_absolute_tolerance_is_taken_off():
    best = optimise(space(), "mass", target=2 * BECK, cases=beal.tolerance_cases(absolute={STIFFNESS: 0.5}))
    assert best.mass == pytest.approx(2.5**0.5, rel=1e-6)


def test_a_share_of_the_weakest_samples_may_fail():
    scatter = Uncertain(catalog.beck(), {STIFFNESS: Distribution.normal(1.0, 0.1)})
    cases = beal.sample_cases(scatter, 16, seed=1)
    factors = np.sort([case.factors[STIFFNESS] for case in cases])
    best = optimise(space(), "mass", target=2 * BECK, cases=cases, quantile=0.25)
    assert best.mass == pytest.approx((2 / factors[4]) ** 0.5, rel=1e-6)
    laws = {STIFFNESS: Distribution.normal(best.mass**2, 0.1 * best.mass**2)}
    drawn = beal.sample(Uncertain(best.vehicle, laws), 256, seed=2)
    assert np.mean(drawn.critical_thrust < 2 * BECK) == pytest.approx(0.25, abs=1 / 16)


def test_a_robust_joint_stays_away_from_the_cliff():
    vehicle = catalog.tsto(0.6, 30.0, 1e4).model_copy(update={"point_masses": (beal.PointMass(station=0.6, mass=0.0),)})
    chosen = DesignSpace(vehicle, {SPRING: Variable(2.0, 100.0, "log")}, {FITTING: Link(SPRING, factor=1e-4)})
    bare = optimise(chosen, "mass", 90.0, {SPRING: 12.0})
    safe = optimise(chosen, "mass", 90.0, {SPRING: 14.5}, cases=beal.tolerance_cases({SPRING: 0.2}))
    for best, weakest in ((bare, 1.0), (safe, 0.8)):
        softest = weakest * best.values[SPRING]
        at, below = (with_values(best.vehicle, {SPRING: share * softest}) for share in (1.0, 1 - 2e-4))
        assert best.cliff
        assert beal.critical_thrust(at).critical_thrust > 100.0
        assert beal.critical_thrust(below).critical_thrust < 82.0
    around = {SPRING: (0.8 * safe.values[SPRING], 1.2 * safe.values[SPRING])}
    assert beal.worst_case(safe.vehicle, around, workers=1).critical_thrust >= 90.0


def test_an_imperfection_counts_where_it_is_the_weakest():
    soft = [Scenario("sound", {STIFFNESS: 1.0}), Scenario("delaminated", {STIFFNESS: 0.5})]
    best = optimise(space(), cases=soft)
    assert (best.case, best.values[MASS]) == ("delaminated", 4.0)
    assert best.critical.critical_thrust == pytest.approx(8.0 * BECK, rel=1e-8)


def test_slopes_go_through_cases_links_and_spacing():
    damped = with_values(catalog.beck(), {"stage[0].internal_damping": 0.02, NOMINAL: 3.0})
    links = {STIFFNESS: Link(MASS, power=2.0), NOMINAL: Link(MASS, factor=3.0)}
    chosen = DesignSpace(damped, {MASS: Variable(0.5, 4.0, "log")}, links)
    softer = Scenario("softer", {STIFFNESS: 0.8})
    task = Task(chosen, "margin", cases=(softer,))
    vehicle = softer.applied(chosen.at([0.3]))
    gradient = beal.critical_gradient(vehicle, [MASS, STIFFNESS])
    thrust, (stage,) = gradient.critical.critical_thrust, vehicle.stages
    mass, stiffness = stage.mass_per_length, stage.bending_stiffness
    by_chain = (gradient.thrust @ [mass, 2 * stiffness] - thrust) * np.log(8.0) / (3.0 * mass)
    first = min(task.cuts(task.seen(np.array([0.3]))), key=lambda cut: cut.ratio)
    assert first.ratio == pytest.approx(thrust / (3.0 * mass), rel=1e-7)
    assert first.slope[0] == pytest.approx(by_chain, rel=1e-7)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"quantile": 1.0}, "must lie between 0 and 1, found 1"),
        ({"objective": "mass", "target": 1.0, "factor": 2.0}, "give either a target thrust or a factor"),
        ({"cases": [Scenario("odd", {"stage[7].length": 2.0})]}, r"stage\[7\].length"),
    ],
)
def test_cases_that_make_no_sense_are_refused(asked, message):
    with pytest.raises(ModelError, match=message):
        optimise(space(), **asked)


def test_a_margin_needs_a_nominal_thrust():
    with pytest.raises(ModelError, match=r"thrust.nominal: is needed"):
        optimise(space(nominal=None), "margin")


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (({}, {}), "needs 1 to 8 quantities, found 0"),
        (({STIFFNESS: 0.1}, {STIFFNESS: 0.1}), "is given both ways"),
        (({STIFFNESS: -0.1}, {}), "must be positive, found -0.1"),
    ],
)
def test_tolerances_that_make_no_box_are_refused(asked, message):
    with pytest.raises(ModelError, match=message):
        beal.tolerance_cases(*asked)


def test_scatter_about_nothing_is_refused():
    scatter = Uncertain(catalog.beck(), {"stage[0].foundation_stiffness": Distribution.normal(0.0, 1.0, truncate=True)})
    with pytest.raises(ModelError, match="a median that are finite and not zero, found 0"):
        beal.sample_cases(scatter)
