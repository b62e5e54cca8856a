"""What runs in the worker processes: one answer at a time, which the server may end by ending its process."""

import json
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.linalg import LinAlgError
from pydantic import ValidationError

from beal.errors import ConvergenceError, ModelError
from beal.report.numbers import plain
from beal.stability.threads import one_thread
from beal.vehicle.base import Part, problems
from beal.web import answers, further
from beal.web import questions as ask
from beal.web.guard import errors
from beal.web.openapi import description

KEPT = 20_000  # bytes of a question whose answer is remembered
Answering = Callable[[Any], dict[str, Any]]
QUESTIONS: dict[str, tuple[type[Part], Answering]] = {
    "model": (ask.Question, answers.model),
    "open": (ask.Dropped, answers.dropped),
    "draft": (ask.Solve, answers.draft),
    "solve": (ask.Solve, answers.solve),
    "critical": (ask.Critical, answers.critical),
    "curve": (ask.Curve, answers.curve),
    "modes": (ask.Modes, answers.modes),
    "map": (ask.Map, answers.map_points),
    "response": (ask.Response, answers.response),
    "locus": (ask.Locus, answers.locus),
    "flight": (ask.Flight, further.flight),
    "pulsation": (ask.Pulsation, further.pulsation),
    "loop": (ask.Loop, further.loop),
    "export": (ask.Curve, answers.code),
}


def answered(name: str, body: bytes) -> tuple[int, bytes]:
    """The status of an answer and the answer, as JSON; a question that was just answered is not answered anew.

    Parameters
    ----------
    name : str
        Of the question, or ``openapi`` for the description of all.
    body : bytes
        The question as JSON.

    Returns
    -------
    status : int
        422 where the answer is a list of problems, 404 where nothing answers to the name.
    answer : bytes
    """
    if name == "openapi":
        return 200, json.dumps(description(QUESTIONS)).encode()
    if name not in QUESTIONS:
        return 404, json.dumps(errors(f"must be one of {', '.join(QUESTIONS)}", "name")).encode()
    try:
        return 200, (_remembered if len(body) < KEPT else _answer)(name, body)
    except ModelError as error:
        return 422, json.dumps(_told(error)).encode()
    except ConvergenceError as error:
        return 422, json.dumps(errors(str(error))).encode()


def _answer(name: str, body: bytes) -> bytes:
    kind, answer = QUESTIONS[name]
    try:
        question = kind.model_validate_json(body)
    except ValidationError as error:
        raise ModelError(problems(error, kind)) from None
    try:
        with np.errstate(all="ignore"), one_thread():  # processes enough share the cores
            return json.dumps(plain(answer(question)), allow_nan=False).encode()
    except ModelError:
        raise
    except (ArithmeticError, LinAlgError, ValueError) as error:  # of quantities some 1e100 apart
        raise ModelError(f"cannot be computed, the numbers leave the range: {error}") from None


_remembered = lru_cache(maxsize=256)(_answer)


def _told(error: ModelError) -> dict[str, list[dict[str, str]]]:
    """Every problem; of an option its name, with which the message then begins, is the path."""
    listed = []
    for path, message in error.problems:
        option, colon, rest = message.partition(": ")
        option = option.partition(" ")[0] if option.startswith("formulation ") else option
        named = not path and colon and option.isidentifier()
        listed.append({"path": option, "message": rest} if named else {"path": path, "message": message})
    return {"errors": listed}
