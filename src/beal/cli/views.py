"""What is told of a motion at the sensors: histories, their amplitude over time, or over frequency."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from beal.motion import PARTS, QUANTITIES, Response, amplitude_spectrum, envelope
from beal.motion.spectra import RATE_OF

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VIEWS = ("histories", "envelope", "spectrum")
View = tuple[str, Any, dict[str, Any]]  # axis, values along it, of each quantity an array of shape (sensors, k)


def view(found: Response, kind: str) -> View:
    """The motion in one of `VIEWS`."""
    if kind == "envelope":
        rows = {what: [_amplitude(found, sensor, what) for sensor in found.sensors] for what in RATE_OF}
        return "time", found.time, {what: np.array(values) for what, values in rows.items()}
    if kind == "spectrum":
        omega = amplitude_spectrum(found, found.sensors[0])[0]
        lines = {what: [amplitude_spectrum(found, name, what)[1] for name in found.sensors] for what in QUANTITIES}
        return "angular_frequency", omega, {what: np.array(values) for what, values in lines.items()}
    return "time", found.time, {what: getattr(found, what) for what in (*QUANTITIES, *PARTS)}


def columns(found: Response, shown: View) -> dict[str, Any]:
    """The same as columns of a table."""
    axis, along, values = shown
    table = {axis: along}
    for n, name in enumerate(found.sensors):
        table |= {f"{name}_{what}": value[n] for what, value in values.items()}
    return table


def drawing(kind: str) -> "Callable[..., Axes]":
    """The function that draws a quantity in that view."""

    def draw(*given: Any, **options: Any) -> "Axes":
        from beal import plot

        draws = {"histories": plot.response, "envelope": plot.envelope, "spectrum": plot.amplitude_spectrum}
        return draws[kind](*given, **options)

    return draw


def _amplitude(found: Response, sensor: str, quantity: Any) -> Any:
    """Over the times of the motion; nan where it turns less than twice."""
    time, amplitude = envelope(found, sensor, quantity)
    return np.interp(found.time, time, amplitude) if len(time) else np.full_like(found.time, np.nan)
