"""Words beside a drawing: in as many lines as it takes for no two to meet."""

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import matplotlib as mpl
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from beal.plot.style import GREY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LONGEST = 32  # letters
LEADING = 1.5  # distance of lines over the size of the letters
SPACE = 0.8  # between words in a line, over the size of the letters


@dataclass(frozen=True)
class Caption:
    """Words for a point of the drawing; long ones are shortened.

    Parameters
    ----------
    x, y : float
        The point, in units of the axes.
    text : str
    """

    x: float
    y: float
    text: str

    @property
    def words(self) -> str:
        """What is written."""
        return textwrap.shorten(self.text, LONGEST, placeholder=" …")


@dataclass(frozen=True)
class Placed:
    """A caption with its place: the middle of its words, in units of the axes, and its line, counted from 0."""

    caption: Caption
    middle: float
    line: int


def size() -> float:
    """Of the letters, in points."""
    return float(mpl.rcParams["font.size"]) - 1.0


def width(text: str) -> float:
    """Of words, in points."""
    return float(TextPath((0.0, 0.0), text, size=size(), prop=FontProperties()).get_extents().width)


def arranged(captions: Iterable[Caption], left: float, right: float, scale: float) -> list[Placed]:
    """Each caption in the first line that has room for it, over or under its point.

    Parameters
    ----------
    captions : iterable of Caption
        The first ones get the first lines.
    left, right : float
        Ends of the lines, in units of the axes.
    scale : float
        Points per unit of the axes.

    Returns
    -------
    list of Placed

    Examples
    --------
    >>> near = [Caption(0.5, 0.0, "payload"), Caption(0.52, 0.0, "imu"), Caption(0.9, 0.0, "engine")]
    >>> [placed.line for placed in arranged(near, 0.0, 1.0, scale=200.0)]
    [0, 1, 0]
    """
    lines: list[list[tuple[float, float]]] = []
    found = []
    for caption in captions:
        half = (width(caption.words) + SPACE * size()) / 2 / scale
        middle = max(min(caption.x, right - half), left + half)
        free = (all(middle + half <= a or middle - half >= b for a, b in line) for line in lines)
        line = next((number for number, is_free in enumerate(free) if is_free), len(lines))
        if line == len(lines):
            lines.append([])
        lines[line].append((middle - half, middle + half))
        found.append(Placed(caption, middle, line))
    return found


def height(placed: Iterable[Placed], scale: float) -> float:
    """Of all lines, in units of the axes."""
    return LEADING * size() / scale * max((1 + one.line for one in placed), default=0)


def write(ax: "Axes", placed: Iterable[Placed], edge: float, scale: float, shrunk: float) -> None:
    """Write captions beyond an edge, above the axis where it is positive and below it where not, with leaders.

    Parameters
    ----------
    ax : Axes
    placed : iterable of Placed
    edge : float
        In units of the axes.
    scale : float
        Points per unit of the axes at which the captions were arranged.
    shrunk : float
        What remains of it, and of the letters.
    """
    step = LEADING * size() / scale * (1 if edge > 0 else -1)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
    for one in sorted(placed, key=lambda one: -one.line):
        near, y = edge + one.line * step, edge + (one.line + 0.5) * step
        start = one.caption
        ax.plot([start.x, one.middle], [start.y, near], color=GREY, linewidth=0.5, zorder=1)
        ax.text(one.middle, y, start.words, ha="center", va="center", fontsize=shrunk * size(), bbox=box, zorder=2)
