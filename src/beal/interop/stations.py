"""Station tables: rows of a CSV file or a spreadsheet become the stages of a vehicle.

One row per station, with the columns ``x`` [m], ``mass_per_length`` [kg/m] and ``bending_stiffness`` [N m^2], from nose
to tail; properties are linear between stations, and a station that is given twice ends one stage and begins the next.
Or one row per uniform piece, with ``x_start`` and ``x_end`` in place of ``x``. A column ``stage`` says which stage a
row belongs to; a station that is given twice in one stage is then a step. A name may end with a unit in brackets,
``x [ft]``. Rows that begin with ``# beal:`` hold the rest of the model, in the words of a model file.
"""

import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from beal.errors import ModelError
from beal.interop.cells import Rows, read_rows
from beal.interop.nastran import Imported
from beal.interop.structure import Remark, shown
from beal.interop.tables import along
from beal.units import to_si
from beal.vehicle.file import vehicle_from

PROPERTIES = {
    "mass_per_length": "kg/m",
    "bending_stiffness": "N*m^2",
    "shear_stiffness": "N",
    "rotary_inertia_per_length": "kg*m",
    "foundation_stiffness": "N/m^2",
}
# What a blank stands for; the others must be given.
OPTIONAL = {"shear_stiffness": math.inf, "rotary_inertia_per_length": 0.0, "foundation_stiffness": 0.0}
STIFF = ("bending_stiffness", "shear_stiffness")  # may be inf, rigid
REQUIRED = PROPERTIES.keys() - OPTIONAL.keys()
UNITS = {"x": "m", "x_start": "m", "x_end": "m", **PROPERTIES}
LABEL = "stage"
TOUCH = 1e-9  # of their distance from the origin: ends of rows that are one station


@dataclass(frozen=True)
class Row:
    """A row of the table: its place, the stage that it names, where it begins and ends, and its properties."""

    place: str
    label: str
    start: float
    end: float
    values: dict[str, float]


@dataclass
class Table:
    """The rows, whether each is a station or a piece between two, and the columns that nobody asks for."""

    rows: list[Row]
    of_stations: bool
    left: list[str]


Points = list[tuple[float, Row]]  # stations of one stage


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
    rows, kept = read_rows(path)
    given = kept.pop("x_from", "nose")
    x_from = x_from or given
    if x_from not in ("nose", "tail"):
        raise ModelError([("x_from", f"must be nose or tail, found {x_from!r}")], source)
    problems: list[Remark] = []
    table = _table(rows, columns or {}, kept.get("units") == "nondimensional", problems)
    stages = [] if problems else list((_between if table.of_stations else _each)(table.rows, problems))
    if problems:
        raise ModelError(shown(problems), source)
    turned = x_from == "tail"
    described = [_described(stage, turned) for stage in (reversed(stages) if turned else stages)]
    extra = kept.pop("stage", [{}] * len(stages))
    if not isinstance(extra, list) or len(extra) != len(stages) or not all(isinstance(part, dict) for part in extra):
        raise ModelError([("stage", f"must be a list of {len(stages)} tables, one for each stage")], source)
    joints = kept.pop("joint", [{}] * (len(stages) - 1))
    described = [{**stage, **more} for stage, more in zip(described, extra, strict=True)]
    vehicle = vehicle_from({"title": Path(path).stem, **kept, "stage": described, "joint": joints}, source)
    left = (f"columns without a place in a stage, left out: {', '.join(table.left)}",) if table.left else ()
    return Imported(vehicle, (f"x counts from the {x_from}",), left)


def _table(rows: Rows, names: Mapping[str, str], plain: bool, problems: list[Remark]) -> Table:
    """Rows of numbers in SI units."""
    if len(rows) < 2:
        problems.append(("table", "needs a row of names and at least one of numbers"))
        return Table([], True, [])
    (top, head), *body = rows
    bare = [cell.partition("[")[0].strip() for cell in head]
    known = (*UNITS, LABEL)
    problems += [("columns", f"{key!r} is none of {', '.join(known)}") for key in names if key not in known]
    problems += [("columns", f"the table has no {name!r}") for name in names.values() if name not in bare]
    problems += [(f"row {top}", f"names {name!r} twice") for name in sorted({*bare} - {""}) if bare.count(name) > 1]
    there = {key: bare.index(name) for key in known if (name := names.get(key, key)) in bare}
    of_stations = "x" in there
    for key in ("x_start", "x_end") if of_stations else ():
        there.pop(key, None)
    first, last = ("x", "x") if of_stations else ("x_start", "x_end")
    if missing := sorted({first, last, *REQUIRED} - there.keys()):
        other = "other names are given with beal convert --column NAME=COLUMN"
        problems.append((f"row {top}", f"has no column {', '.join(missing)}; found {', '.join(bare)[:200]}; {other}"))
        return Table([], of_stations, [])
    label = there.pop(LABEL, None)
    factors = {key: _factor(head[place], UNITS[key], plain, problems) for key, place in there.items()}
    table = []
    for number, cells in body:
        cells = [*cells, *[""] * (len(head) - len(cells))]
        found = {}
        for key, place in there.items():
            where = f"row {number}, {bare[place]}"
            found[key] = factors[key] * _number(cells[place], where, key, problems)
            if key in PROPERTIES and found[key] < 0:
                problems.append((where, f"must not be negative, found {cells[place][:20]}"))
        values = {key: value for key, value in found.items() if key in PROPERTIES}
        name = "" if label is None else cells[label]
        table.append(Row(f"row {number}", name, found[first], found[last], values))
    used = {*there.values(), label}
    return Table(table, of_stations, [name for place, name in enumerate(bare) if name and place not in used])


def _factor(title: str, wanted: str, plain: bool, problems: list[Remark]) -> float:
    """SI value of the unit in the brackets of a column's title."""
    unit = title.partition("[")[2].rstrip("] ")
    if unit and plain:
        problems.append((title, "a nondimensional model takes plain numbers"))
    try:
        return to_si(f"1 {unit}", wanted) if unit else 1.0
    except ValueError as error:
        problems.append((title, str(error)))
        return 1.0


def _number(text: str, place: str, key: str, problems: list[Remark]) -> float:
    """A number, finite unless it is a stiffness; a blank cell is the default of what has one."""
    if not text and key in OPTIONAL:
        return OPTIONAL[key]
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) and not (key in STIFF and value == math.inf):
        problems.append((place, f"must be a number, found {text[:20]!r}"))
    return value


def _between(table: list[Row], problems: list[Remark]) -> Iterator[Points]:
    """Stages between stations that are given twice, or where the label changes; properties are linear between rows."""
    if len(table) < 2:
        problems.append(("table", "needs at least two stations"))
    first = 0
    for n, (row, following) in enumerate(zip(table, [*table[1:], None], strict=True)):
        if following and following.start < row.start:
            problems.append((f"{following.place}, x", f"must not fall, found {following.start:g} after {row.start:g}"))
        elif following and following.label != row.label and following.start > row.start:
            message = f"begins another stage: repeat the station where the one before ends, {row.start:g}"
            problems.append((following.place, message))
        if following and following.label == row.label and (row.label or following.start != row.start):
            continue
        if row.start == table[first].start:
            problems.append((row.place, "is a stage without length: a station may come twice"))
        yield [(each.start, each) for each in table[first : n + 1]]
        first = n + 1


def _each(table: list[Row], problems: list[Remark]) -> Iterator[Points]:
    """Stages of rows that are uniform pieces: of equal rows, or of those of one label."""
    stage: Points = []
    for row, following in zip(table, [*table[1:], None], strict=True):
        if row.end <= row.start:
            found = f"{row.start:g} to {row.end:g}"
            problems.append((f"{row.place}, x_end", f"must lie beyond x_start, found {found}"))
        if following and abs(following.start - row.end) > TOUCH * max(abs(row.end), abs(row.start)):
            message = f"must be where the row above ends, {row.end:g}, found {following.start:g}"
            problems.append((f"{following.place}, x_start", message))
        stage += [(stage[-1][0] if stage else row.start, row), (row.end, row)]
        alike = following and (following.label or following.values) == (row.label or row.values)
        if not alike:
            yield stage
            stage = []


def _described(stage: Points, turned: bool) -> dict[str, Any]:
    """A stage as a model file has it."""
    if turned:
        stage = [(-x, row) for x, row in reversed(stage)]
    x = [station for station, _ in stage]
    label = stage[0][1].label
    values = {name: along(x, [row.values[name] for _, row in stage]) for name in stage[0][1].values}
    return {**({"name": label} if label and not label.isdigit() else {}), "length": x[-1] - x[0], **values}
