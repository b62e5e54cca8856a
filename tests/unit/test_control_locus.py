"""The roots of the closed loop as something varies, and their drawing."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from beal import Control, Filter, Gain, Joint, ModelError, Sensor, catalog, closed_loop, control_locus, plot


def missile(vehicle=None, factor=1.0):
    gains = [Gain(sensor="imu", quantity=name, gain=factor * k) for name, k in (("slope", 0.6), ("slope_rate", 0.15))]
    law = Control(lag=0.02, gains=gains, filters=[Filter(numerator=[1.0], denominator=[0.05, 1.0])])
    update = {"sensors": (Sensor(name="imu", station=0.6),), "control": law}
    return (vehicle or catalog.beal(internal_damping=5e-4)).model_copy(update=update)


def assert_same(found, roots):
    """Every root of a row of a locus is one of the roots."""
    assert np.abs(found[:, None] - roots).min(axis=1).max() < 1e-7 * np.abs(roots).max()


def test_the_roots_at_each_value_are_those_of_the_closed_loop():
    over_gain = control_locus(missile(), "gain", [0.5, 1.0, 1.7], thrust=8.0)
    for factor, row in zip(over_gain.values, over_gain.roots, strict=True):
        assert_same(row, closed_loop(missile(factor=factor), 8.0, modes=4).roots)
    over_thrust = control_locus(missile(), "thrust", [4.0, 8.0])
    assert_same(over_thrust.roots[1], closed_loop(missile(), 8.0, modes=4).roots)


def test_any_quantity_may_vary():
    jointed = catalog.tsto(0.6, 50.0, 1e4)
    found = control_locus(missile(jointed), "joint[0].rotational_stiffness", [50.0, 400.0], thrust=8.0, modes=2)
    stiffer = jointed.model_copy(update={"joints": (Joint(rotational_stiffness=400.0, shear_stiffness=1e4),)})
    assert_same(found.roots[1], closed_loop(missile(stiffer), 8.0, modes=4).roots)


def test_a_root_keeps_its_column_however_far_the_values_lie_apart():
    coarse = control_locus(missile(), "thrust", np.linspace(2.0, 80.0, 3))
    fine = control_locus(missile(), "thrust", np.linspace(2.0, 80.0, 161))
    assert np.abs(np.diff(fine.roots, axis=0)).max() < 4.0  # nothing jumps
    np.testing.assert_allclose(coarse.roots, fine.roots[::80], rtol=1e-6, atol=1e-6)


def test_the_margin_is_where_a_path_crosses_the_axis():
    found = control_locus(missile(), "gain", [1.5, 1.5582659703, 1.6], thrust=8.0)
    crossing = found.roots[:, np.abs(found.roots[1] - 27.303102966j).argmin()]
    assert crossing.real[0] < 0 < crossing.real[2]
    assert abs(crossing.real[1]) < 1e-6


@pytest.mark.parametrize(
    ("over", "values", "message"),
    [
        ("gain", [1.0], "values: must be at least two"),
        ("gain", [1.0, np.nan], "values: must be at least two finite numbers"),
        ("joint[0].shear_stiffness", [1.0, 2.0], "joint"),
        ("control.lag", [0.1, 0.0], "leave out 0 for a lag or delay"),
        ("control.lag", [0.1, -0.1], "control.lag: must be greater than or equal to 0"),
    ],
)
def test_what_is_wrong_with_a_locus_is_told(over, values, message):
    with pytest.raises(ModelError, match=message):
        control_locus(missile(), over, values, thrust=8.0)


def test_the_drawing_shows_every_path_of_the_upper_half():
    locus = control_locus(missile(), "gain", np.linspace(0.0, 2.0, 11), thrust=8.0)
    ax = plot.control_locus(locus, Figure().subplots())
    assert ax.get_ylabel() == r"imaginary part $\omega\sqrt{mL^4/EI}$"
    assert ax.figure.axes[1].get_ylabel() == "factor on all gains"
    low, high = ax.get_xlim()
    assert low < locus.roots.real.min() < locus.roots.real.max() < high
    ends = [line.get_xydata()[0] for line in ax.lines if line.get_marker() == "s"]
    upper = locus.roots[-1][locus.roots[-1].imag >= 0]
    drawn = [complex(*end) for end in ends if np.isfinite(end).all()]
    np.testing.assert_allclose(np.sort_complex(drawn), np.sort_complex(upper))
