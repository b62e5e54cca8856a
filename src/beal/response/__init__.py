"""Operators and excitation to time histories: Newmark's method and the exact solution."""

from beal.response.histories import Response, growth_rate
from beal.response.initial import Initial, ModeShape, Release, Samples
from beal.response.solve import CoarseStepWarning, response

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
