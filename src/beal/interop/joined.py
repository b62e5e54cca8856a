"""Pieces, ties, masses and constraints of a deck put together as one stick, or refused with every reason."""

import math
from collections import defaultdict
from typing import Any

from beal.interop.lumps import Piece
from beal.interop.pieces import pieces_of, titled
from beal.interop.stick import Stick
from beal.interop.structure import GROUND, Link, Mass, Structure
from beal.interop.view import View

STIFF_ENOUGH = 10.0  # times the first bending frequency: a mass on such a spring moves with the stick
FREE_FREE = 22.3733  # omega_1 L^2 sqrt(m/EI) of a uniform free-free beam
HELD = {(math.inf, math.inf): "clamped", (math.inf, 0.0): "pinned", (0.0, math.inf): "sliding"}
FACE = "is moved forward by a billionth of the length, to the joint's forward face"  # SAME_PLACE


class Ties:
    """The links of a structure by the grids at their ends, given away one by one as they find their place."""

    def __init__(self, found: Structure, ground: set[int]) -> None:
        self._links: dict[frozenset[int], list[Link]] = {}
        self._others: defaultdict[int, set[int]] = defaultdict(set)
        for link in found.links:
            a, b = (GROUND if grid in ground else grid for grid in link.ends)
            self._links.setdefault(frozenset((a, b)), []).append(link)
            self._others[a].add(b)
            self._others[b].add(a)

    def of(self, grid: int) -> set[int]:
        """What a grid is tied to."""
        return self._others[grid]

    def take(self, a: int, b: int) -> list[Link]:
        """All links between two grids."""
        return self._links.pop(frozenset((a, b)), [])

    @property
    def left(self) -> list[Link]:
        """Links that found no place."""
        return [link for links in self._links.values() for link in links]


def joined(found: Structure, view: View) -> Stick:
    """The structure as one stick; what stands against it is added to its problems.

    Parameters
    ----------
    found : Structure
    view : View

    Returns
    -------
    Stick
        Not to be used where problems were found.
    """
    line = Stick(sorted(pieces_of(found, view), key=lambda piece: (piece.start, piece.end)), view)
    if not line.pieces:
        return line
    stations = {piece.fore: piece.start for piece in line.pieces} | {piece.aft: piece.end for piece in line.pieces}
    loaded = {mass.grid for mass in found.masses}
    ground = {
        grid
        for grid, held in found.held.items()
        if grid not in stations and grid not in loaded and held.issuperset(view.components)
    }
    ties = Ties(found, ground)
    for before, after in zip(line.pieces, line.pieces[1:], strict=False):
        line.joints.append(_joint(found, line, before, after, ties))
    _add_masses(found, line, stations, ties)
    _add_support(found, line, ties)
    for link in ties.left:
        found.problems.append((link.card.where, _untied(link)))
    tied = {grid for link in found.links for grid in link.ends}
    turned = {bar.orientation for bar in found.bars.values()}
    if idle := len(set(found.grids) - set(stations) - loaded - tied - turned):
        found.notes.append(("", f"{idle} grids carry neither bars nor masses: left out"))
    return line


def _untied(link: Link) -> str:
    if GROUND in link.ends:
        return "stands on the ground: only the ends of a stick can"
    return (
        f"ties grids {link.ends[0]} and {link.ends[1]}: a stick has ties only between the two ends of bars at one"
        " station, from an end to the ground, or from a bar to a mass beside it there"
    )


def _joint(found: Structure, line: Stick, before: Piece, after: Piece, ties: Ties) -> dict[str, Any] | None:
    """What lies between two neighbours, None where they share a grid."""
    if after.start < before.end - line.near:
        found.problems.append((after.where, f"lies beside {before.where}: a stick has one bar at each station"))
    elif after.start > before.end + line.near:
        found.problems.append((after.where, f"leaves a gap to {before.where}: these are two sticks"))
    elif before.aft != after.fore:
        if links := ties.take(before.aft, after.fore):
            shear, rotation = _added(links, line.view)
            damping = dict(zip(("shear_damping", "rotational_damping"), _added(links, line.view, True), strict=True))
            name = titled(links[0].card.comment or "")
            return {
                **({"name": name} if name else {}),
                "shear_stiffness": shear,
                "rotational_stiffness": rotation,
                **{key: value for key, value in damping.items() if value},
            }
        message = f"grid {after.fore} is not tied to grid {before.aft} at the same place: give a CBUSH or an RBE2"
        found.problems.append((after.where, message))
    return None


def _added(links: list[Link], view: View, damping: bool = False) -> tuple[float, float]:
    """Stiffness, or damping, of links side by side against deflection and slope."""
    parts = [link.damping if damping else link.stiffness for link in links]
    deflection, slope = (sum(part.get(n, 0.0) for part in parts) for n in view.components)
    return deflection, slope


def _add_masses(found: Structure, line: Stick, stations: dict[int, float], ties: Ties) -> None:
    """Point masses on the stick's grids, and those beside it on springs so stiff that they move with it."""
    pairs = zip(line.pieces, line.pieces[1:], strict=False)
    forward = {before.aft for before, after in pairs if before.aft != after.fore}
    hung: dict[int, tuple[int, list[Link]]] = {}
    for item in found.masses:
        grid = item.grid
        if grid in found.grids and grid not in stations and grid not in hung and len(ties.of(grid)) == 1:
            (on,) = ties.of(grid)
            hung[grid] = on, ties.take(grid, on)
            _check_place(found, line, hung[grid][1][0])
        on = hung[grid][0] if grid in hung else grid
        if on not in stations:
            what = "is not on the stick" if grid in found.grids else "is missing"
            found.problems.append((item.card.where, f"sits on grid {grid}, which {what}"))
            continue
        station = stations[on]
        if on in forward:
            station -= line.near  # at a joint's own station a mass sits on the aft face
            found.notes.append((item.card.where, FACE))
        name = titled(item.card.comment or "")
        part = {
            "station": station,
            "mass": found.mass_factor * item.mass,
            "rotary_inertia": found.mass_factor * item.inertia[line.view.rotation],
        }
        line.masses.append({"name": name, **part} if name else part)
    _check_springs(found, line, {grid: links for grid, (_, links) in hung.items()})


def _check_place(found: Structure, line: Stick, link: Link) -> None:
    """Refuse a tie between a mass and a bar at different stations."""
    places = [found.grids[grid] for grid in link.ends if grid in found.grids]
    if len(places) == 2 and any(abs(a - b) > line.near for a, b in zip(*places, strict=True)):
        found.problems.append((link.card.where, "ties a mass that is not at its station: put a grid there"))


def _check_springs(found: Structure, line: Stick, hung: dict[int, list[Link]]) -> None:
    """Whether the masses of grids beside the stick may be taken as fixed to it."""
    flexibility = sum(piece.length * (1 / piece.stiffness[0] + 1 / piece.stiffness[-1]) / 2 for piece in line.pieces)
    whole = sum(piece.whole_mass for piece in line.pieces) + sum(mass["mass"] for mass in line.masses)
    period = math.sqrt(flexibility * whole) * line.length / FREE_FREE  # of a uniform beam, per radian
    loads: dict[int, list[Mass]] = {grid: [] for grid in hung}
    for item in found.masses:
        if item.grid in loads:
            loads[item.grid].append(item)
    for grid, links in hung.items():
        items = loads[grid]
        mass = found.mass_factor * sum(item.mass for item in items)
        inertia = found.mass_factor * sum(item.inertia[line.view.rotation] for item in items)
        pairs = zip(_added(links, line.view), (mass, inertia), strict=True)
        own = min((math.sqrt(k / m) for k, m in pairs if m > 0), default=math.inf)
        if period > 0 and own * period < STIFF_ENOUGH:
            message = (
                f"hangs on a spring of {own:.3g} rad/s, less than {STIFF_ENOUGH:g} times the first bending frequency"
                f" (about {1 / period:.3g} rad/s): a vehicle has no sprung masses"
            )
            found.problems.append((items[0].card.where, message))
        elif own < math.inf:
            message = f"hangs on a spring of {own:.3g} rad/s, which is taken as rigid"
            found.ignored.append((items[0].card.where, message))


def _add_support(found: Structure, line: Stick, ties: Ties) -> None:
    """Supports from what holds the end grids in the plane of bending, or springs between them and the ground."""
    ends = {line.pieces[0].fore: "nose", line.pieces[-1].aft: "tail"}
    for grid, name in ends.items():
        links = ties.take(grid, GROUND)
        held = found.held.get(grid, set())
        springs = [
            math.inf if component in held else stiffness
            for component, stiffness in zip(line.view.components, _added(links, line.view), strict=True)
        ]
        dashpots = [link.card.where for link in links if any(link.damping.values())]
        found.ignored += [(where, "the dashpot of an end is left out") for where in dashpots]
        if any(springs):
            translation, rotation = springs
            line.support[name] = HELD.get((translation, rotation), {"translation": translation, "rotation": rotation})
    concerned = {grid for piece in line.pieces for grid in (piece.fore, piece.aft)} | {m.grid for m in found.masses}
    for grid in sorted(concerned.intersection(found.held) - set(ends)):
        if found.held[grid].intersection(line.view.components):
            message = f"is held in the plane {line.view.plane}: only the ends can be"
            found.problems.append((f"GRID {grid}", message))
