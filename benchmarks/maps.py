"""Stability maps of the paper's vehicle against the plain way, in one run.

    python benchmarks/maps.py

The plain way (see critical_thrust.py) is timed on points of the same map. Times are the least of several runs, tables
made anew in each; the whole command is `beal map` in a process of its own, start-up and writing included.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from unittest import mock

import numpy as np
from critical_thrust import ROTATIONAL, SHEAR, plain_way

import beal
from beal.stability import scan, table
from beal.study import batch
from beal.vehicle.paths import with_values

POINTS = 100
SPLITS = (0.2, 0.4, 0.6, 0.8)
AXES = {ROTATIONAL: np.geomspace(1, 1e4, POINTS), SHEAR: np.geomspace(1e2, 1e4, POINTS)}
STUDY = f"""
model = "model.toml"
[grid]
"stage.split" = {{values = [SPLITS]}}
"{ROTATIONAL}" = {{from = 1, to = 1e4, points = {POINTS}, spacing = "log"}}
"{SHEAR}" = {{from = 1e2, to = 1e4, points = {POINTS}, spacing = "log"}}
"""


def least(task: Callable[[], object], repeats: int) -> float:
    """Least wall time of a task, in seconds."""
    times = []
    for _ in range(repeats):
        batch._panel.cache_clear()
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return min(times)


def plain_seconds(vehicle: beal.Vehicle) -> float:
    """Seconds a point of the plain way, over a sample of the map; the modes are not counted."""
    values = [{ROTATIONAL: r, SHEAR: s} for r, s in zip(AXES[ROTATIONAL][2::5], AXES[SHEAR][2::5][::-1], strict=True)]
    modal = [beal.discretise(with_values(vehicle, value), "corrected-ritz") for value in values]
    return least(lambda: [plain_way(operators) for operators in modal], 3) / len(modal)


def true_error(vehicle: beal.Vehicle, chart: object, sample: int) -> float:
    """Largest relative error over a sample of the map, the search for one vehicle to 1e-12 being the truth."""
    rng = np.random.default_rng(0)
    worst = 0.0
    for i, j in rng.integers(0, POINTS, (sample, 2)):
        at = {ROTATIONAL: AXES[ROTATIONAL][i], SHEAR: AXES[SHEAR][j]}
        exact = beal.critical_thrust(with_values(vehicle, at)).critical_thrust
        worst = max(worst, abs(float(chart.critical_thrust[i, j]) / exact - 1))
    return worst


def command(folder: Path, splits: tuple[float, ...]) -> float:
    """Seconds of `beal map`, the least of three."""
    (folder / "study.toml").write_text(STUDY.replace("SPLITS", ", ".join(map(str, splits))))
    times = []
    for number in range(4):  # the first fills the caches of the file system and of numba
        start = time.perf_counter()
        line = [Path(sys.executable).with_name("beal"), "map", "study.toml", "-o", f"{len(splits)}-{number}.zarr"]
        subprocess.run(line, cwd=folder, check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return min(times[1:])


def main() -> None:
    vehicle = beal.catalog.tsto(0.6, 5000.0, 5000.0)
    number = POINTS**2
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    plain = plain_seconds(vehicle)
    print(f"plain way                              {plain * 1e6:9.1f} us a point")

    def show(text: str, seconds: float) -> None:
        print(
            f"{text:38s} {seconds / number * 1e6:9.2f} us a point, {plain * number / seconds:6.0f} times the plain way"
        )

    def solve(workers: int) -> object:
        return beal.stability_map(vehicle, AXES, workers=workers)

    chart = solve(1)
    show("compiled kernel, tables included, 1 core", least(lambda: solve(1), 9))
    show("compiled kernel, 2 threads", least(lambda: solve(2), 9))
    paths, values = tuple(AXES), np.array([(r, s) for r in AXES[ROTATIONAL] for s in AXES[SHEAR]])
    tables = table.panel(vehicle, paths, "objective", (0.0, beal.stability.limit.default_limit(vehicle) / 4), False)
    factors = table.weights(vehicle, paths, values)
    show("compiled kernel alone, 1 core", least(lambda: scan.scan(tables, factors), 9))
    with mock.patch.object(scan, "compiled_kernels", bool), mock.patch.object(table, "compiled_kernels", bool):
        show("plain NumPy twin, tables included", least(lambda: solve(1), 5))
    estimate = float((chart.error_estimate / chart.critical_thrust).max())
    print(f"largest relative error {true_error(vehicle, chart, 200):.0e}, estimated {estimate:.0e}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "model.toml").write_text(
            (files("beal.vehicle.catalog") / "models" / "tsto.toml").read_text(encoding="utf-8")
        )
        print(f"beal map, {number} points, whole command    {command(folder, (0.6,)):5.2f} s")
        print(f"beal map, the four maps, {4 * number} points      {command(folder, SPLITS):5.2f} s")


if __name__ == "__main__":
    main()
