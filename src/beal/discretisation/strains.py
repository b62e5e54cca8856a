"""The strains that a segment may have: the curvature of bending, and the shear strain beside it.

A section turns by psi, the axis by y' = psi + gamma; bending strains by psi' and shear by gamma. Without shear psi is
y' (Euler-Bernoulli); with it the two strains are independent (Timoshenko), so nothing locks however stiff the shear.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from beal.discretisation.basis import CURVATURE, DEFLECTION, ROTATION, SHEAR, SLOPE, Array, Segment
from beal.discretisation.polynomials import integrated
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Strain:
    """A strain of a segment.

    Parameters
    ----------
    stiffness : str
        Name of the stage's stiffness against it.
    reading : int
        The strain itself.
    times : mapping of reading to int
        How often the strain is integrated from the segment's front for what it adds to a reading.
    """

    stiffness: Literal["bending_stiffness", "shear_stiffness"]
    reading: int
    times: Mapping[int, int]

    def stiffnesses(self, vehicle: Vehicle, chain: Sequence[Segment]) -> Array:
        """Mean stiffness of the stage of each segment, infinite where there is no such strain."""
        of_stages = np.array([mean(getattr(stage, self.stiffness)) for stage in vehicle.stages])
        return np.asarray(of_stages[[segment.stage for segment in chain]])


BENDING = Strain("bending_stiffness", CURVATURE, {DEFLECTION: 2, SLOPE: 1, ROTATION: 1, CURVATURE: 0})
SHEARING = Strain("shear_stiffness", SHEAR, {DEFLECTION: 1, SLOPE: 0, SHEAR: 0})
STRAINS = (BENDING, SHEARING)


def carried(reading: int, length: Array | float, xi: Array) -> Array:
    """What a unit of the deflection and one of the rotation at a segment's front do behind it, shape (len(xi), 2)."""
    rows = np.zeros((len(xi), 2))
    if reading == DEFLECTION:
        rows[:, 0] = 1.0
        rows[:, 1] = length * (1 + xi) / 2
    elif reading in (SLOPE, ROTATION):
        rows[:, 1] = 1.0
    return rows


@dataclass(frozen=True)
class UniformShapes:
    """A strain as Legendre polynomials, orthonormal in energy, on a segment of one stiffness.

    Parameters
    ----------
    order : int
    length, stiffness : float
    """

    order: int
    length: float
    stiffness: float

    def at(self, xi: Array, times: int) -> Array:
        """Strains integrated ``times`` times, at xi in [-1, 1] of the segment, shape (len(xi), order + 1)."""
        unit_energy = (self.length * self.stiffness) ** -0.5 * (self.length / 2) ** times
        return np.asarray(orthonormal(self.order, times, xi) * unit_energy)


def orthonormal(order: int, times: int, xi: Array) -> Array:
    """sqrt(2 k + 1) P_k, k = 0..order, integrated from -1 ``times`` times, shape (len(xi), order + 1)."""
    return integrated(order, times, xi) * np.sqrt(2 * np.arange(order + 1) + 1)
