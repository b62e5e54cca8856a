"""What the plot functions put on the axes that they are given."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from beal import plot
from beal.discretisation import discretise
from beal.motion import ModeShape, amplitude_map, transient_growth
from beal.motion import response as solve
from beal.stability.critical import critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.spectrum import spectrum
from beal.vehicle import Force, Sine, catalog


@pytest.fixture
def ax():
    return Figure().subplots()


def chart(kind, low, high):
    """A map of 3 by 4 points with the given kind and modes."""
    axes = {"k": [1.0, 10.0, 100.0], "s": [1.0, 10.0, 100.0, 1000.0]}
    dims, shape = tuple(axes), (3, 4)
    values = {"critical_thrust": np.full(shape, 50.0), "kind": kind, "mode_low": low, "mode_high": high}
    return xr.Dataset({name: (dims, np.broadcast_to(value, shape)) for name, value in values.items()}, axes)


def labels(ax):
    return sorted(text.get_text() for text in ax.texts)


def test_a_joint_breaks_the_line_of_a_deflection(ax):
    operators = discretise(catalog.tsto(0.2, 3000.0, 300.0))
    plot.deflections(spectrum(operators, 0.0, 1), operators, ax)
    forward, aft = (line for line in ax.lines if len(line.get_xdata()) > 2)
    assert forward.get_xdata()[-1] == aft.get_xdata()[0] == pytest.approx(0.2)
    assert abs(forward.get_ydata()[-1] - aft.get_ydata()[0]) > 0.05


def test_deflections_are_scaled_to_one(ax):
    operators = discretise(catalog.tsto(0.2, 3000.0, 3000.0))
    plot.deflections(spectrum(operators, 0.0, 3), operators, ax)
    heights = [abs(line.get_ydata()).max() for line in ax.lines if len(line.get_xdata()) > 2]
    assert max(heights) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("joint", "name"), [((0.6, 5000.0, 5000.0), "flutter 1\N{EN DASH}2"), ((0.6, 1.0, 1e4), "divergence 1")]
)
def test_the_critical_thrust_is_marked_by_its_kind(ax, joint, name):
    vehicle = catalog.tsto(*joint)
    found = critical_thrust(vehicle)
    plot.thrust_curve(thrust_curve(vehicle, to=120.0, points=31, modes=2), ax, critical=found)
    mark = next(line for line in ax.lines if line.get_label().startswith(name))
    assert mark.get_xdata()[0] == found.critical_thrust
    assert mark.get_ydata()[0] == pytest.approx(found.angular_frequency)


def test_relative_frequencies_start_at_one(ax):
    plot.thrust_curve(thrust_curve(catalog.beal(), to=50.0, points=6, modes=2), ax, relative=True)
    first = next(line for line in ax.lines if line.get_label() == "mode 1")
    assert first.get_ydata()[0] == 1.0


def test_unstable_stretches_are_not_drawn_as_stable(ax):
    curve = thrust_curve(catalog.beal(), to=130.0, points=27, modes=2)
    plot.thrust_curve(curve, ax)
    first = next(line for line in ax.lines if line.get_label() == "mode 1")
    drawn = curve.thrust[np.isfinite(first.get_ydata())]
    assert drawn.max() < 109.69 < drawn.max() + 5.0


def test_a_map_names_its_regions(ax):
    kind = np.array([[2], [1], [1]])
    plot.stability_map(chart(kind, np.array([[1], [2], [2]]), np.array([[1], [3], [3]])), ax)
    assert labels(ax) == ["divergence 1", "flutter 2\N{EN DASH}3"]


def test_only_divergence_is_hatched(ax):
    kind = np.array([[2], [1], [1]])
    plot.stability_map(chart(kind, 1, 2), ax, colorbar=False)
    hatched = [collection for collection in ax.collections if collection.get_hatch()]
    assert [len(collection.get_paths()) for collection in hatched] == [4]


def test_a_border_parts_regions_of_different_modes(ax):
    low = np.array([[1], [1], [2]])
    plot.stability_map(chart(1, low, low + 1), ax, colorbar=False)
    assert {round(float(x), 6) for line in ax.lines for x in line.get_xdata()} == {round(10**1.5, 6)}


def test_a_uniform_map_has_no_border(ax):
    plot.stability_map(chart(1, 1, 2), ax, colorbar=False)
    assert ax.lines[:] == []
    assert labels(ax) == ["flutter 1\N{EN DASH}2"]


def test_maps_have_logarithmic_axes_with_units(ax):
    plot.stability_map(chart(1, 1, 2), ax, colorbar=False)
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")


@pytest.mark.parametrize(
    ("units", "labels"),
    [
        ("nondimensional", ["rotational stiffness $k_r L/EI$", "critical thrust $P L^2/EI$"]),
        ("SI", ["rotational stiffness $k_r$ (N m/rad)", "critical thrust P (N)"]),
    ],
)
def test_a_map_is_labelled_in_the_units_of_its_vehicle(ax, units, labels):
    found = chart(1, 1, 2).rename(k="joint[0].rotational_stiffness").assign_attrs(units=units)
    plot.stability_map(found, ax)
    assert [ax.get_xlabel(), ax.figure.axes[1].get_ylabel()] == labels


def test_a_map_over_two_joints_says_which_axis_is_which(ax):
    names = {"k": "joint[0].rotational_stiffness", "s": "joint[1].rotational_stiffness"}
    plot.stability_map(chart(1, 1, 2).rename(names).assign_attrs(units="SI"), ax, colorbar=False)
    words = "rotational stiffness $k_r$ (N m/rad)"
    assert [ax.get_xlabel(), ax.get_ylabel()] == [f"joint[0]: {words}", f"joint[1]: {words}"]


@pytest.mark.parametrize("quantity", ["displacement", "rate", "slope"])
def test_a_response_is_drawn_as_computed(ax, quantity):
    moved = solve(catalog.tsto(0.6, 5000.0, 5000.0), 0.5, 50.0, initial=ModeShape(1, 1e-3))
    plot.response(moved, ax, quantity=quantity)
    np.testing.assert_array_equal(ax.lines[-1].get_ydata(), getattr(moved, quantity)[0])


@pytest.mark.parametrize(("duration", "points", "words"), [(0.5, 1, []), (0.1, 0, ["turns less than twice"])])
def test_an_envelope_of_few_points_is_seen(ax, duration, points, words):
    vehicle = catalog.tsto(0.6, 5000.0, 5000.0)
    plot.envelope(solve(vehicle, duration, 50.0, initial=ModeShape(1, 1e-3), rigid_body=False), ax)
    (line,) = ax.lines
    assert (len(line.get_xdata()), line.get_marker(), labels(ax)) == (points, "o", words)


def test_a_trajectory_marks_where_it_starts(ax):
    moved = solve(catalog.tsto(0.6, 5000.0, 5000.0), 0.5, 50.0, initial=ModeShape(1, 1e-3))
    plot.trajectory(moved, ax)
    start = next(line for line in ax.lines if line.get_label() == "start")
    assert (start.get_xdata()[0], start.get_ydata()[0]) == (moved.displacement[0, 0], moved.rate[0, 0])


def test_transient_growth_is_drawn_between_its_bounds(ax):
    found = transient_growth(catalog.tsto(0.6, 5000.0, 5000.0), 90.0)
    plot.transient_growth(found, ax)
    curve, largest, *bounds = ax.lines
    np.testing.assert_array_equal(curve.get_ydata(), found.history)
    assert (largest.get_xdata()[0], largest.get_ydata()[0]) == (found.instant, found.growth)
    assert [line.get_ydata()[0] for line in bounds] == [found.lower_bound, found.upper_bound]
    assert ax.get_yscale() == "log"


def test_pseudospectra_surround_the_two_lowest_roots(ax):
    found = transient_growth(catalog.tsto(0.6, 5000.0, 5000.0), 90.0)
    plot.pseudospectrum(found, ax, nondimensional=False)
    roots = ax.lines[0].get_ydata()
    assert sorted(roots) == pytest.approx([12.3255726, 37.3518948])
    (contours,) = (item for item in ax.collections if hasattr(item, "levels"))
    reached = {level: path.vertices for level, path in zip(contours.levels, contours.get_paths(), strict=True)}
    points = reached[-0.75]
    assert len(points)
    distance = 1 / (12.3255726 * found.resolvent_norm(points[:, 0] + 1j * points[:, 1]))
    np.testing.assert_allclose(np.log10(distance), -0.75, atol=0.02)
    assert ax.get_xlabel() == "real part (1/s)"


def test_an_amplitude_map_is_drawn_with_a_logarithmic_colour(ax):
    push = Force(station=1.0, signal=Sine(kind="sine", amplitude=0.01, angular_frequency=2.0))
    vehicle = catalog.tsto(0.6, 5000.0, 5000.0).model_copy(update={"forces": (push,)})
    chart = amplitude_map(vehicle, 0.5, [0.0, 50.0, 100.0], [1.0, 2.0], modes=3)
    plot.amplitude_map(chart, ax)
    np.testing.assert_array_equal(ax.collections[0].get_array(), chart.amplitude.T)
    assert ax.figure.axes[1].get_yscale() == "log"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("thrust $P L^2/EI$", "multiple of the forces")
