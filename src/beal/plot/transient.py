"""Transient growth of the energy, and the pseudospectra that explain it."""

from typing import TYPE_CHECKING, Any

import numpy as np

from beal.motion import TransientGrowth
from beal.plot.histories import TIME
from beal.plot.style import BLUE, GREY, VERMILION, axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS = 201  # of the grid of the pseudospectra, along each axis
MODES = 2  # that they show
LEVELS = np.arange(-2.0, 0.6, 0.25)  # of the perturbation, decades of the lowest frequency


def transient_growth(
    result: TransientGrowth, ax: "Axes | None" = None, nondimensional: bool = True, **line: Any
) -> "Axes":
    """Draw the largest growth of energy over time, with the bounds of its supremum.

    Parameters
    ----------
    result : TransientGrowth
    ax : Axes, optional
    nondimensional : bool
        Whether the label of the time is that of the non-dimensional form or carries SI units.
    **line
        For matplotlib's ``plot``.

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        look: dict[str, Any] = {"color": BLUE, "linewidth": 1.0} | line
        ax.semilogy(result.time, result.history, **look)
        ax.plot([result.instant], [result.growth], marker="o", color=VERMILION, markersize=5, linestyle="none")
        for bound, name in ((result.lower_bound, "Kreiss"), (result.upper_bound, "eigenvectors")):
            ax.axhline(bound, color=GREY, linewidth=0.8, linestyle="--")
            ax.annotate(name, (0.0, bound), (2, 1), textcoords="offset points", va="bottom", color=GREY, fontsize=8)
        ax.set_xlabel(TIME if nondimensional else "time (s)")
        ax.set_ylabel("growth of energy $G(t)$")
        ax.margins(x=0.0)
        return ax


def pseudospectrum(result: TransientGrowth, ax: "Axes | None" = None, nondimensional: bool = True) -> "Axes":
    """Draw the pseudospectra of the lowest modes: contours of the perturbation that would put a root there.

    Parameters
    ----------
    result : TransientGrowth
    ax : Axes, optional
    nondimensional : bool

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        roots = np.linalg.eigvals(result.matrix)
        roots = roots[roots.imag >= 0]
        roots = roots[np.argsort(abs(roots))][:MODES]
        lowest, top = abs(roots[0]), 1.4 * abs(roots[-1])
        real, imag = np.linspace(-top / 3, top / 3, POINTS), np.linspace(0.0, top, POINTS)
        distance = -np.log10(lowest * result.resolvent_norm(real + 1j * imag[:, None]))
        lines = ax.contour(real, imag, distance, levels=LEVELS, cmap="viridis", linewidths=0.9)
        ax.clabel(lines, fontsize=7, fmt="%.2g")
        ax.plot(roots.real, roots.imag, marker="o", color=VERMILION, markersize=4, linestyle="none")
        ax.axvline(0.0, color=GREY, linewidth=0.6)
        unit = r"of $s\,(mL^4/EI)^{1/2}$" if nondimensional else "(1/s)"
        ax.set_xlabel(f"real part {unit}")
        ax.set_ylabel(f"imaginary part {unit}")
        ax.set_title(r"$\log_{10}$ of the smallest perturbation$\,/\,|s_1|$")
        return ax
