"""Results to matplotlib axes: each function draws one result and computes nothing."""

from beal.plot.border import spring_border
from beal.plot.control import control_locus, control_map
from beal.plot.curves import growth_rates, root_locus, thrust_curve
from beal.plot.design import design_map
from beal.plot.drawing import vehicle
from beal.plot.flight import flight
from beal.plot.histories import amplitude_map, amplitude_spectrum, envelope, response, trajectory
from beal.plot.maps import stability_map
from beal.plot.opened import nichols, nyquist
from beal.plot.pareto import pareto_front
from beal.plot.pulsating import floquet_chart, multipliers
from beal.plot.shapes import deflections, mode_shapes
from beal.plot.style import style
from beal.plot.tornado import tornado
from beal.plot.transient import pseudospectrum, transient_growth
from beal.plot.uncertainty import thrust_distribution

__all__ = [
    "amplitude_map",
    "amplitude_spectrum",
    "control_locus",
    "control_map",
    "deflections",
    "design_map",
    "envelope",
    "flight",
    "floquet_chart",
    "growth_rates",
    "mode_shapes",
    "multipliers",
    "nichols",
    "nyquist",
    "pareto_front",
    "pseudospectrum",
    "response",
    "root_locus",
    "spring_border",
    "stability_map",
    "style",
    "thrust_curve",
    "thrust_distribution",
    "tornado",
    "trajectory",
    "transient_growth",
    "vehicle",
]
