"""beal: whether a flexible launch vehicle under thrust stays stable, where it fails and how.

Names are imported when they are first used, so that the command answers at once.
"""

import typing as _typing
from importlib import import_module as _import_module
from importlib.metadata import version as _version

if _typing.TYPE_CHECKING:
    from beal import plot
    from beal.control import (
        ClosedLoop,
        ControlledThrust,
        ControlLocus,
        Margins,
        StateSpace,
        closed_loop,
        control_locus,
        controlled_thrust,
        stability_margins,
        state_space,
    )
    from beal.design.optimise import Optimum, optimise
    from beal.design.ranges import AllowedInterval, AllowedRange, allowed_range
    from beal.design.variables import DesignSpace, LinearBound, Link, Variable
    from beal.discretisation.build import discretise
    from beal.discretisation.operators import Operators
    from beal.errors import BealError, ConvergenceError, ModelError
    from beal.interop.files import load
    from beal.motion import (
        AmplitudeMap,
        ModeShape,
        PulsatingThrust,
        Release,
        Response,
        Samples,
        State,
        ThrustTable,
        TransientGrowth,
        amplitude_map,
        amplitude_spectrum,
        envelope,
        growth_rate,
        response,
        transient_growth,
    )
    from beal.stability.complete import Event
    from beal.stability.critical import CriticalThrust, critical_events, critical_thrust
    from beal.stability.curve import ThrustCurve, thrust_curve
    from beal.stability.floquet import Floquet, floquet
    from beal.stability.resonances import Resonance
    from beal.stability.spectrum import Spectrum, spectrum
    from beal.stability.vanishing import vanishing_damping_limit
    from beal.study.flight import Flight, FlightState, flight
    from beal.study.map import stability_map
    from beal.study.pulsating import floquet_chart
    from beal.study.refined import RefinedMap, refined_map
    from beal.vehicle import catalog
    from beal.vehicle.control import Control, Filter, Gain
    from beal.vehicle.file import dumps, loads
    from beal.vehicle.parts import (
        AxialLoad,
        Damping,
        DistributedThrust,
        ElasticEnd,
        Force,
        Joint,
        PointMass,
        Sensor,
        Stage,
        Support,
        Thrust,
    )
    from beal.vehicle.tanks import Tank
    from beal.vehicle.timeline import Timeline
    from beal.vehicle.vehicle import Vehicle
    from beal.verification.run import verify

__version__ = _version("beal")

_HOMES = {
    "AllowedInterval": "beal.design.ranges",
    "AllowedRange": "beal.design.ranges",
    "AmplitudeMap": "beal.motion",
    "AxialLoad": "beal.vehicle.parts",
    "BealError": "beal.errors",
    "ClosedLoop": "beal.control",
    "Control": "beal.vehicle.control",
    "ControlLocus": "beal.control",
    "ControlledThrust": "beal.control",
    "ConvergenceError": "beal.errors",
    "CriticalThrust": "beal.stability.critical",
    "Damping": "beal.vehicle.parts",
    "DesignSpace": "beal.design.variables",
    "DistributedThrust": "beal.vehicle.parts",
    "ElasticEnd": "beal.vehicle.parts",
    "Event": "beal.stability.complete",
    "Filter": "beal.vehicle.control",
    "Flight": "beal.study.flight",
    "FlightState": "beal.study.flight",
    "Floquet": "beal.stability.floquet",
    "Force": "beal.vehicle.parts",
    "Gain": "beal.vehicle.control",
    "Joint": "beal.vehicle.parts",
    "LinearBound": "beal.design.variables",
    "Link": "beal.design.variables",
    "Margins": "beal.control",
    "ModeShape": "beal.motion",
    "ModelError": "beal.errors",
    "Operators": "beal.discretisation.operators",
    "Optimum": "beal.design.optimise",
    "PointMass": "beal.vehicle.parts",
    "PulsatingThrust": "beal.motion",
    "RefinedMap": "beal.study.refined",
    "Release": "beal.motion",
    "Resonance": "beal.stability.resonances",
    "Response": "beal.motion",
    "Samples": "beal.motion",
    "Sensor": "beal.vehicle.parts",
    "Spectrum": "beal.stability.spectrum",
    "Stage": "beal.vehicle.parts",
    "State": "beal.motion",
    "StateSpace": "beal.control",
    "Support": "beal.vehicle.parts",
    "Tank": "beal.vehicle.tanks",
    "Thrust": "beal.vehicle.parts",
    "ThrustCurve": "beal.stability.curve",
    "ThrustTable": "beal.motion",
    "Timeline": "beal.vehicle.timeline",
    "TransientGrowth": "beal.motion",
    "Variable": "beal.design.variables",
    "Vehicle": "beal.vehicle.vehicle",
    "allowed_range": "beal.design.ranges",
    "amplitude_map": "beal.motion",
    "amplitude_spectrum": "beal.motion",
    "catalog": "beal.vehicle.catalog",
    "closed_loop": "beal.control",
    "control_locus": "beal.control",
    "controlled_thrust": "beal.control",
    "critical_events": "beal.stability.critical",
    "critical_thrust": "beal.stability.critical",
    "discretise": "beal.discretisation.build",
    "dumps": "beal.vehicle.file",
    "envelope": "beal.motion",
    "flight": "beal.study.flight",
    "floquet": "beal.stability.floquet",
    "floquet_chart": "beal.study.pulsating",
    "growth_rate": "beal.motion",
    "load": "beal.interop.files",
    "loads": "beal.vehicle.file",
    "optimise": "beal.design.optimise",
    "plot": "beal.plot",
    "refined_map": "beal.study.refined",
    "response": "beal.motion",
    "spectrum": "beal.stability.spectrum",
    "stability_map": "beal.study.map",
    "stability_margins": "beal.control",
    "state_space": "beal.control",
    "thrust_curve": "beal.stability.curve",
    "transient_growth": "beal.motion",
    "vanishing_damping_limit": "beal.stability.vanishing",
    "verify": "beal.verification.run",
}

__all__ = [
    "AllowedInterval",
    "AllowedRange",
    "AmplitudeMap",
    "AxialLoad",
    "BealError",
    "ClosedLoop",
    "Control",
    "ControlLocus",
    "ControlledThrust",
    "ConvergenceError",
    "CriticalThrust",
    "Damping",
    "DesignSpace",
    "DistributedThrust",
    "ElasticEnd",
    "Event",
    "Filter",
    "Flight",
    "FlightState",
    "Floquet",
    "Force",
    "Gain",
    "Joint",
    "LinearBound",
    "Link",
    "Margins",
    "ModeShape",
    "ModelError",
    "Operators",
    "Optimum",
    "PointMass",
    "PulsatingThrust",
    "RefinedMap",
    "Release",
    "Resonance",
    "Response",
    "Samples",
    "Sensor",
    "Spectrum",
    "Stage",
    "State",
    "StateSpace",
    "Support",
    "Tank",
    "Thrust",
    "ThrustCurve",
    "ThrustTable",
    "Timeline",
    "TransientGrowth",
    "Variable",
    "Vehicle",
    "allowed_range",
    "amplitude_map",
    "amplitude_spectrum",
    "catalog",
    "closed_loop",
    "control_locus",
    "controlled_thrust",
    "critical_events",
    "critical_thrust",
    "discretise",
    "dumps",
    "envelope",
    "flight",
    "floquet",
    "floquet_chart",
    "growth_rate",
    "load",
    "loads",
    "optimise",
    "plot",
    "refined_map",
    "response",
    "spectrum",
    "stability_map",
    "stability_margins",
    "state_space",
    "thrust_curve",
    "transient_growth",
    "vanishing_damping_limit",
    "verify",
]


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module 'beal' has no attribute {name!r}")
    module = _import_module(_HOMES[name])
    value = getattr(module, name, module)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
