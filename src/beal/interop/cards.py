"""Nastran bulk data as text: lines become cards, whatever format their fields are written in."""

import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from beal.errors import ModelError
from beal.vehicle.file import read_bytes

LARGEST_DECK = 5_000_000  # bytes, included files counted: ten thousand bars
DEEPEST, MOST_FILES = 10, 1000  # files included from files, and all of them
KEPT = "beal:"  # opens a comment that carries what bulk data cannot say

_BEGIN = re.compile(r"\s*BEGIN\s+BULK\b", re.IGNORECASE)
_SELECTED = re.compile(r"\s*SPC\s*=\s*([0-9]+)\s*$", re.IGNORECASE)
_PARAMETER = re.compile(r"\s*PARAM[,*\s]", re.IGNORECASE)
_INCLUDE = re.compile(r"\s*INCLUDE\b\s*(.*)", re.IGNORECASE)
_END = re.compile(r"\s*ENDDATA\b", re.IGNORECASE)
_NAME = re.compile(r"[A-Z][A-Z0-9]*")
_INTEGER = re.compile(r"[+-]?[0-9]{1,18}")
_REAL = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))(?:[ED]?([+-][0-9]+)|[ED]([0-9]+))?", re.IGNORECASE)


class FieldError(ValueError):
    """A field that does not hold what its card needs."""


@dataclass
class Card:
    """One bulk data card: its fields after the name, continuations joined.

    Parameters
    ----------
    name : str
    fields : list of str
        Stripped; eight to each line, or to each pair of lines in the large format.
    place : str
        File and line, for messages.
    comment : str or None
        The comment in the line before, None where there is none.
    """

    name: str
    fields: list[str]
    place: str
    comment: str | None = None

    @property
    def where(self) -> str:
        """What messages call it, such as ``line 12, CBAR 7``."""
        return f"{self.place}, {self.name} {self.text(1)}".rstrip()

    def text(self, number: int) -> str:
        """Field by its number after the name, from 1; empty where it is blank."""
        return self.fields[number - 1] if number <= len(self.fields) else ""

    def integer(self, number: int, default: int | None = None) -> int:
        """A whole number; a blank is the default, and refused where there is none."""
        text = self.text(number)
        if not text and default is not None:
            return default
        if not _INTEGER.fullmatch(text):
            raise FieldError(f"field {number + 1} must be a whole number, found {text[:20]!r}")
        return int(text)

    def real(self, number: int, default: float | None = None) -> float:
        """A number, in Nastran's ways of writing it; a blank is the default, and refused where there is none.

        Examples
        --------
        >>> [Card("", [text], "").real(1) for text in ("10.4+6", "1.D3", "-.5")]
        [10400000.0, 1000.0, -0.5]
        """
        text = self.text(number)
        if not text and default is not None:
            return default
        match = _REAL.fullmatch(text)
        value = float(f"{match[1]}e{match[2] or match[3] or 0}") if match else float("inf")
        if abs(value) == float("inf"):
            raise FieldError(f"field {number + 1} must be a number, found {text[:20]!r}")
        return value


@dataclass
class Deck:
    """What a deck holds, before anything is understood.

    Parameters
    ----------
    cards : list of Card
    kept : list of str
        Comments that begin with ``beal:``, without it.
    selected : int or None
        The constraint set that the case control section selects; 0 where it selects none, None where there is none.
    problems : list of (where, message)
        Lines that are no cards.
    ignored : list of (where, message)
        Continuations that are promised and do not come.
    ended : bool
        Whether it ends with ENDDATA.
    files, size : int
        Number of files read, and their bytes.
    """

    cards: list[Card] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)
    selected: int | None = None
    problems: list[tuple[str, str]] = field(default_factory=list)
    ignored: list[tuple[str, str]] = field(default_factory=list)
    ended: bool = False
    files: int = 0
    size: int = 0


@dataclass(frozen=True)
class _Line:
    place: str
    text: str
    comment: str | None


def read_deck(path: str | os.PathLike[str]) -> Deck:
    """Read the bulk data of a deck and of the files that it includes.

    Parameters
    ----------
    path : str or path-like
        A deck with or without executive and case control sections, which are skipped.

    Returns
    -------
    Deck

    Raises
    ------
    ModelError
        If the file, or one that it includes, cannot be read or is no text.
    """
    deck = Deck()
    lines, deck.ended = _unfolded(Path(path), "", [], deck)
    begin = next((n for n, line in enumerate(lines) if _BEGIN.match(line.text)), None)
    if begin is None:
        _gather(lines, deck)
        return deck
    if not deck.ended:
        deck.problems.append((lines[-1].place, "the deck ends without ENDDATA: it may be cut off"))
    selected = sorted({int(match[1]) for line in lines[:begin] if (match := _SELECTED.match(line.text))})
    if len(selected) > 1:
        sets = " and ".join(map(str, selected))
        deck.problems.append(("case control", f"selects SPC {sets}: keep the subcase of one support"))
    deck.selected = selected[0] if selected else 0
    _gather([line for line in lines[:begin] if _PARAMETER.match(line.text)] + lines[begin + 1 :], deck)
    return deck


def _unfolded(path: Path, prefix: str, above: list[Path], deck: Deck) -> tuple[list[_Line], bool]:
    """Lines of a file with those of included files in their places, and whether they end with ENDDATA."""
    deck.files += 1
    content = read_bytes(path, LARGEST_DECK, "Nastran bulk data")
    deck.size += len(content)
    if deck.size > LARGEST_DECK:
        raise ModelError(f"is larger than {LARGEST_DECK // 10**6} MB with what was read before it", str(path))
    if b"\0" in content:
        raise ModelError("holds null bytes: expected a text file of Nastran bulk data", str(path))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")  # decks are ASCII; what else there is stands in comments
    raw = iter(enumerate(text.expandtabs(8).split("\n"), 1))
    lines: list[_Line] = []
    comment = None
    for number, line in raw:
        place = f"{prefix}line {number}"
        if line.lstrip().startswith("$"):
            comment = line.strip()[1:].strip()
            if comment.startswith(KEPT):
                deck.kept.append(comment.removeprefix(KEPT).removeprefix(" "))
                comment = None
            continue
        text = line.split("$")[0].rstrip()
        if _END.match(text):
            return lines, True
        if match := _INCLUDE.match(text):
            name = match[1]
            while name[:1] in ("'", '"') and name.count(name[0]) < 2 and (more := next(raw, None)):
                name += more[1].strip()  # a long name goes on in the next line
            target = path.parent / name.strip().strip("'\"")
            if len(above) == DEEPEST or deck.files == MOST_FILES or target in (*above, path):
                raise ModelError(f"includes {target.name} again, or too many files in files", f"{path}: {place}")
            inner, ended = _unfolded(target, f"{target.name} ", [*above, path], deck)
            lines += inner
            if ended:
                return lines, True
        elif text.strip():
            lines.append(_Line(place, text, comment))
        comment = None
    return lines, False


def _gather(lines: list[_Line], deck: Deck) -> None:
    """Cards of the lines: each continuation is joined to the card that waits for it."""
    waiting: dict[str, Card] = {}
    last: Card | None = None
    expected = ""
    for line in lines:
        try:
            name, large, fields, label = _split(line.text)
        except FieldError as error:
            deck.problems.append((line.place, str(error)))
            last = None
            continue
        if not name or name[0] in "+*":
            parent = waiting.pop(name[1:].strip(), None) or (last if not (expected and name[1:].strip()) else None)
            if parent is None:
                deck.problems.append((line.place, f"continues no card: {line.text.strip()[:40]!r}"))
                continue
        elif not _NAME.fullmatch(name):
            deck.problems.append((line.place, f"is no card: {line.text.strip()[:40]!r}"))
            last = None
            continue
        else:
            parent = Card(name, [], line.place, line.comment)
            deck.cards.append(parent)
        if not large:
            parent.fields += [""] * (-len(parent.fields) % 8)
        parent.fields += fields
        last, expected = parent, label[1:].strip()
        if expected in waiting:
            deck.problems.append((line.place, f"names the continuation {expected}, as {waiting[expected].where} does"))
        if expected:
            waiting[expected] = parent
    deck.ignored += [(card.where, "names a continuation that does not come") for card in waiting.values()]


def _split(text: str) -> tuple[str, bool, list[str], str]:
    """(name, whether its fields are large, four or eight fields, label of the continuation) of a line.

    Examples
    --------
    >>> _split("GRID,7,,1.5")
    ('GRID', False, ['7', '', '1.5', '', '', '', '', ''], '')
    """
    if "," in text:
        name, *fields = (part.strip() for part in text.split(","))
        width = 4 if "*" in name else 8
        label = fields[width] if len(fields) > width else ""
        if any(fields[width + 1 :]) or label[:1] not in ("", "+", "*"):
            raise FieldError(f"has more than {width} fields in a line of the free format")
        fields = (fields + [""] * width)[:width]
    else:
        name = text[:8].strip()
        starts = range(8, 72, 16 if "*" in name else 8)
        fields = [text[start : start + starts.step].strip() for start in starts]
        label = text[72:80].strip()
    if any("=" in part for part in (name, *fields)):
        raise FieldError("replication (=) is not read: write the cards out")
    if name[:1] in ("+", "*"):
        return name, name[0] == "*", fields, label
    return name.removesuffix("*").strip().upper(), name.endswith("*"), fields, label
