"""How long a time step may be, and how long it is unless given."""

import math
import warnings
from dataclasses import dataclass

from beal.errors import ModelError
from beal.motion import signals
from beal.motion.newmark import largest_step
from beal.motion.reduction import ReducedEquations
from beal.vehicle.vehicle import Vehicle

RESOLVED_MODE = 4  # the elastic mode up to which the default step resolves the motion
STEPS_PER_PERIOD, FEWEST_STEPS_PER_PERIOD = 40, 10
STEPS_PER_SHORTEST_PERIOD = 2  # of all modes that are kept: none is aliased
MOST_STEPS = 1_000_000


class CoarseStepWarning(RuntimeWarning):
    """The step of Newmark's method is too long for the motion of interest; the message says by how much."""


class AliasingWarning(CoarseStepWarning):
    """The output is too coarse for the highest frequency kept, which the message gives."""


@dataclass(frozen=True)
class Frequencies:
    """What a time step has to follow, in rad/s.

    Parameters
    ----------
    interest : float
        The highest among the lowest elastic modes and the forces.
    kept : float
        The highest among all modes that are kept and the forces.
    modes : float
        The highest among all modes that are kept.
    """

    interest: float
    kept: float
    modes: float


def frequencies(reduced: ReducedEquations, vehicle: Vehicle, others: float = 0.0) -> Frequencies:
    """The frequencies of a vehicle's reduced equations and its forces, and another one if there is one."""
    resolved = float(abs(reduced.mu[: reduced.rigid + RESOLVED_MODE][-1])) ** 0.5
    modes = float(abs(reduced.mu[-1])) ** 0.5
    forced = max([others, *(signals.highest_frequency(force.signal) for force in vehicle.forces)])
    return Frequencies(max(resolved, forced), max(modes, forced), modes)


def step_count(duration: float, step: float | None, found: Frequencies) -> int:
    """Number of steps: as long as given, else such that they follow the motion and alias none of it."""
    if step is None:
        step = 2 * math.pi / max(found.interest * STEPS_PER_PERIOD, found.kept * STEPS_PER_SHORTEST_PERIOD)
    count = math.ceil(duration / step * (1 - 1e-12))  # a step that divides the duration stays as it is
    if count > MOST_STEPS:
        raise ModelError(
            f"step: at most {MOST_STEPS} steps are taken, found {count}; shorten the duration or lengthen the step"
        )
    return count


def check_step(step: float, found: Frequencies, newmark: tuple[float, float] | None) -> None:
    """Refuses a step with which Newmark's method is unstable and warns of one that is coarse or hides motions.

    Parameters
    ----------
    step : float
        In s.
    found : Frequencies
    newmark : pair of float or None
        beta and gamma; None for a method without an error of the step.
    """
    if newmark and step >= (stable := largest_step(found.modes, *newmark)):
        raise ModelError(
            f"step: with beta = {newmark[0]:g} and gamma = {newmark[1]:g} it must be shorter than {stable:.3g}, "
            f"found {step:.3g}; shorten it, keep fewer modes, or use beta >= gamma/2"
        )
    shortest, longest = 2 * math.pi / found.interest, math.pi / found.kept
    if newmark and step > shortest / FEWEST_STEPS_PER_PERIOD:
        warnings.warn(
            f"the step {step:.3g} is longer than a tenth of the shortest period of interest, {shortest:.3g}; "
            'shorten it or use method = "exact"',
            CoarseStepWarning,
            stacklevel=3,
        )
    elif step > longest * (1 + 1e-9):
        warnings.warn(
            f"the output is aliased: the highest frequency kept is {found.kept:.4g} rad/s, a step of {step:.3g} shows "
            f"none above {math.pi / step:.4g}; shorten it to {longest:.3g} or keep fewer modes",
            AliasingWarning,
            stacklevel=3,
        )
