"""Pieces along one line, with what joins and loads them, as the content of a model file."""

from dataclasses import dataclass, field
from typing import Any

from beal.interop.lumps import Lump, Piece, weighted
from beal.interop.structure import Structure
from beal.interop.tables import along
from beal.interop.view import SAME_PLACE, View


@dataclass
class Stick:
    """The pieces of a stick from nose to tail, and what sits on them, in the deck's own units.

    Parameters
    ----------
    pieces : list of Piece
    view : View
    joints : list of dict or None
        Between the pieces, as [[joint]] has them: None where two pieces share a grid.
    masses : list of dict
        As [[point_mass]] has them.
    support : dict
        As [support] has it.
    """

    pieces: list[Piece]
    view: View
    joints: list[dict[str, Any] | None] = field(default_factory=list)
    masses: list[Lump] = field(default_factory=list)
    support: dict[str, Any] = field(default_factory=dict)

    @property
    def length(self) -> float:
        """From end to end."""
        return self.pieces[-1].end

    @property
    def near(self) -> float:
        """Distance within which places are one."""
        return SAME_PLACE * self.length


def described(line: Stick, found: Structure, spread: bool, by_comments: bool) -> dict[str, Any]:
    """The stick as the content of a model file, in the deck's own units.

    Parameters
    ----------
    line : Stick
    found : Structure
        To whose problems and notes it is added.
    spread : bool
        Whether lumps on bars without mass are spread along them.
    by_comments : bool
        Whether every stage begins with a comment, and only there.

    Returns
    -------
    dict
    """
    pieces, masses = weighted(line.pieces, line.masses, spread, found.problems, found.notes)
    runs: list[list[Piece]] = [[pieces[0]]]
    joints: list[dict[str, Any]] = []
    for piece, joint in zip(pieces[1:], line.joints, strict=True):
        before = runs[-1][-1]
        alike = piece.continues(before) or (by_comments and piece.group == before.group > 0 and not piece.alone)
        if alike and joint is None:
            runs[-1].append(piece)
        else:
            joints.append(joint or {})
            runs.append([piece])
    return {"stage": [_stage(run) for run in runs], "joint": joints, "point_mass": masses, "support": line.support}


def _stage(run: list[Piece]) -> dict[str, Any]:
    x = [station for piece in run for station in piece.x]
    name = next((piece.name for piece in run if piece.name), "")
    return {
        **({"name": name} if name else {}),
        "length": x[-1] - x[0],
        "mass_per_length": along(x, [value for piece in run for value in piece.mass]),
        "bending_stiffness": along(x, [value for piece in run for value in piece.stiffness]),
        "shear_stiffness": along(x, [value for piece in run for value in piece.shear]),
    }
