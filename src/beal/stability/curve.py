"""Frequencies over thrust, each mode followed through veering, crossing and coalescence."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from beal.discretisation.build import RITZ, Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.damped_roots import NEUTRAL, damped_modes
from beal.stability.large import is_large, operators_over_thrust
from beal.stability.limit import default_limit
from beal.stability.pencil import Array, ComplexArray, pencil, reduced
from beal.stability.spectrum import elastic_modes, exponents
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

SPARE = 3  # roots followed beyond those asked for, so that a mode that rises out of them is not lost
LIKENESS = 0.6  # below this likeness of the shapes a step is halved
GROWING = 1e-6  # growth rate over the first frequency above which a root counts as unstable
SLOWER = 1e-2  # what decides between two real roots that are equally near
HALVINGS = 6
MODES = 4  # followed unless told otherwise
ORDER = 14
MANY, KEPT = 120, 20  # coordinates from which on a pencil is reduced, and the modes kept beyond those asked for


@dataclass(frozen=True)
class ThrustCurve(Shown):
    """Tracked elastic modes over thrust.

    The rigid-body motion is not among them; where it grows, as it can beside joints that slide along a fixed line,
    `critical_thrust` says so.

    Parameters
    ----------
    thrust : ndarray, shape (points,)
        In N.
    angular_frequency, growth_rate : ndarray, shape (points, modes)
        In rad/s and 1/s. Of a coalesced pair one branch grows and the other decays; of a mode that damping or
        divergence splits into two real roots the one that decays more slowly is followed.
    formulation : str
    units : {"SI", "nondimensional"}
    """

    thrust: Array
    angular_frequency: Array
    growth_rate: Array
    formulation: str
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def unstable(self) -> NDArray[np.bool_]:
        """Where modes grow, shape (points, modes); without damping also where they decay, as halves of a pair."""
        least = GROWING * self.angular_frequency[0].min()
        damped = (abs(self.growth_rate[0]) > least).any()
        return np.asarray((self.growth_rate if damped else abs(self.growth_rate)) > least)


@dataclass(frozen=True)
class _Roots:
    thrust: float
    W: ComplexArray
    vectors: ComplexArray
    s: ComplexArray


def thrust_curve(
    vehicle: Vehicle | Operators,
    to: float | None = None,
    points: int = 201,
    modes: int | None = None,
    formulation: Formulation = "objective",
) -> ThrustCurve:
    """Frequency and growth rate of the lowest modes from zero thrust up.

    Modes are matched from one thrust to the next by an optimal assignment on the likeness of their shapes and the
    nearness of their roots, with steps halved where the match is not clear; so a mode keeps its column where
    frequencies veer or cross, and both partners go on as a pair after they coalesce. A vehicle of many segments is
    reduced to its modes at some thrusts, which leaves some 1e-7 and saves minutes.

    Parameters
    ----------
    vehicle : Vehicle or Operators
    to : float, optional
        Last thrust, in N; by default that to which `critical_thrust` searches.
    points : int
        Number of thrusts, evenly spaced from 0.
    modes : int, optional
        Number of elastic modes, the lowest at zero thrust; by default 4, or all that rigid stages have.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}

    Returns
    -------
    ThrustCurve

    Raises
    ------
    ModelError
        If the range or a count is not usable.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> curve = thrust_curve(catalog.beck(), to=20.0, points=5, modes=2)
    >>> curve.angular_frequency[3].round(5).tolist()
    [6.62741, 16.25983]
    """
    if points < 2:
        raise ModelError(f"points: must be at least 2, found {points}")
    if to is not None and not 0 < to < np.inf:
        raise ModelError(f"to: must be a positive thrust, found {to}")
    operators = vehicle
    if isinstance(operators, Vehicle):
        if formulation not in RITZ and is_large(operators):
            if modes is not None and not 1 <= modes <= MANY:
                raise ModelError(f"modes: must lie between 1 and {MANY}, found {modes}")
            operators = operators_over_thrust(operators, formulation, to or default_limit(operators), modes or MODES)
        else:
            operators = discretise(operators, formulation, order=None if formulation in RITZ else ORDER)
    full = pencil(operators)
    elastic = len(full.M) - full.rigid
    modes = min(MODES, elastic) if modes is None else modes
    if not 1 <= modes <= elastic:
        raise ModelError(f"modes: must lie between 1 and {elastic} for this discretisation, found {modes}")
    if len(full.M) > MANY:
        full = reduced(full, modes + KEPT, modes + SPARE)
    followed = min(modes + full.rigid + SPARE, len(full.M))
    thrusts = np.linspace(0.0, to or default_limit(operators.vehicle), points)

    def roots(thrust: float) -> _Roots:
        if full.C is None:
            W, vectors = elastic_modes(full, thrust, followed - full.rigid)
            return _Roots(thrust, W, vectors, exponents(W))
        s, vectors = damped_modes(full, thrust, followed + full.rigid + SPARE)  # more: a mode may split in two
        return _Roots(thrust, -(s**2), vectors, s)

    with one_thread():
        state = roots(0.0)
        state = _Roots(0.0, state.W[:followed], state.vectors[:, :followed], state.s[:followed])
        if full.C is None:
            columns = np.argsort(np.abs(state.W))[:modes]
        else:
            columns = np.flatnonzero(np.abs(state.s) > NEUTRAL * np.sqrt(full.shift))[:modes]
        history = [state.s[columns]]
        for thrust in thrusts[1:]:
            state = _follow(state, float(thrust), roots, full.M, HALVINGS)
            history.append(state.s[columns])
    s = np.array(history)
    return ThrustCurve(thrusts, np.abs(s.imag), np.asarray(s.real), formulation, operators.vehicle.units)


def _follow(state: _Roots, thrust: float, roots: Callable[[float], _Roots], M: Array, halvings: int) -> _Roots:
    """The roots at a thrust in the order in which ``state`` has them."""
    new = roots(thrust)
    likeness = np.abs(state.vectors.conj().T @ M @ new.vectors)
    scale = np.abs(state.W[:, None]) + np.abs(new.W) + np.ptp(np.abs(state.W)) / len(state.W)
    distance = np.abs(state.W[:, None] - new.W) / scale
    slower = np.where(new.s.imag == 0, np.argsort(np.argsort(new.s.real)) / len(new.s), 0.0)  # of a pair of real roots
    before, after = linear_sum_assignment(distance + 1 - likeness - SLOWER * slower)
    order = after[np.argsort(before)]
    if halvings and likeness[before, after][:-SPARE].min(initial=1.0) < LIKENESS:
        middle = _follow(state, (state.thrust + thrust) / 2, roots, M, halvings - 1)
        return _follow(middle, thrust, roots, M, 0 if halvings == 1 else halvings - 1)
    return _Roots(thrust, new.W[order], new.vectors[:, order], new.s[order])
