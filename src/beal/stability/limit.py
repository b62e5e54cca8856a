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

    integral of sqrt(N/EI) dx = 5 pi, with N = P n(x). Where Engesser's axial force takes from the shear stiffness, the
    vehicle is softer, 1/P = 1/P_bending + max(n/kGA).
    """
    points = _points(vehicle)
    stiffness, shear = points.property("bending_stiffness"), points.property("shear_stiffness")
    force = np.abs(axial_force(vehicle, points.station))
    if not force.any():  # a thrust at the nose that holds it
        force = np.ones_like(force)
    phase = float(points.weight @ np.sqrt(force / stiffness))
    bending = (phase / (HALF_WAVES * math.pi)) ** 2
    shearing = float(np.max(force / shear)) if vehicle.thrust.axial_term == "engesser" else 0.0
    return 1 / (bending + shearing or _one_over_chain(vehicle))


def _one_over_chain(vehicle: Vehicle) -> float:
    """One over the thrust to which a chain of rigid stages is searched.

    Against rotation at its joints, none buckles above four times the stiffest spring over the shortest stage.
    """
    return min(stage.length for stage in vehicle.stages) * vehicle.length / (8 * vehicle.scales.bending_stiffness)


def waves(vehicle: Vehicle) -> Array:
    """Integral over each segment of (m/EI)^(1/4), the wave number at W = 1, shape (segments,)."""
    points = _points(vehicle)
    number = (points.property("mass_per_length") / points.property("bending_stiffness")) ** 0.25
    return np.asarray(np.bincount(points.segment, points.weight * number), dtype=np.float64)


def _points(vehicle: Vehicle) -> Points:
    """For integrals of which a few digits will do."""
    chain = segments(vehicle, few=ALL)
    return quadrature(vehicle, chain, 8, pieces(vehicle, chain, 5))
