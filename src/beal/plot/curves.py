"""Frequencies over thrust, with the points where modes meet or vanish."""

from typing import TYPE_CHECKING

import numpy as np

from beal.plot.style import BLACK, CYCLE, GREY, axes
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

GROWING = 1e-6  # growth rate over the first frequency above which a root is drawn as unstable


def thrust_curve(
    curve: ThrustCurve,
    ax: "Axes | None" = None,
    critical: CriticalThrust | None = None,
    relative: bool = False,
    nondimensional: bool = True,
) -> "Axes":
    """Draw frequencies over thrust; unstable stretches are dotted, the critical thrust is marked by its kind.

    Parameters
    ----------
    curve : ThrustCurve
    ax : Axes, optional
    critical : CriticalThrust, optional
        Of the same vehicle, to be marked: a disc where two modes meet, a diamond where a frequency vanishes.
    relative : bool
        Whether frequencies are divided by the first one at zero thrust, as Irani & Kavianipour (2009) do.
    nondimensional : bool
        Whether the labels speak of P L²/EI or of N and rad/s.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    first = curve.angular_frequency[0].min()
    scale = first if relative else 1.0
    for index, (omega, growth) in enumerate(zip(curve.angular_frequency.T, curve.growth_rate.T, strict=True)):
        color = CYCLE[index % len(CYCLE)]
        unstable = abs(growth) > GROWING * first
        ax.plot(curve.thrust, np.where(unstable, np.nan, omega / scale), color=color, label=f"mode {index + 1}")
        ax.plot(curve.thrust, np.where(unstable, omega / scale, np.nan), color=color, linestyle=":", linewidth=1.2)
    if critical is not None and critical.critical_thrust is not None:
        _mark(ax, critical, scale)
    ax.set_ylim(bottom=0.0)
    ax.set_xlim(curve.thrust[0], curve.thrust[-1])
    ax.set_xlabel("thrust $P L^2/EI$" if nondimensional else "thrust P (N)")
    unit = r"frequency $\omega\sqrt{mL^4/EI}$" if nondimensional else "frequency ω (rad/s)"
    ax.set_ylabel(r"frequency $\omega/\omega_1(P=0)$" if relative else unit)
    return ax


def _mark(ax: "Axes", critical: CriticalThrust, scale: float) -> None:
    thrust, omega = critical.critical_thrust, critical.angular_frequency
    low, high = critical.modes or (0, 0)
    name = f"flutter {low}\N{EN DASH}{high}" if critical.kind == "flutter" else f"divergence {low}"
    ax.axvline(thrust or 0.0, color=GREY, linewidth=0.8, linestyle="--", zorder=0)
    ax.plot(
        [thrust or 0.0],
        [(omega or 0.0) / scale],
        marker="o" if critical.kind == "flutter" else "D",
        color=BLACK,
        markerfacecolor="white",
        markersize=6.5,
        markeredgewidth=1.4,
        linestyle="none",
        clip_on=False,
        zorder=5,
        label=f"{name}, P = {thrust:.2f}",
    )
