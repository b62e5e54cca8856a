"""Stability maps: the critical thrust over a grid of vehicles."""

import multiprocessing
import os
import signal
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, wait
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from beal.discretisation import Formulation
from beal.errors import ModelError
from beal.study.solve import solve_block
from beal.study.store import Arrays, Block, Store, attributes, blocks, empty, variable_attributes
from beal.study.study import Solve, Study
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], None]
SERIAL = 512  # points up to which starting processes costs more than it saves


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
        Zarr directory to write to, block by block; in memory alone if left out.
    resume : bool
        Whether to go on with what is in ``out``.
    workers : int, optional
        Processes; by default one for each core.
    progress : callable, optional
        Called with the number of points solved and of all points.

    Returns
    -------
    xarray.Dataset
        One dimension for each axis; ``critical_thrust`` is NaN where the vehicle is stable to the thrust searched to,
        and where ``status`` says that it could not be solved.

    Raises
    ------
    ModelError
        If an axis is not a quantity of the vehicle, an option does not apply, or the output cannot be written.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> axes = {"joint[0].rotational_stiffness": [10.0, 1e4]}
    >>> stability_map(catalog.tsto(0.5, 1.0, 1e4), axes)["kind"].values.tolist()
    [2, 1]
    """
    named = {path: tuple(float(value) for value in values) for path, values in axes.items()}
    study = Study(vehicle, named, Solve(max_thrust, tolerance, formulation, modes))
    return run_study(study, out, resume, workers, progress)


def run_study(
    study: Study,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
) -> "xarray.Dataset":
    """Solves all points of a study that are not solved yet.

    Parameters
    ----------
    study : Study
    out, resume, workers, progress
        As for `stability_map`.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    ModelError
        If the output cannot be written or belongs to another study.
    """
    if workers is not None and workers < 1:
        raise ModelError(f"workers: must be at least 1, found {workers}")
    store = Store(Path(out), study, resume) if out is not None else None
    solved = empty(study.shape) if store is None else {}
    todo = [block for block in blocks(study.shape) if store is None or store.pending(block)]
    total = int(np.prod(study.shape))
    done = total - sum(_points(block) for block in todo)

    def keep(block: Block, arrays: Arrays) -> None:
        nonlocal done
        if store is None:
            for name, values in arrays.items():
                solved[name][block] = values
        else:
            store.write(block, arrays)
        done += _points(block)
        if progress:
            progress(done, total)

    if progress:
        progress(done, total)
    with _executor(workers, total - done) as executor:
        _run(study, todo, executor, keep)
    if store is None:
        return _dataset(study, solved)
    import xarray

    return xarray.open_zarr(str(store.path))


def _points(block: Block) -> int:
    return int(np.prod([part.stop - part.start for part in block]))


def _executor(workers: int | None, points: int) -> "ProcessPoolExecutor | nullcontext[None]":
    workers = workers or os.cpu_count() or 1
    if workers == 1 or points <= SERIAL:
        return nullcontext()
    fork = "fork" in multiprocessing.get_all_start_methods()  # a script need not guard its main module
    context = multiprocessing.get_context("fork" if fork else None)
    return ProcessPoolExecutor(workers, mp_context=context, initializer=_ignore_interrupt)


def _ignore_interrupt() -> None:
    """Ctrl-C reaches the whole process group; only the parent, which keeps the store, acts on it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _run(study: Study, todo: Sequence[Block], executor: Executor | None, keep: Callable[[Block, Arrays], None]) -> None:
    """Solves blocks here or in the executor's workers; results are kept in this process as they come."""
    if executor is None:
        for block in todo:
            keep(block, solve_block(study, block))
        return
    futures = {executor.submit(solve_block, study, block): block for block in todo}
    try:
        while futures:
            for future in wait(futures, return_when=FIRST_COMPLETED).done:
                keep(futures.pop(future), future.result())
    finally:
        for future in futures:
            future.cancel()


def _dataset(study: Study, arrays: Arrays) -> "xarray.Dataset":
    import xarray

    dimensions = tuple(study.axes)
    units = study.vehicle.units
    variables = {name: (dimensions, values, variable_attributes(name, units)) for name, values in arrays.items()}
    coordinates = {path: np.array(values) for path, values in study.axes.items()}
    return xarray.Dataset(variables, coordinates, attributes(study))
