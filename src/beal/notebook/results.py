"""Results as a notebook shows them: what was found in words, the evidence, a figure."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from beal.motion import Response
from beal.notebook.pictures import HIGH, picture, verdict
from beal.report import table
from beal.report.numbers import cell, digits, quantity
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve
from beal.stability.floquet import Floquet
from beal.stability.spectrum import Spectrum
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
        yield verdict("tumbles as a rigid body under any thrust; of its elastic modes alone:")
        yield from critical(found.elastic)
        return
    rows = []
    if found.critical_thrust is None or found.modes is None:
        yield verdict(f"stable up to P = {searched}, as far as was searched")
    else:
        yield verdict(f"{found.kind} at P = {quantity(found.critical_thrust, force, found.error_estimate)}")
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


def spectrum(found: Spectrum) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Spectrum

    Yields
    ------
    str
    """
    si = found.units == "SI"
    yield verdict(f"elastic modes at P = {quantity(found.thrust, 'N' if si else '')}")
    order = found.angular_frequency.argsort(kind="stable")
    rows = []
    for number, mode in enumerate(order, 1):
        omega, growth = float(found.angular_frequency[mode]), float(found.growth_rate[mode]) + 0.0  # no -0
        rows.append([number, cell(omega), *([cell(omega / (2 * np.pi))] if si else []), cell(growth)])
    names = ["angular frequency [rad/s]", "frequency [Hz]", "growth rate [1/s]"]
    header = ["mode", *(names if si else ["angular frequency", "growth rate"])]
    yield table(header, rows, numeric=range(len(header)))
    yield f"<p>rigid-body modes, not listed: {found.rigid_body_modes}</p>"


def floquet(found: Floquet) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Floquet

    Yields
    ------
    str
    """
    force = "N" if found.units == "SI" else ""
    state = "stable" if found.stable else f"unstable, its motion grows as exp({found.growth_rate:.4g} t)"
    mean, swing = (quantity(thrust, force) for thrust in (found.thrust, found.amplitude))
    yield verdict(f"P = {mean} + {swing} cos({cell(found.angular_frequency)} t): {state}")
    if found.steady_growth_rate > 0:
        yield "<p>unstable already without the pulsation</p>"
    yield picture(lambda plot, on: plot.multipliers(found, on.subplots()), "multipliers of a period", height=1.2 * HIGH)
    modulus = digits(found.largest_modulus, found.error_estimate)
    rows = [["largest modulus of the multipliers", modulus]]
    if near := found.resonance:
        rows.append(["nearest resonance", f"{near.name} = {cell(near.angular_frequency)}"])
    rows.append(["rigid-body motions left out", str(found.rigid_body_modes)])
    yield table([], rows)


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
        yield verdict(f"least margin {bound}{margin} {at}: critical over actual thrust, less 1")
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
