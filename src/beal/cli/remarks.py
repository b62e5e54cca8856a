"""What of a model a command leaves out, said beside its answer."""

from typing import TYPE_CHECKING

from beal.cli.output import note

if TYPE_CHECKING:
    from beal.vehicle.vehicle import Vehicle

LAW = "control: the law is left out, the answer is that of the vehicle without it; beal control counts it"


def remark(vehicle: "Vehicle", quiet: bool) -> list[str]:
    """A sentence for each part of the model that counts in other commands only; said at once unless quiet."""
    notes = [LAW] if vehicle.control else []
    for text in [] if quiet else notes:
        note(text)
    return notes
