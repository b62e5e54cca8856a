"""Where the mass of a stick sits: along its bars, on its grids, or on grids but meant along the bars."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

NEARLY_NOTHING = 1e-9  # share of the whole mass that bars without mass are given, taken from their grids
UNIFORM = 1e-3  # relative difference to which lumps count as those of a uniform bar
Problems = list[tuple[str, str]]


@dataclass(frozen=True)
class Piece:
    """One bar of a stick, from station to station.

    Parameters
    ----------
    where : str
        What messages call it.
    start, end : float
        Stations from the nose.
    fore, aft : int
        Grids there.
    mass, stiffness : float
        Per length, and in bending.
    group : int
        Number of the comments above it in the deck.
    name : str
        The comment in the line above.
    alone : bool
        Whether it is to stay a stage of its own.
    """

    where: str
    start: float
    end: float
    fore: int
    aft: int
    mass: float
    stiffness: float
    group: int
    name: str
    alone: bool = False

    def continues(self, before: "Piece") -> bool:
        """Whether it and the piece before are one uniform stage."""
        alike = (self.mass, self.stiffness, self.group) == (before.mass, before.stiffness, before.group)
        return alike and not self.alone and not before.alone


def weighted(
    pieces: list[Piece], masses: list[dict[str, Any]], spread: bool, problems: Problems, notes: list[str]
) -> tuple[list[Piece], list[dict[str, Any]]]:
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
    bare = [piece for piece in pieces if piece.mass == 0]
    if not bare:
        if spread:
            problems.append(("lumps", "there is nothing to spread: every bar has mass"))
        return pieces, masses
    if not any(mass["mass"] for mass in masses):
        problems.append(("deck", f"{bare[0].where} and {len(bare) - 1} more bars have no mass, nor have their grids"))
        return pieces, masses
    return (_spread if spread else _kept)(pieces, masses, problems, notes)


def _kept(
    pieces: list[Piece], masses: list[dict[str, Any]], problems: Problems, notes: list[str]
) -> tuple[list[Piece], list[dict[str, Any]]]:
    """Between two lumps a bar without mass bends as a cubic: each stays a stage, so that this is met exactly."""
    length = pieces[-1].end - pieces[0].start
    nothing = NEARLY_NOTHING * sum(mass["mass"] for mass in masses) / length
    taken: dict[float, float] = {}
    for piece in pieces:
        if piece.mass == 0:
            for station in (piece.start, piece.end):
                taken[station] = taken.get(station, 0.0) + nothing * (piece.end - piece.start) / 2
    rest = [{**m, "mass": max(m["mass"] - taken.get(m["station"], 0.0), 0.0)} for m in masses]
    notes.append(
        f"bars without mass carry {NEARLY_NOTHING:g} of the mass of their grids, which keep the rest (lumps = keep); to"
        " have it along the bars, give lumps = spread"
    )
    return [p if p.mass else replace(p, mass=nothing, alone=True) for p in pieces], rest


def _spread(
    pieces: list[Piece], masses: list[dict[str, Any]], problems: Problems, notes: list[str]
) -> tuple[list[Piece], list[dict[str, Any]]]:
    """Uniform runs of bars take the mass of the lumps that such a run leaves on its grids."""
    lumps: dict[float, float] = {}
    for mass in masses:
        lumps[mass["station"]] = lumps.get(mass["station"], 0.0) + mass["mass"]
    found: list[Piece] = []
    for run in _runs(pieces):
        inner = [lumps.get(b.start, 0.0) / ((b.end - a.start) / 2) for a, b in zip(run, run[1:], strict=False)]
        if run[0].mass == 0 and not inner:
            problems.append((run[0].where, "is the only bar of its kind: no grid inside tells its mass per length"))
        found += [replace(p, mass=median(inner)) if p.mass == 0 and inner else p for p in run]
    share: dict[float, float] = {}
    for piece, before in zip(found, pieces, strict=True):
        if before.mass == 0:
            for station in (piece.start, piece.end):
                share[station] = share.get(station, 0.0) + piece.mass * (piece.end - piece.start) / 2
    for station in sorted(share):
        if lumps.get(station, 0.0) < (1 - UNIFORM) * share[station]:
            message = f"must be {share[station]:g} at least for uniform bars, found {lumps.get(station, 0.0):g}"
            problems.append((f"mass at {station:g} from the nose", message))
    left = {s: 0.0 if lumps[s] < (1 + UNIFORM) * share.get(s, 0.0) else lumps[s] - share.get(s, 0.0) for s in lumps}
    whole = sum(share.values())
    factor = (sum(lumps.values()) - sum(left.values())) / whole if whole else 1.0
    found = [replace(p, mass=p.mass * factor) if q.mass == 0 else p for p, q in zip(found, pieces, strict=True)]
    rest = []
    for mass in masses:
        part = left.pop(mass["station"], 0.0)
        if part or mass.get("rotary_inertia"):
            rest.append({**mass, "mass": part})
    notes.append("the masses on grids of bars without mass are spread along them (lumps = spread)")
    return found, rest


def _runs(pieces: list[Piece]) -> Iterator[list[Piece]]:
    run: list[Piece] = []
    for piece in pieces:
        if run and not piece.continues(run[-1]):
            yield run
            run = []
        run.append(piece)
    yield run
