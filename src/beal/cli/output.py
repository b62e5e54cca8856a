"""What the command prints and writes: strict JSON, tables, whole files."""

import csv
import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from beal.errors import ModelError
from beal.report.numbers import cell, plain

if TYPE_CHECKING:
    import xarray
    from rich.console import Console

STYLES = {  # of words in a table
    "agrees": "green",
    "differs": "bold red",
    "destabilises": "red",
    "restabilises": "green",
    "tumbles": "red",
    "not converged": "bold red",
    "invalid": "bold red",
}
Answer = Sequence[str | tuple[Sequence[str], Sequence[Sequence[object]]]]  # sentences, and tables as columns and rows


def emit(data: dict[str, Any]) -> None:
    """Print one JSON object: arrays as lists, what is not finite as null."""
    print(json.dumps(plain(data), allow_nan=False))


def note(message: str) -> None:
    """Print a message beside the result, on standard error."""
    print(f"beal: {message}", file=sys.stderr)


def console() -> "Console":
    """Standard output, with colours where it is a terminal and NO_COLOR is not set."""
    from rich.console import Console

    out = Console(markup=False, highlight=False, emoji=False)
    if not out.is_terminal:
        out.width = 160  # a pipe has no width: do not fold
    return out


def shows(letters: str) -> bool:
    """Whether the encoding of standard output has all the letters."""
    try:
        letters.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        return False
    return True


def say(text: str, style: str = "") -> None:
    """Print a line, on a terminal in a style."""
    console().print(text, style=style, soft_wrap=True)


def show(answer: Answer) -> None:
    """Print sentences and tables in their order."""
    for block in answer:
        if isinstance(block, str):
            print(block)
        else:
            show_table(*block)


def show_table(columns: Sequence[str], rows: Sequence[Sequence[object]], title: str = "") -> None:
    """Print a table; numbers with six significant digits, nothing where there is none."""
    from rich.table import Table
    from rich.text import Text

    table = Table(title=title or None, title_justify="left")
    for column in columns:
        table.add_column(column, justify="left" if column == "name" else "right")
    for row in rows:
        table.add_row(*(Text(text, STYLES.get(text, "")) for text in map(cell, row)))
    console().print(table)


@contextmanager
def new_file(path: Path) -> Iterator[TextIO]:
    """A text file that appears under its name when all of it is written.

    Parameters
    ----------
    path : Path
        In a folder that exists; a file that is there is replaced.

    Raises
    ------
    ModelError
        If no file can be written there.
    """
    with new_path(path) as part, part.open("w", encoding="utf-8", newline="") as file:
        yield file


@contextmanager
def new_path(path: Path) -> Iterator[Path]:
    """The name of an empty file that takes the place of another when all of it is written.

    Parameters
    ----------
    path : Path
        In a folder that exists; a file that is there is replaced.

    Raises
    ------
    ModelError
        If no file can be written there.
    """
    target = path.resolve()
    if target.exists() and not target.is_file():  # replacing a folder or a device would destroy it
        raise ModelError("cannot be written: is not a regular file; give the name of a file", str(path))
    part = target.with_name(f".{target.name}-{os.getpid()}.part")  # a command may write two files at once
    try:
        part.open("x").close()
    except OSError as error:
        message = f"cannot be written: {error.strerror}; give a file in a folder that exists and may be written"
        raise ModelError(message, str(path)) from None
    try:
        yield part
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)


def check_folder(path: Path) -> None:
    """Refuse the name of a result folder that cannot be made.

    Raises
    ------
    ModelError
        If it is a file, or the folder above it does not exist.
    """
    if path.exists() and not path.is_dir():
        raise ModelError("cannot be written: is a file; give the name of a folder", str(path))
    if not path.resolve().parent.is_dir():
        raise ModelError("cannot be written: the folder above does not exist; make it first", str(path))


def write_columns(file: TextIO, columns: dict[str, Any]) -> None:
    """Write equally long columns as CSV, with all digits."""
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


@contextmanager
def new_result(path: Path | None) -> Iterator["Callable[[dict[str, Any], Callable[[], xarray.Dataset]], None]"]:
    """Writes a result, given as columns and as a data set, to a file of the kind that the name's ending says.

    Parameters
    ----------
    path : Path or None
        CSV unless it ends with .nc, .mat, .uff or .unv; nothing is written to None.

    Raises
    ------
    ModelError
        If no file can be written there.
    """
    from beal.interop.files import RESULTS, write_result

    if path is None:
        yield lambda columns, dataset: None
    elif (ending := path.suffix.lower()) in RESULTS:
        with new_path(path) as part:
            yield lambda columns, dataset: write_result(dataset(), part, ending)
    else:
        with new_file(path) as file:
            yield lambda columns, dataset: write_columns(file, columns)


def check_new_folder(path: Path) -> None:
    """Refuse the name of a result folder that cannot be made or is there already.

    Raises
    ------
    ModelError
    """
    check_folder(path)
    if path.exists():
        raise ModelError("exists already; name another place or remove it", str(path))


def make_folder(path: Path) -> None:
    """Make a result folder and those above it.

    Raises
    ------
    ModelError
        If it cannot be made.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ModelError(f"cannot be written: {error.strerror}; give the name of a folder", str(path)) from None


@contextmanager
def progress_bar() -> Iterator[Callable[[str, int, int], None]]:
    """A bar on standard error that is moved by (text, done, total)."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("", total=None)
        yield lambda text, done, total: bar.update(task, description=text, completed=done, total=total)
