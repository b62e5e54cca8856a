"""Numbering of coordinates along the chain: rigid-body motion, segments and flexible joints, springs to the ground."""

import math
from dataclasses import dataclass

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


@dataclass(frozen=True)
class GroundSpring:
    """A spring between an end and the ground.

    Parameters
    ----------
    end : {0, 1}
        Nose or tail.
    derivative : {0, 1}
        Against deflection or slope.
    stiffness : float
    scale : float
        Deflection or slope of the end at a unit of the spring's coordinate, see `jump_scales`.
    """

    end: int
    derivative: int
    stiffness: float
    scale: float


def ground_springs(vehicle: Vehicle) -> tuple[GroundSpring, ...]:
    """The springs at the ends that are neither rigid nor absent."""
    own = vehicle.scales.thrust / vehicle.length, vehicle.scales.thrust * vehicle.length
    return tuple(
        GroundSpring(end, derivative, k, (k + own[derivative]) ** -0.5)
        for end, stiffness in enumerate(vehicle.support.stiffness)
        for derivative, k in enumerate(stiffness)
        if 0 < k < math.inf
    )


def held(vehicle: Vehicle) -> list[tuple[int, int]]:
    """(end, derivative) of what is held rigidly; end 0 is the nose, 1 the tail."""
    ends = enumerate(vehicle.support.stiffness)
    return [(end, derivative) for end, stiffness in ends for derivative in (0, 1) if stiffness[derivative] == math.inf]


class Chain:
    """Columns of the segments' own coordinates, of the joints' jumps and of the springs to the ground."""

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
        self.springs = ground_springs(vehicle)
        self.size = column + len(self.springs)

    def deformations(self) -> Array:
        """Deflections and slopes at the ground springs, the last coordinates, shape (springs, size)."""
        scales = np.array([spring.scale for spring in self.springs])
        return scales[:, None] * np.eye(self.size)[self.size - len(scales) :]

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
