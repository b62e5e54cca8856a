"""Correlated quantities through a Gaussian copula: normal scores with a correlation, each mapped to its own law."""

import math
from collections.abc import Mapping
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import special
from scipy.optimize import brentq

from beal.design.distributions import DRAWN, Distribution
from beal.errors import ModelError

Array = NDArray[np.float64]
Measure = Literal["spearman", "pearson"]
Pair = tuple[str, str]

NODES = 48  # of Gauss and Hermite in each score
STRONGEST = 0.999  # correlation of scores looked for
SMALLEST = 1e-10  # eigenvalue of a correlation matrix that counts as positive


def score_correlation(
    distributions: Mapping[str, Distribution], pairs: Mapping[Pair, float], measure: Measure
) -> Array:
    """Correlation matrix of the normal scores that gives the quantities the correlation asked for.

    Spearman: 2 sin(pi r/6), exact for continuous laws. Pearson: solved for, pair by pair (Nataf transformation).

    Parameters
    ----------
    distributions : mapping of path to Distribution
    pairs : mapping of (path, path) to float
        Correlation of two quantities; those not named are not correlated.
    measure : {"spearman", "pearson"}

    Returns
    -------
    ndarray, shape (quantities, quantities)

    Raises
    ------
    ModelError
        If a pair is unknown, given twice or out of reach of its laws, or the matrix is not positive definite.

    References
    ----------
    A. Der Kiureghian and P.-L. Liu, J. Eng. Mech. 112 (1986) 85-104.

    Examples
    --------
    >>> both = {"a": Distribution.uniform(0, 1), "b": Distribution.uniform(2, 3)}
    >>> score_correlation(both, {("a", "b"): 0.5}, "spearman").round(4).tolist()
    [[1.0, 0.5176], [0.5176, 1.0]]
    """
    names = list(distributions)
    given, scores = np.eye(len(names)), np.eye(len(names))
    problems: list[tuple[str, str]] = []
    for (first, second), value in pairs.items():
        where = f"correlation of {first} and {second}"
        unknown = [name for name in (first, second) if name not in distributions]
        if unknown:
            problems.append((where, f"{unknown[0]} is not among the uncertain quantities"))
        elif first == second:
            problems.append((where, "needs two different quantities"))
        elif not -1 < value < 1:
            problems.append((where, f"must lie between -1 and 1, found {value}"))
        elif given[names.index(first), names.index(second)] != 0:
            problems.append((where, "is given twice"))
        else:
            i, j = names.index(first), names.index(second)
            given[i, j] = given[j, i] = value
            if measure == "spearman":
                score = 2 * math.sin(math.pi * value / 6)
            else:
                score = _nataf(distributions[first], distributions[second], value, where)
            scores[i, j] = scores[j, i] = score
    if problems:
        raise ModelError(problems)
    for matrix, what in ((given, "given"), (scores, "of the normal scores")):
        smallest = float(np.linalg.eigvalsh(matrix)[0])
        if smallest < SMALLEST:
            message = f"the matrix {what} must be positive definite, found the eigenvalue {smallest:.3g}"
            raise ModelError([("correlation", f"{message}; the correlations contradict each other")])
    return scores


def probability(score: Array) -> Array:
    """Of a normal score, away from 0 and 1 where the value may be infinite."""
    return np.clip(special.ndtr(score), DRAWN, 1 - DRAWN)


def _nataf(first: Distribution, second: Distribution, value: float, where: str) -> float:
    nodes, weights = np.polynomial.hermite_e.hermegauss(NODES)
    weights = weights / weights.sum()

    def standard(law: Distribution) -> tuple[float, float]:
        x = law.quantile(probability(nodes))
        mean = float(weights @ x)
        return mean, math.sqrt(float(weights @ (x - mean) ** 2))

    (m1, s1), (m2, s2) = standard(first), standard(second)
    x1 = (first.quantile(probability(nodes)) - m1) / s1

    def reached(score: float) -> float:
        z = score * nodes[:, None] + math.sqrt(1 - score**2) * nodes[None, :]
        return float(weights @ (x1[:, None] * (second.quantile(probability(z)) - m2) / s2) @ weights)

    low, high = reached(-STRONGEST), reached(STRONGEST)
    if not low <= value <= high:
        raise ModelError([(where, f"these distributions reach {low:.3g} to {high:.3g} only, found {value}")])
    return float(brentq(lambda score: reached(score) - value, -STRONGEST, STRONGEST, xtol=1e-10))
