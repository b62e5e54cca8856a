"""Grids and bars of a vehicle, as its deck has them."""

import math
from bisect import bisect
from dataclasses import dataclass

from beal.interop.view import SAME_PLACE
from beal.vehicle.parts import Joint
from beal.vehicle.vehicle import Vehicle

VARYING = ("mass_per_length", "bending_stiffness", "shear_stiffness")  # what sections say of a stage
APART = 10 * SAME_PLACE  # of the length: grids of one stage


@dataclass(frozen=True)
class Mesh:
    """Grids and bars from nose to tail; grids are numbered from 1.

    Parameters
    ----------
    grids : list of float
        Stations.
    bars : list of tuple
        Index of the stage, forward grid, aft grid.
    faces : list of tuple
        Forward and aft grid of each joint, one and the same where it is rigid.
    """

    grids: list[float]
    bars: list[tuple[int, int, int]]
    faces: list[tuple[int, int]]

    def grid_at(self, station: float) -> int:
        """The grid nearest to a station; of a joint's two the aft one, unless the station is clearly forward of it."""
        length = self.grids[-1]
        for forward, aft in self.faces:
            if abs(station - self.grids[aft - 1]) <= APART * length:
                return aft if station >= self.grids[aft - 1] - SAME_PLACE * length / 2 else forward
        after = min(bisect(self.grids, station), len(self.grids) - 1)
        return after + (self.grids[after] - station < station - self.grids[after - 1])


def meshed(vehicle: Vehicle, elements: int) -> Mesh:
    """Bars between the stages' ends, the stations of their tables and of masses, and evenly between.

    Parameters
    ----------
    vehicle : Vehicle
    elements : int
        Even parts of each stage.

    Returns
    -------
    Mesh

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> meshed(catalog.tsto(0.6, 50.0, 5000.0), elements=1)
    Mesh(grids=[0.0, 0.6, 0.6, 1.0], bars=[(0, 1, 2), (1, 3, 4)], faces=[(2, 3)])
    """
    grids, bars, faces = [0.0], [], []
    masses = [mass.station for mass in vehicle.point_masses]
    for index, (start, end) in enumerate(zip(vehicle.boundaries, vehicle.boundaries[1:], strict=False)):
        if index:
            forward = len(grids)
            if not is_rigid(vehicle.joints[index - 1]):
                grids.append(start)
            faces.append((forward, len(grids)))
        tables = vehicle.stages[index].tables
        wanted = [start + x for name in VARYING if name in tables for x in tables[name].x]
        wanted += masses
        wanted += [start + (end - start) * n / elements for n in range(1, elements)]
        for x in _apart(wanted, start, end, APART * vehicle.length):
            bars.append((index, len(grids), len(grids) + 1))
            grids.append(x)
    return Mesh(grids, bars, faces)


def is_rigid(joint: Joint) -> bool:
    """Whether nothing gives, and there is nothing to say of dashpots."""
    damping = joint.rotational_damping or joint.shear_damping
    return joint.rotational_stiffness == joint.shear_stiffness == math.inf and not damping


def _apart(wanted: list[float], start: float, end: float, near: float) -> list[float]:
    """Stations behind the start up to the end, without those too near to one that was wanted before."""
    kept = [start, end]
    for x in wanted:
        after = bisect(kept, x)
        if 0 < after < len(kept) and min(x - kept[after - 1], kept[after] - x) > near:
            kept.insert(after, x)
    return kept[1:]
