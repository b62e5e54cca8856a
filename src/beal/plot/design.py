"""Where a design stands among its neighbours."""

from typing import TYPE_CHECKING

import numpy as np

from beal.plot.maps import DIVERGENCE, axis_label, stability_map
from beal.plot.refined import regions
from beal.plot.style import BLACK, BLUE, ORANGE, VERMILION, axes, style, thrust_label, thrust_unit
from beal.study.lattice import spacing_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import Dataset

    from beal.design.answer import DesignAnswer


def design_map(answer: "DesignAnswer", ax: "Axes | None" = None) -> "Axes":
    """Draw the critical thrust over one or two variables with the design, and what bounds it.

    Over two variables a star is the design, and lines inside each region are where the critical thrust falls to the
    share that the design's ranges keep; dashed lines are linear bounds over these two alone. Over one variable the
    thrust is a line, broken where another kind of instability or another pair of modes comes first.

    Parameters
    ----------
    answer : DesignAnswer
        From `beal.design_answer`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        if len(answer.chart.critical_thrust.dims) == 1:
            _line(answer, ax)
        else:
            stability_map(answer.refined or answer.chart, ax)
            _bounds(answer, ax)
            _kept(answer, ax)
        where = _place(answer)
        ax.plot(
            *where, "*", color=ORANGE, markeredgecolor=BLACK, markersize=13, zorder=5, clip_on=False, label="design"
        )
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
        return ax


def _place(answer: "DesignAnswer") -> tuple[float, float]:
    dims = [str(name) for name in answer.chart.critical_thrust.dims]
    found = [answer.best.values[path] for path in dims]
    return (found[0], answer.critical.critical_thrust or 0.0) if len(found) == 1 else (found[0], found[1])


def _line(answer: "DesignAnswer", ax: "Axes") -> None:
    chart = answer.chart
    path = str(chart.critical_thrust.dims[0])
    x, thrust = np.asarray(chart[path]), np.asarray(chart.critical_thrust)
    region = regions(chart)
    named = set()
    for part in np.split(np.arange(len(x)), np.flatnonzero(np.diff(region)) + 1):
        if region[part[0]]:
            diverges = chart.kind.values[part[0]] == DIVERGENCE
            label = "divergence" if diverges else "flutter"
            ax.plot(
                x[part], thrust[part], "--" if diverges else "-", color=VERMILION if diverges else BLUE,
                label=None if label in named else label,
            )  # fmt: skip
            named.add(label)
    ax.axhline(answer.kept, color=BLACK, linewidth=0.8, linestyle=":", label=_kept_label(answer))
    ax.set_xscale(spacing_of(x))
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(0.0, 1.1 * max(float(np.nanmax(thrust)), answer.critical.critical_thrust or 0.0))
    si = chart.attrs.get("units") == "SI"
    top = float(np.nanmax(thrust))
    size, _ = thrust_unit(top, not si)
    ax.set_xlabel(axis_label(path, si))
    ax.set_ylabel(f"critical {thrust_label(top, not si)}")
    ax.yaxis.set_major_formatter(lambda value, _: f"{value / size:g}")


def _kept(answer: "DesignAnswer", ax: "Axes") -> None:
    """Within each region: over a border the thrust jumps."""
    x, y, thrust = _grid(answer.chart)
    region = regions(answer.chart)
    for one in np.unique(region[region > 0]):
        inside = np.where(region == one, thrust, np.nan)
        if np.nanmin(inside) < answer.kept < np.nanmax(inside):
            ax.contour(x, y, inside.T, [answer.kept], colors=ORANGE, linewidths=1.6, zorder=4)
    ax.plot([], [], color=ORANGE, linewidth=1.6, label=_kept_label(answer))


def _bounds(answer: "DesignAnswer", ax: "Axes") -> None:
    """Linear bounds that speak of the two variables alone."""
    x, y, _ = _grid(answer.chart)
    dims = [str(name) for name in answer.chart.critical_thrust.dims]
    label: str | None = "bound"
    for bound in answer.study.space.bounds:
        if not set(bound.coefficients) <= set(dims):
            continue
        a, b = (bound.coefficients.get(path, 0.0) for path in dims)
        for limit in {bound.low, bound.high}:
            if np.isfinite(limit):
                xs, ys = (x[[0, -1]], (limit - a * x[[0, -1]]) / b) if b else (np.full(2, limit / a), y[[0, -1]])
                ax.plot(xs, ys, "--", color=VERMILION, linewidth=1.4, zorder=4, label=label, scalex=False, scaley=False)
                label = None


def _kept_label(answer: "DesignAnswer") -> str:
    return f"{answer.study.keep:.0%} of the design's critical thrust"


def _grid(chart: "Dataset") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    across, up = chart.critical_thrust.dims
    return np.asarray(chart[across]), np.asarray(chart[up]), np.asarray(chart.critical_thrust)
