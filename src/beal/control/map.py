"""Where the closed loop is stable, over the thrust and a gain, a sensor's station or any other quantity."""

from collections.abc import Callable, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from beal.control.closed import lowest_roots, refinements
from beal.control.compensator import Array
from beal.control.crossings import condensed
from beal.control.locus import THRUST, varied
from beal.control.loop import Loop, law_of
from beal.control.thrust import changes
from beal.errors import ModelError
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], None]


def control_map(
    vehicle: Vehicle,
    over: str,
    values: Sequence[float] | Array,
    thrusts: Sequence[float] | Array,
    modes: int = 3,
    progress: Progress | None = None,
) -> "xarray.Dataset":
    """Stability of the closed loop over the thrust and a gain, the station of a sensor or any other quantity.

    For each value of the quantity all thrusts at which the stability changes are found in the way in which
    `beal.controlled_thrust` finds the first, so that none lies hidden between two points of the grid.

    Parameters
    ----------
    vehicle : Vehicle
        With a control law.
    over : str
        ``"gain"`` (a factor on all gains) or the path of a quantity, such as ``"sensor[0].station"``,
        ``"control.gains[1].gain"`` or ``"joint[0].rotational_stiffness"``.
    values, thrusts : sequence of float
        Ascending; thrusts in N, positive.
    modes : int
        Number of elastic modes that are watched.
    progress : callable, optional
        Called with the number of values done and of all.

    Returns
    -------
    xarray.Dataset
        Over the quantity and ``thrust``: ``stable``, ``damping_ratio`` and ``angular_frequency`` (rad/s) of the root
        that is least damped, drift aside; over the quantity and ``change``: ``border``, the thrusts at which the
        stability changes up to the last, nan where there are no more, 0 first where it is lost under the first thrust.

    Raises
    ------
    ModelError
        If there is no control law, the quantity is not known or a list does not ascend.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> law = Control(gains=[Gain(sensor="imu", quantity="slope", gain=1.0)])
    >>> missile = catalog.beal().model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.0),), "control": law})
    >>> found = control_map(missile, "sensor[0].station", [0.0, 0.5], [5.0, 20.0, 30.0])
    >>> found.border[:, 0].values.round(6).tolist()  # flutter, divergence
    [16.936004, 25.638181]
    >>> found.stable.values.tolist()
    [[True, False, False], [True, True, False]]
    """
    import xarray

    law_of(vehicle)
    if over == THRUST:
        raise ModelError("over: the thrust is one axis already; name another quantity, such as gain")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    points, thrust = _ascending("values", values), _ascending("thrusts", thrusts)
    if thrust[0] <= 0:
        raise ModelError(f"thrusts: must be positive, found {thrust[0]:g}")
    borders, worst = [], np.empty((len(points), len(thrust)), dtype=complex)
    with one_thread():
        for n, value in enumerate(points.tolist()):
            closed = next(refinements(varied(vehicle, over, value), 2 * modes))
            borders.append([P for P, _ in changes(closed, float(thrust[-1]), modes)])
            worst[n] = _least_damped(condensed(closed, modes), closed.resting, thrust, modes)
            if progress:
                progress(n + 1, len(points))
    grid, size = (over, "thrust"), np.abs(worst)
    changed = np.full((len(points), max(1, *map(len, borders))), np.nan)
    for row, found in zip(changed, borders, strict=True):
        row[: len(found)] = found
    # Beyond an odd number of changes a root grows.
    passed = (changed[:, None] < thrust[:, None]).sum(axis=2)
    si = vehicle.units == "SI"
    return xarray.Dataset(
        {
            "stable": (grid, passed % 2 == 0),
            "damping_ratio": (grid, -worst.real / np.where(size > 0, size, 1.0)),
            "angular_frequency": (grid, np.abs(worst.imag), {"units": "rad/s" if si else "1"}),
            "border": ((over, "change"), changed, {"units": "N" if si else "1"}),
        },
        {over: points, "thrust": ("thrust", thrust, {"units": "N" if si else "1"})},
        {
            "title": vehicle.title,
            "units": vehicle.units,
            "modes": modes,
            "length": vehicle.length,
            "beal_version": version("beal"),
        },
    )


def _least_damped(closed: Loop, zero: int, thrusts: Array, modes: int) -> Array:
    """The root with the smallest damping ratio under each thrust, those that are always zero aside."""
    found = []
    for thrust in thrusts.tolist():
        s = lowest_roots(closed, thrust, modes)[zero:]
        found.append(s[np.argmax(s.real / np.abs(s))])
    return np.array(found)


def _ascending(name: str, values: Sequence[float] | Array) -> Array:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or len(array) < 2 or not np.all(np.isfinite(array)) or not np.all(np.diff(array) > 0):
        raise ModelError(f"{name}: must be at least two finite numbers in ascending order, found {values}")
    return array
