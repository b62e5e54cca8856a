"""The ridge scan for many vehicles at once, on tables of their characteristic function.

The search of `beal.stability.ridge`, compiled where numba is installed, else on arrays over the vehicles. It answers
only where every check passes; the others are left to the search that looks at one vehicle at a time.
"""

from dataclasses import dataclass
from importlib import import_module

import numpy as np
from numpy.typing import NDArray

from beal.stability.kernels import compiled_kernels
from beal.stability.pencil import Array
from beal.stability.table import Panel


@dataclass(frozen=True)
class Found:
    """First instability of each vehicle on a panel.

    Parameters
    ----------
    kind : ndarray of int, shape (vehicles,)
        0 none on the panel, 1 flutter, 2 divergence, 3 undecided.
    mode : ndarray of int, shape (vehicles,)
        Lower of the modes that meet, counted from 1; 0 where none do.
    thrust, W, error : ndarray, shape (vehicles,)
    border : ndarray of bool, shape (vehicles,)
        Whether another instability comes at practically the same thrust, or all but came before.
    """

    kind: NDArray[np.intp]
    mode: NDArray[np.intp]
    thrust: Array
    W: Array
    error: Array
    border: NDArray[np.bool_]


def scan(panel: Panel, weights: Array) -> Found:
    """First instabilities on a panel.

    Parameters
    ----------
    panel : Panel
    weights : ndarray, shape (vehicles, subsets)
        From `beal.stability.table.weights`.

    Returns
    -------
    Found
    """
    kernels = import_module(f"beal.stability.kernels.scan_{'compiled' if compiled_kernels() else 'plain'}")
    kind, mode = np.zeros((2, len(weights)), dtype=np.intp)
    found = np.empty((len(weights), 4))
    kernels.scan(panel, np.ascontiguousarray(weights), kind, mode, found)
    thrust, W, error, border = found.T
    return Found(kind, mode, thrust, W, error, border > 0)
