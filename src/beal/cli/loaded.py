"""The vehicle that a command is about, and what of it the command leaves out."""

from pathlib import Path
from typing import TYPE_CHECKING

from beal.cli.output import note

if TYPE_CHECKING:
    from beal.vehicle.vehicle import Vehicle


def vehicle_of(model: Path, over_time: bool = False) -> "Vehicle":
    """The vehicle of a model file.

    Parameters
    ----------
    model : Path
    over_time : bool
        Whether the command follows the thrust's signal.

    Raises
    ------
    ModelError
        With every problem, each with its path.
    """
    from beal.interop.files import load

    vehicle = load(model)
    note_omissions(vehicle, over_time)
    return vehicle


def note_omissions(vehicle: "Vehicle", over_time: bool = False) -> None:
    """Say on standard error what of a vehicle does not count here."""
    if vehicle.control:
        note("the control law is left out here; beal control closes the loop")
    if vehicle.thrust.signal and not over_time:
        note("the signal of the thrust is left out here; beal response follows it")
