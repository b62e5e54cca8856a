"""What commands tell with ``--report``: one self-contained page."""

import shlex
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beal.cli.figures import Draw
from beal.cli.output import Answer, new_file, note
from beal.errors import ModelError
from beal.report.numbers import cell

if TYPE_CHECKING:
    from beal.report import Page
    from beal.vehicle.vehicle import Vehicle

Tell = Callable[..., None]  # as `page`


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
        yield lambda *told, **more: None
        return
    if path.suffix.lower() != ".html":
        raise ModelError(f"--report: must end with .html, found {path.suffix or 'no ending'}", str(path))
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        raise ModelError("--report: needs matplotlib, which is not installed; install beal[plot]") from None
    with new_file(path) as file:

        def write(*told: Any, **more: Any) -> None:
            file.write(page(*told, **more))

        yield write
    if not quiet:
        note(f"report written to {path}")


def page(
    vehicle: "Vehicle",
    question: str,
    answer: Answer,
    figures: Mapping[str, Draw],
    evidence: Answer = (),
    sources: Mapping[str, str] | None = None,
) -> str:
    """The page: what was asked, the answer, figures, the vehicle, and how to get it again.

    Parameters
    ----------
    vehicle : Vehicle
    question : str
    answer : Answer
    figures : mapping of str to callable
        By caption.
    evidence : Answer
        Below the figures.
    sources : mapping of str to str
        Text of the files that the answer was made from, by what they are; by default the vehicle's model.
    """
    from beal.notebook.pictures import image
    from beal.notebook.vehicle import vehicle as described
    from beal.plot import style
    from beal.report import Page
    from beal.vehicle.file import dumps

    title = f"{vehicle.title or 'Vehicle'}: {question}"
    found = Page(title, f"beal {version('beal')}")
    found.section("answer", "Answer")
    _add(found, answer)
    for number, (caption, draw) in enumerate(figures.items(), 1):
        with style():
            found.figure(f"figure-{number}", image(draw(), caption), f"Figure {number}", escape(caption))
    if evidence:
        found.section("evidence", "Evidence")
        _add(found, evidence)
    found.section("vehicle", "Vehicle")
    found.add(*described(vehicle))
    found.section("again", "Again")
    found.text("This page was made by")
    found.add(f"<pre>{escape(shlex.join(['beal', *sys.argv[1:]]))}</pre>")
    for name, text in (sources or {"the model": dumps(vehicle)}).items():
        found.text(f"from {escape(name)}")
        found.add(f"<pre>{escape(text)}</pre>")
    return found.html()


def _add(found: "Page", answer: Answer) -> None:
    """Sentences and tables."""
    from beal.report import table

    for block in answer:
        if isinstance(block, str):
            found.text(escape(block[:1].upper() + block[1:] + "."))
        else:
            columns, rows = block
            cells = [list(map(cell, row)) for row in rows]
            found.add(table([escape(name) for name in columns], cells, numeric=range(1, len(columns))))
