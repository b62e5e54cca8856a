"""Answers to questions of design, where they are known in closed form."""

import math

import numpy as np
import pytest

import beal
import beal.design.answer
from beal.stability.critical import critical_thrust

BECK = 20.0509536
EI, MASS = "stage[0].bending_stiffness", "stage[0].mass_per_length"
STUDY = f"""
model = "beck.toml"
[design]
question = "Which wall bears a thrust of 30?"
objective = "mass"
target = 30.0
starts = 1
[variables]
"{EI}" = {{low = 0.5, high = 3.0}}
[links]
"{MASS}" = {{of = "{EI}", power = 0.5}}
[uncertain]
"{EI}" = {{distribution = "lognormal", median = 1.0, cv = 0.1}}
[sampling]
samples = 64
[tolerance]
"{EI}" = {{low = 0.9, high = 1.1}}
[scenario.dented]
multiply = {{"{EI}" = 0.8}}
"""


def study_of(folder, text=STUDY):
    (folder / "beck.toml").write_text(beal.dumps(beal.catalog.beck()))
    (folder / "study.toml").write_text(text)
    return beal.load_design(folder / "study.toml")


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return beal.design_answer(study_of(tmp_path_factory.mktemp("design")), workers=1)


def test_the_least_mass_that_bears_a_thrust_is_that_of_the_formula(found):
    stiffness = 30 / BECK
    assert found.best.values[EI] == pytest.approx(stiffness, rel=1e-7)
    assert found.best.mass == pytest.approx(math.sqrt(stiffness), rel=1e-7)
    assert found.best.vehicle.stages[0].mass_per_length == pytest.approx(math.sqrt(stiffness), rel=1e-7)
    assert found.given.critical_thrust == pytest.approx(BECK, rel=1e-7)
    assert found.asked == 30


def test_the_range_ends_where_the_share_of_the_thrust_does(found):
    one = found.ranges[EI]
    assert (one.low, one.low_edge) == (pytest.approx(0.95 * 30 / BECK, rel=1e-6), "crossing")
    assert (one.high, one.high_edge) == (3.0, "end")


def test_the_map_follows_the_links(found):
    assert found.refined is None
    assert found.chart[EI].values[[0, -1]].tolist() == [0.5, 3.0]
    np.testing.assert_allclose(found.chart.critical_thrust, BECK * found.chart[EI], rtol=1e-6)


def test_robustness_speaks_of_factors_on_the_design(found):
    assert found.worst.critical_thrust == pytest.approx(27.0, rel=1e-6)
    assert found.worst.values[EI] == pytest.approx(0.9 * 30 / BECK, rel=1e-6)
    assert dict(found.scenarios)["dented"].critical_thrust == pytest.approx(24.0, rel=1e-6)
    assert np.median(found.scatter.values) == pytest.approx(30 / BECK, rel=0.05)
    assert found.sensitivity[EI].elasticity == pytest.approx(1.0, rel=1e-6)
    assert found.gaps == ()


def ritz_study(folder):
    (folder / "model.toml").write_text(beal.dumps(beal.catalog.tsto(0.6, 10.0, 1e4)))
    (folder / "study.toml").write_text(
        """
        model = "model.toml"
        [design]
        starts = 1
        [variables]
        "joint[0].rotational_stiffness" = {low = 5.0, high = 20.0}
        [solve]
        formulation = "corrected-ritz"
        modes = 4
        """
    )
    return beal.load_design(folder / "study.toml")


def test_a_ritz_formulation_is_answered_in_its_own_modes(tmp_path):
    found = beal.design_answer(ritz_study(tmp_path), workers=1)
    thrust = found.best.critical.critical_thrust
    again = critical_thrust(found.best.vehicle, None, "corrected-ritz", modes=4)
    assert thrust == pytest.approx(again.critical_thrust, rel=1e-7)
    assert float(found.chart.critical_thrust.max()) <= thrust * (1 + 1e-6)
    assert found.sensitivity.critical is found.best.critical
    assert found.best.second is None


def test_evidence_that_cannot_be_had_is_told_and_the_rest_kept(tmp_path, monkeypatch):
    def lost(*told, **more):
        raise beal.ConvergenceError("lost on the way")

    monkeypatch.setattr(beal.design.answer, "sensitivity", lost)
    found = beal.design_answer(ritz_study(tmp_path), workers=1)
    assert found.sensitivity is None
    assert found.gaps == ("sensitivities: lost on the way",)
    assert found.given.critical_thrust < found.best.critical.critical_thrust


@pytest.mark.parametrize(
    ("robust", "weakest"),
    [("worst", 0.8), ("quantile", None)],
)
def test_a_robust_study_counts_the_weakest_of_its_cases(tmp_path, robust, weakest):
    text = STUDY.replace("starts = 1", f'starts = 1\nrobust = "{robust}"\nquantile = 0.25')
    study = study_of(tmp_path, text)
    best = beal.optimise(study.space, "mass", study.target, cases=study.cases, quantile=study.quantile)
    if weakest is None:
        factors = sorted(case.factors[EI] for case in study.cases)
        weakest = factors[len(factors) // 4]
    assert best.values[EI] == pytest.approx(30 / (weakest * BECK), rel=1e-6)
    assert best.critical.critical_thrust == pytest.approx(30.0, rel=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("starts = 1", 'robust = "best"', "must be 'worst' or 'quantile'"),
        ("target = 30.0", "", "give either a target thrust or a factor"),
        ('objective = "mass"', "", "design.target: goes with the objective mass"),
        ("low = 0.5", "low = 4.0", "contradictory bounds: from 4 to 3"),
        ('stage[0].bending_stiffness" = {low', 'stage[7].bending_stiffness" = {low', "index out of range"),
        ("median = 1.0", "median = 10.0", "is a factor on the quantity as designed: needs a median between 0.5 and 2"),
        ("low = 0.9", "low = 1.05", "is a factor on the quantity as designed: needs low up to 1"),
        (
            '{"stage[0].bending_stiffness" = 0.8}',
            '{"stage[0].bendign_stiffness" = 0.8}',
            "is not a quantity of this vehicle",
        ),
        ("[sampling]", "[tolerances]", "unknown key"),
        ("[sampling]", '[map]\naxes = ["stage[0].length"]\n[sampling]', "map.axes: must be variables"),
    ],
)
def test_a_study_that_cannot_be_answered_is_refused_before_any_search(tmp_path, old, new, message):
    assert old in STUDY
    with pytest.raises(beal.ModelError, match=message):
        study_of(tmp_path, STUDY.replace(old, new))


def test_a_study_may_ask_for_the_largest_margin(tmp_path):
    column = beal.catalog.beck().model_copy(update={"thrust": beal.Thrust(nominal=10.0)})
    (tmp_path / "model.toml").write_text(beal.dumps(column))
    (tmp_path / "study.toml").write_text(
        f'model = "model.toml"\n[design]\nobjective = "margin"\n[variables]\n"{EI}" = {{low = 0.5, high = 2.0}}\n'
    )
    study = beal.load_design(tmp_path / "study.toml")
    assert (study.objective, study.target) == ("margin", None)
    best = beal.optimise(study.space, study.objective)
    assert best.margin == pytest.approx(2 * BECK / 10 - 1, rel=1e-7)
