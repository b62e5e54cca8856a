"""Numbering of coordinates along the chain: rigid-body motion, segments and flexible joints, springs to the ground."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from beal.discretisation.basis import DEFLECTION, ROTATION, Array, Segment
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


def jump_scales(vehicle: Vehicle) -> list[tuple[float, float]]:
    """Jumps of deflection and rotation at a unit of each joint's coordinates; 0 where the joint is rigid.

    A joint's coordinate is its jump times the square root of (stiffness + that of the beam behind), which keeps every
    column of the same size in energy from a hinge to an all but rigid joint.
    """
    return [
        (
            (joint.shear_stiffness + beam_behind(vehicle, index, DEFLECTION)) ** -0.5,
            (joint.rotational_stiffness + beam_behind(vehicle, index, ROTATION)) ** -0.5,
        )
        for index, joint in enumerate(vehicle.joints)
    ]


def beam_behind(vehicle: Vehicle, joint: int, reading: int) -> float:
    """Stiffness of the stage behind a joint against deflection, EI/L^3, or rotation, EI/L; of a rigid one the scale."""
    stiffness = mean(vehicle.stages[joint + 1].bending_stiffness)
    if stiffness == math.inf:
        stiffness = vehicle.scales.bending_stiffness
    return stiffness / vehicle.length ** (1 if reading == ROTATION else 3)


@dataclass(frozen=True)
class GroundSpring:
    """A spring between an end and the ground.

    Parameters
    ----------
    end : {0, 1}
        Nose or tail.
    reading : {DEFLECTION, ROTATION}
        What it resists.
    stiffness : float
    scale : float
        Deflection or rotation of the end at a unit of the spring's coordinate, see `jump_scales`.
    """

    end: int
    reading: int
    stiffness: float
    scale: float


def ground_springs(vehicle: Vehicle) -> tuple[GroundSpring, ...]:
    """The springs at the ends that are neither rigid nor absent."""
    own = {DEFLECTION: vehicle.scales.thrust / vehicle.length, ROTATION: vehicle.scales.thrust * vehicle.length}
    return tuple(
        GroundSpring(end, reading, k, (k + own[reading]) ** -0.5)
        for end, reading, k in _ends(vehicle)
        if 0 < k < math.inf
    )


def held(vehicle: Vehicle) -> list[tuple[int, int]]:
    """(end, reading) of what is held rigidly; end 0 is the nose, 1 the tail."""
    return [(end, reading) for end, reading, k in _ends(vehicle) if k == math.inf]


def _ends(vehicle: Vehicle) -> Iterator[tuple[int, int, float]]:
    """Of both ends the stiffness against deflection and rotation."""
    for end, stiffness in enumerate(vehicle.support.stiffness):
        for reading, k in zip((DEFLECTION, ROTATION), stiffness, strict=True):
            yield end, reading, k


class Chain:
    """Columns of the segments' own coordinates, as many as given, of joints' jumps and of springs to the ground."""

    def __init__(self, vehicle: Vehicle, segments: tuple[Segment, ...], own: Sequence[int]) -> None:
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
            self.columns.append(slice(column, column + own[index]))
            column += own[index]
        self.springs = ground_springs(vehicle)
        self.size = column + len(self.springs)

    def deformations(self) -> Array:
        """Deflections and rotations at the ground springs, the last coordinates, shape (springs, size)."""
        scales = np.array([spring.scale for spring in self.springs])
        return scales[:, None] * np.eye(self.size)[self.size - len(scales) :]

    def nose(self) -> Array:
        """Deflection and rotation at the nose: the rigid-body coordinates, shape (2, size)."""
        return np.eye(2, self.size)

    def jumps(self, segment: int) -> Array:
        """Jumps of deflection and rotation across the front of a segment, shape (2, size); zero without a joint."""
        shear, shear_scale, rotation, rotation_scale = self._jumps[segment]
        jumps = np.zeros((2, self.size))
        if shear is not None:
            jumps[0, shear] = shear_scale
        if rotation is not None:
            jumps[1, rotation] = rotation_scale
        return jumps
