"""How a deck is looked at: along which axis its stick lies, in which plane it bends, and where its nose is."""

from collections import Counter
from dataclasses import dataclass
from typing import Literal

from beal.interop.structure import Structure

AXES = "xyz"
SAME_PLACE = 1e-9  # of the stick's length


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
    return View(axis, deflection, nose) if spans[axis] > 0 else None
