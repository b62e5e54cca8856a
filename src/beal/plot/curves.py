"""Frequencies and growth rates over thrust, and the paths of the roots, with the points where stability changes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from beal.plot.style import BLACK, CYCLE, GREY, VERMILION, axes, style, thrust_axis, thrust_label, thrust_unit
from beal.stability.complete import Event
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BEYOND = 1e-6  # relative distance from the critical thrust from which on an event is another one
LEAST = 0.05  # half width of a root locus whose roots stay on the imaginary axis, over its height
MARKERS = {"flutter": "o", "divergence": "D"}
UNSTABLE: dict[str, Any] = {"color": VERMILION, "alpha": 0.08, "linewidth": 0.0, "zorder": 0}
WORD: dict[str, Any] = {"color": GREY, "fontsize": "small", "fontstyle": "italic"}


def thrust_curve(
    curve: ThrustCurve,
    ax: "Axes | None" = None,
    critical: CriticalThrust | None = None,
    relative: bool = False,
    nondimensional: bool = True,
    events: Sequence[Event] = (),
) -> "Axes":
    """Draw frequencies over thrust; unstable stretches are dotted, the critical thrust is marked by its kind.

    Parameters
    ----------
    curve : ThrustCurve
    ax : Axes, optional
    critical : CriticalThrust, optional
        Of the same vehicle, to be marked: a disc where modes meet or begin to grow, a diamond where a frequency
        vanishes. Of a vehicle that tumbles, that of its elastic modes.
    relative : bool
        Whether frequencies are divided by the first one at zero thrust, as Irani & Kavianipour (2009) do.
    nondimensional : bool
        Whether the labels speak of P L²/EI or of N and rad/s.
    events : sequence of Event
        Of the same vehicle, from `beal.critical_events`: those beyond the critical thrust are marked too, smaller.

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        scale = curve.angular_frequency[0].min() if relative else 1.0
        for number, (omega, unstable) in enumerate(zip(curve.angular_frequency.T, curve.unstable.T, strict=True)):
            color = CYCLE[number % len(CYCLE)]
            near = np.convolve(unstable, [1, 1, 1])[1:-1] > 0  # the points beside it too, so that no gap is left
            ax.plot(curve.thrust, np.where(unstable, np.nan, omega / scale), color=color, label=f"mode {number + 1}")
            ax.plot(
                curve.thrust, np.where(near, omega / scale, np.nan), color=color, linestyle=":", linewidth=1.2, zorder=3
            )
            start = curve.thrust[0], omega[0] / scale
            ax.annotate(str(number + 1), start, (4, 3), textcoords="offset points", color=color, fontweight="bold")
        for change in _changes(critical, events):
            if change.first:
                ax.axvline(change.thrust, color=GREY, linewidth=0.8, linestyle="--", zorder=0)
            _mark(ax, change, (change.thrust, change.omega / scale), nondimensional)
        ax.set_ylim(0.0, 1.07 * curve.angular_frequency.max() / scale)
        unit = r"frequency $\omega\sqrt{mL^4/EI}$" if nondimensional else r"frequency $\omega$ (rad/s)"
        ax.set_ylabel(r"frequency $\omega/\omega_1(P=0)$" if relative else unit)
        thrust_axis(ax, curve.thrust, nondimensional)
        return ax


def growth_rates(
    curve: ThrustCurve,
    ax: "Axes | None" = None,
    critical: CriticalThrust | None = None,
    nondimensional: bool = True,
) -> "Axes":
    """Draw growth rates over thrust; above zero, where the ground is tinted, the motion grows.

    Parameters
    ----------
    curve : ThrustCurve
    ax : Axes, optional
    critical : CriticalThrust, optional
        Of the same vehicle, to be marked.
    nondimensional : bool
        Whether the labels speak of P L²/EI or of N and 1/s.

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        for number, growth in enumerate(curve.growth_rate.T):
            ax.plot(curve.thrust, growth, color=CYCLE[number % len(CYCLE)], label=f"mode {number + 1}")
        for change in _changes(critical):
            ax.axvline(change.thrust, color=GREY, linewidth=0.8, linestyle="--", zorder=0)
            _mark(ax, change, (change.thrust, 0.0), nondimensional)
        ax.axhline(0.0, color=BLACK, linewidth=0.8)
        limits = ax.get_ylim()
        ax.axhspan(0.0, max(map(abs, limits)), **UNSTABLE)
        ax.set_ylim(limits)
        ax.annotate("unstable", (curve.thrust[0], 0.0), (4, 3), textcoords="offset points", **WORD)
        ax.set_ylabel(r"growth rate $\sigma\sqrt{mL^4/EI}$" if nondimensional else r"growth rate $\sigma$ (1/s)")
        thrust_axis(ax, curve.thrust, nondimensional)
        return ax


def root_locus(
    curve: ThrustCurve,
    ax: "Axes | None" = None,
    critical: CriticalThrust | None = None,
    nondimensional: bool = True,
) -> "Axes":
    """Draw the paths of the roots s = σ + iω in the complex plane, coloured by the thrust, the unstable half tinted.

    Each path leads from a ring at the first thrust to a square at the last. Only roots with ω >= 0 are drawn; their
    conjugates mirror them.

    Parameters
    ----------
    curve : ThrustCurve
    ax : Axes, optional
    critical : CriticalThrust, optional
        Of the same vehicle; where its root crosses the imaginary axis is marked with the thrust.
    nondimensional : bool
        Whether the labels speak of P L²/EI or of N and rad/s.

    Returns
    -------
    Axes
        With a colour bar for the thrust.

    Examples
    --------
    >>> from beal.stability.curve import thrust_curve
    >>> from beal.vehicle.catalog import beck
    >>> from matplotlib.figure import Figure
    >>> ax = root_locus(thrust_curve(beck(), to=24.0, points=25, modes=2), Figure().subplots())
    >>> bool(sum(ax.get_xlim()) == 0.0)
    True
    """
    with style():
        ax = axes(ax)
        factor, _ = thrust_unit(curve.thrust[-1], nondimensional)
        color = {"cmap": "viridis", "norm": Normalize(curve.thrust[0] / factor, curve.thrust[-1] / factor)}
        for points in np.stack((curve.growth_rate, curve.angular_frequency), axis=-1).swapaxes(0, 1):
            pieces = np.stack((points[:-1], points[1:]), axis=1)
            path = LineCollection(list(pieces), linewidths=2.0, capstyle="round", zorder=3, **color)
            path.set_array((curve.thrust[1:] + curve.thrust[:-1]) / 2 / factor)
            ax.add_collection(path, autolim=False)
            for marker, end in (("o", points[0]), ("s", points[-1])):
                ax.plot(*end[:, None], marker, color=BLACK, markersize=4.0, markerfacecolor="white", zorder=4)
        for change in _changes(critical):
            _mark(ax, change, (0.0, change.omega), nondimensional)
            ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.0)  # paths leave no room inside
        top = 1.08 * curve.angular_frequency.max()
        reach = max(1.15 * abs(curve.growth_rate).max(), LEAST * top)
        ax.axvspan(0.0, reach, **UNSTABLE)
        ax.axvline(0.0, color=BLACK, linewidth=0.8, zorder=1)
        ax.text(0.98, 0.98, "unstable", transform=ax.transAxes, ha="right", va="top", **WORD)
        ax.set(xlim=(-reach, reach), ylim=(0.0, top))
        ax.set_xlabel(r"real part $\sigma\sqrt{mL^4/EI}$" if nondimensional else r"real part $\sigma$ (1/s)")
        ax.set_ylabel(
            r"imaginary part $\omega\sqrt{mL^4/EI}$" if nondimensional else r"imaginary part $\omega$ (rad/s)"
        )
        ax.figure.colorbar(path, ax=ax, label=thrust_label(curve.thrust[-1], nondimensional))
        return ax


@dataclass(frozen=True)
class _Change:
    """A thrust at which the stability changes, and whether it is the critical one."""

    thrust: float
    omega: float
    kind: Literal["flutter", "divergence"]
    modes: tuple[int, int]
    first: bool

    @property
    def name(self) -> str:
        """The kind and its modes: two that meet, or one that diverges or, damped, begins to grow."""
        names = [str(mode) if mode else "rigid body" for mode in sorted(set(self.modes))]
        return f"{self.kind} " + "\N{EN DASH}".join(names)


def _changes(critical: CriticalThrust | None, events: Sequence[Event] = ()) -> Iterator[_Change]:
    """The critical thrust, and the events beyond it."""
    found = critical.elastic or critical if critical else None
    first = 0.0
    if found and found.critical_thrust is not None and found.kind != "stable":
        first = found.critical_thrust * (1 + BEYOND)
        yield _Change(found.critical_thrust, found.angular_frequency or 0.0, found.kind, found.modes or (0, 0), True)
    for event in events:
        if event.thrust > first:
            yield _Change(event.thrust, math.sqrt(max(event.W, 0.0)), event.kind, event.modes, False)


def _mark(ax: "Axes", change: _Change, at: tuple[float, float], nondimensional: bool) -> None:
    """A point where the stability changes, told in the legend; larger where it is the first."""
    color, size = (BLACK, 6.5) if change.first else (GREY, 4.5)
    look: dict[str, Any] = {"markersize": size, "markeredgewidth": size / 5, "markerfacecolor": "white", "zorder": 5}
    factor, unit = thrust_unit(change.thrust, nondimensional)
    value = f"{change.thrust / factor:#.5g}".rstrip(".") if change.thrust else "0"
    label = f"{change.name}, P = {value} {unit}".rstrip()
    ax.plot([at[0]], [at[1]], MARKERS[change.kind], color=color, clip_on=False, label=label, **look)
    marks = [pair for pair in zip(*ax.get_legend_handles_labels(), strict=True) if "P =" in pair[1]]
    ax.legend(*zip(*marks, strict=True), handletextpad=0.2, frameon=True, framealpha=0.9, edgecolor="none")
