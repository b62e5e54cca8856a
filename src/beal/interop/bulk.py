"""Nastran bulk data understood card by card, with every problem listed."""

import re
from collections.abc import Callable

from beal.interop.cards import Card, Deck, FieldError
from beal.interop.constraints import components, constrain, read_constraint, read_union
from beal.interop.sections import section
from beal.interop.springs import read_cbush, read_celas2, read_rbar, read_rbe2
from beal.interop.structure import Bar, Mass, Material, Structure, check_frame

SETTINGS = re.compile(  # of analyses, loads and plots: no part of a vehicle
    "PARAM|EIG(RL|R|B|C)|FREQ[1-5]?|TSTEP|TABDMP1|TABLED1|[DRT]LOAD[12]?|DAREA|FORCE|MOMENT|LOAD|GRAV|PLOAD1|SUPORT1?|SPOINT"
    "|SET[13]?|ASET1?|OMIT1?|ECHO(ON|OFF)|PLOTEL|CORD[123][RCS]"
)
COUPLING = re.compile("RBE[13]|RBAR1|RROD|RTRPLT|MPC(ADD)?|SPCD|GENEL|DMIG|C.*")
READ = "CBAR, CBEAM, CONM2, CBUSH, CELAS2, RBE2 and RBAR"
DEFAULTS = {"GRDSET": "GRID", "BAROR": "CBAR", "BEAMOR": "CBEAM"}


def understood(deck: Deck) -> Structure:
    """Each card of the deck read by its own rules.

    Parameters
    ----------
    deck : Deck

    Returns
    -------
    Structure
    """
    found = Structure(problems=list(deck.problems), ignored=list(deck.ignored))
    _fill(deck.cards)
    bushes: dict[int, Card] = {}
    seen: dict[tuple[str, int], Card] = {}
    left: dict[str, int] = {}
    defaults: dict[str, Card] = {}
    for card in sorted(deck.cards, key=lambda card: _FIRST.get(card.name, 2)):
        try:
            if card.name in _UNIQUE and _is_repeated(seen, card):
                continue
            if card.name == "PBUSH":
                bushes[card.integer(1)] = card
            elif card.name == "CBUSH":
                read_cbush(found, card, bushes)
            elif card.name in _READERS:
                _READERS[card.name](found, card)
            elif card.name == "PARAM" and card.text(1).upper() in _PARAMETERS:
                _PARAMETERS[card.text(1).upper()](found, card)
            elif SETTINGS.fullmatch(card.name):
                left[card.name] = left.get(card.name, 0) + 1
            elif card.name not in DEFAULTS:
                _refuse(found, card)
            elif defaults.setdefault(card.name, card) is not card:
                raise FieldError("may come once")
        except FieldError as error:
            found.problems.append((card.where, str(error)))
    constrain(found, deck.selected)
    if left:
        cards = ", ".join(f"{name} ({number})" for name, number in left.items())
        found.notes.append(("", f"no part of a vehicle, left out: {cards}"))
    if not deck.ended:
        found.notes.append(("", "the deck has no ENDDATA: nothing says that it is whole"))
    return found


def _fill(cards: list[Card]) -> None:
    """Blank fields take what a GRDSET, BAROR or BEAMOR card says, orientations as a whole."""
    defaults = {card.name: card for card in reversed(cards) if card.name in DEFAULTS}
    for default in defaults.values():
        groups = ((2,), (6,), (7,)) if default.name == "GRDSET" else ((2,), (5, 6, 7), (8,))
        for card in cards:
            if card.name == DEFAULTS[default.name]:
                card.fields += [""] * (8 - len(card.fields))
                for group in groups:
                    if not any(card.text(n) for n in group):
                        for n in group:
                            card.fields[n - 1] = default.text(n)


def _is_repeated(seen: dict[tuple[str, int], Card], card: Card) -> bool:
    """Whether a card says again what another has said; refused where it says something else, or is an element."""
    kind, number = _UNIQUE[card.name], card.integer(1)
    if number < 1:
        raise FieldError(f"field 2 must be positive, found {number}")
    before = seen.setdefault((kind, number), card)
    if before is not card and (kind == "element" or (before.name, before.fields) != (card.name, card.fields)):
        raise FieldError(f"has the number of another card ({before.place})")
    return before is not card


def _refuse(found: Structure, card: Card) -> None:
    """Unknown cards: what may add stiffness, mass or coupling cannot be left out."""
    if COUPLING.fullmatch(card.name):
        found.problems.append((card.where, f"is not read: a stick has {READ} only"))
    else:
        found.ignored.append((card.where, f"{card.name} is unknown, left out"))


def _mass_factor(found: Structure, card: Card) -> None:
    found.mass_factor = card.real(2)
    if found.mass_factor <= 0:
        raise FieldError(f"WTMASS must be positive, found {found.mass_factor:g}")
    found.notes.append(("", f"all masses are multiplied by {found.mass_factor:g} (PARAM,WTMASS)"))


def _structural_damping(found: Structure, card: Card) -> None:
    if card.real(2):
        found.ignored.append((card.where, "structural damping (G) is left out"))


def _cord2r(found: Structure, card: Card) -> None:
    """The basic system under another number; others are refused where they are used."""
    a, b, c = (tuple(card.real(first + n, 0.0) for n in range(3)) for first in (3, 6, 9))
    along = card.integer(2, 0) == 0 and not any(a) and b[:2] == (0.0, 0.0) and b[2] > 0
    if along and c[0] > 0 and c[1] == 0:
        found.frames.add(card.integer(1))


def _grid(found: Structure, card: Card) -> None:
    check_frame(found, card, 2)
    check_frame(found, card, 6)
    found.grids[card.integer(1)] = (card.real(3, 0.0), card.real(4, 0.0), card.real(5, 0.0))
    if card.text(7):
        found.held.setdefault(card.integer(1), set()).update(components(card.text(7)))


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
    found.sections[card.integer(1)] = read = section(card)
    if read.relieved:
        found.ignored.append((card.where, "relief of shear by taper (S1, S2) is left out"))


def _material(found: Structure, card: Card) -> None:
    """E, G and the ratio between them: the third follows from two, and one alone leaves the ratio 0."""
    ratio = card.real(4, 0.0)
    shear = card.real(3, card.real(2, 0.0) / (2 * (1 + ratio)) if ratio > -1 and card.text(4) else 0.0)
    stiffness = card.real(2, 2 * (1 + ratio) * shear)
    density = card.real(5, 0.0)
    if stiffness <= 0 or shear < 0 or density < 0:
        values = f"{stiffness:g}, {shear:g} and {density:g}"
        raise FieldError(f"E must be positive, G and rho not negative, found {values}")
    if card.real(8, 0.0):
        found.ignored.append((card.where, "structural damping (GE) is left out"))
    found.materials[card.integer(1)] = Material(stiffness, shear, density)


def _mass(found: Structure, card: Card) -> None:
    check_frame(found, card, 3)
    if any(card.real(n, 0.0) for n in (5, 6, 7)):
        raise FieldError("is offset from its grid: put a grid at its centre of mass and tie it to the bars there")
    mass, inertia = card.real(4, 0.0), (card.real(9, 0.0), card.real(11, 0.0), card.real(14, 0.0))
    if mass < 0 or min(inertia) < 0:
        raise FieldError("masses and moments of inertia must not be negative")
    if any(card.real(n, 0.0) for n in (10, 12, 13)):
        found.ignored.append((card.where, "products of inertia couple the planes, left out"))
    found.masses.append(Mass(card, card.integer(2), mass, inertia))


_FIRST = {"CORD2R": 0, "PBUSH": 1}  # before those who use them
_PARAMETERS = {"WTMASS": _mass_factor, "G": _structural_damping}
_READERS: dict[str, Callable[[Structure, Card], None]] = {
    "CORD2R": _cord2r,
    "GRID": _grid,
    "CBAR": _bar,
    "CBEAM": _bar,
    **dict.fromkeys(("PBAR", "PBARL", "PBEAM"), _section),
    "MAT1": _material,
    "CONM2": _mass,
    "CELAS2": read_celas2,
    "RBE2": read_rbe2,
    "RBAR": read_rbar,
    **dict.fromkeys(("SPC", "SPC1"), read_constraint),
    "SPCADD": read_union,
}
_UNIQUE = {
    **{name: name for name in ("GRID", "MAT1", "PBUSH", "SPCADD", "CORD2R")},
    **dict.fromkeys(("CBAR", "CBEAM", "CONM2", "CBUSH", "CELAS2", "RBE2", "RBAR"), "element"),
    **dict.fromkeys(("PBAR", "PBARL", "PBEAM"), "property"),
}
