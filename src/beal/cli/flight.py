"""``beal flight``: margins over the flight."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import flight_figure, named, new_figure
from beal.cli.loaded import vehicle_of
from beal.cli.options import AsJson, Figure, Model
from beal.cli.output import emit, new_file, note, progress_bar, show_table, write_columns
from beal.report.numbers import cell

if TYPE_CHECKING:
    from beal.study.flight import Flight, FlightState


def flight(
    model: Model,
    timeline: Annotated[
        Path | None, typer.Option("--timeline", metavar="FILE", help="CSV with time, thrust, fill.TANK, stages.")
    ] = None,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Number of elastic modes.")] = 3,
    table: Annotated[Path | None, typer.Option("--csv", metavar="OUT", help="Write a table there.")] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Mass, frequencies, critical thrust and margin at every time of a flight."""
    from beal.cli import NOT_CONVERGED
    from beal.report.records import flight_record
    from beal.study.flight import flight as fly

    vehicle = vehicle_of(model)
    with new_figure(figure, as_json) as draw:
        with progress_bar() as progress:
            found = fly(vehicle, timeline, modes, lambda done, total: progress("times", done, total))
        draw(lambda: flight_figure(found))
    if table:
        with new_file(table) as file:
            write_columns(file, _columns(found))
    if as_json:
        emit({**flight_record(found), **named(figure)})
    else:
        _show(found)
        if table:
            note(f"written to {table}")
    if any(state.status != "solved" for state in found.states):
        raise typer.Exit(NOT_CONVERGED)


def _columns(found: "Flight") -> dict[str, Any]:
    """The same with a column for each mode, and nothing where there is no number."""
    import numpy as np

    from beal.report.records import flight_record

    columns: dict[str, Any] = {}
    for name, values in flight_record(found).items():
        if name == "units":
            continue
        if name == "modes":
            for place, end in enumerate(("mode_low", "mode_high")):
                columns[end] = [pair and pair[place] for pair in values]
        elif np.ndim(values) == 2:
            columns |= {f"{name}_{n}": column for n, column in enumerate(np.transpose(values), 1)}
        else:
            columns[name] = values
    return {name: np.array([_known(value) for value in column], dtype=object) for name, column in columns.items()}


def _known(value: Any) -> Any:
    """None for nan."""
    return None if isinstance(value, float) and math.isnan(value) else value


def _show(found: "Flight") -> None:
    from beal.report.records import stage_range

    si = found.units == "SI"
    staged = len({state.stages for state in found.states}) > 1
    scale, unit = (2 * math.pi, " [Hz]") if si else (1.0, "")
    count = found.angular_frequency.shape[1]
    name = "f" if si else "omega"
    columns = ["time", "mass", "thrust"]
    columns = [f"{title} [{unit}]" if si else title for title, unit in zip(columns, ("s", "kg", "N"), strict=True)]
    columns += [*(["stages"] if staged else []), *(f"{name} {n}{unit}" for n in range(1, count + 1))]
    columns += ["critical thrust" + (" [N]" if si else ""), "instability", "margin"]
    rows = [
        [
            state.time,
            state.mass,
            state.thrust,
            *([stage_range(state)] if staged else []),
            *(_known(omega / scale) for omega in frequencies),
            state.critical and state.critical.critical_thrust,
            _instability(state),
            _margin(state),
        ]
        for state, frequencies in zip(found.states, found.angular_frequency.tolist(), strict=True)
    ]
    show_table(columns, rows, "margin: critical over actual thrust, less 1")
    for reason in dict.fromkeys(state.reason for state in found.states if state.reason):
        times = ", ".join(cell(state.time) for state in found.states if state.reason == reason)
        print(f"at {times}: {reason}")


def _instability(state: "FlightState") -> str:
    found = state.critical
    if found is None:
        return state.status.replace("_", " ")
    if found.elastic is not None:
        return "tumbles"
    if found.modes is None:
        return f"stable up to {found.searched_to:.6g}"
    low, high = found.modes
    return f"{found.kind} {low}" if low == high else f"{found.kind} {low}-{high}"


def _margin(state: "FlightState") -> str:
    if math.isnan(state.margin):
        return ""
    return f"{'>= ' if state.at_least else ''}{state.margin:.4g}"
