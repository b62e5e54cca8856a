"""One look for all figures: colours that colour-blind readers can tell apart, and sizes that stay legible in print."""

from contextlib import AbstractContextManager
from typing import TYPE_CHECKING

import matplotlib as mpl
from cycler import cycler

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Okabe & Ito (2008), Color Universal Design
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
CYCLE = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
GREY = "#6B6B6B"

RC = {
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
    "svg.hashsalt": "beal",  # the same figure gives the same file
    "savefig.dpi": 160,
}


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
