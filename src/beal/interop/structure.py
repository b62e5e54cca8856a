"""Nastran cards understood one by one: grids, bars, properties, masses, springs, rigid links and constraints."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from beal.interop.cards import Card, Deck, FieldError
from beal.interop.sections import Section, section

Vector = tuple[float, float, float]

SETTINGS = re.compile(  # of analyses, loads and plots: no part of a vehicle
    "PARAM|EIG(RL|R|B|C)|FREQ[1-5]?|TSTEP|TABDMP1|TABLED1|[DRT]LOAD[12]?|DAREA|FORCE|MOMENT|LOAD|GRAV|PLOAD1|SUPORT1?|SPOINT"
    "|SET[13]?|ASET1?|OMIT1?|ECHO(ON|OFF)|PLOTEL"
)
COUPLING = re.compile("RBE[13]|RBAR1?|RROD|RTRPLT|MPC(ADD)?|SPC(ADD|D)|GENEL|DMIG|GRDSET|BAROR|BEAMOR|C.*")
MOST_GRIDS = 1_000_000


@dataclass(frozen=True)
class Bar:
    """A CBAR or CBEAM: property, both ends, and the orientation as a vector or a third grid."""

    card: Card
    section: int
    ends: tuple[int, int]
    orientation: Vector | int


@dataclass(frozen=True)
class Mass:
    """A CONM2: mass, and the inertia about each basic axis."""

    card: Card
    grid: int
    mass: float
    inertia: Vector


@dataclass(frozen=True)
class Link:
    """Springs (or rigid ties, infinitely stiff) between two grids, by component 1 to 6."""

    card: Card
    ends: tuple[int, int]
    stiffness: dict[int, float]


@dataclass
class Structure:
    """The cards of a deck, by number, and what could not be understood.

    Parameters
    ----------
    grids, bars, sections, materials : dict
        By number; of a material E and rho.
    masses, links : list
    held : dict of int to set of int
        Components of a grid that are held in place.
    frames : set of str
        Numbers of the coordinate systems whose axes are the basic ones.
    constraint_set : int or None
        The one in use, 0 for none, None until a constraint is seen.
    mass_factor : float
        PARAM,WTMASS.
    problems : list of (where, message)
        What cannot be used.
    notes, ignored : list of str
        What was assumed or has no influence; what was left out although it has.
    """

    grids: dict[int, Vector] = field(default_factory=dict)
    bars: dict[int, Bar] = field(default_factory=dict)
    sections: dict[int, Section] = field(default_factory=dict)
    materials: dict[int, tuple[float, float]] = field(default_factory=dict)
    masses: list[Mass] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    frames: set[str] = field(default_factory=set)
    held: dict[int, set[int]] = field(default_factory=dict)
    constraint_set: int | None = None
    mass_factor: float = 1.0
    problems: list[tuple[str, str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    ignored: list[str] = field(default_factory=list)


def understood(deck: Deck) -> Structure:
    """Each card of the deck read by its own rules, with every problem listed.

    Parameters
    ----------
    deck : Deck

    Returns
    -------
    Structure
    """
    found = Structure(problems=list(deck.problems), constraint_set=deck.selected)
    seen: dict[tuple[str, str], Card] = {}
    left: dict[str, int] = {}
    bushes = {card.text(1): card for card in deck.cards if card.name == "PBUSH"}
    for card in sorted(deck.cards, key=lambda card: card.name != "CORD2R"):  # frames before those who use them
        kind = _UNIQUE.get(card.name, "")
        before = seen.setdefault((kind, card.text(1)), card) if kind else card
        try:
            if before is not card:
                if before.fields != card.fields:
                    found.problems.append((card.where, f"has the number of another card ({before.place})"))
            elif card.name in _READERS:
                _READERS[card.name](found, card)
            elif card.name == "CBUSH":
                found.links.append(_cbush(found, card, bushes))
            elif card.name in ("SPC", "SPC1"):
                _constrain(found, card)
            elif SETTINGS.fullmatch(card.name):
                left[card.name] = left.get(card.name, 0) + 1
                _setting(found, card)
            elif card.name != "PBUSH":
                _refuse(found, card)
        except FieldError as error:
            found.problems.append((card.where, str(error)))
    if left:
        cards = ", ".join(f"{name} ({number})" for name, number in left.items())
        found.notes.append(f"no part of a vehicle, left out: {cards}")
    return found


def _refuse(found: Structure, card: Card) -> None:
    """Unknown cards: what may add stiffness, mass or coupling cannot be left out."""
    if card.name.startswith("CORD"):
        found.problems.append((card.where, "only CORD2R along the basic axes is read: give the grids in basic axes"))
    elif COUPLING.fullmatch(card.name):
        found.problems.append((card.where, "is not read: a stick has CBAR, CBEAM, CONM2, CBUSH, CELAS2 and RBE2 only"))
    else:
        found.ignored.append(f"{card.where}: unknown, left out")


def _setting(found: Structure, card: Card) -> None:
    if card.name == "PARAM" and card.text(1).upper() == "WTMASS":
        found.mass_factor = card.real(2)
        if found.mass_factor <= 0:
            raise FieldError(f"WTMASS must be positive, found {found.mass_factor:g}")


def _frame(found: Structure, card: Card, number: int) -> None:
    """Refuse a coordinate system whose axes are not the basic ones."""
    if card.text(number) not in ("", "0", *found.frames):
        raise FieldError(f"uses the coordinate system {card.text(number)}: give it in basic axes")


def _is_basic(card: Card) -> bool:
    """Whether a CORD2R is the basic system under another number."""
    a, b, c = (tuple(card.real(first + n, 0.0) for n in range(3)) for first in (3, 6, 9))
    along = card.text(2) in ("", "0") and not any(a) and b[:2] == (0.0, 0.0) and b[2] > 0
    return along and c[0] > 0 and c[1] == 0


def _cord2r(found: Structure, card: Card) -> None:
    if not _is_basic(card):
        raise FieldError("turns or moves the axes: give the grids in basic axes")
    found.frames.add(card.text(1))


def _grid(found: Structure, card: Card) -> None:
    _frame(found, card, 2)
    _frame(found, card, 6)
    found.grids[card.integer(1)] = (card.real(3, 0.0), card.real(4, 0.0), card.real(5, 0.0))
    found.held.setdefault(card.integer(1), set()).update(_components(card.text(7)))


def _components(text: str) -> set[int]:
    if not set(text) <= set("0123456"):
        raise FieldError(f"components must be digits from 1 to 6, found {text!r}")
    return {int(digit) for digit in text} - {0}


def _bar(found: Structure, card: Card) -> None:
    if card.text(8) not in ("", "GGG"):
        raise FieldError(f"gives its orientation or offsets in other axes ({card.text(8)}): give them in basic axes")
    if pins := [card.text(n) for n in (9, 10) if card.text(n) not in ("", "0")]:
        raise FieldError(f"has pin flags ({', '.join(pins)}): write two grids and a CBUSH between them")
    if any(card.real(n, 0.0) for n in range(11, 17)):
        raise FieldError("has offsets: a stick's bars lie on the line of its grids")
    vector = bool(card.text(6) or card.text(7)) or not card.text(5).lstrip("+-").isdigit()
    orientation = (card.real(5, 0.0), card.real(6, 0.0), card.real(7, 0.0)) if vector else card.integer(5)
    number = card.integer(1)
    found.bars[number] = Bar(card, card.integer(2, number), (card.integer(3), card.integer(4)), orientation)


def _section(found: Structure, card: Card) -> None:
    found.sections[card.integer(1)] = section(card)


def _material(found: Structure, card: Card) -> None:
    shear, ratio = card.real(3, 0.0), card.real(4, 0.0)
    stiffness = card.real(2, 2 * (1 + ratio) * shear)
    density = card.real(5, 0.0)
    if stiffness <= 0 or density < 0:
        raise FieldError(f"E must be positive and rho not negative, found {stiffness:g} and {density:g}")
    found.materials[card.integer(1)] = (stiffness, density)


def _mass(found: Structure, card: Card) -> None:
    _frame(found, card, 3)
    if any(card.real(n, 0.0) for n in (5, 6, 7)):
        raise FieldError("is offset from its grid: put a grid at its centre of mass and tie it to the bars there")
    mass, inertia = card.real(4), (card.real(9, 0.0), card.real(11, 0.0), card.real(14, 0.0))
    if mass < 0 or min(inertia) < 0:
        raise FieldError("masses and moments of inertia must not be negative")
    if any(card.real(n, 0.0) for n in (10, 12, 13)):
        found.ignored.append(f"{card.where}: products of inertia couple the planes, left out")
    found.masses.append(Mass(card, card.integer(2), mass, inertia))


def _cbush(found: Structure, card: Card, properties: dict[str, Card]) -> Link:
    number = card.text(2) or card.text(1)
    if number not in properties:
        raise FieldError(f"its property PBUSH {number} is missing")
    if any(card.text(n) for n in (5, 6, 7)):
        raise FieldError("has an orientation vector: give its coordinate system as 0, the basic axes")
    _frame(found, card, 8)
    if not card.text(8):
        found.notes.append(f"{card.where}: names no coordinate system, basic axes are taken")
    if any(card.text(n) not in ("", "0") for n in (10, *range(12, 15))):
        raise FieldError("has an offset spring")
    return Link(card, (card.integer(3), card.integer(4)), _stiffness(found, properties[number]))


def _stiffness(found: Structure, card: Card) -> dict[int, float]:
    """Row K of a PBUSH; rows B and GE are damping."""
    stiffness: dict[int, float] = {}
    for start in range(2, len(card.fields) + 1, 8):
        values = {n: start + n for n in range(1, 7) if card.text(start + n)}
        match card.text(start).upper():
            case "K":
                stiffness = {n: card.real(where) for n, where in values.items()}
            case "B" | "GE" if any(card.real(where) for where in values.values()):
                found.ignored.append(f"{card.where}: damping ({card.text(start).upper()}) is left out")
            case "M" if any(card.real(where) for where in values.values()):
                raise FieldError("has a mass")
    if any(value < 0 for value in stiffness.values()):
        raise FieldError("stiffness must not be negative")
    return stiffness


def _celas2(found: Structure, card: Card) -> None:
    ends = card.integer(3, 0), card.integer(5, 0)
    components = card.text(4), card.text(6)
    if 0 in ends:
        raise FieldError("ties a grid to the ground: only the ends can be held, by SPC1")
    if components[0] != components[1] or components[0] not in "123456" or len(components[0]) != 1:
        raise FieldError(f"must join the same component of two grids, found {components[0]!r} and {components[1]!r}")
    if card.real(2) < 0:
        raise FieldError("stiffness must not be negative")
    if card.real(7, 0.0):
        found.ignored.append(f"{card.where}: damping (GE) is left out")
    found.links.append(Link(card, ends, {int(components[0]): card.real(2)}))


def _rbe2(found: Structure, card: Card) -> None:
    tied = [n for n in range(4, len(card.fields) + 1) if card.text(n) and "." not in card.text(n)]
    if not tied:
        raise FieldError("ties no grid")
    for number in tied:
        stiffness = dict.fromkeys(_components(card.text(3)), float("inf"))
        found.links.append(Link(card, (card.integer(2), card.integer(number)), stiffness))


def _constrain(found: Structure, card: Card) -> None:
    number = card.integer(1)
    if found.constraint_set is None:
        found.constraint_set = number
    if found.constraint_set == 0:
        found.ignored.append(f"{card.where}: the case control section selects no SPC, left out")
    elif number == found.constraint_set:
        for grid, components in _constraints(card):
            found.held.setdefault(grid, set()).update(components)
    else:
        found.ignored.append(
            f"{card.where}: set {found.constraint_set} of the constraints is in use, this one left out"
        )


def _constraints(card: Card) -> Iterator[tuple[int, set[int]]]:
    if card.name == "SPC":
        for first in (2, 5):
            if card.text(first):
                if card.real(first + 2, 0.0):
                    raise FieldError("enforces a motion that is not zero")
                yield card.integer(first), _components(card.text(first + 1))
        return
    held = _components(card.text(2))
    if card.text(4).upper() == "THRU":
        first, last = card.integer(3), card.integer(5)
        if not 0 <= last - first <= MOST_GRIDS:
            raise FieldError(f"must run from a number to a larger one, found {first} THRU {last}")
        yield from ((grid, held) for grid in range(first, last + 1))
    else:
        yield from ((card.integer(n), held) for n in range(3, len(card.fields) + 1) if card.text(n))


_READERS: dict[str, Callable[[Structure, Card], None]] = {
    "CORD2R": _cord2r,
    "GRID": _grid,
    "CBAR": _bar,
    "CBEAM": _bar,
    "PBAR": _section,
    "PBARL": _section,
    "PBEAM": _section,
    "MAT1": _material,
    "CONM2": _mass,
    "CELAS2": _celas2,
    "RBE2": _rbe2,
}
_ELEMENTS = ("CBAR", "CBEAM", "CONM2", "CBUSH", "CELAS2", "RBE2")
_PROPERTIES = ("PBAR", "PBARL", "PBEAM")
_UNIQUE = {
    "GRID": "grid",
    "MAT1": "material",
    "PBUSH": "PBUSH",
    **dict.fromkeys(_ELEMENTS, "element"),
    **dict.fromkeys(_PROPERTIES, "property"),
}
