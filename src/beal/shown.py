"""How results come to be shown in notebooks: here they only say that they can be, the rooms above them say how."""

from collections.abc import Callable
from typing import Any

_painters: list[Callable[[Any], str]] = []


def painted_by(painter: Callable[[Any], str]) -> None:
    """Name the function that turns what is `Shown` into HTML, in place of the one before.

    Parameters
    ----------
    painter : callable
    """
    _painters[:] = [painter]


class Shown:
    """Base of what a notebook shows as figures and tables.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> catalog.beck()._repr_html_()[:18]
    '<div class="beal">'
    """

    def _repr_html_(self) -> str | None:
        """HTML for a notebook."""
        return _painters[0](self) if _painters else None
