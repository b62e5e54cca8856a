"""Axial force per thrust, n(x) = N(x)/P, compression positive.

d'Alembert for a vehicle in flight: the share of the mass forward of x (Wu 1975; Irani & Kavianipour 2009, Eq. (3), for
uniform stages), less what acts there itself. Where the nose takes the reaction, all that acts aft of x.
"""

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.stations import StationTable, integral, mean
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
SAME = 1e-12  # share of the length within which a mass sits at a joint, as in Vehicle.stage_at


def axial_force(vehicle: Vehicle, stations: Array) -> Array:
    """n at stations, in any shape; at a point mass or a thrust the value just aft of it."""
    at = vehicle.thrust.station
    applied = _distributed_forward(vehicle, stations)
    if at is not None and at < vehicle.length:
        applied = applied + np.where(stations >= at, vehicle.thrust.scale, 0.0)
    if vehicle.axial_force == "constant":
        return np.full(stations.shape, _total(vehicle)) - applied
    return np.asarray(_mass_forward(vehicle, stations) * acceleration(vehicle) - applied)


def axial_force_in_joints(vehicle: Vehicle) -> Array:
    """n in every joint, shape (joints,); what acts at a joint sits on the aft face and does not press on it."""
    stations = np.array(vehicle.boundaries[1:-1])
    applied = _distributed_forward(vehicle, stations)
    if vehicle.thrust.station is not None:
        applied = applied + np.where(stations > vehicle.thrust.station + SAME * vehicle.length, vehicle.thrust.scale, 0)
    if vehicle.axial_force == "constant":
        return np.full(stations.shape, _total(vehicle)) - applied
    return np.asarray(_mass_forward_of_joints(vehicle) * acceleration(vehicle) - applied)


def acceleration(vehicle: Vehicle) -> float:
    """Along the axis, per thrust, in 1/kg; zero where a support bears the thrust."""
    return _total(vehicle) / vehicle.mass if vehicle.axial_force == "inertia" else 0.0


def has_dead_loads(vehicle: Vehicle) -> bool:
    """Whether loads that do not grow with the thrust press on the vehicle."""
    return bool(vehicle.axial_loads) or (vehicle.gravity != 0 and vehicle.axial_force == "constant")


def dead_axial_force(vehicle: Vehicle, stations: Array) -> Array:
    """Axial force of the dead loads at stations, in N, in any shape."""
    applied = _axial_loads_forward(vehicle, stations)
    return _dead(vehicle, applied, _mass_forward(vehicle, stations))


def dead_axial_force_in_joints(vehicle: Vehicle) -> Array:
    """The same in every joint, shape (joints,)."""
    applied = _axial_loads_forward(vehicle, np.array(vehicle.boundaries[1:-1]) - SAME * vehicle.length)
    return _dead(vehicle, applied, _mass_forward_of_joints(vehicle))


def _axial_loads_forward(vehicle: Vehicle, stations: Array) -> Array:
    applied = np.zeros(stations.shape)
    for load in vehicle.axial_loads:
        applied += load.force * (stations >= load.station)
    return applied


def _dead(vehicle: Vehicle, applied: Array, mass_forward: Array) -> Array:
    """From what acts forward of stations: borne by inertia, by the nose, or by the tail where it alone is held."""
    total = sum(load.force for load in vehicle.axial_loads)
    if vehicle.axial_force == "inertia":
        return np.asarray(total / vehicle.mass * mass_forward - applied)
    applied = applied - vehicle.gravity * mass_forward
    nose, tail = (any(end) for end in vehicle.support.stiffness)
    return np.asarray((0.0 if tail and not nose else total - vehicle.gravity * vehicle.mass) - applied)


def _mass_forward(vehicle: Vehicle, stations: Array) -> Array:
    forward = np.interp(stations, vehicle.boundaries, _stages_forward(vehicle))
    for n, stage in enumerate(vehicle.laden):
        if isinstance(stage.mass_per_length, StationTable):
            front, back = vehicle.boundaries[n : n + 2]
            here = (stations >= front) & (stations <= back)
            forward[here] = _stages_forward(vehicle)[n] + stage.mass_per_length.integral(stations[here] - front)
    if vehicle.point_masses:
        lumps = sorted((lump.station, lump.mass) for lump in vehicle.point_masses)
        fore = np.cumsum([0.0] + [mass for _, mass in lumps])
        forward = forward + fore[np.searchsorted([station for station, _ in lumps], stations, side="right")]
    return np.asarray(forward)


def _mass_forward_of_joints(vehicle: Vehicle) -> Array:
    forward = _stages_forward(vehicle)[1:-1]
    if vehicle.point_masses:
        snapped = np.array([lump.station for lump in vehicle.point_masses]) + SAME * vehicle.length
        stages = np.searchsorted(vehicle.boundaries[1:-1], snapped, side="right")
        lumps = np.bincount(stages, [lump.mass for lump in vehicle.point_masses], len(vehicle.stages))
        forward = forward + np.cumsum(lumps)[:-1]
    return np.asarray(forward)


def _total(vehicle: Vehicle) -> float:
    """All loads along the axis over P."""
    distributed = sum(vehicle.length * mean(load.value) for load in vehicle.distributed_thrusts)
    return vehicle.thrust.scale + distributed


def _distributed_forward(vehicle: Vehicle, stations: Array) -> Array | float:
    """The part of the distributed loads that acts forward of stations, over P."""
    return sum((integral(load.value, stations) for load in vehicle.distributed_thrusts), 0.0)


def _stages_forward(vehicle: Vehicle) -> Array:
    """Mass of the stages forward of each boundary, shape (stages + 1,)."""
    return np.cumsum([0.0] + [stage.mass for stage in vehicle.laden])
