"""The question of Irani & Kavianipour (2009): where should the joint be, and how stiff should its springs be?

python benchmarks/paper_question.py [STARTS [FIGURE.png]]

Searches the largest critical thrust within the ranges of the paper under each of the four formulations, and again for
the weakest vehicle within tolerances; prints what each design bears under the other formulations, and draws the map
around each. Some eight minutes with eight starts.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import beal
from beal import plot
from beal.vehicle.paths import with_values

SPLIT, TURNING, SLIDING = "stage.split", "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
RANGES = {
    SPLIT: beal.Variable(0.2, 0.8),
    TURNING: beal.Variable(1.0, 1e4, "log"),
    SLIDING: beal.Variable(1e2, 1e4, "log"),
}
TOLERANCES = {SPLIT: (0.98, 1.02), TURNING: (0.8, 1.25), SLIDING: (0.8, 1.25)}
FORMULATIONS = {"objective": None, "converged": None, "corrected-ritz": 8, "as-printed": 8}
ACROSS, UP = np.linspace(0.2, 0.8, 41), np.geomspace(1e2, 1e4, 41)  # of a map


def main(starts: int = 8, figure: str = "") -> None:
    """Prints the table and draws the maps."""
    vehicle = beal.catalog.tsto(0.5, 1e3, 1e3)
    space = beal.DesignSpace(vehicle, RANGES)
    best = {}
    for name, modes in FORMULATIONS.items():
        found = beal.optimise(space, starts=starts, formulation=name, modes=modes, progress=_counted(name))
        best[name] = found
        _tell(name, found.values)
    robust, weakest = beal.robust_optimum(space, TOLERANCES, start=best["objective"].values)
    _tell("robust", robust.values)
    print(f"  weakest within the tolerances: {weakest.critical_thrust:.3f}")
    weakest = beal.worst_case(best["objective"].vehicle, _box(best["objective"].values))
    print(f"  that of the best under objective: {weakest.critical_thrust:.3f}")
    for path, value in best["objective"].values.items():
        _edges(best["objective"], path, value)
    if figure:
        _drawn(best, robust, Path(figure))


def _counted(name: str):
    return lambda done, total: print(f"{name}: search {done} of {total}", end="\r", file=sys.stderr)


def _tell(name: str, values: dict[str, float]) -> None:
    """A design, and what it bears under each formulation."""
    vehicle = with_values(beal.catalog.tsto(0.5, 1e3, 1e3), values)
    bears = []
    for formulation, modes in FORMULATIONS.items():
        found = beal.critical_thrust(vehicle, None, formulation, modes=modes, method="complete")
        low, high = found.modes or (0, 0)
        pair = f"{low}-{high}" if low != high else f"{low}"
        bears.append(f"{formulation} {found.critical_thrust or np.inf:.3f} {found.kind} {pair}")
    print(f"{name:15} x/L = {values[SPLIT]:.4f}, k_r = {values[TURNING]:.5g}, k_s = {values[SLIDING]:.5g}")
    print(f"  bears: {'; '.join(bears)}", flush=True)


def _box(values: dict[str, float]) -> dict[str, tuple[float, float]]:
    return {path: (low * values[path], high * values[path]) for path, (low, high) in TOLERANCES.items()}


def _edges(found: beal.Optimum, path: str, value: float) -> None:
    """How far a quantity of the best design may move before five percent of the thrust are gone."""
    one, target = RANGES[path], 0.95 * (found.critical.critical_thrust or 0.0)
    for low, high in ((one.low, value), (value, one.high)):
        if low < high:
            seen = beal.allowed_range(found.vehicle, path, low, high, target, spacing=one.spacing, points=41).intervals
            near = seen[-1] if high == value else seen[0]
            edge, kind, end = (
                (near.low_edge, near.low_kind, near.low)
                if high == value
                else (near.high_edge, near.high_kind, near.high)
            )
            print(f"  {path}: to {end:.6g} ({end / value - 1:+.2%}), {edge} {kind}", flush=True)


def _drawn(best: dict[str, beal.Optimum], robust: beal.Optimum, path: Path) -> None:
    """Maps over the place of the joint and its shear spring, the rotational spring as in the best design."""
    with plot.style():
        drawing = Figure(figsize=(9.0, 7.4), layout="constrained")
        for ax, (name, modes) in zip(drawing.subplots(2, 2).flat, FORMULATIONS.items(), strict=True):
            found = best[name]
            axes = {SPLIT: ACROSS.tolist(), SLIDING: UP.tolist()}
            chart = beal.refined_map(found.vehicle, axes, 0.005, formulation=name, modes=modes)
            plot.stability_map(chart, ax)
            ax.plot(found.values[SPLIT], found.values[SLIDING], "*", **_marked(14))
            if name == "objective":
                ax.plot(robust.values[SPLIT], robust.values[SLIDING], "o", **_marked(7))
            turning = found.values[TURNING]
            ax.set_title(f"{name}: {found.critical.critical_thrust:.1f} with $k_r$ = {turning:g}")
        drawing.savefig(path, dpi=110)


def _marked(size: float) -> dict[str, object]:
    return {"color": "#E69F00", "markeredgecolor": "black", "markersize": size, "zorder": 5, "clip_on": False}


if __name__ == "__main__":
    main(*(kind(text) for kind, text in zip((int, str), sys.argv[1:], strict=False)))
