"""Results to matplotlib axes: each function draws one result and computes nothing."""

from beal.plot.curves import thrust_curve
from beal.plot.flight import flight
from beal.plot.histories import response, trajectory
from beal.plot.maps import stability_map
from beal.plot.shapes import mode_shapes
from beal.plot.style import style

__all__ = ["flight", "mode_shapes", "response", "stability_map", "style", "thrust_curve", "trajectory"]
