"""The paths of the closed loop's roots over thrust, gain or any quantity of the vehicle."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import linear_sum_assignment

from beal.control.closed import lowest_roots, refinements, thrust_of
from beal.control.compensator import Array
from beal.control.loop import law_of
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.pencil import ComplexArray
from beal.stability.threads import one_thread
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

THRUST, GAIN = "thrust", "gain"
SPARE = 2  # modes followed beyond those asked for
CLEAR = 0.5  # a root that moves by more than this share of its distance to another one may have been mistaken for it
HALVINGS = 5

Roots = Callable[[float], ComplexArray]


@dataclass(frozen=True)
class ControlLocus(Shown):
    """Tracked roots of the closed loop.

    Parameters
    ----------
    over : str
        What varies: ``thrust``, ``gain`` or a path.
    values : ndarray, shape (points,)
    roots : ndarray of complex, shape (points, k)
        In rad/s, each root in its column; those of the drift are left out.
    units : {"SI", "nondimensional"}
    """

    over: str
    values: Array
    roots: ComplexArray
    units: Literal["SI", "nondimensional"] = "SI"


def control_locus(
    vehicle: Vehicle, over: str, values: Sequence[float] | Array, thrust: float | None = None, modes: int = 3
) -> ControlLocus:
    """Roots of the closed loop, each followed as something varies.

    From one value to the next the roots are matched by an optimal assignment, with steps halved where two come so close
    that one could be mistaken for the other.

    Parameters
    ----------
    vehicle : Vehicle
        With a control law.
    over : str
        ``"thrust"``, ``"gain"`` (a factor on all gains) or the path of any quantity, such as
        ``"joint[0].rotational_stiffness"`` or ``"control.lag"``.
    values : sequence of float
        At least two.
    thrust : float, optional
        Where it is not what varies; by default the vehicle's nominal thrust.
    modes : int
        Number of elastic modes.

    Returns
    -------
    ControlLocus

    Raises
    ------
    ModelError
        If there is no control law, a value is not allowed or the path unknown.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> law = Control(gains=[Gain(sensor="imu", quantity="slope", gain=1.0)])
    >>> missile = catalog.beal().model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.5),), "control": law})
    >>> found = control_locus(missile, "gain", [0.0, 0.5, 1.0], thrust=10.0, modes=1)
    >>> found.roots[:, found.roots[-1].imag > 0].imag.round(4).tolist()
    [[0.0, 20.9746], [4.4302, 21.1192], [6.298, 21.2865]]
    """
    law_of(vehicle)
    points = np.asarray(values, dtype=float)
    if points.ndim != 1 or len(points) < 2 or not np.all(np.isfinite(points)):
        raise ModelError(f"values: must be at least two finite numbers, found {len(points)}")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    given = None if over == THRUST else thrust_of(vehicle, thrust)

    def roots(value: float) -> ComplexArray:
        changed = varied(vehicle, over, value)
        closed = next(refinements(changed, 2 * modes))
        return lowest_roots(closed, thrust_of(changed, value if given is None else given), modes + SPARE)

    with one_thread():
        s = roots(float(points[0]))
        history = [s]
        for before, after in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
            s = _follow(s, before, after, roots, HALVINGS)
            history.append(s)
    followed = np.array(history)
    count = len(followed[0]) - 2 * SPARE
    kept = [n for n in range(count) if np.any(followed[:, n])]
    return ControlLocus(over, points, followed[:, kept], vehicle.units)


def varied(vehicle: Vehicle, over: str, value: float) -> Vehicle:
    """The vehicle with a thrust (which leaves it as it is), a factor on all gains or the quantity of a path."""
    if over == THRUST:
        return vehicle
    if over != GAIN:
        return with_values(vehicle, {over: value})
    law = law_of(vehicle)
    gains = tuple(part.model_copy(update={"gain": value * part.gain}) for part in law.gains)
    return vehicle.model_copy(update={"control": law.model_copy(update={"gains": gains})})


def _follow(s: ComplexArray, before: float, after: float, roots: Roots, halvings: int) -> ComplexArray:
    """The roots at a value in the order in which ``s`` has them at the one before."""
    new = roots(after)
    if len(new) != len(s):
        raise ModelError(
            f"values: {len(s)} roots at {before:g} cannot be followed to {len(new)} at {after:g}; "
            "leave out 0 for a lag or delay, which then has no root"
        )
    distance = np.abs(s[:, None] - new)
    rows, columns = linear_sum_assignment(distance)
    apart = np.abs(new[:, None] - new) + np.where(np.eye(len(new)), np.inf, 0.0)
    doubtful = distance[rows, columns] > CLEAR * apart[columns].min(axis=1)
    if halvings and np.any(doubtful[: len(s) - 2 * SPARE]):
        middle = (before + after) / 2
        return _follow(_follow(s, before, middle, roots, halvings - 1), middle, after, roots, halvings - 1)
    return np.asarray(new[columns])
