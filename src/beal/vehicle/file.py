"""The model file: TOML to a vehicle and back."""

import json
import os
import tomllib
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from beal.errors import ModelError
from beal.vehicle.base import Part, problems
from beal.vehicle.columns import columns
from beal.vehicle.timeline_table import timeline_columns
from beal.vehicle.vehicle import Vehicle

LARGEST_FILE = 5_000_000  # bytes: a hundred thousand stages
_readable: ContextVar[tuple[Path, ...] | None] = ContextVar("_readable", default=None)


@contextmanager
def reading_only(*folders: Path) -> Iterator[None]:
    """While it holds, no file outside these folders is read, whatever a model or a deck names.

    Parameters
    ----------
    *folders : Path
    """
    token = _readable.set(tuple(folder.resolve() for folder in folders))
    try:
        yield
    finally:
        _readable.reset(token)


def loads(text: str, source: str = "model") -> Vehicle:
    """Read a vehicle from the text of a model file.

    Parameters
    ----------
    text : str
        TOML.
    source : str
        What error messages call it.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        With every problem in the text, each with its path.

    Examples
    --------
    >>> loads("[[stage]]\\nlength = '2 km'\\nmass_per_length = 2.0\\nbending_stiffness = 3.0").length
    2000.0
    """
    return vehicle_from(_parsed(text, source), source)


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read the content of any TOML file, not checked yet.

    Parameters
    ----------
    path : str or path-like

    Returns
    -------
    dict

    Raises
    ------
    ModelError
        With the reason why the file cannot be read.
    """
    return _parsed(_text(path, "a text file in TOML"), str(path))


def read_timeline(path: str | os.PathLike[str], units: str | None) -> dict[str, Any]:
    """Read the fields of a timeline from a table, not checked yet.

    Parameters
    ----------
    path : str or path-like
        CSV, see `beal.vehicle.timeline_table.timeline_columns`.
    units : str or None
        Of the model: ``nondimensional``, or anything else.

    Returns
    -------
    dict

    Raises
    ------
    ModelError
        With the reason why the file cannot be read, or what is wrong with its columns.
    """
    text = _text(path, "a table in CSV")
    try:
        return timeline_columns(text, units == "nondimensional")
    except ModelError as error:
        raise ModelError(error.problems, str(path)) from None


def _read_signal(path: str | os.PathLike[str], units: str | None) -> dict[str, Any]:
    """The fields of a table of a force over time from CSV, not checked yet."""
    text = _text(path, "a table in CSV")
    try:
        return columns(text, units == "nondimensional", {"time": "s", "value": "N"}.get, "time and value")
    except ModelError as error:
        raise ModelError(error.problems, str(path)) from None


def _text(path: str | os.PathLike[str], expected: str) -> str:
    try:
        return read_bytes(path, LARGEST_FILE, expected).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        message = f"is not text in UTF-8 (byte {error.start} is wrong): expected {expected}"
        raise ModelError(message, str(path)) from None


def read_bytes(path: str | os.PathLike[str], largest: int, expected: str) -> bytes:
    """Content of a file that is not larger than it should be.

    Parameters
    ----------
    path : str or path-like
    largest : int
        In bytes.
    expected : str
        What kind of file it should be, for the message.

    Returns
    -------
    bytes

    Raises
    ------
    ModelError
        With the reason why the file cannot be read.
    """
    source = str(path)
    _check_readable(path)
    try:
        with Path(path).open("rb") as file:
            content = file.read(largest + 1)
    except OSError as error:
        raise ModelError(f"cannot be read: {error.strerror or error}", source) from None
    except ValueError as error:
        raise ModelError(f"is not a file name: {error}", repr(source)) from None
    if len(content) > largest:
        raise ModelError(f"is larger than {largest // 10**6} MB: expected {expected}", source)
    return content


def _check_readable(path: str | os.PathLike[str]) -> None:
    folders = _readable.get()
    if folders is None:
        return
    inside = "\0" not in str(path) and any(Path(path).resolve().is_relative_to(folder) for folder in folders)
    if not inside:
        raise ModelError("is not read here; put its content into the model", str(path))


def vehicle_from(data: dict[str, Any], source: str) -> Vehicle:
    """The vehicle that the content of a model file describes.

    Parameters
    ----------
    data : dict
        As TOML gives it.
    source : str
        What error messages call it.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        With every problem, each with its path.
    """
    if not data:
        raise ModelError("is empty, expected at least one [[stage]]", source)
    fields = {name: field.alias or name for name, field in Vehicle.model_fields.items()}
    # Fields that Python code calls by another name than the file are unknown keys there.
    refused = [name for name in data if fields.get(name, name) != name]
    known = ", ".join(fields.values())
    found = [(name, f"unknown key; known here: {known}") for name in refused]
    accepted = {key: value for key, value in data.items() if key not in refused}
    accepted = _with_tables(accepted, Path(source).parent, found)
    try:
        vehicle = Vehicle.model_validate(accepted, context={"units": data.get("units")})
    except ValidationError as error:
        raise ModelError([*found, *problems(error, Vehicle)], source) from None
    if found:
        raise ModelError(found, source)
    return vehicle


def _with_tables(data: dict[str, Any], folder: Path, found: list[tuple[str, str]]) -> dict[str, Any]:
    """The content of a model file with what is in files of their own, named from where it is; adds to the problems."""
    units = data.get("units")

    def beside(given: Any, name: str, read: Callable[[Path, str | None], dict[str, Any]], stand_in: Any) -> Any:
        if not isinstance(given, dict) or "file" not in given:
            return given
        file, others = given["file"], given.keys() - {"file", "kind"}
        try:
            if others or not isinstance(file, str):
                raise ModelError(f"must be the name of a file and nothing beside it, found {', '.join(given)}")
            return {key: value for key, value in given.items() if key == "kind"} | read(folder / file, units)
        except ModelError as error:
            name = f"{name}.file, {file}"
            found.extend((f"{name}, {place}" if place else name, message) for place, message in error.problems)
            return stand_in

    content = dict(data)
    if "timeline" in data:
        content["timeline"] = beside(data["timeline"], "timeline", read_timeline, None)

    def with_table(part: Any, name: str) -> Any:
        if not (isinstance(part, dict) and isinstance(signal := part.get("signal"), dict) and _is_a_file(signal)):
            return part
        return part | {"signal": beside(signal, f"{name}.signal", _read_signal, {"kind": "step", "amplitude": 0.0})}

    if isinstance(forces := data.get("force"), list):
        content["force"] = [with_table(force, f"force[{n}]") for n, force in enumerate(forces)]
    if "thrust" in data:
        content["thrust"] = with_table(data["thrust"], "thrust")
    return content


def _is_a_file(signal: dict[str, Any]) -> bool:
    return signal.get("kind") == "table" and "file" in signal


def _parsed(text: str, source: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except ValueError as error:  # TOMLDecodeError, or a whole number of thousands of digits
        raise ModelError(f"is not valid TOML: {error}", source) from None
    except RecursionError:
        raise ModelError("is not a model: lists or tables are nested too deeply", source) from None


def dumps(vehicle: Vehicle) -> str:
    """TOML text that reads back to an equal vehicle.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    str
        Quantities as plain numbers; what has its default value is left out.

    Examples
    --------
    >>> print(dumps(loads("[[stage]]\\nlength = 2\\nmass_per_length = 1.0\\nbending_stiffness = '3 kN*m^2'")))
    [[stage]]
    length = 2.0
    mass_per_length = 1.0
    bending_stiffness = 3000.0
    <BLANKLINE>
    """
    return "\n".join(_blocks(vehicle, {}))


def dumps_rest(vehicle: Vehicle, said: Mapping[str, Collection[str]]) -> str:
    """TOML text of what another format cannot say.

    Parameters
    ----------
    vehicle : Vehicle
    said : mapping of str to collection of str
        For each kind of part the keys that the other format holds.

    Returns
    -------
    str
        As many tables of a kind as the vehicle has parts, or none.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> said = {"stage": ["length", "mass_per_length"], "point_mass": ["station", "mass"]}
    >>> print(dumps_rest(catalog.pflueger(0.5), said))
    title = "Pflüger's column"
    units = "nondimensional"
    <BLANKLINE>
    [[stage]]
    bending_stiffness = 1.0
    <BLANKLINE>
    [support]
    nose = "clamped"
    <BLANKLINE>
    """
    return "\n".join(_blocks(vehicle, said))


def _blocks(vehicle: Vehicle, said: Mapping[str, Collection[str]]) -> Iterator[str]:
    given = list(_given(vehicle))
    if plain := "".join(f"{key} = {_literal(value)}\n" for key, value in given if not _is_table(value)):
        yield plain
    for key, value in given:
        if not _is_table(value):
            continue
        parts = [value] if isinstance(value, Part) else value
        rest = [_assignments(part, said.get(key, ())) for part in parts]
        head = f"[{key}]\n" if isinstance(value, Part) else f"[[{key}]]\n"
        if any(rest) or key not in said:
            yield from (head + text for text in rest)


def _given(part: Part) -> Iterator[tuple[str, Any]]:
    """(key, value) of what differs from its default."""
    for name, field in type(part).model_fields.items():
        value = getattr(part, name)
        if field.is_required() or value != field.default:
            yield field.alias or name, value


def _is_table(value: Any) -> bool:
    return isinstance(value, Part) or (isinstance(value, tuple) and any(isinstance(item, Part) for item in value))


def _assignments(part: Part, said: Collection[str]) -> str:
    return "".join(f"{key} = {_literal(value)}\n" for key, value in _given(part) if key not in said)


def _literal(value: Any) -> str:
    if isinstance(value, Part):
        return "{" + ", ".join(f"{key} = {_literal(item)}" for key, item in _given(value)) + "}"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_literal(key)} = {_literal(item)}" for key, item in value.items()) + "}"
    if isinstance(value, tuple):
        return "[" + ", ".join(map(_literal, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # the one escape that JSON lacks
    return repr(float(value))
