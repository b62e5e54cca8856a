"""Answers behind the further charts: margins over a flight, a pulsating thrust, the control loop."""

from typing import Any

import numpy as np

from beal.control import closed_loop, open_loop, stability_margins
from beal.control.opened import frequencies
from beal.errors import ModelError
from beal.report.records import control_record, flight_record, pairs
from beal.study.flight import flight as fly
from beal.study.pulsating import chart_resonances, floquet_chart
from beal.vehicle.vehicle import Vehicle
from beal.web import questions as ask
from beal.web.vehicles import vehicle_of

Answer = dict[str, Any]


def flight(question: ask.Flight) -> Answer:
    """Some of the times of a flight, as ``beal flight --json`` gives them, and the number of all of them."""
    vehicle = vehicle_of(question)
    line = vehicle.timeline
    if line is None:
        raise ModelError([("timeline", "is needed and missing; give [timeline] or a table")])
    some = slice(question.first, question.first + question.count)
    if not line.time[some]:
        raise ModelError([("first", f"must lie below {len(line.time)}, the number of times, found {question.first}")])
    fill = {name: values[some] for name, values in line.fill.items()}
    part = {"time": line.time[some], "thrust": line.thrust[some], "fill": fill, "stages": line.stages[some]}
    found = fly(vehicle.model_copy(update={"timeline": line.model_copy(update=part)}), modes=question.modes)
    return {**flight_record(found), "times": len(line.time)}


def pulsation(question: ask.Pulsation) -> Answer:
    """Stability under P(t) = P0 + P1 cos(W t) over a grid of W and P1, as ``beal floquet`` finds it."""
    vehicle = vehicle_of(question)
    frequencies, amplitudes = question.angular_frequencies, question.amplitudes
    chart = floquet_chart(vehicle, _thrust(vehicle, question.thrust), frequencies, amplitudes, question.modes)
    grids = {name: chart[name].values for name in ("largest_modulus", "growth_rate", "stable")}
    resonances = [{"name": name, "angular_frequency": omega} for name, omega in chart_resonances(chart)]
    beside = {name: chart.attrs[name] for name in ("thrust", "steady_growth_rate", "rigid_body_modes")}
    axes = {"angular_frequency": frequencies, "amplitude": amplitudes}
    return {**axes, **grids, "resonances": resonances, **beside, "units": vehicle.units}


def loop(question: ask.Loop) -> Answer:
    """The closed loop as ``beal control --json`` gives it, and the open one over the frequency."""
    vehicle = vehicle_of(question)
    thrust = _thrust(vehicle, question.thrust)
    found = closed_loop(vehicle, thrust, question.modes)
    margins = stability_margins(vehicle, thrust, question.modes)
    opened = open_loop(vehicle, thrust, question.modes)
    omega = frequencies(opened)
    L = np.array([opened.frequency_response(w)[0, 0] for w in omega])
    return {**control_record(vehicle, found, margins), "open_loop": {"angular_frequency": omega, "value": pairs(L)}}


def _thrust(vehicle: Vehicle, given: float | None) -> float:
    thrust = vehicle.thrust.nominal if given is None else given
    if thrust is None:
        raise ModelError([("thrust", "is needed; give it, or thrust.nominal in the model")])
    return thrust
