"""Time histories at a sensor and the trajectory that they trace in the phase plane."""

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from beal.motion import AmplitudeMap, MotionPart, Quantity, Response
from beal.motion import amplitude_spectrum as spectrum
from beal.motion import envelope as amplitudes
from beal.plot.style import BLUE, GREY, VERMILION, axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FAINT, AUDIBLE = 1e-12, 1e-4  # of the largest amplitude: what is drawn at all, and up to where the axis reaches
FEW = 10  # points of an envelope up to which each is marked, since one alone makes no line
TIME = r"time $\bar t = t\,(EI/mL^4)^{1/2}$"


def response(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    quantity: Quantity | MotionPart = "displacement",
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
        Or a part of the motion, ``rigid_displacement``, ``elastic_displacement``, ``rigid_slope`` or ``elastic_slope``.
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


def envelope(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    quantity: Literal["displacement", "rate", "slope"] = "displacement",
    nondimensional: bool = True,
) -> "Axes":
    """Draw the amplitude of one quantity at a sensor over time.

    Parameters
    ----------
    result : Response
    ax : Axes, optional
    sensor : str, optional
        Name; by default the first.
    quantity : {"displacement", "rate", "slope"}
    nondimensional : bool

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        time, amplitude = amplitudes(result, sensor or result.sensors[0], quantity)
        ax.plot(time, amplitude, color=VERMILION, linewidth=1.2, marker="o" if len(time) <= FEW else "", markersize=4)
        if not len(time):
            ax.text(0.5, 0.5, "turns less than twice", transform=ax.transAxes, ha="center", va="center")
        ax.set_xlabel(TIME if nondimensional else "time (s)")
        ax.set_ylabel(f"amplitude,\n{_label(quantity, nondimensional)}")
        ax.set_xlim(result.time[0], result.time[-1])
        ax.set_ylim(bottom=0.0)
        _powers(ax, "y")
        return ax


def amplitude_spectrum(
    result: Response,
    ax: "Axes | None" = None,
    sensor: str | None = None,
    quantity: Quantity = "displacement",
    nondimensional: bool = True,
) -> "Axes":
    """Draw the amplitude spectrum of one quantity at a sensor, as far as its lines reach.

    Parameters
    ----------
    result : Response
    ax : Axes, optional
    sensor : str, optional
        Name; by default the first.
    quantity : {"displacement", "rate", "acceleration", "slope", "slope_rate"}
    nondimensional : bool

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        omega, amplitude = spectrum(result, sensor or result.sensors[0], quantity)
        largest = float(amplitude.max()) or 1.0
        ax.semilogy(omega, np.maximum(amplitude, FAINT * largest), color=BLUE, linewidth=1.0)
        loud = omega[amplitude > AUDIBLE * largest]
        ax.set_xlim(0.0, min(1.3 * float(loud.max(initial=0.0)) or omega[-1], omega[-1]))
        ax.set_ylim(AUDIBLE / 10 * largest, 2 * largest)
        unit = r"angular frequency $\omega\sqrt{mL^4/EI}$" if nondimensional else "angular frequency ω (rad/s)"
        ax.set_xlabel(unit)
        ax.set_ylabel(f"amplitude,\n{_label(quantity, nondimensional)}")
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
        "rigid_displacement": "of rigid body $y/L$",
        "elastic_displacement": "elastic $y/L$",
        "rigid_slope": "of rigid body $y'$",
        "elastic_slope": "elastic $y'$",
    }
    si = {
        "displacement": "displacement (m)",
        "rate": "rate (m/s)",
        "acceleration": "acceleration (m/s²)",
        "slope": "slope (rad)",
        "slope_rate": "slope rate (rad/s)",
        "rigid_displacement": "of rigid body (m)",
        "elastic_displacement": "elastic (m)",
        "rigid_slope": "of rigid body (rad)",
        "elastic_slope": "elastic (rad)",
    }
    return (dimensionless if nondimensional else si)[quantity]
