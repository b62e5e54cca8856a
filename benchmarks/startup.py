"""Time that a user waits for a command, from the start of its process, and for the first answer of the explorer.

python benchmarks/startup.py
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from urllib.request import Request, urlopen

BEAL = Path(sys.executable).with_name("beal")
RUNS = 5
COMMANDS = (
    "check",
    "critical",
    "modes",
    "curve --to 150",
    "response --duration 1",
    "floquet --amplitude 5 --angular-frequency 30",
)


def command(model: str, words: str) -> float:
    """Seconds of a command."""
    name, *options = words.split()
    began = time.perf_counter()
    subprocess.run([BEAL, name, model, *options, "--json"], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def explorer(model: str) -> tuple[float, ...]:
    """Seconds until the explorer has an address, a page and a verdict."""
    began = time.perf_counter()
    line = [BEAL, "explore", "--no-browser", "--json"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        address = json.loads(server.stdout.readline())["address"]
        seen = [time.perf_counter() - began]
        question = json.dumps({"model": model}).encode()
        headers = {"Content-Type": "application/json"}
        for wanted in (address, Request(f"{address}api/solve", question, headers)):
            with urlopen(wanted) as answer:
                answer.read()
            seen.append(time.perf_counter() - began)
        server.terminate()
    return tuple(seen)


def main() -> None:
    """The median of some runs each, after one that is not counted."""
    with tempfile.TemporaryDirectory() as folder:
        model = str(Path(folder) / "tsto.toml")
        subprocess.run([BEAL, "example", "tsto", "-o", model], check=True, stdout=subprocess.DEVNULL)
        for words in COMMANDS:
            print(f"beal {words:48} {statistics.median(command(model, words) for _ in range(RUNS)):.2f} s")
        runs = [explorer(Path(model).read_text()) for _ in range(RUNS)]
        for name, times in zip(("address", "page", "verdict"), zip(*runs, strict=True), strict=True):
            print(f"beal explore, {name:39} {statistics.median(times):.2f} s")


if __name__ == "__main__":
    main()
