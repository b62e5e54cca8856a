"""How far to search: the thrust at which a dead load would have buckled the vehicle several times."""

import math

import numpy as np

from beal.discretisation.assembly import gauss
from beal.discretisation.axial import axial_force
from beal.discretisation.basis import segments
from beal.vehicle.vehicle import Vehicle

HALF_WAVES = 5  # of the buckling shape whose thrust ends the search


def default_limit(vehicle: Vehicle) -> float:
    """Thrust, in N, at which a dead load would buckle the rigidly jointed vehicle in five half waves (WKB).

    integral of sqrt(N/EI) dx = 5 pi, with N = P n(x).
    """
    xi, weight = gauss(8)
    chain = segments(vehicle)
    start, length = np.array([(segment.start, segment.length) for segment in chain]).T[:, :, None]
    stiffness = np.array([[vehicle.stages[segment.stage].bending_stiffness] for segment in chain])
    density = np.sqrt(axial_force(vehicle, start + length * (1 + xi) / 2) / stiffness)
    phase = float(np.sum(length / 2 * density * weight))
    return (HALF_WAVES * math.pi / phase) ** 2
