"""Bars along one line become stages, joints, point masses and supports, or are refused with every reason."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

from beal.interop.lumps import Piece, weighted
from beal.interop.structure import Bar, Link, Structure

AXES = "xyz"
SAME_PLACE = 1e-9  # of the stick's length
STIFF_ENOUGH = 10.0  # times the first bending frequency: a mass on such a spring moves with the stick
FREE_FREE = 22.3733  # omega_1 L^2 sqrt(m/EI) of a uniform free-free beam
Problems = list[tuple[str, str]]


@dataclass(frozen=True)
class View:
    """How a deck is looked at.

    Parameters
    ----------
    axis, deflection : int
        Directions of the stick and of its deflection: 0, 1, 2 for x, y, z.
    nose : {"high", "low"}
        Which end of the axis the nose is.
    """

    axis: int
    deflection: int
    nose: Literal["high", "low"]

    @property
    def plane(self) -> str:
        """Both directions, such as ``xy``."""
        return AXES[self.axis] + AXES[self.deflection]

    @property
    def rotation(self) -> int:
        """Direction that the slope turns about."""
        return 3 - self.axis - self.deflection

    @property
    def components(self) -> tuple[int, int]:
        """Nastran's numbers of the deflection and of the slope."""
        return self.deflection + 1, self.rotation + 4


@dataclass
class Stick:
    """The pieces of a stick from nose to tail, and what sits on them, in the deck's own units.

    Parameters
    ----------
    pieces : list of Piece
    joints : list of dict
        Between the pieces: None where they share a grid, else the springs by component.
    masses : list of dict
        As [[point_mass]] has them.
    support : dict
    view : View
    """

    pieces: list[Piece]
    view: View
    joints: list[tuple[str, dict[int, float]] | None] = field(default_factory=list)
    masses: list[dict[str, Any]] = field(default_factory=list)
    support: dict[str, str] = field(default_factory=dict)


def viewed(found: Structure, plane: str | None, nose: Literal["high", "low"]) -> View | None:
    """The axis that the bars lie along, None (and problems) where they do not lie along one."""
    used = sorted({grid for bar in found.bars.values() for grid in bar.ends if grid in found.grids})
    if not found.bars or len(used) < 2:
        found.problems.append(("deck", f"needs CBAR or CBEAM elements between grids, found {len(found.bars)}"))
        return None
    spans = [max(found.grids[g][n] for g in used) - min(found.grids[g][n] for g in used) for n in range(3)]
    axis = spans.index(max(spans))
    for other in {0, 1, 2} - {axis}:
        common = Counter(found.grids[g][other] for g in used).most_common(1)[0][0]
        off = [g for g in used if abs(found.grids[g][other] - common) > SAME_PLACE * spans[axis]]
        found.problems += [
            (f"GRID {g}", f"is off the line of the others: {AXES[other]} = {found.grids[g][other]:g}, not {common:g}")
            for g in off
        ]
    if spans[axis] == 0:
        found.problems.append(("deck", "all grids of the bars are at one place"))
    plane = plane or AXES[axis] + ("y" if axis != 1 else "x")
    if AXES[axis] not in plane:
        message = f"must hold the stick's axis {AXES[axis]} and the direction that it bends in, found {plane!r}"
        found.problems.append(("plane", message))
        return None
    deflection = AXES.index(plane.replace(AXES[axis], ""))
    return View(axis, deflection, nose) if not found.problems or spans[axis] > 0 else None


def stick(found: Structure, view: View) -> Stick:
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
    concerned = {grid for bar in found.bars.values() for grid in (*bar.ends, bar.orientation)}
    if idle := set(found.grids) - concerned - {mass.grid for mass in found.masses}:
        found.notes.append(f"{len(idle)} grids carry neither bars nor masses: left out")
    pieces = sorted(_pieces(found, view), key=lambda piece: (piece.start, piece.end))
    result = Stick(pieces, view)
    if not pieces:
        return result
    used: set[int] = set()
    tolerance = SAME_PLACE * (pieces[-1].end - pieces[0].start)
    for before, after in zip(pieces, pieces[1:], strict=False):
        result.joints.append(_joint(found, before, after, tolerance, used))
    _add_masses(found, result, used)
    for n, link in enumerate(found.links):
        if n not in used:
            found.problems.append((link.card.where, f"ties grids {link.ends[0]} and {link.ends[1]}: {_UNTIED}"))
    _add_support(found, result)
    return result


_UNTIED = "a stick has ties only between the two ends of bars at one station, or from one to a mass beside it there"


def _pieces(found: Structure, view: View) -> Iterator[Piece]:
    """The bars as pieces of the stick; stations count from the nose."""
    sign = -1.0 if view.nose == "high" else 1.0
    used = [found.grids[g][view.axis] for bar in found.bars.values() for g in bar.ends if g in found.grids]
    origin = min(sign * x for x in used)
    unlike, sheared, group = 0, 0, 0
    for bar in found.bars.values():
        group += bar.card.comment is not None
        missing = [f"GRID {grid}" for grid in bar.ends if grid not in found.grids]
        section = found.sections.get(bar.section)
        if section is None:
            missing.append(f"property {bar.section}")
        elif section.material not in found.materials:
            missing.append(f"MAT1 {section.material}")
        if missing or section is None:
            found.problems.append((bar.card.where, f"is missing: {', '.join(missing)}"))
            continue
        plane = _bending_plane(found, bar, view)
        modulus, density = found.materials[section.material]
        inertia, shear = (section.first, section.first_shear) if plane == 1 else (section.second, section.second_shear)
        stations = [(sign * found.grids[grid][view.axis] - origin, grid) for grid in bar.ends]
        (start, fore), (end, aft) = sorted(stations, key=lambda end: end[0])
        stiffness = modulus * inertia
        mass = found.mass_factor * (density * section.area + section.added_mass)
        problem = (
            f"its bending stiffness in the plane {view.plane} must be positive and finite, found {stiffness:g}"
            if not 0 < stiffness < math.inf
            else f"its mass per length must not be negative, found {mass:g}"
            if mass < 0
            else "has a product of inertia: its planes are coupled"
            if section.product
            else "has no orientation across its axis"
            if plane == 0
            else "bends about axes that are turned against the plane"
            if plane < 0
            else "has no length"
            if end <= start
            else ""
        )
        if problem:
            found.problems.append((bar.card.where, problem))
            continue
        unlike += section.first != section.second
        sheared += shear != 0
        yield Piece(bar.card.where, start, end, fore, aft, mass, stiffness, group, titled(bar.card.comment or ""))
    if unlike:
        found.notes.append(f"{unlike} bars are not equally stiff in both planes: the plane {view.plane} is taken")
    if sheared:
        found.ignored.append(
            f"{sheared} bars are flexible in shear (K1, K2): left out, stages are Euler-Bernoulli beams"
        )


def _bending_plane(found: Structure, bar: Bar, view: View) -> int:
    """1 or 2: which second moment resists the deflection; 0 without an orientation, -1 where it is askew."""
    vector = bar.orientation
    if isinstance(vector, int):
        if vector not in found.grids:
            return 0
        there, here = found.grids[vector], found.grids[bar.ends[0]]
        vector = (there[0] - here[0], there[1] - here[1], there[2] - here[2])
    across = math.hypot(vector[view.deflection], vector[view.rotation])
    if across == 0:
        return 0
    section = found.sections[bar.section]
    if abs(vector[view.rotation]) <= 1e-6 * across or section.first == section.second:
        return 1
    return 2 if abs(vector[view.deflection]) <= 1e-6 * across else -1


def titled(comment: str) -> str:
    """A comment as a name; empty where it is only a ruler."""
    return comment if any(letter.isalpha() for letter in comment) else ""


def _joint(
    found: Structure, before: Piece, after: Piece, tolerance: float, used: set[int]
) -> tuple[str, dict[int, float]] | None:
    """The springs between two neighbours, None where they share a grid."""
    if after.start < before.end - tolerance:
        found.problems.append((after.where, f"lies beside {before.where}: a stick has one bar at each station"))
    elif after.start > before.end + tolerance:
        found.problems.append((after.where, f"leaves a gap to {before.where}: these are two sticks"))
    elif before.aft != after.fore:
        links = [(n, link) for n, link in enumerate(found.links) if set(link.ends) == {before.aft, after.fore}]
        used.update(n for n, _ in links)
        if links:
            return titled(links[0][1].card.comment or ""), _added([link for _, link in links])
        message = f"grid {after.fore} is not tied to grid {before.aft} at the same place: give a CBUSH or an RBE2"
        found.problems.append((after.where, message))
    return None


def _added(links: list[Link]) -> dict[int, float]:
    return {n: sum(link.stiffness.get(n, 0.0) for link in links) for n in range(1, 7)}


def _add_masses(found: Structure, result: Stick, used: set[int]) -> None:
    """Point masses on the stick's grids, and those beside it on springs so stiff that they move with it."""
    view, pieces = result.view, result.pieces
    stations = {piece.fore: piece.start for piece in pieces} | {piece.aft: piece.end for piece in pieces}
    length = pieces[-1].end
    forward = {before.aft for before, after in zip(pieces, pieces[1:], strict=False) if before.aft != after.fore}
    with_mass = {item.grid for item in found.masses}
    moved: dict[int, int] = {}
    for n, link in enumerate(found.links):
        beside = [grid for grid in link.ends if grid not in stations]
        on = [grid for grid in link.ends if grid in stations]
        if n in used or len(on) != 1 or beside[0] not in with_mass & set(found.grids):
            continue
        if moved.setdefault(beside[0], on[0]) != on[0]:
            continue
        if any(abs(a - b) > SAME_PLACE * length for a, b in zip(*(found.grids[g] for g in link.ends), strict=True)):
            found.problems.append((link.card.where, "ties a mass that is not at its station: put a grid there"))
        used.add(n)
    for grid, on_grid in moved.items():
        _check_spring(found, result, grid, on_grid)
    for item in found.masses:
        where, grid = item.card.where, moved.get(item.grid, item.grid)
        if grid not in stations:
            what = "is not on the stick" if grid in found.grids else "is missing"
            found.problems.append((where, f"sits on grid {grid}, which {what}"))
            continue
        station = stations[grid]
        if grid in forward:
            station -= SAME_PLACE * length  # at a joint's own station a mass sits on the aft face
            found.notes.append(
                f"{where}: is moved forward by {SAME_PLACE:g} of the length, to the joint's forward face"
            )
        name = titled(item.card.comment or "")
        part = {
            "station": station,
            "mass": found.mass_factor * item.mass,
            "rotary_inertia": found.mass_factor * item.inertia[view.rotation],
        }
        result.masses.append({"name": name, **part} if name else part)


def _check_spring(found: Structure, result: Stick, grid: int, on: int) -> None:
    """Whether the masses of a grid beside the stick may be taken as fixed to it."""
    items = [item for item in found.masses if item.grid == grid]
    where = items[0].card.where
    mass = found.mass_factor * sum(item.mass for item in items)
    inertia = found.mass_factor * sum(item.inertia[result.view.rotation] for item in items)
    springs = _added([link for link in found.links if set(link.ends) == {grid, on}])
    pairs = zip((springs[n] for n in result.view.components), (mass, inertia), strict=True)
    own = min((math.sqrt(k / m) for k, m in pairs if m > 0), default=math.inf)
    length = result.pieces[-1].end
    flexibility = sum((piece.end - piece.start) / piece.stiffness for piece in result.pieces) / length
    total = sum((p.end - p.start) * p.mass for p in result.pieces) + sum(
        found.mass_factor * m.mass for m in found.masses
    )
    period = math.sqrt(flexibility * total * length * length * length) / FREE_FREE  # per radian, of a uniform beam
    if period > 0 and own * period < STIFF_ENOUGH:
        found.problems.append(
            (
                where,
                f"hangs on a spring of {own:.3g} rad/s, less than {STIFF_ENOUGH:g} times the first bending frequency"
                f" (about {1 / period:.3g} rad/s): a vehicle has no sprung masses",
            )
        )
    elif own < math.inf:
        found.ignored.append(f"{where}: hangs on a spring of {own:.3g} rad/s, which is taken as rigid")


def _add_support(found: Structure, result: Stick) -> None:
    """Supports from what holds the end grids in the plane of bending."""
    slide, turn = result.view.components
    ends = {result.pieces[0].fore: "nose", result.pieces[-1].aft: "tail"}
    concerned = {grid for piece in result.pieces for grid in (piece.fore, piece.aft)} | {m.grid for m in found.masses}
    for grid in sorted(concerned & set(found.held)):
        held = (slide in found.held[grid], turn in found.held[grid])
        if grid in ends:
            kind = {(True, True): "clamped", (True, False): "pinned", (False, True): "sliding", (False, False): "free"}
            if held != (False, False):
                result.support[ends[grid]] = kind[held]
        elif any(held):
            found.problems.append((f"GRID {grid}", f"is held in the plane {result.view.plane}: only the ends can be"))


def described(result: Stick, spread: bool, problems: Problems, notes: list[str]) -> dict[str, Any]:
    """The stick as the content of a model file, in the deck's own units."""
    pieces, masses = weighted(result.pieces, result.masses, spread, problems, notes)
    stages: list[dict[str, Any]] = []
    joints: list[dict[str, Any]] = []
    before: Piece | None = None
    start = 0.0
    for piece, joint in zip(pieces, [None, *result.joints], strict=True):
        if before is not None and joint is None and piece.continues(before):
            stages[-1]["length"] = piece.end - start
        else:
            if before is not None:
                joints.append(_springs(joint, result.view.components))
            start = piece.start
            properties = {"mass_per_length": piece.mass, "bending_stiffness": piece.stiffness}
            stages.append({"length": piece.end - start, **properties})
        if piece.name:
            stages[-1]["name"] = piece.name
        before = piece
    return {"stage": stages, "joint": joints, "point_mass": masses, "support": result.support}


def _springs(joint: tuple[str, dict[int, float]] | None, components: tuple[int, int]) -> dict[str, Any]:
    if joint is None:
        return {}
    name, stiffness = joint
    springs = {"shear_stiffness": stiffness[components[0]], "rotational_stiffness": stiffness[components[1]]}
    return {**({"name": name} if name else {}), **springs}
