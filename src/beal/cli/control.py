"""``beal control``: the roots of the closed loop."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.options import AsJson, Model, Table
from beal.cli.output import emit, new_path, new_result, note, show_table
from beal.errors import ModelError

if TYPE_CHECKING:
    from beal.control import ClosedLoop
    from beal.vehicle.vehicle import Vehicle

STATE_SPACE = (".mat", ".nc")


def control(
    model: Model,
    thrust: Annotated[float | None, typer.Option("--thrust", metavar="P", help="Else thrust.nominal.")] = None,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help="Number of elastic modes.")] = 6,
    output: Table = None,
    plant: Annotated[
        Path | None,
        typer.Option("--state-space", metavar="FILE", help="Write the open loop there: .mat or .nc."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Roots of the vehicle with its control law closed."""
    from beal.control import closed_loop, state_space
    from beal.interop import results
    from beal.interop.files import load, write_result

    if plant and plant.suffix.lower() not in STATE_SPACE:
        known = " or ".join(STATE_SPACE)
        raise ModelError(f"--state-space: must end with {known}, found {plant.suffix or 'no ending'}", str(plant))
    vehicle = load(model)
    with new_result(output) as write:
        found = closed_loop(vehicle, thrust, modes)
        write(_columns(found), lambda: results.closed_loop(found))
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
                "error_estimate": found.error_estimate,
                "units": vehicle.units,
                "file": str(output) if output else None,
                "state_space": str(plant) if plant else None,
            }
        )
        return
    _show(vehicle, found)
    for what, path in (("roots", output), ("state space", plant)):
        if path:
            note(f"{what} written to {path}")


def _least(found: "ClosedLoop") -> dict[str, Any]:
    root = found.least_damped
    return {
        "root": [root.real, root.imag],
        "angular_frequency": abs(root.imag),
        "damping_ratio": -root.real / abs(root),
    }


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
