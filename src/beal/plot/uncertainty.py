"""Critical thrusts of random vehicles: how they scatter and by which kind the vehicles fail."""

from typing import TYPE_CHECKING

import numpy as np

from beal.design.sampling import Sample
from beal.plot.style import BLACK, BLUE, GREY, VERMILION, axes, style, thrust_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BINS = 60
KINDS = (("flutter", 1, BLUE, ""), ("divergence", 2, VERMILION, "////"))


def thrust_distribution(
    found: Sample, ax: "Axes | None" = None, nominal: float | None = None, nondimensional: bool = True
) -> "Axes":
    """Draw a histogram of the critical thrust, coloured by kind, and the share of vehicles unstable up to each thrust.

    Vehicles that are stable to the thrust searched to, or could not be solved, are in the shares but not in the bars;
    their numbers are written above the axes.

    Parameters
    ----------
    found : Sample
        From `beal.sample`.
    ax : Axes, optional
    nominal : float, optional
        A thrust to mark, in N.
    nondimensional : bool
        Whether the vehicles are.

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        unstable = np.isfinite(found.critical_thrust)
        thrusts = found.critical_thrust[unstable]
        top = float(thrusts.max()) * 1.02 if len(thrusts) else found.searched_to
        low = float(thrusts.min()) * 0.98 if len(thrusts) else 0.0
        ends = (low, top) if nominal is None else (min(low, 0.98 * nominal), max(top, 1.02 * nominal))
        edges, bottom = np.linspace(low, top, BINS + 1), np.zeros(BINS)
        for name, kind, colour, hatch in KINDS:
            of_kind = found.critical_thrust[found.kind == kind]
            if not len(of_kind):
                continue
            share = np.histogram(of_kind, edges)[0] / found.count
            label = f"{name}, {len(of_kind) / found.count:.1%} of the vehicles"
            ax.bar(
                edges[:-1], share, np.diff(edges), bottom, align="edge", color=colour, label=label, hatch=hatch,
                edgecolor="white", linewidth=0.0,
            )  # fmt: skip
            bottom += share
        ax.set_ylim(0.0, 1.05 * bottom.max() or 1.0)
        ax.set_ylabel("share of vehicles in each bar")
        cumulative = ax.twinx()
        cumulative.spines["right"].set_visible(True)
        cumulative.plot(
            np.sort(thrusts), np.arange(1, len(thrusts) + 1) / found.count, color=BLACK, label="unstable up to P"
        )
        cumulative.set_ylim(0.0, 1.02)
        cumulative.set_ylabel("share of vehicles unstable up to P")
        if nominal is not None:
            ax.axvline(nominal, color=GREY, linestyle="--", label="thrust asked about")
        thrust_axis(ax, np.array(ends), nondimensional)
        handles = [pair for part in (ax, cumulative) for pair in zip(*part.get_legend_handles_labels(), strict=True)]
        ax.legend(*zip(*handles, strict=True), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
        if unstable.sum() < found.count:
            stable = int(np.isinf(found.critical_thrust).sum())
            ax.set_title(f"{stable} stable to the end of the search, {found.failed} not solved", y=1.16)
        return ax
