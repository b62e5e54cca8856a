"""``beal control``: the roots of the closed loop."""

import math
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import control_figure, named, new_figure
from beal.cli.options import AsJson, Figure, Model, Table
from beal.cli.output import emit, new_path, new_result, note, quantity, show_table
from beal.errors import ModelError

if TYPE_CHECKING:
    from beal.control import ClosedLoop, ControlledThrust, Margins
    from beal.vehicle.vehicle import Vehicle

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
    to: Annotated[float | None, typer.Option("--to", metavar="X", help="Up to there; of a gain, a factor.")] = None,
    output: Table = None,
    figure: Figure = None,
    plant: Annotated[
        Path | None,
        typer.Option("--state-space", metavar="FILE", help="Write the open loop there: .mat or .nc."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Roots and margins of the vehicle with its control law closed."""
    from beal.control import closed_loop, control_locus, controlled_thrust, stability_margins, state_space
    from beal.interop import results
    from beal.interop.files import load, write_result

    if plant and plant.suffix.lower() not in STATE_SPACE:
        known = " or ".join(STATE_SPACE)
        raise ModelError(f"--state-space: must end with {known}, found {plant.suffix or 'no ending'}", str(plant))
    if not figure and (over != "thrust" or to is not None):
        raise ModelError("--over, --to: say what a figure shows; give --figure FILE")
    vehicle = load(model)
    with new_figure(figure, as_json) as draw, new_result(output) as write:
        found = closed_loop(vehicle, thrust, modes)
        margins = stability_margins(vehicle, thrust, modes)
        critical = controlled_thrust(vehicle, modes=modes) if largest else None
        write(_columns(found), lambda: results.closed_loop(found))
        if figure:
            values = _values(vehicle, over, to, found.thrust)
            locus = control_locus(vehicle, over, values, found.thrust, min(modes, DRAWN))
            draw(lambda: control_figure(locus, vehicle.units == "nondimensional"))
    if plant:
        with new_path(plant) as part:
            matrices = state_space(vehicle, thrust, modes=modes)
            write_result(results.state_space(matrices), part, plant.suffix.lower())
    if as_json:
        emit(
            {
                "thrust": found.thrust,
                "roots": _pairs(found.roots),
                "stable": found.stable,
                "rigid_body_roots": _pairs(found.rigid_body_roots),
                "least_damped": _least(found),
                "margins": _margins(margins),
                **({"critical": asdict(critical)} if critical else {}),
                "error_estimate": found.error_estimate,
                "units": vehicle.units,
                "file": str(output) if output else None,
                "state_space": str(plant) if plant else None,
                **named(figure),
            }
        )
        return
    _show(vehicle, found)
    _show_margins(vehicle, margins)
    if critical:
        print(_borne(vehicle, critical))
    for what, path in (("roots", output), ("state space", plant)):
        if path:
            note(f"{what} written to {path}")


def _values(vehicle: "Vehicle", over: str, to: float | None, thrust: float) -> "list[float]":
    """From nothing, or what the quantity is, to where the figure ends."""
    from beal.vehicle.paths import value_at

    start = 0.0 if over in ("thrust", "gain") else value_at(vehicle, over)
    end = BEYOND * {"thrust": thrust, "gain": 1.0}.get(over, start) if to is None else to
    if not math.isfinite(end) or end == start:
        raise ModelError(f"--to: must be a finite number other than the first, {start:g}, found {end:g}")
    return [start + (end - start) * n / (POINTS - 1) for n in range(POINTS)]


def _least(found: "ClosedLoop") -> dict[str, Any]:
    root = found.least_damped
    return {
        "root": [root.real, root.imag],
        "angular_frequency": abs(root.imag),
        "damping_ratio": -root.real / abs(root),
    }


def _margins(found: "Margins") -> dict[str, Any]:
    gain = [{**asdict(margin), "decibel": margin.decibel} for margin in found.gain]
    phase = [{**asdict(margin), "delay": margin.delay} for margin in found.phase]
    return {"gain": gain, "phase": phase}


def _pairs(roots: Any) -> Any:
    return [[root.real, root.imag] for root in roots.tolist()]


def _columns(found: "ClosedLoop") -> dict[str, Any]:
    return {"real": found.roots.real, "imag": found.roots.imag, "damping_ratio": found.damping_ratio}


def _show(vehicle: "Vehicle", found: "ClosedLoop") -> None:
    root, si = found.least_damped, vehicle.units == "SI"
    if found.stable:
        state = "stable" if root.real < 0 else "stable, but undamped"
    else:
        state = f"unstable, its motion grows as exp({root.real:.4g} t)"
    drift = f"; {found.drift} zero roots of rigid-body drift" if found.drift else ""
    print(f"P = {found.thrust:.9g}{' N' if si else ''}: {state}{drift}")
    upper = [root for root in found.roots[found.drift :].tolist() if root.imag >= 0]
    rows = [[root.real + 0.0, root.imag, -root.real / abs(root) + 0.0] for root in upper]
    columns = ["real part [1/s]", "imaginary part [rad/s]"] if si else ["real part", "imaginary part"]
    if si:
        rows = [[real, imag, imag / (2 * math.pi), ratio] for real, imag, ratio in rows]
        columns.append("frequency [Hz]")
    show_table([*columns, "damping ratio"], rows)


def _show_margins(vehicle: "Vehicle", found: "Margins") -> None:
    rows: list[list[Any]] = [
        ["gain", margin.angular_frequency, _mode(margin.mode), margin.decibel, margin.factor] for margin in found.gain
    ]
    rows += [
        ["phase", margin.angular_frequency, _mode(margin.mode), margin.degrees, margin.delay] for margin in found.phase
    ]
    if rows:
        unit = (" [rad/s]", " [s]") if vehicle.units == "SI" else ("", "")
        columns = ["name", f"angular frequency{unit[0]}", "near", "margin [dB, deg]", f"factor, delay{unit[1]}"]
        rows.sort(key=lambda row: row[1])
        show_table(columns, rows)


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
