"""The paper's figures, redrawn under the formulations side by side."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from beal import plot
from beal.discretisation import discretise
from beal.discretisation.build import Formulation
from beal.discretisation.joint_modes import joint_modes
from beal.paper import cases
from beal.paper.evidence import Curve, Maps
from beal.plot.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION
from beal.stability.spectrum import Spectrum
from beal.study.variables import VARIABLES
from beal.vehicle.catalog import tsto

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D
    from xarray import Dataset

WIDTH = 7.4  # inches, of the page
LEVELS = (0, 20, 40, 60, 80, 90, 95, 100, 105, 110, 115, 120, 130, 140, 160)  # of the colours of all maps
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


def panels(rows: int, columns: int, height: float, **options: Any) -> "tuple[Figure, Any]":
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def shapes() -> Drawing:
    """Fig. 2: the admissible functions under both signs of Eq. (12), and what they do at the joint.

    Returns
    -------
    Drawing
    """
    figure, axes = panels(2, 2, 5.4)
    rows: list[tuple[Any, ...]] = []
    wavenumbers, jumps = {}, {}
    pairs: tuple[tuple[Formulation, str], ...] = (("as-printed", "sign as printed"), ("corrected-ritz", "right sign"))
    for column, (formulation, title) in enumerate(pairs):
        operators = discretise(tsto(*MODE_JOINT), formulation, order=4)
        roots = joint_modes(*MODE_JOINT, 4, "printed" if formulation == "as-printed" else "natural").wavenumbers
        wavenumbers[formulation] = roots
        # the coordinates of a Ritz formulation are the mode shapes themselves
        spectrum = Spectrum(0.0, roots.astype(complex) ** 4, np.eye(4, dtype=complex), 0)
        ax = axes[0, column]
        plot.deflections(spectrum, operators, ax)
        ax.set_title(f"{'ab'[column]}  {title}")
        ax.legend(loc="lower center", ncols=2, fontsize=7, handlelength=2.6)
        ax.set_ylim(-1.75, 1.12)
        stations = np.concatenate([np.linspace(0.0, 0.2, 21), np.linspace(0.2, 1.0, 81)])
        values = operators.shape(stations)
        values[20] = operators.shape(0.2, side="forward")[0]
        rows += [(formulation, x, *row) for x, row in zip(stations, values, strict=True)]
        jumps[formulation] = [operators.basis.jump(1, derivative) / abs(values).max(axis=0) for derivative in (0, 1)]
    for derivative, ax in enumerate(axes[1]):
        for shift, (formulation, title) in zip((-0.2, 0.2), pairs, strict=True):
            color = {"as-printed": VERMILION}.get(formulation, BLUE)
            ax.bar(np.arange(1, 5) + shift, jumps[formulation][derivative], 0.38, color=color, label=title)
        ax.axhline(0.0, color=GREY, linewidth=0.8)
        ax.set(
            xlabel="mode", xticks=range(1, 5), title=("c  jump of the deflection", "d  jump of the slope")[derivative]
        )
    axes[1, 0].set_ylabel(r"$\phi_2(0)-\phi_1(L_1)$")
    axes[1, 1].set_ylabel(r"$\phi_2'(0)-\phi_1'(L_1)$")
    axes[1, 0].legend(loc="upper left")
    lambdas = "; ".join(
        f"{cases.NAMES[name]}: " + ", ".join(f"{v:.4f}" for v in roots) for name, roots in wavenumbers.items()
    )
    largest = 1 + int(np.argmax(abs(jumps["corrected-ritz"][0])))
    caption = (
        "The first four admissible functions for L₁ = 0.2, k_r = k_s = 3000, under the printed and the right sign of "
        "the rotational line of Eq. (12). The deflection jumps at the joint (dotted line), where the shear spring "
        f"gives, most of all in mode {largest}. Below, both jumps: that of the deflection is the same, that of the "
        f"slope has the opposite sign. λ {lambdas}."
    )
    table = Table(
        "Admissible functions of Eq. (10), unit generalised mass, L1/L = 0.2, k_r L/EI = k_s L^3/EI = 3000; station "
        "x/L; the joint's station appears twice, once on each side",
        ("formulation", "station", "phi_1", "phi_2", "phi_3", "phi_4"),
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
    figure, axes = panels(len(found), 3, 2.55 * len(found) + 0.45, sharey="row")
    rows: list[tuple[Any, ...]] = []
    for line, by_formulation in zip(axes, found, strict=True):
        case = next(iter(by_formulation.values())).case
        for column, name in enumerate(SHOWN):
            ax, curve = line[column], by_formulation[name]
            plot.thrust_curve(curve.curve, ax, curve.critical, relative=True)
            ax.set_ylabel(
                f"$k_r$ = {case.joint[1]:g}, $k_s$ = {case.joint[2]:g}\n" + r"frequency $\omega/\omega_1(P=0)$"
                if column == 0
                else ""
            )
            ax.set_title(cases.NAMES[name])
            marks = [(h, label) for h, label in zip(*ax.get_legend_handles_labels(), strict=True) if "P =" in label]
            ax.legend(
                *zip(*marks, strict=True),
                loc="upper center",
                handletextpad=0.2,
                frameon=True,
                framealpha=0.9,
                edgecolor="none",
                borderpad=0.2,
            ) if marks else None
            ax.set_ylim(0.0, 1.22 * max(1.0, _tallest(by_formulation)))
            rows += _curve_rows(case, name, curve)
        rows += _curve_rows(case, "corrected-ritz", by_formulation["corrected-ritz"])
    lines = [line for ax in axes.flat for line in ax.lines if line.get_label().startswith("mode") and _shows(ax, line)]
    names = sorted({line.get_label() for line in lines})
    handles = [next(line for line in lines if line.get_label() == name) for name in names]
    figure.legend(handles, names, loc="outside upper center", ncols=4)
    caption = _curve_caption(found)
    table = Table(
        "Angular frequency omega sqrt(m L^4/EI) and growth rate of the four lowest elastic modes over the thrust P "
        "L^2/EI; omega_1(P=0) is omega_1 in the first row of each case and formulation; k_r L/EI, k_s L^3/EI",
        (
            "formulation",
            "L1",
            "k_r",
            "k_s",
            "thrust",
            *(f"omega_{i}" for i in range(1, 5)),
            *(f"growth_{i}" for i in range(1, 5)),
        ),
        rows,
    )
    title = f"Fig. {number}. Frequencies over thrust, L₁ = {found[0]['objective'].case.joint[0]:g}"
    return Drawing(f"fig{number:02d}", title, caption, figure, table)


def _shows(ax: "Axes", line: "Line2D") -> bool:
    return bool(np.nanmin(np.asarray(line.get_ydata(), dtype=float)) < ax.get_ylim()[1])


def _tallest(by_formulation: Mapping[Formulation, Curve]) -> float:
    """Height at which the third mode begins or the pair of the critical point lies, over the first frequency."""
    heights = []
    for curve in by_formulation.values():
        omega = curve.curve.angular_frequency
        upper = max(2, (curve.critical.modes or (1, 2))[1])
        heights.append(omega[:, :upper].max() / omega[0].min())
    return float(max(heights))


def _curve_rows(case: cases.CurveCase, name: str, curve: Curve) -> list[tuple[Any, ...]]:
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
        " ".join(parts)
        + " Disc: two modes meet (flutter); diamond: a frequency vanishes (divergence); dotted: unstable."
    )


def _event(curve: Curve) -> str:
    found = curve.critical
    if found.critical_thrust is None or found.modes is None:
        return f"stable to {found.searched_to:.0f}"
    low, high = found.modes
    name = f"flutter {low}-{high}" if found.kind == "flutter" else f"divergence {low}"
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
    figure, axes = panels(2, 2, 6.6, sharex=True, sharey=True)
    rows: list[tuple[Any, ...]] = []
    ranges = []
    for index, (ax, name) in enumerate(zip(axes.flat, cases.ORDER, strict=True)):
        data = charts[split, name]
        plot.stability_map(data, ax, levels=LEVELS, colorbar=False)
        ax.set_title(f"{'abcd'[index]}  {cases.NAMES[name]}")
        ax.label_outer()
        thrust = np.asarray(data.critical_thrust)
        span = f"P_cr {np.nanmin(thrust):.2f} to {np.nanmax(thrust):.2f}"
        ranges.append(f"{cases.NAMES[name]}: {span}, {_shares(data)}")
        flat = data.stack(point=(cases.K_R, cases.K_S))
        values = [np.asarray(flat[v]) for v in VARIABLES]
        rows += [(name, *row) for row in zip(flat[cases.K_R].values, flat[cases.K_S].values, *values, strict=True)]
    mesh = axes[0, 0].collections[0]
    figure.colorbar(mesh, ax=axes, label="critical thrust $P_{cr} L^2/EI$", ticks=LEVELS, shrink=0.85, aspect=32)
    caption = (
        f"Critical thrust over the springs of the joint for L₁ = {split:g}, on {len(data[cases.K_R])} by "
        f"{len(data[cases.K_S])} points under each formulation, all on one colour scale with steps that are finest "
        "near the uniform beam's 109.69. Lines part regions of another kind or another pair of modes; divergence is "
        "hatched. Isolated cells lie in tongues narrower than the grid. Range and number of points: "
        f"{'; '.join(ranges)}."
    )
    table = Table(
        "Critical thrust P L^2/EI over k_r L/EI and k_s L^3/EI; kind 0 stable, 1 flutter, 2 divergence; modes that "
        "meet; omega sqrt(m L^4/EI) there; error estimate of the thrust; status 1 solved",
        ("formulation", "k_r", "k_s", *VARIABLES),
        rows,
    )
    return Drawing(
        f"fig{number:02d}",
        f"Fig. {number}. Critical thrust over the joint's springs, L₁ = {split:g}",
        caption,
        figure,
        table,
    )


def _mathtext(text: str) -> str:
    return text.replace("k_r", "$k_r$").replace("k_s", "$k_s$").replace("L₁", "$L_1$")


def _shares(data: "Dataset") -> str:
    """How many points of a map each kind and pair has, the most frequent first."""
    names = ("stable", "flutter", "divergence")
    labels = zip(*(np.asarray(data[v]).astype(int).ravel() for v in ("kind", "mode_low", "mode_high")), strict=True)
    counts = Counter(f"{names[k]} {low}" + (f"-{high}" if names[k] == "flutter" else "") for k, low, high in labels)
    return ", ".join(f"{name} {count}" for name, count in counts.most_common())


def convergence(found: Mapping[str, Mapping[str, Sequence[tuple[int, float]]]]) -> Drawing:
    """Error of the critical thrust over the number of unknowns, modes against polynomials.

    Parameters
    ----------
    found : dict of case to dict of basis to list of (unknowns, relative error)

    Returns
    -------
    Drawing
    """
    figure, axes = panels(1, len(found), 2.9, sharey=True)
    rows: list[tuple[Any, ...]] = []
    looks = {"modes, right sign": (ORANGE, "s"), "polynomials": (GREEN, "o")}
    for index, (ax, (case, bases)) in enumerate(zip(axes.flat, found.items(), strict=True)):
        for basis, points in bases.items():
            color, marker = looks[basis]
            count, error = np.array(points).T
            ax.loglog(count, np.maximum(error, 1e-14), color=color, marker=marker, markersize=4, label=basis)
            rows += [(case, basis, int(n), e) for n, e in points]
        ax.axvline(8, color=GREY, linewidth=0.8, linestyle="--", zorder=0)
        ax.set_title(f"{'abc'[index]}  " + _mathtext(case).replace(", ", "\n    ", 1), fontsize=8.5)
        ax.set_xlabel("number of elastic unknowns")
        ax.set_xticks([4, 8, 16, 32, 64], ["4", "8", "16", "32", "64"], minor=False)
        ax.minorticks_off()
    axes[0, 0].set_ylabel("relative error of $P_{cr}$")
    axes[0, 0].legend(loc="lower left")
    caption = (
        "Relative error of the critical thrust against the converged one, for the lowest modes of the unloaded "
        "vehicle with the right sign of Eq. (12) and for polynomials on each stage; inertial shear axis, elastic "
        "modes only. Dashed: the eight modes of the paper."
    )
    table = Table(
        "Relative error of the critical thrust over the number of elastic unknowns",
        ("case", "basis", "unknowns", "relative_error"),
        rows,
    )
    return Drawing("convergence", "Convergence of the critical thrust", caption, figure, table)
