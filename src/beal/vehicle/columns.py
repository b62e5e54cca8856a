"""Tables in CSV: a row of names, each with a unit in brackets if it has one, and a row for each entry."""

import csv
import math
from collections.abc import Callable
from typing import Any

from beal.errors import ModelError
from beal.units import to_si

TEXT = "text"  # stands for a unit where cells are kept as they are


def columns(text: str, plain: bool, unit: Callable[[str], str | None], known: str) -> dict[str, list[Any]]:
    """The columns of a table in CSV, not checked yet.

    Parameters
    ----------
    text : str
        Rows that begin with # are comments.
    plain : bool
        Whether the model is nondimensional and takes no units.
    unit : callable
        The SI unit that a column of some name is kept in, ``TEXT`` for one of words, None if there is no such column.
    known : str
        What columns there are, for messages.

    Returns
    -------
    dict
        Numbers in SI units; cells that are no numbers as they are.

    Raises
    ------
    ModelError
        With every problem of the names, and every row that is longer than they are.

    Examples
    --------
    >>> columns("time [ms]\\n0\\n500\\n", False, {"time": "s"}.get, "time")
    {'time': [0.0, 0.5]}
    """
    lines = ((n, [cell.strip() for cell in row]) for n, row in enumerate(csv.reader(text.splitlines()), 1))
    rows = [(n, row) for n, row in lines if any(row) and not row[0].startswith("#")]
    if not rows:
        raise ModelError(f"needs a row of names ({known}), and a row for each time")
    (place, head), *rows = rows
    problems = [
        (f"row {n}", f"has {len(row)} cells, more than the {len(head)} names")
        for n, row in rows
        if len(row) > len(head)
    ]
    found: dict[str, list[Any]] = {}
    for column, title in enumerate(head):
        name, given = (part.rstrip("] ") for part in (*title.split("[", 1), "")[:2])
        wanted = unit(name)
        if wanted is None:
            problems.append((f"row {place}", f"{name!r} is no column here: {known}"))
        elif name in found:
            problems.append((f"row {place}", f"{name!r} comes twice"))
        else:
            cells = [row[column] if column < len(row) else "" for _, row in rows]
            factor = 1.0 if wanted == TEXT else _factor(title, given, wanted, plain, problems)
            found[name] = cells if wanted == TEXT else [_value(cell, factor) for cell in cells]
    if problems:
        raise ModelError(problems)
    return found


def _factor(title: str, given: str, wanted: str, plain: bool, problems: list[tuple[str, str]]) -> float:
    if given and plain:
        problems.append((title, "a nondimensional model takes plain numbers"))
    try:
        return to_si(f"1 {given}", wanted) if given else 1.0
    except ValueError as error:
        problems.append((title, str(error)))
        return 1.0


def _value(cell: str, factor: float) -> float | str:
    """A number, or the cell as it is for the model to refuse."""
    try:
        value = float(cell) * factor
    except ValueError:
        return cell
    return value if math.isfinite(value) else cell
