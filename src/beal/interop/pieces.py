"""Nastran bars and their sections as pieces of a stick."""

import math
from collections.abc import Iterator

from beal.interop.lumps import Piece
from beal.interop.sections import Section
from beal.interop.structure import Bar, Material, Structure, Vector
from beal.interop.view import View

STRAIGHT = 1e-6  # sine of the angle by which an orientation may miss a plane


def pieces_of(found: Structure, view: View) -> Iterator[Piece]:
    """Pieces of the bars that can be used; what stands against the others is added to the problems.

    Parameters
    ----------
    found : Structure
    view : View

    Yields
    ------
    Piece
        In the order of the deck; stations count from the nose.
    """
    sign = -1.0 if view.nose == "high" else 1.0
    origin = min(sign * found.grids[g][view.axis] for bar in found.bars.values() for g in bar.ends if g in found.grids)
    group = 0
    for bar in found.bars.values():
        group += bar.card.comment is not None
        section = found.sections.get(bar.section)
        material = found.materials.get(section.material) if section else None
        missing = [f"GRID {grid}" for grid in bar.ends if grid not in found.grids]
        if section is None:
            missing.append(f"property {bar.section}")
        elif material is None:
            missing.append(f"MAT1 {section.material}")
        if missing or section is None or material is None:
            found.problems.append((bar.card.where, f"is missing: {', '.join(missing)}"))
            continue
        ends = [sign * found.grids[grid][view.axis] - origin for grid in bar.ends]
        if problem := _misfit(found, bar, section, view) or ("" if ends[0] != ends[1] else "has no length"):
            found.problems.append((bar.card.where, problem))
            continue
        piece = _piece(found, bar, section, material, ends, group, plane=_plane(found, bar, section, view))
        if problem := _unusable(piece, view):
            found.problems.append((bar.card.where, problem))
            continue
        if not _round(section):
            note = f"is not equally stiff in both planes: the plane {view.plane} is taken"
            found.notes.append((bar.card.where, note))
        if math.isinf(piece.shear[0]) and (section.first_shear or section.second_shear):
            note = "has no shear modulus or area that K1 and K2 could multiply: it is rigid in shear"
            found.notes.append((bar.card.where, note))
        yield piece


def _piece(
    found: Structure, bar: Bar, section: Section, material: Material, ends: list[float], group: int, plane: int
) -> Piece:
    a, b = ends
    factor = section.first_shear if plane == 1 else section.second_shear
    rows = [
        (
            b if at == 1 else a + at * (b - a),
            found.mass_factor * (material.density * cut.area + cut.added_mass),
            material.elasticity * (cut.first if plane == 1 else cut.second),
            factor * material.shear * cut.area or math.inf,
        )
        for at, cut in section.cuts.items()
    ]
    grids = bar.ends
    if b < a:
        rows, grids = rows[::-1], grids[::-1]
    x, mass, stiffness, shear = (tuple(column) for column in zip(*rows, strict=True))
    return Piece(bar.card.where, x, mass, stiffness, shear, *grids, group, titled(bar.card.comment or ""))


def _misfit(found: Structure, bar: Bar, section: Section, view: View) -> str:
    """Why a bar does not bend in one plane, empty if it does."""
    if any(cut.product for cut in section.cuts.values()):
        return "has a product of inertia: its planes are coupled"
    return {0: "has no orientation across its axis", -1: "bends about axes that are turned against the plane"}.get(
        _plane(found, bar, section, view), ""
    )


def _plane(found: Structure, bar: Bar, section: Section, view: View) -> int:
    """1 or 2: which second moment resists the deflection; 0 without an orientation, -1 where it is askew."""
    vector = _orientation(found, bar)
    across = math.hypot(vector[view.deflection], vector[view.rotation])
    if across == 0:
        return 0
    if abs(vector[view.rotation]) <= STRAIGHT * across or _round(section):
        return 1
    return 2 if abs(vector[view.deflection]) <= STRAIGHT * across else -1


def _orientation(found: Structure, bar: Bar) -> Vector:
    if not isinstance(bar.orientation, int):
        return bar.orientation
    here = found.grids[bar.ends[0]]
    there = found.grids.get(bar.orientation, here)
    return there[0] - here[0], there[1] - here[1], there[2] - here[2]


def _round(section: Section) -> bool:
    """Whether a section bends alike in every plane."""
    shear = section.first_shear == section.second_shear
    return shear and all(cut.first == cut.second for cut in section.cuts.values())


def _unusable(piece: Piece, view: View) -> str:
    """Why a piece is no piece of a stage, empty if it is."""
    stiffness, mass = min(piece.stiffness), min(piece.mass)
    if not 0 < stiffness <= max(piece.stiffness) < math.inf:
        return f"its bending stiffness in the plane {view.plane} must be positive and finite, found {stiffness:g}"
    if mass < 0 or max(piece.mass) == math.inf:
        return f"its mass per length must be finite and not negative, found {mass:g}"
    if mass == 0 and any(piece.mass):
        return "its mass per length must be positive all along, or nowhere, found 0 at one place"
    if min(piece.shear) <= 0 or len({math.isinf(value) for value in piece.shear}) > 1:
        return f"its stiffness in shear must be positive all along, or nowhere finite, found {min(piece.shear):g}"
    if any(b <= a for a, b in zip(piece.x, piece.x[1:], strict=False)):
        return "its stations are too close together"
    return ""


def titled(comment: str) -> str:
    """A comment as a name; empty where it is only a ruler."""
    return comment if any(letter.isalpha() for letter in comment) else ""
