"""``beal control``: the roots of the closed loop."""

import math
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.control_map import show_map
from beal.cli.figures import Draw, control_figure, named, new_figure, open_loop_figure
from beal.cli.options import AsJson, Figure, Model, Report, Table
from beal.cli.output import Answer, emit, new_path, new_result, note, show
from beal.cli.reports import new_report
from beal.errors import ModelError
from beal.report.numbers import quantity

if TYPE_CHECKING:
    from beal.control import ClosedLoop, ControlledThrust, Margins
    from beal.vehicle.vehicle import Vehicle

DRAWINGS = ("locus", "nyquist", "nichols")
STATE_SPACE = (".mat", ".nc")
DRAWN, POINTS, BEYOND = 3, 201, 2.0  # modes and points of a figure, and how many times thrust or gains it reaches


def control(
    model: Model,
    thrust: Annotated[float | None, typer.Option("--thrust", metavar="P", help="Else thrust.nominal.")] = None,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Number of elastic modes.")] = 6,
    largest: Annotated[bool, typer.Option("--critical", help="The largest stable thrust too.")] = False,
    over: Annotated[
        str, typer.Option("--over", metavar="NAME", help="What varies in the figure: thrust, gain, or a path.")
    ] = "thrust",
    start: Annotated[float | None, typer.Option("--from", metavar="X", help="Of a map: from there.")] = None,
    to: Annotated[float | None, typer.Option("--to", metavar="X", help="Up to there; of a gain, a factor.")] = None,
    mapped: Annotated[
        bool, typer.Option("--map", help="Where the loop is stable, over the thrust and --over.")
    ] = False,
    max_thrust: Annotated[
        float | None, typer.Option("--max-thrust", metavar="P", help="Of a map; else twice the thrust.")
    ] = None,
    points: Annotated[int, typer.Option("--points", metavar="N", help="Of a map, along each axis.")] = 61,
    drawn: Annotated[
        str, typer.Option("--draw", metavar="WHAT", help="What the figure shows: locus, nyquist or nichols.")
    ] = "locus",
    output: Table = None,
    figure: Figure = None,
    report: Report = None,
    plant: Annotated[
        Path | None,
        typer.Option("--state-space", metavar="FILE", help="Write the open loop there: .mat or .nc."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Roots and margins of the vehicle with its control law closed."""
    from beal.control import closed_loop, control_locus, controlled_thrust, open_loop, stability_margins, state_space
    from beal.interop import results
    from beal.interop.files import load, write_result
    from beal.report.records import control_record

    if plant and plant.suffix.lower() not in STATE_SPACE:
        known = " or ".join(STATE_SPACE)
        raise ModelError(f"--state-space: must end with {known}, found {plant.suffix or 'no ending'}", str(plant))
    if drawn not in DRAWINGS:
        raise ModelError(f"--draw: must be one of {', '.join(DRAWINGS)}, found {drawn!r}")
    vehicle = load(model)
    if mapped and report:
        raise ModelError("--report: tells of one thrust; leave out --map")
    if mapped:
        limits = (start, to, max_thrust)
        show_map(vehicle, over, limits, points, thrust, min(modes, DRAWN), output, figure, as_json)
        return
    if start is not None or max_thrust is not None:
        raise ModelError("--from, --max-thrust: are of a map; give --map")
    if not figure and (over != "thrust" or to is not None or drawn != "locus"):
        raise ModelError("--over, --to, --draw: say what a figure shows; give --figure FILE")
    with new_figure(figure, as_json) as draw, new_result(output) as write, new_report(report, as_json) as tell:
        found = closed_loop(vehicle, thrust, modes)
        margins = stability_margins(vehicle, thrust, modes)
        critical = controlled_thrust(vehicle, modes=modes) if largest else None
        write(_columns(found), lambda: results.closed_loop(found))
        if figure and drawn == "locus":
            values = _values(vehicle, over, to, found.thrust)
            locus = control_locus(vehicle, over, values, found.thrust, min(modes, DRAWN))
            draw(lambda: control_figure(locus, vehicle.units == "nondimensional"))
        elif figure:
            loop = open_loop(vehicle, thrust, modes)
            draw(lambda: open_loop_figure(loop, margins, drawn))
        answer = _answer(vehicle, found, margins, critical)
        if report:
            tell(
                vehicle, "its control loop closed", answer, _figures(vehicle, found.thrust, margins, min(modes, DRAWN))
            )
    if plant:
        with new_path(plant) as part:
            matrices = state_space(vehicle, thrust, modes=modes)
            write_result(results.state_space(matrices), part, plant.suffix.lower())
    if as_json:
        emit(
            {
                **control_record(vehicle, found, margins),
                **({"critical": asdict(critical)} if critical else {}),
                "file": str(output) if output else None,
                "state_space": str(plant) if plant else None,
                **named(figure, report),
            }
        )
        return
    show(answer)
    for what, path in (("roots", output), ("state space", plant)):
        if path:
            note(f"{what} written to {path}")


def _figures(vehicle: "Vehicle", thrust: float, margins: "Margins", modes: int) -> "dict[str, Draw]":
    """What a report shows."""
    from beal.control import control_locus, open_loop

    plain = vehicle.units == "nondimensional"
    figures: dict[str, Draw] = {}
    for over, caption in (("thrust", "from no thrust to twice this one"), ("gain", "from no gain to twice the law's")):
        locus = control_locus(vehicle, over, _values(vehicle, over, None, thrust), thrust, modes)
        figures[f"Roots {caption}"] = partial(control_figure, locus, plain)
    if margins.gain or margins.phase:
        loop = open_loop(vehicle, thrust, modes)
        figures["Open loop, Nyquist"] = partial(open_loop_figure, loop, margins, "nyquist")
        figures["Open loop, Nichols"] = partial(open_loop_figure, loop, margins, "nichols")
    return figures


def _values(vehicle: "Vehicle", over: str, to: float | None, thrust: float) -> "list[float]":
    """From nothing, or what the quantity is, to where the figure ends."""
    from beal.vehicle.paths import value_at

    start = 0.0 if over in ("thrust", "gain") else value_at(vehicle, over)
    end = BEYOND * {"thrust": thrust, "gain": 1.0}.get(over, start) if to is None else to
    if not math.isfinite(end) or end == start:
        raise ModelError(f"--to: must be a finite number other than the first, {start:g}, found {end:g}")
    return [start + (end - start) * n / (POINTS - 1) for n in range(POINTS)]


def _columns(found: "ClosedLoop") -> dict[str, Any]:
    return {"real": found.roots.real, "imag": found.roots.imag, "damping_ratio": found.damping_ratio}


def _answer(vehicle: "Vehicle", found: "ClosedLoop", margins: "Margins", critical: "ControlledThrust | None") -> Answer:
    root, si = found.least_damped, vehicle.units == "SI"
    if found.stable:
        state = "stable" if root.real < 0 else "stable, but undamped"
    else:
        state = f"unstable, its motion grows as exp({root.real:.4g} t)"
    drift = f"; {found.drift} zero roots of rigid-body drift" if found.drift else ""
    moving = zip(found.roots[found.drift :].tolist(), found.damping_ratio[found.drift :].tolist(), strict=True)
    rows = [[root.real + 0.0, root.imag, ratio + 0.0] for root, ratio in moving if root.imag >= 0]
    columns = ["real part [1/s]", "imaginary part [rad/s]"] if si else ["real part", "imaginary part"]
    if si:
        rows = [[real, imag, imag / (2 * math.pi), ratio] for real, imag, ratio in rows]
        columns.append("frequency [Hz]")
    answer: list[Any] = [f"P = {found.thrust:.9g}{' N' if si else ''}: {state}{drift}"]
    answer.append(([*columns, "damping ratio"], rows))
    if margins.gain or margins.phase:
        answer.append(_margin_table(vehicle, margins))
    if critical:
        answer.append(_borne(vehicle, critical))
    return answer


def _margin_table(vehicle: "Vehicle", found: "Margins") -> tuple[list[str], list[list[Any]]]:
    rows: list[list[Any]] = [
        ["gain", margin.angular_frequency, _mode(margin.mode), margin.decibel, margin.factor] for margin in found.gain
    ]
    rows += [
        ["phase", margin.angular_frequency, _mode(margin.mode), margin.degrees, margin.delay] for margin in found.phase
    ]
    unit = (" [rad/s]", " [s]") if vehicle.units == "SI" else ("", "")
    columns = ["name", f"angular frequency{unit[0]}", "near", "margin [dB, deg]", f"factor, delay{unit[1]}"]
    return columns, sorted(rows, key=lambda row: row[1])


def _mode(number: int) -> str:
    return f"mode {number}" if number else "rigid body"


def _borne(vehicle: "Vehicle", found: "ControlledThrust") -> str:
    unit = "N" if vehicle.units == "SI" else ""
    if found.critical_thrust is None or found.angular_frequency is None:
        return f"stable up to {quantity(found.searched_to, unit)}, as far as was searched"
    if not found.critical_thrust:
        return "unstable under any thrust"
    thrust = quantity(found.critical_thrust, unit, found.error_estimate)
    if found.kind == "divergence":
        return f"with the loop closed: diverges at P = {thrust}"
    return f"with the loop closed: flutters at P = {thrust}, {found.angular_frequency:.6g}{' rad/s' * bool(unit)}"
