"""The symbols of mechanics: springs, supports, arrows; all in the units of the axes, which are equal along both."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Circle, FancyArrowPatch, Polygon
from numpy.typing import NDArray

from beal.plot.style import BLACK

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
Point = tuple[float, float]

LINE: dict[str, Any] = {"color": BLACK, "linewidth": 0.9, "solid_capstyle": "round", "solid_joinstyle": "round"}
TURNS = 2  # of a coil
STROKES = 6  # of a hatched ground


def spring(ax: "Axes", start: Point, end: Point, width: float, teeth: int = 3) -> None:
    """A zigzag from one point to another."""
    a, b = np.array(start), np.array(end)
    across = width * np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
    share = np.concatenate(([0.0], np.linspace(0.2, 0.8, 2 * teeth + 1), [1.0]))
    side = np.concatenate(([0.0, 0.0], np.tile([1.0, -1.0], teeth)[:-1], [0.0, 0.0]))
    ax.plot(*(a[:, None] + np.outer(b - a, share) + np.outer(across, side)), **LINE)


def coil(ax: "Axes", centre: Point, radius: float, outward: float) -> None:
    """A spiral around a point, that ends one radius to its right (``outward`` 1) or left (-1)."""
    turn = np.linspace(0.0, 2 * np.pi * TURNS, 60)
    r = radius * turn / turn[-1]
    ax.plot(centre[0] + outward * r * np.cos(turn), centre[1] + r * np.sin(turn), **LINE)


def disc(ax: "Axes", centre: Point, radius: float, **look: Any) -> None:
    """A circle."""
    ax.add_patch(Circle(centre, radius, **({"edgecolor": BLACK, "linewidth": 0.9} | look)))


def ground(ax: "Axes", centre: Point, half: float, normal: Point) -> None:
    """A line with hatching behind it; ``normal`` points away from the ground."""
    across = np.array([-normal[1], normal[0]])
    middle, back = np.array(centre), -np.array(normal)
    ends = middle + half * np.outer([-1.0, 1.0], across)
    ax.plot(*ends.T, **(LINE | {"linewidth": 1.3}))
    stroke = 2 * half / STROKES
    for share in np.linspace(-1.0, 1.0, STROKES + 1)[1:]:
        foot = middle + half * share * across
        ax.plot(*np.array([foot, foot + stroke * (back - across)]).T, **(LINE | {"linewidth": 0.6}))


def pin(ax: "Axes", tip: Point, size: float) -> None:
    """A triangle that stands on hatched ground and holds its tip."""
    x, y = tip
    base = [(x, y), (x - 0.6 * size, y - size), (x + 0.6 * size, y - size)]
    ax.add_patch(Polygon(base, closed=True, facecolor="white", edgecolor=BLACK, linewidth=0.9, zorder=4))
    ground(ax, (x, y - size), 0.9 * size, (0.0, 1.0))


def arrow(ax: "Axes", tail: Point, tip: Point, color: str, width: float = 1.8, head: float = 11.0) -> None:
    """A straight arrow; width of its line and size of its head in points."""
    look: dict[str, Any] = {
        "arrowstyle": "-|>",
        "mutation_scale": head,
        "shrinkA": 0.0,
        "shrinkB": 0.0,
        "linewidth": width,
    }
    patch = FancyArrowPatch(tail, tip, color=color, zorder=6, joinstyle="miter", **look)
    ax.add_artist(patch)
    ax.update_datalim([tail, tip])
