"""The answer to a question of design: the best vehicle found, and the evidence for it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from beal.design.cutting import robust_optimum, silent
from beal.design.design_file import DesignStudy
from beal.design.optimise import Optimum, optimise
from beal.design.ranges import AllowedInterval, allowed_range
from beal.design.robust import WorstCase, scenarios, worst_case
from beal.design.sampling import Sample, sample
from beal.design.sensitivity import Sensitivity, sensitivity
from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.study.map import study_map
from beal.study.refined import RefinedMap, run_refined
from beal.study.study import Solve, Study, spaced
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from xarray import Dataset

T = TypeVar("T")
Count = Callable[[int, int], None]
Progress = Callable[[str, int, int], None]

SCAN = 41  # points from the design to either bound of a variable
LINE = 101  # points of a map over one variable
WIDTH = 0.005  # of the cells on the borders of a map over two, as a share of each axis


@dataclass(frozen=True)
class DesignAnswer:
    """The best vehicle found, and how it stands.

    Parameters
    ----------
    study : DesignStudy
    best : Optimum
        Where cases count, its critical thrust is that of the weakest.
    critical : CriticalThrust
        Of the design itself.
    given : CriticalThrust or None
        Of the vehicle in the file; None where it cannot be solved.
    ranges : dict of str to AllowedInterval
        For each variable the values around the design that keep a share of its critical thrust, all others and the
        linear bounds left alone.
    chart : Dataset
        Critical thrust over one or two variables, the others as designed.
    refined : RefinedMap or None
        The same over two, with the borders resolved.
    sensitivity : Sensitivity or None
    worst : WorstCase or None
        Within the tolerances.
    scatter : Sample or None
    scenarios : list of (str, CriticalThrust)
        The first is the design itself.
    gaps : tuple of str
        Evidence that could not be had, and why.
    """

    study: DesignStudy
    best: Optimum
    critical: CriticalThrust
    given: CriticalThrust | None
    ranges: dict[str, AllowedInterval]
    chart: "Dataset"
    refined: RefinedMap | None
    sensitivity: Sensitivity | None
    worst: WorstCase | None
    scatter: Sample | None
    scenarios: list[tuple[str, CriticalThrust]]
    gaps: tuple[str, ...]

    @property
    def asked(self) -> float | None:
        """Thrust that has to be borne, in N: the target, else the nominal thrust."""
        return self.study.target or self.best.vehicle.thrust.nominal

    @property
    def kept(self) -> float:
        """Critical thrust that the ranges keep, in N."""
        return _kept(self.study, self.critical)


def design_answer(study: DesignStudy, workers: int | None = None, progress: Progress | None = None) -> DesignAnswer:
    """Searches the best vehicle of a study and gathers the evidence.

    Parameters
    ----------
    study : DesignStudy
        From `beal.load_design`.
    workers : int, optional
        By default one for each core.
    progress : callable, optional
        Called with what is done, how much of it and of how much.

    Returns
    -------
    DesignAnswer

    Raises
    ------
    ModelError
        If no vehicle of the space reaches the target; the message has the nearest.
    ConvergenceError
        If the best design is not confirmed.
    """
    tell = progress or silent
    space, how = study.space, study.solve
    best, weakest = _best(study, workers, tell)
    vehicle, gaps = best.vehicle, _Gaps()
    solved = partial(critical_thrust, max_thrust=None, formulation=how.formulation, modes=how.modes)
    critical = solved(vehicle) if study.cases else best.critical
    goal = _kept(study, critical)
    ranges = {}
    for number, path in enumerate(space.variables):
        tell("ranges", number, len(space.variables))
        ranges[path] = _range(study, best, path, goal)
    charted, refined = _charted(study, best, ranges), None
    if len(charted.axes) == 1:
        chart = study_map(charted, workers=workers, progress=partial(tell, "map"))
    else:
        refined = run_refined(charted, WIDTH, workers=workers, progress=partial(tell, "map"))
        chart = refined.grid
    slopes = partial(sensitivity, vehicle, formulation=how.formulation, critical=critical, modes=how.modes)
    return DesignAnswer(
        study,
        best,
        critical,
        gaps.unless("the vehicle as given", partial(solved, space.vehicle)),
        ranges,
        chart,
        refined,
        gaps.unless("sensitivities", slopes),
        weakest or gaps.unless("worst case", partial(_worst, study, vehicle, workers, partial(tell, "worst case"))),
        gaps.unless("scatter", partial(_scatter, study, vehicle, workers, partial(tell, "scatter"))),
        gaps.unless("scenarios", lambda: scenarios(vehicle, study.scenarios, how) if study.scenarios else []) or [],
        tuple(gaps),
    )


def _kept(study: DesignStudy, critical: CriticalThrust) -> float:
    return study.keep * (critical.critical_thrust or 0.0)


def _best(study: DesignStudy, workers: int | None, tell: Progress) -> tuple[Optimum, WorstCase | None]:
    """The best design, and the weakest vehicle of its tolerances where that is what counts."""
    how = study.solve
    if study.cases and not study.quantile:
        return robust_optimum(
            study.space,
            study.tolerances,
            study.objective,
            study.target,
            starts=study.starts,
            solve=how,
            cases=study.scenarios,
            workers=workers,
            progress=tell,
        )
    best = optimise(
        study.space,
        study.objective,
        study.target,
        starts=study.starts,
        cases=study.cases,
        quantile=study.quantile,
        formulation=how.formulation,
        modes=how.modes,
        progress=partial(tell, "searches"),
    )
    return best, None


class _Gaps(list[str]):
    """What could not be had."""

    def unless(self, what: str, found: Callable[[], T]) -> T | None:
        """What is found, or None and a gap."""
        try:
            return found()
        except (ModelError, ConvergenceError) as error:
            self.append(f"{what}: {error}")
            return None


def _range(study: DesignStudy, best: Optimum, path: str, goal: float) -> AllowedInterval:
    """The values of a variable around the design, found from there to either bound."""
    one, space, how = study.space.variables[path], study.space, study.solve
    value = best.values[path]
    links = {follower: link for follower, link in space.links.items() if link.of == path}
    sides = {}
    for name, (low, high) in {"low": (one.low, value), "high": (value, one.high)}.items():
        if low < high:
            found = allowed_range(
                best.vehicle, path, low, high, goal, None, one.spacing, SCAN, how.formulation, how.modes, links
            ).intervals
            sides[name] = found[-1] if name == "low" else found[0]
    below = sides.get("low", AllowedInterval(value, value, "end", "end"))
    above = sides.get("high", AllowedInterval(value, value, "end", "end"))
    return AllowedInterval(below.low, above.high, below.low_edge, above.high_edge, below.low_kind, above.high_kind)


def _charted(study: DesignStudy, best: Optimum, ranges: dict[str, AllowedInterval]) -> Study:
    """A grid over the variables that are asked for, or whose ranges are the narrowest."""
    space, how = study.space, study.solve

    def width(path: str) -> float:
        return space.variables[path].share(ranges[path].high) - space.variables[path].share(ranges[path].low)

    axes = study.axes or tuple(sorted(space.variables, key=width)[:2])
    points = study.points if len(axes) == 2 else LINE
    chosen = {path: space.variables[path] for path in axes}
    grid = {path: spaced(one.low, one.high, points, one.spacing) for path, one in chosen.items()}
    links = {path: link for path, link in space.links.items() if link.of in axes}
    return Study(best.vehicle, grid, Solve(None, how.tolerance, how.formulation, how.modes), links)


def _worst(study: DesignStudy, vehicle: Vehicle, workers: int | None, progress: Count) -> WorstCase | None:
    return worst_case(vehicle, study.box(vehicle), study.solve, workers, progress) if study.tolerances else None


def _scatter(study: DesignStudy, vehicle: Vehicle, workers: int | None, progress: Count) -> Sample | None:
    uncertain, drawn = study.scattered(vehicle), study.sampling
    if uncertain is None:
        return None
    return sample(uncertain, drawn.samples, drawn.method, drawn.seed, study.solve, workers, progress)
