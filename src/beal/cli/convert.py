"""``beal convert``: a vehicle from one kind of file into another."""

from pathlib import Path
from typing import Annotated, Any

import typer

from beal.cli.options import AsJson
from beal.cli.output import emit, new_path, note
from beal.errors import ModelError


def convert(
    source: Annotated[
        Path, typer.Argument(metavar="IN", help="TOML, .bdf, .dat, .nas, .csv or .xlsx.", show_default=False)
    ],
    target: Annotated[
        Path, typer.Argument(metavar="OUT", help="TOML, .bdf, .dat, .nas, .csv or .xlsx.", show_default=False)
    ],
    plane: Annotated[str | None, typer.Option(help="Deck: axis and direction of bending, such as xz.")] = None,
    nose: Annotated[str | None, typer.Option(help="Deck: end of the axis that the nose is at, high or low.")] = None,
    lumps: Annotated[str | None, typer.Option(help="Deck: keep masses on bars without mass, or spread them.")] = None,
    length_unit: Annotated[str | None, typer.Option(metavar="UNIT", help="Deck: m unless given.")] = None,
    force_unit: Annotated[str | None, typer.Option(metavar="UNIT", help="Deck: N unless given.")] = None,
    x_from: Annotated[str | None, typer.Option(help="Table: where x counts from, nose or tail.")] = None,
    column: Annotated[
        list[str] | None, typer.Option(metavar="NAME=COLUMN", help="Table: its own name of a column.")
    ] = None,
    elements: Annotated[int | None, typer.Option(metavar="N", help="Deck to write: bars in each stage.")] = None,
    as_json: AsJson = False,
) -> None:
    """Read a vehicle from one kind of file and write it as another, with notes on what was understood."""
    from beal.interop.files import content, imported

    options: dict[str, Any] = {
        "plane": plane,
        "nose": nose,
        "lumps": lumps,
        "length_unit": length_unit,
        "force_unit": force_unit,
        "x_from": x_from,
        "columns": _columns(column) if column else None,
    }
    found = imported(source, **{name: value for name, value in options.items() if value is not None})
    written = content(found.vehicle, target, elements)
    with new_path(target) as part:
        part.write_bytes(written)
    if as_json:
        emit({"file": str(target), "notes": found.notes, "ignored": found.ignored})
        return
    for line in found.notes:
        note(line)
    for line in found.ignored:
        note(f"left out or simplified: {line}")
    vehicle = found.vehicle
    print(f"{target}: {len(vehicle.stages)} stages, {len(vehicle.point_masses)} point masses, mass {vehicle.mass:.9g}")


def _columns(pairs: list[str]) -> dict[str, str]:
    found = {}
    for pair in pairs:
        name, equals, column = pair.partition("=")
        if not equals:
            raise ModelError(f"--column: must be NAME=COLUMN, found {pair!r}")
        found[name.strip()] = column.strip()
    return found
