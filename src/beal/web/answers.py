"""Answers to the page: thin, on the public functions, as JSON objects that equal those of the command."""

from typing import Any

import numpy as np

from beal.control import control_locus
from beal.discretisation.build import RITZ, discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.motion import ModeShape
from beal.motion import response as motion_of
from beal.report.records import critical_record, curve_record, event_record, modes_record, response_record
from beal.report.verdict import convention, searched, shown_to, verdict
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.large import Reduction, is_large, operators_over_thrust
from beal.stability.limit import default_limit
from beal.stability.modes import converged_modes
from beal.stability.spectrum import Spectrum, spectrum
from beal.study.batch import WORTHWHILE
from beal.study.solve import solve_points
from beal.study.study import Solve, Study
from beal.study.variables import KINDS, STATUS
from beal.vehicle.file import dumps
from beal.vehicle.paths import value_at
from beal.vehicle.vehicle import Vehicle
from beal.web import questions as ask
from beal.web.code import command_lines, python_lines
from beal.web.vehicles import base_of, controls, described, opened, vehicle_of

FEW = 21  # points of the curves of a draft
DRAWN = 24  # points of a mode shape in each stage
Answer = dict[str, Any]


def model(question: ask.Question) -> Answer:
    """The resolved model, as text and as a summary, with the sliders and choices that it has."""
    base, vehicle = base_of(question), vehicle_of(question)
    return {"model": dumps(vehicle), "vehicle": described(vehicle), **controls(base, vehicle)}


def dropped(question: ask.Dropped) -> Answer:
    """The model in a file, and how it was read."""
    found = opened(question)
    return {"model": dumps(found.vehicle), "notes": found.notes, "ignored": found.ignored}


def critical(question: ask.Critical) -> Answer:
    """The first instability, as ``beal critical --json`` gives it, and the verdict in words."""
    vehicle = vehicle_of(question)
    found = critical_thrust(vehicle, question.max_thrust, question.formulation)
    answer = {**critical_record(vehicle, found), "verdict": verdict(vehicle, found)}
    if question.every:
        events = critical_events(vehicle, question.max_thrust, question.formulation)
        answer["events"] = [event_record(event) for event in events]
    return answer


def curve(question: ask.Curve) -> Answer:
    """Modes over thrust, as ``beal curve --json`` gives them."""
    vehicle = vehicle_of(question)
    to = question.to or shown_to(critical_thrust(vehicle, None, question.formulation))
    found = thrust_curve(vehicle, to, question.points, question.modes, question.formulation)
    return curve_record(vehicle, found)


def modes(question: ask.Modes) -> Answer:
    """Frequencies at a thrust, as ``beal modes --json`` gives them, and the mode shapes."""
    vehicle = vehicle_of(question)
    found, error = converged_modes(vehicle, question.thrust, question.count, question.formulation)
    operators = discretise(vehicle, question.formulation)
    shapes = _shapes(operators, spectrum(operators, question.thrust, question.count))
    return {**modes_record(vehicle, found, error, question.formulation), "shapes": shapes}


def draft(question: ask.Solve) -> Answer:
    """Curves and mode shapes as ``solve`` gives them, roughly and soon; of large vehicles good to some 0.01 %."""
    vehicle = vehicle_of(question)
    operators = Reduction(vehicle, question.formulation).operators if _is_large(question, vehicle) else None
    return _seen(question, vehicle, operators, question.to or default_limit(vehicle), min(question.points, FEW))


def solve(question: ask.Solve) -> Answer:
    """What a move of a slider changes: the vehicle, its verdict, its curves, and mode shapes at a thrust."""
    vehicle = vehicle_of(question)
    found = critical_thrust(vehicle, None, question.formulation)
    to = question.to or shown_to(found)
    large = _is_large(question, vehicle)
    operators = operators_over_thrust(vehicle, question.formulation, to, question.modes) if large else None
    return {
        **_seen(question, vehicle, operators, to, question.points),
        "critical": critical_record(vehicle, found),
        "verdict": verdict(vehicle, found),
        "searched": searched(vehicle, found),
        "convention": convention(vehicle, question.formulation),
    }


def _is_large(question: ask.Solve, vehicle: Vehicle) -> bool:
    """Whether its dense operators would take too long."""
    return is_large(vehicle) and question.formulation not in RITZ


def _seen(question: ask.Solve, vehicle: Vehicle, operators: Operators | None, to: float, points: int) -> Answer:
    """The vehicle, its curves and its shapes, from the usual operators unless others are given."""
    operators = operators or discretise(vehicle, question.formulation)
    count = min(question.modes, len(operators.M) - operators.rigid)
    curve = thrust_curve(operators, to, points, count, question.formulation)
    nominal = vehicle.thrust.nominal or 0.0
    thrust = nominal if question.thrust is None else question.thrust
    shapes = _shapes(operators, spectrum(operators, thrust, count))
    return {"vehicle": described(vehicle), "curve": curve_record(vehicle, curve), "shapes": shapes}


def map_points(question: ask.Map) -> Answer:
    """Critical thrusts at points in the plane of two quantities, as ``beal map`` finds them."""
    one, other = question.axes
    if one == other:
        raise ModelError([("axes", f"must be two quantities, found {one} twice")])
    vehicle = vehicle_of(question)
    axes = {path: (value_at(vehicle, path),) for path in question.axes}
    study = Study(vehicle, axes, Solve(formulation=question.formulation))
    points = np.array(question.points)
    few = WORTHWHILE - 1 if is_large(vehicle) else len(points)  # so few that no tables are made, which take long then
    parts = [solve_points(study, points[n : n + few]) for n in range(0, len(points), few)]
    names = ("critical_thrust", "kind", "mode_low", "mode_high", "angular_frequency", "status")
    found = {name: np.concatenate([part[name] for part in parts]) for name in names}
    return {**found, "kinds": KINDS, "statuses": STATUS}


def response(question: ask.Response) -> Answer:
    """Motion at the sensors, as ``beal response --method exact --json`` gives it."""
    vehicle = vehicle_of(question)
    operators = discretise(vehicle)
    start = ModeShape(question.mode, question.amplitude) if question.mode else None
    step = question.duration / (question.points - 1)
    options: dict[str, Any] = {"step": step, "method": "exact", "initial": start, "rigid_body": not question.elastic}
    found = motion_of(operators, question.duration, question.thrust, **options)
    growth = float(spectrum(operators, found.thrust, count=6).growth_rate.max())
    return response_record(vehicle, found, growth)


def locus(question: ask.Locus) -> Answer:
    """Roots of the closed loop, followed over a quantity."""
    vehicle = vehicle_of(question)
    found = control_locus(vehicle, question.over, question.at, question.thrust, question.modes)
    return {"over": found.over, "values": found.values, "real": found.roots.real, "imag": found.roots.imag}


def code(question: ask.Curve) -> Answer:
    """The same as a model file, as lines of Python, and as command lines."""
    vehicle = vehicle_of(question)
    text = dumps(vehicle)
    options = (text, question.formulation, question.to, question.points, question.modes)
    return {"toml": text, "python": python_lines(*options), "command": command_lines(*options)}


def _shapes(operators: Operators, found: Spectrum) -> Answer:
    """Mode shapes stage by stage, of largest deflection 1, with the roots s that they move by."""
    vehicle = operators.vehicle
    ends = zip(vehicle.boundaries, vehicle.boundaries[1:], strict=False)
    x = np.array([np.linspace(a, b, DRAWN) for a, b in ends])
    rows = operators.shape(x.ravel(), side="aft")
    last = slice(DRAWN - 1, None, DRAWN)
    rows[last] = operators.shape(x[:, -1], side="forward")
    deflection = rows @ found.shapes
    largest = deflection[np.abs(deflection).argmax(axis=0), np.arange(deflection.shape[1])]
    deflection = (deflection / largest).T.reshape(-1, *x.shape)
    parts = {"real": deflection.real, "imag": deflection.imag}
    return {
        "thrust": found.thrust,
        "station": x,
        "angular_frequency": found.angular_frequency,
        "growth_rate": found.growth_rate + 0.0,
        **parts,
    }
