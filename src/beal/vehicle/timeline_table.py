"""A timeline as a table: a column for each history, a row for each time."""

from typing import Any

from beal.vehicle.columns import TEXT, columns

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
    found = columns(text, plain, _unit, "time, thrust, fill.TANK or stages")
    fills = {name.removeprefix(FILL): values for name, values in found.items() if name.startswith(FILL)}
    return {name: values for name, values in found.items() if not name.startswith(FILL)} | (
        {"fill": fills} if fills else {}
    )


def _unit(name: str) -> str | None:
    if name.startswith(FILL):
        return ""
    return {"time": "s", "thrust": "N", "stages": TEXT}.get(name)
