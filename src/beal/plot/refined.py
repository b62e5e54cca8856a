"""Refined maps over two properties: smooth borders, and contour lines that end at them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm
from matplotlib.patheffects import withStroke
from matplotlib.scale import LogTransform
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import IdentityTransform, Transform, blended_transform_factory
from matplotlib.tri import Triangulation
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from beal.errors import ModelError
from beal.plot.style import BLACK, thrust_unit
from beal.study.refine import JUMP

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import TriMesh
    from matplotlib.tri import TriContourSet
    from xarray import Dataset

    from beal.study.refined import RefinedMap

Array = NDArray[np.float64]
Integers = NDArray[np.int_]

DIVERGENCE = 2
LINES = 12  # contours of the critical thrust, about
DARK = 0.6  # share of the highest thrust below which its colour is dark
LONG = 0.15  # of the map: shorter contours bear no number


def regions(chart: "Dataset") -> Integers:
    """One number for each kind and pair of modes, 0 for stable."""
    kind, low, high = (np.asarray(chart[name]).astype(int) for name in ("kind", "mode_low", "mode_high"))
    return np.where(kind == 0, 0, 10_000 * kind + 100 * low + high)


def highest(chart: "Dataset") -> float:
    """The largest critical thrust of a grid, 0 where all is stable."""
    thrust = np.asarray(chart.critical_thrust, dtype=float)
    return float(thrust[np.isfinite(thrust)].max(initial=0.0))


def draw(ax: "Axes", found: "RefinedMap", levels: Sequence[float] | None) -> ScalarMappable:
    """Colour, hatching, borders and contour lines of a refined map, along the spacing of its axes.

    All is drawn on triangles between the points. A border runs midway between points of different regions, which are
    no farther apart than the refined width; colours and contour lines stay on triangles inside one region.
    """
    if len(found.grid.critical_thrust.dims) != 2 or min(found.grid.critical_thrust.shape) < 2:
        shape = dict(found.grid.critical_thrust.sizes)
        raise ModelError(f"stability_map: draws two axes of more than one value each, found {shape}")
    x_scale, y_scale = found.refined.attrs["spacing"]
    ax.set_xscale(x_scale)
    ax.set_yscale(y_scale)
    spacing = _from_spacing(x_scale, y_scale)
    place = spacing + ax.transData

    points, region, thrust = _points(found)
    x, y = points.T
    triangles = Triangulation(x / np.ptp(x), y / np.ptp(y)).triangles
    parted = np.ptp(region[triangles], axis=1) > 0
    beside = np.isin(triangles, triangles[parted]).any(axis=1)  # where the thrust may fall steeply to the border
    jumps = ~beside & _at_jumps(found, points, triangles) & (_change(thrust[triangles]) > JUMP)
    inside = ~parted & ~jumps & np.all(np.isfinite(thrust[triangles]), axis=1)

    size, _ = thrust_unit(highest(found.grid), found.grid.attrs.get("units") != "SI")
    colours = (
        _colours(ax, Triangulation(x, y, triangles[inside]), np.nan_to_num(thrust), levels, spacing, size)
        if inside.any()
        else ScalarMappable(cmap="viridis")
    )
    every = Triangulation(x, y, triangles)
    _hatching(ax, every, region // 10_000 == DIVERGENCE, place)
    _borders(ax, every, region, place)
    cuts = list(_cuts(points, thrust, triangles[jumps]))
    ax.add_collection(
        LineCollection(cuts, colors=BLACK, linewidths=1.3, capstyle="round", transform=place, zorder=2), autolim=False
    )
    return colours


def _spaced(found: "RefinedMap", values: Array) -> Array:
    """Values on the axes, shape (points, 2), in the spacing of each."""
    log = np.array(found.refined.attrs["spacing"]) == "log"
    return np.where(log, np.log10(np.where(log, values, 1.0)), values)


def _points(found: "RefinedMap") -> tuple[Array, Integers, Array]:
    """Where the points of grid and refinement lie in the spacing of the axes, their regions and thrusts."""
    grid, refined = found.grid, found.refined
    names = [str(name) for name in grid.critical_thrust.dims]
    corners = np.meshgrid(*(np.asarray(grid[name], dtype=float) for name in names), indexing="ij")
    points = [np.concatenate((c.ravel(), refined[name])) for name, c in zip(names, corners, strict=True)]
    region = np.concatenate((regions(grid).ravel(), regions(refined)))
    return (
        _spaced(found, np.array(points).T),
        region,
        np.concatenate((np.ravel(grid.critical_thrust), refined.critical_thrust)),
    )


def _change(thrust: Array) -> Array:
    """Relative change of the thrust over the corners of triangles."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.ptp(np.log(thrust), axis=1)


def _at_jumps(found: "RefinedMap", points: Array, triangles: Integers) -> NDArray[np.bool_]:
    """Whether a triangle lies at a cell over which the thrust jumps inside one region."""
    refined = found.refined
    sides = [np.asarray(refined[f"side_{name}"]) for name in ("status", "kind", "mode_low", "mode_high")]
    jumps = np.all([side[:, 0] == side[:, 1] for side in sides], axis=0)
    if not jumps.any():
        return np.zeros(len(triangles), dtype=bool)
    low, high = (_spaced(found, np.asarray(refined[end])[jumps]) for end in ("low", "high"))
    extent = np.ptp(points, axis=0)
    near, _ = cKDTree((low + high) / 2 / extent).query(points[triangles].mean(axis=1) / extent, p=np.inf)
    return np.asarray(near < refined.attrs["width"])


def _from_spacing(x_scale: str, y_scale: str) -> Transform:
    """From the spacing of the axes to their values."""
    x, y = (LogTransform(10).inverted() if scale == "log" else IdentityTransform() for scale in (x_scale, y_scale))
    return blended_transform_factory(x, y)


def _cuts(points: Array, thrust: Array, triangles: Integers) -> Array:
    """Across each triangle the line that parts its odd corner from the others, shape (triangles, 2, 2)."""
    corners = np.take_along_axis(triangles, np.argsort(thrust[triangles], axis=1), axis=1)
    low, middle, high = thrust[corners].T
    odd = np.where((middle - low > high - middle)[:, None], corners, corners[:, ::-1])  # the odd one first
    return (points[odd[:, :1]] + points[odd[:, 1:]]) / 2


def _colours(
    ax: "Axes", mesh: Triangulation, thrust: Array, levels: Sequence[float] | None, spacing: Transform, size: float
) -> ScalarMappable:
    """The numbers at contour lines are in units of a size."""
    place = spacing + ax.transData
    colours: TriMesh | TriContourSet
    if levels is None:
        colours = ax.tripcolor(mesh, thrust, shading="gouraud", cmap="viridis", vmin=0.0, rasterized=True, zorder=0)
    else:
        norm = BoundaryNorm(levels, 256, extend="max")
        colours = ax.tricontourf(mesh, thrust, levels, cmap="viridis", norm=norm, extend="max", zorder=0)
    colours.set_transform(place)
    lines = MaxNLocator(LINES, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, thrust.max()) if levels is None else levels
    bright = ["white" if level < DARK * thrust.max() else BLACK for level in lines]
    drawn = ax.tricontour(mesh, thrust, lines, colors=bright, linewidths=0.7, zorder=1.5)
    drawn.set_transform(place)
    where = [spacing.transform(place) for place in _numbered(drawn.allsegs, mesh)]
    if where:
        for text in ax.clabel(drawn, manual=where, fontsize=6.5, fmt=lambda level: f"{level / size:g}"):
            behind = colours.to_rgba(np.array([float(text.get_text()) * size]))[0]
            text.set_path_effects([withStroke(linewidth=2.0, foreground=behind)])
    return colours


def _numbered(lines: Sequence[Sequence[Array]], mesh: Triangulation) -> list[Array]:
    """A third along the longest line of each level, if it is long enough for a number; names stand in the middle."""
    extent = np.array([np.ptp(mesh.x), np.ptp(mesh.y)])
    found = []
    for level in lines:
        parts = [part for part in level if len(part)]
        along = [np.cumsum(np.hypot(*(np.diff(part, axis=0, prepend=part[:1]) / extent).T)) for part in parts]
        longest = max(range(len(parts)), key=lambda n: along[n][-1], default=None)
        if longest is not None and (length := along[longest])[-1] > LONG:
            found.append(parts[longest][np.searchsorted(length, length[-1] / 3)])
    return found


def _hatching(ax: "Axes", mesh: Triangulation, hatched: NDArray[np.bool_], place: Transform) -> None:
    if hatched.any():
        area = ax.tricontourf(mesh, hatched.astype(float), [0.5, 1.5], colors="none", hatches=["////"], zorder=1)
        area.set(transform=place, edgecolor=(1.0, 1.0, 1.0, 0.75), linewidth=0.0)


def _borders(ax: "Axes", mesh: Triangulation, region: Integers, place: Transform) -> None:
    for one in np.unique(region)[1:]:
        line = ax.tricontour(mesh, (region == one).astype(float), [0.5], colors=BLACK, linewidths=1.3, zorder=2)
        line.set(transform=place, joinstyle="round")
