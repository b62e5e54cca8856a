"""Options that take a number or a grid."""

import math

from beal.errors import ModelError

GRID = "a number, or a grid as FROM:TO:POINTS with more than one point"


def values(option: str, text: str) -> list[float]:
    """One number, or those of a grid.

    Parameters
    ----------
    option : str
        What the message calls it.
    text : str

    Returns
    -------
    list of float
        Ascending.

    Raises
    ------
    ModelError
        If it is neither.

    Examples
    --------
    >>> values("--thrust", "5"), values("--thrust", "0:1:3")
    ([5.0], [0.0, 0.5, 1.0])
    """
    from numpy import linspace

    try:
        match text.split(":"):
            case [number]:
                return [float(number)]
            case [start, stop, points] if float(start) < float(stop) < math.inf and int(points) > 1:
                return list(linspace(float(start), float(stop), int(points)).tolist())
    except ValueError:
        pass
    raise ModelError(f"{option}: must be {GRID}, in ascending order, found {text!r}")
