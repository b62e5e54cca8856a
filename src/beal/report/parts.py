"""Parts of a resolved vehicle in the cells of a table."""

from typing import Any

from beal.report.numbers import cell


def told(value: Any) -> str:
    """A table by its range, springs by their names, all else as it is.

    Parameters
    ----------
    value : object
        Of a `beal.vehicle.summary.summary`.

    Returns
    -------
    str

    Examples
    --------
    >>> told({"x": [0.0, 1.0], "value": [2.0, 1.0]}), told({"translation": 4.0, "rotation": "rigid"}), told(None)
    ('1 to 2', 'translation 4 and rotation rigid', '')
    """
    if not isinstance(value, dict):
        return cell(value)
    if "x" in value:
        return f"{cell(min(value['value']))} to {cell(max(value['value']))}"
    return " and ".join(f"{key} {cell(item)}" for key, item in value.items())


def titled(name: str, units: dict[str, str]) -> str:
    """The name of a quantity with its unit, if it has one.

    Parameters
    ----------
    name : str
    units : dict

    Returns
    -------
    str

    Examples
    --------
    >>> titled("bending_stiffness", {"bending_stiffness": "N m^2"})
    'bending stiffness [N m^2]'
    """
    title = name.replace("_", " ")
    return f"{title} [{units[name]}]" if name in units else title
