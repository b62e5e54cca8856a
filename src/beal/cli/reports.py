"""What commands write with ``--report``: one page on the question, the model and the answer."""

import shlex
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from beal import __version__
from beal.cli.figures import Draw, need_matplotlib, vehicle_figure
from beal.cli.output import new_path, note
from beal.errors import ModelError
from beal.report import Picture, Section, Table, run_page
from beal.report.parts import titled, told

if TYPE_CHECKING:
    from beal.vehicle.vehicle import Vehicle

ENDINGS = (".html", ".htm")
WHOLE = ("length", "mass", "centre_of_mass", "axial_force", "tangency", "nominal_thrust", "gravity")
LISTS = ("stages", "joints", "point_masses", "tanks", "sensors", "gains", "filters")
ABSENT = {"", "0", "rigid"}  # of a property of stages
PLACES = ("from", "to")


@dataclass(frozen=True)
class Run:
    """What a command found, as its page tells it; the answer in lines without a full stop."""

    subject: str
    question: str
    answer: Sequence[str]
    sections: Sequence[Section]


@contextmanager
def new_report(path: Path | None, quiet: bool) -> Iterator["Callable[[Vehicle, Callable[[], Run]], None]"]:
    """Writes the page of a run, with the warnings that were given meanwhile.

    Parameters
    ----------
    path : Path or None
        Nothing is written to None.
    quiet : bool
        Whether nothing is said about it.

    Raises
    ------
    ModelError
        If the ending is not that of a page, matplotlib is not installed, or no file can be written there.
    """
    if path is None:
        yield lambda vehicle, run: None
        return
    if path.suffix.lower() not in ENDINGS:
        raise ModelError(f"--report: must end with .html, found {path.suffix or 'no ending'}", str(path))
    need_matplotlib("--report")
    with new_path(path) as part, _warned() as given:

        def write(vehicle: "Vehicle", run: Callable[[], Run]) -> None:
            found = run()
            page = run_page(
                f"{found.subject}: {vehicle.title}" if vehicle.title else found.subject,
                found.question,
                [f"{line[0].upper()}{line[1:]}." for line in found.answer],
                [_model(vehicle), *found.sections],
                command=shlex.join(["beal", *sys.argv[1:]]),
                version=__version__,
                warnings=given,
            )
            part.write_text(page, encoding="utf-8")

        yield write
    if not quiet:
        note(f"report written to {path}")


def reported(path: Path | None) -> dict[str, str]:
    """The report's entry in a JSON object, if there is one."""
    return {"report": str(path)} if path else {}


def picture(draw: Draw, title: str, caption: str = "") -> Picture:
    """A figure as a page holds it."""
    from beal.plot import style

    svg = BytesIO()
    with style():
        draw().savefig(svg, format="svg", metadata={"Date": None})  # the same each time
    return Picture(svg.getvalue(), title, caption)


@contextmanager
def _warned() -> Iterator[list[str]]:
    """The warnings, which are shown as before too."""
    given: list[str] = []
    before = warnings.showwarning

    def keep(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        given.append(str(message))
        before(message, category, filename, lineno, file, line)

    warnings.showwarning = keep
    try:
        yield given
    finally:
        warnings.showwarning = before


def _model(vehicle: "Vehicle") -> Section:
    from beal.vehicle.summary import OF_STAGES, UNITS, summary

    resolved = summary(vehicle)
    units = UNITS if vehicle.units == "SI" else {}
    whole = [[titled(name, units), told(resolved[name])] for name in WHOLE if resolved[name] is not None]
    whole += [[f"support at the {end}", told(value)] for end, value in resolved["support"].items()]
    tables = [Table(["quantity", "value"], whole, "The whole vehicle")]
    for name in LISTS:
        if resolved[name]:
            known = units | OF_STAGES if units and name == "stages" else units
            tables.append(_listed(resolved[name], name.replace("_", " ").capitalize(), known, name == "stages"))
    if law := resolved["control"]:
        rows = [[titled(name, {}), told(value)] for name, value in law.items() if value not in (None, 0.0)]
        tables.append(Table(["quantity", "value"], rows, "Control law"))
    if vehicle.forces:
        loads: list[list[Any]] = [[force.station, _signal(force.signal.model_dump())] for force in vehicle.forces]
        tables.append(Table([titled("station", units), "force over time"], loads, "Transverse forces"))
    unit = "SI units." if units else "Non-dimensional, as the model gives it."
    drawn = picture(lambda: vehicle_figure(vehicle), "The vehicle, from nose to tail")
    return Section("The model", [unit], [drawn], tables)


def _listed(parts: list[dict[str, Any]], title: str, units: dict[str, str], sparse: bool) -> Table:
    """The parts of one kind; of stages, only the properties that one of them has."""
    columns = {name: [told(part[name]) for part in parts] for name in parts[0]}
    kept = {name: cells for name, cells in columns.items() if not sparse or name in PLACES or set(cells) - ABSENT}
    rows = list(zip(*kept.values(), strict=True))
    return Table([titled(name, units) for name in kept], rows, title)


def _signal(given: dict[str, Any]) -> str:
    kind = given.pop("kind")
    values = (f"{name.replace('_', ' ')} {_brief(value)}" for name, value in given.items())
    return f"{kind}: {', '.join(values)}"


def _brief(value: Any) -> str:
    if isinstance(value, tuple):
        return f"of {len(value)} values from {min(value):g} to {max(value):g}"
    return told(value)
