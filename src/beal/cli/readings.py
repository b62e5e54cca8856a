"""What ``beal response`` reads off its motion: histories, envelopes or spectra, as columns, JSON and a table."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from beal.cli.figures import DRAWN
from beal.errors import ModelError
from beal.report import Table

if TYPE_CHECKING:
    from beal.motion import Part, Quantity, Response

READINGS = ("history", "envelope", "spectrum")
SHOWN: "dict[str, tuple[Quantity | Part, ...]]" = {
    "history": DRAWN,
    "envelope": ("displacement",),
    "spectrum": ("displacement", "slope"),
}
IN_FLIGHT: "dict[str, tuple[Quantity | Part, ...]]" = {
    "history": ("displacement", "elastic_displacement", "rate", "slope"),
    "spectrum": ("elastic_displacement", "elastic_slope"),
}


@dataclass(frozen=True)
class Readings:
    """Columns of a file, an entry of a JSON object, and tables beside the largest values."""

    columns: dict[str, Any]
    entry: dict[str, Any] = field(default_factory=dict)
    tables: Sequence[Table] = ()


def shown(show: str, names: Sequence[str], flies: bool) -> "list[Quantity | Part]":
    """The quantities that are read, in their order."""
    from beal.motion import PARTS, QUANTITIES
    from beal.motion.spectra import RATE_OF

    if show not in READINGS:
        raise ModelError(f"--show: must be one of {', '.join(READINGS)}, found {show!r}")
    if show == "envelope" and flies:
        raise ModelError("--show envelope: a vehicle that flies drifts away; give --elastic")
    known: Sequence[Any] = tuple(RATE_OF) if show == "envelope" else (*QUANTITIES, *PARTS)
    if unknown := set(names) - set(known):
        raise ModelError(f"--quantity: must be one of {', '.join(known)}, found {min(unknown)!r}")
    return [name for name in known if name in names] or [*(IN_FLIGHT if flies else SHOWN)[show]]


def readings(found: "Response", show: str, quantities: "Sequence[Quantity | Part]") -> Readings:
    """What the motion shows at its sensors."""
    read = {"history": _histories, "envelope": _envelopes, "spectrum": _spectra}[show]
    return read(found, quantities)


def _histories(found: "Response", quantities: "Sequence[Quantity | Part]") -> Readings:
    from beal.motion import PARTS, QUANTITIES

    names = [(sensor, what) for sensor in found.sensors for what in (*QUANTITIES, *PARTS)]
    return Readings({"time": found.time} | {f"{sensor}_{what}": found.history(sensor, what) for sensor, what in names})


def _envelopes(found: "Response", quantities: "Sequence[Any]") -> Readings:
    """A row for each sensor, quantity and time, because each turns at times of its own."""
    import numpy as np

    from beal.motion import envelope

    parts, rows = [], []
    entry: dict[str, dict[str, Any]] = {}
    for sensor in found.sensors:
        entry[sensor] = {}
        for what in quantities:
            time, amplitude = envelope(found, sensor, what)
            entry[sensor][what] = {"time": time, "amplitude": amplitude}
            parts.append((np.full(len(time), sensor), np.full(len(time), what), time, amplitude))
            ends = [amplitude[0].item(), amplitude[-1].item(), amplitude.max().item()] if len(time) else [None] * 3
            rows.append([sensor, what.replace("_", " "), *ends])
    names = ("sensor", "quantity", "time", "amplitude")
    columns = {name: np.concatenate(column) for name, column in zip(names, zip(*parts, strict=True), strict=True)}
    table = Table(["amplitude at", "of", "first", "last", "largest"], rows)
    return Readings(columns, {"envelope": entry}, [table])


def _spectra(found: "Response", quantities: "Sequence[Quantity | Part]") -> Readings:
    from beal.motion import amplitude_spectrum

    columns: dict[str, Any] = {}
    entry: dict[str, Any] = {}
    rows = []
    for sensor in found.sensors:
        entry[sensor] = {}
        for what in quantities:
            frequency, amplitude = amplitude_spectrum(found, sensor, what)
            entry["angular_frequency"] = columns["angular_frequency"] = frequency
            entry[sensor][what] = columns[f"{sensor}_{what}"] = amplitude
            peak = amplitude.argmax()
            rows.append([sensor, what.replace("_", " "), frequency[peak].item(), amplitude[peak].item()])
    table = Table(["strongest line at", "of", "angular frequency", "amplitude"], rows)
    return Readings(
        columns, {"spectrum": {"angular_frequency": entry.pop("angular_frequency"), "sensors": entry}}, [table]
    )
