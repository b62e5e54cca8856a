"""Accurate solution of q'' + D q' + (A + p(t) B) q = f(t) by collocation at Gauss's points, of eighth order."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.errors import ConvergenceError
from beal.motion.exact import intervals
from beal.motion.march import march

Array = NDArray[np.float64]
STAGES = 4
TOLERANCE = 1e-11  # of the largest displacement and rate
GAIN = 2 ** (2 * STAGES) - 1  # by which the error falls below the change when the step is halved
FINEST = 256  # substeps of an output step
CHUNK = 2000  # steps whose matrices are held at a time


@dataclass(frozen=True)
class VaryingEquations:
    """q'' + D q' + (A + p(t) B) q = f(t).

    Parameters
    ----------
    A, B : ndarray, shape (n, n)
    D : ndarray, shape (n, n), or None
    p : callable
        Times of any shape to values of that shape.
    load : callable
        Times of shape (...) to f of shape (..., n).
    breakpoints : sequence of float
        Times at which p or f, or one of their derivatives, jumps.
    """

    A: Array
    B: Array
    D: Array | None
    p: Callable[[Array], Array]
    load: Callable[[Array], Array]
    breakpoints: Sequence[float]


def collocation(
    equations: VaryingEquations, start: tuple[Array, Array], step: float, count: int
) -> tuple[Array, Array]:
    """Time history at multiples of a step.

    The method is symmetric, symplectic where the system is, and stable for every step. Substeps, none of which holds a
    breakpoint, are halved until the history does not change beyond the error asked for.

    Parameters
    ----------
    equations : VaryingEquations
    start : pair of ndarray, shape (n,)
        q and q' at time 0.
    step : float
        Between the times of the output, in s.
    count : int
        Number of steps.

    Returns
    -------
    q, rate : ndarray, shape (count + 1, n)

    Raises
    ------
    ConvergenceError
        If the finest substeps do not reach the accuracy, or the motion outgrows the range of numbers.

    References
    ----------
    Hairer, E., Norsett, S. P., Wanner, G., 1993. Solving Ordinary Differential Equations I, II.7 (Kuntzmann and
    Butcher's methods).
    """
    coarse = _history(equations, start, step, count, 1)
    substeps = 2
    while substeps <= FINEST:
        fine = _history(equations, start, step, count, substeps)
        changes = [abs(a - b).max() for a, b in zip(fine, coarse, strict=True)]
        if all(change <= GAIN * TOLERANCE * abs(a).max() for change, a in zip(changes, fine, strict=True)):
            return fine
        coarse, substeps = fine, 2 * substeps
    raise ConvergenceError(
        f"response: {FINEST} substeps in a step of {step:.3g} do not reach {TOLERANCE:g} of the motion; "
        "shorten the step or the duration"
    )


def _history(
    equations: VaryingEquations, start: tuple[Array, Array], step: float, count: int, substeps: int
) -> tuple[Array, Array]:
    starts, lengths, output = intervals(equations.breakpoints, step, count, 1 / substeps)
    size = len(equations.A)
    states = np.empty((len(lengths) + 1, 2 * size))
    states[0] = np.concatenate([start[0], step * start[1]])
    for first in range(0, len(lengths), CHUNK):
        chunk = slice(first, first + CHUNK)
        transitions, forcing = _steps(equations, starts[chunk] * step, lengths[chunk] * step, step)
        which = np.arange(len(forcing))
        states[first : first + len(forcing) + 1] = march(list(transitions), which, forcing, states[first])
    return states[output, :size], states[output, size:] / step


def _steps(equations: VaryingEquations, starts: Array, lengths: Array, scale: float) -> tuple[Array, Array]:
    """Transitions (k, 2n, 2n) and forcing (k, 2n) of the state (q, scale q') over intervals.

    Unknown are the accelerations a_i at the stages:
    a_i + D (q' + h sum_j C_ij a_j) + K_i (q + c_i h q' + h^2 sum_j (C C)_ij a_j) = f_i.
    """
    c, C, b = _gauss()
    n, k = len(equations.A), len(starts)
    D = np.zeros((n, n)) if equations.D is None else equations.D
    times = starts[:, None] + lengths[:, None] * c
    K = equations.A + equations.p(times)[..., None, None] * equations.B  # (k, s, n, n)
    h = lengths[:, None, None, None, None]
    matrix = h * C[:, None, :, None] * D[:, None, :] + h**2 * (C @ C)[:, None, :, None] * K[:, :, :, None, :]
    matrix = matrix.reshape(k, STAGES * n, STAGES * n) + np.eye(STAGES * n)
    from_rate = -(D + h[..., 0] * c[:, None, None] * K) / scale
    right = np.concatenate([-K, from_rate, equations.load(times)[..., None]], axis=-1)
    a = np.linalg.solve(matrix, right.reshape(k, STAGES * n, 2 * n + 1)).reshape(k, STAGES, n, 2 * n + 1)
    h = lengths[:, None, None]
    change = np.concatenate(
        [h**2 * np.einsum("s,ksij->kij", b @ C, a), h * scale * np.einsum("s,ksij->kij", b, a)], axis=1
    )
    transitions = change[..., :-1] + np.eye(2 * n)
    transitions[:, :n, n:] += h / scale * np.eye(n)
    return transitions, change[..., -1]


def _gauss() -> tuple[Array, Array, Array]:
    """Points c, matrix C with sum_j C_ij f(c_j) the integral of f from 0 to c_i, and weights b, on [0, 1]."""
    x, w = np.polynomial.legendre.leggauss(STAGES)
    c = (1 + x) / 2
    powers = np.arange(STAGES)
    C = c[:, None] ** (powers + 1) / (powers + 1) @ np.linalg.inv(c[:, None] ** powers)
    return c, C, w / 2
