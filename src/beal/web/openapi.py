"""The description of the server's answers for other programs (OpenAPI 3.1)."""

from collections.abc import Callable, Mapping
from importlib.metadata import version
from typing import Any

from beal.vehicle.base import Part

REFUSED = {
    "403": "The request does not come from the explorer's own page.",
    "413": "The request is too large.",
    "415": "The body is not JSON.",
    "422": "Something in the question cannot be used: each problem with its path.",
    "503": "The answer takes too long.",
}
ERRORS = {
    "type": "object",
    "required": ["errors"],
    "properties": {
        "errors": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["path", "message"],
                "properties": {"path": {"type": "string"}, "message": {"type": "string"}},
            },
        }
    },
}


def description(questions: Mapping[str, tuple[type[Part], Callable[[Any], Any]]]) -> dict[str, Any]:
    """The OpenAPI document.

    Parameters
    ----------
    questions : mapping of str to (Part, callable)
        For each name under ``/api/`` what is asked and what answers, whose docstring is the description.

    Returns
    -------
    dict
    """
    schemas: dict[str, Any] = {"Errors": ERRORS}
    routes: dict[str, Any] = {"/api/start": {"get": _operation("start", "The model that the page opens with.")}}
    for name, (kind, answer) in questions.items():
        schema = kind.model_json_schema(ref_template="#/components/schemas/{model}")
        schemas |= schema.pop("$defs", {})
        title = kind.__name__
        schemas[title] = schema
        operation = _operation(name, (answer.__doc__ or "").split("\n")[0])
        operation["requestBody"] = {"required": True, "content": _json({"$ref": f"#/components/schemas/{title}"})}
        operation["responses"] |= {code: _response(text, "Errors") for code, text in REFUSED.items()}
        routes[f"/api/{name}"] = {"post": operation}
    return {
        "openapi": "3.1.0",
        "info": {"title": "beal explorer", "version": version("beal"), "license": {"name": "BSD-3-Clause"}},
        "paths": routes,
        "components": {"schemas": schemas},
    }


def _operation(name: str, summary: str) -> dict[str, Any]:
    return {
        "operationId": name,
        "summary": summary,
        "responses": {"200": {"description": "The answer.", "content": _json({"type": "object"})}},
    }


def _response(text: str, schema: str) -> dict[str, Any]:
    return {"description": text, "content": _json({"$ref": f"#/components/schemas/{schema}"})}


def _json(schema: dict[str, Any]) -> dict[str, Any]:
    return {"application/json": {"schema": schema}}
