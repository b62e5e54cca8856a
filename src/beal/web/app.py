"""The server behind the page: every answer in a process that can be ended, bounded in time, every refusal as JSON."""

import json
import os
from contextlib import suppress
from importlib.resources import files
from pathlib import Path

import anyio
from anyio import BrokenWorkerProcess, CancelScope, CapacityLimiter
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route
from starlette.staticfiles import StaticFiles

from beal.web.examples import EXAMPLES, example_text
from beal.web.guard import Guard, TooLarge, body_of, errors
from beal.web.process import asked

LONGEST = 20.0  # seconds that an answer may take
WATCHED = 0.2  # seconds from one look whether somebody waits for it to the next
GRACE = 0.8  # seconds for which it may go on when nobody does: to start a process anew takes as long
ENDED = json.dumps(errors("was ended from outside; ask again")).encode()
STATIC = Path(str(files("beal.web") / "static"))
PLOTLY = Path(str(files("plotly") / "package_data" / "plotly.min.js"))


def application(first: str = "") -> Starlette:
    """The explorer as an ASGI application.

    Parameters
    ----------
    first : str
        The model that it opens with; an example of the catalog if empty.

    Returns
    -------
    Starlette
    """
    start = first or example_text("tsto")
    limits = {"map": CapacityLimiter(1), "": CapacityLimiter(max(2, os.cpu_count() or 1))}  # maps give way

    async def begin(request: Request) -> Response:
        return JSONResponse({"model": start, "examples": EXAMPLES})

    async def example(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in EXAMPLES:
            return JSONResponse(errors(f"must be one of {', '.join(EXAMPLES)}", "name"), status_code=404)
        return JSONResponse({"model": example_text(name)})

    async def page(request: Request) -> Response:
        return FileResponse(STATIC / "index.html")

    async def plotly(request: Request) -> Response:
        return FileResponse(PLOTLY)

    async def openapi(request: Request) -> Response:
        return _json(*await asked("openapi", b""))

    async def answer(request: Request) -> Response:
        name = request.path_params["name"]
        return await _answer(request, name, limits.get(name, limits[""]))

    routes = [
        Route("/", page),
        Route("/plotly.js", plotly),
        Route("/openapi.json", openapi),
        Route("/api/start", begin),
        Route("/api/examples/{name}", example),
        Route("/api/{name}", answer, methods=["POST"]),
    ]
    app = Starlette(
        routes=routes,
        middleware=[Middleware(Guard)],
        exception_handlers={HTTPException: _http},
    )
    app.mount("/static", StaticFiles(directory=STATIC))
    return app


async def _answer(request: Request, name: str, limit: CapacityLimiter) -> Response:
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
        return JSONResponse(errors("must be JSON: Content-Type application/json"), status_code=415)
    try:
        body = await body_of(request)
        with anyio.fail_after(LONGEST):
            return _json(*await _while_wanted(request, name, body, limit))
    except TooLarge as error:
        return JSONResponse(errors(str(error)), status_code=413)
    except TimeoutError:
        message = f"took longer than {LONGEST:g} s; the command beal has no such limit"
        return JSONResponse(errors(message), status_code=503)


def _json(status: int, text: bytes) -> Response:
    return Response(text, status, media_type="application/json")


async def _while_wanted(request: Request, name: str, body: bytes, limit: CapacityLimiter) -> tuple[int, bytes]:
    """The answer; its process is ended when its time is over, or nobody has waited for it for a while."""
    found = (503, ENDED)
    async with anyio.create_task_group() as both:
        both.start_soon(_left, request, both.cancel_scope)
        with suppress(BrokenWorkerProcess):
            found = await asked(name, body, limit)
        both.cancel_scope.cancel()
    return found


async def _left(request: Request, answering: CancelScope) -> None:
    """Ends when whoever asked has gone."""
    while not await request.is_disconnected():
        await anyio.sleep(WATCHED)
    await anyio.sleep(GRACE)
    answering.cancel()


async def _http(request: Request, error: Exception) -> Response:
    status = error.status_code if isinstance(error, HTTPException) else 400
    headers = error.headers if isinstance(error, HTTPException) else None
    return JSONResponse(errors(getattr(error, "detail", "is not a request")), status_code=status, headers=headers)
