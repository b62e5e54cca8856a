"""Frequencies over thrust, drawn with characters below a verdict."""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING, Annotated

import typer

from beal.cli.canvas import Canvas
from beal.cli.output import console, shows
from beal.errors import ModelError
from beal.report.numbers import prefixed

if TYPE_CHECKING:
    from rich.text import Text

    from beal.stability.complete import Event
    from beal.stability.critical import CriticalThrust
    from beal.stability.curve import ThrustCurve
    from beal.vehicle.vehicle import Vehicle

Plot = Annotated[
    bool | None,
    typer.Option("--plot/--no-plot", help="Draw the frequencies with characters, as is done on a terminal."),
]
NARROWEST, PAGE, WIDEST, HIGH = 40, 80, 100, 14  # characters; a page is as wide as a pipe
COLORS = ("blue", "red", "green", "magenta", "yellow", "cyan")
MARKS = {"flutter": "●", "divergence": "◆"}
ASCII = str.maketrans("●◆┊│┤┬─└", "*#:|++-+") | str.maketrans({"ω": "omega", "²": "^2"})
DOTTED = 3  # columns from one dot of an unstable stretch to the next


@dataclass(frozen=True)
class _Axis:
    """Values from 0 to an end, told in units of a factor."""

    label: str
    end: float
    factor: float
    most: int  # ticks

    @property
    def ticks(self) -> dict[float, str]:
        """Places from 0 to 1 with their numbers, which are multiples of 1, 2 or 5."""
        least = self.end / self.factor / self.most
        size = 10.0 ** math.floor(math.log10(least))
        step = next(step * size for step in (1, 2, 5, 10) if step * size >= least)
        count = math.floor(self.end / self.factor / step + 1e-9)
        return {n * step * self.factor / self.end: f"{n * step:g}" for n in range(count + 1)}


def wanted(plot: bool | None, as_json: bool) -> bool:
    """Whether to draw: where somebody looks on, unless told otherwise.

    Raises
    ------
    ModelError
        If it would be drawn into JSON.
    """
    if plot and as_json:
        raise ModelError("--plot: is given beside --json; give one of them")
    return not as_json and (sys.stdout.isatty() if plot is None else plot)


def show_curve(
    vehicle: "Vehicle", curve: "ThrustCurve", critical: "CriticalThrust | None" = None, events: "Sequence[Event]" = ()
) -> None:
    """Print frequencies over thrust, as wide as the terminal and with the letters that it has."""
    if critical and not events:
        curve = _lowest(curve, critical.elastic or critical)
    out = console()
    width = min(out.width, WIDEST) if out.is_terminal else PAGE
    for line in drawing(vehicle, curve, width, shows("".join(map(chr, ASCII)) + "⣿"), critical, events):
        out.print(line, soft_wrap=True)


def _lowest(curve: "ThrustCurve", critical: "CriticalThrust") -> "ThrustCurve":
    """The modes that have a part in it, and those below: higher ones would press them flat."""
    if critical.modes is None:
        return curve
    count = max(*critical.modes, 2 if critical.kind == "flutter" else 1)
    frequency, growth = curve.angular_frequency[:, :count], curve.growth_rate[:, :count]
    return replace(curve, angular_frequency=frequency, growth_rate=growth)


def drawing(
    vehicle: "Vehicle",
    curve: "ThrustCurve",
    width: int,
    fine: bool = True,
    critical: "CriticalThrust | None" = None,
    events: "Sequence[Event]" = (),
) -> "list[Text]":
    """Lines of characters; unstable stretches are dotted, the critical thrust or all events are marked."""
    across, up = _thrust(vehicle, curve), _frequency(vehicle, curve)
    margin = max(map(len, up.ticks.values()))
    canvas = Canvas(max(width, NARROWEST) - margin - 2, HIGH, fine)
    x, y = (curve.thrust / across.end).tolist(), (curve.angular_frequency / up.end).T.tolist()
    for number, (mode, unstable) in enumerate(zip(y, curve.unstable.T.tolist(), strict=True)):
        letter, color = str(number + 1)[-1], COLORS[number % len(COLORS)]
        for grows, stretch in groupby(range(len(x)), unstable.__getitem__):
            points = list(stretch)
            ends = slice(max(points[0] - 1, 0), points[-1] + 1)  # joined to the stretch before
            canvas.line(x[ends], mode[ends], letter, color, DOTTED if grows else 1)
    for number, mode in enumerate(y):
        canvas.put(0.0, mode[0], str(number + 1)[-1], f"bold {COLORS[number % len(COLORS)]}")
    kinds = set()
    for thrust, omega, kind in _changes(critical, events):
        if thrust <= across.end and omega <= up.end:
            for row in range(HIGH):
                canvas.put(thrust / across.end, row / (HIGH - 1), "┊", "dim", over=False)
            canvas.put(thrust / across.end, omega / up.end, MARKS[kind], "bold")
            kinds.add(kind)
    lines = _framed(canvas, across, up, margin)
    key = [f"{MARKS[kind]} {kind}" for kind in MARKS if kind in kinds]
    if curve.unstable.any():
        key.append("dotted: unstable")
    if key:
        lines.append(_text(f"{'':>{margin + 2}}{'   '.join(key)}"))
    if not fine:
        for line in lines:
            line.plain = line.plain.translate(ASCII)
    return lines


def _thrust(vehicle: "Vehicle", curve: "ThrustCurve") -> _Axis:
    end = float(curve.thrust[-1])
    if vehicle.units == "SI":
        factor, unit = prefixed(end, "N")
        return _Axis(f"thrust [{unit}]", end, factor, 6)
    return _Axis("thrust P L²/EI" if vehicle.scales.thrust == 1 else "thrust P", end, 1.0, 6)


def _frequency(vehicle: "Vehicle", curve: "ThrustCurve") -> _Axis:
    end = 1.05 * float(curve.angular_frequency.max())
    if vehicle.units == "SI":
        return _Axis("frequency [Hz]", end, 2 * math.pi, 4)
    return _Axis("angular frequency ω", end, 1.0, 4)


def _changes(critical: "CriticalThrust | None", events: "Sequence[Event]") -> list[tuple[float, float, str]]:
    """Thrust, angular frequency and kind of what is marked."""
    if events:
        return [(event.thrust, math.sqrt(max(event.W, 0.0)), event.kind) for event in events]
    found = critical and (critical.elastic or critical)
    if not found or found.critical_thrust is None:
        return []
    return [(found.critical_thrust, found.angular_frequency or 0.0, found.kind)]


def _framed(canvas: Canvas, across: _Axis, up: _Axis, margin: int) -> "list[Text]":
    """The drawing with its axes."""
    numbers = {canvas.cell(0.0, place)[1]: number for place, number in up.ticks.items()}
    lines = [_text(up.label)]
    for n, row in enumerate(canvas.rows()):
        lines.append(_text(f"{numbers.get(n, ''):>{margin}} {'┤' if n in numbers else '│'}").append_text(row))
    places = {canvas.cell(place, 0.0)[0]: number for place, number in across.ticks.items()}
    width = canvas.cell(1.0, 0.0)[0] + 1
    lines.append(_text(f"{'':>{margin}} └" + "".join("┬" if n in places else "─" for n in range(width))))
    below = ""
    for column, number in places.items():
        start = margin + 2 + column - len(number) // 2
        if len(below) < start and start + len(number) <= margin + 2 + width:
            below = below.ljust(start) + number
    lines.append(_text(below))
    lines.append(_text(f"{across.label:>{margin + 2 + width}}"))
    return lines


def _text(line: str) -> "Text":
    from rich.text import Text

    return Text(line.rstrip())
