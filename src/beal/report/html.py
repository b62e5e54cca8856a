"""A page as a list of blocks: plain strings, escaped where they come from data."""

import base64
from collections.abc import Sequence
from html import escape
from typing import Any

from beal.report.theme import CSS

MIME = {"svg": "image/svg+xml", "png": "image/png"}


def data_uri(content: bytes, kind: str) -> str:
    """A file's content as an address that needs no file.

    Parameters
    ----------
    content : bytes
    kind : {"svg", "png"}

    Returns
    -------
    str

    Examples
    --------
    >>> data_uri(b"<svg/>", "svg")
    'data:image/svg+xml;base64,PHN2Zy8+'
    """
    return f"data:{MIME[kind]};base64,{base64.b64encode(content).decode('ascii')}"


def table(
    header: Sequence[str],
    rows: Sequence[Sequence[Any]],
    caption: str = "",
    numeric: Sequence[int] = (),
) -> str:
    """A table whose cells are HTML where they are `Markup` and are escaped otherwise.

    Parameters
    ----------
    header : sequence of str
        HTML.
    rows : sequence of sequences
    caption : str
        HTML.
    numeric : sequence of int
        Columns that are set flush right.

    Returns
    -------
    str

    Examples
    --------
    >>> table(["a"], [["<"]])
    '<div class="wide"><table><thead><tr><th>a</th></tr></thead><tbody><tr><td>&lt;</td></tr></tbody></table></div>'
    """

    def cells(tag: str, row: Sequence[Any]) -> str:
        parts = []
        for index, value in enumerate(row):
            extra = value.attributes if isinstance(value, Markup) else ""
            extra += ' class="n"' if index in numeric and not extra else ""
            content = str(value) if isinstance(value, Markup) or tag == "th" else escape(str(value))
            parts.append(f"<{tag}{extra}>{content}</{tag}>")
        return f"<tr>{''.join(parts)}</tr>"

    head = f"<caption>{caption}</caption>" if caption else ""
    body = "".join(cells("td", row) for row in rows)
    return f'<div class="wide"><table>{head}<thead>{cells("th", header)}</thead><tbody>{body}</tbody></table></div>'


class Markup(str):
    """HTML that is not escaped again, with attributes for the cell that holds it."""

    attributes = ""

    def of_class(self, name: str) -> "Markup":
        """The same in a cell of a class."""
        marked = Markup(self)
        marked.attributes = f' class="{name}"'
        return marked


class Page:
    """A report that is put together from top to bottom.

    Parameters
    ----------
    title : str
    byline : str
        HTML.
    """

    def __init__(self, title: str, byline: str) -> None:
        self._title = title
        self._blocks = [f"<h1>{escape(title)}</h1>", f'<p class="byline">{byline}</p>']

    def add(self, *blocks: str) -> None:
        """Append blocks of HTML as they are."""
        self._blocks += blocks

    def text(self, *paragraphs: str) -> None:
        """Append paragraphs of HTML."""
        self.add(*(f"<p>{paragraph}</p>" for paragraph in paragraphs))

    def section(self, anchor: str, title: str, level: int = 2) -> None:
        """Begin a section."""
        self.add(f'<h{level} id="{anchor}">{title}</h{level}>')

    def equation(self, *lines: str) -> None:
        """Append displayed equations of HTML."""
        self.add(*(f'<div class="eq">{line}</div>' for line in lines))

    def figure(self, anchor: str, picture: str, title: str, caption: str) -> None:
        """Append a figure, an ``svg`` or ``img`` element, with a title and a caption of HTML."""
        described = f"<figcaption><b>{title}.</b> {caption}</figcaption>"
        self.add(f'<figure id="{anchor}"><div class="wide">{picture}</div>{described}</figure>')

    def html(self) -> str:
        """The whole document."""
        return (
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(self._title)}</title>\n<style>{CSS}</style>\n</head>\n<body>\n<main>\n"
            + "\n".join(self._blocks)
            + "\n</main>\n</body>\n</html>\n"
        )
