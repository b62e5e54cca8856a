"""The control loop: sensors, gains, filters and the actuator that turns the thrust."""

from beal.control.closed import ClosedLoop, closed_loop
from beal.control.locus import ControlLocus, control_locus
from beal.control.map import control_map
from beal.control.margins import GainMargin, Margins, PhaseMargin, stability_margins
from beal.control.opened import open_loop
from beal.control.state_space import StateSpace, state_space
from beal.control.thrust import ControlledThrust, controlled_thrust

__all__ = [
    "ClosedLoop",
    "ControlLocus",
    "ControlledThrust",
    "GainMargin",
    "Margins",
    "PhaseMargin",
    "StateSpace",
    "closed_loop",
    "control_locus",
    "control_map",
    "controlled_thrust",
    "open_loop",
    "stability_margins",
    "state_space",
]
