"""``beal curve``: frequencies over thrust."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import curve_figure, named, new_figure
from beal.cli.options import AsJson, Figure, Formulation, Model, Table
from beal.cli.output import emit, new_result, note, show_table

if TYPE_CHECKING:
    from beal.stability.curve import ThrustCurve


def curve(
    model: Model,
    to: Annotated[float, typer.Option("--to", metavar="P", help="Last thrust.", show_default=False)],
    points: Annotated[int, typer.Option("--points", metavar="N", help="Number of thrusts, from 0.")] = 41,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Number of elastic modes.")] = 4,
    formulation: Formulation = "objective",
    output: Table = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Frequency and growth rate of each mode, followed over the thrust."""
    from beal.interop import results
    from beal.interop.files import load
    from beal.stability.critical import critical_events, critical_thrust
    from beal.stability.curve import thrust_curve

    vehicle = load(model)
    with new_figure(figure, as_json) as draw, new_result(output) as write:
        found = thrust_curve(vehicle, to, points, modes, formulation)  # type: ignore[arg-type]  # checked there
        columns = _columns(found)
        write(columns, lambda: results.thrust_curve(found))
        if figure:
            first = critical_thrust(vehicle, to, formulation)  # type: ignore[arg-type]
            events = critical_events(vehicle, to, formulation)  # type: ignore[arg-type]
            draw(lambda: curve_figure(vehicle, found, first, events))
    if as_json:
        data = {name: getattr(found, name) for name in ("thrust", "angular_frequency", "growth_rate", "formulation")}
        emit({**data, "units": vehicle.units, "file": str(output) if output else None, **named(figure)})
    elif output:
        note(f"{points} thrusts and {modes} modes written to {output}")
    else:
        units = (" [N]", " [rad/s]", " [1/s]") if vehicle.units == "SI" else ("", "", "")
        print("thrust{}; of each mode the angular frequency{} and the growth rate{}".format(*units))
        short = [name.replace("angular_frequency_", "omega ").replace("growth_rate_", "growth ") for name in columns]
        show_table(short, list(zip(*(column.tolist() for column in columns.values()), strict=True)))


def _columns(found: "ThrustCurve") -> dict[str, Any]:
    """The thrust, then frequency and growth rate of each mode."""
    columns: dict[str, Any] = {"thrust": found.thrust}
    for name in ("angular_frequency", "growth_rate"):
        columns |= {f"{name}_{n}": column + 0.0 for n, column in enumerate(getattr(found, name).T, 1)}
    return columns
