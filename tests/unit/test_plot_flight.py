"""What the drawing of a flight shows."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from beal import plot
from beal.errors import ModelError
from beal.stability.critical import CriticalThrust
from beal.study.flight import Flight, FlightState


def state(time, thrust, critical, stages=(1, 2), kind="flutter", first=1.0):
    """A state with two modes whose vehicle bears ``critical``."""
    borne = None if kind == "stable" else critical
    found = CriticalThrust(borne, kind, None, 1.0, 0.0, "objective", critical, 8, "neutral")
    return FlightState(time, thrust, 1.0, stages, (first, 3 * first), (0.0, 0.0), found)


def drawn(*states, units="SI"):
    upper = plot.flight(Flight(states, units), Figure().subplots())
    return upper, upper.figure.axes[-1]


ASCENT = [state(0.0, 10.0, 50.0), state(1.0, 12.0, 60.0), state(2.0, 12.0, 30.0, kind="divergence")]


def labelled(ax):
    return {line.get_label(): line for line in ax.lines if not line.get_label().startswith("_")}


def test_frequencies_are_above_and_thrusts_below_on_one_time():
    above, below = drawn(*ASCENT)
    assert above.get_position().y0 > below.get_position().y1
    assert above.get_shared_x_axes().joined(above, below)
    assert list(labelled(above)) == ["mode 1", "mode 2"]
    np.testing.assert_allclose(labelled(above)["mode 2"].get_ydata(), 3 / (2 * np.pi))
    assert list(labelled(below)) == ["critical, flutter", "critical, divergence", "actual"]
    np.testing.assert_array_equal(labelled(below)["critical, flutter"].get_ydata(), [50.0, 60.0, np.nan])
    np.testing.assert_array_equal(labelled(below)["critical, divergence"].get_ydata(), [np.nan, np.nan, 30.0])
    np.testing.assert_array_equal(labelled(below)["actual"].get_ydata(), [10.0, 12.0, 12.0])


def test_the_smallest_margin_is_written_and_a_bound_is_one():
    assert "smallest margin 1.5" in [text.get_text() for text in drawn(*ASCENT)[1].texts]
    stable = state(0.0, 10.0, 50.0, kind="stable")
    ax = drawn(stable)[1]
    assert "smallest margin \N{GREATER-THAN OR EQUAL TO} 4" in [text.get_text() for text in ax.texts]
    assert labelled(ax)["stable up to"].get_marker() == "^"


def test_an_overload_is_shaded_in_another_colour():
    def bands(*states):
        return {tuple(band.get_facecolor()[0]) for band in drawn(*states)[1].collections if band.get_paths()}

    assert len(bands(*ASCENT)) == 1
    assert len(bands(*ASCENT, state(3.0, 40.0, 30.0), state(4.0, 45.0, 30.0))) == 2
    assert "smallest margin \N{MINUS SIGN}0.333" in [
        text.get_text() for text in drawn(*ASCENT, state(4.0, 45.0, 30.0))[1].texts
    ]


def test_a_separation_is_a_line_at_its_time_and_breaks_the_curves():
    above, below = drawn(*ASCENT, state(4.0, 12.0, 30.0, (1, 1)), state(6.0, 12.0, 30.0, (1, 1)))
    for ax in (above, below):
        (line,) = [line for line in ax.lines if np.array_equal(line.get_xdata(), [3.0, 3.0])]
        assert np.array_equal(line.get_ydata(), [0, 1])
    assert "stage 1" in [text.get_text() for text in above.texts]
    curves = [list(line.get_xdata()) for line in above.lines if line.get_marker() == "o"]
    assert curves == [[0.0, 1.0, 2.0], [4.0, 6.0]] * 2


def test_values_that_are_far_apart_have_logarithmic_axes():
    near, far = drawn(*ASCENT), drawn(state(0.0, 1.0, 300.0), state(1.0, 1.0, 300.0, first=100.0))
    assert [ax.get_yscale() for ax in (*near, *far)] == ["linear", "linear", "log", "log"]


def test_coasting_and_failed_times_leave_gaps():
    failed = FlightState(2.0, 10.0, 1.0, (1, 2), status="not_converged", reason="lost")
    above, below = drawn(state(0.0, 10.0, 50.0), state(1.0, 0.0, 50.0), failed)
    np.testing.assert_array_equal(np.isnan(labelled(below)["actual"].get_ydata()), [False, True, False])
    np.testing.assert_array_equal(np.isnan(labelled(below)["critical, flutter"].get_ydata()), [False, False, True])
    np.testing.assert_array_equal(np.isnan(labelled(above)["mode 1"].get_ydata()), [False, False, True])


def test_a_flight_that_failed_throughout_is_drawn_empty():
    failed = FlightState(2.0, 10.0, 1.0, (1, 2), status="not_converged", reason="lost")
    assert list(labelled(drawn(failed)[1])) == ["actual"]


def test_labels_have_units_in_si_alone():
    si, plain = ([ax.get_ylabel() for ax in drawn(*ASCENT, units=units)] for units in ("SI", "nondimensional"))
    assert (si, plain) == (["frequency (Hz)", "thrust"], ["angular frequency", "thrust"])
    assert drawn(*ASCENT)[1].get_xlabel() == "time (s)"


def test_axes_that_have_no_place_in_a_grid_are_refused():
    with pytest.raises(ModelError, match="must be one of a grid"):
        plot.flight(Flight(tuple(ASCENT), "SI"), Figure().add_axes((0, 0, 1, 1)))
