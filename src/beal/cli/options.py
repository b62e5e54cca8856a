"""Arguments and options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

Model = Annotated[Path, typer.Argument(metavar="MODEL", help="Model file (TOML).", show_default=False)]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object on standard output.")]
Formulation = Annotated[
    str, typer.Option("--formulation", metavar="F", help="objective, converged, corrected-ritz or as-printed.")
]
Table = Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write a CSV table there.")]
