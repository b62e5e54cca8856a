"""Running the explorer on this machine."""

import socket
import warnings
import webbrowser
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from functools import partial
from threading import Thread

import uvicorn
from starlette.applications import Starlette

from beal.errors import ModelError
from beal.motion import AliasingWarning
from beal.vehicle.file import dumps
from beal.vehicle.vehicle import Vehicle
from beal.web.answers import map_points
from beal.web.app import application
from beal.web.examples import example_text
from beal.web.questions import Map

HOST = "127.0.0.1"


def serve(vehicle: Vehicle | None, port: int, browser: bool, ready: Callable[[str], None]) -> None:
    """Serve the explorer until it is interrupted.

    Parameters
    ----------
    vehicle : Vehicle or None
        What it opens with.
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
    with socket.socket() as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, port))
            listening.listen()  # who comes before the server is ready waits
        except (OSError, OverflowError) as error:
            message = f"{port} cannot be used: {error}; leave it out to take any that is free"
            raise ModelError([("--port", message)]) from None
        address = f"http://{HOST}:{listening.getsockname()[1]}/"
        warnings.simplefilter("ignore", AliasingWarning)  # of a chart: what it leaves out is finer than its line
        app = application(dumps(vehicle) if vehicle else "")
        app.router.lifespan_context = partial(_announced, address, browser, ready)
        uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="on")).run(sockets=[listening])


@asynccontextmanager
async def _announced(address: str, browser: bool, ready: Callable[[str], None], app: Starlette) -> AsyncIterator[None]:
    Thread(target=_compile, daemon=True).start()
    ready(address)
    if browser:
        webbrowser.open(address)
    yield


def _compile() -> None:
    """Solves a small map: where the kernels are compiled for the first time on this machine, that takes a while."""
    axes = ("joint[0].rotational_stiffness", "joint[0].shear_stiffness")
    points = tuple((10.0**n, 10.0**n) for n in range(1, 6))
    map_points(Map(model=example_text("tsto"), axes=axes, points=points))
