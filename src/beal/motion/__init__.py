"""Operators and excitation to time histories: Newmark's method and the exact solution."""

from beal.motion.amplitude import AmplitudeMap, amplitude_map
from beal.motion.histories import PARTS, QUANTITIES, Quantity, Response, growth_rate
from beal.motion.initial import Initial, ModeShape, Release, Samples, State
from beal.motion.solve import response
from beal.motion.spectra import amplitude_spectrum, envelope
from beal.motion.steps import AliasingWarning, CoarseStepWarning
from beal.motion.thrusts import PulsatingThrust, ThrustHistory, ThrustTable
from beal.motion.transient import TransientGrowth, transient_growth

__all__ = [
    "PARTS",
    "QUANTITIES",
    "AliasingWarning",
    "AmplitudeMap",
    "CoarseStepWarning",
    "Initial",
    "ModeShape",
    "PulsatingThrust",
    "Quantity",
    "Release",
    "Response",
    "Samples",
    "State",
    "ThrustHistory",
    "ThrustTable",
    "TransientGrowth",
    "amplitude_map",
    "amplitude_spectrum",
    "envelope",
    "growth_rate",
    "response",
    "transient_growth",
]
