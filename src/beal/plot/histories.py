"""Time histories at a sensor and the trajectory that they trace in the phase plane."""

from typing import TYPE_CHECKING, Any, Literal

from beal.plot.style import BLUE, GREY, VERMILION, axes
from beal.response import Response

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def response(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    quantity: Literal["displacement", "rate", "slope"] = "displacement",
    nondimensional: bool = True,
    **line: Any,
) -> "Axes":
    """Draw one quantity at a sensor over time.

    Parameters
    ----------
    result : Response
    ax : Axes, optional
    sensor : str, optional
        Name; by default the first.
    quantity : {"displacement", "rate", "slope"}
    nondimensional : bool
        Whether the labels are those of the non-dimensional form or carry SI units.
    **line
        For matplotlib's ``plot``.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    row = result.index(sensor or result.sensors[0])
    ax.axhline(0.0, color=GREY, linewidth=0.6)
    ax.plot(result.time, getattr(result, quantity)[row], **{"color": BLUE, "linewidth": 1.0} | line)
    ax.set_xlabel("time t √(EI/mL⁴)" if nondimensional else "time (s)")
    ax.set_ylabel(_label(quantity, nondimensional))
    ax.margins(x=0.0)
    return ax


def trajectory(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    nondimensional: bool = True,
    **line: Any,
) -> "Axes":
    """Draw rate over displacement at a sensor; a disc marks the start.

    Parameters
    ----------
    result : Response
    ax : Axes, optional
    sensor : str, optional
        Name; by default the first.
    nondimensional : bool
    **line
        For matplotlib's ``plot``.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    displacement, rate = result.trajectory(sensor or result.sensors[0])
    ax.plot(displacement, rate, **{"color": BLUE, "linewidth": 0.8} | line)
    ax.plot(displacement[:1], rate[:1], marker="o", color=VERMILION, markersize=5, linestyle="none", label="start")
    ax.set_xlabel(_label("displacement", nondimensional))
    ax.set_ylabel(_label("rate", nondimensional))
    return ax


def _label(quantity: str, nondimensional: bool) -> str:
    dimensionless = {"displacement": "displacement y/L", "rate": "rate d(y/L)/dt̄", "slope": "slope y′ (rad)"}
    si = {"displacement": "displacement (m)", "rate": "rate (m/s)", "slope": "slope (rad)"}
    return (dimensionless if nondimensional else si)[quantity]
