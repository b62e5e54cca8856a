"""``beal floquet``: a pulsating thrust, at one frequency and amplitude or over a grid of both."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import floquet_figure, multipliers_figure, named, new_figure
from beal.cli.grids import GRID, values
from beal.cli.loaded import vehicle_of
from beal.cli.options import AsJson, Figure, Model, Report
from beal.cli.output import Answer, check_new_folder, emit, progress_bar, show
from beal.cli.reports import new_report
from beal.errors import ModelError
from beal.report.numbers import digits

if TYPE_CHECKING:
    from xarray import Dataset

    from beal.stability.floquet import Floquet
    from beal.vehicle.vehicle import Vehicle

QUESTION = "under a pulsating thrust"


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
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Stability under the thrust P0 + P1 cos(W t): multipliers of a period and the resonance."""
    from beal.stability.floquet import floquet as multipliers_of

    vehicle = vehicle_of(model)
    mean = vehicle.thrust.nominal if thrust is None else thrust
    if mean is None:
        raise ModelError("--thrust: give one, or set thrust.nominal in the model")
    amplitudes, frequencies = values("--amplitude", amplitude), values("--angular-frequency", angular_frequency)
    if len(amplitudes) == len(frequencies) == 1:
        if output or figure:
            raise ModelError(f"{'--output' if output else '--figure'}: holds a chart; give {GRID}")
        with new_report(report, as_json) as tell:
            found = multipliers_of(vehicle, mean, amplitudes[0], frequencies[0], modes)
            tell(vehicle, QUESTION, _point(found), {"Multipliers of a period": lambda: multipliers_figure(found)})
        _show_point(vehicle, found, report, as_json)
        return
    if figure and 1 in (len(amplitudes), len(frequencies)):
        raise ModelError("--figure: draws charts over a grid of both the amplitude and the angular frequency")
    with new_figure(figure, as_json) as draw, new_report(report, as_json) as tell:
        chart = _chart(vehicle, mean, frequencies, amplitudes, modes, output)
        draw(lambda: floquet_figure(chart))
        grid = 1 not in (len(amplitudes), len(frequencies))
        figures = {"Growth rate over frequency and amplitude": lambda: floquet_figure(chart)} if grid else {}
        tell(vehicle, QUESTION, _of_chart(chart, output), figures)
    _show_chart(vehicle, chart, output, named(figure, report), as_json)


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
    check_new_folder(out)
    chart = _chart(vehicle, thrust, frequencies, amplitudes, modes, None)
    write_chart(chart, Place.of(out))
    return chart


def _show_point(vehicle: "Vehicle", found: "Floquet", report: Path | None, as_json: bool) -> None:
    if not as_json:
        show(_point(found))
        return
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
            **named(None, report),
        }
    )


def _point(found: "Floquet") -> Answer:
    state = "stable" if found.stable else f"unstable, its motion grows as exp({found.growth_rate:.4g} t)"
    modulus = digits(found.largest_modulus, found.error_estimate)
    told = [f"P = {found.thrust:g} + {found.amplitude:g} cos({found.angular_frequency:g} t): {state}"]
    told.append(f"largest modulus of the multipliers: {modulus}")
    if resonance := found.resonance:
        told.append(f"nearest resonance: {resonance.name} = {resonance.angular_frequency:.6g}")
    return [*told, *_beside(found.thrust, found.steady_growth_rate, found.rigid_body_modes)]


def _show_chart(
    vehicle: "Vehicle", chart: "Dataset", out: Path | None, pictures: dict[str, str], as_json: bool
) -> None:
    from beal.study.pulsating import chart_resonances

    if not as_json:
        show(_of_chart(chart, out))
        return
    data: dict[str, Any] = {
        "file": str(out) if out else None,
        "points": chart.stable.size,
        "unstable": int((~chart.stable).sum()),
        "largest_modulus": float(chart.largest_modulus.max()),
        "resonances": [{"name": name, "angular_frequency": omega} for name, omega in chart_resonances(chart)],
        **{name: chart.attrs[name] for name in ("thrust", "steady_growth_rate", "rigid_body_modes")},
        "units": vehicle.units,
    }
    emit({**data, **pictures})


def _of_chart(chart: "Dataset", out: Path | None) -> Answer:
    from beal.study.pulsating import chart_resonances

    points, unstable = chart.stable.size, int((~chart.stable).sum())
    resonant = ", ".join(f"{name} = {omega:.6g}" for name, omega in chart_resonances(chart))
    told = [f"{f'{out}: ' if out else ''}{points} points: {points - unstable} stable, {unstable} unstable"]
    told.append(f"resonances: {resonant or 'none within'}")
    return [*told, *_beside(*(chart.attrs[name] for name in ("thrust", "steady_growth_rate", "rigid_body_modes")))]


def _beside(thrust: float, growth: float, rigid: int) -> list[str]:
    """What holds for all pulsations."""
    told = []
    if growth > 0:
        told.append(f"already unstable under P = {thrust:g} alone, its motion grows as exp({growth:.4g} t)")
    if rigid:
        told.append(f"rigid-body motions left out, which drive no others: {rigid}")
    return told
