"""The verdict on a vehicle in words."""

import math

from beal.design.sensitivity import Rival
from beal.report.numbers import quantity
from beal.report.records import relative
from beal.stability.critical import CriticalThrust
from beal.vehicle.vehicle import Vehicle

BEYOND = 1.3  # last thrust of a curve, over the critical one


def verdict(vehicle: Vehicle, found: CriticalThrust) -> str:
    """The whole sentence, with the vehicle's title and with what a tumbling vehicle's elastic modes bear.

    Parameters
    ----------
    vehicle : Vehicle
    found : CriticalThrust

    Returns
    -------
    str

    Examples
    --------
    >>> from beal.stability.critical import critical_thrust
    >>> from beal.vehicle.catalog import beck
    >>> verdict(beck(), critical_thrust(beck()))
    "Beck's column: flutters at P L^2/EI = 20.0509536: modes 1 and 2 meet at an angular frequency of 11.0156"
    """
    if found.elastic is not None:
        elastic = instability(vehicle, found.elastic)
        return f"tumbles as a rigid body under any thrust; its elastic modes alone: {elastic}"
    return f"{vehicle.title}: {instability(vehicle, found)}" if vehicle.title else instability(vehicle, found)


def instability(vehicle: Vehicle, found: CriticalThrust) -> str:
    """One sentence: how, at which thrust, in which modes, at which frequency, with which margin."""
    thrust, unit = found.critical_thrust, thrust_unit(vehicle)
    if thrust is None or found.modes is None or found.angular_frequency is None:
        return f"stable up to {quantity(found.searched_to, unit)}, as far as was searched"
    if thrust == 0 and found.angular_frequency:
        return f"flutters under any thrust: damping feeds {_mode(found.modes[0])}"
    if thrust == 0:
        return "is unstable at any thrust: it folds or slides without resistance"
    scale = vehicle.scales.thrust
    group = quantity(thrust / scale, "", None if found.error_estimate is None else found.error_estimate / scale)
    value = f"P L^2/EI = {group}"
    if unit or scale != 1:
        value = f"{quantity(thrust, unit, found.error_estimate)} ({value})"
    if found.kind == "flutter":
        text = f"flutters at {value}: {_meeting(found.modes)} at {_frequency(vehicle, found.angular_frequency)}"
    else:
        text = f"diverges at {value}: the frequency of {_mode(found.modes[0])} falls to zero"
    margin = relative(vehicle, found)["margin"]
    if margin is None:
        return text
    return (
        f"{text}; margin {100 * margin:+.2f} % over the nominal thrust {quantity(vehicle.thrust.nominal or 0.0, unit)}"
    )


def close_by(rival: Rival) -> str:
    """What else changes near a critical thrust, and how near."""
    event = rival.event
    modes = " and ".join(map(str, dict.fromkeys(event.modes)))
    change = "comes" if event.change == "destabilises" else "ends"
    return f"close by: {event.kind} of modes {modes} {change} {100 * rival.distance:.2g} % above"


def thrust_unit(vehicle: Vehicle) -> str:
    """N, or nothing where the vehicle is nondimensional."""
    return "N" if vehicle.units == "SI" else ""


def _meeting(pair: tuple[int, int]) -> str:
    if pair[0] == pair[1]:  # damped
        return f"{_mode(pair[0])} begins to grow"
    return f"modes {pair[0]} and {pair[1]} meet" if all(pair) else f"the rigid-body motion and mode {max(pair)} meet"


def _mode(number: int) -> str:
    return f"mode {number}" if number else "the rigid-body motion"


def _frequency(vehicle: Vehicle, omega: float) -> str:
    if vehicle.units == "SI":
        return f"{omega / (2 * math.pi):.6g} Hz ({omega:.6g} rad/s)"
    return f"an angular frequency of {omega:.6g}"


def searched(vehicle: Vehicle, found: CriticalThrust) -> str:
    """What was looked at to come to the verdict."""
    reached = found.elastic or found
    text = f"searched: the {found.watched_modes} lowest elastic modes"
    text += f" up to {quantity(found.searched_to, thrust_unit(vehicle))}, formulation {found.formulation}"
    if reached.critical_thrust and reached.error_estimate is not None:
        text += f", relative error about {reached.error_estimate / reached.critical_thrust:.0e}"
    return text


def convention(vehicle: Vehicle, formulation: str) -> str:
    """Which couple a joint that slides under the axial force carries."""
    if not any(math.isfinite(joint.shear_stiffness) for joint in vehicle.joints):
        return ""
    if formulation != "objective":
        return "joints: shear axis inertial, by the formulation (such a joint does not balance moments)"
    axes = {joint.shear_axis for joint in vehicle.joints if math.isfinite(joint.shear_stiffness)}
    if len(axes) == 1:
        warning = " (such a joint does not balance moments)" if "inertial" in axes else ""
        return f"joints: shear axis {axes.pop()}{warning}"
    return "joints: shear axes " + ", ".join(joint.shear_axis for joint in vehicle.joints) + ", from nose to tail"


def shown_to(found: CriticalThrust) -> float:
    """To which thrust a curve shows what happens.

    Parameters
    ----------
    found : CriticalThrust

    Returns
    -------
    float
        In N.
    """
    first = found.elastic or found
    return BEYOND * first.critical_thrust if first.critical_thrust else first.searched_to
