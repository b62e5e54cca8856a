"""The reduced equations over time, by either method, under a constant or a varying thrust."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.motion import signals
from beal.motion.collocation import VaryingEquations, collocation
from beal.motion.exact import exact
from beal.motion.newmark import newmark, newmark_varying
from beal.motion.reduction import ReducedEquations
from beal.motion.thrusts import ThrustHistory
from beal.vehicle.signals import Signal

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Problem:
    """p'' + D p' + (A + (P(t) - P0) B) p = shapes F(t), where the reduced equations hold at P0.

    Parameters
    ----------
    reduced : ReducedEquations
    shapes : ndarray, shape (k, f)
    loads : sequence of Signal, length f
    start : pair of ndarray, shape (k,)
        p and p' at time 0.
    B : ndarray, shape (k, k)
        Stiffness per thrust.
    thrust : PulsatingThrust, ThrustTable or SignalThrust, optional
        P; by default P0.
    """

    reduced: ReducedEquations
    shapes: Array
    loads: Sequence[Signal]
    start: tuple[Array, Array]
    B: Array
    thrust: ThrustHistory | None

    def change(self, time: Array) -> Array:
        """P(t) - P0, in N, of the shape of the times."""
        return 0.0 * time if self.thrust is None else self.thrust.at(time) - self.thrust.middle

    def force(self, time: Array) -> Array:
        """The right-hand side, shape (..., k) for times of shape (...)."""
        total = np.zeros((*time.shape, len(self.shapes)))
        for shape, load in zip(self.shapes.T, self.loads, strict=True):
            total += signals.value(load, time)[..., None] * shape
        return total


def by_newmark(problem: Problem, step: float, count: int, beta: float, gamma: float) -> tuple[Array, Array, Array]:
    """Newmark's p, p' and p'' at multiples of a step, shape (count + 1, k) each."""
    A, D = problem.reduced.A, problem.reduced.D
    sampled = np.array([signals.samples(signal, step, count + 1) for signal in problem.loads]).reshape(-1, count + 1)
    load = (problem.shapes @ sampled).T
    if problem.thrust is None:
        return newmark(np.eye(len(A)), A, load, problem.start, step, beta, gamma, D)
    change = problem.change(step * np.arange(count + 1.0))
    return newmark_varying(A, problem.B, change, load, problem.start, step, beta, gamma, D)


def without_error_of_the_step(problem: Problem, step: float, count: int) -> tuple[Array, Array, Array]:
    """p, p' and p'' at multiples of a step, shape (count + 1, k) each; p'' after a jump of a force."""
    A, D, time = problem.reduced.A, problem.reduced.D, step * np.arange(count + 1.0)
    if problem.thrust is None:
        p, p_rate = exact(A, problem.shapes, problem.loads, problem.start, step, count, D)
    else:
        breaks = [t for load in problem.loads for t in signals.breakpoints(load)]
        breaks += problem.thrust.breakpoints
        equations = VaryingEquations(A, problem.B, D, problem.change, problem.force, breaks)
        p, p_rate = collocation(equations, problem.start, step, count)
    acceleration = problem.force(time) - p @ A.T - problem.change(time)[:, None] * (p @ problem.B.T)
    return p, p_rate, acceleration if D is None else acceleration - p_rate @ D.T
