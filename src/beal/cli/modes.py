"""``beal modes``: frequencies of the loaded or unloaded vehicle, converged."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import modes_figure, named, new_figure
from beal.cli.options import AsJson, Figure, Formulation, Model
from beal.cli.output import digits, emit, new_result, note, show_table
from beal.errors import ModelError

if TYPE_CHECKING:
    import xarray

    from beal.vehicle.vehicle import Vehicle


def modes(
    model: Model,
    count: Annotated[int, typer.Option("--count", metavar="N", help="Number of elastic modes.")] = 6,
    thrust: Annotated[float | None, typer.Option("--thrust", metavar="P", help="Thrust; 0 unless given.")] = None,
    loaded: Annotated[bool, typer.Option("--loaded", help="Under the model's nominal thrust.")] = False,
    formulation: Formulation = "objective",
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Write the mode shapes there: CSV, .uff, .nc or .mat."),
    ] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Frequencies and growth rates of the lowest elastic modes at a thrust."""
    from beal.discretisation.build import discretise
    from beal.interop.files import load
    from beal.interop.results import mode_shapes
    from beal.stability.modes import converged_modes
    from beal.stability.spectrum import spectrum

    vehicle = load(model)
    with new_figure(figure, as_json) as draw, new_result(output) as write:
        found, error = converged_modes(vehicle, _thrust(vehicle, thrust, loaded), count, formulation)  # type: ignore[arg-type]
        if output or figure:
            operators = discretise(vehicle, formulation)  # type: ignore[arg-type]  # checked before
            shapes = spectrum(operators, found.thrust, count)
            draw(lambda: modes_figure(shapes, operators))
            if output:
                dataset = mode_shapes(shapes, operators)
                write(_columns(dataset), lambda: dataset)
    order = found.angular_frequency.argsort(kind="stable")
    omega, growth = found.angular_frequency[order], found.growth_rate[order] + 0.0  # no -0
    si = vehicle.units == "SI"
    data: dict[str, Any] = {
        "angular_frequency": omega,
        **({"frequency_hz": omega / (2 * math.pi)} if si else {}),
        "growth_rate": growth,
        "error_estimate": error,
        "rigid_body_modes": found.rigid_body_modes,
        "thrust": found.thrust,
        "formulation": formulation,
        "units": vehicle.units,
        **({"file": str(output)} if output else {}),
        **named(figure),
    }
    if as_json:
        emit(data)
        return
    print(f"elastic modes at P = {found.thrust:.9g}{' N' if si else ''}; rigid-body modes: {found.rigid_body_modes}")
    errors = [None] * len(omega) if error is None else error.tolist()
    rows = [
        [n, digits(w, e), *([w / (2 * math.pi)] if si else []), a, e]
        for n, (w, a, e) in enumerate(zip(omega.tolist(), growth.tolist(), errors, strict=True), 1)
    ]
    rate = " [1/s]" if si else ""
    frequency = ["angular frequency [rad/s]", "frequency [Hz]"] if si else ["angular frequency"]
    show_table(["mode", *frequency, f"growth rate{rate}", "error estimate"], rows)
    if output:
        note(f"mode shapes written to {output}")


def _columns(shapes: "xarray.Dataset") -> dict[str, Any]:
    """The station, then the real part of each mode's deflection and slope."""
    columns: dict[str, Any] = {"station": shapes["station"].values}
    for name in ("displacement", "slope"):
        columns |= {f"{name}_{n}": row for n, row in enumerate(shapes[f"{name}_real"].values, 1)}
    return columns


def _thrust(vehicle: "Vehicle", thrust: float | None, loaded: bool) -> float:
    if not loaded:
        return thrust or 0.0
    if thrust is not None:
        raise ModelError("--thrust: is given beside --loaded, which takes thrust.nominal; give one of them")
    if vehicle.thrust.nominal is None:
        raise ModelError("thrust.nominal: is needed by --loaded and missing in the model; give --thrust instead")
    return vehicle.thrust.nominal
