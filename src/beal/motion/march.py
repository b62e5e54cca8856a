"""The loop behind both methods: a linear step is one matrix."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from beal.errors import ConvergenceError

Array = NDArray[np.float64]


def march(transitions: Sequence[Array], which: NDArray[np.intp], forcing: Array, start: Array) -> Array:
    """States of z_{k+1} = T_k z_k + g_k, where T_k is one of a few matrices.

    Parameters
    ----------
    transitions : sequence of ndarray, shape (n, n)
    which : ndarray of int, shape (k,)
        The transition of each step.
    forcing : ndarray, shape (k, n)
    start : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (k + 1, n)

    Raises
    ------
    ConvergenceError
        If the motion outgrows the range of floating-point numbers.

    Examples
    --------
    >>> march([np.eye(1) / 2], np.zeros(2, dtype=int), np.ones((2, 1)), np.array([4.0])).ravel().tolist()
    [4.0, 3.0, 2.5]
    """
    states = np.empty((len(which) + 1, len(start)))
    states[0] = start
    with np.errstate(over="ignore", invalid="ignore"):
        for k, index in enumerate(which.tolist()):
            states[k + 1] = transitions[index] @ states[k] + forcing[k]
    check_range(states)
    return states


def check_range(states: Array) -> None:
    """Refuses a history, times in rows, that has left the range of numbers."""
    lost = ~np.isfinite(states).all(axis=1)
    if lost.any():
        raise ConvergenceError(
            f"response: the motion outgrew the range of numbers in step {int(np.argmax(lost))} of "
            f"{len(states) - 1}; shorten the duration, or the step if the vehicle is stable"
        )
