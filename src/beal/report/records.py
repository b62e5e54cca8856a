"""Results as JSON objects, the same from the command and from the explorer."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from beal.stability.complete import Event
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve
from beal.stability.pencil import ComplexArray
from beal.stability.spectrum import Spectrum
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from beal.control import ClosedLoop, Margins
    from beal.design.pareto import ParetoFront
    from beal.design.sampling import Sample
    from beal.motion import Response
    from beal.study.flight import Flight, FlightState

QUANTILES = (0.01, 0.05, 0.5, 0.95)


def critical_record(vehicle: Vehicle, found: CriticalThrust) -> dict[str, Any]:
    """What ``beal critical --json`` says of the first instability.

    Parameters
    ----------
    vehicle : Vehicle
    found : CriticalThrust

    Returns
    -------
    dict
        The fields of the result; P L^2/EI and the margin over the nominal thrust, None where there is none.

    Examples
    --------
    >>> from beal.stability.critical import critical_thrust
    >>> from beal.vehicle.catalog import beck
    >>> critical_record(beck(), critical_thrust(beck()))["kind"]
    'flutter'
    """
    return {**asdict(found), **relative(vehicle, found), "units": vehicle.units}


def relative(vehicle: Vehicle, found: CriticalThrust) -> dict[str, float | None]:
    """P L^2/EI, and the margin over the nominal thrust."""
    thrust, nominal = found.critical_thrust, vehicle.thrust.nominal
    return {
        "nondimensional_thrust": None if thrust is None else thrust / vehicle.scales.thrust,
        "margin": None if thrust is None or nominal is None else thrust / nominal - 1,
    }


def event_record(event: Event) -> dict[str, Any]:
    """One change of stability, as ``beal critical --all --json`` lists it."""
    return {
        "thrust": event.thrust,
        "kind": event.kind,
        "modes": event.modes,
        "angular_frequency": math.sqrt(max(event.W, 0.0)),
        "change": event.change,
        "unstable": event.unstable,
    }


def curve_record(vehicle: Vehicle, found: ThrustCurve) -> dict[str, Any]:
    """What ``beal curve --json`` says."""
    names = ("thrust", "angular_frequency", "growth_rate", "formulation")
    return {**{name: getattr(found, name) for name in names}, "units": vehicle.units}


def modes_record(vehicle: Vehicle, found: Spectrum, error: Any, formulation: str) -> dict[str, Any]:
    """What ``beal modes --json`` says, in order of frequency.

    Parameters
    ----------
    vehicle : Vehicle
    found : Spectrum
    error : ndarray or None
        Of each angular frequency in ascending order.
    formulation : str

    Returns
    -------
    dict
    """
    order = found.angular_frequency.argsort(kind="stable")
    omega = found.angular_frequency[order]
    return {
        "angular_frequency": omega,
        **({"frequency_hz": omega / (2 * math.pi)} if vehicle.units == "SI" else {}),
        "growth_rate": found.growth_rate[order] + 0.0,  # no -0
        "error_estimate": error,
        "rigid_body_modes": found.rigid_body_modes,
        "thrust": found.thrust,
        "formulation": formulation,
        "units": vehicle.units,
    }


def sample_record(found: "Sample", thrust: float | None) -> dict[str, Any]:
    """What ``beal uncertainty --json`` says of random vehicles.

    Parameters
    ----------
    found : Sample
    thrust : float or None
        Whose probability of instability is told, in N.

    Returns
    -------
    dict
    """
    from beal.design.reliability import probability_of_instability, thrust_quantile

    quantiles = {q: thrust_quantile(found, q) for q in QUANTILES}
    return {
        "samples": found.count,
        "method": found.method,
        "seed": found.seed,
        "kind": found.kinds,
        "failed": found.failed,
        "searched_to": found.searched_to,
        "truncated": found.truncated,
        "thrust": thrust,
        "quantiles": [{"probability": q, **asdict(estimate)} for q, estimate in quantiles.items()],
        "probability_of_instability": None if thrust is None else asdict(probability_of_instability(found, thrust)),
    }


def front_record(found: "ParetoFront") -> dict[str, Any]:
    """A Pareto front as a JSON object.

    Parameters
    ----------
    found : ParetoFront

    Returns
    -------
    dict
        Under ``points`` the mass, critical thrust, kind and variables of each design, and whether it is at a cliff.
    """
    return {
        "points": [
            {
                "mass": point.mass,
                "critical_thrust": point.critical.critical_thrust,
                "kind": point.critical.kind,
                "cliff": point.cliff,
                "case": point.case,
                "values": point.values,
            }
            for point in found.points
        ],
        "targets": found.targets,
        "gaps": found.gaps,
        "units": found.units,
    }


def response_record(vehicle: Vehicle, found: "Response", growth: float | None) -> dict[str, Any]:
    """What ``beal response --json`` says.

    Parameters
    ----------
    vehicle : Vehicle
    found : Response
    growth : float or None
        Largest growth rate under a steady thrust, in 1/s.

    Returns
    -------
    dict
    """
    from beal.motion import PARTS, QUANTITIES

    whats = (*QUANTITIES, *PARTS)
    return {
        "time": found.time,
        "sensors": {name: {what: getattr(found, what)[n] for what in whats} for n, name in enumerate(found.sensors)},
        "method": found.method,
        "step": found.step,
        "thrust": found.thrust,
        "thrust_history": found.thrust_history,
        "growth_rate": growth,
        "units": vehicle.units,
    }


def flight_record(found: "Flight") -> dict[str, Any]:
    """What ``beal flight --json`` says: one list for each quantity, an entry for each time."""
    omega = found.angular_frequency
    return {
        "time": found.time,
        "thrust": found.thrust,
        "mass": found.mass,
        "stages": [stage_range(state) for state in found.states],
        "angular_frequency": omega,
        **({"frequency_hz": omega / (2 * math.pi)} if found.units == "SI" else {}),
        "critical_thrust": found.critical_thrust,
        "kind": [state.critical and state.critical.kind for state in found.states],
        "modes": [state.critical and state.critical.modes for state in found.states],
        "error_estimate": [state.critical and state.critical.error_estimate for state in found.states],
        "searched_to": found.searched_to,
        "margin": found.margin,
        "margin_is_lower_bound": found.at_least,
        "status": [state.status for state in found.states],
        "reason": [state.reason for state in found.states],
        "units": found.units,
    }


def stage_range(state: "FlightState") -> str:
    """The stages attached, as the model file names them: ``1-2``."""
    first, last = state.stages
    return f"{first}" if first == last else f"{first}-{last}"


def control_record(vehicle: Vehicle, found: "ClosedLoop", margins: "Margins") -> dict[str, Any]:
    """What ``beal control --json`` says.

    Parameters
    ----------
    vehicle : Vehicle
    found : ClosedLoop
    margins : Margins

    Returns
    -------
    dict
    """
    root = found.least_damped
    least = {
        "root": [root.real, root.imag],
        "angular_frequency": abs(root.imag),
        "damping_ratio": -root.real / abs(root) if root else 0.0,
    }
    gain = [{**asdict(margin), "decibel": margin.decibel} for margin in margins.gain]
    phase = [{**asdict(margin), "delay": margin.delay} for margin in margins.phase]
    return {
        "thrust": found.thrust,
        "roots": pairs(found.roots),
        "stable": found.stable,
        "rigid_body_roots": pairs(found.rigid_body_roots),
        "least_damped": least,
        "margins": {"gain": gain, "phase": phase},
        "error_estimate": found.error_estimate,
        "units": vehicle.units,
    }


def pairs(numbers: ComplexArray) -> list[list[float]]:
    """Complex numbers as JSON has them: real and imaginary parts, in the same order."""
    return [[number.real, number.imag] for number in numbers.tolist()]
