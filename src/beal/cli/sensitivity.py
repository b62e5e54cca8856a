"""``beal sensitivity``: which quantities the critical thrust, or the frequencies, depend on."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import named, new_figure, sensitivity_figure
from beal.cli.options import AsJson, Figure, Formulation, Model
from beal.cli.output import emit, show_table

if TYPE_CHECKING:
    from beal.design.frequencies import FrequencySensitivity
    from beal.design.sensitivity import Rival, Sensitivity
    from beal.design.touches import Touch
    from beal.vehicle.vehicle import Vehicle


def sensitivity(
    model: Model,
    paths: Annotated[
        list[str] | None, typer.Option("--path", metavar="PATH", help="A quantity; may be repeated. By default all.")
    ] = None,
    thrust: Annotated[
        float | None, typer.Option("--thrust", metavar="P", help="Of the frequencies under that thrust instead.")
    ] = None,
    count: Annotated[int, typer.Option("--count", metavar="N", help="Number of frequencies.")] = 4,
    max_thrust: Annotated[float | None, typer.Option("--max-thrust", metavar="P", help="Search up to there.")] = None,
    time: Annotated[float | None, typer.Option("--time", metavar="T", help="At a time of the timeline.")] = None,
    formulation: Formulation = "objective",
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Derivatives of the critical thrust with respect to every quantity, the most important first."""
    from beal.design.frequencies import frequency_sensitivity
    from beal.design.sensitivity import sensitivity as differentiate
    from beal.errors import ModelError
    from beal.interop.files import load

    vehicle = load(model)
    if thrust is not None:
        if figure:
            raise ModelError("--figure: draws the critical thrust's sensitivities, leave --thrust out")
        of_modes = frequency_sensitivity(vehicle, thrust, paths or None, count, formulation, time)  # type: ignore[arg-type]
        if as_json:
            emit({**_frequencies(of_modes), "units": vehicle.units})
        else:
            _show_frequencies(of_modes)
        return
    with new_figure(figure, as_json) as draw:
        found = differentiate(vehicle, paths or None, max_thrust, formulation, time)  # type: ignore[arg-type]
        draw(lambda: sensitivity_figure(found))
    if as_json:
        emit({**_data(found), "units": vehicle.units, **named(figure)})
    else:
        _show(vehicle, found)


def _data(found: "Sensitivity") -> dict[str, Any]:
    return {
        **asdict(found.critical),
        "differentiability": found.status,
        "parameters": [asdict(each) for each in found.parameters],
        "rivals": [
            {"critical_thrust": each.event.thrust, "kind": each.event.kind, "modes": each.event.modes}
            | {"change": each.event.change, "distance": each.distance, "derivatives": each.derivatives}
            for each in found.rivals
        ],
        "touches": [
            {"thrust": each.thrust, "kind": each.kind, "modes": each.modes}
            | {"changes": [None if math.isnan(change) else change for change in each.changes]}
            for each in found.touches
        ],
    }


def _frequencies(found: "FrequencySensitivity") -> dict[str, Any]:
    return {
        "thrust": found.thrust,
        "angular_frequency": found.angular_frequency,
        "growth_rate": found.s.real,
        "parameters": [
            {"path": path, "value": value, "derivative": d, "growth_derivative": g, "elasticity": e}
            for path, value, d, g, e in zip(
                found.paths,
                found.values.tolist(),
                found.frequency_derivative,
                found.growth_derivative,
                found.elasticity,
                strict=True,
            )
        ],
    }


def _show(vehicle: "Vehicle", found: "Sensitivity") -> None:
    from beal.report.verdict import instability

    print(instability(vehicle, found.critical))
    rows = [
        [each.path, each.value, each.derivative, each.elasticity, _significant(each.frequency_elasticity), each.status]
        for each in found.ranked
    ]
    columns = ["name", "value", "derivative", "% per %", "frequency, % per %", "status"]
    show_table(columns, rows, "critical thrust, the most important quantity first")
    if unknown := [each.path for each in found.parameters if each.status == "not differentiable"]:
        print(f"without a derivative, since the critical thrust jumps: {', '.join(unknown)}")
    for rival in found.rivals:
        print(_warning(rival))
    for touch in found.touches:
        print(_cliff(found, touch))


def _significant(elasticity: float) -> float:
    """Zero where there is nothing but rounding."""
    from beal.design.sensitivity import ROUNDING

    return elasticity if abs(elasticity) > ROUNDING else 0.0


def _warning(rival: "Rival") -> str:
    from beal.report.verdict import close_by

    return f"{close_by(rival)}; a change of the vehicle may make the critical thrust jump or give it a kink"


def _cliff(found: "Sensitivity", touch: "Touch") -> str:
    path = found.parameters[touch.changes.index(touch.nearest)].path
    pair = " and ".join(map(str, dict.fromkeys(touch.modes)))
    return (
        f"a cliff close by: {touch.kind} of modes {pair} begins at a thrust of {touch.thrust:.6g} "
        f"once {path} changes by {100 * touch.nearest:+.2g} %"
    )


def _show_frequencies(found: "FrequencySensitivity") -> None:
    columns = ["name", "value", *(f"omega {n} = {omega:.6g}" for n, omega in enumerate(found.angular_frequency, 1))]
    rows = [
        [path, value, *(None if math.isnan(each) else each for each in row)]
        for path, value, row in zip(found.paths, found.values.tolist(), found.elasticity.tolist(), strict=True)
        if any(each and math.isfinite(each) for each in row)
    ]
    show_table(columns, rows, f"angular frequencies under a thrust of {found.thrust:.6g}, % per %")
