"""Results as a notebook shows them: what was found in words, the evidence, a figure."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from beal.control import ClosedLoop, ControlLocus
from beal.motion import Response
from beal.notebook.pictures import HIGH, picture
from beal.report import table
from beal.report.numbers import cell, quantity
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve
from beal.study.flight import Flight

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SENSORS = 2.2  # inches, height of the panel of one sensor


def critical(found: CriticalThrust) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : CriticalThrust

    Yields
    ------
    str
    """
    force, frequency = ("N", " rad/s") if found.units == "SI" else ("", "")
    searched = quantity(found.searched_to, force)
    if found.elastic:
        yield _verdict("tumbles as a rigid body under any thrust; of its elastic modes alone:")
        yield from critical(found.elastic)
        return
    rows = []
    if found.critical_thrust is None or found.modes is None:
        yield _verdict(f"stable up to P = {searched}, as far as was searched")
    else:
        yield _verdict(f"{found.kind} at P = {quantity(found.critical_thrust, force, found.error_estimate)}")
        rows += [
            ["modes", " and ".join(str(mode) if mode else "rigid body" for mode in sorted(set(found.modes)))],
            ["angular frequency", f"{cell(found.angular_frequency)}{frequency}"],
            ["error estimate", f"{found.error_estimate:.1e} {force}"],
        ]
        if found.border:
            rows.append(["border", "another kind or pair of modes comes at practically the same thrust"])
    rows += [
        ["searched", f"the {found.watched_modes} lowest elastic modes up to {searched}"],
        ["formulation", found.formulation],
        ["rigid body", found.rigid_body],
    ]
    yield table([], rows)


def curve(found: ThrustCurve) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : ThrustCurve

    Yields
    ------
    str
    """
    points, modes = found.angular_frequency.shape
    title = f"frequencies of {modes} modes over thrust"
    yield picture(lambda plot, on: plot.thrust_curve(found, on.subplots(), nondimensional=found.units != "SI"), title)
    yield f"<p>{title}, {points} points, formulation {found.formulation}; dotted: unstable</p>"


def closed_loop(found: ClosedLoop) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : ClosedLoop

    Yields
    ------
    str
    """
    force, rate = ("N", " [1/s]") if found.units == "SI" else ("", "")
    state = "stable" if found.stable else f"unstable, its motion grows as exp({found.least_damped.real:.4g} t)"
    yield _verdict(f"closed loop at P = {quantity(found.thrust, force)}: {state}")
    if found.drift:
        yield f"<p>{found.drift} zero roots of rigid-body drift</p>"
    rows = [
        [cell(root.real + 0.0), cell(root.imag), cell(ratio)]
        for root, ratio in zip(found.roots.tolist(), found.damping_ratio.tolist(), strict=True)
        if root.imag >= 0 and root
    ]
    yield table([f"real part{rate}", f"imaginary part{rate and ' [rad/s]'}", "damping ratio"], rows, numeric=range(3))


def control_locus(found: ControlLocus) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : ControlLocus

    Yields
    ------
    str
    """
    title = f"roots of the closed loop over {found.over}"
    yield picture(
        lambda plot, on: plot.control_locus(found, on.subplots(), found.units != "SI"), title, height=1.2 * HIGH
    )


def flight(found: Flight) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Flight

    Yields
    ------
    str
    """
    second = " s" if found.units == "SI" else ""
    if np.isfinite(found.margin).any():
        least = int(np.nanargmin(found.margin))
        bound = "at least " if found.at_least[least] else ""
        at = f"at t = {cell(float(found.time[least]))}{second}"
        margin = cell(float(found.margin[least]))
        yield _verdict(f"least margin {bound}{margin} {at}: critical over actual thrust, less 1")
    yield picture(
        lambda plot, on: plot.flight(found, on.subplots()), "frequencies and thrusts over the flight", height=5.2
    )
    for reason in dict.fromkeys(state.reason for state in found.states if state.reason):
        times = ", ".join(cell(state.time) for state in found.states if state.reason == reason)
        yield f"<p>at {times}: {reason}</p>"


def response(found: Response) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Response

    Yields
    ------
    str
    """
    thrust = quantity(found.thrust, "N" if found.units == "SI" else "")
    title = f"motion under P = {thrust}, {len(found.time) - 1} steps of {found.step:.4g} by {found.method}"
    yield picture(lambda plot, on: _histories(found, plot, on), title, height=SENSORS * len(found.sensors) + 0.4)
    yield f"<p>{title}</p>"


def _histories(found: Response, plot: Any, figure: "Figure") -> None:
    """The deflection at each sensor."""
    panels = figure.subplots(len(found.sensors), sharex=True, squeeze=False)
    for sensor, ax in zip(found.sensors, panels[:, 0], strict=True):
        plot.response(found, ax, sensor, nondimensional=found.units != "SI").set_title(sensor)
        ax.label_outer()


def _verdict(text: str) -> str:
    return f'<p class="verdict">{text}</p>'
