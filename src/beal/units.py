"""Units at the edge: a number is SI already, a string such as ``"12 ft"`` is converted, floats inside."""

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint


@cache
def registry() -> "pint.UnitRegistry[float]":
    import pint  # costs a third of a second: only files with units in them pay it

    return pint.UnitRegistry()


def to_si(text: str, unit: str) -> float:
    """Magnitude of ``text`` in the coherent SI ``unit``.

    Parameters
    ----------
    text : str
        A number with a unit, such as ``"12 ft"`` or ``"3.5e6 lbf*in^2"``, or a plain number.
    unit : str
        The SI unit that the quantity is kept in, such as ``"m"``; ``""`` for a pure number.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        If the text is not a quantity or has another dimension.

    Examples
    --------
    >>> round(to_si("12 ft", "m"), 4)
    3.6576
    """
    import pint

    try:
        quantity = registry().Quantity(text)
        if quantity.unitless and not quantity.dimensionality and "inf" in text.lower().split():
            return float(quantity.magnitude)
        return float(quantity.to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError as error:
        raise ValueError(f"expected a quantity in {unit or 'no unit'}, found {text!r} ({error.units1})") from None
    except (pint.PintError, ArithmeticError, AttributeError, TypeError, ValueError, SyntaxError) as error:
        raise ValueError(f"expected a number or a number with a unit in {unit}, found {text!r}") from error
