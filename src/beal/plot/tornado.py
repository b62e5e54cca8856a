"""Elasticities as bars to both sides of zero, the longest on top."""

from typing import TYPE_CHECKING

import numpy as np

from beal.design.sensitivity import Sensitivity
from beal.errors import ModelError
from beal.plot.style import BLACK, BLUE, VERMILION, axes, thrust_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST = 15  # bars
SMALLEST = 1e-3  # share of the longest bar below which one is a dot


def tornado(result: Sensitivity, ax: "Axes | None" = None, most: int = MOST) -> "Axes":
    """Draw what one percent more of each quantity does to the critical thrust.

    Parameters
    ----------
    result : Sensitivity
    ax : Axes, optional
    most : int
        Number of quantities, the most important ones; those with next to no effect are left out.

    Returns
    -------
    Axes

    Raises
    ------
    ModelError
        If no quantity has an effect.
    """
    ranked = result.ranked
    shown = [each for each in ranked if abs(each.elasticity) > SMALLEST * abs(ranked[0].elasticity)][:most]
    if not shown:
        raise ModelError("sensitivity: none of the quantities has an effect that could be drawn")
    ax = axes(ax)
    rows, bars = np.arange(len(shown)), np.array([each.elasticity for each in shown])
    ax.barh(rows, bars, height=0.7, color=[BLUE if bar > 0 else VERMILION for bar in bars])
    for row, bar in zip(rows, bars, strict=True):
        side = np.sign(bar)
        ax.annotate(
            f"{bar:+.3g}",
            (bar, row),
            xytext=(3 * side, 0),
            textcoords="offset points",
            ha="left" if side > 0 else "right",
            va="center",
            fontsize="small",
        )
    ax.axvline(0.0, color=BLACK, linewidth=0.8)
    ax.set_yticks(rows, [each.path for each in shown])
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.invert_yaxis()
    ax.margins(x=0.15)
    ax.set_xlabel("change of critical thrust (% per % of the quantity)")
    thrust = result.critical.critical_thrust or 0.0
    size, unit = thrust_unit(thrust, result.units == "nondimensional")
    ax.set_title(f"{result.critical.kind} at P = {thrust / size:.6g} {unit}".rstrip())
    return ax
