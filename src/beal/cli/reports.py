"""What commands tell with ``--report``: one self-contained page."""

import shlex
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from beal.cli.figures import Draw
from beal.cli.output import Answer, new_file, note
from beal.errors import ModelError
from beal.report.numbers import cell

if TYPE_CHECKING:
    from beal.vehicle.vehicle import Vehicle

Tell = Callable[["Vehicle", str, Answer, Mapping[str, Draw]], None]


@contextmanager
def new_report(path: Path | None, quiet: bool) -> Iterator[Tell]:
    """Writes a page of an answer and its figures, refusing before any work what could not be written.

    Parameters
    ----------
    path : Path or None
        Nothing is written for None.
    quiet : bool
        Whether nothing is said about it.

    Raises
    ------
    ModelError
        If the ending is not .html, matplotlib is not installed, or no file can be written there.
    """
    if path is None:
        yield lambda vehicle, question, answer, figures: None
        return
    if path.suffix.lower() != ".html":
        raise ModelError(f"--report: must end with .html, found {path.suffix or 'no ending'}", str(path))
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        raise ModelError("--report: needs matplotlib, which is not installed; install beal[plot]") from None
    with new_file(path) as file:

        def write(vehicle: "Vehicle", question: str, answer: Answer, figures: Mapping[str, Draw]) -> None:
            file.write(page(vehicle, question, answer, figures))

        yield write
    if not quiet:
        note(f"report written to {path}")


def page(vehicle: "Vehicle", question: str, answer: Answer, figures: Mapping[str, Draw]) -> str:
    """The page: what was asked, the answer, figures, the vehicle, and how to get it again."""
    from beal.notebook.pictures import image
    from beal.notebook.vehicle import vehicle as described
    from beal.plot import style
    from beal.report import Page, table
    from beal.vehicle.file import dumps

    title = f"{vehicle.title or 'Vehicle'}: {question}"
    found = Page(title, f"beal {version('beal')}")
    found.section("answer", "Answer")
    for block in answer:
        if isinstance(block, str):
            found.text(escape(block[:1].upper() + block[1:] + "."))
        else:
            columns, rows = block
            cells = [list(map(cell, row)) for row in rows]
            found.add(table([escape(name) for name in columns], cells, numeric=range(1, len(columns))))
    for number, (caption, draw) in enumerate(figures.items(), 1):
        with style():
            found.figure(f"figure-{number}", image(draw(), caption), f"Figure {number}", escape(caption))
    found.section("vehicle", "Vehicle")
    found.add(*described(vehicle))
    found.section("again", "Again")
    found.text("This page was made by")
    found.add(f"<pre>{escape(shlex.join(['beal', *sys.argv[1:]]))}</pre>")
    found.text("from the model")
    found.add(f"<pre>{escape(dumps(vehicle))}</pre>")
    return found.html()
