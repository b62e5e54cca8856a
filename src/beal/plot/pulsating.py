"""Instability charts of a pulsating thrust: tongues of growth that start from the resonances."""

from typing import TYPE_CHECKING, Any

import numpy as np

from beal.plot.style import BLUE, GREY, VERMILION, axes, style, thrust_unit
from beal.stability.floquet import Floquet
from beal.study.pulsating import chart_resonances

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import Dataset

MARGIN = 1 + 1e-9  # modulus from which on a multiplier of an unstable vehicle is drawn as one that grows
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


def multipliers(found: Floquet, ax: "Axes | None" = None) -> "Axes":
    """Draw the Floquet multipliers of one pulsation beside the unit circle, those outside it in another colour.

    Parameters
    ----------
    found : Floquet
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        turn = np.linspace(0.0, 2 * np.pi, 361)
        ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=0.8, zorder=1)
        outside = np.zeros(len(found.multipliers), dtype=bool) if found.stable else np.abs(found.multipliers) > MARGIN
        groups = (("o", BLUE, ~outside, "on or inside"), ("D", VERMILION, outside, "outside: grows"))
        for mark, color, these, name in groups:
            points = found.multipliers[these]
            if len(points):
                look: dict[str, Any] = {
                    "markerfacecolor": "white",
                    "markeredgewidth": 1.4,
                    "linestyle": "none",
                    "zorder": 3,
                }
                ax.plot(points.real, points.imag, mark, color=color, markersize=6, label=name, **look)
        reach = 1.15 * max(1.0, found.largest_modulus)
        ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        ax.set_xlabel("real part of the multipliers")
        ax.set_ylabel("imaginary part")
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.2)
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
