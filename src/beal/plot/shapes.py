"""Mode shapes along the vehicle, with the jumps at the joints."""

from typing import TYPE_CHECKING

import numpy as np

from beal.discretisation.operators import Operators
from beal.plot.style import CYCLE, GREY, axes
from beal.stability.spectrum import Spectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STATIONS = 161  # per stage
DASHES = ("-", "--", "-.", ":")


def mode_shapes(spectrum: Spectrum, operators: Operators, ax: "Axes | None" = None) -> "Axes":
    """Draw the mode shapes of a spectrum, stage by stage, scaled to a largest deflection of 1.

    Parameters
    ----------
    spectrum : Spectrum
    operators : Operators
        Those that the spectrum was computed from.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    ends = operators.vehicle.boundaries
    stages = [np.linspace(front, back, STATIONS) for front, back in zip(ends, ends[1:], strict=False)]
    rows = [np.vstack([operators.shape(x[:-1], side="aft"), operators.shape(x[-1:], side="forward")]) for x in stages]
    nondimensional = operators.vehicle.units == "nondimensional"
    for joint in ends[1:-1]:
        ax.axvline(joint, color=GREY, linewidth=0.8, linestyle=(0, (1, 2)))
    for index, (shape, omega) in enumerate(zip(spectrum.shapes.T, spectrum.angular_frequency, strict=True)):
        deflections = [stage @ shape for stage in rows]
        together = np.concatenate(deflections)
        largest = together[np.argmax(abs(together))]
        sign = np.sign((together[0] / largest).real) or 1.0
        color, dash = CYCLE[index % len(CYCLE)], DASHES[index % len(DASHES)]
        label = f"mode {index + 1}, " + (f"λ = {omega**0.5:.4f}" if nondimensional else f"ω = {omega:.4g} rad/s")
        for x, deflection in zip(stages, deflections, strict=True):
            ax.plot(x, sign * (deflection / largest).real, color=color, linestyle=dash, label=label)
            label = ""
    ax.axhline(0.0, color=GREY, linewidth=0.6)
    ax.set(xlabel="station $x/L$" if nondimensional else "station x (m)", ylabel="deflection (largest = 1)")
    ax.margins(x=0.0)
    return ax
