"""A timeline as a table: a column for each history, a row for each time."""

import csv
import math
from typing import Any

from beal.errors import ModelError
from beal.units import to_si

UNITS = {"time": "s", "thrust": "N"}
FILL = "fill."


def timeline_columns(text: str, plain: bool) -> dict[str, Any]:
    """The fields of a timeline from CSV, not checked yet.

    Parameters
    ----------
    text : str
        A row of names, ``time``, ``thrust``, ``fill.TANK`` for any tanks and, if stages leave, ``stages``, then a row
        for each time. A name may end with a unit in brackets, ``thrust [kN]``. Rows that begin with # are comments.
    plain : bool
        Whether the model is nondimensional and takes no units.

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
    >>> timeline_columns("time [min], thrust [kN], fill.LOX\\n0, 40, 1\\n2, 45, 0.1", plain=False)
    {'time': [0.0, 120.0], 'thrust': [40000.0, 45000.0], 'fill': {'LOX': [1.0, 0.1]}}
    """
    lines = ((n, [cell.strip() for cell in row]) for n, row in enumerate(csv.reader(text.splitlines()), 1))
    rows = [(n, row) for n, row in lines if any(row) and not row[0].startswith("#")]
    if not rows:
        raise ModelError("needs a row of names, time, thrust and so on, and a row for each time")
    (place, head), *rows = rows
    problems = [
        (f"row {n}", f"has {len(row)} cells, more than the {len(head)} names")
        for n, row in rows
        if len(row) > len(head)
    ]
    found: dict[str, Any] = {}
    for column, title in enumerate(head):
        name, unit = (part.rstrip("] ") for part in (*title.split("[", 1), "")[:2])
        where = found.setdefault("fill", {}) if name.startswith(FILL) else found
        key = name.removeprefix(FILL)
        if where is found and name not in (*UNITS, "stages"):
            problems.append((f"row {place}", f"{name!r} is no column of a timeline: time, thrust, fill.TANK or stages"))
        elif key in where:
            problems.append((f"row {place}", f"{name!r} comes twice"))
        else:
            cells = [row[column] if column < len(row) else "" for _, row in rows]
            factor = _factor(title, unit, UNITS.get(name, ""), plain, problems)
            where[key] = cells if name == "stages" else [_value(cell, factor) for cell in cells]
    if problems:
        raise ModelError(problems)
    return found


def _factor(title: str, unit: str, wanted: str, plain: bool, problems: list[tuple[str, str]]) -> float:
    if unit and plain:
        problems.append((title, "a nondimensional model takes plain numbers"))
    try:
        return to_si(f"1 {unit}", wanted) if unit else 1.0
    except ValueError as error:
        problems.append((title, str(error)))
        return 1.0


def _value(cell: str, factor: float) -> float | str:
    """A number, or the cell as it is for the timeline to refuse."""
    try:
        value = float(cell) * factor
    except ValueError:
        return cell
    return value if math.isfinite(value) else cell
