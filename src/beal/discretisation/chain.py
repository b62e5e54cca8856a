"""Numbering of coordinates along the chain: rigid-body motion first, then segments and flexible joints in order."""

import numpy as np

from beal.discretisation.basis import Array, Segment
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


def jump_scales(vehicle: Vehicle) -> list[tuple[float, float]]:
    """Jumps of deflection and slope at a unit of each joint's coordinates; 0 where the joint is rigid.

    A joint's coordinate is its jump times the square root of (stiffness + that of the beam behind), which keeps every
    column of the same size in energy from a hinge to an all but rigid joint.
    """
    length = vehicle.length
    return [
        (
            (joint.shear_stiffness + mean(stage.bending_stiffness) / length**3) ** -0.5,
            (joint.rotational_stiffness + mean(stage.bending_stiffness) / length) ** -0.5,
        )
        for joint, stage in zip(vehicle.joints, vehicle.stages[1:], strict=True)
    ]


class Chain:
    """Columns of the segments' own coordinates and of the joints' jumps."""

    def __init__(self, vehicle: Vehicle, segments: tuple[Segment, ...], per_segment: int) -> None:
        self.columns: list[slice] = []
        self._jumps: list[tuple[int | None, float, int | None, float]] = []
        scales = jump_scales(vehicle)
        column = 2
        for index, segment in enumerate(segments):
            shear = rotation = None
            shear_scale = rotation_scale = 0.0
            if index and segments[index - 1].stage != segment.stage:
                shear_scale, rotation_scale = scales[segment.stage - 1]
                if shear_scale:
                    shear, column = column, column + 1
                if rotation_scale:
                    rotation, column = column, column + 1
            self._jumps.append((shear, shear_scale, rotation, rotation_scale))
            self.columns.append(slice(column, column + per_segment))
            column += per_segment
        self.size = column

    def nose(self) -> Array:
        """Deflection and slope at the nose: the rigid-body coordinates, shape (2, size)."""
        return np.eye(2, self.size)

    def jumps(self, segment: int) -> Array:
        """Jumps of deflection and slope across the front of a segment, shape (2, size); zero without a joint."""
        shear, shear_scale, rotation, rotation_scale = self._jumps[segment]
        jumps = np.zeros((2, self.size))
        if shear is not None:
            jumps[0, shear] = shear_scale
        if rotation is not None:
            jumps[1, rotation] = rotation_scale
        return jumps
