"""``beal floquet``: a pulsating thrust, at one frequency and amplitude or over a grid of both."""

import math
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import floquet_figure, named, new_figure
from beal.cli.options import AsJson, Figure, Model
from beal.cli.output import check_folder, digits, emit, progress_bar
from beal.errors import ModelError

if TYPE_CHECKING:
    from xarray import Dataset

    from beal.stability.floquet import Floquet
    from beal.vehicle.vehicle import Vehicle

GRID = "a number, or a grid as FROM:TO:POINTS with more than one point"


def floquet(
    model: Model,
    amplitude: Annotated[
        str,
        typer.Option("--amplitude", metavar="P1", help="A number, or a grid as FROM:TO:POINTS.", show_default=False),
    ],
    angular_frequency: Annotated[
        str, typer.Option("--angular-frequency", metavar="W", help="The same.", show_default=False)
    ],
    thrust: Annotated[float | None, typer.Option("--thrust", metavar="P0", help="Else thrust.nominal.")] = None,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Elastic modes that keep their inertia.")] = 8,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="OUT.zarr", help="Folder of the chart over a grid.")
    ] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Stability under the thrust P0 + P1 cos(W t): multipliers of a period and the resonance."""
    from beal.interop.files import load
    from beal.stability.floquet import floquet as multipliers_of

    vehicle = load(model)
    mean = vehicle.thrust.nominal if thrust is None else thrust
    if mean is None:
        raise ModelError("--thrust: give one, or set thrust.nominal in the model")
    amplitudes, frequencies = _values("--amplitude", amplitude), _values("--angular-frequency", angular_frequency)
    if len(amplitudes) == len(frequencies) == 1:
        if output or figure:
            raise ModelError(f"{'--output' if output else '--figure'}: holds a chart; give {GRID}")
        found = multipliers_of(vehicle, mean, amplitudes[0], frequencies[0], modes)
        _show_point(vehicle, found, as_json)
        return
    if figure and 1 in (len(amplitudes), len(frequencies)):
        raise ModelError("--figure: draws charts over a grid of both the amplitude and the angular frequency")
    with new_figure(figure, as_json) as draw:
        chart = _chart(vehicle, mean, frequencies, amplitudes, modes, output)
        draw(lambda: floquet_figure(chart))
    _show_chart(vehicle, chart, output, figure, as_json)


def _values(option: str, text: str) -> list[float]:
    """One number, or those of a grid."""
    from numpy import linspace

    try:
        match text.split(":"):
            case [number]:
                return [float(number)]
            case [start, stop, points] if float(start) < float(stop) < math.inf and int(points) > 1:
                return list(linspace(float(start), float(stop), int(points)).tolist())
    except ValueError:
        pass
    raise ModelError(f"{option}: must be {GRID}, in ascending order, found {text!r}")


def _chart(
    vehicle: "Vehicle", thrust: float, frequencies: list[float], amplitudes: list[float], modes: int, out: Path | None
) -> "Dataset":
    """The chart, written where it is asked for."""
    from beal.study.place import Place
    from beal.study.pulsating import floquet_chart, write_chart

    if out is None:
        with progress_bar() as progress:
            return floquet_chart(
                vehicle, thrust, frequencies, amplitudes, modes, lambda *n: progress("frequencies", *n)
            )
    check_folder(out)
    if out.exists():
        raise ModelError("exists already; name another place or remove it", str(out))
    chart = _chart(vehicle, thrust, frequencies, amplitudes, modes, None)
    write_chart(chart, Place.of(out))
    return chart


def _show_point(vehicle: "Vehicle", found: "Floquet", as_json: bool) -> None:
    if as_json:
        resonance = found.resonance
        emit(
            {
                "multipliers": [[number.real, number.imag] for number in found.multipliers.tolist()],
                "stable": found.stable,
                "largest_modulus": found.largest_modulus,
                "growth_rate": found.growth_rate,
                "error_estimate": found.error_estimate,
                "resonance": resonance and {"name": resonance.name, **asdict(resonance)},
                "thrust": found.thrust,
                "amplitude": found.amplitude,
                "angular_frequency": found.angular_frequency,
                "steady_growth_rate": found.steady_growth_rate,
                "rigid_body_modes": found.rigid_body_modes,
                "units": vehicle.units,
            }
        )
        return
    state = "stable" if found.stable else f"unstable, its motion grows as exp({found.growth_rate:.4g} t)"
    modulus = digits(found.largest_modulus, found.error_estimate)
    print(f"P = {found.thrust:g} + {found.amplitude:g} cos({found.angular_frequency:g} t): {state}")
    print(f"largest modulus of the multipliers: {modulus}")
    if resonance := found.resonance:
        print(f"nearest resonance: {resonance.name} = {resonance.angular_frequency:.6g}")
    _beside(found.thrust, found.steady_growth_rate, found.rigid_body_modes)


def _show_chart(vehicle: "Vehicle", chart: "Dataset", out: Path | None, figure: Path | None, as_json: bool) -> None:
    from beal.study.pulsating import chart_resonances

    points, unstable = chart.stable.size, int((~chart.stable).sum())
    found = chart_resonances(chart)
    if as_json:
        data: dict[str, Any] = {
            "file": str(out) if out else None,
            "points": points,
            "unstable": unstable,
            "largest_modulus": float(chart.largest_modulus.max()),
            "resonances": [{"name": name, "angular_frequency": omega} for name, omega in found],
            **{name: chart.attrs[name] for name in ("thrust", "steady_growth_rate", "rigid_body_modes")},
            "units": vehicle.units,
        }
        emit({**data, **named(figure)})
        return
    print(f"{f'{out}: ' if out else ''}{points} points: {points - unstable} stable, {unstable} unstable")
    print("resonances: " + (", ".join(f"{name} = {omega:.6g}" for name, omega in found) or "none within"))
    _beside(chart.attrs["thrust"], chart.attrs["steady_growth_rate"], chart.attrs["rigid_body_modes"])


def _beside(thrust: float, growth: float, rigid: int) -> None:
    """What holds for all pulsations."""
    if growth > 0:
        print(f"already unstable under P = {thrust:g} alone, its motion grows as exp({growth:.4g} t)")
    if rigid:
        print(f"rigid-body motions left out, which drive no others: {rigid}")
