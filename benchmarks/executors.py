"""Points per second of a map by kind and number of workers, and what the engine adds to a block.

    python benchmarks/executors.py [POINTS]

POINTS, 300 by default, along each of two springs, on tables; twice POINTS lengths of the stages, one by one.
"""

import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

import numpy as np

import beal
from beal.study.blocks import blocks
from beal.study.cluster import cluster
from beal.study.map import run_study
from beal.study.run import Processes
from beal.study.solve import solve_block
from beal.study.store import prepare
from beal.study.study import Solve, Study

Workers = Callable[[], "AbstractContextManager[Executor | None]"]
WAYS: dict[str, Workers] = {
    "here": nullcontext,
    "1 thread": lambda: ThreadPoolExecutor(1),
    "2 threads": lambda: ThreadPoolExecutor(2),
    "1 process": lambda: Processes(1),
    "2 processes": lambda: Processes(2),
    "1 dask worker": lambda: cluster("local", 1),
    "2 dask workers": lambda: cluster("local", 2),
}


def studies(points: int) -> dict[str, Study]:
    vehicle = beal.catalog.tsto(0.6, 5000.0, 5000.0)
    rotational, shear = np.geomspace(1, 1e4, points).tolist(), np.geomspace(1e2, 1e4, points).tolist()
    splits = np.linspace(0.2, 0.8, 2 * points).tolist()
    springs = {"joint[0].rotational_stiffness": tuple(rotational), "joint[0].shear_stiffness": tuple(shear)}
    return {
        "springs, on tables": Study(vehicle, springs, Solve()),
        "stages, one by one": Study(vehicle, {"stage.split": tuple(splits)}, Solve()),
    }


def timed(study: Study, folder: Path, workers: Workers) -> float:
    """Seconds of a map on workers that have started and solved a first block each."""
    with workers() as executor:
        run_study(
            Study(study.vehicle, {path: axis[:8] for path, axis in study.axes.items()}, study.solve),
            folder / "first.zarr",
            executor=executor,
            workers=None if executor else 1,
        )
        start = time.perf_counter()
        run_study(study, folder / "map.zarr", executor=executor, workers=None if executor else 1)
        return time.perf_counter() - start


def pieces(study: Study, folder: Path) -> tuple[float, float]:
    """Mean seconds of solving a block and of writing it, over all blocks, when tables have been made."""
    store, cut, times = prepare(folder / "map.zarr", study, False), blocks(study), []
    solve_block(study, cut[0])
    for index in range(len(cut)):
        start = time.perf_counter()
        arrays = solve_block(study, cut[index])
        middle = time.perf_counter()
        store.write(index, arrays)
        times.append((middle - start, time.perf_counter() - middle))
    solve, write = np.mean(times, axis=0).tolist()
    return solve, write


def main() -> None:
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    for name, study in studies(points).items():
        cut = blocks(study)
        with tempfile.TemporaryDirectory() as folder:
            solve, write = pieces(study, Path(folder))
        number = int(cut.points.sum())
        print(f"{name}: {number} points in {len(cut)} blocks of {'x'.join(map(str, cut.sizes))}")
        print(f"  a block: {1e3 * solve:.1f} ms to solve, {1e3 * write:.1f} ms to write")
        alone = 0.0
        for way, workers in WAYS.items():
            with tempfile.TemporaryDirectory() as folder:
                seconds = timed(study, Path(folder), workers)
            alone = alone or seconds
            added = 1e3 * (seconds - len(cut) * (solve + write)) / len(cut)
            own = (
                f", engine {added:.1f} ms a block" if way in ("here", "1 thread", "1 process", "1 dask worker") else ""
            )
            print(f"  {way:15s} {number / seconds:9.0f} points/s, {alone / seconds:4.2f} times the first{own}")


if __name__ == "__main__":  # workers of dask import this file too
    main()
