"""Exact solution of q'' + D q' + A q = B F(t) by the matrix exponential, breakpoint by breakpoint."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, expm

from beal.motion import signals
from beal.motion.march import march
from beal.vehicle.signals import Signal

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

    Between its breakpoints each signal is carried by a linear system z' = G z (`beal.motion.signals`); the
    exponential of the matrix of (q, q', z) then takes all of it over any interval without a breakpoint. It exists
    whatever A is: singular, defective, or with roots of either sign.

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
    >>> from beal.vehicle.signals import Step
    >>> kick = Step(kind="step", amplitude=2.0)
    >>> rest = np.zeros(1), np.zeros(1)
    >>> q, rate = exact(np.zeros((1, 1)), np.ones((1, 1)), [kick], rest, step=1.0, count=3)  # F t^2 / 2
    >>> np.allclose(q.ravel(), [0, 1, 4, 9])
    True
    """
    terms = [(term, shape) for load, shape in zip(loads, shapes.T, strict=True) for term in signals.terms(load)]
    frequencies = [signals.highest_frequency(term) for term, _ in terms]
    scale = max(float(np.linalg.norm(stiffness, 2)) ** 0.5, 1 / step, *frequencies)  # rates are kept as rate/scale
    matrix = _generator(stiffness, damping, scale)
    breaks = [t for term, _ in terms for t in signals.breakpoints(term)]
    longest = min((signals.longest_interval(term) / step for term, _ in terms), default=np.inf)
    starts, lengths, output = intervals(breaks, step, count, longest)
    middles = (starts + lengths / 2) * step  # where rounding has put no one on the wrong side of a breakpoint
    distinct, which = np.unique(lengths, return_inverse=True)
    transitions = [np.asarray(expm(matrix * (length * step))) for length in distinct]
    forcing = np.zeros((len(lengths), len(matrix)))
    for term, shape in terms:
        states, carrier = signals.state(term, middles), signals.generator(term)
        for index, length in enumerate(distinct * step):
            gain = _gain(matrix, carrier, shape / scale, length)
            forcing[which == index] += (gain @ states[:, which == index]).T
    history = march(transitions, which, forcing, np.concatenate([start[0], start[1] / scale]))[output]
    size = len(stiffness)
    return history[:, :size], history[:, size:] * scale


def _generator(stiffness: Array, damping: Array | None, scale: float) -> Array:
    """Matrix of d/dt (q, q'/scale)."""
    size = len(stiffness)
    damping = np.zeros((size, size)) if damping is None else damping
    return np.block([[np.zeros((size, size)), scale * np.eye(size)], [-stiffness / scale, -damping]])


def _gain(matrix: Array, carrier: Array, shape: Array, length: float) -> Array:
    """What a signal adds to the state over an interval, from the state of the signal in its middle."""
    joined = block_diag(matrix, carrier)
    joined[len(shape) : len(matrix), len(matrix)] = shape
    forward, back = expm(joined * length), expm(carrier * (-length / 2))
    return np.asarray(forward[: len(matrix), len(matrix) :] @ back)


def intervals(
    breaks: Sequence[float], step: float, count: int, longest: float
) -> tuple[Array, Array, NDArray[np.intp]]:
    """Starts and lengths, in steps, of the intervals between output times and breakpoints, and which ends are output.

    Whole steps have length 1 exactly, so that one exponential serves them all; what is too long is cut
    evenly.
    """
    inside = np.array([t / step for t in breaks if 0 < t < count * step])
    whole = np.round(inside)
    nodes = np.union1d(np.arange(count + 1.0), np.where(abs(inside - whole) < SNAP, whole, inside))
    parts = np.maximum(np.ceil(np.diff(nodes) / longest), 1).astype(np.intp)
    ends = np.concatenate([[0], np.cumsum(parts)])
    lengths = np.repeat(np.diff(nodes) / parts, parts)
    starts = np.repeat(nodes[:-1], parts) + (np.arange(ends[-1]) - np.repeat(ends[:-1], parts)) * lengths
    return starts, lengths, ends[np.isin(nodes, np.arange(count + 1.0))]
