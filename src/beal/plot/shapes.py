"""Mode shapes: the vehicle bent by each mode, or their deflections as lines over the station."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from beal.discretisation.operators import Operators
from beal.plot.body import Section, flexible, sections
from beal.plot.style import BLACK, BLUE, CYCLE, GREY, TINTS, VERMILION, along, axes, fitted, station_label, style
from beal.stability.spectrum import Spectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STATIONS = 161  # per stage
DASHES = ("-", "--", "-.", ":")
# Of the bent vehicle, over its length
HALF_WIDTH = 0.02
AMPLITUDE, STEEPEST = 0.07, 0.7  # largest deflection and slope
ROW = 0.22  # from one mode to the next
WORDS = 0.3  # room beside the vehicle
PHASES = 8  # of a cycle, in which a complex mode is drawn
COMPLEX = 0.05  # part out of phase over the largest deflection, above which a mode has no nodes
ZERO = 1e-6  # deflection over the largest one, below which it has no sign
GROWING = 1e-6  # growth rate over the modulus of the root, above which it is told


@dataclass(frozen=True)
class _Shape:
    """A mode, its largest deflection 1 and the nose on the positive side."""

    operators: Operators
    q: NDArray[np.complex128]

    def on(self, x: NDArray[np.float64], derivative: int = 0) -> NDArray[np.complex128]:
        """The deflection, or the slope, along one stage: at its end that of its own face."""
        ends = self.operators.shape(x[:-1], derivative, "aft"), self.operators.shape(x[-1:], derivative, "forward")
        return np.asarray(np.concatenate(ends) @ self.q)


def mode_shapes(spectrum: Spectrum, operators: Operators, ax: "Axes | None" = None) -> "Axes":
    """Draw the vehicle bent by each mode of a spectrum, the first at the top.

    Where a joint gives, both faces are drawn with the jumps of deflection and slope between them; white circles are
    nodes. A mode whose parts move out of phase by a twentieth of its largest deflection or more, as in flutter, has
    none: its axis is drawn at eight phases of a cycle inside its envelope, its growth left out. Each mode has a scale
    of its own. The body is that of `beal.plot.vehicle`, thinner.

    Parameters
    ----------
    spectrum : Spectrum
    operators : Operators
        Those that the spectrum was computed from.
    ax : Axes, optional

    Returns
    -------
    Axes
        With equal units along both axes.

    Examples
    --------
    >>> from beal.discretisation.build import discretise
    >>> from beal.stability.spectrum import spectrum
    >>> from beal.vehicle.catalog import beal
    >>> from matplotlib.figure import Figure
    >>> operators = discretise(beal())
    >>> ax = mode_shapes(spectrum(operators, count=2), operators, Figure().subplots())
    >>> [text.get_text() for text in ax.texts]
    ['mode 1\\n$\\\\omega$ = 22.37', 'mode 2\\n$\\\\omega$ = 61.67']
    """
    with style():
        target, vehicle = axes(ax), operators.vehicle
        length = vehicle.length
        bodies = sections(vehicle, HALF_WIDTH)
        for number, shape in enumerate(_shapes(spectrum, operators)):
            base = -number * ROW * length
            _bent(target, shape, bodies, base)
            target.text(
                1.03 * length, base, _words(spectrum, number, vehicle.units == "SI"), va="center", fontsize="small"
            )
        high = (AMPLITUDE + HALF_WIDTH + 0.02) * length
        target.set(xlim=(-0.02 * length, (1 + WORDS) * length), ylim=(base - high, high), aspect="equal", yticks=[])
        along(target, vehicle)
        if ax is None:
            fitted(target)
        return target


def deflections(spectrum: Spectrum, operators: Operators, ax: "Axes | None" = None) -> "Axes":
    """Draw the deflections of the modes of a spectrum as lines, stage by stage, scaled to a largest one of 1.

    Parameters
    ----------
    spectrum : Spectrum
    operators : Operators
        Those that the spectrum was computed from.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    with style():
        ax = axes(ax)
        nondimensional = operators.vehicle.units == "nondimensional"
        for joint in operators.vehicle.boundaries[1:-1]:
            ax.axvline(joint, color=GREY, linewidth=0.8, linestyle=(0, (1, 2)))
        for index, (shape, omega) in enumerate(
            zip(_shapes(spectrum, operators), spectrum.angular_frequency, strict=True)
        ):
            color, dash = CYCLE[index % len(CYCLE)], DASHES[index % len(DASHES)]
            label = f"mode {index + 1}, " + (f"λ = {omega**0.5:.4f}" if nondimensional else f"ω = {omega:.4g} rad/s")
            for x in _stages(operators):
                ax.plot(x, shape.on(x).real, color=color, linestyle=dash, label=label)
                label = ""
        ax.axhline(0.0, color=GREY, linewidth=0.6)
        ax.set(xlabel=station_label(operators.vehicle), ylabel="deflection (largest = 1)")
        ax.margins(x=0.0)
        return ax


def _stages(operators: Operators) -> list[NDArray[np.float64]]:
    """Stations along each stage."""
    ends = operators.vehicle.boundaries
    return [np.linspace(front, back, STATIONS) for front, back in zip(ends, ends[1:], strict=False)]


def _shapes(spectrum: Spectrum, operators: Operators) -> list[_Shape]:
    found = []
    for q in spectrum.shapes.T:
        deflection = np.concatenate([_Shape(operators, q).on(x) for x in _stages(operators)])
        largest = deflection[np.argmax(abs(deflection))]
        sign = np.sign((deflection[0] / largest).real) or 1.0
        found.append(_Shape(operators, sign * q / largest))
    return found


def _bent(ax: "Axes", shape: _Shape, bodies: list[Section], base: float) -> None:
    """The body bent by a mode, its axis, and nodes or phases."""
    stages = _stages(shape.operators)
    deflection = [shape.on(x) for x in stages]
    steepest = max(abs(shape.on(x, derivative=1)).max() for x in stages)
    scale = min(AMPLITUDE * shape.operators.vehicle.length, STEEPEST / steepest)
    moving = max(abs(part.imag).max() for part in deflection) > COMPLEX
    ax.plot([stages[0][0], stages[-1][-1]], [base, base], color=GREY, linewidth=0.6, dashes=(9, 3, 2, 3), zorder=1)
    for number, body in enumerate(bodies):
        bent, turned = (scale * shape.on(body.x, derivative).real for derivative in (0, 1))
        look = {"facecolor": TINTS[number % 2], "edgecolor": BLACK, "linewidth": 0.7, "zorder": 2}
        ax.add_patch(Polygon(body.outline(base + bent, turned), closed=True, **look))
    for x, part in zip(stages, deflection, strict=True):
        ax.plot(x, base + scale * part.real, color=BLUE, linewidth=1.2, zorder=4)
        if moving:
            _cycle(ax, x, base, scale * part)
        else:
            nodes = _nodes(x, part.real)
            ax.plot(
                nodes, np.full_like(nodes, base), "o", color=BLACK, markersize=4.0, markerfacecolor="white", zorder=5
            )
    _faces(ax, shape, base, scale)


def _cycle(ax: "Axes", x: NDArray[np.float64], base: float, drawn: NDArray[np.complex128]) -> None:
    """The axis at phases of a cycle, and its envelope."""
    for turn in np.exp(2j * np.pi * np.arange(1, PHASES) / PHASES):
        ax.plot(x, base + (turn * drawn).real, color=BLUE, linewidth=0.7, alpha=0.7, zorder=3)
    for side in (1, -1):
        ax.plot(x, base + side * abs(drawn), color=VERMILION, linewidth=0.9, linestyle=":", zorder=3)


def _nodes(x: NDArray[np.float64], deflection: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where a deflection changes its sign."""
    clear = abs(deflection) > ZERO
    x, y = x[clear], deflection[clear]
    at = np.flatnonzero(y[1:] * y[:-1] < 0)
    return np.asarray(x[at] - y[at] * (x[at + 1] - x[at]) / (y[at + 1] - y[at]))


def _faces(ax: "Axes", shape: _Shape, base: float, scale: float) -> None:
    """Both faces of each joint that gives: a dot at each, and what has come between them."""
    vehicle = shape.operators.vehicle
    for joint, station in zip(vehicle.joints, vehicle.boundaries[1:], strict=False):
        if flexible(joint):
            rows = np.concatenate([shape.operators.shape(station, 0, side) for side in ("forward", "aft")])
            y = base + scale * (rows @ shape.q).real
            ax.plot([station, station], y, color=VERMILION, marker="o", markersize=2.8, linewidth=1.2, zorder=5)


def _words(spectrum: Spectrum, number: int, si: bool) -> str:
    """The frequency of a mode, and how it grows or decays if it does."""
    omega, growth = float(spectrum.angular_frequency[number]), float(spectrum.growth_rate[number])
    least = GROWING * math.hypot(omega, growth)
    lines = [f"mode {number + 1}"]
    if omega > least:
        value = f"{omega / (2 * math.pi) if si else omega:#.4g}".rstrip(".")
        lines.append(f"{value} Hz" if si else rf"$\omega$ = {value}")
    if abs(growth) > least:
        manner = "decays" if growth < 0 else "grows" if omega > least else "diverges"
        lines.append(f"{manner}, {abs(growth):#.3g}".rstrip(".") + (" 1/s" if si else ""))
    return "\n".join(lines)
