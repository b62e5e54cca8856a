"""What a chart of a pulsating thrust shows."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import beal
from beal import plot
from beal.vehicle import catalog


@pytest.fixture(scope="module")
def chart():
    return beal.floquet_chart(catalog.beck(), 5.0, np.linspace(6.0, 22.0, 33), np.linspace(0.0, 3.0, 13))


def test_growth_is_coloured_and_stability_left_white(chart):
    ax = plot.floquet_chart(chart, Figure().subplots())
    shown = ax.collections[0].get_array()
    assert (shown.mask == chart.stable.values.T).all()
    assert np.allclose(shown.compressed(), chart.growth_rate.values.T[~shown.mask])
    assert (ax.get_xlim(), ax.get_ylim()) == ((6.0, 22.0), (0.0, 3.0))


def test_tongues_are_named_at_their_resonances(chart):
    ax = plot.floquet_chart(chart, Figure().subplots())
    named = {text.get_text(): text.xy[0] for text in ax.texts}
    w1, w2 = beal.spectrum(beal.discretise(catalog.beck(), order=24), 5.0, 2).angular_frequency
    assert named[r"$2 \omega_1$"] == pytest.approx(2 * w1)
    assert named[r"$\omega_2 - \omega_1$"] == pytest.approx(w2 - w1)
    marks = [line.get_xdata()[0] for line in ax.lines]
    assert sorted(marks) == pytest.approx(chart.resonance_angular_frequency.values)


def test_names_that_would_cover_each_other_are_left_out(chart):
    names = [text.get_text() for text in plot.floquet_chart(chart, Figure().subplots()).texts]
    assert r"$(\omega_2 - \omega_1)/2$" not in names  # beside 2 w1, which is of first order


def test_axes_have_units(chart):
    ax = plot.floquet_chart(chart, Figure().subplots())
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"angular frequency $\Omega$", "amplitude $P_1 L^2/EI$")
    heavy = chart.assign_coords(amplitude=1e3 * chart.amplitude).assign_attrs(units="SI")
    ax = plot.floquet_chart(heavy, Figure().subplots())
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"angular frequency $\Omega$ (rad/s)", "amplitude $P_1$ (kN)")
    assert ax.get_ylim() == (0.0, 3.0)


def test_a_chart_without_a_tongue_is_drawn():
    quiet = beal.floquet_chart(catalog.beck(), 5.0, [6.0, 6.5], [0.0, 0.5])
    ax = plot.floquet_chart(quiet, Figure().subplots())
    assert ax.collections[0].get_array().mask.all()
