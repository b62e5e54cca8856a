"""The paper's figures, redrawn under the formulations side by side."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from beal import plot
from beal.discretise import discretise
from beal.discretise.build import Formulation
from beal.paper import cases
from beal.paper.evidence import Array, Curve, Maps, Motion
from beal.plot.style import BLACK, BLUE, CYCLE, GREEN, GREY, ORANGE, SKY, VERMILION
from beal.stability.spectrum import Spectrum
from beal.vehicle.catalog import tsto

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable

WIDTH = 7.4  # inches, of the page
SCALE = (0.0, 160.0)  # of the colours of all maps
SHOWN: tuple[Formulation, ...] = ("as-printed", "converged", "objective")
COLORS: dict[Formulation, str] = {
    "as-printed": VERMILION,
    "corrected-ritz": ORANGE,
    "converged": BLUE,
    "objective": BLACK,
}
DASHES: dict[Formulation, Any] = {
    "as-printed": (0, (4, 1.5)),
    "corrected-ritz": (0, (1, 1)),
    "converged": (0, (7, 1.5, 1, 1.5)),
    "objective": "-",
}
MODE_JOINT = (0.2, 3000.0, 3000.0)


@dataclass(frozen=True)
class Table:
    """The data behind a figure: what it is, its columns, its rows."""

    about: str
    columns: tuple[str, ...]
    rows: Sequence[Sequence[Any]]


@dataclass(frozen=True)
class Drawing:
    """A figure with its file name, its caption (plain text) and the data behind it."""

    name: str
    title: str
    caption: str
    figure: Figure
    table: Table


def _panels(rows: int, columns: int, height: float, **options: Any) -> "tuple[Figure, Any]":
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def shapes() -> Drawing:
    """Fig. 2: the admissible functions under both signs of Eq. (12), and what they do at the joint.

    Returns
    -------
    Drawing
    """
    figure, axes = _panels(2, 2, 5.6)
    rows: list[tuple[Any, ...]] = []
    wavenumbers = {}
    for column, (formulation, title) in enumerate((("as-printed", "sign as printed"), ("corrected-ritz", "right sign"))):
        operators = discretise(tsto(*MODE_JOINT), formulation, order=4)  # type: ignore[arg-type]
        # the coordinates of a Ritz formulation are the mode shapes themselves
        roots = wavenumbers[formulation] = operators.basis._modes.wavenumbers  # type: ignore[attr-defined]
        spectrum = Spectrum(0.0, roots.astype(complex) ** 4, np.eye(4, dtype=complex), 0)
        top, bottom = axes[:, column]
        plot.mode_shapes(spectrum, operators, top)
        plot.mode_shapes(spectrum, operators, bottom)
        top.set_title(f"{'ab'[column]}  {title}")
        top.legend(loc="lower center", ncols=2, fontsize=7, handlelength=2.6)
        top.set_ylim(-1.75, 1.12)
        bottom.set(title=f"{'cd'[column]}  {title}, near the joint", xlim=(0.12, 0.28), ylim=(-1.12, 1.12))
        for side, low, high in (("forward", 0.0, 0.2), ("aft", 0.2, 1.0)):
            stations = np.linspace(low, high, 81 if side == "aft" else 21)
            values = operators.shape(stations, side="aft")
            values[-1 if side == "forward" else 0] = operators.shape(0.2, side=side)[0]  # type: ignore[arg-type]
            rows += [(formulation, side, x, *row) for x, row in zip(stations, values, strict=True)]
    lambdas = "; ".join(f"{cases.NAMES[name]}: " + ", ".join(f"{v:.4f}" for v in roots) for name, roots in wavenumbers.items())  # type: ignore[index]
    caption = (
        "The first four admissible functions for L₁ = 0.2, k_r = k_s = 3000, under the printed and the right sign of the "
        "rotational line of Eq. (12). The deflection jumps at the joint (dotted line), where the shear spring gives; the jump "
        "grows with the mode number because the shear force grows with λ³. Below, enlarged: the slope jumps one way on the left "
        f"and the other way on the right. λ {lambdas}."
    )
    table = Table(
        "Admissible functions of Eq. (10), unit generalised mass, L1/L = 0.2, k_r L/EI = k_s L^3/EI = 3000; station x/L; "
        "the joint's station appears twice, once on each side",
        ("formulation", "stage", "station", "phi_1", "phi_2", "phi_3", "phi_4"),
        rows,
    )
    return Drawing("fig02", "Fig. 2. Mode shapes", caption, figure, table)


def frequencies(number: int, found: Sequence[Mapping[Formulation, Curve]]) -> Drawing:
    """Figs. 3, 5, 7, 9, 10 and 12: frequencies over thrust, a row for each case.

    Parameters
    ----------
    number : int
        Of the figure.
    found : sequence of dict of str to Curve

    Returns
    -------
    Drawing
    """
    figure, axes = _panels(len(found), 3, 2.55 * len(found) + 0.45, sharey="row")
    rows: list[tuple[Any, ...]] = []
    for line, by_formulation in zip(axes, found, strict=True):
        case = next(iter(by_formulation.values())).case
        for column, name in enumerate(SHOWN):
            ax, curve = line[column], by_formulation[name]
            plot.thrust_curve(curve.curve, ax, curve.critical, relative=True)
            ax.set_ylabel(f"k_r = {case.joint[1]:g}, k_s = {case.joint[2]:g}\nfrequency ω/ω₁(P = 0)" if column == 0 else "")
            ax.set_title(cases.NAMES[name])
            marks = [(h, label) for h, label in zip(*ax.get_legend_handles_labels(), strict=True) if "P =" in label]
            ax.legend(*zip(*marks, strict=True), loc="upper center", handletextpad=0.2) if marks else None
            shown = curve.curve.angular_frequency / curve.curve.angular_frequency[0].min()
            ax.set_ylim(0.0, 1.22 * max(1.0, _tallest(by_formulation)))
            rows += _curve_rows(case, name, curve, shown)
        rows += _curve_rows(case, "corrected-ritz", by_formulation["corrected-ritz"], None)
    handles = [h for h, label in zip(*axes[0, 0].get_legend_handles_labels(), strict=True) if label.startswith("mode")]
    names = [f"mode {i + 1}" for i in range(len(handles))]
    figure.legend(handles, names, loc="outside upper center", ncols=4)
    caption = _curve_caption(found)
    table = Table(
        "Angular frequency omega sqrt(m L^4/EI) and growth rate of the four lowest elastic modes over the thrust P L^2/EI; "
        "omega_1(P=0) is omega_1 in the first row of each case and formulation; k_r L/EI, k_s L^3/EI",
        ("formulation", "L1", "k_r", "k_s", "thrust", *(f"omega_{i}" for i in range(1, 5)), *(f"growth_{i}" for i in range(1, 5))),
        rows,
    )
    title = f"Fig. {number}. Frequencies over thrust, L₁ = {found[0]['objective'].case.joint[0]:g}"
    return Drawing(f"fig{number:02d}", title, caption, figure, table)


def _tallest(by_formulation: Mapping[Formulation, Curve]) -> float:
    """Height at which the third mode begins or the pair of the critical point lies, over the first frequency."""
    heights = []
    for curve in by_formulation.values():
        omega = curve.curve.angular_frequency
        upper = max(2, (curve.critical.modes or (1, 2))[1])
        heights.append(omega[:, :upper].max() / omega[0].min())
    return float(max(heights))


def _curve_rows(case: cases.CurveCase, name: str, curve: Curve, shown: Array | None) -> list[tuple[Any, ...]]:
    c = curve.curve
    return [
        (name, *case.joint, P, *omega, *growth)
        for P, omega, growth in zip(c.thrust, c.angular_frequency, c.growth_rate, strict=True)
    ]


def _curve_caption(found: Sequence[Mapping[Formulation, Curve]]) -> str:
    parts = []
    for by_formulation in found:
        case = by_formulation["objective"].case
        loads = ", ".join(f"{_event(curve)} ({cases.NAMES[name]})" for name, curve in by_formulation.items())
        origin = f"chosen to show {case.chosen}" if case.chosen else "as in the paper"
        parts.append(f"{cases.joint_text(case.joint)} ({origin}): {loads}.")
    return (
        " ".join(parts) + " Disc: two modes meet (flutter); diamond: a frequency vanishes (divergence); dotted: unstable."
    )


def _event(curve: Curve) -> str:
    found = curve.critical
    if found.critical_thrust is None or found.modes is None:
        return f"stable to {found.searched_to:.0f}"
    low, high = found.modes
    name = f"flutter {low}–{high}" if found.kind == "flutter" else f"divergence {low}"
    return f"{name} at {found.critical_thrust:.2f}"


def chart(number: int, split: float, charts: Maps) -> Drawing:
    """Figs. 4, 6, 8 and 11: the critical thrust over both springs under the four formulations.

    Parameters
    ----------
    number : int
        Of the figure.
    split : float
        L1/L.
    charts : dict of (L1, formulation) to Dataset

    Returns
    -------
    Drawing
    """
    figure, axes = _panels(2, 2, 6.6, sharex=True, sharey=True)
    rows: list[tuple[Any, ...]] = []
    ranges = []
    for index, (ax, name) in enumerate(zip(axes.flat, cases.ORDER, strict=True)):
        data = charts[split, name]
        plot.stability_map(data, ax, limits=SCALE, colorbar=False)
        ax.set_title(f"{'abcd'[index]}  {cases.NAMES[name]}")
        ax.label_outer()
        thrust = np.asarray(data.critical_thrust)
        ranges.append(f"{np.nanmin(thrust):.2f} to {np.nanmax(thrust):.2f} ({cases.NAMES[name]})")
        flat = data.stack(point=(cases.K_R, cases.K_S))
        values = [np.asarray(flat[v]) for v in ("critical_thrust", "kind", "mode_low", "mode_high", "angular_frequency", "error_estimate", "status")]
        rows += [(name, *row) for row in zip(flat[cases.K_R].values, flat[cases.K_S].values, *values, strict=True)]
    mesh: ScalarMappable = axes[0, 0].collections[0]
    bar = figure.colorbar(mesh, ax=axes, label="critical thrust P_cr L²/EI", extend="max", shrink=0.85, aspect=32)
    bar.ax.axhline(cases.UNIFORM, color="white", linewidth=1.4)
    bar.ax.text(1.25, cases.UNIFORM, "uniform", transform=bar.ax.get_yaxis_transform(), va="center", fontsize=0)
    caption = (
        f"Critical thrust over the springs of the joint for L₁ = {split:g}, on {len(data[cases.K_R])} × {len(data[cases.K_S])} points "
        "under each formulation, all on one colour scale (white line on the bar: the uniform beam). Lines part regions of another "
        f"kind or another pair of modes; divergence is hatched. P_cr from {'; '.join(ranges)}."
    )
    table = Table(
        "Critical thrust P L^2/EI over k_r L/EI and k_s L^3/EI; kind 0 stable, 1 flutter, 2 divergence; modes that meet; omega "
        "sqrt(m L^4/EI) there; error estimate of the thrust; status 1 solved",
        ("formulation", "k_r", "k_s", "critical_thrust", "kind", "mode_low", "mode_high", "angular_frequency", "error_estimate", "status"),
        rows,
    )
    return Drawing(f"fig{number:02d}", f"Fig. {number}. Critical thrust over the joint’s springs, L₁ = {split:g}", caption, figure, table)


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
    figure, axes = _panels(2, 2, 5.4)
    (a, b), (c, d) = axes
    for name in ("as-printed", "objective"):
        line = {"color": COLORS[name], "linestyle": DASHES[name], "label": cases.NAMES[name]}
        plot.response(found[name].newmark, a, quantity="displacement", **line)
        plot.response(found[name].newmark, b, quantity="rate", **line)
    for name in cases.ORDER:
        time, size = _peaks(found[name])
        c.semilogy(time, size, color=COLORS[name], linestyle=DASHES[name], marker=".", markersize=4, linewidth=1.1, label=cases.NAMES[name])
    low, high = c.get_ylim()
    c.set(xlabel="time t √(EI/mL⁴)", ylabel="peaks of |y|/L", ylim=(min(low, 1e-4), max(high, 1e-3)))
    plot.trajectory(found["objective"].newmark, d)
    for ax, title in zip((a, b, c, d), ("displacement", "rate", "size of the peaks", "trajectory, objective"), strict=True):
        ax.set_title(f"{'abcd'[(a, b, c, d).index(ax)]}  {title}")
    a.legend(loc="upper left", ncols=2)
    c.legend(loc="best", fontsize=7)
    d.legend(loc="upper left")
    a.set_ylim(-1.3 * _reach(a), 1.3 * _reach(a))
    worst = max(motion.difference for motion in found.values())
    caption = (
        f"Elastic motion of the IMU (x = 0.2 L₁ = 0.12) for {cases.joint_text(cases.RESPONSE_JOINT)}, P = {thrust:g}, no transverse "
        f"force. {start} Newmark’s method (β = 1/4, γ = 1/2, step {found['objective'].newmark.step:.0e}); the largest difference from the "
        f"exact solution, over all four formulations, is {worst:.1e} of the largest displacement."
    )
    rows: list[tuple[Any, ...]] = []
    for name, motion in found.items():
        newmark, exact = motion.newmark, motion.exact
        columns = (newmark.time, newmark.displacement[0], newmark.rate[0], exact.displacement[0], exact.rate[0])
        rows += [(name, *row) for row in zip(*columns, strict=True)]
    table = Table(
        f"Elastic motion at x/L = 0.12, L1/L = 0.6, k_r L/EI = k_s L^3/EI = 5000, P L^2/EI = {thrust:g}, F = 0; time t sqrt(EI/(m L^4)); "
        "displacement y/L and its rate by Newmark's method and exact",
        ("formulation", "time", "displacement", "rate", "displacement_exact", "rate_exact"),
        rows,
    )
    kind = "below" if thrust < cases.PAPER_CRITICAL else "above"
    return Drawing(f"fig{number}", f"Fig. {number}. Free motion {kind} the critical thrust, P = {thrust:g}", caption, figure, table)


def _reach(ax: "Axes") -> float:
    return float(max(abs(v) for v in ax.get_ylim()))


def _peaks(motion: Motion) -> tuple[Array, Array]:
    """Times and sizes at which |y| is larger than before and after."""
    size, time = abs(motion.exact.displacement[0]), motion.exact.time
    top = np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] > size[2:])) + 1
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
    figure, axes = _panels(2, 2, 5.4)
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
        c.plot(thrusts, sweeps["objective"][force], color=color, linestyle=dash, marker=".", label=f"F = {force:g} sin 2t")
    for name in cases.ORDER:
        d.plot(thrusts, sweeps[name][small], color=COLORS[name], linestyle=DASHES[name], label=cases.NAMES[name])
    for ax in (c, d):
        for thrust in cases.FORCED_THRUSTS:
            ax.axvline(thrust, color=GREY, linewidth=0.7, linestyle=":")
        ax.set(xlabel="thrust P L²/EI", ylabel="amplitude of |y|/L", ylim=(0.0, None))
        ax.legend(loc="best")
    c.set_title("c  amplitude over thrust, objective")
    d.set_title(f"d  the same, F = {small:g}, all formulations")
    worst = max(motion.difference for motion in found.values())
    caption = (
        f"Elastic displacement of the IMU (x = 0.12) under F sin 2t at the tail, from rest, for {cases.joint_text(cases.RESPONSE_JOINT)}. "
        f"Newmark against exact: at most {worst:.1e} of the largest displacement. Amplitude: the largest |y| in 20 units of time. Doubling the "
        "force doubles the motion; raising the thrust raises it at first, then lowers it to almost nothing near P = 90, where the "
        "deflection at the IMU changes sign, and raises it again towards flutter."
    )
    rows = [
        (thrust, force, *row)
        for (thrust, force), motion in found.items()
        for row in zip(motion.newmark.time, motion.newmark.displacement[0], motion.newmark.rate[0], motion.exact.displacement[0], strict=True)
    ]
    table = Table(
        "Elastic motion at x/L = 0.12 from rest, objective formulation, L1/L = 0.6, k_r L/EI = k_s L^3/EI = 5000; thrust P L^2/EI, force F L^2/EI times "
        "sin 2t at the tail; time t sqrt(EI/(m L^4)); displacement y/L and rate by Newmark's method, displacement exact",
        ("thrust", "force", "time", "displacement", "rate", "displacement_exact"),
        rows,
    )
    return Drawing("fig15", "Fig. 15. Forced motion below the critical thrust", caption, figure, table)


def convergence(found: Mapping[str, Mapping[str, Sequence[tuple[int, float]]]]) -> Drawing:
    """Error of the critical thrust over the number of unknowns, modes against polynomials.

    Parameters
    ----------
    found : dict of case to dict of basis to list of (unknowns, relative error)

    Returns
    -------
    Drawing
    """
    figure, axes = _panels(1, len(found), 2.9, sharey=True)
    rows: list[tuple[Any, ...]] = []
    looks = {"modes, right sign": (ORANGE, "s"), "polynomials": (GREEN, "o")}
    for index, (ax, (case, bases)) in enumerate(zip(axes.flat, found.items(), strict=True)):
        for basis, points in bases.items():
            color, marker = looks[basis]
            count, error = np.array(points).T
            ax.loglog(count, np.maximum(error, 1e-14), color=color, marker=marker, markersize=4, label=basis)
            rows += [(case, basis, int(n), e) for n, e in points]
        ax.axvline(8, color=CYCLE[1], linewidth=0.8, linestyle="--", zorder=0)
        ax.set_title(f"{'abc'[index]}  {case}")
        ax.set_xlabel("number of elastic unknowns")
        ax.set_xticks([4, 8, 16, 32, 64], ["4", "8", "16", "32", "64"], minor=False)
        ax.minorticks_off()
    axes[0, 0].set_ylabel("relative error of P_cr")
    axes[0, 0].legend(loc="lower left")
    caption = (
        "Relative error of the critical thrust against the converged one, for the lowest modes of the unloaded vehicle with the right "
        "sign of Eq. (12) and for polynomials on each stage; inertial shear axis, elastic modes only. Dashed: the eight modes of the paper."
    )
    table = Table("Relative error of the critical thrust over the number of elastic unknowns", ("case", "basis", "unknowns", "relative_error"), rows)
    return Drawing("convergence", "Convergence of the critical thrust", caption, figure, table)
