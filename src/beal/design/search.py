"""One search for a better design: linear programmes over a trust region, under the planes of all instabilities."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import copysign

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from beal.design.worth import MISSED, Cut, Seen, Task
from beal.errors import ConvergenceError

Array = NDArray[np.float64]

FIRST_STEP, LEAST_STEP, GROWN, SHRUNK = 0.1, 1e-5, 2.0, 0.4  # of the trust region, in the unit cube
CLIFFS = 12  # rejected steps remembered
NEAR = 3.0  # radii within which a cliff is about where its plane says
GAIN = 1e-4  # share of the worth below which a search does not begin anew
AT_ONCE = 1.0  # times the ratio that counts: only what comes first
NOTHING = 1e-7  # gain that a linear programme promises at a local optimum, relative
FALL, CLOSE = 0.02, 1e-3  # of the ratio, by a step in the unit cube that explains no more than half of it


@dataclass(frozen=True)
class Climb:
    """Where a search led.

    Parameters
    ----------
    trail : tuple of Seen
        The designs that it kept, the best last.
    worth, start : float
        Of the best, and where the search began.
    cliff : bool
        Whether a step of 1e-3 or less from the best was seen to cost 2 % of what it bears.
    evaluations : int
        Designs looked at.
    """

    trail: tuple[Seen, ...]
    worth: float
    start: float
    cliff: bool
    evaluations: int


def climbed(task: Task, place: Array, iterations: int) -> Climb | None:
    """The best design that steps from a place lead to; None where the first cannot be solved.

    A step is kept if the complete lists of the new design are better and a sweep of all coordinates finds no flutter
    that they overlook. A rejected one leaves planes that the next steps do not cross.
    """
    first = task.seen(place)
    if first is None:
        return None
    trail = [task.swept(first)]
    worth = start = since = task.worth(trail[0])
    radius, here, cliffs, evaluations, cliff = FIRST_STEP, None, deque[Cut](maxlen=CLIFFS), 1, False
    for _ in range(iterations):
        seen = trail[-1]
        if here is None:
            here = task.cuts(seen)
        near = [cut for cut in cliffs if np.abs(cut.place - seen.place).max() < NEAR * radius]
        to, gain = _step(task, seen, here, near, radius)
        if gain < NOTHING and not near:
            break
        if gain < NOTHING:
            cliffs.clear()
            continue
        trial = task.seen(to)
        evaluations += 1
        if trial is not None and task.worth(trial) > worth:
            trial = task.swept(trial)
        if trial is not None and task.worth(trial) > worth:
            trail.append(trial)
            worth, here, cliff = task.worth(trial), None, False
            radius = min(GROWN * radius, 0.5)
            continue
        radius *= SHRUNK
        if trial is not None:
            cliff |= float(np.abs(to - seen.place).max()) < CLOSE and trial.first < (1 - FALL) * seen.first
            cliffs.extend(_met(task, trial))
        if radius < LEAST_STEP:
            if worth <= since * (1 + copysign(GAIN, since)):
                break
            radius, since = FIRST_STEP, worth
            cliffs.clear()
    return Climb(tuple(trail), worth, start, cliff, evaluations)


def _met(task: Task, trial: Seen) -> list[Cut]:
    """What a rejected step met first; nothing where it is lost in the discretisation that is differentiated."""
    try:
        return task.cuts(trial, AT_ONCE)
    except ConvergenceError:
        return []


def _step(task: Task, seen: Seen, here: Sequence[Cut], cliffs: Sequence[Cut], radius: float) -> tuple[Array, float]:
    """Where a linear programme over a box around the design leads, and what it promises.

    An instability that a rejected step met is a plane that the next one does not cross; the design itself, where it
    does not come first, stays on the right side of it.
    """
    place, space, first = seen.place, task.space, seen.first
    ratio = [cut.ratio for cut in here]
    ratio += [max(cut.ratio + float(cut.slope @ (place - cut.place)), first) for cut in cliffs]
    slope = np.array([cut.slope for cut in (*here, *cliffs)])
    A, b = space.rows()
    within = [(max(-radius, -x), min(radius, 1 - x)) for x in place.tolist()]
    if task.objective == "mass":  # least mass, and a price on what is missed
        cost, last, unit = np.append(task.mass_slopes(place) / space.vehicle.mass, MISSED), -1.0, 1.0
        worst = MISSED * max(0.0, 1 - first)
    else:  # maximise t with r_e + g_e d >= (1 + t) r
        cost, last, unit, worst = np.append(np.zeros(len(place)), -1.0), 1.0, first, 0.0
    rows = np.column_stack((-slope / unit, np.full(len(slope), last)))
    table = np.vstack((rows, np.column_stack((A, np.zeros(len(A))))))
    limits = np.concatenate((np.array(ratio) / unit - 1, b - A @ place))
    found = linprog(cost, table, limits, bounds=[*within, (None if last > 0 else 0, None)])
    if found.x is None or found.fun is None:
        return place, 0.0
    return np.clip(place + found.x[: len(place)], 0.0, 1.0), worst - float(found.fun)
