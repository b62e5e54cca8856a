"""The vehicle itself, drawn along its axis: stages, joints, masses, supports, loads and sensors."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Polygon

from beal.plot.body import Section, flexible, gap, sections
from beal.plot.captions import Caption, arranged, height, write
from beal.plot.style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, TINTS, VERMILION, along, axes, fitted, style
from beal.plot.symbols import LINE, arrow, coil, disc, ground, pin, spring
from beal.vehicle.parts import DistributedThrust, Joint
from beal.vehicle.stations import values
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# All over the length of the vehicle
MASS = 0.11  # radius of a disc that stands for the mass of the whole vehicle
SYMBOL = 0.024  # size of springs and supports
ARROW = 0.10
BESIDE = 0.015  # between the body and what is drawn beside it
SPACING = 0.05  # of the arrows of a distributed load, and of the springs of a foundation
MARGIN = 0.02
TANK = 0.75  # width over that of the body

Captions = Iterator[Caption]


@dataclass(frozen=True)
class _Sketch:
    """A vehicle and the axes that it is drawn on."""

    ax: "Axes"
    vehicle: Vehicle

    @property
    def length(self) -> float:
        return self.vehicle.length

    @cached_property
    def bodies(self) -> list[Section]:
        return sections(self.vehicle)

    def half_width(self, station: float) -> float:
        """Of the body at a station; in a gap or a step that of the wider side."""
        x, half = (np.concatenate([getattr(body, name) for body in self.bodies]) for name in ("x", "half_width"))
        first, last = np.searchsorted(x, station, "left"), np.searchsorted(x, station, "right")
        return float(half[max(first - 1, 0) : last + 1].max())


def vehicle(vehicle: Vehicle, ax: "Axes | None" = None) -> "Axes":
    """Draw a vehicle to scale along its axis, the nose at the left.

    The width of the body is a symbol: it goes with EI^(1/4), as the radius of similar sections of one material does.
    The area of a point mass goes with its mass. A rigid joint is a line; a joint that gives is a gap with a circle for
    its rotational and a zigzag for its shear spring. Arrows are loads: thrust and axial loads along the axis,
    transverse forces across it.

    Parameters
    ----------
    vehicle : Vehicle
    ax : Axes, optional

    Returns
    -------
    Axes
        With equal units along both axes, so that nothing is distorted.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from beal.vehicle.catalog import tsto
    >>> ax = vehicle(tsto(0.6, 5000.0, 5000.0), Figure().subplots())
    >>> sorted(text.get_text() for text in ax.texts)
    ['$P$, follower', '$k_r$, $k_s$', 'imu', 'lower', 'upper']
    """
    with style():
        target = axes(ax)
        sketch = _Sketch(target, vehicle)
        _supports(sketch)
        _foundation(sketch)
        above = [caption for part in (_stages, _thrust, _distributed, _sensors) for caption in part(sketch)]
        below = [caption for part in (_tanks, _joints, _masses, _axial_loads, _forces) for caption in part(sketch)]
        target.plot([0.0, vehicle.length], [0.0, 0.0], color=GREY, linewidth=0.6, dashes=(9, 3, 2, 3), zorder=3)
        _frame(sketch, above, below, own=ax is None)
        return target


def _stages(sketch: _Sketch) -> Captions:
    for number, (stage, body) in enumerate(zip(sketch.vehicle.stages, sketch.bodies, strict=True)):
        look = {"facecolor": TINTS[number % 2], "edgecolor": BLACK, "linewidth": 0.9, "zorder": 2}
        sketch.ax.add_patch(Polygon(body.outline(), closed=True, label=stage.name, **look))
        if stage.name:
            middle = float(body.x[0] + body.x[-1]) / 2
            yield Caption(middle, sketch.half_width(middle), stage.name)


def _joints(sketch: _Sketch) -> Captions:
    for number, joint in enumerate(sketch.vehicle.joints):
        x = sketch.vehicle.boundaries[number + 1]
        half = sketch.half_width(x)
        if flexible(joint):
            _springs(sketch.ax, joint, x, half, gap(sketch.vehicle, number))
        springs = {"$k_r$": joint.rotational_stiffness, "$k_s$": joint.shear_stiffness}
        given = ", ".join(symbol for symbol, stiffness in springs.items() if math.isfinite(stiffness))
        if text := f"{joint.name} ({given})" if joint.name and given else joint.name or given:
            yield Caption(x, -half, text)


def _springs(ax: "Axes", joint: Joint, x: float, half: float, width: float) -> None:
    """What lies in the gap of a joint: a zigzag and a circle, one over the other where both springs give."""
    turns, slides = math.isfinite(joint.rotational_stiffness), math.isfinite(joint.shear_stiffness)
    if slides:
        foot = 0.0 if turns else -half
        ax.plot([x - width, x], [half, half], **LINE)
        ax.plot([x + width, x], [foot, foot], **LINE)
        spring(ax, (x, half), (x, foot), 0.7 * width, teeth=2 if turns else 3)
    if turns:
        y = -0.55 * half if slides else 0.0
        ax.plot([x - width, x + width], [y, y], **LINE)
        disc(ax, (x, y), min(0.6 * width, 0.4 * half), facecolor=ORANGE, zorder=5)


def _tanks(sketch: _Sketch) -> Captions:
    """Tanks inside the body, their liquid at the aft end."""
    for tank in sketch.vehicle.tanks:
        along_it = np.linspace(tank.forward_end, tank.aft_end, 41)
        half = np.full(2, TANK * min(sketch.half_width(station) for station in along_it))
        for front, color in ((tank.forward_end, "white"), (tank.surface, SKY)):
            look = {"facecolor": color, "edgecolor": BLACK, "linewidth": 0.6, "zorder": 2.5}
            outline = Section(np.array([front, tank.aft_end]), half).outline()
            sketch.ax.add_patch(Polygon(outline, closed=True, **look))
        middle = (tank.forward_end + tank.aft_end) / 2
        yield Caption(middle, -sketch.half_width(middle), tank.name)


def _masses(sketch: _Sketch) -> Captions:
    joints = dict(zip(sketch.vehicle.boundaries[1:], range(len(sketch.vehicle.joints)), strict=False))
    for point in sketch.vehicle.point_masses:
        x = point.station + (gap(sketch.vehicle, joints[point.station]) if point.station in joints else 0.0)
        radius = MASS * sketch.length * math.sqrt(point.mass / sketch.vehicle.mass)
        disc(sketch.ax, (x, 0.0), radius, facecolor=GREY, alpha=0.75, zorder=4)
        if point.name:
            yield Caption(x, -radius, point.name)


def _sensors(sketch: _Sketch) -> Captions:
    for sensor in sketch.vehicle.sensors:
        y = sketch.half_width(sensor.station) + BESIDE * sketch.length
        sketch.ax.plot(sensor.station, y, marker="v", color=GREEN, markeredgecolor=BLACK, markeredgewidth=0.6, zorder=5)
        yield Caption(sensor.station, y, sensor.name)


def _thrust(sketch: _Sketch) -> Captions:
    thrust = sketch.vehicle.thrust
    if not thrust.scale:
        return
    x = sketch.length if thrust.station is None else thrust.station
    held = x == sketch.length and sketch.vehicle.support.stiffness[1][1]
    tip = x + (2 * SYMBOL * sketch.length if held else 0.0)
    tail = tip + ARROW * sketch.length
    arrow(sketch.ax, (tail, 0.0), (tip, 0.0), VERMILION, width=2.2, head=13.0)
    manner = {0.0: "fixed in space", 1.0: "follower"}.get(thrust.tangency, rf"$\eta$ = {thrust.tangency:g}")
    share = "" if thrust.scale == 1 else f"{thrust.scale:g} "
    yield Caption((tip + tail) / 2, 0.0, f"{share}$P$, {'fixed line' if thrust.line == 'fixed' else manner}")


def _distributed(sketch: _Sketch) -> Captions:
    for load in sketch.vehicle.distributed_thrusts:
        yield from _row(sketch, load)


def _row(sketch: _Sketch, load: DistributedThrust) -> Captions:
    """Arrows beside the body, as long as the load there."""
    x = np.linspace(0.0, sketch.length, round(1 / SPACING) + 1)
    value = values(load.value, x)
    reach = 0.9 * SPACING * sketch.length * value / abs(value).max(initial=np.finfo(float).tiny)
    for station, long in zip(x.tolist(), reach.tolist(), strict=True):
        if abs(long) > 0.2 * SPACING * sketch.length:
            for side in (1, -1):
                y = side * (sketch.half_width(station) + BESIDE * sketch.length)
                ends = (min(max(station + way * long / 2, 0.0), sketch.length) for way in (1, -1))
                start, tip = ((end, y) for end in ends)
                arrow(sketch.ax, start, tip, VERMILION, width=0.9, head=5.0)
    middle = sketch.length / 2
    yield Caption(middle, sketch.half_width(middle) + 2 * BESIDE * sketch.length, "distributed thrust")


def _axial_loads(sketch: _Sketch) -> Captions:
    for load in sketch.vehicle.axial_loads:
        if load.force:
            tail = load.station + math.copysign(ARROW * sketch.length, load.force)
            arrow(sketch.ax, (tail, 0.0), (load.station, 0.0), PURPLE)
            yield Caption((load.station + tail) / 2, 0.0, load.name or "axial load")
    if sketch.vehicle.gravity:
        x, y = sketch.vehicle.centre_of_mass, -sketch.half_width(sketch.vehicle.centre_of_mass) - BESIDE * sketch.length
        way = math.copysign(ARROW * sketch.length, sketch.vehicle.gravity)
        arrow(sketch.ax, (x, y), (x + way, y), PURPLE, width=1.2, head=8.0)
        yield Caption(x + way / 2, y, "$g$")


def _forces(sketch: _Sketch) -> Captions:
    for force in sketch.vehicle.forces:
        tip = -sketch.half_width(force.station)
        arrow(sketch.ax, (force.station, tip - ARROW * sketch.length), (force.station, tip), BLUE)
        yield Caption(force.station, tip - ARROW * sketch.length, force.name or "$F(t)$")


def _supports(sketch: _Sketch) -> None:
    nose, tail = sketch.vehicle.support.stiffness
    _support(sketch, 0.0, -1.0, *nose)
    _support(sketch, sketch.length, 1.0, *tail)


def _support(sketch: _Sketch, x: float, outward: float, translation: float, rotation: float) -> None:
    """A wall, a pin, rollers on a wall, springs: what holds deflection stands below, what holds the slope beyond."""
    ax, size, half = sketch.ax, SYMBOL * sketch.length, sketch.half_width(x)
    wall = (-outward, 0.0)
    if math.isinf(rotation):
        held = math.isinf(translation)
        roller = 0.0 if held else size / 3
        for side in (-0.6, 0.6) if roller else ():
            disc(ax, (x + outward * roller, side * half), roller, facecolor="white", zorder=3)
        ground(ax, (x + 2 * outward * roller, 0.0), half + size, wall)
    elif rotation:
        coil(ax, (x + outward * size, 0.0), size, outward)
        ground(ax, (x + 2 * outward * size, 0.0), size, wall)
    if math.isinf(translation) and not math.isinf(rotation):
        pin(ax, (x, 0.0), half + size)
    elif 0 < translation < math.inf:
        spring(ax, (x, -half), (x, -half - 2.5 * size), size / 2)
        ground(ax, (x, -half - 2.5 * size), size, (0.0, 1.0))


def _foundation(sketch: _Sketch) -> None:
    size = SYMBOL * sketch.length
    for stage, front in zip(sketch.vehicle.stages, sketch.vehicle.boundaries, strict=False):
        number = max(1, round(stage.length / (SPACING * sketch.length)))
        x = (np.arange(number) + 0.5) * stage.length / number
        for station, stiffness in zip(
            (front + x).tolist(), values(stage.foundation_stiffness, x).tolist(), strict=True
        ):
            if stiffness:
                top = -sketch.half_width(station)
                spring(sketch.ax, (station, top), (station, top - 2 * size), size / 3)
                ground(sketch.ax, (station, top - 2 * size), size / 2, (0.0, 1.0))


def _frame(sketch: _Sketch, above: list[Caption], below: list[Caption], own: bool) -> None:
    """Limits around all that is drawn, with the captions beyond; too low axes shrink drawing and letters alike."""
    ax, margin = sketch.ax, MARGIN * sketch.length
    left, bottom, right, top = (ax.dataLim.extents + margin * np.array([-1, -1, 1, 1])).tolist()
    wide, high = (np.array(ax.get_window_extent().size) * 72 / ax.figure.dpi).tolist()
    scale = wide / (right - left)
    over, under = (arranged(captions, left, right, scale) for captions in (above, below))
    ends = bottom - height(under, scale), top + height(over, scale)
    shrunk = 1.0 if own else min(1.0, high / (ends[1] - ends[0]) / scale)
    write(ax, over, top, scale, shrunk)
    write(ax, under, bottom, scale, shrunk)
    ax.set(xlim=(left, right), ylim=ends, aspect="equal", yticks=[])
    along(ax, sketch.vehicle)
    if own:
        fitted(ax)
