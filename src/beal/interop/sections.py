"""Nastran property cards: area, second moments, mass and shear factors of a bar's cross-section."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from beal.interop.cards import Card, FieldError


@dataclass(frozen=True)
class Section:
    """A uniform cross-section.

    Parameters
    ----------
    material : int
    area, first, second, product : float
        A, I1, I2 and I12; I1 resists bending in plane 1, that of the bar's axis and its orientation vector.
    added_mass : float
        Non-structural mass per length.
    first_shear, second_shear : float
        K1 and K2; 0 is rigid in shear.
    """

    material: int
    area: float
    first: float
    second: float
    product: float = 0.0
    added_mass: float = 0.0
    first_shear: float = 0.0
    second_shear: float = 0.0


def section(card: Card) -> Section:
    """The cross-section of a PBAR, PBARL or PBEAM card.

    Raises
    ------
    FieldError
        If a field is wrong, or the section is tapered or of a kind that is not known.
    """
    try:
        return {"PBAR": _pbar, "PBARL": _pbarl, "PBEAM": _pbeam}[card.name](card)
    except OverflowError:
        raise FieldError("its sizes leave the range of numbers") from None


def _pbar(card: Card) -> Section:
    area, first, second = (card.real(n, 0.0) for n in (3, 4, 5))
    return Section(
        card.integer(2),
        area,
        first,
        second,
        card.real(19, 0.0),
        card.real(7, 0.0),
        card.real(17, 0.0),
        card.real(18, 0.0),
    )


def _pbarl(card: Card) -> Section:
    kind = card.text(4).upper()
    if kind not in _SHAPES:
        raise FieldError(f"the section {kind or 'without a name'} is not read, only {', '.join(_SHAPES)}")
    count, shape = _SHAPES[kind]
    sizes = [card.real(9 + n) for n in range(count)]
    if min(sizes) < 0:
        raise FieldError(f"sizes of a section must not be negative, found {min(sizes):g}")
    area, first, second = shape(*sizes)
    return Section(card.integer(2), area, first, second, added_mass=card.real(9 + count, 0.0))


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
    """End A of a PBEAM; other stations must repeat it, as a stage's bars are uniform."""
    values = [card.real(n, 0.0) for n in range(3, 9)]  # A, I1, I2, I12, J, NSM
    row = 17 if card.text(9).upper() not in ("YES", "YESA", "NO") else 9  # recovery points are left out sometimes
    while card.text(row).upper() in ("YES", "YESA", "NO"):
        there = [card.real(row + 1 + n, value) for n, value in enumerate(values, 1)]
        if there != values:
            raise FieldError(
                f"is tapered (another section at x/l = {card.text(row + 1)}): divide it into bars of uniform sections"
            )
        row += 8 if card.text(row).upper() == "NO" else 16
    for offset, what in ((6, "mass moment of inertia"), (7, "mass moment of inertia")):
        if card.real(row + offset, 0.0):
            raise FieldError(f"its non-structural {what} per length has no place in a stage")
    if any(card.real(row + n, 0.0) for n in range(8, 16)):
        raise FieldError("its axis of mass or neutral axis is off the line of the grids")
    area, first, second, product, _, added = values
    return Section(card.integer(2), area, first, second, product, added, card.real(row, 1.0), card.real(row + 1, 1.0))
