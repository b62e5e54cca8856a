"""Station tables: a vehicle's stages as rows of a CSV file or a spreadsheet.

One row per station, with the columns ``x`` [m], ``mass_per_length`` [kg/m] and ``bending_stiffness`` [N m^2], from nose
to tail; a station that is given twice ends one stage and begins the next. Or one row per stage, with ``x_start`` and
``x_end`` in place of ``x``. A name may end with a unit in brackets, ``x [ft]``. Rows that begin with ``# beal:`` hold
the rest of the model, in the words of a model file.
"""

import csv
import io
import math
import os
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal

from beal.errors import ModelError
from beal.interop.nastran import Imported
from beal.units import to_si
from beal.vehicle.file import LARGEST_FILE, dumps_rest, read_bytes, vehicle_from
from beal.vehicle.parts import Stage
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle

KEPT = "# beal:"
UNITS = {"x": "m", "x_start": "m", "x_end": "m", "mass_per_length": "kg/m", "bending_stiffness": "N*m^2"}
SAID = {"stage": ("length", "mass_per_length", "bending_stiffness")}
Rows = list[tuple[int, list[str]]]


def read_stations(
    path: str | os.PathLike[str],
    x_from: Literal["nose", "tail"] | None = None,
    columns: Mapping[str, str] | None = None,
) -> Imported:
    """Read a vehicle from a station table.

    Parameters
    ----------
    path : str or path-like
        CSV, or the first sheet of a spreadsheet (``.xlsx``, with the extra ``io``).
    x_from : {"nose", "tail"}, optional
        Where x counts from; else what the file says by ``# beal: x_from = "tail"``, else the nose.
    columns : mapping of str to str, optional
        The table's own names of columns: ``{"mass_per_length": "m_liftoff_kg_m"}``.

    Returns
    -------
    Imported

    Raises
    ------
    ModelError
        With every problem and its row.
    """
    source = str(path)
    rows, kept = _rows(path, source)
    given = kept.pop("x_from", "nose")
    x_from = x_from or given
    if x_from not in ("nose", "tail"):
        raise ModelError([("x_from", f"must be nose or tail, found {x_from!r}")], source)
    problems: list[tuple[str, str]] = []
    table, ignored = _columns(rows, columns or {}, kept.get("units") == "nondimensional", problems)
    stages = [] if problems else _stages(table, x_from == "tail", [n for n, _ in rows[1:]], problems)
    if problems:
        raise ModelError(problems, source)
    extra = kept.pop("stage", [{}] * len(stages))
    if not isinstance(extra, list) or len(extra) != len(stages):
        raise ModelError([("stage", f"must be a list of {len(stages)} tables, one for each stage")], source)
    joints = kept.pop("joint", [{}] * (len(stages) - 1))
    stages = [{**stage, **more} for stage, more in zip(stages, extra, strict=True)]
    vehicle = vehicle_from({"title": Path(path).stem, **kept, "stage": stages, "joint": joints}, source)
    return Imported(vehicle, (f"x counts from the {x_from}",), tuple(ignored))


def _rows(path: str | os.PathLike[str], source: str) -> tuple[Rows, dict[str, Any]]:
    """Numbered rows without empty ones and comments, and what the comments say."""
    every = _sheet(path, source) if str(path).lower().endswith(".xlsx") else _csv(path, source)
    rows: Rows = []
    kept: list[str] = []
    for number, row in enumerate(every, 1):
        cells = [cell.strip() for cell in row]
        if cells and cells[0].startswith("#"):
            line = ",".join(row).strip()
            if line.startswith(KEPT):
                kept.append(line.removeprefix(KEPT).removeprefix(" "))
        elif any(cells):
            rows.append((number, cells))
    try:
        return rows, tomllib.loads("\n".join(kept))
    except (ValueError, RecursionError) as error:
        raise ModelError(f"the rows that begin with {KEPT} are not valid TOML: {error}", source) from None


def _csv(path: str | os.PathLike[str], source: str) -> Iterator[list[str]]:
    try:
        text = read_bytes(path, LARGEST_FILE, "a table").decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ModelError(f"is not text in UTF-8 (byte {error.start} is wrong): expected CSV", source) from None
    for line in text.splitlines():
        # A comment is one cell, commas and quotes in it or not.
        yield [line] if line.lstrip().startswith("#") else next(csv.reader([line.replace("\0", " ")]), [])


def _sheet(path: str | os.PathLike[str], source: str) -> list[list[str]]:
    content = read_bytes(path, LARGEST_FILE, "a spreadsheet")
    try:
        import openpyxl  # only spreadsheets need it
    except ImportError:
        raise ModelError("needs openpyxl: install beal[io], or give the table as CSV", source) from None
    from zipfile import BadZipFile

    try:
        sheet = openpyxl.load_workbook(io.BytesIO(content), read_only=True, data_only=True).worksheets[0]
        return [["" if cell is None else str(cell) for cell in row] for row in sheet.iter_rows(values_only=True)]
    except (BadZipFile, KeyError, ValueError, IndexError) as error:
        raise ModelError(f"is not a spreadsheet: {error}", source) from None


def _columns(
    rows: Rows, names: Mapping[str, str], plain: bool, problems: list[tuple[str, str]]
) -> tuple[dict[str, list[float]], list[str]]:
    """Numbers of the known columns, in SI units."""
    if len(rows) < 2:
        problems.append(("table", "needs a row of names and at least one of numbers"))
        return {}, []
    head = rows[0][1]
    bare = [cell.partition("[")[0].strip() for cell in head]
    places = {key: names.get(key, key) for key in UNITS}
    unknown = [key for key in names if key not in UNITS]
    problems += [("columns", f"{key!r} is none of {', '.join(UNITS)}") for key in unknown]
    problems += [("columns", f"the table has no {place!r}") for key, place in names.items() if place not in bare]
    there = {key: bare.index(place) for key, place in places.items() if place in bare}
    wanted = {"mass_per_length", "bending_stiffness"} | ({"x"} if "x" in there else {"x_start", "x_end"})
    if missing := sorted(wanted - set(there)):
        problems.append((f"row {rows[0][0]}", f"has no column {', '.join(missing)}; found {', '.join(bare)[:200]}"))
        return {}, []
    table: dict[str, list[float]] = {}
    for key in sorted(wanted):
        unit = head[there[key]].partition("[")[2].rstrip("] ")
        if unit and plain:
            problems.append((head[there[key]], "a nondimensional model takes plain numbers"))
        try:
            factor = to_si(f"1 {unit}", UNITS[key]) if unit else 1.0
        except ValueError as error:
            problems.append((head[there[key]], str(error)))
            factor = 1.0
        table[key] = [factor * _number(number, row, there[key], places[key], problems) for number, row in rows[1:]]
    left = [name for name in bare if name and bare.index(name) not in {there[key] for key in wanted}]
    return table, [f"columns without a place in a stage, left out: {', '.join(left)}"] if left else []


def _number(number: int, row: list[str], place: int, name: str, problems: list[tuple[str, str]]) -> float:
    text = row[place] if place < len(row) else ""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        problems.append((f"row {number}, {name}", f"must be a number, found {text[:20]!r}"))
    return value


def _stages(
    table: dict[str, list[float]], turned: bool, numbers: list[int], problems: list[tuple[str, str]]
) -> list[dict[str, Any]]:
    """Stages from nose to tail."""
    starts, ends = (table[key] for key in (("x", "x") if "x" in table else ("x_start", "x_end")))
    values = list(zip(table["mass_per_length"], table["bending_stiffness"], strict=True))
    pieces = list(
        _between(starts, values, numbers, problems) if "x" in table else _each(starts, ends, values, numbers, problems)
    )
    if not pieces and not problems:
        problems.append(("table", "needs at least two stations"))
    return [
        {"length": length, "mass_per_length": mass, "bending_stiffness": stiffness}
        for length, (mass, stiffness) in (reversed(pieces) if turned else pieces)
    ]


Piece = tuple[float, tuple[float, float]]


def _between(
    x: list[float], values: list[tuple[float, float]], numbers: list[int], problems: list[tuple[str, str]]
) -> Iterator[Piece]:
    """Length and properties between repeated stations; where stages are uniform, so is the table there."""
    first = 0
    for n in range(1, len(x)):
        if x[n] < x[n - 1]:
            problems.append((f"row {numbers[n]}, x", f"must not fall, found {x[n]:g} after {x[n - 1]:g}"))
        elif x[n] > x[n - 1] and values[n] != values[n - 1]:
            message = "properties change between two stations: a stage is uniform, give a step (the station twice)"
            problems.append((f"row {numbers[n]}", message))
        if n + 1 == len(x) or x[n + 1] == x[n]:
            if x[n] > x[first]:
                yield x[n] - x[first], values[first]
            first = n + 1


def _each(
    starts: list[float],
    ends: list[float],
    values: list[tuple[float, float]],
    numbers: list[int],
    problems: list[tuple[str, str]],
) -> Iterator[Piece]:
    """Length and properties of runs of rows with equal ones."""
    first = 0
    for n, (start, end) in enumerate(zip(starts, ends, strict=True)):
        if end <= start:
            problems.append((f"row {numbers[n]}, x_end", f"must lie beyond x_start, found {start:g} to {end:g}"))
        if n and start != ends[n - 1]:
            problems.append((f"row {numbers[n]}, x_start", f"must be where the row above ends, {ends[n - 1]:g}"))
        if n + 1 == len(starts) or values[n + 1] != values[n]:
            yield end - starts[first], values[first]
            first = n + 1


def station_rows(vehicle: Vehicle) -> list[list[str | float]]:
    """Rows of a station table that reads back to the vehicle.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    list of list

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> for row in station_rows(catalog.beck())[-3:]:
    ...     print(row)
    ['x', 'mass_per_length', 'bending_stiffness']
    [0.0, 1.0, 1.0]
    [1.0, 1.0, 1.0]
    """
    units = {"x": "m", "mass_per_length": "kg/m", "bending_stiffness": "N*m^2"}
    head = [f"{name} [{unit}]" if vehicle.units == "SI" else name for name, unit in units.items()]
    rest = ([] if vehicle.title else ['title = ""']) + dumps_rest(vehicle, SAID).splitlines()
    rows: list[list[str | float]] = [[f"{KEPT} {line}"] for line in rest]
    rows.append([*head])
    for stage, start, end in zip(vehicle.stages, vehicle.boundaries, vehicle.boundaries[1:], strict=False):
        rows += [[x, *_properties(stage)] for x in (start, end)]
    return rows


def _properties(stage: Stage) -> tuple[float, float]:
    if stage.tables:
        raise ModelError([("stage", f"{' and '.join(stage.tables)} vary along it, which is not written; keep TOML")])
    return mean(stage.mass_per_length), mean(stage.bending_stiffness)


def stations_text(vehicle: Vehicle) -> str:
    """The station table of a vehicle as CSV.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    str
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for row in station_rows(vehicle):
        if len(row) == 1:
            text.write(f"{row[0]}\n")  # a comment, without quotes
        else:
            writer.writerow(row)
    return text.getvalue()


def stations_sheet(vehicle: Vehicle) -> bytes:
    """The station table of a vehicle as a spreadsheet.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    bytes
        Of an ``.xlsx`` file.

    Raises
    ------
    ModelError
        If openpyxl, of the extra ``io``, is not installed.
    """
    try:
        import openpyxl
    except ImportError:
        raise ModelError("a spreadsheet needs openpyxl: install beal[io], or write CSV") from None
    book = openpyxl.Workbook(write_only=True)
    sheet = book.create_sheet("stations")
    for row in station_rows(vehicle):
        sheet.append(row)
    content = io.BytesIO()
    book.save(content)
    return content.getvalue()
