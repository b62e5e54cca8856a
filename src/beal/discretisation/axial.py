"""Axial force per thrust, n(x) = N(x)/P, compression positive.

d'Alembert for a vehicle in flight: the share of the mass forward of x (Wu 1975; Irani & Kavianipour 2009, Eq. (3), for
uniform stages). Constant where the nose takes the reaction.
"""

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.stations import integral
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
SAME = 1e-12  # share of the length within which a mass sits at a joint, as in Vehicle.stage_at


def axial_force(vehicle: Vehicle, stations: Array) -> Array:
    """n at stations, in any shape; at a point mass the value just aft of it."""
    if vehicle.axial_force == "constant":
        return np.ones_like(stations)
    forward = np.interp(stations, vehicle.boundaries, _stages_forward(vehicle))
    for n, stage in enumerate(vehicle.stages):
        if "mass_per_length" in stage.tables:
            front, back = vehicle.boundaries[n : n + 2]
            here = (stations >= front) & (stations <= back)
            inside = integral(stage.mass_per_length, stations[here] - front)
            forward[here] = _stages_forward(vehicle)[n] + inside
    if vehicle.point_masses:
        lumps = sorted((lump.station, lump.mass) for lump in vehicle.point_masses)
        fore = np.cumsum([0.0] + [mass for _, mass in lumps])
        forward = forward + fore[np.searchsorted([station for station, _ in lumps], stations, side="right")]
    return np.asarray(forward / vehicle.mass)


def axial_force_in_joints(vehicle: Vehicle) -> Array:
    """n in every joint, shape (joints,); a point mass at a joint sits on the aft face and does not press on it."""
    if vehicle.axial_force == "constant":
        return np.ones(len(vehicle.joints))
    forward = _stages_forward(vehicle)[1:-1]
    if vehicle.point_masses:
        snapped = np.array([lump.station for lump in vehicle.point_masses]) + SAME * vehicle.length
        stages = np.searchsorted(vehicle.boundaries[1:-1], snapped, side="right")
        lumps = np.bincount(stages, [lump.mass for lump in vehicle.point_masses], len(vehicle.stages))
        forward = forward + np.cumsum(lumps)[:-1]
    return np.asarray(forward / vehicle.mass)


def _stages_forward(vehicle: Vehicle) -> Array:
    """Mass of the stages forward of each boundary, shape (stages + 1,)."""
    return np.cumsum([0.0] + [stage.mass for stage in vehicle.stages])
