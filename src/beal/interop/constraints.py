"""Nastran constraint cards: which components of which grids are held in place."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator

from beal.interop.cards import Card, FieldError
from beal.interop.structure import Structure

MOST_HELD = 1_000_000  # grids that the cards of a deck name, each as often as it is named


def components(text: str) -> set[int]:
    """Components 1 to 6 as a field lists them; 0 is none of them."""
    if not set(text) <= set("0123456"):
        raise FieldError(f"components must be digits from 1 to 6, found {text[:20]!r}")
    return {int(digit) for digit in text} - {0}


def read_constraint(found: Structure, card: Card) -> None:
    """Keep an SPC or SPC1 card until its set is known to be in use."""
    found.constraints.setdefault(card.integer(1), []).append(card)


def read_union(found: Structure, card: Card) -> None:
    """Sets of an SPCADD card."""
    found.unions[card.integer(1)] = [card.integer(n) for n in range(2, len(card.fields) + 1) if card.text(n)]


def constrain(found: Structure, selected: int | None) -> None:
    """Hold the grids that the set of constraints in use names.

    Parameters
    ----------
    found : Structure
        To which it is added.
    selected : int or None
        The set that the case control section selects, 0 for none; None where there is no such section: then the first
        set of the deck is in use.
    """
    if selected is None:
        selected = next(iter([*found.unions, *found.constraints]), 0)
    chosen = found.unions.get(selected, [selected] if selected else [])
    found.ignored += [
        (f"SPC {number}", "is in use, but the deck has no constraints of this number")
        for number in chosen
        if number not in found.constraints
    ]
    why = f"set {selected} is in use" if selected else "the case control section selects no SPC"
    grids, named = sorted(found.grids), 0
    for number, cards in found.constraints.items():
        for card in cards:
            if number not in chosen:
                found.ignored.append((card.where, f"these constraints are left out: {why}"))
                continue
            try:
                for grid, held in _held(card, grids):
                    _hold(found, card, grid, held)
                    named += 1
                    if named > MOST_HELD:
                        raise FieldError(f"holds, with the cards before, more than {MOST_HELD} grids")
            except FieldError as error:
                found.problems.append((card.where, str(error)))


def _hold(found: Structure, card: Card, grid: int, held: set[int]) -> None:
    if grid in found.grids:
        found.held.setdefault(grid, set()).update(held)
    else:
        found.ignored.append((card.where, "holds grids that are missing"))


def _held(card: Card, grids: list[int]) -> Iterator[tuple[int, set[int]]]:
    """(grid, components) of an SPC, or of an SPC1 with single grids and ranges."""
    if card.name == "SPC":
        for first in (2, 5):
            if card.text(first):
                if card.real(first + 2, 0.0):
                    raise FieldError("enforces a motion that is not zero")
                yield card.integer(first), components(card.text(first + 1))
        return
    held = components(card.text(2))
    place, last = 3, len(card.fields)
    while place <= last:
        if card.text(place + 1).upper() == "THRU":
            start, end = card.integer(place), card.integer(place + 2)
            if end < start:
                raise FieldError(f"must run from a number to a larger one, found {start} THRU {end}")
            yield from ((grid, held) for grid in grids[bisect_left(grids, start) : bisect_right(grids, end)])
            place += 3
        else:
            if card.text(place):
                yield card.integer(place), held
            place += 1
