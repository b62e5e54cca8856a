"""``beal response``: time histories at the sensors."""

from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import DRAWN, named, new_figure, response_figure
from beal.cli.loaded import vehicle_of
from beal.cli.options import AsJson, Figure, Model, Report, Table
from beal.cli.output import Answer, emit, new_result, note, show
from beal.cli.reports import new_report
from beal.errors import ModelError

if TYPE_CHECKING:
    from beal.motion import Initial, Response, ThrustHistory
    from beal.vehicle.vehicle import Vehicle

THRUST = "expected a number, ramp:FROM:TO:TIME, pulsating:MEAN:AMPLITUDE:ANGULAR_FREQUENCY or a CSV file"
INITIAL = "expected mode:NUMBER:AMPLITUDE or release:DEFLECTION[:STATION]"


def response(
    model: Model,
    duration: Annotated[float, typer.Option("--duration", metavar="T", help="Length of time.", show_default=False)],
    step: Annotated[float | None, typer.Option("--step", metavar="DT", help="Time step, else a fitting one.")] = None,
    method: Annotated[str, typer.Option("--method", help="newmark or exact.")] = "newmark",
    thrust: Annotated[
        str | None,
        typer.Option(
            metavar="P",
            help="A number, ramp:FROM:TO:TIME, pulsating:MEAN:AMPLITUDE:ANGULAR_FREQUENCY, or a CSV file with the "
            "columns time and thrust; else thrust.nominal.",
        ),
    ] = None,
    initial: Annotated[
        str | None,
        typer.Option(help="Start: mode:NUMBER:AMPLITUDE, or release:DEFLECTION[:STATION]; else at rest."),
    ] = None,
    elastic: Annotated[bool, typer.Option("--elastic", help="Leave the rigid-body motion out.")] = False,
    quantity: Annotated[
        list[str] | None,
        typer.Option(
            metavar="Q",
            help="What the figure shows: displacement, rate, acceleration, slope, slope_rate, or a part of the motion, "
            "rigid_displacement, elastic_displacement, rigid_slope or elastic_slope; again for more.",
        ),
    ] = None,
    told: Annotated[
        str, typer.Option("--as", metavar="VIEW", help="What is written and drawn: histories, envelope or spectrum.")
    ] = "histories",
    output: Table = None,
    figure: Figure = None,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Motion at the sensors under the thrust and the transverse forces."""
    from beal.cli.views import VIEWS, columns, drawing, view
    from beal.discretisation.build import discretise
    from beal.interop import results
    from beal.motion import PARTS
    from beal.motion import response as motion_of
    from beal.report.records import response_record
    from beal.stability.growth import largest_growth_rate

    if told not in VIEWS:
        raise ModelError(f"--as: must be one of {', '.join(VIEWS)}, found {told!r}")
    vehicle = vehicle_of(model, over_time=True)
    start = initial_of(initial) if initial else None
    given = thrust_of(thrust, vehicle.units) if thrust else None
    shown = _quantities(quantity, told) if quantity else DRAWN
    plain = vehicle.units == "nondimensional"
    with new_figure(figure, as_json) as draw, new_result(output) as write, new_report(report, as_json) as tell:
        operators = discretise(vehicle)
        options: dict[str, Any] = {"step": step, "method": method, "initial": start, "rigid_body": not elastic}
        found = motion_of(operators, duration, given, **options)
        steady = (given is None and not vehicle.thrust.signal) or isinstance(given, float)
        growth = largest_growth_rate(operators, found.thrust, not elastic) if steady else None
        seen = view(found, told)
        axis, along, values = seen
        write(columns(found, seen), lambda: results.at_sensors(found, *seen))
        draw(lambda: response_figure(found, plain, shown, drawing(told)))
        answer = _answer(vehicle, found, growth, apart=bool(operators.rigid) and not elastic)
        figures = {"Histories": partial(response_figure, found, plain)}
        if operators.rigid and not elastic:
            apart = partial(response_figure, found, plain, PARTS[:2])
            figures["Rigid-body and elastic motion apart"] = apart
        swinging = found
        if report and operators.rigid and not elastic:  # a drift has no amplitude
            swinging = motion_of(operators, duration, given, **options | {"rigid_body": False})
        for caption, kind in (("Amplitude of the elastic motion", "envelope"), ("Its spectrum", "spectrum")):
            figures[caption] = partial(response_figure, swinging, plain, DRAWN[:1], drawing(kind))
        tell(vehicle, "motion at the sensors", answer, figures)
    if as_json:
        sensors = {name: {what: value[n] for what, value in values.items()} for n, name in enumerate(found.sensors)}
        beside = {"file": str(output) if output else None, **named(figure, report)}
        emit({**response_record(vehicle, found, growth), axis: along, "sensors": sensors, **beside})
        return
    show(answer)
    if output:
        note(f"{told} written to {output}")


def _answer(vehicle: "Vehicle", found: "Response", growth: float | None, apart: bool) -> "Answer":
    from beal.motion import QUANTITIES

    if growth is None:
        state = f"P from {found.thrust_history.min():.9g} to {found.thrust_history.max():.9g}"
    else:
        state = f"P = {found.thrust:.9g}: "
        state += "stable" if growth <= 0 else f"unstable, its motion grows as exp({growth:.4g} t)"
    sentences = [f"{state}; {len(found.time) - 1} steps of {found.step:.4g} by {found.method}"]
    if vehicle.units == "SI":
        sentences.append("in N, s, m and rad")
    parts = ("displacement", "elastic_displacement", *QUANTITIES[1:]) if apart else QUANTITIES
    largest = [
        [name, *(abs(getattr(found, what)[n]).max().item() for what in parts)] for n, name in enumerate(found.sensors)
    ]
    return [*sentences, (["largest", *(what.replace("_", " ") for what in parts)], largest)]


def initial_of(text: str) -> "Initial":
    """The start that an option gives."""
    from beal.motion import ModeShape, Release

    kind, *numbers = text.split(":")
    try:
        match kind, numbers:
            case "mode", [number, amplitude]:
                return ModeShape(int(number), float(amplitude))
            case "release", [deflection, *station] if len(station) < 2:
                return Release(float(deflection), *map(float, station))
    except ValueError:
        raise ModelError(f"--initial: {INITIAL} with numbers, found {text!r}") from None
    raise ModelError(f"--initial: {INITIAL}, found {text!r}")


def thrust_of(text: str, units: str) -> "float | ThrustHistory":
    """The thrust that an option gives."""
    from beal.motion import PulsatingThrust, ThrustTable
    from beal.vehicle.file import read_timeline

    if text.lower().endswith(".csv"):
        columns = read_timeline(text, units)
        if set(columns) != {"time", "thrust"}:
            raise ModelError(f"--thrust: takes the columns time and thrust, found {', '.join(columns)}", text)
        return ThrustTable(columns["time"], columns["thrust"])
    kind, *numbers = text.split(":")
    try:
        match kind, list(map(float, numbers)):
            case "ramp", [first, last, duration]:
                return ThrustTable([0.0, duration], [first, last])
            case "pulsating", [mean, amplitude, angular_frequency]:
                return PulsatingThrust(mean, amplitude, angular_frequency)
            case number, []:
                return float(number)
    except ModelError:
        raise
    except ValueError:
        raise ModelError(f"--thrust: {THRUST}, found {text!r}") from None
    raise ModelError(f"--thrust: {THRUST}, found {text!r}")


def _quantities(names: "list[str]", told: str) -> list[str]:
    """Those that a view of the motion has, in its order."""
    from beal.motion import PARTS, QUANTITIES
    from beal.motion.spectra import RATE_OF

    known = {"histories": (*QUANTITIES, *PARTS), "envelope": tuple(RATE_OF), "spectrum": QUANTITIES}[told]
    if unknown := set(names) - set(known):
        raise ModelError(f"--quantity: must be one of {', '.join(known)}, found {min(unknown)!r}")
    return [quantity for quantity in known if quantity in names]
