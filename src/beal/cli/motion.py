"""``beal response``: time histories at the sensors."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import DRAWN, named, new_figure, response_figure
from beal.cli.options import AsJson, Figure, Model, Table
from beal.cli.output import emit, new_result, note, show_table
from beal.errors import ModelError

if TYPE_CHECKING:
    from beal.motion import Initial, Quantity, Response, ThrustHistory

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
            help="What the figure shows: displacement, rate, acceleration, slope or slope_rate; again for more.",
        ),
    ] = None,
    output: Table = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Motion at the sensors under the thrust and the transverse forces."""
    from beal.discretisation.build import discretise
    from beal.interop import results
    from beal.interop.files import load
    from beal.motion import PARTS, QUANTITIES
    from beal.motion import response as motion_of
    from beal.stability.spectrum import spectrum

    vehicle = load(model)
    start = _initial(initial) if initial else None
    given = thrust_of(thrust, vehicle.units) if thrust else None
    shown = _quantities(quantity) if quantity else DRAWN
    with new_figure(figure, as_json) as draw, new_result(output) as write:
        operators = discretise(vehicle)
        options: dict[str, Any] = {"step": step, "method": method, "initial": start, "rigid_body": not elastic}
        found = motion_of(operators, duration, given, **options)
        steady = given is None or isinstance(given, float)
        growth = float(spectrum(operators, found.thrust, count=6).growth_rate.max()) if steady else None
        write(_columns(found), lambda: results.response(found))
        draw(lambda: response_figure(found, vehicle.units == "nondimensional", shown))
    if as_json:
        whats = (*QUANTITIES, *PARTS)
        sensors = {name: {what: getattr(found, what)[n] for what in whats} for n, name in enumerate(found.sensors)}
        emit(
            {
                "time": found.time,
                "sensors": sensors,
                "method": found.method,
                "step": found.step,
                "thrust": found.thrust,
                "thrust_history": found.thrust_history,
                "growth_rate": growth,
                "units": vehicle.units,
                "file": str(output) if output else None,
                **named(figure),
            }
        )
        return
    if growth is None:
        state = f"P from {found.thrust_history.min():.9g} to {found.thrust_history.max():.9g}"
    else:
        state = f"P = {found.thrust:.9g}: "
        state += "stable" if growth <= 0 else f"unstable, its motion grows as exp({growth:.4g} t)"
    print(f"{state}; {len(found.time) - 1} steps of {found.step:.4g} by {found.method}")
    if vehicle.units == "SI":
        print("in N, s, m and rad")
    parts = ("displacement", "elastic_displacement", *QUANTITIES[1:]) if operators.rigid and not elastic else QUANTITIES
    largest = [[name, *(abs(getattr(found, what)[n]).max().item() for what in parts)] for n, name in _named(found)]
    show_table(["largest", *(what.replace("_", " ") for what in parts)], largest)
    if output:
        note(f"histories written to {output}")


def _initial(text: str) -> "Initial":
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


def _quantities(names: "list[str]") -> "list[Quantity]":
    from beal.motion import QUANTITIES

    if unknown := set(names) - set(QUANTITIES):
        raise ModelError(f"--quantity: must be one of {', '.join(QUANTITIES)}, found {min(unknown)!r}")
    return [quantity for quantity in QUANTITIES if quantity in names]


def _named(found: "Response") -> "list[tuple[int, str]]":
    return list(enumerate(found.sensors))


def _columns(found: "Response") -> dict[str, Any]:
    from beal.motion import PARTS, QUANTITIES

    columns: dict[str, Any] = {"time": found.time}
    for n, name in _named(found):
        columns |= {f"{name}_{what}": getattr(found, what)[n] for what in (*QUANTITIES, *PARTS)}
    return columns
