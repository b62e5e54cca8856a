"""Axial force per thrust, n(x) = N(x)/P, compression positive.

d'Alembert for a vehicle in flight: the share of the mass forward of x (Wu 1975; Irani & Kavianipour 2009, Eq. (3), for
uniform stages). Constant where the nose takes the reaction.
"""

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]


def axial_force(vehicle: Vehicle, stations: Array) -> Array:
    """n at stations, in any shape; at a point mass the value just aft of it."""
    if vehicle.axial_force == "constant":
        return np.ones_like(stations)
    forward = np.zeros_like(stations)
    for front, stage in zip(vehicle.boundaries, vehicle.stages, strict=False):
        forward += stage.mass_per_length * np.clip(stations - front, 0.0, stage.length)
    for lump in vehicle.point_masses:
        forward += lump.mass * (stations >= lump.station)
    return forward / vehicle.mass


def axial_force_in_joint(vehicle: Vehicle, joint: int) -> float:
    """n in a joint; a point mass at its station sits on the aft face and does not press on it."""
    if vehicle.axial_force == "constant":
        return 1.0
    stages = sum(stage.length * stage.mass_per_length for stage in vehicle.stages[: joint + 1])
    lumps = sum(lump.mass for lump in vehicle.point_masses if vehicle.stage_at(lump.station) <= joint)
    return (stages + lumps) / vehicle.mass
