"""Tables as rows of cells: CSV files and spreadsheets, read and written."""

import csv
import io
import os
import tomllib
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from typing import Any

from beal.errors import ModelError
from beal.vehicle.file import LARGEST_FILE, read_bytes

KEPT = "# beal:"  # opens a row that carries what columns cannot say
MOST_CELLS, MOST_BYTES = 1_000_000, 100_000_000  # of a spreadsheet, which is packed
# What zipfile, its decompressors and openpyxl raise on a file that is damaged, encrypted or no spreadsheet.
UNREADABLE = (
    *(zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError),
    *(AttributeError, IndexError, KeyError, SyntaxError, TypeError, ValueError),
)
Cell = str | float
Rows = list[tuple[int, list[str]]]


def read_rows(path: str | os.PathLike[str]) -> tuple[Rows, dict[str, Any]]:
    """Read a table as numbered rows of stripped cells, without empty rows and comments, and what the comments say.

    Parameters
    ----------
    path : str or path-like
        CSV, or the first sheet of a spreadsheet (``.xlsx``).

    Returns
    -------
    rows : list of (number, cells)
    kept : dict
        Content of the rows that begin with ``# beal:``, which are TOML.

    Raises
    ------
    ModelError
        If the file cannot be read.
    """
    source = str(path)
    every = _sheet(path, source) if source.lower().endswith(".xlsx") else _csv(path, source)
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
    for number, line in enumerate(text.splitlines(), 1):
        try:
            # A comment is one cell, commas and quotes in it or not.
            yield [line] if line.lstrip().startswith("#") else next(csv.reader([line.replace("\0", " ")]), [])
        except csv.Error as error:
            raise ModelError([(f"row {number}", f"is not CSV: {error}")], source) from None


def _sheet(path: str | os.PathLike[str], source: str) -> Iterator[list[str]]:
    content = io.BytesIO(read_bytes(path, LARGEST_FILE, "a spreadsheet"))
    try:
        import openpyxl  # only spreadsheets need it
    except ImportError:
        raise ModelError("needs openpyxl: install beal[io], or give the table as CSV", source) from None
    left = MOST_CELLS
    try:
        _check_archive(content)
        sheet = openpyxl.load_workbook(content, read_only=True, data_only=True).worksheets[0]
        for row in sheet.iter_rows(values_only=True):
            left -= len(row)
            if left < 0:
                raise ValueError(f"it has more than {MOST_CELLS} cells")
            yield ["" if cell is None else str(cell) for cell in row]
    except UNREADABLE as error:
        raise ModelError(f"is not a spreadsheet: {error}", source) from None


def _check_archive(content: io.BytesIO) -> None:
    """Read all of a packed file once, whose damage openpyxl meets in many ways."""
    with zipfile.ZipFile(content) as archive:
        if sum(part.file_size for part in archive.infolist()) > MOST_BYTES:
            raise ValueError(f"it is larger than {MOST_BYTES // 10**6} MB when unpacked")
        if damaged := archive.testzip():
            raise ValueError(f"its part {damaged} is damaged")


def csv_text(rows: Iterable[list[Cell]]) -> str:
    """Rows as CSV; a row of one cell is a comment, which takes no quotes."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for row in rows:
        if len(row) == 1:
            text.write(f"{row[0]}\n")
        else:
            writer.writerow(row)
    return text.getvalue()


def sheet_content(rows: Iterable[list[Cell]]) -> bytes:
    """Rows as the content of an ``.xlsx`` file.

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
    for row in rows:
        sheet.append(row)
    content = io.BytesIO()
    book.save(content)
    return content.getvalue()
