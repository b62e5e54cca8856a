"""Stability maps: the critical thrust over a grid of vehicles."""

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from beal.discretisation import Formulation
from beal.errors import ModelError
from beal.study.blocks import Blocks, blocks
from beal.study.place import Place
from beal.study.run import run, workers_for
from beal.study.solve import solve_block
from beal.study.store import Store, attributes, prepare
from beal.study.study import Solve, Study
from beal.study.summary import Summary
from beal.study.variables import Arrays, empty, variable_attributes
from beal.vehicle.links import Link
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], None]
IN_MEMORY = 10_000_000  # points, some 0.4 GB


def stability_map(
    vehicle: Vehicle,
    axes: Mapping[str, Sequence[float]],
    formulation: Formulation = "objective",
    modes: int | None = None,
    max_thrust: float | None = None,
    tolerance: float = 1e-6,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
    links: Mapping[str, Link] | None = None,
) -> "xarray.Dataset":
    """Critical thrust, kind and modes over a grid of vehicles.

    Parameters
    ----------
    vehicle : Vehicle
    axes : mapping of str to sequence of float
        Values of each quantity, named by its path in the model, such as ``joint[0].shear_stiffness`` or
        ``stage.split``; the first varies slowest.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
    modes : int, optional
        Number of modes of the Ritz formulations.
    max_thrust : float, optional
        Thrust to search to, in N.
    tolerance : float
        Relative error to reach at each point.
    out : str or Path, optional
        Zarr folder, or URL that fsspec understands, to which workers write block by block; in memory alone if left out.
    resume : bool
        Whether to go on with what is in ``out``.
    workers : int, optional
        Threads or processes of this machine, whichever suit the study; by default one for each core.
    progress : callable, optional
        Called with the number of points solved and of all points.
    executor : concurrent.futures.Executor, optional
        Solves the blocks in place of this machine's workers, such as ``client.get_executor()`` of dask.
    links : mapping of str to Link, optional
        By the path of a quantity that follows one of the axes.

    Returns
    -------
    xarray.Dataset
        One dimension for each axis; ``critical_thrust`` is NaN where the vehicle is stable to the thrust searched to,
        and where ``status`` says that it could not be solved.

    Raises
    ------
    ModelError
        If an axis is not a quantity of the vehicle, an option does not apply, the output cannot be written, or the map
        is too large for the memory.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> axes = {"joint[0].rotational_stiffness": [10.0, 1e4]}
    >>> stability_map(catalog.tsto(0.5, 1.0, 1e4), axes)["kind"].values.tolist()
    [2, 1]
    """
    named = {path: tuple(float(value) for value in values) for path, values in axes.items()}
    study = Study(vehicle, named, Solve(max_thrust, tolerance, formulation, modes), links or {})
    return study_map(study, out, resume, workers, progress, executor)


def study_map(
    study: Study,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
) -> "xarray.Dataset":
    """Solves all points of a study.

    Parameters
    ----------
    study : Study
    out, resume, workers, progress, executor
        As for `stability_map`.

    Returns
    -------
    xarray.Dataset
        As from `stability_map`.

    Raises
    ------
    ModelError
        As from `stability_map`.
    """
    if out is None:
        return _in_memory(study, workers, progress, executor)
    run_study(study, out, resume, workers, progress, executor)
    import xarray

    return xarray.open_zarr(Place.of(out).name, chunks=None)


def run_study(
    study: Study,
    out: str | Path,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: Executor | None = None,
) -> Summary:
    """Solves all points of a study that are not solved yet, onto a disk.

    The workers write their blocks themselves; here only numbers arrive, so that the memory is bounded by the blocks in
    work and not by the map.

    Parameters
    ----------
    study : Study
    out, resume, workers, progress, executor
        As for `stability_map`.

    Returns
    -------
    Summary
        Of all points, those of earlier runs included.

    Raises
    ------
    ModelError
        If the output cannot be written or belongs to another study.
    """
    _check(workers, executor)
    store = prepare(out, study, resume)
    if not store.place.is_shared:
        if not isinstance(executor, ThreadPoolExecutor | None):
            raise ModelError(f"{out}: only this process sees it; give a folder, or a URL that all workers see")
        workers = 1
    ready = store.done()
    points, total = store.blocks.points, math.prod(study.shape)
    found = sum((Summary.of(store.read(int(index))) for index in np.flatnonzero(ready)), Summary())

    def keep(index: int, summary: Summary) -> None:
        nonlocal found
        found += summary
        if progress:
            progress(found.points, total)

    if progress:
        progress(found.points, total)
    with _workers(study, workers, executor, int(points[~ready].sum())) as crew:
        run(map(int, np.flatnonzero(~ready)), _Written(store), keep, crew)
    return found


@dataclass(frozen=True)
class _Written:
    """Solves a block of the study in a store and writes it there."""

    store: Store

    def __call__(self, index: int) -> Summary:
        arrays = solve_block(self.store.study, self.store.blocks[index])
        self.store.write(index, arrays)
        return Summary.of(arrays)


def _in_memory(
    study: Study, workers: int | None, progress: Progress | None, executor: Executor | None
) -> "xarray.Dataset":
    _check(workers, executor)
    total, done = math.prod(study.shape), 0
    if total > IN_MEMORY:
        raise ModelError(f"grid: at most {IN_MEMORY} points in memory, found {total}; name an output, out=PATH")
    solved, cuts = empty(study.shape), blocks(study)

    def keep(index: int, arrays: Arrays) -> None:
        nonlocal done
        for name, values in arrays.items():
            solved[name][cuts[index]] = values
        done += int(cuts.points[index])
        if progress:
            progress(done, total)

    with _workers(study, workers, executor, total) as crew:
        run(range(len(cuts)), partial(_solved, study, cuts), keep, crew)
    return _dataset(study, solved)


def _solved(study: Study, cuts: Blocks, index: int) -> Arrays:
    return solve_block(study, cuts[index])


def _check(workers: int | None, executor: Executor | None) -> None:
    if workers is not None and executor is not None:
        raise ModelError("workers: an executor brings its own; leave one of the two out")


def _workers(
    study: Study, workers: int | None, executor: Executor | None, points: int
) -> AbstractContextManager[Executor | None]:
    return workers_for(study, workers, points) if executor is None else nullcontext(executor)


def _dataset(study: Study, arrays: Arrays) -> "xarray.Dataset":
    import xarray

    dimensions = tuple(study.axes)
    units = study.vehicle.units
    variables = {name: (dimensions, values, variable_attributes(name, units)) for name, values in arrays.items()}
    coordinates = {path: np.array(values) for path, values in study.axes.items()}
    return xarray.Dataset(variables, coordinates, attributes(study))
