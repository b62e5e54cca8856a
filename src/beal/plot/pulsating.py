"""Instability charts of a pulsating thrust: tongues of growth that start from the resonances."""

from typing import TYPE_CHECKING

import numpy as np

from beal.plot.style import GREY, axes, style, thrust_unit
from beal.study.pulsating import chart_resonances

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import Dataset

CROWDED = 0.035  # share of the width below which the name of a resonance would cover the one before


def floquet_chart(chart: "Dataset", ax: "Axes | None" = None) -> "Axes":
    """Draw how fast a vehicle grows under a thrust that pulsates, over frequency and amplitude.

    White is stable, colour the growth rate. Each resonance is marked where its tongue starts, those of first order by a
    full line; names that would cover each other are left out, of second order first.

    Parameters
    ----------
    chart : Dataset
        From `beal.floquet_chart`, of more than one frequency and amplitude.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        frequency, amplitude = chart.angular_frequency.values, chart.amplitude.values
        nondimensional = chart.attrs["units"] != "SI"
        factor, unit = thrust_unit(float(amplitude[-1]), nondimensional)
        growth = chart.growth_rate.where(~chart.stable).values
        largest = float(np.nanmax(growth, initial=0.0)) or 1.0
        mesh = ax.pcolormesh(
            frequency, amplitude / factor, growth.T, cmap="viridis_r", vmin=0.0, vmax=largest, rasterized=True, zorder=0
        )
        _mark(ax, chart)
        ax.set_xlim(frequency[0], frequency[-1])
        ax.set_ylim(amplitude[0] / factor, amplitude[-1] / factor)
        rate = "" if nondimensional else " (1/s)"
        ax.set_xlabel("angular frequency $\\Omega$" + ("" if nondimensional else " (rad/s)"))
        ax.set_ylabel("amplitude $P_1 L^2/EI$" if nondimensional else f"amplitude $P_1$ ({unit})")
        ax.figure.colorbar(mesh, ax=ax, label=f"growth rate{rate}")
        return ax


def _mark(ax: "Axes", chart: "Dataset") -> None:
    """Names above the axes, at the frequencies of the resonances."""
    width = float(chart.angular_frequency[-1] - chart.angular_frequency[0])
    named: list[float] = []
    orders = chart.resonance_order.values.tolist()
    for order, (name, omega) in sorted(zip(orders, chart_resonances(chart), strict=True), key=lambda item: item[0]):
        ax.axvline(omega, ymax=1.0 if order == 1 else 0.06, color=GREY, linewidth=0.6, zorder=1)
        if all(abs(omega - other) > CROWDED * width for other in named):
            named.append(omega)
            text = name.replace("w", r"\omega_")
            ax.annotate(
                f"${text}$",
                (omega, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(0, 3),
                textcoords="offset points",
                rotation=90,
                ha="center",
                va="bottom",
                fontsize=6.5,
            )
