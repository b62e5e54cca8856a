"""Where the closed loop is stable, and the open one in Nyquist's and Nichols's plots."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from beal import (
    Control,
    Filter,
    Gain,
    ModelError,
    Sensor,
    catalog,
    closed_loop,
    control_map,
    controlled_thrust,
    open_loop,
    plot,
    stability_margins,
)


def missile(lag=0.02, damping=5e-4, station=0.6, **law):
    gains = [Gain(sensor="imu", quantity="slope", gain=0.6), Gain(sensor="imu", quantity="slope_rate", gain=0.15)]
    filters = [Filter(numerator=[1.0], denominator=[0.05, 1.0])] if lag else []
    control = Control(lag=lag, gains=gains, filters=filters) if lag else Control(gains=gains[:1])
    update = {"sensors": (Sensor(name="imu", station=station),), "control": control}
    return catalog.beal(internal_damping=damping).model_copy(update=update)


def test_the_first_border_is_the_largest_controlled_thrust():
    found = control_map(missile(), "sensor[0].station", [0.3, 0.6, 0.9], [10.0, 40.0])
    single = [controlled_thrust(missile(station=x), 40.0, modes=3).critical_thrust for x in (0.3, 0.6, 0.9)]
    np.testing.assert_allclose(found.border[:, 0], single, rtol=1e-5)  # here growth counts from 1e-8 of |s| on


def test_a_map_is_stable_where_the_closed_loop_is():
    thrusts = np.linspace(2.0, 30.0, 15)
    found = control_map(missile(), "sensor[0].station", [0.44, 0.45, 0.5], thrusts)
    expected = [[closed_loop(missile(station=x), P, 3).stable for P in thrusts] for x in (0.44, 0.45, 0.5)]
    np.testing.assert_array_equal(found.stable, expected)
    np.testing.assert_array_equal(found.damping_ratio > 0, expected)
    assert np.isfinite(found.border[1]).sum() == 3  # lost, found again and lost


def test_without_damping_the_borders_are_flutter_and_divergence():
    still = missile(lag=0.0, damping=0.0)
    found = control_map(still, "gain", [0.5, 1.0], [10.0, 60.0])
    assert found.border[:, 0].values == pytest.approx([25.638181376802] * 2, rel=1e-9)


def test_a_law_that_feeds_a_mode_at_once_has_a_border_at_no_thrust():
    law = Control(lag=0.02, gains=missile().control.gains[:1])
    fed = missile(damping=0.0).model_copy(update={"control": law})
    found = control_map(fed, "control.lag", [0.01, 0.02], [1.0, 5.0])
    assert found.border[:, 0].values.tolist() == [0.0, 0.0]
    assert not found.stable.any()


@pytest.mark.parametrize(
    ("over", "values", "thrusts", "message"),
    [
        ("thrust", [1.0, 2.0], [1.0, 2.0], "over: the thrust is one axis already"),
        ("gain", [2.0, 1.0], [1.0, 2.0], "values: must be at least two finite numbers in ascending order"),
        ("gain", [1.0], [1.0, 2.0], "values: must be at least two"),
        ("gain", [1.0, 2.0], [0.0, 2.0], "thrusts: must be positive, found 0"),
        ("control.leg", [1.0, 2.0], [1.0, 2.0], "control.leg: is not a quantity"),
    ],
)
def test_what_is_wrong_with_a_map_is_told(over, values, thrusts, message):
    with pytest.raises(ModelError, match=message):
        control_map(missile(), over, values, thrusts)


def test_the_open_loop_is_that_of_the_margins():
    found, loop = stability_margins(missile(), 8.0, modes=3), open_loop(missile(), 8.0, modes=3)
    for margin in found.gain:
        assert loop.frequency_response(margin.angular_frequency)[0, 0] == pytest.approx(-1 / margin.factor, rel=1e-9)
    assert loop.to_control().ninputs == 1


def test_the_closed_loop_is_the_open_one_closed():
    loop = open_loop(missile(), 8.0, modes=3)
    closed = np.linalg.eigvals(loop.A - loop.B @ loop.C / (1 + loop.D))
    for root in closed_loop(missile(), 8.0, modes=3).roots[2:]:
        assert np.abs(closed - root).min() < 1e-6 * abs(root)


@pytest.mark.parametrize("draw", [plot.nyquist, plot.nichols])
def test_the_open_loop_is_drawn_with_its_margins_and_the_critical_point(draw):
    ax = draw(open_loop(missile(), 8.0, 3), Figure().subplots(), stability_margins(missile(), 8.0, 3))
    assert {"critical point", "gain margin", "phase margin"} <= set(ax.get_legend_handles_labels()[1])
    critical = next(line for line in ax.lines if line.get_label() == "critical point")
    assert critical.get_xydata().tolist() == [[-180.0, 0.0] if draw is plot.nichols else [-1.0, 0.0]]


def test_a_map_is_drawn_with_its_borders():
    found = control_map(missile(), "gain", np.geomspace(0.1, 3.0, 5), [5.0, 20.0, 40.0])
    ax = plot.control_map(found, Figure().subplots())
    assert ax.get_xscale() == "log"
    assert ax.get_xlabel() == "factor on all gains"
    assert ax.lines[0].get_ydata().tolist() == found.border[:, 0].values.tolist()
