"""Numbers with the digits that they deserve."""

import math

MOST_DIGITS = 9


def digits(value: float, error: float | None) -> str:
    """The number with as many digits as its error supports.

    Parameters
    ----------
    value : float
    error : float or None
        In the same unit; six digits where it is not known.

    Returns
    -------
    str

    Examples
    --------
    >>> digits(106.43723149, 1e-9), digits(106.43723149, 0.004), digits(106.4, None)
    ('106.437231', '106.44', '106.4')
    """
    if error is None or value == 0:
        return f"{value:.6g}"
    known = MOST_DIGITS
    if error > 0:
        known = math.floor(math.log10(abs(value))) - math.ceil(math.log10(2 * error)) + 1
    return f"{value:#.{min(max(known, 1), MOST_DIGITS)}g}".rstrip(".")


def quantity(value: float, unit: str, error: float | None = None) -> str:
    """The number with its digits and a unit prefix, k or M.

    Parameters
    ----------
    value : float
    unit : str
        Without it there is no prefix.
    error : float, optional

    Returns
    -------
    str

    Examples
    --------
    >>> quantity(106437.25, "N"), quantity(106.25, "")
    ('106.437 kN', '106.25')
    """
    if not unit:
        return digits(value, error)
    factor, unit = prefixed(value, unit)
    return f"{digits(value / factor, None if error is None else error / factor)} {unit}"


def prefixed(value: float, unit: str) -> tuple[float, str]:
    """The size of the unit in which a value is told, and its name with the prefix k or M.

    Parameters
    ----------
    value : float
    unit : str

    Returns
    -------
    size : float
    name : str

    Examples
    --------
    >>> prefixed(2.5e5, "N")
    (1000.0, 'kN')
    """
    factor, prefix = next(((f, p) for f, p in ((1e6, "M"), (1e3, "k")) if abs(value) >= f), (1.0, ""))
    return factor, f"{prefix}{unit}"


def cell(value: object) -> str:
    """A value as a table shows it: nothing for None, six digits of a float.

    Parameters
    ----------
    value : object

    Returns
    -------
    str

    Examples
    --------
    >>> cell(None), cell(2 / 3), cell(3), cell("rigid")
    ('', '0.666667', '3', 'rigid')
    """
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
