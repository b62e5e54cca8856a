"""Maps of the critical thrust over two properties: height as colour, kind and modes as borders, hatching and labels."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import BoundaryNorm
from numpy.typing import NDArray

from beal.plot.refined import draw, highest, regions
from beal.plot.style import BLACK, axes, style, thrust_label, thrust_unit
from beal.study.lattice import spacing_of
from beal.study.refined import RefinedMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import QuadMesh
    from xarray import Dataset

FLUTTER, DIVERGENCE = 1, 2
NARROW = 0.3  # share of the width below which a region's label stands upright
SMALLEST_LABEL = 0.008  # share of the map below which a region carries no name
NAMES = {  # non-dimensional, and in SI units
    "stage.split": ("place of the first joint $x/L$",) * 2,
    "rotational_stiffness": ("rotational stiffness $k_r L/EI$", "rotational stiffness $k_r$ (N m/rad)"),
    "shear_stiffness": ("shear stiffness $k_s L^3/EI$", "shear stiffness $k_s$ (N/m)"),
}
JOINT = re.compile(r"joint\[(\d+)\]\.")


def stability_map(
    chart: "Dataset | RefinedMap",
    ax: "Axes | None" = None,
    levels: Sequence[float] | None = None,
    colorbar: bool = True,
) -> "Axes":
    """Draw the critical thrust over the two axes of a map.

    Colour is the critical thrust; black lines part regions in which another kind of instability, or another pair of
    modes, comes first; divergence is hatched; points that are stable to the end of the search are white. In a refined
    map the lines are smooth, lines part regions between which the thrust alone jumps too, and white contour lines of
    the critical thrust end at them.

    Parameters
    ----------
    chart : Dataset or RefinedMap
        From `beal.stability_map`, with two dimensions, or from `beal.refined_map`; drawn in the spacing of its axes,
        linear or logarithmic.
    ax : Axes, optional
    levels : sequence of float, optional
        Thrusts at which the colour changes; by default it changes continuously.
    colorbar : bool

    Returns
    -------
    Axes

    Raises
    ------
    ModelError
        If a refined map has other than two axes.
    """
    with style():
        ax = axes(ax)
        mesh: ScalarMappable | None = draw(ax, chart, levels) if isinstance(chart, RefinedMap) else None
        grid = chart.grid if isinstance(chart, RefinedMap) else chart
        across, up = grid.critical_thrust.dims
        x, y = (np.asarray(grid[name], dtype=float) for name in (across, up))
        x_edges, y_edges = (x, y) if mesh else (_edges(x), _edges(y))
        mesh = mesh or _cells(ax, x_edges, y_edges, grid, levels)
        _labels(ax, x, y, regions(grid))
        si = grid.attrs.get("units") == "SI"
        ax.set_xlabel(axis_label(str(across), si, str(up)))
        ax.set_ylabel(axis_label(str(up), si, str(across)))
        ax.set_xlim(x_edges[0], x_edges[-1])
        ax.set_ylim(y_edges[0], y_edges[-1])
        if colorbar:
            size, _ = thrust_unit(highest(grid), not si)
            bar = ax.figure.colorbar(mesh, ax=ax, label=f"critical {thrust_label(highest(grid), not si)}")
            bar.ax.yaxis.set_major_formatter(lambda value, _: f"{value / size:g}")
        return ax


def axis_label(name: str, si: bool, beside: str = "") -> str:
    """Words for a path; which joint it is where it may be another than the first, or the other axis has another."""
    joint, other = JOINT.match(name), JOINT.match(beside)
    words = NAMES.get(JOINT.sub("", name))
    if words is None:
        return name
    named = joint and (joint[1] != "0" or (other and other[1] != joint[1]))
    return f"joint[{joint[1]}]: {words[si]}" if joint and named else words[si]


def _cells(
    ax: "Axes", x: NDArray[Any], y: NDArray[Any], chart: "Dataset", levels: Sequence[float] | None
) -> "QuadMesh":
    """A cell around each point of a grid, between edges x and y."""
    mesh = _colours(ax, x, y, np.asarray(chart.critical_thrust, dtype=float), levels)
    _hatching(ax, x, y, np.asarray(chart.kind) == DIVERGENCE)
    _borders(ax, x, y, regions(chart))
    across, up = chart.critical_thrust.dims
    ax.set_xscale(spacing_of(np.asarray(chart[across])))
    ax.set_yscale(spacing_of(np.asarray(chart[up])))
    return mesh


def _colours(
    ax: "Axes", x: NDArray[Any], y: NDArray[Any], thrust: NDArray[Any], levels: Sequence[float] | None
) -> "QuadMesh":
    if levels is None:
        return ax.pcolormesh(x, y, thrust.T, cmap="viridis", vmin=0.0, rasterized=True, zorder=0)
    norm = BoundaryNorm(levels, 256, extend="max")
    return ax.pcolormesh(x, y, thrust.T, cmap="viridis", norm=norm, rasterized=True, zorder=0)


def _hatching(ax: "Axes", x: NDArray[Any], y: NDArray[Any], hatched: NDArray[np.bool_]) -> None:
    cells = [
        [(x[i], y[j]), (x[i + 1], y[j]), (x[i + 1], y[j + 1]), (x[i], y[j + 1])]
        for i, j in zip(*np.nonzero(hatched), strict=True)
    ]
    white = (1.0, 1.0, 1.0, 0.75)
    patch = PolyCollection(cells, facecolors="none", edgecolors=white, linewidths=0.0, hatch="////", zorder=1)
    ax.add_collection(patch, autolim=False)


def _borders(ax: "Axes", x: NDArray[Any], y: NDArray[Any], region: NDArray[np.int_]) -> None:
    """Lines between cells of different regions, along the edges of the cells."""
    for i, j in zip(*np.nonzero(region[1:] != region[:-1]), strict=True):
        ax.plot([x[i + 1]] * 2, y[j : j + 2], color=BLACK, linewidth=1.3, zorder=2, solid_capstyle="projecting")
    for i, j in zip(*np.nonzero(region[:, 1:] != region[:, :-1]), strict=True):
        ax.plot(x[i : i + 2], [y[j + 1]] * 2, color=BLACK, linewidth=1.3, zorder=2, solid_capstyle="projecting")


def _labels(ax: "Axes", x: NDArray[Any], y: NDArray[Any], region: NDArray[np.int_]) -> None:
    """The name of each kind and pair, in the cell that lies deepest inside its region; upright where that is narrow."""
    box = {"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": BLACK, "linewidth": 0.6, "alpha": 0.92}
    for value in np.unique(region):
        inside = region == value
        if np.mean(inside) < SMALLEST_LABEL:
            continue
        depth = _depth(inside)
        deepest = np.argwhere(depth == depth.max())
        i, j = deepest[np.argmin(abs(deepest - deepest.mean(axis=0)).sum(axis=1))]
        upright = inside[:, j].mean() < NARROW < inside[i].mean()
        if upright:  # in the middle of the column, so that the name stays inside the map
            j = int(np.median(np.flatnonzero(inside[i])))
        ax.text(
            x[i],
            y[j],
            _name(int(value)),
            ha="center",
            va="center",
            rotation=90 if upright else 0,
            fontsize=8 if depth.max() > 2 else 6.5,
            bbox=box,
            zorder=3,
        )


def _depth(inside: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Number of cells to the nearest cell outside; the border of the map counts half."""
    depth = np.zeros(inside.shape)
    grown = np.pad(inside, 1, mode="edge")
    grown[[0, -1], :] = grown[:, [0, -1]] = False
    while grown.any():
        depth += grown[1:-1, 1:-1]
        core = grown.copy()
        core[1:-1, 1:-1] &= grown[:-2, 1:-1] & grown[2:, 1:-1] & grown[1:-1, :-2] & grown[1:-1, 2:]
        if (core == grown).all():
            break
        grown = core
    return depth


def _name(region: int) -> str:
    kind, pair = divmod(region, 10_000)
    low, high = divmod(pair, 100)
    return {0: "stable", FLUTTER: f"flutter {low}\N{EN DASH}{high}", DIVERGENCE: f"divergence {low}"}[kind]


def _edges(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Borders between neighbouring values, in the logarithm where that is how they are spaced."""
    log = spacing_of(values) == "log"
    v = np.log(values) if log else values
    middle = (v[1:] + v[:-1]) / 2
    edges = np.concatenate([[v[0] - (middle[0] - v[0])], middle, [v[-1] + (v[-1] - middle[-1])]])
    return np.asarray(np.exp(edges) if log else edges)
