"""One look for all figures: colours that colour-blind readers can tell apart, and sizes that stay legible in print."""

from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
from cycler import cycler
from numpy.typing import NDArray

from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[Any]

# Okabe & Ito (2008), Color Universal Design
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
GREY = "#6B6B6B"
TINTS = ("#CFE3F2", "#F1F1F1")  # of neighbouring bodies, unlike in grey too

RC = {
    "figure.figsize": (5.0, 3.4),  # inches; letters stay above 6 points in a column of 85 mm
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.0,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "axes.prop_cycle": cycler(color=CYCLE),
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.titlelocation": "left",
    "lines.linewidth": 1.5,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "svg.hashsalt": "beal",  # the same figure gives the same file
    "savefig.dpi": 160,
}
LABELS = 0.6  # height of ticks and label of an axis, inches


def style() -> AbstractContextManager[None]:
    """The shared settings, for a ``with`` statement around what creates and saves a figure.

    Returns
    -------
    context manager

    Examples
    --------
    >>> with style():
    ...     mpl.rcParams["font.size"]
    9.0
    """
    return mpl.rc_context(RC)  # type: ignore[arg-type]


def axes(ax: "Axes | None") -> "Axes":
    """The axes given, or those of a new figure.

    Parameters
    ----------
    ax : Axes or None

    Returns
    -------
    Axes
    """
    if ax is not None:
        return ax
    from matplotlib import pyplot  # chooses a window system: only when a figure is wanted on the spot

    with style():
        return pyplot.subplots(layout="constrained")[1]


def fitted(ax: "Axes") -> None:
    """Give the figure of axes with equal units the height that they need, and room for their labels."""
    figure = ax.get_figure(root=True)
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    if figure is not None:
        figure.set_figheight(LABELS + figure.get_figwidth() * (top - bottom) / (right - left))


def along(ax: "Axes", vehicle: Vehicle) -> None:
    """Make the axis of stations the only one, as long as the vehicle."""
    ax.set_xticks([tick for tick in ax.get_xticks() if 0 <= tick <= vehicle.length * (1 + 1e-9)])
    ax.set_xlabel(station_label(vehicle))
    ax.spines["left"].set_visible(False)
    ax.spines["bottom"].set_bounds(0.0, vehicle.length)


def station_label(vehicle: Vehicle) -> str:
    """Of the axis along the vehicle."""
    if vehicle.units == "SI":
        return "station x (m)"
    return "station $x/L$" if abs(vehicle.length - 1.0) < 1e-9 else "station $x$"


def thrust_unit(largest: float, nondimensional: bool) -> tuple[float, str]:
    """The unit in which thrusts up to the largest are told, in N, and its name."""
    if nondimensional:
        return 1.0, ""
    return next(((size, name) for size, name in ((1e6, "MN"), (1e3, "kN")) if largest >= size), (1.0, "N"))


def thrust_label(largest: float, nondimensional: bool) -> str:
    """Of an axis of thrusts."""
    return "thrust $P L^2/EI$" if nondimensional else f"thrust P ({thrust_unit(largest, False)[1]})"


def thrust_axis(ax: "Axes", thrust: Array, nondimensional: bool) -> None:
    """Make the horizontal axis that of the thrust."""
    factor, _ = thrust_unit(thrust[-1], nondimensional)
    ax.set_xlim(thrust[0], thrust[-1])
    ax.set_xlabel(thrust_label(thrust[-1], nondimensional))
    if factor != 1:
        ax.xaxis.set_major_formatter(lambda value, _: f"{value / factor:g}")
