"""How far to search: the thrust at which a dead load would have buckled the vehicle several times."""

import math

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.axial import axial_force
from beal.discretisation.basis import segments
from beal.discretisation.cuts import ALL
from beal.discretisation.quadrature import Points, quadrature
from beal.discretisation.varying import pieces
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
HALF_WAVES = 5  # of the buckling shape whose thrust ends the search


def default_limit(vehicle: Vehicle) -> float:
    """Thrust, in N, at which a dead load would buckle the rigidly jointed vehicle in five half waves (WKB).

    integral of sqrt(N/EI) dx = 5 pi, with N = P n(x).
    """
    points = _points(vehicle)
    stiffness = points.property("bending_stiffness")
    phase = float(points.weight @ np.sqrt(np.abs(axial_force(vehicle, points.station)) / stiffness))
    phase = phase or float(points.weight @ np.sqrt(1 / stiffness))  # a thrust at the nose that holds it
    return (HALF_WAVES * math.pi / phase) ** 2


def waves(vehicle: Vehicle) -> Array:
    """Integral over each segment of (m/EI)^(1/4), the wave number at W = 1, shape (segments,)."""
    points = _points(vehicle)
    number = (points.property("mass_per_length") / points.property("bending_stiffness")) ** 0.25
    return np.asarray(np.bincount(points.segment, points.weight * number), dtype=np.float64)


def _points(vehicle: Vehicle) -> Points:
    """For integrals of which a few digits will do."""
    chain = segments(vehicle, few=ALL)
    return quadrature(vehicle, chain, 8, pieces(vehicle, chain, 5))
