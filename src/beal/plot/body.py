"""The vehicle's body as it is drawn: an outline whose width stands for the bending stiffness, straight or bent."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.parts import Joint, Stage
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

HALF_WIDTH = 0.035  # of the stiffest section, over the length
GAP = 0.02  # between a flexible joint and the body on either side, over the length
LARGEST_GAP = 0.25  # over the length of the shorter stage
STEPS = 80  # of the outline, over the whole length


@dataclass(frozen=True)
class Section:
    """The body of one stage.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Stations from the nose, in m; a step of the stiffness is there twice.
    half_width : ndarray, shape (n,)
        In m of the drawing.
    """

    x: Array
    half_width: Array

    def outline(self, deflection: Array | float = 0.0, slope: Array | float = 0.0) -> Array:
        """The closed outline, with cross-sections normal to the bent axis.

        Parameters
        ----------
        deflection, slope : ndarray, shape (n,), or float
            Of the axis at the stations, as drawn.

        Returns
        -------
        ndarray, shape (2 n, 2)
        """
        turn = np.arctan(slope)
        across, up = self.half_width * np.sin(turn), self.half_width * np.cos(turn)
        left = np.column_stack((self.x - across, deflection + up))
        right = np.column_stack((self.x + across, deflection - up))
        return np.concatenate((left, right[::-1]))


def sections(vehicle: Vehicle, half_width: float = HALF_WIDTH) -> list[Section]:
    """The bodies of all stages, from nose to tail; a flexible joint leaves a gap between two of them.

    A beam has a bending stiffness EI and no radius: the drawn width goes with EI^(1/4), as the radius of geometrically
    similar sections of one material does. A rigid stage is as wide as the stiffest of the others.

    Parameters
    ----------
    vehicle : Vehicle
    half_width : float
        Of the stiffest section, over the length of the vehicle.

    Returns
    -------
    list of Section

    Examples
    --------
    >>> stages = [Stage(length=0.5, mass_per_length=1.0, bending_stiffness=value) for value in (1.0, 16.0)]
    >>> [body.half_width.max().item() for body in sections(Vehicle(stages=stages, joints=[Joint()]), 0.04)]
    [0.02, 0.04]
    """
    given = [stiffness for stage in vehicle.stages for stiffness in _table(stage)[1] if math.isfinite(stiffness)]
    stiffest = max(given, default=1.0)
    profiles = [_profile(stage, vehicle.length, stiffest) for stage in vehicle.stages]
    gaps = (0.0, *(gap(vehicle, number) for number in range(len(vehicle.joints))), 0.0)
    return [
        Section(np.clip(front + x, front + before, front + x[-1] - after), half_width * vehicle.length * share**0.25)
        for (x, share), front, before, after in zip(profiles, vehicle.boundaries, gaps, gaps[1:], strict=False)
    ]


def gap(vehicle: Vehicle, number: int) -> float:
    """Between a joint, counted from 0, and the body on either side, in m of the drawing; 0 for a rigid joint."""
    if not flexible(vehicle.joints[number]):
        return 0.0
    shorter = min(stage.length for stage in vehicle.stages[number : number + 2])
    return min(GAP * vehicle.length, LARGEST_GAP * shorter)


def flexible(joint: Joint) -> bool:
    """Whether any of the joint's springs gives."""
    return math.isfinite(joint.rotational_stiffness) or math.isfinite(joint.shear_stiffness)


def _table(stage: Stage) -> tuple[Array, Array]:
    """Stations from the front of a stage, and the stiffness at each."""
    given = stage.bending_stiffness
    if isinstance(given, StationTable):
        return given.arrays.x, given.arrays.value
    return np.array([0.0, stage.length]), np.full(2, given)


def _profile(stage: Stage, length: float, stiffest: float) -> tuple[Array, Array]:
    """Stations, close enough for a smooth outline, and at each the stiffness over the largest finite one, at most 1."""
    ends, values = _table(stage)
    values = np.minimum(values, stiffest) / stiffest
    x, share = [ends[:1]], [values[:1]]
    for n in range(1, len(ends)):
        part = np.linspace(0.0, 1.0, 1 + max(1, math.ceil(STEPS * (ends[n] - ends[n - 1]) / length)))[1:]
        x.append(ends[n - 1] + part * (ends[n] - ends[n - 1]))
        share.append(values[n - 1] + part * (values[n] - values[n - 1]))
    return np.concatenate(x), np.concatenate(share)
