"""Frequencies and thrust margin over a flight."""

import math
from itertools import groupby, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import EngFormatter
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.plot.style import BLACK, BLUE, CYCLE, GREY, VERMILION, axes
from beal.study.flight import Flight

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
DASHES = ("-", "--", "-.", ":")
KINDS = {"flutter": "-", "divergence": "--"}
FAR = 20.0  # ratio of the largest to the smallest value from which an axis is logarithmic


def flight(result: Flight, ax: "Axes | None" = None) -> "Axes":
    """Draw frequencies over time above, critical and actual thrust below; separations are dotted lines.

    Parameters
    ----------
    result : Flight
    ax : Axes, optional
        One of a grid of subplots, whose place both drawings share.

    Returns
    -------
    Axes
        The upper one; the lower one is the figure's last.

    Raises
    ------
    ModelError
        If ``ax`` is not one of a grid.
    """
    ax = axes(ax)
    place = ax.get_subplotspec()
    if place is None:
        raise ModelError("ax: must be one of a grid, as pyplot.subplots makes them")
    halves = place.subgridspec(2, 1)
    ax.set_subplotspec(halves[0])
    below = ax.figure.add_subplot(halves[1], sharex=ax)
    parts = _parts([state.stages for state in result.states])
    _frequencies(ax, result, parts)
    _thrusts(below, result, parts)
    for before, after in pairwise(parts):
        separation = float(result.time[before.stop - 1] + result.time[after.start]) / 2
        for each in (ax, below):
            each.axvline(separation, color=GREY, linewidth=0.8, linestyle=(0, (1, 2)), zorder=0)
        _name_stages(ax, separation, result.states[after.start].stages)
    ax.tick_params(labelbottom=False)
    ax.margins(x=0.02)
    below.set_xlabel("time (s)" if result.units == "SI" else "time")
    return ax


def _parts(labels: list[tuple[int, int]]) -> list[slice]:
    """Runs of equal labels."""
    lengths = [len(list(run)) for _, run in groupby(labels)]
    ends = np.cumsum([0, *lengths]).tolist()
    return [slice(a, b) for a, b in pairwise(ends)]


def _name_stages(ax: "Axes", time: float, stages: tuple[int, int]) -> None:
    """Which stages stay, beside the line of the separation."""
    first, last = stages
    name = f"stage {first}" if first == last else f"stages {first}\N{EN DASH}{last}"
    ax.annotate(
        name,
        (time, 0.0),  # where frequencies, higher than before, leave room
        xycoords=("data", "axes fraction"),
        xytext=(2, 3),
        textcoords="offset points",
        rotation=90,
        va="bottom",
        fontsize=7,
        color=GREY,
    )


def _frequencies(ax: "Axes", result: Flight, parts: list[slice]) -> None:
    si = result.units == "SI"
    frequencies = result.angular_frequency / (2 * math.pi if si else 1.0)
    for mode, values in enumerate(frequencies.T):
        color, dash = CYCLE[mode % len(CYCLE)], DASHES[mode % len(DASHES)]
        _line(ax, result.time, values, parts, f"mode {mode + 1}", color, dash)
    ax.set_ylabel("frequency (Hz)" if si else "angular frequency")
    if frequencies.size:
        first = frequencies[frequencies[:, 0] > 0, 0]
        _scaled(ax, float(np.max(first, initial=0.0) / np.min(first, initial=np.inf)))
        _legend(ax)


def _thrusts(ax: "Axes", result: Flight, parts: list[slice]) -> None:
    thrust = np.where(result.thrust > 0, result.thrust, np.nan)
    critical = result.critical_thrust
    kinds = np.array([state.critical.kind if state.critical else "" for state in result.states])
    for kind, dash in KINDS.items():
        if np.any(kinds == kind):
            values = np.where(kinds == kind, critical, np.nan)
            _line(ax, result.time, values, parts, f"critical, {kind}", BLUE, dash)
    borne = np.where(result.at_least, result.searched_to, critical)
    if np.any(result.at_least):
        values = np.where(result.at_least, borne, np.nan)
        ax.plot(result.time, values, color=BLUE, marker="^", markersize=4, linestyle="none", label="stable up to")
    _line(ax, result.time, thrust, parts, "actual", BLACK, "-")
    for part in parts:
        band = result.time[part], thrust[part], borne[part]
        for unstable, color in ((False, BLUE), (True, VERMILION)):
            where = (band[2] < band[1]) == unstable
            ax.fill_between(*band, where=where, interpolate=True, color=color, alpha=0.12, linewidth=0)
    _scaled(ax, float(np.nanmax(borne / thrust, initial=0.0)))
    si = result.units == "SI"
    if si:
        ax.yaxis.set_major_formatter(EngFormatter(unit="N"))
    ax.set_ylabel("thrust")
    if np.any(np.isfinite(result.margin)):
        _mark_least(ax, result, borne)
    _legend(ax)


def _mark_least(ax: "Axes", result: Flight, borne: Array) -> None:
    """The smallest margin, written into the band between both thrusts."""
    least = int(np.nanargmin(result.margin))
    time, low, high = result.time[least], result.thrust[least], borne[least]
    ax.annotate("", (time, low), (time, high), arrowprops={"arrowstyle": "<->", "color": BLACK, "linewidth": 0.8})
    bound = "\N{GREATER-THAN OR EQUAL TO} " if result.at_least[least] else ""
    right = time < (result.time[0] + result.time[-1]) / 2
    middle = math.sqrt(low * high) if ax.get_yscale() == "log" else (low + high) / 2
    ax.annotate(
        f"smallest margin {bound}{result.margin[least]:.3g}".replace("-", "\N{MINUS SIGN}"),
        (time, max(middle, low)),
        xytext=(5 if right else -5, 0),
        textcoords="offset points",
        ha="left" if right else "right",
        va="center",
        fontsize=8,
        bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1},
    )


def _line(ax: "Axes", time: Array, values: Array, parts: list[slice], label: str, color: str, linestyle: str) -> None:
    """A line for each part of the flight, a dot for each time."""
    look: dict[str, Any] = {"color": color, "linestyle": linestyle, "linewidth": 1.2, "marker": "o", "markersize": 2.2}
    for part in parts:
        ax.plot(time[part], values[part], label=label, **look)
        label = ""


def _legend(ax: "Axes") -> None:
    ax.legend(ncols=4, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)


def _scaled(ax: "Axes", ratio: float) -> None:
    """A logarithmic axis for values of a ratio that a linear one would hide."""
    if ratio > FAR:
        ax.set_yscale("log")
    else:
        ax.set_ylim(bottom=0.0)
