"""Time from a move of a slider to the answer of the explorer's server: one user, then twenty at once.

python benchmarks/explorer.py            # two-stage vehicle
python benchmarks/explorer.py launcher.toml
"""

import asyncio
import json
import statistics
import subprocess
import sys
import time
from itertools import chain
from pathlib import Path

import httpx

USERS, MOVES, PAUSE = 20, 15, 1.0  # each user moves a slider so often, with a pause in between, in s
FIRST = "joint[0].rotational_stiffness"


async def moves(client: httpx.AsyncClient, model: str, user: int, count: int, pause: float) -> list[float]:
    """Milliseconds of each answer; no two questions are equal, so none is remembered."""
    found = []
    await asyncio.sleep(pause * user / USERS)
    for move in range(count):
        values = {FIRST: 3000.0 + 100.0 * user + 7.0 * move}
        began = time.perf_counter()
        reply = await client.post("api/solve", json={"model": model, "values": values})
        found.append(1000 * (time.perf_counter() - began))
        reply.raise_for_status()
        await asyncio.sleep(pause)
    return found


async def measured(address: str) -> None:
    """Prints median and 95th percentile."""
    async with httpx.AsyncClient(base_url=address, timeout=60) as client:
        model = (await client.get("api/start")).json()["model"]
        await moves(client, model, 0, 5, 0.0)
        for users, count, pause in ((1, 40, 0.0), (USERS, MOVES, PAUSE)):
            each = await asyncio.gather(*(moves(client, model, user + 100, count, pause) for user in range(users)))
            times = sorted(chain.from_iterable(each))
            print(
                f"{users:2} users, {len(times)} moves: median {statistics.median(times):.0f} ms, "
                f"95th percentile {times[int(0.95 * len(times))]:.0f} ms, longest {times[-1]:.0f} ms"
            )


def main() -> None:
    """Starts the server as the command does."""
    command = [Path(sys.executable).with_name("beal"), "explore", *sys.argv[1:], "--no-browser", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            asyncio.run(measured(json.loads(server.stdout.readline())["address"]))
        finally:
            server.terminate()


if __name__ == "__main__":
    main()
