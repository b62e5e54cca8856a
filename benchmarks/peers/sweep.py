"""The vehicles; what every peer leaves to its user (sweep of thrust, bisection, label); the line each script prints.

Non-dimensional: bending stiffness, mass per length and length are 1. Sizes are numbers of elements, or of functions.
"""

import json
import sys
import time
from collections.abc import Callable
from importlib.metadata import version

import numpy as np

JOINT_AT, JOINT_STIFFNESS = 0.6, 5.0  # of the jointed beam: free-free, a rotational spring, rigid in shear
EXPECTED = {
    "beck": (20.0509536190, "flutter"),
    "free-free": (109.689191958738, "flutter"),
    "jointed": (47.2073610453, "divergence"),
}


def first_instability(
    roots: Callable[[float], np.ndarray],
    rigid: int,
    tolerance: float,
    step: float = 1.0,
    limit: float = 300.0,
    watched: int = 4,
) -> tuple[float, str]:
    """Lowest unstable thrust and its kind, from the squared frequencies at a thrust."""

    def kind(thrust: float) -> str | None:
        squares = roots(thrust)
        # Under thrust the rigid-body pair splits to either side of zero: by value it would read as an instability.
        squares = squares[np.argsort(np.abs(squares))][rigid : rigid + watched]
        if np.any(np.abs(squares.imag) > 1e-4 * np.abs(squares)):
            return "flutter"
        return "divergence" if np.any(squares.real < 0) else None

    high = step
    while high < limit and kind(high) is None:
        high += step
    found = kind(high)  # not at the load itself, where a diverging root hides among the rigid-body pair
    low = high - step
    while high - low > tolerance * high:
        middle = (low + high) / 2
        low, high = (middle, high) if kind(middle) is None else (low, middle)
    return high, found or "stable"


def report(
    tool: str,
    package: str,
    sizes: dict[tuple[str, float], int | str],
    solve: Callable[[str, int | str, float], tuple[float, str]],
    repeats: int = 5,
) -> None:
    """Time ``solve(vehicle, size, accuracy)`` for the vehicle and the accuracy on the command line; print one line."""
    vehicle, accuracy = sys.argv[1], float(sys.argv[2])
    line = {"tool": tool, "version": version(package), "vehicle": vehicle, "accuracy": accuracy, "seconds": []}
    if size := sizes.get((vehicle, accuracy)):
        for _ in range(repeats):
            start = time.perf_counter()
            line["critical_thrust"], line["kind"] = solve(vehicle, size, accuracy)
            line["seconds"].append(time.perf_counter() - start)
        line["size"] = size
    print(json.dumps(line))
