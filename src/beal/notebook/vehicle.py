"""A vehicle as a notebook shows it: drawn to scale, with its parts in tables."""

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

from beal.notebook.pictures import WIDE, picture
from beal.report import table
from beal.report.numbers import cell
from beal.report.parts import titled, told
from beal.vehicle.summary import OF_STAGES, UNITS, summary
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NOTHING: tuple[Any, ...] = (None, "", 0.0, "rigid")  # what a part is without, unless given


def vehicle(shown: Vehicle) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    shown : Vehicle

    Yields
    ------
    str
    """
    resolved = summary(shown)
    units = UNITS if shown.units == "SI" else {}
    yield f'<p class="verdict">{escape(shown.title or "vehicle")}</p>'
    yield picture(
        lambda plot, figure: _sketch(shown, plot, figure), f"sketch of {shown.title or 'the vehicle'}", height=4 * WIDE
    )
    yield f"<p>{escape(_line(resolved, units))}</p>"
    for name, rows in resolved.items():
        if isinstance(rows, list) and rows:
            yield _parts(name, rows, units | OF_STAGES if units and name == "stages" else units)


def _sketch(shown: Vehicle, plot: Any, figure: "Figure") -> None:
    from beal.plot.style import fitted

    fitted(plot.vehicle(shown, figure.subplots()))


def _line(resolved: dict[str, Any], units: dict[str, str]) -> str:
    """What it adds up to, and how it is held and pushed."""
    names = ("length", "mass", "centre_of_mass", "nominal_thrust")
    sums = [
        f"{name.replace('_', ' ')} {cell(resolved[name])} {units.get(name, '')}".rstrip()
        for name in names
        if resolved[name] is not None
    ]
    nose, tail = (told(resolved["support"][end]) for end in ("nose", "tail"))
    held = f"both ends {nose}" if nose == tail else f"nose {nose}, tail {tail}"
    return "; ".join([", ".join(sums), held])


def _parts(name: str, rows: list[dict[str, Any]], units: dict[str, str]) -> str:
    """The parts of one kind; a column in which none has anything is left out."""
    keys = [key for key in rows[0] if any(row[key] not in NOTHING for row in rows)]
    numbers = [n for n, key in enumerate(keys) if key not in ("name", "shear_axis", "sensor", "quantity")]
    header = ["", *(escape(titled(key, units)) for key in keys)]
    body = [[n, *(told(row[key]) for key in keys)] for n, row in enumerate(rows)]
    return table(header, body, name.replace("_", " "), [0, *(n + 1 for n in numbers)])
