"""Seconds per critical thrust and lines of user code: beal against its peers, each in its own process. Run with

python benchmarks/peers/compare.py
"""

import ast
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

from sweep import EXPECTED

HERE = Path(__file__).parent
BEAL = "beal_beam.py"
PEERS = ["numpy_beam.py", "skfem_beam.py", "exudyn_beam.py", "opensees_beam.py"]
PROCESSES = 3  # of each script
HEADINGS = [
    "vehicle",
    "error asked for",
    "tool",
    "size",
    "P L²/EI",
    "relative error",
    "kind, told by",
    "start-up, ms",
    "first, ms",
    "next, ms",
    "times beal",
    "lines",
]


def statements(source: str, function: str | None = None) -> int:
    """Lines of code, a statement on one however long; without comments, docstrings and the block that prints."""
    tree = ast.parse(source)
    if function:
        tree.body = [node for node in tree.body if getattr(node, "name", None) == function]
    tree.body = [node for node in tree.body if not (isinstance(node, ast.If) and "__name__" in ast.unparse(node.test))]
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            del node.body[0]
    return sum(bool(line.strip()) for line in ast.unparse(tree).splitlines())


def lines_of_code(script: str) -> int:
    """Lines the user of a code writes, its sweep included."""
    source = (HERE / script).read_text(encoding="utf-8")
    sweep = (HERE / "sweep.py").read_text(encoding="utf-8")
    return statements(source) + ("first_instability" in source) * statements(sweep, "first_instability")


def measured(script: str, vehicle: str, accuracy: float) -> dict:
    """What a script prints, with the rest of its process's time as start-up; or why there is nothing."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, str(HERE / script), vehicle, str(accuracy)]
    start = time.perf_counter()
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    wall = time.perf_counter() - start
    if run.returncode:
        missing = "ModuleNotFoundError" in run.stderr
        trouble = "not installed" if missing else f"does not run: {run.stderr.strip().splitlines()[-1]}"
        return {"tool": script.removesuffix("_beam.py"), "version": "", "trouble": trouble}
    line = json.loads(run.stdout.splitlines()[-1])
    if not line["seconds"]:
        return line | {"trouble": "not attained"}
    return line | {"startup": wall - sum(line["seconds"])}


def summary(runs: list[dict]) -> dict:
    """One answer of several runs, with median times."""
    if "trouble" in runs[0]:
        return runs[0]
    return runs[0] | {
        "startup": statistics.median(run["startup"] for run in runs),
        "first": statistics.median(run["seconds"][0] for run in runs),
        "next": statistics.median(second for run in runs for second in run["seconds"][1:]),
    }


def as_asked(found: dict) -> bool:
    """Whether an answer is of the right kind and about as accurate as asked."""
    thrust, kind = EXPECTED[found["vehicle"]]
    return found["kind"] == kind and abs(found["critical_thrust"] / thrust - 1) < 2 * found["accuracy"]


def cells(script: str, vehicle: str, accuracy: float, found: dict, beal: dict) -> list[str]:
    """One row of the table."""
    own = script == BEAL
    asked = [vehicle, "its own" if own else f"{accuracy:.0e}", f"{found['tool']} {found['version']}".strip()]
    if "trouble" in found:
        return asked + [found["trouble"]] + [""] * (len(HEADINGS) - 4)
    ratio = found["next"] / beal["next"]
    return [
        *asked,
        "its own" if own else str(found["size"]),
        f"{found['critical_thrust']:.7f}",
        f"{abs(found['critical_thrust'] / EXPECTED[vehicle][0] - 1):.0e}" + ("" if as_asked(found) else " WRONG"),
        f"{found['kind']}, by {'itself' if own else 'the sweep'}",
        *(f"{1e3 * found[name]:.{0 if name == 'startup' else 1}f}" for name in ("startup", "first", "next")),
        f"{ratio:.{1 if ratio < 10 else 0}f}",
        str(lines_of_code(script)),
    ]


def main() -> int:
    """Print the table; 1 if an answer is wrong, 0 otherwise, whatever is not installed."""
    right = True
    print(f"Python {sys.version.split()[0]}\n")
    for row in (HEADINGS, ["---"] * len(HEADINGS)):
        print(f"| {' | '.join(row)} |")
    for vehicle in EXPECTED:
        jobs = [(BEAL, 1e-6), *((script, accuracy) for accuracy in (1e-3, 1e-6) for script in PEERS)]
        # In rounds, so that what else the machine does at a moment falls on all of them alike.
        rounds = [[measured(script, vehicle, accuracy) for script, accuracy in jobs] for _ in range(PROCESSES)]
        results = [summary(list(runs)) for runs in zip(*rounds, strict=True)]
        for (script, accuracy), found in zip(jobs, results, strict=True):
            right &= "trouble" in found or as_asked(found)
            print(f"| {' | '.join(cells(script, vehicle, accuracy, found, results[0]))} |", flush=True)
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
