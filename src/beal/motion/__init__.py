"""Operators and excitation to time histories: Newmark's method and the exact solution."""

from beal.motion.histories import PARTS, QUANTITIES, Quantity, Response, growth_rate
from beal.motion.initial import Initial, ModeShape, Release, Samples
from beal.motion.solve import response
from beal.motion.spectra import amplitude_spectrum, envelope
from beal.motion.steps import AliasingWarning, CoarseStepWarning

__all__ = [
    "PARTS",
    "QUANTITIES",
    "AliasingWarning",
    "CoarseStepWarning",
    "Initial",
    "ModeShape",
    "Quantity",
    "Release",
    "Response",
    "Samples",
    "amplitude_spectrum",
    "envelope",
    "growth_rate",
    "response",
]
