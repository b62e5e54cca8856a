"""The open loop as Nyquist's and Nichols's plots."""

from typing import TYPE_CHECKING, Any

import numpy as np

from beal.control import Margins, StateSpace
from beal.control.opened import frequencies
from beal.control.state_space import python_control
from beal.plot.style import BLACK, BLUE, GREY, VERMILION, axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, np.dtype[Any]]
REACH = 3.0  # from the origin, of what Nyquist's plot shows
ARROWS = 2.0  # distance from one to the next
DECIBELS = (-40.0, 30.0)
FULL = 360.0
CRITICAL: dict[str, Any] = {"marker": "x", "color": VERMILION, "markersize": 9, "markeredgewidth": 2.2, "zorder": 6}


def nyquist(loop: StateSpace, ax: "Axes | None" = None, margins: Margins | None = None) -> "Axes":
    """Draw the open loop L(iω) in the complex plane around the critical point -1.

    Parameters
    ----------
    loop : StateSpace
        From `beal.open_loop`.
    ax : Axes, optional
    margins : Margins, optional
        Of the same loop, from `beal.stability_margins`: a disc where the phase is 180 degrees, a square where the
        modulus is 1.

    Returns
    -------
    Axes
        Up to three times the critical distance; what lies further out, where hardly damped modes and the rigid body
        reach, is cut off.
    """
    L = _response(loop, frequencies(loop))
    with style():
        ax = axes(ax)
        turn = np.linspace(0.0, 2 * np.pi, 361)
        ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=0.8, linestyle="--", zorder=1)
        ax.axhline(0.0, color=GREY, linewidth=0.6, zorder=0)
        ax.axvline(0.0, color=GREY, linewidth=0.6, zorder=0)
        ax.plot(L.real, L.imag, color=BLUE, label="L(iω), ω > 0", zorder=3)
        ax.plot(L.real, -L.imag, color=BLUE, linewidth=0.8, linestyle=":", label="ω < 0", zorder=2)
        _arrows(ax, L)
        ax.plot([-1.0], [0.0], linestyle="none", label="critical point", **CRITICAL)
        for mark, at, name in _crossed(loop, margins):
            ax.plot(at.real, at.imag, mark, color=BLACK, markersize=4.5, markerfacecolor="white", label=name, zorder=5)
        ax.set(xlim=(-REACH, REACH), ylim=(-REACH, REACH), aspect="equal")
        ax.set_xlabel("Re L")
        ax.set_ylabel("Im L")
        _legend(ax)
        return ax


def nichols(loop: StateSpace, ax: "Axes | None" = None, margins: Margins | None = None) -> "Axes":
    """Draw the modulus of the open loop over its phase, with the closed loop's contours behind.

    Parameters
    ----------
    loop : StateSpace
        From `beal.open_loop`.
    ax : Axes, optional
    margins : Margins, optional
        Of the same loop, to be marked.

    Returns
    -------
    Axes
        Phases from -360 to 0 degrees; a curve that leaves on one side comes back on the other.

    Raises
    ------
    ModelError
        If python-control is not installed.
    """
    control = python_control()
    L = _response(loop, frequencies(loop))
    phase, decibel = _phase(L), _decibel(L)
    jumps = np.abs(np.diff(phase)) > FULL / 2
    with style():
        ax = axes(ax)
        ax.set(xlim=(-FULL, 0.0), ylim=DECIBELS)
        control.nichols_grid(ax=ax, line_style="dotted", label_cl_phases=False)
        ax.axhline(0.0, color=GREY, linewidth=0.6, zorder=0)
        ax.axvline(-FULL / 2, color=GREY, linewidth=0.6, zorder=0)
        broken = np.flatnonzero(jumps) + 1
        ax.plot(
            np.insert(phase, broken, np.nan), np.insert(decibel, broken, np.nan), color=BLUE, label="L(iω)", zorder=3
        )
        ax.plot([-FULL / 2], [0.0], linestyle="none", label="critical point", **CRITICAL)
        for mark, at, name in _crossed(loop, margins):
            ax.plot(
                _phase(at),
                _decibel(at),
                mark,
                color=BLACK,
                markersize=4.5,
                markerfacecolor="white",
                label=name,
                zorder=5,
            )
        ax.set(xlim=(-FULL, 0.0), ylim=DECIBELS, title="")
        ax.set_xticks(np.arange(-FULL, 1.0, 45.0))
        ax.set_xlabel("phase of L (deg)")
        ax.set_ylabel("modulus of L (dB)")
        _legend(ax)
        return ax


def _response(loop: StateSpace, omega: Array) -> Array:
    return np.array([loop.frequency_response(w)[0, 0] for w in omega])


def _phase(L: Array) -> Array:
    return np.asarray(np.degrees(np.angle(L)) % FULL - FULL)


def _decibel(L: Array) -> Array:
    return np.asarray(20 * np.log10(np.maximum(np.abs(L), np.finfo(float).tiny)))  # L may vanish


def _crossed(loop: StateSpace, margins: Margins | None) -> list[tuple[str, Array, str]]:
    """Marks, places and names of the margins."""
    if margins is None:
        return []
    groups = (("o", margins.gain, "gain margin"), ("s", margins.phase, "phase margin"))
    return [
        (mark, _response(loop, np.array([m.angular_frequency for m in found])), name)
        for mark, found, name in groups
        if found
    ]


def _arrows(ax: "Axes", L: Array) -> None:
    """The direction of growing frequency, at even distances along what is seen."""
    seen = np.flatnonzero((np.abs(L[:-1]) < REACH) & (np.abs(np.diff(L)) > 0))
    run = np.cumsum(np.abs(np.diff(L))[seen])
    for n in seen[np.searchsorted(run, np.arange(ARROWS / 2, run[-1] if len(run) else 0.0, ARROWS))]:
        tail, head = ((L[k].real, L[k].imag) for k in (n, n + 1))
        look = {"arrowstyle": "-|>", "color": BLUE, "mutation_scale": 11}
        ax.annotate("", head, tail, arrowprops=look, zorder=4)


def _legend(ax: "Axes") -> None:
    """Above the plot, where it covers no curve."""
    columns = (len(ax.get_legend_handles_labels()[0]) + 1) // 2
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.2)
