"""The paths of the closed loop's roots in the complex plane, and where it is stable."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, Normalize

from beal.control import ControlLocus
from beal.plot.curves import UNSTABLE, WORD
from beal.plot.style import BLACK, axes, style, thrust_label, thrust_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import Dataset

ROOM = 0.08  # beside the paths, over their extent
STRONG = 0.1  # damping ratio from which on the shade is the same
LEAST = 0.25  # width of the unstable half, over that of the whole


def control_locus(locus: ControlLocus, ax: "Axes | None" = None, nondimensional: bool = True) -> "Axes":
    """Draw the paths of the closed loop's roots, coloured by what varies, the unstable half tinted.

    Each path leads from a ring at the first value to a square at the last. Only roots with Im s >= 0 are drawn.

    Parameters
    ----------
    locus : ControlLocus
    ax : Axes, optional
    nondimensional : bool
        Whether the labels are those of the non-dimensional form or carry SI units.

    Returns
    -------
    Axes
        With a colour bar.
    """
    with style():
        ax = axes(ax)
        of_thrust = locus.over == "thrust"
        factor, _ = thrust_unit(locus.values[-1], nondimensional) if of_thrust else (1.0, "")
        values = locus.values / factor
        upper = np.where(locus.roots.imag >= 0, locus.roots, np.nan)
        color = {"cmap": "viridis", "norm": Normalize(values.min(), values.max())}
        for path in upper.T:
            points = np.column_stack((path.real, path.imag))
            pieces = LineCollection(
                list(np.stack((points[:-1], points[1:]), axis=1)), linewidths=2.0, capstyle="round", zorder=3, **color
            )
            pieces.set_array((values[1:] + values[:-1]) / 2)
            ax.add_collection(pieces, autolim=False)
            for marker, end in (("o", points[0]), ("s", points[-1])):
                ax.plot(*end[:, None], marker, color=BLACK, markersize=4.0, markerfacecolor="white", zorder=4)
        left, right = float(np.nanmin(upper.real)), float(np.nanmax(upper.real))
        top = (1 + ROOM) * float(np.nanmax(upper.imag)) or 1.0
        width = max(right - left, LEAST * top)
        left, right = min(left, 0.0) - ROOM * width, max(right + ROOM * width, LEAST * width)
        ax.axvspan(0.0, right, **UNSTABLE)
        ax.axvline(0.0, color=BLACK, linewidth=0.8, zorder=1)
        ax.text(0.98, 0.98, "unstable", transform=ax.transAxes, ha="right", va="top", **WORD)
        ax.set(xlim=(left, right), ylim=(-0.02 * top, top))
        ax.set_xlabel(r"real part $\sigma\sqrt{mL^4/EI}$" if nondimensional else r"real part $\sigma$ (1/s)")
        imaginary = r"imaginary part $\omega\sqrt{mL^4/EI}$"
        ax.set_ylabel(imaginary if nondimensional else r"imaginary part $\omega$ (rad/s)")
        label = thrust_label(locus.values[-1], nondimensional) if of_thrust else _name(locus.over)
        ax.figure.colorbar(pieces, ax=ax, label=label)
        return ax


def control_map(chart: "Dataset", ax: "Axes | None" = None) -> "Axes":
    """Draw where the closed loop is stable, shaded by the damping ratio of its least damped root.

    Parameters
    ----------
    chart : Dataset
        From `beal.control_map`.
    ax : Axes, optional

    Returns
    -------
    Axes
        With a colour bar. The borders are those that were solved for, not those of the grid; unstable ground is tinted.
    """
    over = str(chart.stable.dims[0])
    nondimensional = chart.attrs["units"] != "SI"
    values, thrust = chart[over].values, chart.thrust.values
    factor, _ = thrust_unit(float(thrust[-1]), nondimensional)
    with style():
        ax = axes(ax)
        ratio = chart.damping_ratio.where(chart.stable).values
        strong = min(STRONG, float(np.nanmax(ratio, initial=0.0)) or STRONG)
        shades = ListedColormap(colormaps["Blues"](np.linspace(0.25, 1.0, 256)))  # the palest still unlike the ground
        mesh = ax.pcolormesh(values, thrust / factor, ratio.T, cmap=shades, vmin=0.0, vmax=strong, rasterized=True)
        for border in chart.border.values.T:  # dots, too: an island may be one value wide
            ax.plot(values, border / factor, color=BLACK, linewidth=1.4, marker="o", markersize=1.6, zorder=3)
        ax.set(xlim=(values[0], values[-1]), ylim=(thrust[0] / factor, thrust[-1] / factor))
        ax.axvspan(values[0], values[-1], **UNSTABLE)
        if values[0] > 0 and np.ptp(np.diff(np.log(values))) < np.ptp(np.diff(values)) / values[-1]:
            ax.set_xscale("log")
        ax.set_xlabel(_name(over))
        ax.set_ylabel(thrust_label(float(thrust[-1]), nondimensional))
        ax.figure.colorbar(mesh, ax=ax, label="damping ratio of the least damped root", extend="max")
        if not chart.stable.values.all():
            ax.text(0.98, 0.97, "unstable", transform=ax.transAxes, ha="right", va="top", **WORD)
        return ax


def _name(over: str) -> str:
    return "factor on all gains" if over == "gain" else over
