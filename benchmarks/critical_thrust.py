"""Critical thrust of the two-stage vehicle: beal against the plain way, in one run on one core.

The plain way is what a script does: eight modes of the unloaded vehicle, thrust in steps of 0.25, eigenvalues at each
until one is complex or negative, bisection. Its time does not include finding the modes. Run with

    python benchmarks/critical_thrust.py [POINTS OF EACH AXIS OF THE MAP]
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import platform
import statistics
import sys
import time
from collections.abc import Callable

import numpy as np

import beal
from beal.discretisation import Operators
from beal.vehicle.paths import with_values

ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
SPLIT = 0.6
STEP, LIMIT = 0.25, 300.0


def plain_way(operators: Operators) -> float:
    """Critical thrust by sweep and bisection, to 1e-6."""

    def stable(thrust: float) -> bool:
        roots = np.linalg.eigvals(np.linalg.solve(operators.M, operators.stiffness(thrust)))
        return bool(np.all(np.abs(roots.imag) < 1e-6) and np.all(roots.real > 0))

    high = STEP
    while high < LIMIT and stable(high):
        high += STEP
    low = high - STEP
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (middle, high) if stable(middle) else (low, middle)
    return high


def seconds(task: Callable[[], object], repeats: int) -> float:
    """Median wall time of a task."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main(points: int) -> None:
    vehicle = beal.catalog.tsto(SPLIT, 5000.0, 5000.0)
    axes = {ROTATIONAL: np.geomspace(1, 1e4, points), SHEAR: np.geomspace(1e2, 1e4, points)}
    sample = [(axes[ROTATIONAL][i], axes[SHEAR][i]) for i in range(0, points, max(points // 20, 1))]
    modal = [
        beal.discretise(with_values(vehicle, {ROTATIONAL: k_r, SHEAR: k_s}), "corrected-ritz") for k_r, k_s in sample
    ]
    plain = seconds(lambda: [plain_way(operators) for operators in modal], 3) / len(sample)
    exact = [
        beal.critical_thrust(with_values(vehicle, {ROTATIONAL: k_r, SHEAR: k_s}), formulation="converged")
        for k_r, k_s in sample
    ]
    off = [abs(plain_way(o) / e.critical_thrust - 1) for o, e in zip(modal, exact, strict=True) if e.critical_thrust]
    found = beal.critical_thrust(vehicle)
    chart = beal.stability_map(vehicle, axes)
    estimated = float((chart["error_estimate"] / chart["critical_thrust"]).max())
    single = seconds(lambda: beal.critical_thrust(vehicle), 21)
    whole = seconds(lambda: beal.stability_map(vehicle, axes, workers=1), 3) / points**2
    both = seconds(lambda: beal.stability_map(vehicle, axes, workers=2), 3) / points**2

    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    print(
        f"plain way, one vehicle           {plain * 1e3:7.2f} ms, relative error {statistics.median(off):.0e} "
        f"(median), {max(off):.0e} (largest)"
    )
    print(
        f"critical_thrust, one vehicle     {single * 1e3:7.2f} ms, relative error estimate "
        f"{found.error_estimate / found.critical_thrust:.0e}"
    )
    print(
        f"stability_map, a point, 1 core   {whole * 1e3:7.3f} ms, relative error estimate {estimated:.0e} (largest), "
        f"{plain / whole:.0f} times the plain way's points per second"
    )
    print(f"stability_map, a point, 2 cores  {both * 1e3:7.3f} ms, {1 / both:.0f} points per second")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
