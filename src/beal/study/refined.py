"""Refined maps: a grid and the points that resolve its borders, in memory or in the zarr store of the grid."""

import math
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import Formulation
from beal.shown import Shown
from beal.study.blocks import together
from beal.study.lattice import ONE, Index, Integers, Lattice
from beal.study.map import Progress, study_map
from beal.study.place import Place
from beal.study.points import GROUP, PointStore, Variable
from beal.study.refine import LIMIT, Refined, refine
from beal.study.run import run, workers_for
from beal.study.solve import solve_points
from beal.study.store import attributes
from beal.study.study import Solve, Study
from beal.study.variables import VARIABLES, Arrays, empty, variable_attributes
from beal.vehicle.links import Link
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

Values = NDArray[np.float64]
Part = tuple[NDArray[np.intp], Values]  # numbers of points, and their values on the axes

MOST, FEW = 8192, 64  # points that are solved, and stored, at a time: with tables, each by itself
SIDES = ("kind", "mode_low", "mode_high", "status", "critical_thrust")


@dataclass(frozen=True)
class RefinedMap(Shown):
    """A stability map whose borders are resolved.

    Parameters
    ----------
    grid : Dataset
        As from `stability_map`.
    refined : Dataset
        Along ``point``, what was solved off the grid: a coordinate for each axis and the variables of the map. Along
        ``cell``, the narrow cells on the borders: ``low`` and ``high``, their corners on the axes, and what is on the
        two sides, such as ``side_kind``. Its attribute ``width`` is that of the widest such cell asked for.
    """

    grid: "xarray.Dataset"
    refined: "xarray.Dataset"


def refined_map(
    vehicle: Vehicle,
    axes: Mapping[str, Sequence[float]],
    width: float,
    formulation: Formulation = "objective",
    modes: int | None = None,
    max_thrust: float | None = None,
    tolerance: float = 1e-6,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
    limit: int = LIMIT,
    links: Mapping[str, Link] | None = None,
) -> RefinedMap:
    """Stability map with the borders between its regions resolved to a width.

    Solves the grid and its cells' centres, then halves the cells that a border crosses until they are narrower than
    the width: where the kind of instability or its modes change, where points cannot be solved, and where the critical
    thrust jumps by more than 2 %. Missed is what no point lies in: an island in a cell of the grid that reaches neither
    its corners nor its centre, or a tongue as thin as that all along; give a finer grid where such are expected.

    Parameters
    ----------
    vehicle : Vehicle
    axes : mapping of str to sequence of float
        Ascending values of each quantity, as for `stability_map`; the cells between them are halved in the spacing of
        the axis, logarithmic or linear. At most six axes with more than one value.
    width : float
        Widest cell on a border, as a share of each axis' whole range, such as 0.001.
    formulation, modes, max_thrust, tolerance, out, resume, workers, executor, links
        As for `stability_map`; in ``out`` the points are kept in the group ``refined``, and are not solved again when
        the map is resumed or refined to another width.
    progress : callable, optional
        Called with the number of points solved and of all points that are known to be needed.
    limit : int
        Number of points, those of the grid included.

    Returns
    -------
    RefinedMap

    Raises
    ------
    ModelError
        As from `stability_map`, or if the axes or the width do not allow refinement, or it needs more points than the
        limit.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> axes = {"joint[0].rotational_stiffness": [1.0, 1e4]}
    >>> found = refined_map(catalog.tsto(0.6, 1.0, 1e4), axes, width=1e-4).refined
    >>> found["side_kind"].values.tolist()
    [[2, 1]]
    >>> low, high = found["low"].item(), found["high"].item()
    >>> f"{low:.3f} {high:.3f}"
    '11.021 11.028'
    """
    named = {path: tuple(float(value) for value in values) for path, values in axes.items()}
    study = Study(vehicle, named, Solve(max_thrust, tolerance, formulation, modes), links or {})
    return run_refined(study, width, out, resume, workers, progress, executor, limit)


def run_refined(
    study: Study,
    width: float,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
    limit: int = LIMIT,
) -> RefinedMap:
    """Solves the grid of a study and resolves the borders in it.

    Parameters
    ----------
    study : Study
    width, out, resume, workers, progress, executor, limit
        As for `refined_map`.

    Returns
    -------
    RefinedMap

    Raises
    ------
    ModelError
        As from `refined_map`.
    """
    lattice = Lattice(study.axes, width)
    grid = study_map(study, out, resume, workers, progress, executor)
    columns = _Columns(study, lattice)
    store = None if out is None else PointStore(Place.of(out), columns.points(lattice.nowhere, empty((0,))))
    solve = _Solver(columns, store, workers, executor, progress)
    result = refine(lattice, {name: np.asarray(grid[name]) for name in VARIABLES}, solve, limit)
    import xarray

    if store is None:
        variables = columns.points(result.places, result.arrays) | columns.cells(result)
        refined = xarray.Dataset(variables, attrs=columns.attributes).set_coords(list(study.axes))
        return RefinedMap(grid, refined)
    store.finish(columns.cells(result), columns.attributes | {"coordinates": " ".join(study.axes)})
    return RefinedMap(grid, xarray.open_zarr(store.place.name, group=GROUP, chunks=None))


@dataclass(frozen=True)
class _Columns:
    """The variables of a refined map as dimensions, values and attributes."""

    study: Study
    lattice: Lattice

    def points(self, places: Integers, arrays: Arrays) -> dict[str, Variable]:
        units = self.study.vehicle.units
        found: dict[str, Variable] = {"place": (("point", "free_axis"), places, {"steps_of_a_grid_cell": ONE})}
        for path, values in zip(self.study.axes, self.lattice.values(places).T, strict=True):
            found[path] = ("point",), values, {}
        for name in VARIABLES:  # status last
            found[name] = ("point",), arrays[name], variable_attributes(name, units)
        return found

    def cells(self, found: Refined) -> dict[str, Variable]:
        units, values = self.study.vehicle.units, self.lattice.values
        ends: dict[str, Variable] = {
            "low": (("cell", "axis"), values(found.low), {}),
            "high": (("cell", "axis"), values(found.high), {}),
        }
        sides = {name: (("cell", "side"), found.sides[name], variable_attributes(name, units)) for name in SIDES}
        return ends | {f"side_{name}": side for name, side in sides.items()}

    @property
    def attributes(self) -> dict[str, Any]:
        spacing = self.lattice.spacing
        about = {"width": self.lattice.width, "axes": list(spacing), "spacing": list(spacing.values())}
        return attributes(self.study) | about


class _Solver:
    """Finds what is at places of the lattice: in the store, or by solving it and keeping it there."""

    def __init__(
        self,
        columns: _Columns,
        store: PointStore | None,
        workers: int | None,
        executor: Executor | None,
        progress: Progress | None,
    ) -> None:
        self.columns, self.store = columns, store
        self.workers, self.executor, self.progress = workers, executor, progress
        self._index = Index(columns.lattice.nowhere if store is None else store.read("place"))
        self._arrays = {} if store is None else {name: store.read(name) for name in VARIABLES}
        self._done = math.prod(columns.study.shape)

    def __call__(self, places: Integers) -> Arrays:
        arrays, at = empty((len(places),)), self._index.find(places)
        for name, values in self._arrays.items():
            arrays[name][at >= 0] = values[at[at >= 0]]
        unknown = np.flatnonzero(at < 0)
        self._done += len(places) - len(unknown)
        total = self._done + len(unknown)

        def keep(part: Part, solved: Arrays) -> None:
            points, _ = part
            for name, values in solved.items():
                arrays[name][points] = values
            if self.store is not None:
                columns = self.columns.points(places[points], solved)
                self.store.append({name: values for name, (_, values, _) in columns.items()})
            self._done += len(points)
            if self.progress:
                self.progress(self._done, total)

        study, values = self.columns.study, self.columns.lattice.values(places)
        own = workers_for(study, self.workers, len(unknown)) if self.executor is None else nullcontext(self.executor)
        with own as executor:
            run(_parts(study, values, unknown), partial(_solve, study), keep, executor)
        return arrays


def _parts(study: Study, values: Values, points: NDArray[np.intp]) -> Iterator[Part]:
    """Points in parts of about one cost, those that differ in springs alone next to each other."""
    others = [axis for axis, path in enumerate(study.axes) if not study.tabulated(path)]
    if others:
        points = points[np.lexsort(values[points][:, others].T)]
    size = MOST if together(study) else FEW
    for start in range(0, len(points), size):
        part = points[start : start + size]
        yield part, values[part]


def _solve(study: Study, part: Part) -> Arrays:
    return solve_points(study, part[1])
