"""Units at the edge: a number is SI already, a string such as ``"12 ft"`` is converted, floats inside."""

import re
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint

# Stricter than pint, which reads "1,5 m" as 15 m and "m" as 1 m, and works out 9**9**9 to the last digit.
_NUMBER = r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|inf)"
_POWER = r"(?:\s*(?:\^|\*\*)\s*[+-]?[0-9]{1,2}|[²³⁴])?"
_NAME = rf"[A-Za-zµμ°%_]+{_POWER}"
_JOIN = r"(?:\s*[*/·]\s*|\s+)"
_FACTOR = rf"(?:{_NAME}|\({_NAME}(?:{_JOIN}{_NAME})*\){_POWER})"
_UNIT = rf"(?:1\s*/\s*)?{_FACTOR}(?:{_JOIN}{_FACTOR})*"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*({_UNIT})?\s*")
_LONGEST = 80


@cache
def registry() -> "pint.UnitRegistry[float]":
    """Pint's units, with the hertz as one turn per second: pint's own, 1/s, would pass for 1 rad/s."""
    import pint  # costs a third of a second: only files with units in them pay it

    units: pint.UnitRegistry[float] = pint.UnitRegistry(on_redefinition="ignore")
    units.define("hertz = 2 * pi * radian / second = Hz")
    return units


def to_si(text: str, unit: str) -> float:
    """Magnitude of ``text`` in the coherent SI ``unit``.

    Parameters
    ----------
    text : str
        A number with a unit, such as ``"12 ft"`` or ``"3.5e6 lbf*in^2"``; ``"inf"`` needs none.
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
    >>> round(to_si("1 Hz", "rad/s"), 4)
    6.2832
    """
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if match is None:
        raise ValueError(f"expected {_wanted(unit)}, found {text[:_LONGEST]!r}")
    number, given = float(match[1]), match[2]
    if given is None and (not unit or "inf" in match[1]):
        return number
    return _converted(text, number, given or "", unit)


def _converted(text: str, number: float, given: str, unit: str) -> float:
    import pint

    try:
        return float(registry().Quantity(number, given or "dimensionless").to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError as error:
        raise ValueError(f"expected {_wanted(unit)}, found {text!r} ({error.units1})") from None
    except (pint.PintError, ArithmeticError, AttributeError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f"expected {_wanted(unit)}, found {text!r} ({error})") from error


def _wanted(unit: str) -> str:
    return f"a number, or a number with a unit that converts to {unit}" if unit else "a pure number"
