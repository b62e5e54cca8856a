"""A drawing made of characters: eight dots of braille to a character, or plain ASCII."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.text import Text

BRAILLE = 0x2800
DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # bits of a character, from the top, left and right


class Canvas:
    """Characters in rows, with points at coordinates from 0 to 1 towards the right and up.

    Parameters
    ----------
    width, height : int
        In characters.
    fine : bool
        Whether a character holds two by four dots of braille; else a line is made of the letter that it is given.

    Examples
    --------
    >>> canvas = Canvas(4, 2, fine=True)
    >>> canvas.line([0.0, 1.0], [0.0, 1.0])
    >>> print(*canvas.rows(), sep="\\n")
      ⡠⠊
    ⡠⠊
    """

    def __init__(self, width: int, height: int, fine: bool) -> None:
        self._columns, self._lines = (2 * width, 4 * height) if fine else (width, height)
        self._size = width, height
        self._fine = fine
        self._dots: dict[tuple[int, int], int] = {}
        self._letters: dict[tuple[int, int], str] = {}
        self._styles: dict[tuple[int, int], str] = {}

    def line(self, x: Sequence[float], y: Sequence[float], letter: str = "*", style: str = "", gaps: int = 1) -> None:
        """Join points by straight lines, drawn in one of ``gaps`` columns."""
        points = [self._dot(*point) for point in zip(x, y, strict=True)]
        for (left, low), (right, high) in zip(points, points[1:], strict=False):
            steps = max(abs(right - left), abs(high - low), 1)
            for step in range(steps + 1):
                column = round(left + (right - left) * step / steps)
                if column % gaps == 0:
                    self._set(column, round(low + (high - low) * step / steps), letter, style)

    def put(self, x: float, y: float, letter: str, style: str = "", over: bool = True) -> None:
        """A letter at a point, over what is drawn there or only where nothing is."""
        cell = self.cell(x, y)
        if over or (cell not in self._letters and cell not in self._dots):
            self._letters[cell], self._styles[cell] = letter, style

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Column and row of the character at a point, counted from the upper left."""
        return self._cell(*self._dot(x, y))

    def rows(self) -> "list[Text]":
        """The rows from the top."""
        from rich.text import Text

        width, height = self._size
        rows = []
        for row in range(height):
            text = Text()
            for cell in ((column, row) for column in range(width)):
                drawn = chr(BRAILLE | self._dots[cell]) if cell in self._dots else " "
                text.append(self._letters.get(cell, drawn), self._styles.get(cell))
            text.rstrip()
            rows.append(text)
        return rows

    def _dot(self, x: float, y: float) -> tuple[int, int]:
        """Column and line of a point, counted from the lower left."""
        return round(x * (self._columns - 1)), round(y * (self._lines - 1))

    def _cell(self, column: int, line: int) -> tuple[int, int]:
        return (column // 2, (self._lines - 1 - line) // 4) if self._fine else (column, self._lines - 1 - line)

    def _set(self, column: int, line: int, letter: str, style: str) -> None:
        cell = self._cell(column, line)
        if self._fine:
            self._dots[cell] = self._dots.get(cell, 0) | DOTS[(self._lines - 1 - line) % 4][column % 2]
        else:
            self._letters[cell] = letter
        self._styles[cell] = style
