"""Where the mass of a stick sits: along its bars, on its grids, or on grids but meant along the bars."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

from beal.interop.structure import Remark

Lump = dict[str, Any]
NEARLY_NOTHING = 1e-9  # share of the whole mass that bars without mass are given, taken from their grids
UNIFORM = 1e-3  # relative difference to which lumps count as those of a uniform bar


@dataclass(frozen=True)
class Piece:
    """One bar of a stick, from station to station.

    Parameters
    ----------
    where : str
        What messages call it.
    x : tuple of float
        Stations from the nose, from end to end; what follows is linear in between.
    mass, stiffness, shear : tuple of float
        Mass per length, stiffness in bending, and in shear, infinite where it is rigid in shear.
    fore, aft : int
        Grids at the ends.
    group : int
        Number of the comments above it in the deck.
    name : str
        The comment in the line above.
    alone : bool
        Whether it is to stay a stage of its own.
    """

    where: str
    x: tuple[float, ...]
    mass: tuple[float, ...]
    stiffness: tuple[float, ...]
    shear: tuple[float, ...]
    fore: int
    aft: int
    group: int
    name: str
    alone: bool = False

    @property
    def start(self) -> float:
        """Station of the forward end."""
        return self.x[0]

    @property
    def end(self) -> float:
        """Station of the aft end."""
        return self.x[-1]

    @property
    def length(self) -> float:
        """From end to end."""
        return self.end - self.start

    @property
    def whole_mass(self) -> float:
        """Mass per length, integrated."""
        stations = zip(self.x, self.x[1:], self.mass, self.mass[1:], strict=False)
        return sum((b - a) * (m + n) / 2 for a, b, m, n in stations)

    @property
    def tapered(self) -> bool:
        """Whether anything varies along it."""
        return any(len(set(values)) > 1 for values in (self.mass, self.stiffness, self.shear))

    def weighing(self, mass: float, alone: bool = False) -> "Piece":
        """The piece with another mass per length."""
        return replace(self, mass=(mass,) * len(self.x), alone=alone)

    def continues(self, before: "Piece") -> bool:
        """Whether it and the piece before are one stage: equal and uniform, or linear in places."""
        if self.group != before.group or self.alone or before.alone or any(self.mass) != any(before.mass):
            return False
        if math.isinf(self.shear[0]) != math.isinf(before.shear[0]):
            return False
        here, there = ((piece.mass[0], piece.stiffness[0], piece.shear[0]) for piece in (self, before))
        return here == there or self.tapered or before.tapered


def weighted(
    pieces: list[Piece], masses: list[Lump], spread: bool, problems: list[Remark], notes: list[Remark]
) -> tuple[list[Piece], list[Lump]]:
    """Pieces that all have mass, and the point masses that remain.

    A vehicle's stages have mass. Where a deck has it all on its grids, either it stays there and the bars get next to
    nothing, or it is spread along the bars.

    Parameters
    ----------
    pieces : list of Piece
    masses : list of dict
        As [[point_mass]] has them.
    spread : bool
        Whether the lumps on bars without mass are spread along them.
    problems, notes : list
        To add to.

    Returns
    -------
    pieces, masses : list
    """
    bare = [piece for piece in pieces if not any(piece.mass)]
    if not bare:
        if spread:
            problems.append(("lumps", "there is nothing to spread: every bar has mass"))
        return pieces, masses
    if not any(mass["mass"] for mass in masses):
        problems.append(("deck", f"{bare[0].where} and {len(bare) - 1} more bars have no mass, nor have their grids"))
        return pieces, masses
    return _spread(pieces, masses, problems, notes) if spread else _kept(pieces, masses, notes)


def _kept(pieces: list[Piece], masses: list[Lump], notes: list[Remark]) -> tuple[list[Piece], list[Lump]]:
    """Between two lumps a bar without mass bends as a cubic: each stays a stage, so that this is met exactly."""
    whole = sum(mass["mass"] for mass in masses)
    nothing = NEARLY_NOTHING * whole / pieces[-1].end
    added = nothing * sum(piece.length for piece in pieces if not any(piece.mass))
    rest = [{**mass, "mass": mass["mass"] * (1 - added / whole)} for mass in masses]
    message = (
        f"bars without mass carry {NEARLY_NOTHING:g} of the mass on the grids, which keep the rest (lumps = keep); to"
        " have it along the bars, give lumps = spread"
    )
    notes.append(("", message))
    return [p if any(p.mass) else p.weighing(nothing, alone=True) for p in pieces], rest


def _spread(
    pieces: list[Piece], masses: list[Lump], problems: list[Remark], notes: list[Remark]
) -> tuple[list[Piece], list[Lump]]:
    """Uniform runs of bars take the mass of the lumps that such a run leaves on its grids."""
    lumps: dict[float, float] = {}
    for mass in masses:
        lumps[mass["station"]] = lumps.get(mass["station"], 0.0) + mass["mass"]
    found: list[Piece] = []
    for run in _runs(pieces):
        inner = [lumps.get(b.start, 0.0) / ((b.end - a.start) / 2) for a, b in zip(run, run[1:], strict=False)]
        if not any(run[0].mass) and not inner:
            problems.append((run[0].where, "is the only bar of its kind: no grid inside tells its mass per length"))
        found += [p.weighing(median(inner)) if not any(p.mass) and inner else p for p in run]
    share: dict[float, float] = {}
    for piece, before in zip(found, pieces, strict=True):
        if not any(before.mass):
            for station in (piece.start, piece.end):
                share[station] = share.get(station, 0.0) + piece.whole_mass / 2
    for station in sorted(share):
        if lumps.get(station, 0.0) < (1 - UNIFORM) * share[station]:
            message = f"must be {share[station]:g} at least for uniform bars, found {lumps.get(station, 0.0):g}"
            problems.append((f"mass at {station:g} from the nose", message))
    left = {s: 0.0 if lumps[s] < (1 + UNIFORM) * share.get(s, 0.0) else lumps[s] - share.get(s, 0.0) for s in lumps}
    whole = sum(share.values())
    factor = (sum(lumps.values()) - sum(left.values())) / whole if whole else 1.0
    found = [p if any(q.mass) else p.weighing(p.mass[0] * factor) for p, q in zip(found, pieces, strict=True)]
    rest = []
    for mass in masses:
        part = left.pop(mass["station"], 0.0)
        if part or mass.get("rotary_inertia"):
            rest.append({**mass, "mass": part})
    notes.append(("", "the masses on grids of bars without mass are spread along them (lumps = spread)"))
    return found, rest


def _runs(pieces: list[Piece]) -> Iterator[list[Piece]]:
    run: list[Piece] = []
    for piece in pieces:
        if run and not piece.continues(run[-1]):
            yield run
            run = []
        run.append(piece)
    yield run
