"""Exact solution of q'' + D q' + A q = B F(t) by the matrix exponential, breakpoint by breakpoint."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from beal.motion import signals
from beal.motion.march import march
from beal.vehicle.parts import Signal

Array = NDArray[np.float64]
SNAP = 1e-9  # share of a step within which a breakpoint counts as an output time


def exact(
    stiffness: Array,
    shapes: Array,
    loads: Sequence[Signal],
    start: tuple[Array, Array],
    step: float,
    count: int,
    damping: Array | None = None,
) -> tuple[Array, Array]:
    """Time history of q'' + D q' + A q = B F(t) at multiples of a step, without error of the step.

    Each signal joins the state as (F, F') with F'' = -w^2 F, which holds between its breakpoints; the
    exponential of the matrix of (q, q', F, F') then carries all of it over any interval without a breakpoint.
    It exists whatever A is: singular, defective, or with roots of either sign.

    Parameters
    ----------
    stiffness : ndarray, shape (n, n)
        A.
    shapes : ndarray, shape (n, f)
        B, a column for each signal.
    loads : sequence of Signal, length f
    start : pair of ndarray, shape (n,)
        q and q' at time 0.
    step : float
        Between the times of the output, in s.
    count : int
        Number of steps.
    damping : ndarray, shape (n, n), optional
        D; by default none.

    Returns
    -------
    q, rate : ndarray, shape (count + 1, n)

    Examples
    --------
    >>> from beal.vehicle.parts import Step
    >>> kick = Step(kind="step", amplitude=2.0)
    >>> rest = np.zeros(1), np.zeros(1)
    >>> q, rate = exact(np.zeros((1, 1)), np.ones((1, 1)), [kick], rest, step=1.0, count=3)  # F t^2 / 2
    >>> np.allclose(q.ravel(), [0, 1, 4, 9])
    True
    """
    size = len(stiffness)
    frequencies = [signals.angular_frequency(signal) for signal in loads]
    scale = max(float(np.linalg.norm(stiffness, 2)) ** 0.5, 1 / step, *frequencies)  # rates are kept as rate/scale
    matrix = _generator(stiffness, shapes, frequencies, scale)
    if damping is not None:
        matrix[size : 2 * size, size : 2 * size] = -damping
    nodes, lengths = _intervals([t for signal in loads for t in signals.breakpoints(signal)], step, count)
    distinct, which = np.unique(lengths, return_inverse=True)
    exponentials = [np.asarray(expm(matrix * (length * step))) for length in distinct]
    forcing = np.zeros((len(lengths), 2 * size))
    if loads:
        states = np.vstack([signals.states(load, nodes[:-1] * step, lengths * step) for load in loads])
        states[1::2] /= scale
        for index, exponential in enumerate(exponentials):
            forcing[which == index] = states[:, which == index].T @ exponential[: 2 * size, 2 * size :].T
    transitions = [exponential[: 2 * size, : 2 * size] for exponential in exponentials]
    history = march(transitions, which, forcing, np.concatenate([start[0], start[1] / scale]))
    output = history[np.isin(nodes, np.arange(count + 1.0))]
    return output[:, :size], output[:, size:] * scale


def _generator(stiffness: Array, shapes: Array, frequencies: Sequence[float], scale: float) -> Array:
    """Matrix of d/dt (q, q'/scale, F_1, F_1'/scale, F_2, ...)."""
    size = len(stiffness)
    matrix = np.zeros((2 * (size + len(frequencies)),) * 2)
    matrix[:size, size : 2 * size] = scale * np.eye(size)
    matrix[size : 2 * size, :size] = -stiffness / scale
    matrix[size : 2 * size, 2 * size :: 2] = shapes / scale
    for index, w in enumerate(frequencies):
        row = 2 * (size + index)
        matrix[row : row + 2, row : row + 2] = [[0.0, scale], [-(w**2) / scale, 0.0]]
    return matrix


def _intervals(breaks: Sequence[float], step: float, count: int) -> tuple[Array, Array]:
    """Ends and lengths, in steps, of the intervals between output times and breakpoints.

    Whole steps have length 1 exactly, so that one exponential serves them all.
    """
    inside = np.array([t / step for t in breaks if 0 < t < count * step])
    whole = np.round(inside)
    nodes: Array = np.union1d(np.arange(count + 1.0), np.where(abs(inside - whole) < SNAP, whole, inside))
    return nodes, np.diff(nodes)
