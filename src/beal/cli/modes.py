"""``beal modes``: frequencies of the loaded or unloaded vehicle, converged."""

import math
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.options import AsJson, Formulation, Model
from beal.cli.output import digits, emit, show_table
from beal.errors import ConvergenceError, ModelError

if TYPE_CHECKING:
    from beal.stability.spectrum import Spectrum
    from beal.vehicle.vehicle import Vehicle

ORDERS = (10, 14, 20, 28, 40, 56, 80, 112)
MOST_MODES = 40
GOOD, POOR = 1e-9, 1e-4  # relative change from one order to the next at which to stop, and above which to give up


def modes(
    model: Model,
    count: Annotated[int, typer.Option("--count", metavar="N", help="Number of elastic modes.")] = 6,
    thrust: Annotated[float | None, typer.Option("--thrust", metavar="P", help="Thrust; 0 unless given.")] = None,
    loaded: Annotated[bool, typer.Option("--loaded", help="Under the model's nominal thrust.")] = False,
    formulation: Formulation = "objective",
    as_json: AsJson = False,
) -> None:
    """Frequencies and growth rates of the lowest elastic modes at a thrust."""
    from beal.vehicle.file import load

    vehicle = load(model)
    found, error = _converged(vehicle, _thrust(vehicle, thrust, loaded), count, formulation)
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


def _thrust(vehicle: "Vehicle", thrust: float | None, loaded: bool) -> float:
    if not loaded:
        return thrust or 0.0
    if thrust is not None:
        raise ModelError("--thrust: is given beside --loaded, which takes thrust.nominal; give one of them")
    if vehicle.thrust.nominal is None:
        raise ModelError("thrust.nominal: is needed by --loaded and missing in the model; give --thrust instead")
    return vehicle.thrust.nominal


def _converged(vehicle: "Vehicle", thrust: float, count: int, formulation: str) -> "tuple[Spectrum, Any]":
    """The modes, and how much each frequency changed in the last refinement (None for a few modes by definition)."""
    import numpy as np

    from beal.discretisation.build import RITZ, discretise
    from beal.stability.spectrum import spectrum

    if formulation in RITZ:
        return spectrum(discretise(vehicle, formulation), thrust, count), None  # type: ignore[arg-type]
    if not 1 <= count <= MOST_MODES:
        raise ModelError(f"--count: must lie between 1 and {MOST_MODES}, found {count}")
    before = None
    best: tuple[float, Spectrum, Any] | None = None
    for order in ORDERS:
        operators = discretise(vehicle, formulation, order=order)  # type: ignore[arg-type]
        if len(operators.M) - operators.rigid < count:
            continue
        found = spectrum(operators, thrust, count)
        omega: Any = np.sort(found.angular_frequency)
        if before is not None:
            error = np.abs(omega - before)
            change = float(np.max(error / np.maximum(omega, vehicle.scales.angular_frequency)))
            if best is None or change < best[0]:
                best = change, found, error
            if change < GOOD:
                break
        before = omega
    if best is None or best[0] > POOR:
        raise ConvergenceError(f"modes: {count} frequencies do not converge; ask for fewer with --count")
    return best[1:]
