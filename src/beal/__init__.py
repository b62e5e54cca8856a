"""beal: whether a flexible launch vehicle under thrust stays stable, where it fails and how.

Names are imported when they are first used, so that the command answers at once.
"""

import typing as _typing
from importlib import import_module as _import_module
from importlib.metadata import version as _version

from beal.shown import painted_by as _painted_by

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
        control_map,
        controlled_thrust,
        open_loop,
        stability_margins,
        state_space,
    )
    from beal.design.answer import DesignAnswer, design_answer
    from beal.design.border import BorderPiece, SpringBorder, spring_border
    from beal.design.cases import flight_cases, sample_cases, tolerance_cases, vertex_cases
    from beal.design.cutting import robust_optimum
    from beal.design.design_file import DesignStudy, load_design
    from beal.design.distributions import Distribution
    from beal.design.frequencies import FrequencySensitivity, frequency_sensitivity
    from beal.design.gradient import CriticalGradient, CriticalHessian, critical_gradient, critical_hessian
    from beal.design.indices import MorrisEffects, SobolIndices, morris_effects, sobol_indices, thrust_output
    from beal.design.mdo import StabilityComponent
    from beal.design.optimise import Optimum, optimise
    from beal.design.pareto import ParetoFront, pareto
    from beal.design.ranges import AllowedInterval, AllowedRange, allowed_range
    from beal.design.reliability import Estimate, probability_of_instability, thrust_quantile
    from beal.design.robust import Scenario, WorstCase, scenarios, worst_case
    from beal.design.sampling import Sample, sample
    from beal.design.sensitivity import Parameter, Rival, Sensitivity, sensitivity
    from beal.design.touches import Touch
    from beal.design.uncertain import Uncertain
    from beal.design.variables import DesignSpace, LinearBound, Variable
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
        SignalThrust,
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
    from beal.notebook.explore import explore
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
    from beal.vehicle.control import Actuator, Control, Engine, Filter, Gain
    from beal.vehicle.file import dumps, loads
    from beal.vehicle.links import Link
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
    "Actuator": "beal.vehicle.control",
    "AllowedInterval": "beal.design.ranges",
    "AllowedRange": "beal.design.ranges",
    "AmplitudeMap": "beal.motion",
    "AxialLoad": "beal.vehicle.parts",
    "BealError": "beal.errors",
    "BorderPiece": "beal.design.border",
    "ClosedLoop": "beal.control",
    "Control": "beal.vehicle.control",
    "ControlLocus": "beal.control",
    "ControlledThrust": "beal.control",
    "ConvergenceError": "beal.errors",
    "CriticalGradient": "beal.design.gradient",
    "CriticalHessian": "beal.design.gradient",
    "CriticalThrust": "beal.stability.critical",
    "Damping": "beal.vehicle.parts",
    "DesignAnswer": "beal.design.answer",
    "DesignSpace": "beal.design.variables",
    "DesignStudy": "beal.design.design_file",
    "DistributedThrust": "beal.vehicle.parts",
    "Distribution": "beal.design.distributions",
    "ElasticEnd": "beal.vehicle.parts",
    "Engine": "beal.vehicle.control",
    "Estimate": "beal.design.reliability",
    "Event": "beal.stability.complete",
    "Filter": "beal.vehicle.control",
    "Flight": "beal.study.flight",
    "FlightState": "beal.study.flight",
    "Floquet": "beal.stability.floquet",
    "Force": "beal.vehicle.parts",
    "FrequencySensitivity": "beal.design.frequencies",
    "Gain": "beal.vehicle.control",
    "Joint": "beal.vehicle.parts",
    "LinearBound": "beal.design.variables",
    "Link": "beal.vehicle.links",
    "Margins": "beal.control",
    "ModeShape": "beal.motion",
    "ModelError": "beal.errors",
    "MorrisEffects": "beal.design.indices",
    "Operators": "beal.discretisation.operators",
    "Optimum": "beal.design.optimise",
    "Parameter": "beal.design.sensitivity",
    "ParetoFront": "beal.design.pareto",
    "PointMass": "beal.vehicle.parts",
    "PulsatingThrust": "beal.motion",
    "RefinedMap": "beal.study.refined",
    "Release": "beal.motion",
    "Resonance": "beal.stability.resonances",
    "Response": "beal.motion",
    "Rival": "beal.design.sensitivity",
    "Sample": "beal.design.sampling",
    "Samples": "beal.motion",
    "Scenario": "beal.design.robust",
    "Sensitivity": "beal.design.sensitivity",
    "Sensor": "beal.vehicle.parts",
    "SignalThrust": "beal.motion",
    "SobolIndices": "beal.design.indices",
    "Spectrum": "beal.stability.spectrum",
    "SpringBorder": "beal.design.border",
    "StabilityComponent": "beal.design.mdo",
    "Stage": "beal.vehicle.parts",
    "State": "beal.motion",
    "StateSpace": "beal.control",
    "Support": "beal.vehicle.parts",
    "Tank": "beal.vehicle.tanks",
    "Thrust": "beal.vehicle.parts",
    "ThrustCurve": "beal.stability.curve",
    "ThrustTable": "beal.motion",
    "Timeline": "beal.vehicle.timeline",
    "Touch": "beal.design.touches",
    "TransientGrowth": "beal.motion",
    "Uncertain": "beal.design.uncertain",
    "Variable": "beal.design.variables",
    "Vehicle": "beal.vehicle.vehicle",
    "WorstCase": "beal.design.robust",
    "allowed_range": "beal.design.ranges",
    "amplitude_map": "beal.motion",
    "amplitude_spectrum": "beal.motion",
    "catalog": "beal.vehicle.catalog",
    "closed_loop": "beal.control",
    "control_locus": "beal.control",
    "control_map": "beal.control",
    "controlled_thrust": "beal.control",
    "critical_events": "beal.stability.critical",
    "critical_gradient": "beal.design.gradient",
    "critical_hessian": "beal.design.gradient",
    "critical_thrust": "beal.stability.critical",
    "design_answer": "beal.design.answer",
    "discretise": "beal.discretisation.build",
    "dumps": "beal.vehicle.file",
    "envelope": "beal.motion",
    "explore": "beal.notebook.explore",
    "flight": "beal.study.flight",
    "flight_cases": "beal.design.cases",
    "floquet": "beal.stability.floquet",
    "floquet_chart": "beal.study.pulsating",
    "frequency_sensitivity": "beal.design.frequencies",
    "growth_rate": "beal.motion",
    "load": "beal.interop.files",
    "load_design": "beal.design.design_file",
    "loads": "beal.vehicle.file",
    "morris_effects": "beal.design.indices",
    "open_loop": "beal.control",
    "optimise": "beal.design.optimise",
    "pareto": "beal.design.pareto",
    "plot": "beal.plot",
    "probability_of_instability": "beal.design.reliability",
    "refined_map": "beal.study.refined",
    "response": "beal.motion",
    "robust_optimum": "beal.design.cutting",
    "sample": "beal.design.sampling",
    "sample_cases": "beal.design.cases",
    "scenarios": "beal.design.robust",
    "sensitivity": "beal.design.sensitivity",
    "sobol_indices": "beal.design.indices",
    "spectrum": "beal.stability.spectrum",
    "spring_border": "beal.design.border",
    "stability_map": "beal.study.map",
    "stability_margins": "beal.control",
    "state_space": "beal.control",
    "thrust_curve": "beal.stability.curve",
    "thrust_output": "beal.design.indices",
    "thrust_quantile": "beal.design.reliability",
    "tolerance_cases": "beal.design.cases",
    "transient_growth": "beal.motion",
    "vanishing_damping_limit": "beal.stability.vanishing",
    "verify": "beal.verification.run",
    "vertex_cases": "beal.design.cases",
    "worst_case": "beal.design.robust",
}

__all__ = [
    "Actuator",
    "AllowedInterval",
    "AllowedRange",
    "AmplitudeMap",
    "AxialLoad",
    "BealError",
    "BorderPiece",
    "ClosedLoop",
    "Control",
    "ControlLocus",
    "ControlledThrust",
    "ConvergenceError",
    "CriticalGradient",
    "CriticalHessian",
    "CriticalThrust",
    "Damping",
    "DesignAnswer",
    "DesignSpace",
    "DesignStudy",
    "DistributedThrust",
    "Distribution",
    "ElasticEnd",
    "Engine",
    "Estimate",
    "Event",
    "Filter",
    "Flight",
    "FlightState",
    "Floquet",
    "Force",
    "FrequencySensitivity",
    "Gain",
    "Joint",
    "LinearBound",
    "Link",
    "Margins",
    "ModeShape",
    "ModelError",
    "MorrisEffects",
    "Operators",
    "Optimum",
    "Parameter",
    "ParetoFront",
    "PointMass",
    "PulsatingThrust",
    "RefinedMap",
    "Release",
    "Resonance",
    "Response",
    "Rival",
    "Sample",
    "Samples",
    "Scenario",
    "Sensitivity",
    "Sensor",
    "SignalThrust",
    "SobolIndices",
    "Spectrum",
    "SpringBorder",
    "StabilityComponent",
    "Stage",
    "State",
    "StateSpace",
    "Support",
    "Tank",
    "Thrust",
    "ThrustCurve",
    "ThrustTable",
    "Timeline",
    "Touch",
    "TransientGrowth",
    "Uncertain",
    "Variable",
    "Vehicle",
    "WorstCase",
    "allowed_range",
    "amplitude_map",
    "amplitude_spectrum",
    "catalog",
    "closed_loop",
    "control_locus",
    "control_map",
    "controlled_thrust",
    "critical_events",
    "critical_gradient",
    "critical_hessian",
    "critical_thrust",
    "design_answer",
    "discretise",
    "dumps",
    "envelope",
    "explore",
    "flight",
    "flight_cases",
    "floquet",
    "floquet_chart",
    "frequency_sensitivity",
    "growth_rate",
    "load",
    "load_design",
    "loads",
    "morris_effects",
    "open_loop",
    "optimise",
    "pareto",
    "plot",
    "probability_of_instability",
    "refined_map",
    "response",
    "robust_optimum",
    "sample",
    "sample_cases",
    "scenarios",
    "sensitivity",
    "sobol_indices",
    "spectrum",
    "spring_border",
    "stability_map",
    "stability_margins",
    "state_space",
    "thrust_curve",
    "thrust_output",
    "thrust_quantile",
    "tolerance_cases",
    "transient_growth",
    "vanishing_damping_limit",
    "verify",
    "vertex_cases",
    "worst_case",
]

_painted_by(lambda result: _import_module("beal.notebook.page").html(result))


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module 'beal' has no attribute {name!r}")
    module = _import_module(_HOMES[name])
    value = getattr(module, name, module)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
