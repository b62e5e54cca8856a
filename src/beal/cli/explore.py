"""``beal explore``: the explorer in the browser."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from beal.cli.options import AsJson
from beal.cli.output import emit, note
from beal.errors import ModelError


def explore(
    model: Annotated[
        Path | None, typer.Argument(metavar="[MODEL]", help="Model file; an example if left out.", show_default=False)
    ] = None,
    port: Annotated[int, typer.Option(metavar="N", help="Port on this machine; 0 for any that is free.")] = 0,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")] = True,
    as_json: AsJson = False,
) -> None:
    """Play with a vehicle on a page in the browser, served by this machine alone."""
    first = _text(model) if model else ""
    try:
        from beal.web.serve import serve
    except ModuleNotFoundError as error:
        if error.name not in ("anyio", "plotly", "starlette", "uvicorn"):
            raise
        raise ModelError(f"explore: needs {error.name}, which is not installed; install beal[web]") from None

    def ready(address: str) -> None:
        if as_json:
            emit({"address": address})
            sys.stdout.flush()  # whoever reads it waits for it
        else:
            note(f"the explorer is at {address}; Ctrl-C ends it")

    serve(first, port, browser, ready)


def _text(model: Path) -> str:
    from beal.interop.files import load
    from beal.vehicle.file import dumps

    return dumps(load(model))
