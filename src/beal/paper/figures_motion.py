"""Figs. 13 to 15: how the IMU moves, free and forced."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from beal import plot
from beal.discretisation.build import Formulation
from beal.paper import cases
from beal.paper.evidence import Array, Motion
from beal.paper.figures import COLORS, DASHES, Drawing, Table, panels
from beal.plot.histories import TIME
from beal.plot.style import GREY, SKY, VERMILION

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STRIDE = 4  # of the times in the tables


def free_motion(number: int, thrust: float, found: Mapping[Formulation, Motion], start: str) -> Drawing:
    """Figs. 13 and 14: displacement, rate, size and trajectory of the IMU without a force.

    Parameters
    ----------
    number : int
        Of the figure.
    thrust : float
        P L^2/EI.
    found : dict of str to Motion
    start : str
        The initial condition in words.

    Returns
    -------
    Drawing
    """
    figure, axes = panels(2, 2, 5.4)
    (a, b), (c, d) = axes
    for name in ("as-printed", "objective"):
        line = {"color": COLORS[name], "linestyle": DASHES[name], "label": cases.NAMES[name]}
        plot.response(found[name].newmark, a, quantity="displacement", **line)
        plot.response(found[name].newmark, b, quantity="rate", **line)
    for name in cases.ORDER:
        time, size = _peaks(found[name])
        c.semilogy(
            time,
            size,
            color=COLORS[name],
            linestyle=DASHES[name],
            marker=".",
            markersize=4,
            linewidth=1.1,
            label=cases.NAMES[name],
        )
    low, high = c.get_ylim()
    c.set(
        xlabel=TIME,
        ylabel="largest $|y|/L$ per half period",
        ylim=(min(low, 1e-4), max(high, 1e-3)),
    )
    plot.trajectory(found["objective"].newmark, d)
    for ax, title in zip(
        (a, b, c, d), ("displacement", "rate", "size, half period by half period", "trajectory, objective"), strict=True
    ):
        ax.set_title(f"{'abcd'[(a, b, c, d).index(ax)]}  {title}")
    a.legend(loc="upper left", ncols=2)
    c.legend(loc="best", fontsize=7)
    d.legend(loc="best")
    for ax in (a, b):
        ax.set_xlim(0.0, min(3.0, found["objective"].newmark.time[-1]))
    a.set_ylim(-1.3 * _reach(a), 1.3 * _reach(a))
    apart = ", ".join(f"{motion.difference:.1e} ({cases.NAMES[name]})" for name, motion in found.items())
    caption = (
        f"Elastic motion of the IMU (x = 0.2 L₁ = 0.12) for {cases.joint_text(cases.RESPONSE_JOINT)}, P = {thrust:g}, "
        f"no transverse force. {start} Newmark's method with constant mean acceleration, step "
        f"{found['objective'].newmark.step:.0e}; the largest difference from the exact solution, over the largest "
        f"displacement, is {apart}."
    )
    rows: list[tuple[Any, ...]] = []
    for name, motion in found.items():
        newmark, exact = motion.newmark, motion.exact
        columns = (newmark.time, newmark.displacement[0], newmark.rate[0], exact.displacement[0], exact.rate[0])
        rows += [(name, *row) for row in zip(*(column[::STRIDE] for column in columns), strict=True)]
    table = Table(
        f"Elastic motion at x/L = 0.12, L1/L = 0.6, k_r L/EI = k_s L^3/EI = 5000, P L^2/EI = {thrust:g}, F = 0; time "
        "t sqrt(EI/(m L^4)); displacement y/L and its rate by Newmark's method and exact",
        ("formulation", "time", "displacement", "rate", "displacement_exact", "rate_exact"),
        rows,
    )
    kind = "below" if thrust < cases.PAPER_CRITICAL else "above"
    return Drawing(
        f"fig{number}", f"Fig. {number}. Free motion {kind} the critical thrust, P = {thrust:g}", caption, figure, table
    )


def _reach(ax: "Axes") -> float:
    return float(max(abs(v) for v in ax.get_ylim()))


def _peaks(motion: Motion) -> tuple[Array, Array]:
    """Times and sizes of the largest |y| in each half period of the lowest mode."""
    size, time = abs(motion.exact.displacement[0]), motion.exact.time
    half = np.pi / abs(np.sqrt(-motion.exact.mu[0]).imag)
    windows = [np.flatnonzero((time >= i * half) & (time < (i + 1) * half)) for i in range(int(time[-1] / half))]
    top = np.array([window[np.argmax(size[window])] for window in windows])
    return time[top], size[top]


def forced_motion(
    found: Mapping[tuple[float, float], Motion],
    thrusts: Sequence[float],
    sweeps: Mapping[Formulation, Mapping[float, Sequence[float]]],
) -> Drawing:
    """Fig. 15: the IMU under F sin 2t at the tail, and its amplitude over the thrust.

    Parameters
    ----------
    found : dict of (P, F) to Motion
    thrusts : sequence of float
        Of the sweeps.
    sweeps : dict of str to dict of F to amplitudes

    Returns
    -------
    Drawing
    """
    figure, axes = panels(2, 2, 5.4)
    (a, b), (c, d) = axes
    small, large = cases.FORCED_AMPLITUDES
    forces = {small: (SKY, "-"), large: (VERMILION, (0, (5, 1)))}
    for ax, thrust in ((a, cases.FORCED_THRUSTS[0]), (b, cases.FORCED_THRUSTS[1])):
        for force, (color, dash) in forces.items():
            plot.response(found[thrust, force].newmark, ax, color=color, linestyle=dash, label=f"F = {force:g} sin 2t")
        ax.set_title(f"{'ab'[ax is b]}  P = {thrust:g}, objective")
        ax.legend(loc="upper left", ncols=2)
    reach = 1.3 * max(_reach(a), _reach(b))
    for ax in (a, b):
        ax.set_ylim(-reach, reach)
    for force, (color, dash) in forces.items():
        c.plot(
            thrusts, sweeps["objective"][force], color=color, linestyle=dash, marker=".", label=f"F = {force:g} sin 2t"
        )
    for name in cases.ORDER:
        d.plot(thrusts, sweeps[name][small], color=COLORS[name], linestyle=DASHES[name], label=cases.NAMES[name])
    for ax in (c, d):
        for thrust in cases.FORCED_THRUSTS:
            ax.axvline(thrust, color=GREY, linewidth=0.7, linestyle=":")
        ax.set(xlabel="thrust $P L^2/EI$", ylabel="amplitude of $|y|/L$", ylim=(0.0, None))
        ax.ticklabel_format(axis="y", style="sci", scilimits=(0, 0), useMathText=True)
        ax.legend(loc="best")
    c.set_title("c  amplitude over thrust, objective")
    d.set_title(f"d  the same, F = {small:g}, all formulations")
    worst = max(motion.difference for motion in found.values())
    sizes = np.array(sweeps["objective"][small])
    top, bottom = int(np.argmax(sizes[: int(np.argmin(sizes)) + 1])), int(np.argmin(sizes))
    turns = (
        f"Twice the force gives {sweeps['objective'][large][0] / sizes[0]:.3f} times the motion. With thrust the "
        f"amplitude first peaks at P = {thrusts[top]:g}, falls to {sizes[bottom] / sizes[top]:.0%} of that at P = "
        f"{thrusts[bottom]:g}, where the slow deflection at the IMU changes sign, and grows again towards flutter."
    )
    caption = (
        "Elastic displacement of the IMU (x = 0.12) under F sin 2t at the tail, from rest, for "
        f"{cases.joint_text(cases.RESPONSE_JOINT)}. Newmark against exact: at most {worst:.1e} of the largest "
        f"displacement. Amplitude: the largest |y| in 20 units of time. {turns}"
    )
    rows: list[tuple[Any, ...]] = []
    for key, motion in found.items():
        newmark, exact = motion.newmark, motion.exact
        columns = (newmark.time, newmark.displacement[0], newmark.rate[0], exact.displacement[0])
        rows += [(*key, *row) for row in zip(*(column[::STRIDE] for column in columns), strict=True)]
    table = Table(
        "Elastic motion at x/L = 0.12 from rest, objective formulation, L1/L = 0.6, k_r L/EI = k_s L^3/EI = 5000; "
        "thrust P L^2/EI, force F L^2/EI times sin 2t at the tail; time t sqrt(EI/(m L^4)); displacement y/L and "
        "rate by Newmark's method, displacement exact",
        ("thrust", "force", "time", "displacement", "rate", "displacement_exact"),
        rows,
    )
    return Drawing("fig15", "Fig. 15. Forced motion below the critical thrust", caption, figure, table)
