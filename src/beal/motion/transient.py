"""Transient growth: how much energy a stable vehicle's motion may take from the thrust before it comes back."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import cholesky, expm, solve_triangular
from scipy.optimize import minimize, minimize_scalar

from beal.discretisation import discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.motion.initial import State
from beal.motion.reduction import ReducedEquations, reduce
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
WATCHED = 4  # modes whose beats the time span holds
BEATS, PER_PERIOD, MOST, CLOSER = (
    3,
    16,
    4000,
    400,
)  # of the slowest beat; times in a period, at most, and about the largest
DISTANCES = np.logspace(-5, 1, 25)  # from the imaginary axis, in units of the lowest frequency
UNSTABLE = 1e-6  # growth rate over the lowest frequency; a double root is good to the root of the precision


@dataclass(frozen=True, eq=False)
class TransientGrowth:
    """Growth of the energy of a vehicle's elastic motion under a thrust below the critical one.

    The energy is kinetic energy and strain energy of structure, joints, foundation and supports; loads do work on it.

    Parameters
    ----------
    thrust : float
        In N.
    growth : float
        Largest energy over the initial one that any motion reaches in the time span.
    instant : float
        When, in s.
    initial : State
        The start that does so, of energy 1 J, for `beal.response`.
    time, history : ndarray, shape (k,)
        Times, in s, and the largest growth G(t) that any motion reaches then.
    lower_bound : float
        Square of Kreiss's constant sup Re(s) |(s - S)^-1| over Re(s) > 0, as far as found: the growth over all time is
        no smaller.
    upper_bound : float
        Square of the condition number of the eigenvectors, which no growth exceeds; infinite where they do not exist.
    matrix : ndarray, shape (2 n, 2 n)
        S of z' = S z, where the energy is |z|^2/2.
    """

    thrust: float
    growth: float
    instant: float
    initial: State
    time: Array
    history: Array
    lower_bound: float
    upper_bound: float
    matrix: Array

    def resolvent_norm(self, s: ArrayLike) -> Array:
        """|(s - S)^-1| at complex numbers s, in s, of their shape; its level 1/e bounds the e-pseudospectrum."""
        points = np.asarray(s, dtype=complex)
        shifted = points[..., None, None] * np.eye(len(self.matrix)) - self.matrix
        with np.errstate(divide="ignore"):
            return np.asarray(1 / np.linalg.svd(shifted, compute_uv=False)[..., -1])


def transient_growth(
    model: Vehicle | Operators, thrust: float, *, duration: float | None = None, modes: int = 12
) -> TransientGrowth:
    """The largest growth of energy, over all initial motions, that a thrust below the critical one allows.

    A follower thrust makes the modes of a vehicle non-orthogonal: although each of them only swings or decays, their
    sum may first grow. G(t) = |exp(S t)|^2 in the norm of the energy, S being the matrix of the elastic motion in
    coordinates whose length is that energy. Without thrust G is at most 1; towards flutter it grows beyond all bounds.

    Parameters
    ----------
    model : Vehicle or Operators
    thrust : float
        P, in N.
    duration : float, optional
        Time span, in s; by default three of the slowest beats among the four lowest modes.
    modes : int
        Elastic modes that are kept; rigid-body motion has no part in it.

    Returns
    -------
    TransientGrowth

    Raises
    ------
    ModelError
        If the thrust is negative or motions grow without end under it, or an option is out of range.

    Notes
    -----
    Without damping the supremum over all time may lie above what the time span shows, and below ``upper_bound``.

    References
    ----------
    Trefethen, L. N., Embree, M., 2005. Spectra and Pseudospectra, chapters 14 to 18.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> [round(transient_growth(catalog.beck(), thrust).growth, 2) for thrust in (0.0, 10.0, 19.0)]
    [1.0, 3.25, 44.67]
    """
    operators = discretise(model) if isinstance(model, Vehicle) else model
    if not 0 <= thrust < math.inf:
        raise ModelError(f"thrust: must be finite and not negative, found {thrust}")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    if duration is not None and not 0 < duration < math.inf:
        raise ModelError(f"duration: must be positive and finite, found {duration}")
    reduced = reduce(operators, thrust, modes, rigid_body=False)
    root = cholesky(reduced.X.T @ operators.K0 @ reduced.X)
    S = _energy_matrix(reduced, root)
    s, vectors = np.linalg.eig(S)
    lowest = float(abs(reduced.mu[0])) ** 0.5
    if s.real.max() > UNSTABLE * lowest:
        raise ModelError(
            f"thrust: must lie below the critical one, found {thrust:g}, "
            f"where motions grow as exp({s.real.max():.4g} t)"
        )
    time = _times(np.sqrt(abs(reduced.mu)), duration)
    history = _history(S, time)
    instant = _largest(S, time, history)
    _, sizes, start = np.linalg.svd(expm(S * instant))
    z = math.sqrt(2) * start[0]
    p, p_rate = solve_triangular(root, z[: len(root)]), z[len(root) :]
    found = TransientGrowth(
        thrust=thrust,
        growth=float(sizes[0] ** 2),
        instant=instant,
        initial=State(reduced.X @ p, reduced.X @ p_rate),
        time=time,
        history=history,
        lower_bound=0.0,
        upper_bound=float(np.linalg.cond(vectors) ** 2),
        matrix=S,
    )
    return replace(found, lower_bound=_kreiss(found, s[s.imag >= 0], lowest) ** 2)


def _energy_matrix(reduced: ReducedEquations, root: Array) -> Array:
    """S for z = (R p, p'), where R^T R is the stiffness without loads in coordinates p and their mass is 1."""
    n = len(root)
    D = np.zeros((n, n)) if reduced.D is None else reduced.D
    inverse = solve_triangular(root, np.eye(n))
    return np.block([[np.zeros((n, n)), root], [-reduced.A @ inverse, -D]])


def _times(frequencies: Array, duration: float | None) -> Array:
    """Times that follow the watched modes over their slowest beats, as far as there are not too many."""
    watched = frequencies[:WATCHED]
    if duration is None:
        slowest = min([watched[0], *(gap for gap in np.diff(np.sort(watched)) if gap > 0)])
        duration = BEATS * 2 * math.pi / float(slowest)
    count = math.ceil(duration * float(watched[-1]) / (2 * math.pi) * PER_PERIOD)
    return np.linspace(0.0, duration, min(max(count, PER_PERIOD), MOST) + 1)


def _history(S: Array, time: Array) -> Array:
    """G at equally spaced times."""
    first, step = expm(S * time[0]), expm(S * (time[1] - time[0]))
    motions = np.empty((len(time), *S.shape))
    motions[0] = first
    for k in range(1, len(time)):
        motions[k] = step @ motions[k - 1]
    return np.asarray(np.linalg.norm(motions, 2, axis=(1, 2)) ** 2)


def _largest(S: Array, time: Array, history: Array) -> float:
    """The time of the largest G, from closer ones about the largest so far."""
    instant, step = float(time[history.argmax()]), float(time[1])
    closer = np.linspace(max(0.0, instant - step), min(float(time[-1]), instant + step), CLOSER + 1)
    instant, step = float(closer[_history(S, closer).argmax()]), float(closer[1] - closer[0])
    best = minimize_scalar(
        lambda t: -float(np.linalg.norm(expm(S * t), 2)),
        bounds=(max(0.0, instant - step), min(float(time[-1]), instant + step)),
        method="bounded",
        options={"xatol": 1e-6 * step},
    )
    return float(best.x) if -best.fun > np.linalg.norm(expm(S * instant), 2) else instant


def _kreiss(found: TransientGrowth, roots: NDArray[np.complex128], lowest: float) -> float:
    """Kreiss's constant, from below: the best of a grid beside the low roots and between them, made better."""
    heights = np.sort(roots.imag)[: 2 * WATCHED]
    heights = np.concatenate([heights, (heights[1:] + heights[:-1]) / 2])
    points = lowest * DISTANCES + 1j * heights[:, None]
    sizes = points.real * found.resolvent_norm(points)
    start = points.flat[int(sizes.argmax())]

    def missing(x: Array) -> float:
        s = start.real * math.exp(x[0]) + 1j * (start.imag + lowest * x[1])
        return -float(s.real * found.resolvent_norm(s))

    better = minimize(missing, np.zeros(2), method="Nelder-Mead", options={"initial_simplex": 0.05 * np.eye(3, 2, -1)})
    return max(float(sizes.max()), -float(better.fun), 1.0)
