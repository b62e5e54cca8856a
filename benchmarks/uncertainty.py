"""Time of a million random vehicles of the paper, drawn and solved, on all cores that there are.

python benchmarks/uncertainty.py
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import platform
import time

import numpy as np

import beal
from beal.study.run import cores

SAMPLES = 1_000_000
LAWS = {
    "joint[0].rotational_stiffness": beal.Distribution.lognormal(median=10.0, cv=0.5),
    "joint[0].shear_stiffness": beal.Distribution.lognormal(median=200.0, cv=0.5),
}


def main() -> None:
    """Prints the times."""
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}, {cores()} cores")
    uncertain = beal.Uncertain(beal.catalog.tsto(0.6, 10.0, 200.0), LAWS)
    beal.sample(uncertain, 64)  # numba reads or compiles the kernels
    for method in ("monte-carlo", "sobol"):
        start = time.perf_counter()
        found = beal.sample(uncertain, SAMPLES, method)
        seconds = time.perf_counter() - start
        print(f"{method:12} {found.count:8} vehicles, {found.failed} not solved: {seconds:.1f} s")


if __name__ == "__main__":
    main()
