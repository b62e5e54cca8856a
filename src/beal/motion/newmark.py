"""Newmark's method for M q'' + C q' + K q = f."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from beal.errors import ModelError
from beal.motion.march import check_range, march

Array = NDArray[np.float64]


def newmark(
    mass: Array,
    stiffness: Array,
    load: Array,
    start: tuple[Array, Array],
    step: float,
    beta: float = 0.25,
    gamma: float = 0.5,
    damping: Array | None = None,
) -> tuple[Array, Array, Array]:
    """Time history of M q'' + C q' + K q = f with a constant step h.

        q1  = q0 + h q0' + h^2 ((1/2 - beta) q0'' + beta q1'')
        q1' = q0' + h ((1 - gamma) q0'' + gamma q1'')

    As the equation is linear, a step is one matrix that acts on (q, h q', h^2 q''): M + gamma h C + beta h^2 K
    is factorised once.

    Parameters
    ----------
    mass, stiffness : ndarray, shape (n, n)
        M and K; K need be neither symmetric nor regular.
    load : ndarray, shape (k + 1, n)
        f at the times 0, h, ..., k h.
    start : pair of ndarray, shape (n,)
        q and q' at time 0.
    step : float
        h, in s.
    beta, gamma : float
        1/4 and 1/2 for constant mean acceleration, 1/6 and 1/2 for linear acceleration, 0 and 1/2 for central
        differences.
    damping : ndarray, shape (n, n), optional
        C; by default none.

    Returns
    -------
    q, rate, acceleration : ndarray, shape (k + 1, n)

    Raises
    ------
    ModelError
        If beta or gamma makes the method unstable at every step.

    Notes
    -----
    Of second order for gamma = 1/2, of first order with numerical damping for gamma > 1/2. Where 2 beta < gamma the
    step must stay below ``largest_step``.

    References
    ----------
    Newmark, N. M., 1959. A method of computation for structural dynamics. Journal of the Engineering Mechanics
    Division, 85(3), 67-94.

    Examples
    --------
    >>> spring = np.array([[4.0]])
    >>> rest = np.array([1.0]), np.array([0.0])
    >>> q, _, _ = newmark(np.eye(1), spring, np.zeros((1001, 1)), rest, step=np.pi / 1000)
    >>> round(float(q[-1, 0]), 4)
    1.0
    """
    check_parameters(beta, gamma)
    identity, zero = np.eye(len(mass)), np.zeros_like(mass)
    predict_q = np.hstack([identity, identity, (0.5 - beta) * identity])
    predict_rate = np.hstack([zero, identity, (1 - gamma) * identity])
    damping = zero if damping is None else damping
    factors = lu_factor(mass + gamma * step * damping + beta * step**2 * stiffness)
    from_load = step**2 * np.asarray(lu_solve(factors, identity))
    acceleration = -from_load @ (stiffness @ predict_q + damping @ predict_rate / step)
    transition = np.vstack([predict_q + beta * acceleration, predict_rate + gamma * acceleration, acceleration])
    forcing = load[1:] @ np.vstack([beta * from_load, gamma * from_load, from_load]).T
    q, rate = start
    first = np.linalg.solve(mass, load[0] - stiffness @ q - damping @ rate)
    states = march([transition], np.zeros(len(forcing), dtype=np.intp), forcing, np.r_[q, step * rate, step**2 * first])
    q, rate, acceleration = np.split(states, 3, axis=1)
    return q, rate / step, acceleration / step**2


def newmark_varying(
    stiffness: Array,
    per_change: Array,
    change: Array,
    load: Array,
    start: tuple[Array, Array],
    step: float,
    beta: float,
    gamma: float,
    damping: Array | None,
) -> tuple[Array, Array, Array]:
    """Time history of q'' + C q' + (K + p(t) B) q = f with a constant step, as `newmark` without p.

    Parameters
    ----------
    stiffness, per_change : ndarray, shape (n, n)
        K and B.
    change : ndarray, shape (k + 1,)
        p at the times 0, h, ..., k h.
    load, start, step, beta, gamma, damping
        As of `newmark`.

    Returns
    -------
    q, rate, acceleration : ndarray, shape (k + 1, n)

    Raises
    ------
    ConvergenceError
        If the motion outgrows the range of floating-point numbers.
    """
    q, rate, acceleration = (np.empty_like(load) for _ in range(3))
    q[0], rate[0] = start
    C = np.zeros_like(stiffness) if damping is None else damping
    constant = np.eye(len(stiffness)) + gamma * step * C
    acceleration[0] = load[0] - (stiffness + change[0] * per_change) @ q[0] - C @ rate[0]
    with np.errstate(over="ignore", invalid="ignore"):
        for k in range(len(load) - 1):
            q[k + 1] = q[k] + step * rate[k] + (0.5 - beta) * step**2 * acceleration[k]
            rate[k + 1] = rate[k] + (1 - gamma) * step * acceleration[k]
            K = stiffness + change[k + 1] * per_change
            rest = load[k + 1] - K @ q[k + 1] - C @ rate[k + 1]
            acceleration[k + 1] = np.linalg.solve(constant + beta * step**2 * K, rest)
            q[k + 1] += beta * step**2 * acceleration[k + 1]
            rate[k + 1] += gamma * step * acceleration[k + 1]
    check_range(q)
    return q, rate, acceleration


def check_parameters(beta: float, gamma: float) -> None:
    """Refuses parameters with which no step is stable (and NaN)."""
    if not gamma >= 0.5:
        raise ModelError(
            f"gamma: must be at least 1/2, found {gamma}; below, the method has negative damping and every motion grows"
        )
    if not beta >= 0:
        raise ModelError(f"beta: must not be negative, found {beta}; 1/4 is stable with every step")


def largest_step(angular_frequency: float, beta: float, gamma: float) -> float:
    """Largest stable step for an undamped mode, in s: 1 / (omega sqrt(gamma/2 - beta)).

    Every step is stable where 2 beta >= gamma. T. J. R. Hughes (1987), The Finite Element Method, Eq.
    (9.2.16) without damping, which lengthens it where gamma > 1/2 and leaves it as it is where gamma = 1/2.
    """
    return math.inf if 2 * beta >= gamma else 1 / (angular_frequency * math.sqrt(gamma / 2 - beta))
