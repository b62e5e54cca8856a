"""Which uncertain quantity matters: Sobol' indices of variance and the elementary effects of Morris."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from beal.design.reliability import CONFIDENCE, Estimate
from beal.design.sampling import Progress, solve_values
from beal.design.uncertain import Uncertain
from beal.errors import ConvergenceError, ModelError
from beal.study.study import Solve

Array = NDArray[np.float64]
Output = Callable[[Array], Array]  # of points of the unit cube, shape (points, quantities) -> (points,)

FEWEST = 64  # points of each of the two matrices
FEWEST_PATHS = 4
RESAMPLES = 400  # of the bootstrap
LEVELS = 4  # of each quantity on a path of Morris
TAIL = 0.01  # probability left out at either end there


@dataclass(frozen=True)
class SobolIndices:
    """Shares of the variance of an output.

    Parameters
    ----------
    quantities : tuple of str
    first : tuple of Estimate
        Share that vanishes when the quantity alone is known.
    total : tuple of Estimate
        Share that remains when all others are known; 0 if the quantity does not matter.
    evaluations : int
    """

    quantities: tuple[str, ...]
    first: tuple[Estimate, ...]
    total: tuple[Estimate, ...]
    evaluations: int


@dataclass(frozen=True)
class MorrisEffects:
    """Elementary effects: change of an output over the change of one quantity, in its probability.

    Parameters
    ----------
    quantities : tuple of str
    mean_absolute : tuple of Estimate
        mu*, by which quantities are screened.
    mean, deviation : tuple of float
        mu, and sigma: large where the effect depends on the others or is not linear.
    evaluations : int
    """

    quantities: tuple[str, ...]
    mean_absolute: tuple[Estimate, ...]
    mean: tuple[float, ...]
    deviation: tuple[float, ...]
    evaluations: int


def thrust_output(
    uncertain: Uncertain,
    thrust: float | None = None,
    solve: Solve | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Output:
    """The output that indices speak of.

    Parameters
    ----------
    uncertain : Uncertain
        Its quantities independent of each other.
    thrust : float, optional
        If given the output is 1 where the vehicle is unstable at or below it, else 0. If not, it is the critical
        thrust, or the thrust searched to where the vehicle is stable up to there.
    solve, workers, progress
        As in `beal.sample`.

    Returns
    -------
    callable
        It raises `ConvergenceError` if a vehicle cannot be solved: no index is known then.

    Raises
    ------
    ModelError
        If the quantities are correlated: the shares of variance have no meaning then.
    """
    if any(uncertain.correlations.values()):
        raise ModelError([("correlation", "indices need independent quantities; take the correlations out")])

    def output(cube: Array) -> Array:
        found, _, limit = solve_values(uncertain, uncertain.values(cube), solve, workers, progress)
        if failed := int(np.isnan(found).sum()):
            raise ConvergenceError(f"{failed} of {len(found)} vehicles could not be solved; no index without them")
        return np.minimum(found, limit) if thrust is None else (found <= thrust).astype(float)

    return output


def sobol_indices(
    output: Output, quantities: Sequence[str], samples: int = 1024, seed: int = 0, confidence: float = CONFIDENCE
) -> SobolIndices:
    """Sobol' indices, first order and total, with bootstrap intervals.

    Parameters
    ----------
    output : callable
        From `thrust_output`, or any function of points of the unit cube.
    quantities : sequence of str
    samples : int
        At least 64, rounded up to a power of two; (quantities + 2) times as many evaluations.
    seed : int
    confidence : float

    Returns
    -------
    SobolIndices
        All zero if the output does not vary.

    Raises
    ------
    ModelError
        If there are too few samples.

    References
    ----------
    A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259-270.

    Examples
    --------
    >>> found = sobol_indices(lambda x: 2 * x[:, 0] + x[:, 1], ("a", "b"))
    >>> [round(index.value, 2) for index in found.total]
    [0.8, 0.2]
    """
    if samples < FEWEST:
        raise ModelError([("samples", f"must be at least {FEWEST}, found {samples}")])
    count = 2 ** math.ceil(math.log2(samples))
    evaluations = count * (len(quantities) + 2)
    random = np.random.default_rng(seed)
    A, B = np.split(qmc.Sobol(2 * len(quantities), seed=random).random(count), 2, axis=1)
    mixed = np.repeat(A[None], len(quantities), axis=0)
    for n in range(len(quantities)):
        mixed[n, :, n] = B[:, n]
    y = output(np.concatenate((A, B, mixed.reshape(-1, len(quantities))))).reshape(-1, count)
    y = y - y[:2].mean()
    value = _saltelli(y)
    drawn = [_saltelli(y[:, random.integers(count, size=count)]) for _ in range(RESAMPLES)]
    ends = np.quantile(drawn, [(1 - confidence) / 2, (1 + confidence) / 2], axis=0)
    first, total = (tuple(map(Estimate, value[n].tolist(), ends[0, n].tolist(), ends[1, n].tolist())) for n in range(2))
    return SobolIndices(tuple(quantities), first, total, evaluations)


def morris_effects(
    output: Output, quantities: Sequence[str], trajectories: int = 20, seed: int = 0, confidence: float = CONFIDENCE
) -> MorrisEffects:
    """Elementary effects of Morris, a cheap screening: quantities + 1 evaluations for each path through the cube.

    Each quantity takes four levels between its 1 % and 99 % quantiles, at equal steps of probability.

    Parameters
    ----------
    output : callable
        As in `sobol_indices`.
    quantities : sequence of str
    trajectories : int
        Number of paths, at least 4.
    seed : int
    confidence : float

    Returns
    -------
    MorrisEffects

    Raises
    ------
    ModelError
        If SALib is not installed, or there are too few paths.

    References
    ----------
    M. D. Morris, Technometrics 33 (1991) 161-174; F. Campolongo et al., Environ. Model. Softw. 22 (2007) 1509-1518.

    Examples
    --------
    >>> found = morris_effects(lambda x: 2 * x[:, 0] + x[:, 1], ("a", "b"))
    >>> [round(effect.value, 9) for effect in found.mean_absolute]
    [2.0, 1.0]
    """
    try:
        from SALib.analyze import morris as analyse
        from SALib.sample import morris as draw
    except ModuleNotFoundError as error:
        if error.name and error.name.split(".")[0] != "SALib":
            raise
        raise ModelError("elementary effects: need SALib, which is not installed; install beal[uq]") from None
    if trajectories < FEWEST_PATHS:
        raise ModelError([("trajectories", f"must be at least {FEWEST_PATHS}, found {trajectories}")])
    span = 1 - 2 * TAIL  # SALib takes the step as a share of it
    bounds = [[TAIL, 1 - TAIL]] * len(quantities)
    problem = {"num_vars": len(quantities), "names": list(quantities), "bounds": bounds}
    points = draw.sample(problem, trajectories, num_levels=LEVELS, seed=seed)
    found = analyse.analyze(problem, points, output(points) / span, conf_level=confidence, num_levels=LEVELS, seed=seed)
    absolute = tuple(
        Estimate(float(value), max(0.0, float(value - half)), float(value + half))
        for value, half in zip(found["mu_star"], found["mu_star_conf"], strict=True)
    )
    mean, deviation = (tuple(float(value) for value in found[name]) for name in ("mu", "sigma"))
    return MorrisEffects(tuple(quantities), absolute, mean, deviation, len(points))


def _saltelli(y: Array) -> Array:
    """First order (Saltelli et al. 2010, table 2, b) and total (f), shape (2, quantities).

    The rows of y are f(A), f(B) and, for each quantity, f(A with that column from B).
    """
    A, B, mixed = y[0], y[1], y[2:]
    variance = y[:2].var()
    if variance == 0:
        return np.zeros((2, len(mixed)))
    return np.array([(B * (mixed - A)).mean(axis=1), 0.5 * ((A - mixed) ** 2).mean(axis=1)]) / variance
