"""The page of one run: what was asked, of which vehicle, what came out, and how to do it again."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

from beal.report.html import Page, data_uri, table
from beal.report.numbers import cell


@dataclass(frozen=True)
class Table:
    """Values under a header, as plain text and numbers; None leaves a cell empty."""

    header: Sequence[str]
    rows: Sequence[Sequence[Any]]
    caption: str = ""

    def html(self) -> str:
        """Columns of numbers flush right."""
        columns = list(zip(*self.rows, strict=True))
        numeric = [n for n, column in enumerate(columns) if all(isinstance(x, float | int | None) for x in column)]
        header = [escape(title) for title in self.header]
        return table(header, [list(map(cell, row)) for row in self.rows], escape(self.caption), numeric)


@dataclass(frozen=True)
class Picture:
    """A figure as SVG, with what it shows."""

    svg: bytes
    title: str
    caption: str = ""


@dataclass(frozen=True)
class Section:
    """Paragraphs, pictures and tables under a title, all of plain text."""

    title: str
    text: Sequence[str] = ()
    pictures: Sequence[Picture] = ()
    tables: Sequence[Table] = field(default=())


def run_page(
    title: str,
    question: str,
    answer: Sequence[str],
    sections: Sequence[Section],
    *,
    command: str,
    version: str,
    warnings: Sequence[str] = (),
) -> str:
    """One self-contained page: question and answer first, then the evidence, last how to do it again.

    Parameters
    ----------
    title, question : str
    answer : sequence of str
        Sentences or lines, one each.
    sections : sequence of Section
    command : str
        The command line that made the page.
    version : str
        Of beal.
    warnings : sequence of str
        What else the reader must know; shown beside the answer.

    Returns
    -------
    str
        HTML that needs no other file.

    Examples
    --------
    >>> page = run_page("a run", "Stable?", ["Yes."], [], command="beal critical a.toml", version="1.0")
    >>> "<b>Stable?</b>" in page, "beal critical a.toml" in page
    (True, True)
    """
    page = Page(title, f"beal {escape(version)}")
    page.add('<div class="abstract">')
    page.text(f"<b>{escape(question)}</b>", *map(escape, answer))
    page.add("</div>")
    if warnings:
        items = "".join(f"<li>{escape(warning)}</li>" for warning in warnings)
        page.add(f'<div class="warning"><b>Take care</b><ul>{items}</ul></div>')
    number = 0
    for count, section in enumerate(sections, 1):
        page.section(f"part{count}", escape(section.title))
        page.text(*map(escape, section.text))
        for picture in section.pictures:
            number += 1
            image = f'<img src="{data_uri(picture.svg, "svg")}" alt="{escape(picture.title)}">'
            page.figure(f"fig{number}", image, f"Figure {number}. {escape(picture.title)}", escape(picture.caption))
        page.add(*(part.html() for part in section.tables))
    page.section("again", "Do it again")
    page.add(f"<pre>{escape(command)}</pre>")
    return page.html()
