"""Operators and excitation to time histories: Newmark's method and the exact solution."""

from beal.motion.histories import Response, growth_rate
from beal.motion.initial import Initial, ModeShape, Release, Samples
from beal.motion.solve import CoarseStepWarning, response

__all__ = [
    "CoarseStepWarning",
    "Initial",
    "ModeShape",
    "Release",
    "Response",
    "Samples",
    "growth_rate",
    "response",
]
