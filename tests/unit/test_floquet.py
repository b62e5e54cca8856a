"""Contracts of the multipliers, the resonances and the chart of a pulsating thrust."""

import math
from itertools import pairwise

import numpy as np
import pytest

import beal
from beal.stability.periodic import pulsating_equations
from beal.stability.resonances import nearest, resonances
from beal.vehicle import Thrust, catalog

BECK = catalog.beck()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"thrust": -1.0}, "thrust: must be finite and not negative, found -1"),
        ({"thrust": math.nan}, "thrust: must be finite and not negative, found nan"),
        ({"amplitude": -0.5}, "amplitude: must be finite and not negative, found -0.5"),
        ({"amplitude": math.inf}, "amplitude: must be finite and not negative, found inf"),
        ({"angular_frequency": 0.0}, "angular_frequency: must be positive and finite, found 0"),
        ({"angular_frequency": -3.0}, "angular_frequency: must be positive and finite, found -3"),
        ({"angular_frequency": math.nan}, "angular_frequency: must be positive and finite, found nan"),
        ({"angular_frequency": 1e4}, "must not exceed that of the highest mode kept, .*; keep more than 8 modes"),
        ({"angular_frequency": 1e-9}, "a period holds .* oscillations of the highest mode kept"),
        ({"thrust": 200.0, "angular_frequency": 0.05}, "at 0.05 a motion outgrows all numbers in a period; raise it"),
        ({"modes": 0}, "modes: must be at least 1, found 0"),
    ],
)
def test_a_pulsation_that_is_none_is_refused(given, message):
    with pytest.raises(beal.ModelError, match=message):
        beal.floquet(**({"vehicle": BECK, "thrust": 5.0, "amplitude": 1.0, "angular_frequency": 8.0} | given))


@pytest.mark.parametrize(
    ("frequencies", "amplitudes", "name"),
    [
        ([2.0, 1.0], [1.0], "angular_frequencies"),
        ([1.0, 1.0], [1.0], "angular_frequencies"),
        ([1.0, math.nan], [1.0], "angular_frequencies"),
        ([1.0], [], "amplitudes"),
    ],
)
def test_lists_that_do_not_ascend_are_refused(frequencies, amplitudes, name):
    with pytest.raises(beal.ModelError, match=f"{name}: must be numbers in ascending order"):
        beal.floquet_chart(BECK, 5.0, frequencies, amplitudes)


def test_without_amplitude_the_multipliers_are_those_of_free_motion():
    found = beal.floquet(BECK, 5.0, 0.0, 7.0, modes=4)
    omega = beal.spectrum(beal.discretise(BECK, order=24), 5.0, 4).angular_frequency
    expected = np.exp(2j * np.pi / 7.0 * omega)
    assert max(np.abs(found.multipliers - value).min() for value in (*expected, *expected.conj())) < 1e-9
    assert found.stable
    assert found.steady_growth_rate == 0.0


def test_a_mean_thrust_beyond_the_critical_one_is_told_and_answered():
    found = beal.floquet(BECK, 22.0, 0.1, 7.0)
    growth = beal.spectrum(beal.discretise(BECK, order=24), 22.0, 2).growth_rate.max()
    assert found.steady_growth_rate == pytest.approx(growth, rel=1e-9)
    assert not found.stable
    assert found.growth_rate == pytest.approx(growth, rel=0.05)


def test_a_motion_that_grows_by_many_powers_of_ten_keeps_its_rate():
    found = beal.floquet(BECK, 40.0, 1e-6, 0.5)
    growth = beal.spectrum(beal.discretise(BECK, order=24), 40.0, 2).growth_rate.max()
    assert found.largest_modulus > 1e20
    assert found.growth_rate == pytest.approx(growth, rel=1e-8)


def test_rigid_body_motions_that_only_follow_are_left_out_and_counted():
    found = beal.floquet(catalog.beal(), 20.0, 2.0, 39.0)
    assert (found.rigid_body_modes, len(found.multipliers)) == (2, 16)


def test_a_vehicle_that_tumbles_is_unstable_without_pulsation():
    tumbling = catalog.beal().model_copy(update={"thrust": Thrust(tangency=0.5)})
    found = beal.floquet(tumbling, 20.0, 2.0, 30.0)
    assert not found.stable
    assert found.steady_growth_rate > 0
    assert len(found.multipliers) > 16


def test_half_widths_are_of_first_order():
    found = {r.name: r for r in resonances(pulsating_equations(beal.discretise(BECK, order=24), 5.0, 8))}
    w1, w2 = (found[f"2 w{n}"].angular_frequency / 2 for n in (1, 2))
    assert found["2 w1"].opening == pytest.approx(1.36286829 / (2 * w1), rel=1e-8)
    assert found["2 w2"].opening == pytest.approx(13.92130845 / (2 * w2), rel=1e-8)
    assert found["w2 - w1"].opening == pytest.approx(math.sqrt(31.51937207 / (w1 * w2)) / 2, rel=1e-8)
    assert "w2 + w1" not in found
    assert found["(w2 - w1)/2"].angular_frequency == pytest.approx((w2 - w1) / 2)
    assert all(a.angular_frequency <= b.angular_frequency for a, b in pairwise(found.values()))


def test_the_tongue_around_a_pulsation_comes_before_a_nearer_resonance():
    found = resonances(pulsating_equations(beal.discretise(BECK, order=24), 15.0, 8))
    assert nearest(found, 9.0, 0.0).name == "w2 - w1"
    assert nearest(found, 13.1, 0.5).name == "2 w1"
    assert nearest(found, 16.2, 0.5).name == "2 w2/2"
    assert nearest(found, 16.2, 10.0).name == "2 w1"
    assert nearest([], 16.2, 10.0) is None


@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_a_chart_holds_what_single_points_give(damping):
    stage = BECK.stages[0].model_copy(update={"external_damping": damping})
    column = BECK.model_copy(update={"stages": (stage,)})
    amplitudes = np.linspace(0.0, 6.0, 25)
    chart = beal.floquet_chart(column, 5.0, [8.0, 16.3, 41.0], amplitudes)
    for omega in (8.0, 16.3, 41.0):
        for amplitude in amplitudes[::6]:
            point = chart.sel(angular_frequency=omega, amplitude=amplitude)
            found = beal.floquet(column, 5.0, float(amplitude), omega)
            assert float(point.largest_modulus) == pytest.approx(found.largest_modulus, abs=2e-6)
            assert bool(point.stable) == found.stable
            assert float(point.growth_rate) == pytest.approx(found.growth_rate, abs=2e-5)
    assert not chart.stable.all()


def test_a_chart_names_the_resonances_within():
    chart = beal.floquet_chart(BECK, 5.0, [8.0, 17.0], [0.0, 1.0])
    kinds = np.array(chart.resonance_kind.attrs["flag_meanings"].split())[chart.resonance_kind]
    assert kinds.tolist() == ["difference", "principal", "difference"]
    assert chart.resonance_low.values.tolist() == chart.resonance_low.values.tolist()
    assert chart.resonance_order.values.tolist() == [2, 1, 1]
    assert chart.attrs["thrust"] == 5.0


def test_progress_is_told_frequency_by_frequency():
    told = []
    beal.floquet_chart(BECK, 5.0, [8.0, 9.0], [1.0], progress=lambda *n: told.append(n))
    assert told == [(1, 2), (2, 2)]
