"""The control loop: sensors, gains, filters and the actuator that turns the thrust."""

from beal.control.closed import ClosedLoop, closed_loop
from beal.control.locus import ControlLocus, control_locus
from beal.control.margins import GainMargin, Margins, PhaseMargin, stability_margins
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
    "controlled_thrust",
    "stability_margins",
    "state_space",
]
