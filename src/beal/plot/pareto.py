"""What a critical thrust costs in mass."""

from typing import TYPE_CHECKING

from beal.design.pareto import ParetoFront
from beal.plot.style import BLACK, BLUE, VERMILION, axes, style, thrust_label, thrust_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def pareto_front(front: ParetoFront, ax: "Axes | None" = None) -> "Axes":
    """Draw critical thrust over mass of the designs of a front.

    A dot is a design about which the critical thrust changes smoothly, a diamond one that stands at a cliff.

    Parameters
    ----------
    front : ParetoFront
        From `beal.pareto`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        nondimensional = front.units == "nondimensional"
        unit, _ = thrust_unit(float(front.critical_thrust.max()), nondimensional)
        thrust, cliff = front.critical_thrust / unit, front.cliff
        ax.plot(front.mass, thrust, "-", color=BLACK, linewidth=0.8, zorder=1)
        for which, marker, colour, label in (
            (~cliff, "o", BLUE, "design"),
            (cliff, "D", VERMILION, "design at a cliff"),
        ):
            if which.any():
                ax.plot(front.mass[which], thrust[which], marker, color=colour, markersize=5, label=label)
        ax.set_xlabel("mass" if nondimensional else "mass (kg)")
        ax.set_ylabel(f"critical {thrust_label(float(front.critical_thrust.max()), nondimensional)}")
        ax.legend()
        return ax
