"""Uncertain vehicles whose critical thrust has a known distribution, and functions whose indices are known."""

import math

import numpy as np
import pytest
from scipy import stats

from beal.design.distributions import Distribution
from beal.design.indices import morris_effects, sobol_indices, thrust_output
from beal.design.reliability import probability_of_instability, thrust_quantile
from beal.design.sampling import sample, solve_values
from beal.design.uncertain import Uncertain
from beal.stability.critical import critical_thrust
from beal.vehicle import catalog
from beal.vehicle.paths import with_values

BECK = 20.0509536  # Beck (1952), P L^2/EI
ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
SIGMA = math.sqrt(math.log1p(0.1**2))


@pytest.fixture(scope="module")
def beck():
    """P = 20.05 EI/L^2, so that a lognormal stiffness gives a lognormal critical thrust."""
    law = Distribution.lognormal(median=1.0, cv=0.1)
    return sample(Uncertain(catalog.beck(), {"stage[0].bending_stiffness": law}), 128, workers=1)


def test_the_quantiles_of_becks_column_are_lognormal(beck):
    exact = BECK * beck.values[:, 0]
    assert beck.critical_thrust == pytest.approx(exact, rel=1e-6)  # that asked for
    for probability in (0.1, 0.5, 0.9):
        found = thrust_quantile(beck, probability)
        assert found.low < BECK * math.exp(SIGMA * stats.norm.ppf(probability)) < found.high


def test_the_probability_of_instability_of_becks_column_is_exact(beck):
    for thrust in (18.5, 20.0, 21.0):
        found = probability_of_instability(beck, thrust)
        exact = stats.norm.cdf(math.log(thrust / BECK) / SIGMA)
        assert found.low < exact < found.high
        assert found.value == pytest.approx(exact, abs=1 / 32)


@pytest.fixture(scope="module")
def paper():
    laws = {ROTATIONAL: Distribution.lognormal(10.0, 0.5), SHEAR: Distribution.lognormal(200.0, 0.5)}
    return Uncertain(catalog.tsto(0.6, 10.0, 200.0), laws)


def test_vehicles_on_the_kernel_agree_with_each_by_itself(paper):
    found = sample(paper, 64, "monte-carlo", seed=3)
    for values, thrust in zip(found.values[:12], found.critical_thrust, strict=False):
        alone = critical_thrust(with_values(paper.vehicle, dict(zip(found.paths, values, strict=True))))
        assert thrust == pytest.approx(alone.critical_thrust, rel=1e-6)


def test_the_error_of_random_numbers_falls_as_the_square_root_and_that_of_sobol_faster(paper):
    exact = probability_of_instability(sample(paper, 2**17, seed=99), 60.0).value
    error = {}
    for method in ("monte-carlo", "sobol"):
        for samples in (2**10, 2**14):
            found = [sample(paper, samples, method, seed) for seed in range(10)]
            differences = [probability_of_instability(each, 60.0).value - exact for each in found]
            error[method, samples] = math.sqrt(np.mean(np.square(differences)))
    fall = {method: error[method, 2**10] / error[method, 2**14] for method in ("monte-carlo", "sobol")}
    assert 2 < fall["monte-carlo"] < 8  # 4 but for the scatter of ten
    assert error["sobol", 2**14] < error["monte-carlo", 2**14] / 3


def test_intervals_hold_the_truth_as_often_as_they_say(paper):
    exact = probability_of_instability(sample(paper, 2**17, seed=99), 60.0).value
    for method in ("monte-carlo", "sobol"):
        found = [probability_of_instability(sample(paper, 1024, method, seed), 60.0) for seed in range(60)]
        assert sum(each.low <= exact <= each.high for each in found) >= 52  # of 60 at 95 %: below with chance 0.5 %


def test_correlations_are_those_asked_for():
    laws = {ROTATIONAL: Distribution.lognormal(10.0, 0.5), SHEAR: Distribution.uniform(100.0, 300.0)}
    cube = np.random.default_rng(5).random((100_000, 2))
    for measure, found in (("spearman", stats.spearmanr), ("pearson", stats.pearsonr)):
        uncertain = Uncertain(catalog.tsto(0.6, 10.0, 200.0), laws, {(ROTATIONAL, SHEAR): -0.6}, measure)
        assert found(*uncertain.values(cube).T)[0] == pytest.approx(-0.6, abs=0.01)


def test_the_nataf_correlation_of_two_lognormal_laws_is_the_closed_form():
    """Der Kiureghian and Liu (1986): rho_z = ln(1 + rho cv1 cv2) / sqrt(ln(1 + cv1^2) ln(1 + cv2^2))."""
    laws = {ROTATIONAL: Distribution.lognormal(10.0, 0.5), SHEAR: Distribution.lognormal(200.0, 0.3)}
    uncertain = Uncertain(catalog.tsto(0.6, 10.0, 200.0), laws, {(ROTATIONAL, SHEAR): 0.4}, "pearson")
    exact = math.log1p(0.4 * 0.5 * 0.3) / math.sqrt(math.log1p(0.25) * math.log1p(0.09))
    assert uncertain.scores[0, 1] == pytest.approx(exact, rel=1e-6)


def ishigami(cube):
    z = np.pi * (2 * cube - 1)
    return np.sin(z[:, 0]) + 7 * np.sin(z[:, 1]) ** 2 + 0.1 * z[:, 2] ** 4 * np.sin(z[:, 0])


def sobol_g(cube, a=(0.0, 1.0, 4.5)):
    return np.prod((np.abs(4 * cube - 2) + a) / (1 + np.array(a)), axis=1)


def test_the_indices_of_ishigami_are_the_exact_ones():
    v1, v2, v13 = 0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 49 / 8, 0.01 * np.pi**8 * 8 / 225
    total = v1 + v2 + v13
    exact = ((v1 / total, v2 / total, 0.0), ((v1 + v13) / total, v2 / total, v13 / total))
    check(sobol_indices(ishigami, "abc", 4096), exact, 0.02)


def test_the_indices_of_the_g_function_are_the_exact_ones():
    v = 1 / (3 * (1 + np.array([0.0, 1.0, 4.5])) ** 2)
    total = np.prod(1 + v) - 1
    exact = (v / total, [v[n] * np.prod(1 + np.delete(v, n)) / total for n in range(3)])
    check(sobol_indices(sobol_g, "abc", 4096), exact, 0.02)


def check(found, exact, tolerance):
    for estimates, truths in zip((found.first, found.total), exact, strict=True):
        for estimate, truth in zip(estimates, truths, strict=True):
            assert estimate.value == pytest.approx(truth, abs=tolerance)
            assert estimate.low - 1e-3 <= truth <= estimate.high + 1e-3


def test_the_indices_of_the_papers_vehicle_converge_within_their_error_bars(paper):
    output = thrust_output(paper, workers=1)
    coarse, fine = (sobol_indices(output, (ROTATIONAL, SHEAR), n) for n in (512, 8192))
    for rough, sharp in zip(coarse.first + coarse.total, fine.first + fine.total, strict=True):
        assert sharp.high - sharp.low < 0.5 * (rough.high - rough.low)
        assert rough.low < sharp.value < rough.high
    assert sum(index.value for index in fine.first) < 1 < sum(index.value for index in fine.total)


def test_the_elementary_effects_of_a_sum_are_its_factors():
    found = morris_effects(lambda x: x @ np.array([3.0, -2.0, 0.0]), "abc")
    assert [each.value for each in found.mean_absolute] == pytest.approx([3.0, 2.0, 0.0], abs=1e-12)
    assert found.mean == pytest.approx((3.0, -2.0, 0.0), abs=1e-12)
    assert found.deviation == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_vehicles_with_other_quantities_are_solved_in_processes_as_well(paper):
    laws = {"stage.split": Distribution.uniform(0.4, 0.6), ROTATIONAL: paper.distributions[ROTATIONAL]}
    uncertain = Uncertain(paper.vehicle, laws)
    values = uncertain.values(np.random.default_rng(0).random((112, 2)))
    shared, alone = (solve_values(uncertain, values, workers=n)[0] for n in (2, 1))
    np.testing.assert_array_equal(shared, alone)
