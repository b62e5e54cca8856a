"""``beal critical``: the verdict on a vehicle."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.drawn import Plot, show_curve, wanted
from beal.cli.figures import curve_figure, named, new_figure
from beal.cli.loaded import vehicle_of
from beal.cli.options import AsJson, Figure, Formulation, Model
from beal.cli.output import emit, say, show_table
from beal.report.numbers import quantity

if TYPE_CHECKING:
    from beal.stability.complete import Event
    from beal.stability.critical import CriticalThrust
    from beal.stability.curve import ThrustCurve
    from beal.vehicle.vehicle import Vehicle

POINTS = 151  # thrusts of a figure
MOST = 14  # modes in a figure
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
    plot: Plot = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """The smallest thrust at which the vehicle flutters or diverges."""
    from beal.errors import ModelError
    from beal.report.records import critical_record, event_record
    from beal.report.verdict import convention, instability, searched, thrust_unit, verdict
    from beal.stability.critical import critical_events, critical_thrust
    from beal.stability.vanishing import vanishing_damping_limit

    vehicle = vehicle_of(model)
    drawn = wanted(plot, as_json)
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
    transient = None
    if growth is not None:
        from beal.motion import transient_growth

        transient = transient_growth(vehicle, growth)
    if as_json:
        listed = {"events": [event_record(event) for event in events]} if every else {}
        others = {name: other and asdict(other) for name, other in beside.items()}
        growths = {"transient_growth": {name: getattr(transient, name) for name in GROWTH}} if transient else {}
        emit(
            {
                **critical_record(vehicle, found),
                **others,
                **listed,
                **growths,
                **named(figure),
            }
        )
        return
    say(verdict(vehicle, found), _style(vehicle, found))
    for name, other in beside.items():
        told = instability(vehicle, other.elastic or other) if other else "its dead loads alone make it unstable"
        print(f"{BESIDE[name]}: {told}")
    if transient:
        print(
            f"under a thrust of {quantity(transient.thrust, thrust_unit(vehicle))} the energy of a motion may grow "
            f"{transient.growth:.4g}-fold before it comes back"
        )
    print(searched(vehicle, found))
    if about_joints := convention(vehicle, formulation):
        print(about_joints)
    if drawn:
        show_curve(vehicle, _curve(vehicle, found, size, every), found, events)
    if every:
        _show_events(vehicle, events)


def _curve(vehicle: "Vehicle", found: "CriticalThrust", size: int | None, every: bool) -> "ThrustCurve":
    """The modes that meet, and those below, to a little beyond the critical thrust or over all that was searched."""
    from beal.discretisation.build import discretise
    from beal.report.verdict import shown_to
    from beal.stability.curve import MODES, thrust_curve
    from beal.stability.large import Reduction, is_large

    shown = found.elastic or found
    to = found.searched_to if every else shown_to(found)
    highest = max(shown.modes or (0,))
    count = min(highest, size or MOST) if highest > MODES else None
    formulation: Any = found.formulation
    model: Any = vehicle
    if size:
        model = discretise(vehicle, formulation, order=size)
    elif is_large(vehicle):
        model = Reduction(vehicle, formulation).operators  # exact enough to be drawn
    return thrust_curve(model, to, POINTS, count, formulation)


def _style(vehicle: "Vehicle", found: "CriticalThrust") -> str:
    from beal.report.records import relative

    margin = relative(vehicle, found)["margin"]
    return "bold green" if found.kind == "stable" else "bold red" if margin is not None and margin < 0 else "bold"


def _show_events(vehicle: "Vehicle", events: "list[Event]") -> None:
    from beal.report.verdict import thrust_unit

    unit = thrust_unit(vehicle)
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
