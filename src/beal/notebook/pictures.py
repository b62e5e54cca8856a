"""Figures inside HTML, and the line above them."""

from collections.abc import Callable
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

from beal.report import data_uri

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDE, HIGH = 6.4, 3.6  # inches


def picture(draw: "Callable[[Any, Figure], object]", title: str, width: float = WIDE, height: float = HIGH) -> str:
    """What is drawn on a new figure, as an image element; without matplotlib a line that says so.

    Parameters
    ----------
    draw : callable
        Takes the module `beal.plot` and a figure.
    title : str
        For those who cannot see it.
    width, height : float
        In inches.

    Returns
    -------
    str
    """
    try:
        from beal import plot
    except ModuleNotFoundError as error:
        if not str(error.name).startswith("matplotlib"):
            raise
        return "<p>Figures need matplotlib: install beal[plot].</p>"
    from matplotlib.figure import Figure

    with plot.style():
        figure = Figure(figsize=(width, height), layout="constrained")
        draw(plot, figure)
        return image(figure, title)


def verdict(text: str) -> str:
    """What was found, as the first line.

    Parameters
    ----------
    text : str
        HTML.

    Returns
    -------
    str
    """
    return f'<p class="verdict">{text}</p>'


def image(figure: "Figure", title: str) -> str:
    """A figure as an image element.

    Parameters
    ----------
    figure : Figure
    title : str
        For those who cannot see it.

    Returns
    -------
    str
    """
    file = BytesIO()
    figure.savefig(file, format="svg", metadata={"Date": None})  # the same each time
    return f'<img alt="{escape(title)}" src="{data_uri(file.getvalue(), "svg")}">'
