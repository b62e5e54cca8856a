"""The resolved model: what a vehicle adds up to."""

import math
from typing import Any

from beal.vehicle.parts import ElasticEnd, Joint
from beal.vehicle.stations import Property, StationTable
from beal.vehicle.vehicle import Vehicle

UNITS = {  # of what a summary holds, in SI
    "length": "m",
    "mass": "kg",
    "centre_of_mass": "m",
    "moment_of_inertia": "kg m^2",
    "nominal_thrust": "N",
    "thrust_station": "m",
    "gravity": "m/s^2",
    "force": "N",
    "value": "1/m",
    "from": "m",
    "to": "m",
    "station": "m",
    "surface": "m",
    "mass_per_length": "kg/m",
    "bending_stiffness": "N m^2",
    "internal_damping": "s",
    "external_damping": "N s/m^2",
    "foundation_stiffness": "N/m^2",
    "rotary_inertia": "kg m^2",
    "rotary_inertia_per_length": "kg m",
    "rotational_stiffness": "N m/rad",
    "shear_stiffness": "N/m",
    "rotational_damping": "N m s/rad",
    "shear_damping": "N s/m",
    "reference_length": "m",
    "reference_mass_per_length": "kg/m",
    "reference_bending_stiffness": "N m^2",
    "thrust_scale": "N",
    "time_scale": "s",
}
OF_STAGES = {"shear_stiffness": "N"}  # where joints have the same name for another quantity


def summary(vehicle: Vehicle) -> dict[str, Any]:
    """Lengths, masses, joints and non-dimensional groups of a vehicle, ready for JSON.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    dict
        Quantities in SI units, or non-dimensional where the vehicle is. Under ``nondimensional`` the groups of Irani &
        Kavianipour (2009), Eq. (6), and the reference quantities that they are formed with: the whole length and the
        properties of the first stage that bends. An infinite stiffness is the text ``"rigid"``.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> resolved = summary(tsto(0.6, 5000.0, float("inf")))
    >>> resolved["centre_of_mass"], resolved["joints"][0]["station"]
    (0.5, 0.6)
    >>> resolved["nondimensional"]["joints"]
    [{'rotational_stiffness': 5000.0, 'shear_stiffness': 'rigid'}]
    """
    return {
        "title": vehicle.title,
        "units": vehicle.units,
        "length": vehicle.length,
        "mass": vehicle.mass,
        "centre_of_mass": vehicle.centre_of_mass,
        "moment_of_inertia": vehicle.moment_of_inertia,
        "support": {"nose": _end(vehicle.support.nose), "tail": _end(vehicle.support.tail)},
        "axial_force": vehicle.axial_force,
        "tangency": vehicle.thrust.tangency,
        "along": vehicle.thrust.along,
        "axial_term": vehicle.thrust.axial_term,
        "thrust_station": vehicle.length if vehicle.thrust.station is None else vehicle.thrust.station,
        "thrust_share": vehicle.thrust.scale,
        "nominal_thrust": vehicle.thrust.nominal,
        "thrust_signal": vehicle.thrust.signal and vehicle.thrust.signal.model_dump(),
        "damping_ratios": vehicle.damping.ratios,
        "stages": _stages(vehicle),
        "joints": _joints(vehicle),
        "gravity": vehicle.gravity,
        "distributed_thrusts": [part.model_dump() for part in vehicle.distributed_thrusts],
        "axial_loads": [part.model_dump() for part in vehicle.axial_loads],
        "point_masses": [part.model_dump() for part in vehicle.point_masses],
        "tanks": _tanks(vehicle),
        "sensors": [part.model_dump() for part in vehicle.sensors],
        "control": vehicle.control and vehicle.control.model_dump(exclude={"gains", "filters"}),
        "gains": [part.model_dump() for part in vehicle.control.gains] if vehicle.control else [],
        "filters": [part.model_dump() for part in vehicle.control.filters] if vehicle.control else [],
        "timeline": _timeline(vehicle),
        "nondimensional": _groups(vehicle),
    }


def _stages(vehicle: Vehicle) -> list[dict[str, Any]]:
    ends = zip(vehicle.stages, vehicle.boundaries, vehicle.boundaries[1:], strict=False)
    return [
        {
            "name": stage.name,
            "from": start,
            "to": end,
            "mass": stage.mass,
            "mass_per_length": _property(stage.mass_per_length),
            "bending_stiffness": _property(stage.bending_stiffness),
            "shear_stiffness": _property(stage.shear_stiffness),
            "rotary_inertia_per_length": _property(stage.rotary_inertia_per_length),
            "internal_damping": stage.internal_damping,
            "external_damping": stage.external_damping,
            "foundation_stiffness": _property(stage.foundation_stiffness),
        }
        for stage, start, end in ends
    ]


def _tanks(vehicle: Vehicle) -> list[dict[str, Any]]:
    return [
        {
            "name": tank.name,
            "from": tank.forward_end,
            "to": tank.aft_end,
            "fill": tank.fill,
            "surface": tank.surface,
            "mass": tank.mass,
        }
        for tank in vehicle.tanks
    ]


def _timeline(vehicle: Vehicle) -> dict[str, float] | None:
    if vehicle.timeline is None:
        return None
    time = vehicle.timeline.time
    return {"times": len(time), "from": time[0], "to": time[-1]}


def _property(given: Property) -> float | str | dict[str, Any]:
    return given.model_dump() if isinstance(given, StationTable) else _finite(given)


def _finite(stiffness: float) -> float | str:
    """JSON has no infinity."""
    return "rigid" if math.isinf(stiffness) else stiffness


def _end(end: str | ElasticEnd) -> str | dict[str, float | str]:
    if isinstance(end, str):
        return end
    return {name: _finite(value) for name, value in end.model_dump().items()}


def _joints(vehicle: Vehicle) -> list[dict[str, Any]]:
    return [
        {
            "name": joint.name,
            "station": station,
            "shear_axis": joint.shear_axis,
            **_springs(joint, 1.0, 1.0),
            "rotational_damping": joint.rotational_damping,
            "shear_damping": joint.shear_damping,
        }
        for joint, station in zip(vehicle.joints, vehicle.boundaries[1:], strict=False)
    ]


def _groups(vehicle: Vehicle) -> dict[str, Any]:
    """k_r L/EI, k_s L^3/EI, P L^2/EI and the scales themselves."""
    scales = vehicle.scales
    rotational, shear = scales.thrust * scales.length, scales.thrust / scales.length
    nominal = vehicle.thrust.nominal
    return {
        "reference_length": scales.length,
        "reference_mass_per_length": scales.mass_per_length,
        "reference_bending_stiffness": scales.bending_stiffness,
        "thrust_scale": scales.thrust,
        "time_scale": scales.time,
        "nominal_thrust": None if nominal is None else nominal / scales.thrust,
        "joints": [_springs(joint, rotational, shear) for joint in vehicle.joints],
    }


def _springs(joint: Joint, rotational: float, shear: float) -> dict[str, float | str]:
    """Stiffnesses over their scales."""
    return {
        "rotational_stiffness": _finite(joint.rotational_stiffness / rotational),
        "shear_stiffness": _finite(joint.shear_stiffness / shear),
    }
