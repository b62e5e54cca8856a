"""The border of a joint's two springs: what bears a thrust, what does not, and where it falls at once."""

from typing import TYPE_CHECKING

from matplotlib.patheffects import withTickedStroke

from beal.plot.maps import axis_label
from beal.plot.style import BLUE, VERMILION, axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from beal.design.border import SpringBorder

COLOURS = {"flutter": BLUE, "divergence": VERMILION}
LINES = {"crossing": (1.5, "-"), "jump": (2.6, (0, (4, 1.2)))}


def spring_border(found: "SpringBorder", ax: "Axes | None" = None) -> "Axes":
    """Draw the border of the springs that bear a thrust.

    Blue is flutter, vermilion divergence; a thick broken line is a cliff, where the critical thrust falls at once;
    ticks point to the springs that do not bear the target.

    Parameters
    ----------
    found : SpringBorder
        From `beal.spring_border`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        drawn = set()
        for piece in found.pieces:
            x, y = piece.rotational_stiffness, piece.shear_stiffness
            name = f"{piece.kind}, {'cliff' if piece.edge == 'jump' else 'crossing'}"
            width, dashes = LINES[piece.edge]
            colour = COLOURS[piece.kind]
            ax.plot(x, y, color=colour, linewidth=width, linestyle=dashes, label=None if name in drawn else name)
            ticks = withTickedStroke(angle=-90, length=0.6, spacing=9)
            ax.plot(x, y, color=colour, linewidth=0.7, path_effects=[ticks])
            drawn.add(name)
        ax.set_xscale("log")
        ax.set_yscale("log")
        si = found.vehicle.units == "SI"
        turning, sliding = (f"joint[{found.joint}].{name}_stiffness" for name in ("rotational", "shear"))
        ax.set_xlabel(axis_label(turning, si))
        ax.set_ylabel(axis_label(sliding, si))
        if found.pieces:
            ax.legend(loc="upper right")
        return ax
