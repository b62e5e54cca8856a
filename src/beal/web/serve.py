"""Running the explorer on this machine."""

import json
import socket
import webbrowser
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from functools import partial
from typing import Any

import uvicorn
from anyio import create_task_group
from starlette.applications import Starlette

from beal.errors import ModelError
from beal.web.app import application
from beal.web.examples import example_text
from beal.web.process import asked

HOST = "127.0.0.1"


def serve(first: str, port: int, browser: bool, ready: Callable[[str], None]) -> None:
    """Serve the explorer until it is interrupted.

    Parameters
    ----------
    first : str
        The model that it opens with; an example if empty.
    port : int
        0 takes any that is free.
    browser : bool
        Whether to open the page in the user's browser.
    ready : callable
        Called with the address when the server answers.

    Raises
    ------
    ModelError
        If the port is taken.
    """
    with socket.socket(proto=socket.IPPROTO_TCP) as listening:  # else asyncio does not send small answers at once
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, port))
            listening.listen()  # who comes before the server is ready waits
        except (OSError, OverflowError) as error:
            message = f"{port} cannot be used: {error}; leave it out to take any that is free"
            raise ModelError([("--port", message)]) from None
        address = f"http://{HOST}:{listening.getsockname()[1]}/"
        app = application(first)
        app.router.lifespan_context = partial(_announced, address, browser, ready)
        uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="on")).run(sockets=[listening])


@asynccontextmanager
async def _announced(address: str, browser: bool, ready: Callable[[str], None], app: Starlette) -> AsyncIterator[None]:
    async with create_task_group() as preparing:
        preparing.start_soon(_prepared)
        ready(address)
        if browser:
            webbrowser.open(address)
        yield
        preparing.cancel_scope.cancel()


async def _prepared() -> None:
    """Starts the processes that the first page needs, then compiles the kernels of maps where they are not yet."""
    model = example_text("tsto")
    async with create_task_group() as both:
        for points in (2, 3):
            both.start_soon(_asked, "solve", {"model": model, "points": points})
    axes = ("joint[0].rotational_stiffness", "joint[0].shear_stiffness")
    await _asked("map", {"model": model, "axes": axes, "points": [(10.0**n, 10.0**n) for n in range(1, 6)]})


async def _asked(name: str, question: dict[str, Any]) -> None:
    await asked(name, json.dumps(question).encode())
