"""Time from a move of a slider to the answer of the explorer's server: one user, then twenty at once; and to the curve.

python benchmarks/explorer.py            # the server
python benchmarks/explorer.py --browser  # from the slider to the redrawn curve in Debian's chromium
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

BROWSER = "/usr/bin/chromium"
FLAGS = "--headless=new --no-sandbox --disable-gpu --disable-background-networking --disable-component-update"
SLIDERS = {"tsto": "#q-joint-0-rotational_stiffness", "generic_small_launcher": "#q-stage-0-length"}
DRAG = """async ([field, moves]) => {
    const slider = document.querySelector(`.field:has(${field}) input[type=range]`);
    const curve = document.getElementById("curve");
    const seen = () => new Promise((done) => curve.once("plotly_afterplot", () => requestAnimationFrame(done)));
    const times = [];
    for (let n = 0; n < moves; n += 1) {
        slider.value = 510 + 2 * n;
        const began = performance.now(), drawn = seen();
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await drawn;
        times.push(performance.now() - began);
        await new Promise((done) => setTimeout(done, 20));
    }
    return times.slice(2);
}"""
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
    """Prints how long answers take."""
    async with httpx.AsyncClient(base_url=address, timeout=60) as client:
        model = (await client.get("api/start")).json()["model"]
        await moves(client, model, 0, 5, 0.0)
        for users, count, pause in ((1, 40, 0.0), (USERS, MOVES, PAUSE)):
            each = await asyncio.gather(*(moves(client, model, user + 100, count, pause) for user in range(users)))
            told(f"{users:2} users", list(chain.from_iterable(each)))


def seen(address: str) -> None:
    """Prints how long a slider that is dragged waits for its curve, with all that the page does beside it."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as engine:
        browser = engine.chromium.launch(executable_path=BROWSER, args=FLAGS.split())
        for example, field in SLIDERS.items():
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.goto(address)
            page.wait_for_timeout(6000)  # until the first charts are drawn
            page.select_option("#example", example)
            page.wait_for_timeout(6000)
            told(example, page.evaluate(DRAG, [field, 42]))
            page.close()


def told(who: str, times: list[float]) -> None:
    """Prints median and 95th percentile."""
    times = sorted(times)
    print(
        f"{who}, {len(times)} moves: median {statistics.median(times):.0f} ms, "
        f"95th percentile {times[int(0.95 * len(times))]:.0f} ms, longest {times[-1]:.0f} ms"
    )


def main() -> None:
    """Starts the server as the command does."""
    command = [Path(sys.executable).with_name("beal"), "explore", "--no-browser", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            address = json.loads(server.stdout.readline())["address"]
            seen(address) if "--browser" in sys.argv[1:] else asyncio.run(measured(address))
        finally:
            server.terminate()


if __name__ == "__main__":
    main()
