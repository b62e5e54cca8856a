"""Instability charts of the paper's vehicle under a pulsating thrust.

    python benchmarks/pulsating.py [POINTS]

A chart of POINTS x POINTS frequencies and amplitudes, against its points one at a time, on a sample of them.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
import time

import numpy as np

import beal
from beal.stability.floquet import MODES, discretised
from beal.stability.periodic import monodromy, pulsating_equations

THRUST, FREQUENCIES, AMPLITUDES = 50.0, (10.0, 120.0), (0.0, 30.0)
SAMPLE = 8  # of each


def main(points: int) -> None:
    """Time both and compare what they find."""
    vehicle = beal.catalog.tsto(0.6, 5000.0, 5000.0)
    omega, amplitude = np.linspace(*FREQUENCIES, points), np.linspace(*AMPLITUDES, points)
    start, used = time.perf_counter(), time.process_time()
    chart = beal.floquet_chart(vehicle, THRUST, omega, amplitude)
    wall, processor = time.perf_counter() - start, time.process_time() - used
    print(f"chart, {points} x {points} points: {wall:.1f} s, {processor:.1f} s of processor time")
    equations = pulsating_equations(discretised(vehicle, MODES), THRUST, MODES)
    rows = np.linspace(0, points - 1, SAMPLE).astype(int)
    used, largest = time.process_time(), 0.0
    for i in rows:
        for j in rows:
            transition, _ = monodromy(equations, amplitude[[j]], float(omega[i]), 1e-10)
            modulus = np.abs(np.linalg.eigvals(transition[0])).max()
            largest = max(largest, abs(modulus - chart.largest_modulus.values[i, j]))
    each = (time.process_time() - used) / SAMPLE**2
    print(f"one at a time: {1e3 * each:.1f} ms a point, {each * points**2:.0f} s of processor time for all")
    print(f"largest difference of the moduli {largest:.0e}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)
