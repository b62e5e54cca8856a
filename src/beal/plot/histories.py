"""Time histories at a sensor and the trajectory that they trace in the phase plane."""

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from beal.motion import AmplitudeMap, Quantity, Response
from beal.plot.style import BLUE, GREY, VERMILION, axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TIME = r"time $\bar t = t\,(EI/mL^4)^{1/2}$"


def response(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    quantity: Quantity = "displacement",
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
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}
    nondimensional : bool
        Whether the labels are those of the non-dimensional form or carry SI units.
    **line
        For matplotlib's ``plot``.

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        history = result.history(sensor or result.sensors[0], quantity)
        ax.axhline(0.0, color=GREY, linewidth=0.6)
        look: dict[str, Any] = {"color": BLUE, "linewidth": 1.0} | line
        ax.plot(result.time, history, **look)
        ax.set_xlabel(TIME if nondimensional else "time (s)")
        ax.set_ylabel(_label(quantity, nondimensional))
        ax.margins(x=0.0)
        _powers(ax, "y")
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
    with style():
        ax = axes(ax)
        displacement, rate = result.trajectory(sensor or result.sensors[0])
        look: dict[str, Any] = {"color": BLUE, "linewidth": 0.8} | line
        ax.plot(displacement, rate, **look)
        ax.plot(displacement[:1], rate[:1], marker="o", color=VERMILION, markersize=5, linestyle="none", label="start")
        ax.set_xlabel(_label("displacement", nondimensional))
        ax.set_ylabel(_label("rate", nondimensional))
        _powers(ax, "both")
        return ax


def amplitude_map(result: AmplitudeMap, ax: "Axes | None" = None, nondimensional: bool = True) -> "Axes":
    """Draw the largest motion at a sensor over thrust and force, its colour logarithmic.

    Parameters
    ----------
    result : AmplitudeMap
    ax : Axes, optional
    nondimensional : bool

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        size = np.ma.masked_invalid(result.amplitude.T)
        mesh = ax.pcolormesh(result.thrust, result.factor, size, norm="log", cmap="viridis", rasterized=True)
        bar = ax.figure.colorbar(mesh, ax=ax)
        bar.set_label(f"largest {_label(result.quantity, nondimensional)} at {result.sensor}")
        ax.set_xlabel("thrust $P L^2/EI$" if nondimensional else "thrust P (N)")
        ax.set_ylabel("multiple of the forces")
        return ax


def _powers(ax: "Axes", axis: Literal["y", "both"]) -> None:
    ax.ticklabel_format(axis=axis, style="sci", scilimits=(-2, 3), useMathText=True)


def _label(quantity: str, nondimensional: bool) -> str:
    dimensionless = {
        "displacement": "displacement $y/L$",
        "rate": r"rate $\mathrm{d}(y/L)/\mathrm{d}\bar t$",
        "acceleration": r"acceleration $\mathrm{d}^2(y/L)/\mathrm{d}\bar t^2$",
        "slope": "slope $y'$ (rad)",
        "slope_rate": r"slope rate $\mathrm{d}y'/\mathrm{d}\bar t$",
    }
    si = {
        "displacement": "displacement (m)",
        "rate": "rate (m/s)",
        "acceleration": "acceleration (m/s²)",
        "slope": "slope (rad)",
        "slope_rate": "slope rate (rad/s)",
    }
    return (dimensionless if nondimensional else si)[quantity]
