"""Arguments and options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

Model = Annotated[
    Path, typer.Argument(metavar="MODEL", help="Model file: TOML, .bdf, .dat, .csv or .xlsx.", show_default=False)
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object on standard output.")]
Formulation = Annotated[
    str, typer.Option("--formulation", metavar="F", help="objective, converged, corrected-ritz or as-printed.")
]
Table = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write a table there: CSV, .nc, .mat or .uff.")
]
Figure = Annotated[
    Path | None, typer.Option("--figure", metavar="FILE", help="Draw the result there: .png, .svg or .pdf.")
]
