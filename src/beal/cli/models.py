"""``beal check`` and ``beal example``: model files themselves."""

from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

import typer

from beal.cli.figures import named, new_figure, vehicle_figure
from beal.cli.options import AsJson, Figure, Model
from beal.cli.output import emit, new_file, show_table
from beal.errors import ModelError
from beal.report.numbers import cell
from beal.report.parts import titled, told

EXAMPLES = ("beck", "beal", "pflueger", "tsto", "generic_small_launcher")


def check(model: Model, figure: Figure = None, as_json: AsJson = False) -> None:
    """Show the resolved model, or every error in it."""
    from beal.interop.files import imported
    from beal.vehicle.summary import summary

    try:
        with new_figure(figure, as_json) as draw:
            found = imported(model)
            resolved = summary(found.vehicle)
            draw(lambda: vehicle_figure(found.vehicle))
    except ModelError as error:
        if as_json:
            emit({"errors": [{"path": path, "message": message} for path, message in error.problems]})
        raise
    if as_json:
        emit({**resolved, "notes": found.notes, "ignored": found.ignored, **named(figure)})
        return
    _show(resolved)
    for title, lines in (("how the file was read", found.notes), ("left out or simplified", found.ignored)):
        if lines:
            print(f"\n{title}", *(f"  {line}" for line in lines), sep="\n")


def _show(resolved: dict[str, Any]) -> None:
    from beal.vehicle.summary import UNITS

    groups = resolved.pop("nondimensional")
    units = UNITS if resolved["units"] == "SI" else {}
    _show_part(resolved, units)
    print("\nnondimensional groups, P L^2/EI, k_r L/EI, k_s L^3/EI, and what they refer to")
    references = {name: units[name] for name in groups if name.startswith("reference") or "scale" in name if units}
    _show_part(groups, references)


def _show_part(part: dict[str, Any], units: dict[str, str]) -> None:
    from beal.vehicle.summary import OF_STAGES

    for name, value in part.items():
        if isinstance(value, list):
            if value:
                known = units | OF_STAGES if units and name == "stages" else units
                columns = [titled(key, known) for key in value[0]]
                show_table(columns, [[told(item) for item in row.values()] for row in value], name.replace("_", " "))
        elif value not in (None, "", ()):
            ends = isinstance(value, dict)
            text = ", ".join(f"{key} {told(item)}" for key, item in value.items()) if ends else cell(value)
            print(f"{name.replace('_', ' ')}: {text} {units.get(name, '')}".rstrip())


def _example(name: str) -> str:
    return (files("beal.vehicle.catalog") / "models" / f"{name}.toml").read_text(encoding="utf-8")


def _show_examples(output: Path | None, as_json: bool) -> None:
    """Each with the comment that heads it."""
    if output:
        raise ModelError("--output: holds one model; give its NAME")
    told = {name: _example(name).partition("\n")[0].removeprefix("# ") for name in EXAMPLES}
    if as_json:
        emit({"examples": [{"name": name, "description": text} for name, text in told.items()]})
    else:
        for name, text in told.items():
            print(f"{name:<{max(map(len, EXAMPLES))}}  {text}")


def _named(incomplete: str) -> list[str]:
    """Examples whose name begins so, for the shell's completion."""
    return [name for name in EXAMPLES if name.startswith(incomplete)]


def example(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME", help=f"{', '.join(EXAMPLES)}; without one they are listed.", autocompletion=_named
        ),
    ] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write it there.")] = None,
    as_json: AsJson = False,
) -> None:
    """Print a commented model file of the catalog, or write it to a new file."""
    if name is None:
        _show_examples(output, as_json)
        return
    if name not in EXAMPLES:
        raise ModelError(f"NAME: must be one of {', '.join(EXAMPLES)}, found {name!r}")
    text = _example(name)
    if output:
        if output.exists():
            raise ModelError("exists already; give the name of a new file", str(output))
        with new_file(output) as file:
            file.write(text)
    if as_json:
        emit({"name": name, "model": text, "file": str(output) if output else None})
    elif not output:
        print(text, end="")
