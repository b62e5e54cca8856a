"""Uncertain quantities: what is refused, what is truncated, what a study file may say."""

import numpy as np
import pytest

import beal
from beal.design.distributions import Distribution
from beal.design.reliability import probability_of_instability, thrust_quantile
from beal.design.robust import Scenario, worst_case
from beal.design.sampling import Sample, sample
from beal.design.uncertain import Uncertain
from beal.design.uncertain_file import load_uncertainty
from beal.errors import ModelError
from beal.vehicle import catalog
from beal.vehicle.file import dumps, loads

BENDING = "stage[0].bending_stiffness"
ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
NORMAL = Distribution.normal(1.0, 0.5)
THREE = {ROTATIONAL: Distribution.lognormal(10, 0.3), SHEAR: Distribution.lognormal(200, 0.3)}
THREE |= {"stage.split": Distribution.uniform(0.4, 0.6)}


def test_a_stiffness_that_could_be_negative_is_refused_with_its_probability():
    with pytest.raises(ModelError, match=r"uncertain.stage\[0\].bending_stiffness: .* gives 0.0228 of its probability"):
        Uncertain(catalog.beck(), {BENDING: NORMAL})


def test_a_split_beyond_the_vehicle_is_refused():
    with pytest.raises(ModelError, match=r"lie above 0 and below 1; .* gives 0.125 of"):
        Uncertain(catalog.tsto(0.5, 10, 20), {"stage.split": Distribution.uniform(0.3, 1.1)})


def test_truncation_keeps_the_law_between_the_ends_and_says_what_it_cut():
    uncertain = Uncertain(catalog.beck(), {BENDING: Distribution.normal(1.0, 0.5, truncate=True)})
    assert uncertain.truncated[BENDING] == pytest.approx(0.02275013, rel=1e-6)  # of a normal law below -2 sigma
    cube = (np.arange(4000) + 0.5)[:, None] / 4000
    values = uncertain.values(cube)
    assert values.min() > 0
    assert np.mean(values > 1.0) == pytest.approx(0.5 / (1 - 0.02275013), abs=5e-4)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Distribution.normal(1.0, 0.0), "sd: must be positive, found 0"),
        (lambda: Distribution.lognormal(-1.0, 0.1), "median: must be positive"),
        (lambda: Distribution.uniform(2.0, 1.0), "high: must be above low = 2.0"),
        (lambda: Distribution.triangular(0.0, 3.0, 1.0), "mode: must lie between"),
        (lambda: Distribution.normal(float("nan"), 1.0), "mean: must be a finite number"),
        (lambda: Distribution.of_samples([1.0, 2.0]), "at least 8 measured values, found 2"),
        (lambda: Distribution.of_samples([1.0] * 9), "found one value only"),
    ],
)
def test_a_law_that_is_none_is_refused(make, message):
    with pytest.raises(ModelError, match=message):
        make()


def test_a_quantity_that_does_not_exist_is_named_with_its_neighbours():
    with pytest.raises(ModelError, match=r"uncertain.stage\[0\].bending: is not a quantity"):
        Uncertain(catalog.beck(), {"stage[0].bending": NORMAL})


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        (
            {(ROTATIONAL, SHEAR): 0.9, (SHEAR, "stage.split"): 0.9, (ROTATIONAL, "stage.split"): -0.9},
            "positive definite",
        ),
        ({(ROTATIONAL, SHEAR): 1.5}, "must lie between -1 and 1, found 1.5"),
        ({(ROTATIONAL, BENDING): 0.5}, "is not among the uncertain quantities"),
        ({(ROTATIONAL, SHEAR): 0.5, (SHEAR, ROTATIONAL): 0.5}, "is given twice"),
        ({(SHEAR, SHEAR): 0.5}, "two different quantities"),
    ],
)
def test_correlations_that_cannot_be_are_refused(pairs, message):
    with pytest.raises(ModelError, match=message):
        Uncertain(catalog.tsto(0.5, 10, 20), THREE, pairs)


@pytest.mark.parametrize("samples", [10, 10**9])
def test_too_few_and_too_many_samples_are_refused(samples):
    with pytest.raises(ModelError, match="samples: must lie between 64 and"):
        sample(Uncertain(catalog.tsto(0.5, 10, 20), THREE), samples)


def made(thrusts, replicates=1, limit=300.0):
    thrusts = np.asarray(thrusts, dtype=float)
    kind = np.where(np.isnan(thrusts), -1, np.where(np.isinf(thrusts), 0, 1)).astype(np.int8)
    return Sample(("k",), thrusts[:, None], thrusts, kind, limit, "monte-carlo", 0, replicates)


def test_a_quantile_needs_enough_samples_and_says_how_many():
    with pytest.raises(ModelError, match=r"quantile 0.01 needs at least 368, found 100"):
        thrust_quantile(made(np.arange(1.0, 101.0)), 0.01)


def test_the_interval_is_that_of_clopper_and_pearson():
    found = probability_of_instability(made(np.arange(1.0, 101.0)), 10.0)
    assert (found.value, found.low, found.high) == pytest.approx((0.1, 0.0490047, 0.1762226), abs=1e-6)  # their table


def test_scrambles_that_agree_do_not_make_a_probability_exact():
    found = probability_of_instability(made(np.tile(np.arange(1.0, 9.0), 16), replicates=16), 4.0)
    assert found.low < found.value == 0.5 < found.high


def test_no_failure_among_many_still_leaves_a_chance():
    found = probability_of_instability(made(np.full(100, 200.0)), 10.0)
    assert (found.value, found.low) == (0.0, 0.0)
    assert found.high == pytest.approx(1 - 0.025 ** (1 / 100))


def test_what_could_not_be_solved_counts_against_both_ends():
    thrusts = np.concatenate((np.arange(1.0, 91.0), np.full(10, np.nan)))
    found = probability_of_instability(made(thrusts), 10.0)
    clean = probability_of_instability(made(np.arange(1.0, 101.0)), 20.0)
    assert found.value == pytest.approx(10 / 90)
    assert found.high == pytest.approx(clean.high)  # all ten unstable
    assert thrust_quantile(made(thrusts), 0.05).low == 0.0


def test_stable_vehicles_are_in_the_quantiles_as_infinite():
    thrusts = np.concatenate((np.arange(1.0, 101.0), np.full(100, np.inf)))
    assert thrust_quantile(made(thrusts), 0.25).value == 50.0
    assert thrust_quantile(made(thrusts), 0.75).value == np.inf


def test_a_thrust_beyond_the_search_is_refused():
    with pytest.raises(ModelError, match="must lie between 0 and 300, searched to"):
        probability_of_instability(made(np.arange(1.0, 101.0)), 301.0)


def test_vehicles_that_the_model_refuses_are_counted_as_failed():
    vehicle = loads(dumps(catalog.tsto(0.5, 10, 20)) + '[[sensor]]\nname = "tail"\nstation = 0.9495\n')
    laws = {"stage[0].length": Distribution.uniform(0.45, 0.6), "sensor[1].station": Distribution.uniform(0.9, 0.999)}
    found = sample(Uncertain(vehicle, laws), 64, workers=1)  # with a short stage the sensor is off the vehicle
    assert 0 < found.failed < found.count
    assert probability_of_instability(found, 1.0).high > found.failed / found.count


@pytest.mark.parametrize(
    ("scenario", "message"),
    [
        (Scenario("none"), "scenario.none: changes nothing"),
        (Scenario("odd", {ROTATIONAL: 0.7}, {ROTATIONAL: 2.0}), "both multiplied and replaced"),
        (Scenario("lost", {"joint[3].shear_stiffness": 0.7}), r"scenario.lost.joint\[3\].shear_stiffness: index"),
        (Scenario("lost", {ROTATIONAL: -1.0}), "scenario.lost.joint"),
    ],
)
def test_a_scenario_that_cannot_be_is_refused(scenario, message):
    with pytest.raises(ModelError, match=message):
        scenario.applied(catalog.tsto(0.5, 10, 20))


def test_the_weakest_vehicle_may_be_inside_the_box():
    vehicle = catalog.tsto(0.6, 20.0, 500.0)
    found = worst_case(vehicle, {SHEAR: (150.0, 1e5)})
    grid = beal.stability_map(vehicle, {SHEAR: np.geomspace(150, 1e5, 400)}).critical_thrust
    assert found.critical_thrust <= float(grid.min()) * (1 + 1e-4)
    assert found.critical_thrust < found.lowest_vertex or found.at_vertex


STUDY = """
model = "model.toml"
[uncertain]
"joint[0].rotational_stiffness" = {distribution = "normal", mean = 12.0, cv = 0.1}
"joint[0].shear_stiffness" = {distribution = "samples", file = "tests.csv", column = "shear"}
[correlation]
measure = "pearson"
pairs = [{between = ["joint[0].rotational_stiffness", "joint[0].shear_stiffness"], value = 0.3}]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "model.toml").write_text(dumps(catalog.tsto(0.6, 10, 20)))
    (tmp_path / "tests.csv").write_text("shear\n" + "\n".join(str(200 + 3 * n) for n in range(20)))
    return tmp_path


def test_a_study_file_gives_what_it_says(folder):
    (folder / "study.toml").write_text(STUDY)
    task = load_uncertainty(folder / "study.toml")
    values = task.uncertain.values(np.random.default_rng(1).random((20000, 2)))
    assert values.mean(axis=0) == pytest.approx([12.0, 228.5], rel=0.01)
    assert np.corrcoef(values.T)[0, 1] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"normal"', '"weibull"', "must be|expected"),
        ("mean = 12.0", "mean = -12.0", "median|-12|negative|greater"),
        ('column = "shear"', 'column = "mass"', "has no column 'mass', found shear"),
        ('file = "tests.csv"', 'file = "none.csv"', "cannot be read: No such file"),
        ("cv = 0.1", "cv = 0.1, sd = 1.0", "give either sd or cv"),
        ("value = 0.3", "value = 3.0", "must lie between -1 and 1"),
        ("[uncertain]", "[uncertian]", "unknown key"),
    ],
)
def test_a_wrong_study_file_is_refused_with_the_place(folder, old, new, message):
    (folder / "study.toml").write_text(STUDY.replace(old, new))
    with pytest.raises(ModelError, match=message):
        load_uncertainty(folder / "study.toml")


def test_a_study_of_a_vehicle_in_si_takes_units(tmp_path):
    stage = beal.Stage(length=10.0, mass_per_length=100.0, bending_stiffness=1e8)
    vehicle = beal.Vehicle(stages=[stage], support=beal.Support(nose="clamped"))
    (tmp_path / "model.toml").write_text(beal.dumps(vehicle))
    (tmp_path / "study.toml").write_text(
        """
        model = "model.toml"
        [uncertain]
        "stage[0].bending_stiffness" = {distribution = "lognormal", median = "100 MN*m^2", cv = 0.1}
        "stage[0].length" = {distribution = "normal", mean = 10, sd = "2 cm"}
        [tolerance]
        "stage[0].length" = {low = "30 ft", high = "12 m"}
        [scenario.heavy]
        replace = {"stage[0].mass_per_length" = "0.2 t/m"}
        """
    )
    study = load_uncertainty(tmp_path / "study.toml")
    laws = study.uncertain.distributions
    assert laws["stage[0].bending_stiffness"].median == pytest.approx(1e8)
    assert laws["stage[0].length"].quantile(0.8413447460685429) == pytest.approx(10.02, rel=1e-9)
    assert study.tolerances["stage[0].length"] == (pytest.approx(9.144), 12.0)
    assert study.scenarios[0].applied(vehicle).stages[0].mass_per_length == pytest.approx(200.0)


@pytest.mark.parametrize("text", ['median = "3 m"', 'median = "stiff"'])
def test_a_value_of_another_dimension_is_refused_with_its_path(tmp_path, text):
    (tmp_path / "model.toml").write_text(
        beal.dumps(beal.Vehicle(stages=[beal.Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)]))
    )
    law = f'{{distribution = "lognormal", {text}, cv = 0.1}}'
    study = f'model = "model.toml"\n[uncertain]\n"stage[0].bending_stiffness" = {law}\n'
    (tmp_path / "study.toml").write_text(study)
    with pytest.raises(beal.ModelError, match=r"uncertain\.stage\[0\]\.bending_stiffness: "):
        load_uncertainty(tmp_path / "study.toml")
