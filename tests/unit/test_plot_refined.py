"""What is drawn of a refined map: borders where they are, contour lines that end at them."""

from io import BytesIO

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import LineCollection, TriMesh
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.tri import TriContourSet

from beal import plot
from beal.errors import ModelError
from beal.study.lattice import Lattice
from beal.study.refine import refine
from beal.study.refined import SIDES, RefinedMap
from beal.study.variables import VARIABLES, empty

WIDTH = 0.01


def refined(field):
    """A map over two logarithmic axes; the field says what is at shares of them."""
    axes = {"k": tuple(np.geomspace(1, 1e4, 11)), "s": tuple(np.geomspace(1e2, 1e4, 11))}
    lattice = Lattice(axes, WIDTH)

    def solve(places):
        share = np.column_stack(
            [lattice.share(name, v) for name, v in zip(axes, lattice.values(places).T, strict=True)]
        )
        arrays = empty((len(places),))
        arrays |= {"status": np.ones(len(places), int)} | field(*share.T)
        return arrays

    grid = solve(lattice.grid_points())
    found = refine(lattice, grid, solve)
    values = lattice.values(found.places)
    points = {name: ("point", found.arrays[name]) for name in VARIABLES}
    cells = {
        "low": (("cell", "axis"), lattice.values(found.low)),
        "high": (("cell", "axis"), lattice.values(found.high)),
    }
    cells |= {f"side_{name}": (("cell", "side"), found.sides[name]) for name in SIDES}
    coordinates = {name: ("point", v) for name, v in zip(axes, values.T, strict=True)}
    return RefinedMap(
        xr.Dataset(
            {name: (tuple(axes), grid[name].reshape(11, 11)) for name in VARIABLES},
            {name: np.array(v) for name, v in axes.items()},
        ),
        xr.Dataset(points | cells, coordinates, {"width": WIDTH, "spacing": ["log", "log"]}),
    )


def cliff(x, y):
    """Divergence left of a slanting line, flutter at a higher thrust right of it."""
    left = x < 0.3 + 0.2 * y
    return {
        "kind": np.where(left, 2, 1),
        "mode_low": np.ones(len(x), int),
        "mode_high": np.where(left, 1, 2),
        "critical_thrust": np.where(left, 40.0, 70.0) + 20 * x,
    }


def jump(x, y):
    """The same with one name on both sides."""
    return cliff(x, y) | {"kind": np.ones(len(x), int), "mode_high": np.full(len(x), 2)}


@pytest.fixture
def ax():
    return Figure().subplots()


def beside(places):
    """How far places in the spacing of the axes, here decades, lie from the cliff, as a share of the map."""
    x, y = places[:, 0] / 4, (places[:, 1] - 2) / 2
    return np.abs(x - 0.3 - 0.2 * y)


def lines(ax, width):
    """Vertices of what is drawn as contours with a line width."""
    drawn = (c for c in ax.collections if isinstance(c, TriContourSet) and c.get_linewidths()[0] == width)
    return [part for c in drawn for level in c.allsegs for part in level if len(part)]


def test_the_border_is_drawn_where_it_is(ax):
    plot.stability_map(refined(cliff), ax)
    border = np.concatenate(lines(ax, 1.3))
    assert beside(border).max() < WIDTH
    assert np.ptp(border, axis=0) == pytest.approx([0.2 * 4, 2.0], abs=0.05)


def test_a_jump_inside_a_region_is_drawn_as_a_border(ax):
    plot.stability_map(refined(jump), ax)
    (cuts,) = (c for c in ax.collections if isinstance(c, LineCollection) and not isinstance(c, ContourSet))
    places = np.concatenate([path.vertices for path in cuts.get_paths()])
    assert beside(places).max() < 0.1 / 16 / 2 + 1e-9  # half a cell: the ends halve sides that the cliff crosses
    assert np.ptp(places, axis=0) == pytest.approx([0.2 * 4, 2.0], abs=0.05)
    assert lines(ax, 1.3) == []


@pytest.mark.parametrize("field", [cliff, jump])
def test_contour_lines_end_at_a_cliff(ax, field):
    plot.stability_map(refined(field), ax, levels=[44.5, 60.0, 65.0, 81.0])
    contours = np.concatenate(lines(ax, 0.7))  # of 44.5 on the left and of 81 on the right; the others lie between
    assert np.unique(contours[:, 0].round(6)).tolist() == [4 * 0.225, 4 * 0.55]


def test_a_refined_map_names_its_regions_and_hatches_divergence_on_the_axes_of_its_spacing(ax):
    plot.stability_map(refined(cliff), ax)
    assert sorted(text.get_text() for text in ax.texts if len(text.get_text()) > 3) == [
        "divergence 1",
        "flutter 1\N{EN DASH}2",
    ]
    assert [c.hatches for c in ax.collections if isinstance(c, ContourSet) and any(c.hatches)] == [["////"]]
    assert (ax.get_xscale(), ax.get_yscale(), ax.get_xlim(), ax.get_ylim()) == ("log", "log", (1, 1e4), (1e2, 1e4))


def test_what_is_stable_is_left_white(ax):
    plot.stability_map(refined(lambda x, y: cliff(x, y) | {"critical_thrust": np.full(len(x), np.nan)}), ax)
    assert not any(isinstance(c, TriMesh) for c in ax.collections)


def test_a_refined_map_is_drawn_without_a_warning(ax):
    plot.stability_map(refined(cliff), ax)
    ax.figure.savefig(BytesIO())


def test_a_refined_map_over_one_axis_is_refused(ax):
    whole = refined(cliff)
    with pytest.raises(ModelError, match=r"draws two axes.*'k': 11, 's': 1"):
        plot.stability_map(RefinedMap(whole.grid.isel(s=[0]), whole.refined), ax)
