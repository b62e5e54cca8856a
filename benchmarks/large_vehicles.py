"""Critical thrust of vehicles of 2 to 1000 stages: time against size, on one core.

Four kinds, all as long, heavy and stiff as a uniform beam of EI = m = L = 1: stages that differ from each other and
are joined rigidly; the same on springs that are together as soft as the beam; a stick model, which adds a point mass
in every stage; the springs with damping in stages and joints. The dense matrices of the second kind are timed as far
as they are bearable. Run with

    python benchmarks/large_vehicles.py [FIGURE.png]
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import platform
import statistics
import sys
import time

import numpy as np

import beal
from beal.stability import large

SIZES = (2, 4, 8, 12, 20, 30, 50, 100, 200, 300, 500, 700, 1000)
DENSE_TO = 50
FITTED_FROM = 100  # below, the time is that of the reduced problem and does not depend on the size
REPEATS = 3


def vehicles(stages: int) -> dict[str, beal.Vehicle]:
    """One vehicle of each kind."""
    ripple = 1 + 0.2 * np.sin(np.arange(stages))
    lengths = ripple / ripple.sum()
    beams = [
        beal.Stage(length=x, mass_per_length=1.0, bending_stiffness=r)
        for x, r in zip(lengths, ripple[::-1], strict=True)
    ]
    springs = beal.Joint(rotational_stiffness=float(stages), shear_stiffness=100.0 * stages)
    damped = [beam.model_copy(update={"internal_damping": 1e-3, "external_damping": 0.1}) for beam in beams]
    dashpots = springs.model_copy(update={"rotational_damping": 1e-3 * stages})
    middles = np.cumsum(lengths) - lengths / 2
    lumps = [beal.PointMass(station=x, mass=m) for x, m in zip(middles, lengths, strict=True)]
    return {
        "rigid joints": beal.Vehicle(stages=beams, joints=[beal.Joint()] * (stages - 1)),
        "springs": beal.Vehicle(stages=beams, joints=[springs] * (stages - 1)),
        "stick model": beal.Vehicle(stages=beams, joints=[springs] * (stages - 1), point_masses=lumps),
        "springs, damped": beal.Vehicle(stages=damped, joints=[dashpots] * (stages - 1)),
    }


def seconds(vehicle: beal.Vehicle, segments: int) -> tuple[float, beal.CriticalThrust]:
    """Median wall time with the sparse matrices taken from a number of segments, and what was found."""
    large.SEGMENTS = segments
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        found = beal.critical_thrust(vehicle)
        times.append(time.perf_counter() - start)
    return statistics.median(times), found


def exponent(sizes: list[int], times: list[float]) -> float:
    """Slope of the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def main(figure: str | None) -> None:
    default = large.SEGMENTS
    table: dict[str, list[float]] = {}
    estimates, differences = [], []
    for stages in SIZES:
        for name, vehicle in vehicles(stages).items():
            elapsed, found = seconds(vehicle, default)
            table.setdefault(name, []).append(elapsed)
            estimates.append(found.error_estimate / found.critical_thrust)
            if name == "springs" and stages <= DENSE_TO:
                elapsed, dense = seconds(vehicle, sys.maxsize)
                table.setdefault("springs, dense", []).append(elapsed)
                differences.append(abs(found.critical_thrust / dense.critical_thrust - 1))

    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    print(f"{'stages':>12} " + " ".join(f"{name + ', s':>18}" for name in table))
    for row, stages in enumerate(SIZES):
        cells = (f"{times[row]:18.3f}" if row < len(times) else " " * 18 for times in table.values())
        print(f"{stages:12} " + " ".join(cells))
    for name, times in table.items():
        start = 8 if "dense" in name else FITTED_FROM
        pairs = [(n, t) for n, t in zip(SIZES, times, strict=False) if n >= start]
        sizes, fitted = [n for n, _ in pairs], [t for _, t in pairs]
        print(f"{name}: time grows as N^{exponent(sizes, fitted):.2f} from {sizes[0]} to {sizes[-1]} stages")
    print(
        f"relative error estimate {max(estimates):.0e} (largest), from dense matrices {max(differences):.0e} (largest)"
    )
    if figure:
        draw(table, figure)


def draw(table: dict[str, list[float]], path: str) -> None:
    """Time over size, both logarithmic, with slopes to compare."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    drawing, axes = pyplot.subplots(figsize=(6.4, 4.4), layout="constrained")
    for name, times in table.items():
        axes.loglog(SIZES[: len(times)], times, "o--" if "dense" in name else "o-", markersize=4, label=name)
    ends = np.array([FITTED_FROM, SIZES[-1]])
    last = table["stick model"][-1]
    axes.loglog(ends, 1.5 * last * (ends / ends[-1]) ** 1.5, "k:", label=r"$N^{1.5}$")
    axes.set(xlabel="stages", ylabel="time of one critical thrust [s]", title="Large vehicles, one core")
    axes.grid(which="both", alpha=0.25)
    axes.legend()
    drawing.savefig(path, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
