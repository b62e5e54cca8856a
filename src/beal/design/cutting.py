"""The best of the worst: a design whose weakest vehicle within tolerances is the strongest that was found."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from beal.design.cases import Case, Scattered, vertex_cases
from beal.design.optimise import Optimum, optimise
from beal.design.robust import WorstCase, box_around, worst_case
from beal.design.variables import DesignSpace
from beal.design.worth import Objective
from beal.study.study import Solve
from beal.vehicle.paths import value_at

Progress = Callable[[str, int, int], None]

ROUNDS = 6  # of search and attack
HELD = 1e-3  # relative difference of the weakest found and the weakest that was counted


def robust_optimum(
    space: DesignSpace,
    factors: Mapping[str, tuple[float, float]],
    objective: Objective = "critical_thrust",
    target: float | None = None,
    start: Mapping[str, float] | None = None,
    starts: int = 1,
    solve: Solve | None = None,
    cases: Sequence[Case] = (),
    workers: int | None = None,
    progress: Progress | None = None,
) -> tuple[Optimum, WorstCase | None]:
    """The design whose weakest vehicle within tolerances is the strongest, or the lightest that bears a target.

    The vertices of the box count first. A cliff may be worse between them: so the box around each result is searched
    for its weakest vehicle, which counts from then on, until the search finds none that is weaker.

    Parameters
    ----------
    space : DesignSpace
    factors : mapping of path to (float, float)
        Ends of factors on the quantities as designed; empty where other cases alone count.
    objective, target, start, starts
        As for `beal.optimise`.
    solve : Solve, optional
        Formulation and its modes.
    cases : sequence of Case
        That count beside the box, such as a `Scenario`.
    workers, progress
        As for `beal.worst_case`; progress is told what is done.

    Returns
    -------
    Optimum
    WorstCase or None
        What the last search of the box found; it may be weaker than what counted, after six rounds.

    Raises
    ------
    ModelError, ConvergenceError
        As from `beal.optimise` and `beal.worst_case`.

    References
    ----------
    A. Mutapcic, S. Boyd, Cutting-set methods for robust convex optimization with pessimizing oracles, Optimization
    Methods and Software 24 (2009) 381-406.

    Examples
    --------
    >>> from beal.design.variables import Variable
    >>> from beal.vehicle.catalog import beck
    >>> path = "stage[0].bending_stiffness"
    >>> best, weakest = robust_optimum(DesignSpace(beck(), {path: Variable(0.5, 2.0)}), {path: (0.9, 1.1)})
    >>> best.values[path], round(weakest.critical_thrust, 4)
    (2.0, 36.0917)
    """
    how, tell = solve or Solve(), progress or silent
    counted = [*vertex_cases(factors), *cases]
    weakest = None
    for number in range(1, ROUNDS + 1):
        best = optimise(
            space,
            objective,
            target,
            start,
            starts,
            how.formulation,
            how.modes,
            cases=counted,
            progress=partial(tell, f"round {number}, searches"),
        )
        if not factors:
            break
        box = box_around(best.vehicle, factors)
        weakest = worst_case(best.vehicle, box, how, workers, partial(tell, f"round {number}, attack"))
        if weakest.critical_thrust >= (1 - HELD) * min(best.case_thrusts):
            break
        moved = {path: value / value_at(best.vehicle, path) for path, value in weakest.values.items()}
        counted.append(Scattered(f"weakest of round {number}", moved))
        start, starts = best.values, 1
    return best, weakest


def silent(text: str, done: int, total: int) -> None:
    """Progress that nobody is told."""
