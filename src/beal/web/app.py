"""The server behind the page: every answer in a thread, bounded in time, every refusal as JSON."""

import json
import os
from collections.abc import Awaitable, Callable
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import anyio
import numpy as np
from anyio import CapacityLimiter, to_thread
from numpy.linalg import LinAlgError
from pydantic import ValidationError
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route
from starlette.staticfiles import StaticFiles

from beal.errors import ConvergenceError, ModelError
from beal.report.numbers import plain
from beal.vehicle.base import Part, problems
from beal.web import answers
from beal.web import questions as ask
from beal.web.examples import EXAMPLES, example_text
from beal.web.guard import Guard, TooLarge, body_of, errors
from beal.web.openapi import description

LONGEST = 20.0  # seconds that an answer may take
KEPT = 20_000  # bytes of a question whose answer is remembered
STATIC = Path(str(files("beal.web") / "static"))
PLOTLY = Path(str(files("plotly") / "package_data" / "plotly.min.js"))
Answering = Callable[[Any], dict[str, Any]]
QUESTIONS: dict[str, tuple[type[Part], Answering]] = {
    "model": (ask.Question, answers.model),
    "open": (ask.Dropped, answers.dropped),
    "solve": (ask.Solve, answers.solve),
    "critical": (ask.Critical, answers.critical),
    "curve": (ask.Curve, answers.curve),
    "modes": (ask.Modes, answers.modes),
    "map": (ask.Map, answers.map_points),
    "response": (ask.Response, answers.response),
    "locus": (ask.Locus, answers.locus),
    "export": (ask.Curve, answers.code),
}


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
        return JSONResponse(description(QUESTIONS))

    asked = [
        Route(f"/api/{name}", _endpoint(name, limits.get(name, limits[""])), methods=["POST"]) for name in QUESTIONS
    ]
    plain_routes = [
        Route("/", page),
        Route("/plotly.js", plotly),
        Route("/openapi.json", openapi),
        Route("/api/start", begin),
        Route("/api/examples/{name}", example),
    ]
    app = Starlette(
        routes=[*plain_routes, *asked],
        middleware=[Middleware(Guard)],
        exception_handlers={HTTPException: _http},
    )
    app.mount("/static", StaticFiles(directory=STATIC))
    return app


def _endpoint(name: str, limit: CapacityLimiter) -> Callable[[Request], Awaitable[Response]]:
    async def respond(request: Request) -> Response:
        if request.headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
            return JSONResponse(errors("must be JSON: Content-Type application/json"), status_code=415)
        try:
            body = await body_of(request)
            with anyio.fail_after(LONGEST):
                answer = _remembered if len(body) < KEPT else _answered
                text = await to_thread.run_sync(answer, name, body, limiter=limit, abandon_on_cancel=True)
        except TooLarge as error:
            return JSONResponse(errors(str(error)), status_code=413)
        except ModelError as error:
            return JSONResponse(_told(error), status_code=422)
        except ConvergenceError as error:
            return JSONResponse(errors(str(error)), status_code=422)
        except TimeoutError:
            message = f"took longer than {LONGEST:g} s; the command beal has no such limit"
            return JSONResponse(errors(message), status_code=503)
        return Response(text, media_type="application/json")

    return respond


def _answered(name: str, body: bytes) -> bytes:
    kind, answer = QUESTIONS[name]
    try:
        question = kind.model_validate_json(body)
    except ValidationError as error:
        raise ModelError(problems(error, kind)) from None
    try:
        with np.errstate(all="ignore"):
            return json.dumps(plain(answer(question)), allow_nan=False).encode()
    except ModelError:
        raise
    except (ArithmeticError, LinAlgError, ValueError) as error:  # of quantities some 1e100 apart
        raise ModelError(f"cannot be computed, the numbers leave the range: {error}") from None


_remembered = lru_cache(maxsize=256)(_answered)


def _told(error: ModelError) -> dict[str, list[dict[str, str]]]:
    """Every problem; of an option its name, with which the message then begins, is the path."""
    listed = []
    for path, message in error.problems:
        option, colon, rest = message.partition(": ")
        option = option.partition(" ")[0] if option.startswith("formulation ") else option
        named = not path and colon and option.isidentifier()
        listed.append({"path": option, "message": rest} if named else {"path": path, "message": message})
    return {"errors": listed}


async def _http(request: Request, error: Exception) -> Response:
    status = error.status_code if isinstance(error, HTTPException) else 400
    headers = error.headers if isinstance(error, HTTPException) else None
    return JSONResponse(errors(getattr(error, "detail", "is not a request")), status_code=status, headers=headers)
