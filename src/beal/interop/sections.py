"""Nastran property cards: area, second moments, mass and shear factors of a bar's cross-section."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from beal.interop.cards import Card, FieldError


@dataclass(frozen=True)
class Cut:
    """What a cross-section is at one place of a bar.

    Parameters
    ----------
    area, first, second, product : float
        A, I1, I2 and I12; I1 resists bending in plane 1, that of the bar's axis and its orientation vector.
    added_mass : float
        Non-structural mass per length.
    """

    area: float
    first: float
    second: float
    product: float = 0.0
    added_mass: float = 0.0


@dataclass(frozen=True)
class Section:
    """The cross-sections of a bar, linear between the cuts.

    Parameters
    ----------
    material : int
    cuts : dict of float to Cut
        By their place between the ends, 0 and 1, in this order.
    first_shear, second_shear : float
        K1 and K2; 0 is rigid in shear.
    relieved : bool
        Whether its taper carries part of the shear force (S1, S2).
    """

    material: int
    cuts: dict[float, Cut]
    first_shear: float = 0.0
    second_shear: float = 0.0
    relieved: bool = False


def section(card: Card) -> Section:
    """The cross-section of a PBAR, PBARL or PBEAM card.

    Raises
    ------
    FieldError
        If a field is wrong, or the section is of a kind that is not known.
    """
    try:
        return {"PBAR": _pbar, "PBARL": _pbarl, "PBEAM": _pbeam}[card.name](card)
    except OverflowError:
        raise FieldError("its sizes leave the range of numbers") from None


def _pbar(card: Card) -> Section:
    area, first, second, added, product = (card.real(n, 0.0) for n in (3, 4, 5, 7, 19))
    cut = Cut(area, first, second, product, added)
    return Section(card.integer(2), {0.0: cut, 1.0: cut}, card.real(17, 0.0), card.real(18, 0.0))


def _pbarl(card: Card) -> Section:
    kind = card.text(4).upper()
    if kind not in _SHAPES:
        raise FieldError(f"the section {kind or 'without a name'} is not read, only {', '.join(_SHAPES)}")
    count, shape = _SHAPES[kind]
    sizes = [card.real(9 + n) for n in range(count)]
    if min(sizes) < 0:
        raise FieldError(f"sizes of a section must not be negative, found {min(sizes):g}")
    cut = Cut(*shape(*sizes), added_mass=card.real(9 + count, 0.0))
    return Section(card.integer(2), {0.0: cut, 1.0: cut})


def _ring(outer: float, inner: float) -> tuple[float, float, float]:
    inertia = math.pi * (outer**4 - inner**4) / 4
    return math.pi * (outer**2 - inner**2), inertia, inertia


def _bar(width: float, height: float) -> tuple[float, float, float]:
    return width * height, width * height**3 / 12, height * width**3 / 12


def _box(width: float, height: float, flange: float, web: float) -> tuple[float, float, float]:
    outer, inner = _bar(width, height), _bar(width - 2 * web, height - 2 * flange)
    return outer[0] - inner[0], outer[1] - inner[1], outer[2] - inner[2]


_SHAPES: dict[str, tuple[int, Callable[..., tuple[float, float, float]]]] = {
    "ROD": (1, lambda radius: _ring(radius, 0.0)),
    "TUBE": (2, _ring),
    "TUBE2": (2, lambda outer, wall: _ring(outer, outer - wall)),
    "BAR": (2, _bar),
    "BOX": (4, _box),
}


def _pbeam(card: Card) -> Section:
    """A PBEAM with its stations: blank fields repeat end A at end B, and lie between the ends elsewhere."""
    here = [card.real(n, 0.0) for n in _PROFILE]
    row = 17 if card.text(9).upper() not in _STATION else 9  # recovery points are left out sometimes
    rows: dict[float, int] = {}
    while (kind := card.text(row).upper()) in _STATION:
        at = card.real(row + 1)
        if not 0 < at <= 1 or at in rows:
            raise FieldError(f"its stations must lie between its ends, each once, found x/l = {at:g}")
        rows[at] = row
        row += 16 if kind == "YES" else 8  # which has recovery points of its own
    there = _values(card, rows[1.0], here) if 1.0 in rows else here
    cuts = {0.0: Cut(*here)}
    for at in sorted(rows):
        cuts[at] = Cut(*_values(card, rows[at], [a + at * (b - a) for a, b in zip(here, there, strict=True)]))
    cuts[1.0] = Cut(*there)
    if any(card.real(row + n, 0.0) for n in range(8, 16)):
        raise FieldError("its axis of mass or neutral axis is off the line of the grids")
    relief = any(card.real(row + n, 0.0) for n in (2, 3))
    return Section(card.integer(2), cuts, card.real(row, 1.0), card.real(row + 1, 1.0), relief)


def _values(card: Card, row: int, blank: list[float]) -> list[float]:
    """A, I1, I2, I12 and the mass of a station, with what blank fields stand for."""
    return [card.real(row + n - 1, value) for n, value in zip(_PROFILE, blank, strict=True)]


_PROFILE = (3, 4, 5, 6, 8)  # A, I1, I2, I12 and the mass; between the last two is the torsional J
_STATION = ("YES", "YESA", "NO")
