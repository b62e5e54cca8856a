"""The exact modes of the unloaded vehicle as admissible functions, as Irani & Kavianipour (2009) chose them."""

from functools import cached_property

import numpy as np

from beal.discretisation.basis import ROTATION, SLOPE, Array, Basis, segments
from beal.discretisation.joint_modes import JointSign, joint_modes
from beal.vehicle.vehicle import Vehicle


class ModeBasis(Basis):
    """The lowest elastic modes of two equal uniform free-free stages on a joint, Eq. (10); no rigid-body motion.

    Parameters
    ----------
    vehicle : Vehicle
        Two stages of equal properties, free ends.
    count : int
        Number of modes.
    sign : {"natural", "printed"}
        Sign of the rotational line of Eq. (12).
    """

    def __init__(self, vehicle: Vehicle, count: int, sign: JointSign) -> None:
        self.segments = segments(vehicle)
        self.quadrature = 24 + 3 * count  # modes of a free beam have about one half wave each
        self._length = vehicle.length
        self._split = vehicle.boundaries[1]
        joint, scales = vehicle.joints[0], vehicle.scales
        self._modes = joint_modes(
            self._split / self._length,
            joint.rotational_stiffness * self._length / scales.bending_stiffness,
            joint.shear_stiffness * self._length**3 / scales.bending_stiffness,
            count,
            sign,
        )

    @property
    def size(self) -> int:
        return len(self._modes.wavenumbers)

    def rows(self, segment: int, xi: Array, reading: int) -> Array:
        derivative = SLOPE if reading == ROTATION else reading
        piece = self.segments[segment]
        local = piece.start + piece.length * (1 + xi) / 2 - (self._split if piece.stage else 0.0)
        return self._modes.evaluate(piece.stage, local / self._length, derivative) / self._length**derivative

    @cached_property
    def _jumps(self) -> Array:
        return self._modes.jumps

    def jump(self, segment: int, reading: int) -> Array:
        """Across the joint, from the load in the spring rather than as a small difference."""
        derivative = SLOPE if reading == ROTATION else reading
        return np.asarray(self._jumps[1 - derivative] / self._length**derivative)
