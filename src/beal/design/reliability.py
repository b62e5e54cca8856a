"""What a sample says of the critical thrust: probabilities and quantiles, each with its confidence interval."""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from beal.design.sampling import Sample
from beal.errors import ModelError

CONFIDENCE = 0.95
FEW = 2  # a scramble


@dataclass(frozen=True)
class Estimate:
    """A number estimated from a sample.

    Parameters
    ----------
    value : float
    low, high : float
        Ends of the confidence interval. Vehicles that could not be solved widen it: they count as stable for one end
        and as unstable for the other.
    """

    value: float
    low: float
    high: float


def probability_of_instability(found: Sample, thrust: float, confidence: float = CONFIDENCE) -> Estimate:
    """Probability that a vehicle becomes unstable at or below a thrust.

    For random numbers the interval is that of Clopper and Pearson, exact for any number of samples. For Sobol'
    sequences it is Student's over the independent scrambles, unless all agree or so few vehicles are
    unstable, or stable, that their spread says little.

    Parameters
    ----------
    found : Sample
    thrust : float
        In N, at most the one searched to.
    confidence : float

    Returns
    -------
    Estimate
        Its value counts the vehicles that were solved.

    Raises
    ------
    ModelError
        If the sample says nothing about that thrust.

    References
    ----------
    C. J. Clopper and E. S. Pearson, Biometrika 26 (1934) 404-413.
    """
    if not 0 <= thrust <= found.searched_to:
        limit = f"{found.searched_to:.6g}, searched to"
        raise ModelError([("thrust", f"must lie between 0 and {limit}, found {thrust}; raise max_thrust")])
    solved = _some_solved(found)
    unstable = found.critical_thrust <= thrust
    count, failed = int(unstable.sum()), found.failed
    parts = unstable.reshape(found.replicates, -1).mean(axis=1)
    if parts.std() > 0 and min(count, solved - count) >= FEW * found.replicates:
        error = float(stats.sem(parts) * stats.t.ppf((1 + confidence) / 2, found.replicates - 1))
        middle = count / found.count
        low, high = max(0.0, middle - error), min(1.0, middle + failed / found.count + error)
    else:
        tail = (1 - confidence) / 2
        low = float(stats.beta.ppf(tail, count, found.count - count + 1)) if count else 0.0
        most = count + failed
        high = float(stats.beta.ppf(1 - tail, most + 1, found.count - most)) if most < found.count else 1.0
    return Estimate(count / solved, low, high)


def thrust_quantile(found: Sample, probability: float, confidence: float = CONFIDENCE) -> Estimate:
    """Critical thrust below which a share of the vehicles fails.

    The interval is between two members of the sorted sample, without any assumption on the distribution; for Sobol'
    sequences it is wider than need be.

    Parameters
    ----------
    found : Sample
    probability : float
        Between 0 and 1.
    confidence : float

    Returns
    -------
    Estimate
        In N; infinite where the vehicles are stable to the thrust searched to.

    Raises
    ------
    ModelError
        If there are too few samples for an interval at that probability.

    Examples
    --------
    >>> thrusts = np.arange(1.0, 1001.0)
    >>> found = Sample(("k",), thrusts[:, None], thrusts, np.ones(1000, np.int8), 2e3, "monte-carlo", 0, 1)
    >>> thrust_quantile(found, 0.5)
    Estimate(value=500.0, low=469.0, high=532.0)
    """
    if not 0 < probability < 1:
        raise ModelError([("quantile", f"must lie between 0 and 1, found {probability}")])
    solved, tail = _some_solved(found), (1 - confidence) / 2
    below = int(stats.binom.ppf(tail, found.count, probability))
    above = int(stats.binom.ppf(1 - tail, found.count, probability)) + 1
    if stats.binom.cdf(0, found.count, min(probability, 1 - probability)) > tail:
        needed = int(np.ceil(np.log(tail) / np.log1p(-min(probability, 1 - probability))))
        raise ModelError([("samples", f"quantile {probability:g} needs at least {needed}, found {found.count}")])
    thrusts = np.sort(found.critical_thrust)[:solved]  # NaN comes last
    lowest = np.concatenate((np.zeros(found.failed), thrusts))
    highest = np.concatenate((thrusts, np.full(found.failed, np.inf)))
    value = thrusts[max(0, int(np.ceil(probability * solved)) - 1)]
    return Estimate(float(value), float(lowest[max(below, 1) - 1]), float(highest[min(above, found.count) - 1]))


def _some_solved(found: Sample) -> int:
    if found.failed == found.count:
        raise ModelError("no vehicle of the sample could be solved")
    return found.count - found.failed
