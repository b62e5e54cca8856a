"""``beal critical``: the verdict on a vehicle."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import curve_figure, named, new_figure
from beal.cli.options import AsJson, Figure, Formulation, Model
from beal.cli.output import emit, quantity, show_table

if TYPE_CHECKING:
    from beal.stability.complete import Event
    from beal.stability.critical import CriticalThrust
    from beal.stability.curve import ThrustCurve
    from beal.vehicle.vehicle import Vehicle

DRAWN, POINTS = 1.3, 151  # thrusts of a figure: over the critical one, and their number
FEWEST, MOST = 4, 14  # modes in a figure
GROWTH = ("thrust", "growth", "instant", "lower_bound", "upper_bound")
BESIDE = {"undamped": "without its damping", "vanishing_damping": "in the limit of vanishing damping"}


def critical(
    model: Model,
    max_thrust: Annotated[float | None, typer.Option("--max-thrust", metavar="P", help="Search up to there.")] = None,
    every: Annotated[bool, typer.Option("--all", help="All changes of stability, in order of thrust.")] = False,
    formulation: Formulation = "objective",
    size: Annotated[int | None, typer.Option("--modes", metavar="N", help="Size of the Ritz formulations.")] = None,
    complete: Annotated[bool, typer.Option("--complete", help="By one eigenvalue problem, without a search.")] = False,
    growth: Annotated[
        float | None,
        typer.Option("--growth", metavar="P", help="Also the largest transient growth of energy under that thrust."),
    ] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """The smallest thrust at which the vehicle flutters or diverges."""
    from beal.errors import ModelError
    from beal.interop.files import load
    from beal.motion import transient_growth
    from beal.stability.critical import critical_events, critical_thrust
    from beal.stability.vanishing import vanishing_damping_limit

    vehicle = load(model)
    with new_figure(figure, as_json) as draw:
        found = critical_thrust(
            vehicle,
            max_thrust,
            formulation,  # type: ignore[arg-type]  # checked there
            modes=size,
            method="complete" if complete else "fast",
        )
        events = critical_events(vehicle, max_thrust, formulation, size) if every else []  # type: ignore[arg-type]
        draw(lambda: curve_figure(vehicle, _curve(vehicle, found, size, every), found, events))
    beside: dict[str, CriticalThrust | None] = {}
    if vehicle.damped:
        try:
            beside["undamped"] = critical_thrust(vehicle.undamped, max_thrust, formulation)  # type: ignore[arg-type]
            beside["vanishing_damping"] = vanishing_damping_limit(vehicle, max_thrust, formulation)  # type: ignore[arg-type]
        except ModelError:  # the damping is what bears the dead loads: all else was checked above
            beside = dict.fromkeys(BESIDE)
    transient = None if growth is None else transient_growth(vehicle, growth)
    if as_json:
        listed = {"events": [_event(event) for event in events]} if every else {}
        others = {name: other and asdict(other) for name, other in beside.items()}
        told = {"transient_growth": {name: getattr(transient, name) for name in GROWTH}} if transient else {}
        emit(
            {
                **asdict(found),
                **_relative(vehicle, found),
                "units": vehicle.units,
                **others,
                **listed,
                **told,
                **named(figure),
            }
        )
        return
    print(_verdict(vehicle, found))
    for name, other in beside.items():
        verdict = instability(vehicle, other.elastic or other) if other else "its dead loads alone make it unstable"
        print(f"{BESIDE[name]}: {verdict}")
    if transient:
        print(
            f"under a thrust of {quantity(transient.thrust, _thrust_unit(vehicle))} the energy of a motion may grow "
            f"{transient.growth:.4g}-fold before it comes back"
        )
    print(_searched(vehicle, found))
    if convention := _convention(vehicle, formulation):
        print(convention)
    if every:
        _show_events(vehicle, events)


def _curve(vehicle: "Vehicle", found: "CriticalThrust", size: int | None, every: bool) -> "ThrustCurve":
    """The modes that meet, and those below, to a little beyond the critical thrust or over all that was searched."""
    from beal.discretisation.build import discretise
    from beal.stability.curve import thrust_curve

    shown = found.elastic or found
    to = found.searched_to if every or not shown.critical_thrust else DRAWN * shown.critical_thrust
    count = min(max(FEWEST, *(shown.modes or (0,))), size or MOST)
    formulation: Any = found.formulation
    return thrust_curve(
        discretise(vehicle, formulation, order=size) if size else vehicle, to, POINTS, count, formulation
    )


def _relative(vehicle: "Vehicle", found: "CriticalThrust") -> dict[str, float | None]:
    """P L^2/EI, and the margin over the nominal thrust."""
    thrust, nominal = found.critical_thrust, vehicle.thrust.nominal
    return {
        "nondimensional_thrust": None if thrust is None else thrust / vehicle.scales.thrust,
        "margin": None if thrust is None or nominal is None else thrust / nominal - 1,
    }


def _event(event: "Event") -> dict[str, Any]:
    return {
        "thrust": event.thrust,
        "kind": event.kind,
        "modes": event.modes,
        "angular_frequency": math.sqrt(max(event.W, 0.0)),
        "change": event.change,
        "unstable": event.unstable,
    }


def _verdict(vehicle: "Vehicle", found: "CriticalThrust") -> str:
    if found.elastic is not None:
        elastic = instability(vehicle, found.elastic)
        return f"tumbles as a rigid body under any thrust; its elastic modes alone: {elastic}"
    return f"{vehicle.title}: {instability(vehicle, found)}" if vehicle.title else instability(vehicle, found)


def instability(vehicle: "Vehicle", found: "CriticalThrust") -> str:
    """One sentence: how, at which thrust, in which modes, at which frequency, with which margin."""
    thrust, unit = found.critical_thrust, _thrust_unit(vehicle)
    if thrust is None or found.modes is None or found.angular_frequency is None:
        return f"stable up to {quantity(found.searched_to, unit)}, as far as was searched"
    if thrust == 0 and found.angular_frequency:
        return f"flutters under any thrust: damping feeds {_mode(found.modes[0])}"
    if thrust == 0:
        return "is unstable at any thrust: it folds or slides without resistance"
    relative = _relative(vehicle, found)
    scale = vehicle.scales.thrust
    group = quantity(thrust / scale, "", None if found.error_estimate is None else found.error_estimate / scale)
    value = f"P L^2/EI = {group}"
    if unit or scale != 1:
        value = f"{quantity(thrust, unit, found.error_estimate)} ({value})"
    if found.kind == "flutter":
        text = f"flutters at {value}: {_meeting(found.modes)} at {_frequency(vehicle, found.angular_frequency)}"
    else:
        text = f"diverges at {value}: the frequency of {_mode(found.modes[0])} falls to zero"
    margin = relative["margin"]
    if margin is None:
        return text
    return (
        f"{text}; margin {100 * margin:+.2f} % over the nominal thrust {quantity(vehicle.thrust.nominal or 0.0, unit)}"
    )


def _thrust_unit(vehicle: "Vehicle") -> str:
    return "N" if vehicle.units == "SI" else ""


def _meeting(pair: tuple[int, int]) -> str:
    if pair[0] == pair[1]:  # damped
        return f"{_mode(pair[0])} begins to grow"
    return f"modes {pair[0]} and {pair[1]} meet" if all(pair) else f"the rigid-body motion and mode {max(pair)} meet"


def _mode(number: int) -> str:
    return f"mode {number}" if number else "the rigid-body motion"


def _frequency(vehicle: "Vehicle", omega: float) -> str:
    if vehicle.units == "SI":
        return f"{omega / (2 * math.pi):.6g} Hz ({omega:.6g} rad/s)"
    return f"an angular frequency of {omega:.6g}"


def _searched(vehicle: "Vehicle", found: "CriticalThrust") -> str:
    reached = found.elastic or found
    text = f"searched: the {found.watched_modes} lowest elastic modes"
    text += f" up to {quantity(found.searched_to, _thrust_unit(vehicle))}, formulation {found.formulation}"
    if reached.critical_thrust and reached.error_estimate is not None:
        text += f", relative error about {reached.error_estimate / reached.critical_thrust:.0e}"
    return text


def _convention(vehicle: "Vehicle", formulation: str) -> str:
    """Which couple a joint that slides under the axial force carries."""
    if not any(math.isfinite(joint.shear_stiffness) for joint in vehicle.joints):
        return ""
    if formulation != "objective":
        return "joints: shear axis inertial, by the formulation (such a joint does not balance moments)"
    axes = {joint.shear_axis for joint in vehicle.joints if math.isfinite(joint.shear_stiffness)}
    if len(axes) == 1:
        warning = " (such a joint does not balance moments)" if "inertial" in axes else ""
        return f"joints: shear axis {axes.pop()}{warning}"
    return "joints: shear axes " + ", ".join(joint.shear_axis for joint in vehicle.joints) + ", from nose to tail"


def _show_events(vehicle: "Vehicle", events: "list[Event]") -> None:
    unit = _thrust_unit(vehicle)
    rows = [
        [
            f"{event.thrust:.9g}",
            event.kind,
            event.modes[0] if event.modes[0] == event.modes[1] else f"{event.modes[0]}-{event.modes[1]}",
            math.sqrt(max(event.W, 0.0)),
            event.change,
            event.unstable,
        ]
        for event in events
    ]
    frequency = "angular frequency" + (" [rad/s]" if unit else "")
    columns = [f"thrust{' [N]' if unit else ''}", "kind", "modes", frequency, "change", "unstable roots above"]
    show_table(columns, rows, "all changes of stability")
