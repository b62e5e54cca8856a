"""Critical thrusts of many random vehicles: drawn, solved on the kernel of the maps where that applies, counted."""

import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from beal.design.uncertain import Uncertain
from beal.discretisation.build import RITZ
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.limit import default_limit
from beal.stability.threads import one_thread
from beal.study.blocks import ALONE, DAMPED
from beal.study.run import SMALL, Processes, cores, run
from beal.study.solve import solve_points
from beal.study.study import Solve, Study
from beal.study.variables import KINDS, STATUS
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]
Method = Literal["monte-carlo", "sobol"]
Progress = Callable[[int, int], None]

FEWEST = 64  # samples
MOST = 100_000_000
REPLICATES = 16  # independent scrambles of a Sobol' sequence, whose spread is the error
SHARED, SINGLE = 20_000, 16  # samples of a task: solved together, one by one


@dataclass(frozen=True)
class Sample(Shown):
    """Random vehicles and the thrusts at which they fail.

    Parameters
    ----------
    paths : tuple of str
        Of the quantities.
    values : ndarray, shape (samples, quantities)
    critical_thrust : ndarray, shape (samples,)
        In N; infinite where the vehicle is stable to the thrust searched to, NaN where it could not be solved.
    kind : ndarray of int, shape (samples,)
        0 stable, 1 flutter, 2 divergence; -1 where it could not be solved.
    searched_to : float
    method : {"monte-carlo", "sobol"}
    seed : int
    replicates : int
        Independent parts of equal size, one after the other.
    truncated : mapping of path to float
        Probability that was cut off.
    units : {"SI", "nondimensional"}
    """

    paths: tuple[str, ...]
    values: Array
    critical_thrust: Array
    kind: NDArray[np.int8]
    searched_to: float
    method: Method
    seed: int
    replicates: int
    truncated: dict[str, float] = field(default_factory=dict)
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def kinds(self) -> dict[str, int]:
        """How many are stable to the thrust searched to, flutter and diverge."""
        return {name: int((self.kind == n).sum()) for n, name in enumerate(KINDS)}

    @property
    def failed(self) -> int:
        """How many could not be solved."""
        return int(np.isnan(self.critical_thrust).sum())

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.critical_thrust)


def sample(
    uncertain: Uncertain,
    samples: int = 4096,
    method: Method = "sobol",
    seed: int = 0,
    solve: Solve | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Sample:
    """Draws vehicles and finds the critical thrust of each.

    Where all uncertain quantities are joint springs (or the tangency of a supported vehicle), a million vehicles take
    seconds; where another one scatters too, each vehicle costs some ten milliseconds.

    Parameters
    ----------
    uncertain : Uncertain
    samples : int
        At least 64; of Sobol' sequences the next power of two is taken.
    method : {"sobol", "monte-carlo"}
        Sobol' sequences, scrambled sixteen times, or plain random numbers.
    seed : int
        The same seed gives the same sample.
    solve : Solve, optional
        How each vehicle is solved. All are searched to one thrust, by default that of `beal.critical_thrust` for
        the vehicle with median values.
    workers : int, optional
        By default one for each core.
    progress : callable, optional
        Called with the number of vehicles solved and of all.

    Returns
    -------
    Sample

    Raises
    ------
    ModelError
        If there are too few samples or too many, or the method is unknown.

    Examples
    --------
    >>> from beal.design.distributions import Distribution
    >>> from beal.vehicle import catalog
    >>> spring = {"joint[0].rotational_stiffness": Distribution.lognormal(median=2.0, cv=0.3)}
    >>> found = sample(Uncertain(catalog.tsto(0.5, 2.0, 1e4), spring), 64, workers=1)
    >>> found.count, found.failed
    (64, 0)
    """
    replicates = REPLICATES if method == "sobol" else 1
    values = uncertain.values(_cube(len(uncertain.distributions), samples, method, seed, replicates))
    thrust, kind, limit = solve_values(uncertain, values, solve, workers, progress)
    return Sample(
        tuple(uncertain.distributions),
        values,
        thrust,
        kind,
        limit,
        method,
        seed,
        replicates,
        uncertain.truncated,
        uncertain.vehicle.units,
    )


def solve_values(
    uncertain: Uncertain,
    values: Array,
    solve: Solve | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> tuple[Array, NDArray[np.int8], float]:
    """Critical thrust and kind for values of the uncertain quantities, and the thrust searched to, as in `Sample`."""
    solve = solve or Solve()
    limit = solve.max_thrust or default_limit(median_vehicle(uncertain))
    axes = {path: (law.median,) for path, law in uncertain.laws.items()}
    study = Study(uncertain.vehicle, axes, Solve(limit, solve.tolerance, solve.formulation, solve.modes))
    shared = on_tables(study)
    size, cost = (SHARED, 0.0) if shared else (SINGLE, DAMPED if study.vehicle.damped else ALONE)
    thrust, kind = np.full(len(values), np.nan), np.full(len(values), -1, dtype=np.int8)
    done = 0

    def keep(part: slice, found: tuple[Array, NDArray[np.int8]]) -> None:
        nonlocal done
        thrust[part], kind[part] = found
        done += len(found[0])
        if progress:
            progress(done, len(values))

    tasks = {start: values[start : start + size] for start in range(0, len(values), size)}
    with _workers(shared, len(values) * cost, len(tasks), workers) as executor:
        run(
            tasks.items(),
            partial(_solved, study),
            lambda task, found: keep(slice(task[0], task[0] + size), found),
            executor,
        )
    return thrust, kind, limit


def median_vehicle(uncertain: Uncertain) -> Vehicle:
    """The vehicle with the median of every uncertain quantity."""
    axes = {path: (law.median,) for path, law in uncertain.laws.items()}
    return Study(uncertain.vehicle, axes, Solve()).at(axis[0] for axis in axes.values())


def on_tables(study: Study) -> bool:
    """Whether all vehicles of a study, whatever the values, share one table."""
    ritz = study.solve.formulation in RITZ
    return not ritz and not study.vehicle.damped and all(map(study.tabulated, study.axes))


def _solved(study: Study, task: tuple[int, Array]) -> tuple[Array, NDArray[np.int8]]:
    found = solve_points(study, task[1])
    solved, kind = found["status"] == STATUS.index("solved"), found["kind"].astype(np.int8)
    thrust = np.where(kind == 0, np.inf, found["critical_thrust"])
    return np.where(solved, thrust, np.nan), np.where(solved, kind, -1).astype(np.int8)


def _cube(quantities: int, samples: int, method: Method, seed: int, replicates: int) -> Array:
    """Uniform numbers, shape (samples, quantities)."""
    if not FEWEST <= samples <= MOST:
        raise ModelError([("samples", f"must lie between {FEWEST} and {MOST}, found {samples}")])
    random = np.random.default_rng(seed)
    if method == "monte-carlo":
        return random.random((samples, quantities))
    if method != "sobol":
        raise ModelError([("method", f"must be one of sobol, monte-carlo, found {method!r}")])
    power = math.ceil(math.log2(samples / replicates))
    return np.concatenate([qmc.Sobol(quantities, seed=child).random_base2(power) for child in random.spawn(replicates)])


@contextmanager
def _workers(shared: bool, seconds: float, tasks: int, workers: int | None) -> Iterator[Executor | None]:
    """Threads for the kernel, processes for vehicles solved one by one, neither for a small job."""
    number = workers or cores()
    if number < 1:
        raise ModelError([("workers", f"must be at least 1, found {workers}")])
    if number == 1 or tasks == 1:
        yield None
    elif shared:
        with one_thread(), ThreadPoolExecutor(number) as threads:
            yield threads
    elif seconds > SMALL:
        with Processes(number) as processes:
            yield processes
    else:
        yield None
