"""What figures over thrust show: units, unstable stretches, marks, and the paths of roots."""

import matplotlib
import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from beal import plot
from beal.plot.style import RC
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.vehicle import Damping, Stage, Thrust, Vehicle, catalog

EN = "\N{EN DASH}"


@pytest.fixture
def ax():
    return Figure().subplots()


@pytest.fixture(scope="module")
def damped():
    """Beck's column with internal damping: its first mode begins to grow far below the undamped flutter."""
    beam = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0, internal_damping=5e-3)
    vehicle = catalog.beck().model_copy(update={"stages": (beam,)})
    return thrust_curve(vehicle, to=30.0, points=61, modes=2), critical_thrust(vehicle)


@pytest.fixture(scope="module")
def column():
    """Beck's column in SI units: L = 2 m, m = 3 kg/m, EI = 5e6 N m^2."""
    beam = Stage(length=2.0, mass_per_length=3.0, bending_stiffness=5e6)
    vehicle = Vehicle(stages=[beam], support=catalog.beck().support)
    return thrust_curve(vehicle, to=3e7, points=61, modes=2), critical_thrust(vehicle)


def labelled(ax, start):
    return [line for line in ax.lines if str(line.get_label()).startswith(start)]


def paths(ax):
    """Roots along each path, and the thrust of its pieces."""
    found = [one for one in ax.collections if isinstance(one, LineCollection)]
    return [(np.array(one.get_segments()), one.get_array()) for one in found]


def test_decay_is_not_drawn_as_instability(ax, damped):
    curve, critical = damped
    plot.thrust_curve(curve, ax)
    solid = np.isfinite(labelled(ax, "mode 1")[0].get_ydata())
    assert curve.thrust[solid].max() < critical.critical_thrust < curve.thrust[solid].max() + 0.5
    assert np.isfinite(labelled(ax, "mode 2")[0].get_ydata()).all()


def test_no_gap_is_left_where_a_line_becomes_dotted(ax, damped):
    curve, _ = damped
    plot.thrust_curve(curve, ax)
    (solid,) = labelled(ax, "mode 1")
    dotted = next(line for line in ax.lines if line.get_linestyle() == ":")
    both = np.isfinite(solid.get_ydata()) & np.isfinite(dotted.get_ydata())
    assert np.flatnonzero(both).tolist() == [np.flatnonzero(np.isfinite(solid.get_ydata()))[-1]]


def test_two_thrusts_are_enough(ax):
    curve = thrust_curve(catalog.beck(), to=24.0, points=2, modes=2)
    plot.thrust_curve(curve, ax)
    dotted = [line for line in ax.lines if line.get_linestyle() == ":"]
    assert [np.isfinite(line.get_ydata()).tolist() for line in dotted] == [[True, True], [True, True]]


def test_a_mode_that_begins_to_grow_is_named_once(ax, damped):
    curve, critical = damped
    plot.thrust_curve(curve, ax, critical)
    (mark,) = labelled(ax, "flutter 1, P = ")
    assert mark.get_marker() == "o"
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [mark.get_label()]


def test_modes_carry_their_numbers(ax):
    curve = thrust_curve(catalog.beal(), to=50.0, points=6, modes=3)
    plot.thrust_curve(curve, ax)
    assert [(text.get_text(), text.xy[1]) for text in ax.texts] == [
        (str(n + 1), omega) for n, omega in enumerate(curve.angular_frequency[0])
    ]


def test_thrusts_in_si_units_have_a_prefix(ax, column):
    curve, critical = column
    plot.thrust_curve(curve, ax, critical, nondimensional=False)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("thrust P (MN)", r"frequency $\omega$ (rad/s)")
    assert ax.xaxis.get_major_formatter()(2e7) == "20"
    assert critical.critical_thrust == pytest.approx(20.0509536 * 5e6 / 4)
    assert labelled(ax, f"flutter 1{EN}2, P = 25.064 MN")


def test_changes_beyond_the_critical_thrust_are_marked_smaller(ax):
    vehicle = catalog.tsto(0.8, 20.0, 1000.0)
    curve, critical = thrust_curve(vehicle, to=300.0, points=61, modes=4), critical_thrust(vehicle)
    events = critical_events(vehicle, 300.0)
    plot.thrust_curve(curve, ax, critical, events=events)
    first, second = labelled(ax, f"flutter 1{EN}2, P = 86.652"), labelled(ax, f"flutter 3{EN}4, P = 281.54")
    assert [len(first), len(second)] == [1, 1]
    assert second[0].get_markersize() < first[0].get_markersize()
    assert second[0].get_xdata()[0] == events[-1].thrust


def test_a_stable_vehicle_has_no_mark(ax):
    vehicle = catalog.beck()
    plot.thrust_curve(thrust_curve(vehicle, to=10.0, points=6), ax, critical_thrust(vehicle, 10.0))
    assert ax.get_legend() is None


def test_a_vehicle_that_tumbles_is_marked_by_its_elastic_modes(ax):
    vehicle = catalog.beal().model_copy(update={"thrust": Thrust(tangency=0.9)})
    critical = critical_thrust(vehicle)
    assert critical.critical_thrust == 0.0
    plot.thrust_curve(thrust_curve(vehicle, to=150.0, points=16), ax, critical)
    marks = [line for line in ax.lines if "P =" in str(line.get_label())]
    assert [line.get_xdata()[0] for line in marks] == [critical.elastic.critical_thrust]
    assert marks[0].get_label().startswith(f"flutter rigid body{EN}1, P = ")


def test_a_vehicle_that_folds_without_resistance_is_marked_at_zero(ax):
    vehicle = catalog.tsto(0.6, 0.0, 5000.0)
    plot.thrust_curve(thrust_curve(vehicle, to=100.0, points=11), ax, critical_thrust(vehicle))
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["divergence 1, P = 0"]


def test_growth_above_zero_is_on_tinted_ground(ax, damped):
    curve, critical = damped
    plot.growth_rates(curve, ax, critical)
    for number, line in enumerate(labelled(ax, "mode")):
        np.testing.assert_array_equal(line.get_ydata(), curve.growth_rate[:, number])
    (tint,) = ax.patches
    assert tint.get_y() == 0.0
    assert tint.get_height() >= ax.get_ylim()[1]
    assert labelled(ax, "flutter 1")[0].get_ydata()[0] == 0.0


def test_roots_are_drawn_along_the_thrust(ax, damped):
    curve, critical = damped
    plot.root_locus(curve, ax, critical)
    for number, (pieces, thrust) in enumerate(paths(ax)):
        roots = np.concatenate((pieces[:, 0], pieces[-1:, 1]))
        np.testing.assert_array_equal(roots[:, 0], curve.growth_rate[:, number])
        np.testing.assert_array_equal(roots[:, 1], curve.angular_frequency[:, number])
        np.testing.assert_allclose(thrust, (curve.thrust[1:] + curve.thrust[:-1]) / 2)
    starts = [line for line in ax.lines if line.get_marker() == "o" and not str(line.get_label()).startswith("flutter")]
    assert [line.get_ydata()[0] for line in starts] == curve.angular_frequency[0].tolist()
    assert len([line for line in ax.lines if line.get_marker() == "s"]) == 2


def test_the_crossing_lies_on_the_path_and_the_imaginary_axis(ax, damped):
    curve, critical = damped
    plot.root_locus(curve, ax, critical)
    (mark,) = labelled(ax, "flutter 1")
    assert mark.get_xdata()[0] == 0.0
    crossing = np.interp(0.0, curve.growth_rate[15:30, 0], curve.angular_frequency[15:30, 0])
    assert mark.get_ydata()[0] == pytest.approx(crossing, rel=1e-3)


def test_the_unstable_half_plane_is_the_tinted_one(ax, damped):
    plot.root_locus(damped[0], ax)
    (tint,) = ax.patches
    left, right = ax.get_xlim()
    assert (tint.get_x(), tint.get_width()) == (0.0, right)
    assert left == -right


def test_a_root_locus_in_si_units_says_so(ax, column):
    plot.root_locus(column[0], ax, nondimensional=False)
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"real part $\sigma$ (1/s)", r"imaginary part $\omega$ (rad/s)")
    (_, thrust), *_ = paths(ax)
    assert thrust.max() < 30.0
    bar = next(other for other in ax.figure.axes if other is not ax)
    assert bar.get_ylabel() == "thrust P (MN)"


def test_roots_that_stay_on_the_axis_have_a_plane_to_lie_in(ax):
    plot.root_locus(thrust_curve(catalog.beck(), to=10.0, points=6), ax)
    assert ax.get_xlim()[1] > 1.0


def test_modal_damping_counts_as_damping(ax):
    vehicle = catalog.beck().model_copy(update={"damping": Damping(ratios=[0.01])})
    plot.thrust_curve(thrust_curve(vehicle, to=10.0, points=6, modes=2), ax)
    assert all(np.isnan(line.get_ydata()).all() for line in ax.lines if line.get_linestyle() == ":")


def test_letters_do_not_depend_on_the_settings_of_the_session(ax, column):
    curve, critical = column
    with matplotlib.rc_context({"legend.fontsize": 20.0}):
        plot.thrust_curve(curve, ax, critical)
    assert ax.get_legend().get_texts()[0].get_fontsize() == RC["legend.fontsize"]
