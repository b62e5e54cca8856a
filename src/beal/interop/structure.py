"""What the cards of a Nastran deck say, one by one, before it is seen as a stick."""

from dataclasses import dataclass, field

from beal.interop.cards import Card, FieldError
from beal.interop.sections import Section

Vector = tuple[float, float, float]
Remark = tuple[str, str]  # where, and what
FEW, MANY = 20, 200  # problems that are told one by one; kinds of problems that are told
GROUND = 0  # the number of no grid


@dataclass(frozen=True)
class Material:
    """A MAT1: moduli of elasticity and of shear, and density."""

    elasticity: float
    shear: float
    density: float


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
    """Springs (or rigid ties, infinitely stiff) and dashpots between two grids or a grid and the ground.

    Parameters
    ----------
    card : Card
    ends : tuple of int
        Numbers of the grids, `GROUND` for the ground.
    stiffness, damping : dict of int to float
        By component 1 to 6.
    """

    card: Card
    ends: tuple[int, int]
    stiffness: dict[int, float]
    damping: dict[int, float] = field(default_factory=dict)


@dataclass
class Structure:
    """The cards of a deck, by number, and what could not be understood.

    Parameters
    ----------
    grids, bars, sections, materials : dict
        By number.
    masses, links : list
    held : dict of int to set of int
        Components of a grid that are held in place.
    constraints : dict of int to list of Card
        SPC and SPC1 cards by the number of their set.
    unions : dict of int to list of int
        SPCADD cards: sets of constraints that are united in one.
    frames : set of int
        Numbers of the coordinate systems whose axes are the basic ones.
    mass_factor : float
        PARAM,WTMASS.
    problems : list of (where, message)
        What cannot be used.
    notes, ignored : list of (where, message)
        What was assumed or has no influence; what was left out although it has.
    """

    grids: dict[int, Vector] = field(default_factory=dict)
    bars: dict[int, Bar] = field(default_factory=dict)
    sections: dict[int, Section] = field(default_factory=dict)
    materials: dict[int, Material] = field(default_factory=dict)
    masses: list[Mass] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    frames: set[int] = field(default_factory=set)
    held: dict[int, set[int]] = field(default_factory=dict)
    constraints: dict[int, list[Card]] = field(default_factory=dict)
    unions: dict[int, list[int]] = field(default_factory=dict)
    mass_factor: float = 1.0
    problems: list[Remark] = field(default_factory=list)
    notes: list[Remark] = field(default_factory=list)
    ignored: list[Remark] = field(default_factory=list)


def check_frame(found: Structure, card: Card, number: int) -> None:
    """Refuse a coordinate system, named in a field of a card, whose axes are not the basic ones."""
    if card.integer(number, 0) not in (0, *found.frames):
        raise FieldError(f"uses the coordinate system {card.text(number)}: give it in basic axes")


def grouped(remarks: list[Remark]) -> list[Remark]:
    """Remarks that say the same as one, with the first place.

    Examples
    --------
    >>> grouped([("line 3", "left out"), ("line 7", "left out"), ("", "units: m")])
    [('line 3 and 1 more', 'left out'), ('', 'units: m')]
    """
    places: dict[str, list[str]] = {}
    for where, message in remarks:
        places.setdefault(message, []).append(where)
    return [
        (f"{wheres[0]} and {len(wheres) - 1} more" if len(wheres) > 1 else wheres[0], message)
        for message, wheres in places.items()
    ]


def listed(remarks: list[Remark]) -> tuple[str, ...]:
    """Remarks as lines."""
    return tuple(f"{where}: {message}" if where else message for where, message in grouped(remarks))


def shown(problems: list[Remark]) -> list[Remark]:
    """All problems where they are few, else one of each kind."""
    if len(problems) <= FEW:
        return problems
    kinds = grouped(problems)
    return kinds[:MANY] + ([("", f"and {len(kinds) - MANY} more kinds of problems")] if len(kinds) > MANY else [])
