"""Critical thrust in NumPy and SciPy alone: Legendre polynomials on each part, all terms of the beam by hand."""

import numpy as np
import scipy.linalg
from numpy.polynomial import legendre
from sweep import JOINT_AT, JOINT_STIFFNESS, first_instability, report

FUNCTIONS = {  # of each part
    ("beck", 1e-3): 8,
    ("beck", 1e-6): 10,
    ("free-free", 1e-3): 10,
    ("free-free", 1e-6): 12,
    ("jointed", 1e-3): 6,
    ("jointed", 1e-6): 8,
}


def functions(size: int, length: float, x: np.ndarray, derivative: int) -> np.ndarray:
    """Legendre polynomials of a part, or their derivatives, at places from its forward end."""
    coefficients = legendre.legder(np.eye(size), derivative) * (2 / length) ** derivative
    return legendre.legval(2 * x / length - 1, coefficients)


def solve(vehicle: str, size: int, accuracy: float) -> tuple[float, str]:
    """Critical thrust P L^2/EI and its kind."""
    clamped = vehicle == "beck"
    ends = [0, JOINT_AT, 1] if vehicle == "jointed" else [0, 1]
    M, K, K1 = np.zeros((3, size * (len(ends) - 1), size * (len(ends) - 1)))
    conditions = []
    nodes, weights = legendre.leggauss(size + 1)
    for i, (fore, aft) in enumerate(zip(ends, ends[1:], strict=False)):
        own, length = slice(size * i, size * (i + 1)), aft - fore
        x, w = length * (nodes + 1) / 2, weights * length / 2
        f, slope, curvature = (functions(size, length, x, derivative) for derivative in range(3))
        M[own, own] = f * w @ f.T
        K[own, own] = curvature * w @ curvature.T
        K1[own, own] = -slope * w * (1 if clamped else fore + x) @ slope.T
    front, front_slope = (functions(size, ends[1], np.zeros(1), d)[:, 0] for d in range(2))
    tail, tail_slope = (functions(size, length, np.array([length]), d)[:, 0] for d in range(2))
    K1[own, own] += np.outer(tail, tail_slope)
    if clamped:
        conditions = [front, front_slope]
    elif len(ends) == 3:
        joint, turn = (
            np.concatenate(
                [-functions(size, ends[1], np.array([ends[1]]), d), functions(size, length, np.zeros(1), d)]
            )[:, 0]
            for d in range(2)
        )
        conditions = [joint]
        K += JOINT_STIFFNESS * np.outer(turn, turn)
    free = scipy.linalg.null_space(np.array(conditions)) if conditions else np.eye(size)
    M, K, K1 = (free.T @ matrix @ free for matrix in (M, K, K1))
    return first_instability(lambda P: scipy.linalg.eigvals(K + P * K1, M), 0 if clamped else 2, accuracy / 10)


if __name__ == "__main__":
    report("NumPy + SciPy", "scipy", FUNCTIONS, solve)
