"""The control loop as a notebook shows it: roots, margins, the largest thrust."""

from collections.abc import Iterator

from beal.control import ClosedLoop, ControlledThrust, ControlLocus, Margins
from beal.notebook.pictures import HIGH, picture, verdict
from beal.report import table
from beal.report.numbers import cell, quantity


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
    yield verdict(f"closed loop at P = {quantity(found.thrust, force)}: {state}")
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


def margins(found: Margins) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Margins

    Yields
    ------
    str
    """
    si = found.units == "SI"
    at = f"at P = {quantity(found.thrust, 'N' if si else '')}"
    gain, phase = found.smallest_gain, found.smallest_phase
    smallest = [f"{cell(gain.decibel)} dB"] if gain else []
    smallest += [f"{cell(phase.degrees)} degrees"] if phase else []
    if not smallest:
        yield verdict(f"no margins {at}: the loop never meets the critical point")
        return
    yield verdict(f"smallest margins {at}: {' and '.join(smallest)}")
    rows = [
        (each.angular_frequency, "gain", each.mode, f"{cell(each.decibel)} dB", f"factor {cell(each.factor)}")
        for each in found.gain
    ]
    rows += [
        (each.angular_frequency, "phase", each.mode, f"{cell(each.degrees)} degrees", f"delay {cell(each.delay)}")
        for each in found.phase
    ]
    header = [f"angular frequency{' [rad/s]' * si}", "", "near", "margin", f"the same as{' [s]' * si}"]
    body = [
        [cell(omega), kind, f"mode {mode}" if mode else "rigid body", *rest]
        for omega, kind, mode, *rest in sorted(rows)
    ]
    yield table(header, body, numeric=[0])
    yield "<p>Whether the loop is stable, its roots say, not its margins.</p>"


def controlled(found: ControlledThrust) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : ControlledThrust

    Yields
    ------
    str
    """
    force, rate = ("N", " rad/s") if found.units == "SI" else ("", "")
    searched = quantity(found.searched_to, force)
    rows = [["searched", f"the {found.watched_modes} lowest elastic modes up to {searched}"]]
    if found.critical_thrust is None:
        yield verdict(f"with the loop closed: stable up to P = {searched}, as far as was searched")
    elif not found.critical_thrust:
        yield verdict("with the loop closed: unstable under any thrust")
    else:
        thrust = quantity(found.critical_thrust, force, found.error_estimate)
        yield verdict(f"with the loop closed: {found.kind} at P = {thrust}")
        rows = [
            ["angular frequency", f"{cell(found.angular_frequency)}{rate}"],
            ["error estimate", f"{found.error_estimate:.1e} {force}".rstrip()],
            *rows,
        ]
    yield table([], rows)
