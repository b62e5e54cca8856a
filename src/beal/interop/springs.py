"""Nastran springs, dashpots and rigid ties: CBUSH with PBUSH, CELAS2, RBE2 and RBAR."""

import math

from beal.interop.cards import Card, FieldError
from beal.interop.constraints import components
from beal.interop.structure import GROUND, Link, Structure, check_frame

ALL = {1, 2, 3, 4, 5, 6}


def read_cbush(found: Structure, card: Card, properties: dict[int, Card]) -> None:
    """Springs and dashpots of a CBUSH; without its second grid they stand on the ground.

    Parameters
    ----------
    found : Structure
        To which it is added.
    card : Card
    properties : dict of int to Card
        PBUSH by number.
    """
    number = card.integer(2, card.integer(1))
    if number not in properties:
        raise FieldError(f"its property PBUSH {number} is missing")
    if any(card.text(n) for n in (5, 6, 7)):
        raise FieldError("has an orientation vector: give its coordinate system as 0, the basic axes")
    check_frame(found, card, 8)
    if not card.text(8):
        found.notes.append((card.where, "names no coordinate system, basic axes are taken"))
    if any(card.text(n) not in ("", "0") for n in (10, *range(12, 15))):
        raise FieldError("has an offset spring")
    stiffness, damping = _rows(found, properties[number])
    found.links.append(Link(card, (card.integer(3), card.integer(4, GROUND)), stiffness, damping))


def _rows(found: Structure, card: Card) -> tuple[dict[int, float], dict[int, float]]:
    """Rows K and B of a PBUSH; GE is damping that no dashpot makes."""
    rows: dict[str, dict[int, float]] = {}
    for start in range(2, len(card.fields) + 1, 8):
        kind = card.text(start).upper()
        values = {n: card.real(start + n) for n in range(1, 7) if card.text(start + n)}
        if kind in ("K", "B"):
            rows[kind] = values
        elif kind == "GE" and any(values.values()):
            found.ignored.append((card.where, "structural damping (GE) is left out"))
        elif any(values.values()) and kind != "GE":
            raise FieldError(f"its row {kind or 'without a name'} is not read, only K, B and GE")
    stiffness, damping = rows.get("K", {}), rows.get("B", {})
    if min((*stiffness.values(), *damping.values()), default=0.0) < 0:
        raise FieldError("stiffness and damping must not be negative")
    return stiffness, damping


def read_celas2(found: Structure, card: Card) -> None:
    """One spring between two grids, or between one and the ground."""
    ends = card.integer(3, GROUND), card.integer(5, GROUND)
    given = [card.text(where) for where, end in ((4, ends[0]), (6, ends[1])) if end != GROUND]
    if not given or given[0] not in tuple("123456") or given[0] != given[-1]:
        raise FieldError(f"must join the same component of two grids, found {' and '.join(map(repr, given)) or 'none'}")
    if card.real(2) < 0:
        raise FieldError("stiffness must not be negative")
    if card.real(7, 0.0):
        found.ignored.append((card.where, "structural damping (GE) is left out"))
    found.links.append(Link(card, ends, {int(given[0]): card.real(2)}))


def read_rbe2(found: Structure, card: Card) -> None:
    """Rigid ties of one grid to others, in the components named."""
    tied = [n for n in range(4, len(card.fields) + 1) if card.text(n) and "." not in card.text(n)]
    if not tied:
        raise FieldError("ties no grid")
    for number in tied:
        stiffness = dict.fromkeys(components(card.text(3)), math.inf)
        found.links.append(Link(card, (card.integer(2), card.integer(number)), stiffness))


def read_rbar(found: Structure, card: Card) -> None:
    """A rigid tie whose first grid gives all components to the second."""
    first, second, moved, others = (components(card.text(n)) for n in (4, 5, 7, 6))
    if first != ALL or second or others:
        raise FieldError("must have 123456 as the independent components of its first grid and none of its second")
    found.links.append(Link(card, (card.integer(2), card.integer(3)), dict.fromkeys(moved or ALL, math.inf)))
