"""Numbers as people and as strict JSON read them."""

import math
from typing import Any

MOST_DIGITS = 9


def plain(value: Any) -> Any:
    """A result as strict JSON takes it: arrays as lists, what is not finite as null.

    Examples
    --------
    >>> plain({"thrust": (1.0, float("inf"))})
    {'thrust': [1.0, None]}
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def digits(value: float, error: float | None) -> str:
    """The number with as many digits as its error supports.

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

    Examples
    --------
    >>> quantity(106437.25, "N"), quantity(106.25, "")
    ('106.437 kN', '106.25')
    """
    if not unit:
        return digits(value, error)
    factor, prefix = next(((f, p) for f, p in ((1e6, "M"), (1e3, "k")) if abs(value) >= f), (1.0, ""))
    return f"{digits(value / factor, None if error is None else error / factor)} {prefix}{unit}"
