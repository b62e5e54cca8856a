"""The largest thrust that a vehicle bears with its control law closed."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from beal.control.closed import GROWING, lowest_roots, refinements
from beal.control.crossings import condensed, crossings, first_order
from beal.control.loop import Loop, law_of
from beal.errors import ConvergenceError, ModelError
from beal.shown import Shown
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.limit import default_limit
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

REAL = 1e-6  # |Im s| of a root that crosses at zero, beside the reference frequency
APART = 1e-3  # relative change of the thrust from one discretisation to the next that is too much
STEPS, CLOSE = 20, 1e-13  # of the secant method


@dataclass(frozen=True)
class ControlledThrust(Shown):
    """The smallest thrust at which a vehicle with its control law closed is no longer stable.

    Parameters
    ----------
    critical_thrust : float or None
        In N; 0 if the law feeds a mode under the first thrust; None if the loop is stable up to ``searched_to``.
    kind : {"flutter", "divergence", "stable"}
        Whether the root crosses the imaginary axis with a frequency or at zero; without damping and delay, whether two
        frequencies meet or one vanishes.
    angular_frequency : float or None
        There, in rad/s.
    error_estimate : float or None
        Of the critical thrust, in N: how much it changed in the last refinement.
    searched_to : float
        In N.
    watched_modes : int
        Number of elastic modes that were looked at.
    units : {"SI", "nondimensional"}
    """

    critical_thrust: float | None
    kind: Literal["flutter", "divergence", "stable"]
    angular_frequency: float | None
    error_estimate: float | None
    searched_to: float
    watched_modes: int
    units: Literal["SI", "nondimensional"] = "SI"


def controlled_thrust(vehicle: Vehicle, max_thrust: float | None = None, modes: int = 6) -> ControlledThrust:
    """The smallest thrust at which a root of the closed loop begins to grow.

    All thrusts at which a root may cross the imaginary axis are the eigenvalues of two matrices; between two of them
    the number of growing roots does not change and is counted once, so that no step can pass an instability over.

    Parameters
    ----------
    vehicle : Vehicle
        With a control law.
    max_thrust : float, optional
        In N; by default as for `beal.critical_thrust`.
    modes : int
        Number of elastic modes that are watched.

    Returns
    -------
    ControlledThrust

    Raises
    ------
    ModelError
        If there is no control law, or an option is out of range.
    ConvergenceError
        If the thrust does not converge.

    Notes
    -----
    Not seen are roots faster than those of the modes watched, and growth rates below 1e-8 of the modulus. The
    candidates come from the lowest modes with static corrections; an instability that these lack altogether is found
    only if it lasts to the middle between two others.

    References
    ----------
    Wu, J. J., 1975. On the stability of a free-free beam under axial thrust subjected to directional control. Journal
    of Sound and Vibration, 43(1), 45-52.
    Park, Y. P., Mote, C. D., 1985. The maximum controlled follower force on a free-free beam carrying a concentrated
    mass. Journal of Sound and Vibration, 98, 247-256.

    Examples
    --------
    >>> from beal.vehicle import Control, Gain, Sensor, catalog
    >>> law = Control(gains=[Gain(sensor="imu", quantity="slope", gain=0.1)])
    >>> missile = catalog.beal().model_copy(
    ...     update={"sensors": (Sensor(name="imu", station=0.3),), "control": law})
    >>> found = controlled_thrust(missile)
    >>> found.kind, round(found.critical_thrust, 9)
    ('divergence', 25.638181377)
    """
    law_of(vehicle)
    if max_thrust is not None and not 0 < max_thrust < np.inf:
        raise ModelError(f"max_thrust: must be a positive number, found {max_thrust}")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")
    units = vehicle.units
    with one_thread():
        limit = max_thrust or default_limit(vehicle)
        first, *finer = islice(refinements(vehicle, modes), 3)
        if first.static:
            return _undamped([first, *finer], limit)
        start = next((thrust for thrust, grows in changes(first, limit, modes) if grows), None)
        if start is None:
            return ControlledThrust(None, "stable", None, None, limit, modes, units)
        if not start:
            s = leading(first, _candidates(first, limit, modes)[0] / 2, modes)
            return ControlledThrust(0.0, "flutter" if s.imag else "divergence", abs(s.imag), 0.0, limit, modes, units)
        thrusts: list[float] = []
        s = leading(first, start, modes)
        for closed in (first, *finer):
            thrust, s = _polished(closed, thrusts[-1] if thrusts else start, s, modes)
            thrusts.append(thrust)
    error = abs(thrusts[-1] - thrusts[-2]) if finer else np.nan
    if not error < APART * thrusts[-1]:
        raise ConvergenceError(f"critical thrust near {start:.6g}: it does not converge")
    kind: Literal["flutter", "divergence"] = "flutter" if abs(s.imag) > REAL * first.speed else "divergence"
    omega = abs(s.imag) if kind == "flutter" else 0.0
    return ControlledThrust(thrusts[-1], kind, omega, error, limit, modes, units)


def _undamped(loops: list[Loop], limit: float) -> ControlledThrust:
    """A law without damping and delay is a part of the stiffness."""
    coarse, fine = (critical_thrust(closed.closed(), limit) for closed in (loops[0], loops[-1]))
    watched, units = fine.watched_modes, fine.units
    if fine.critical_thrust is None or coarse.critical_thrust is None:
        return ControlledThrust(None, "stable", None, None, limit, watched, units)
    error = max(fine.error_estimate or 0.0, abs(fine.critical_thrust - coarse.critical_thrust))
    return ControlledThrust(fine.critical_thrust, fine.kind, fine.angular_frequency, error, limit, watched, units)


def changes(closed: Loop, limit: float, modes: int) -> Iterator[tuple[float, bool]]:
    """Thrusts at which the loop becomes unstable or stable again.

    Parameters
    ----------
    closed : Loop
    limit : float
        Thrust to search to, in N.
    modes : int
        Number of elastic modes that are watched.

    Yields
    ------
    thrust : float
        In ascending order; 0 where a root grows under the first thrust already.
    grows : bool
        Whether a root grows beyond it.
    """
    before, grew = 0.0, False
    ends = _candidates(closed, limit, modes)
    for low, high in zip([0.0, *ends], ends, strict=False):
        middle = (low + high) / 2
        grows = _growth(closed, middle, modes) > 0
        if grows != grew:
            yield (
                float(brentq(lambda P: _growth(closed, P, modes), before, middle, rtol=1e-12)) if before else 0.0,
                grows,
            )
        before, grew = middle, grows
    if (_growth(closed, limit, modes) > 0) != grew:
        yield limit, not grew


def _candidates(closed: Loop, limit: float, modes: int) -> list[float]:
    """Thrusts between two of which the number of growing roots is the same, the limit last."""
    if closed.static:
        return [*(event.thrust for event in critical_events(closed.closed(), limit)), limit]
    return [*crossings(*first_order(condensed(closed, modes)), limit).tolist(), limit]


def _growth(closed: Loop, thrust: float, modes: int) -> float:
    """The largest Re s, less what counts as none."""
    s = lowest_roots(closed, thrust, modes)[closed.zero_roots :]
    return float(np.max(s.real - GROWING * np.abs(s)))


def leading(closed: Loop, thrust: float, modes: int) -> complex:
    """The root that grows fastest or decays most slowly, Im s >= 0."""
    s = lowest_roots(closed, thrust, modes)[closed.zero_roots :]
    found = complex(s[np.argmax(s.real)])
    return complex(found.real, abs(found.imag))


def _polished(closed: Loop, thrust: float, near: complex, modes: int) -> tuple[float, complex]:
    """The thrust at which the root near to a given one has no real part, by the secant method."""

    def root(P: float) -> complex:
        s = lowest_roots(closed, P, modes)[closed.zero_roots :]
        return complex(s[np.argmin(np.abs(s - near))])

    last, thrust = thrust, thrust * (1 + 1e-6)
    before, s = root(last), root(thrust)
    for _ in range(STEPS):
        if s.real == before.real or abs(thrust - last) < CLOSE * thrust:
            break
        last, thrust, before = thrust, thrust - s.real * (thrust - last) / (s.real - before.real), s
        s = root(thrust)
    return thrust, s
