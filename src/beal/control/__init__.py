"""The control loop: sensors, gains, filters and the actuator that turns the thrust."""

from beal.control.closed import ClosedLoop, closed_loop
from beal.control.state_space import StateSpace, state_space

__all__ = ["ClosedLoop", "StateSpace", "closed_loop", "state_space"]
