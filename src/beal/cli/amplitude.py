"""``beal amplitude``: the largest motion at a sensor over thrust and force."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import amplitude_figure, named, new_figure
from beal.cli.grids import values
from beal.cli.loaded import vehicle_of
from beal.cli.motion import initial_of
from beal.cli.options import AsJson, Figure, Model, Table
from beal.cli.output import emit, new_result, note, progress_bar
from beal.errors import ModelError
from beal.report.numbers import quantity as with_unit

if TYPE_CHECKING:
    from beal.motion import AmplitudeMap
    from beal.vehicle.vehicle import Vehicle


def amplitude(
    model: Model,
    duration: Annotated[float, typer.Option("--duration", metavar="T", help="Length of time.", show_default=False)],
    thrust: Annotated[
        str, typer.Option("--thrust", metavar="P", help="A number, or a grid as FROM:TO:POINTS.", show_default=False)
    ],
    force: Annotated[
        str, typer.Option("--force", metavar="X", help="Multiples of the model's forces: a number or a grid.")
    ] = "1",
    sensor: Annotated[str | None, typer.Option(metavar="NAME", help="Else the first.")] = None,
    quantity: Annotated[
        str, typer.Option(metavar="Q", help="displacement, rate, acceleration, slope or slope_rate.")
    ] = "displacement",
    initial: Annotated[
        str | None,
        typer.Option(help="Start: mode:NUMBER:AMPLITUDE, or release:DEFLECTION[:STATION]; else at rest."),
    ] = None,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Elastic modes that are kept.")] = 8,
    output: Table = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """The largest motion at a sensor within a time, over thrust and force."""
    from beal.interop import results
    from beal.motion import amplitude_map

    vehicle = vehicle_of(model)
    thrusts, factors = values("--thrust", thrust), values("--force", force)
    if figure and 1 in (len(thrusts), len(factors)):
        raise ModelError("--figure: draws a map over grids of both --thrust and --force")
    start = initial_of(initial) if initial else None
    with new_figure(figure, as_json) as draw, new_result(output) as write, progress_bar() as progress:
        found = amplitude_map(
            vehicle,
            duration,
            thrusts,
            factors,
            sensor=sensor,
            quantity=quantity,  # type: ignore[arg-type]  # checked there
            initial=start,
            modes=modes,
            progress=lambda *n: progress("thrusts", *n),
        )
        write(_columns(found), lambda: results.amplitude_map(found))
        draw(lambda: amplitude_figure(found, vehicle.units == "nondimensional"))
    if as_json:
        told = {
            name: getattr(found, name) for name in ("thrust", "factor", "amplitude", "sensor", "quantity", "duration")
        }
        emit({**told, "units": vehicle.units, "file": str(output) if output else None, **named(figure)})
        return
    print(_told(vehicle, found))
    if output:
        note(f"amplitudes written to {output}")


def _columns(found: "AmplitudeMap") -> dict[str, Any]:
    """A row for each thrust and multiple."""
    from numpy import repeat, tile

    thrusts, factors = len(found.thrust), len(found.factor)
    return {
        "thrust": repeat(found.thrust, factors),
        "force": tile(found.factor, thrusts),
        f"largest_{found.quantity}": found.amplitude.ravel(),
    }


def _told(vehicle: "Vehicle", found: "AmplitudeMap") -> str:
    """Where the motion is largest."""
    import numpy as np

    si = vehicle.units == "SI"
    p, f = np.unravel_index(np.argmax(found.amplitude), found.amplitude.shape)
    where = f"P = {with_unit(float(found.thrust[p]), 'N' if si else '')} and {found.factor[f]:g} times the forces"
    largest = f"{found.amplitude[p, f]:.6g}{' (SI)' if si else ''}"
    return (
        f"largest {found.quantity.replace('_', ' ')} at {found.sensor} within {found.duration:g}: {largest}, at {where}"
    )
