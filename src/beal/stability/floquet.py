"""Stability under a pulsating thrust P0 + P1 cos(Omega t): Floquet's multipliers."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from beal.discretisation.basis import segments
from beal.discretisation.build import DEFAULT_ORDER, discretise
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.pencil import Array, ComplexArray
from beal.stability.periodic import PulsatingEquations, monodromy, pulsating_equations
from beal.stability.resonances import Resonance, nearest, resonances
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

MODES, FEWER = 8, 3  # kept; by how many fewer the error is estimated
SETTLED = 1e-11
STEADY = 1e-6  # growth rate beside the highest frequency kept that is rounding


@dataclass(frozen=True)
class Floquet(Shown):
    """What a pulsating thrust does to a vehicle over one period.

    Parameters
    ----------
    thrust, amplitude : float
        P0 and P1, in N.
    angular_frequency : float
        Omega, in rad/s.
    multipliers : ndarray of complex, shape (2 modes,)
        By which motions grow in a period, largest modulus first.
    stable : bool
        Whether no motion grows in a period. Where nothing is damped a millionth counts as none, since rounding makes it
        of a double multiplier.
    error_estimate : float
        Of the largest modulus: its change with three modes fewer, and by the last halving of the step.
    resonance : Resonance or None
        The one in whose tongue the pulsation lies to first order, or else the nearest.
    steady_growth_rate : float
        Largest growth rate under P0 alone, in 1/s: positive beyond the critical thrust.
    rigid_body_modes : int
        Number of rigid-body motions left out since they drive no others; their multipliers are +1 unless something
        holds or damps them.
    units : {"SI", "nondimensional"}
    """

    thrust: float
    amplitude: float
    angular_frequency: float
    multipliers: ComplexArray
    stable: bool
    error_estimate: float
    resonance: Resonance | None
    steady_growth_rate: float
    rigid_body_modes: int
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def largest_modulus(self) -> float:
        """Of the multipliers."""
        return float(np.abs(self.multipliers[0]))

    @property
    def growth_rate(self) -> float:
        """Of the fastest growing motion over many periods, in 1/s."""
        return math.log(self.largest_modulus) * self.angular_frequency / (2 * math.pi)


def floquet(
    vehicle: Vehicle | Operators, thrust: float, amplitude: float, angular_frequency: float, modes: int = MODES
) -> Floquet:
    """Stability of M q'' + C q' + K(P0 + P1 cos(Omega t)) q = 0.

    Parameters
    ----------
    vehicle : Vehicle or Operators
    thrust : float
        P0, in N.
    amplitude : float
        P1, in N.
    angular_frequency : float
        Omega, in rad/s.
    modes : int
        Elastic modes whose inertia is kept; those above follow statically.

    Returns
    -------
    Floquet

    Raises
    ------
    ModelError
        If an argument is out of range, or the pulsation is as fast as the highest mode kept.
    ConvergenceError
        If the multipliers do not settle.

    References
    ----------
    V. V. Bolotin, The Dynamic Stability of Elastic Systems, Holden-Day (1964).

    Examples
    --------
    Beck's column in its principal resonance, and below the tongue's lower edge at 8.3569766:

    >>> from beal.vehicle import catalog
    >>> inside, outside = (floquet(catalog.beck(), 5.0, 0.5, W) for W in (8.357, 8.3569))
    >>> inside.stable, outside.stable, inside.resonance.name
    (False, True, '2 w1')
    """
    check(thrust, [amplitude], [angular_frequency], modes)
    with one_thread():
        operators = discretised(vehicle, modes)
        equations = pulsating_equations(operators, thrust, modes)
        check_frequency(angular_frequency, equations)
        multipliers, change = _multipliers(equations, amplitude, angular_frequency)
        fewer = pulsating_equations(operators, thrust, max(1, modes - FEWER))
        compared, _ = _multipliers(fewer, amplitude, angular_frequency)
        moved = abs(abs(multipliers[0]) - abs(compared[0]))
    return Floquet(
        thrust=float(thrust),
        amplitude=float(amplitude),
        angular_frequency=float(angular_frequency),
        multipliers=multipliers,
        stable=bool(abs(multipliers[0]) <= equations.neutral),
        error_estimate=float(moved + change * abs(multipliers[0])),
        resonance=nearest(resonances(equations), angular_frequency, amplitude),
        steady_growth_rate=steady_growth_rate(equations),
        rigid_body_modes=operators.rigid - equations.rigid,
        units=operators.vehicle.units,
    )


def discretised(vehicle: Vehicle | Operators, modes: int) -> Operators:
    """Operators in which the modes kept have converged."""
    if isinstance(vehicle, Operators):
        return vehicle
    return discretise(vehicle, order=max(DEFAULT_ORDER["legendre"], 8 + 2 * modes // len(segments(vehicle))))


def steady_growth_rate(equations: PulsatingEquations) -> float:
    """Largest growth rate without pulsation, in 1/s, zero where it is rounding."""
    growth = float(np.linalg.eigvals(equations.F).real.max())
    return growth if abs(growth) > STEADY * equations.highest else 0.0


def check(thrust: float, amplitudes: Array | list[float], frequencies: Array | list[float], modes: int) -> None:
    """Refuse a pulsation that is none."""
    if not 0 <= thrust < math.inf:
        raise ModelError(f"thrust: must be finite and not negative, found {thrust}")
    for amplitude in amplitudes:
        if not 0 <= amplitude < math.inf:
            raise ModelError(f"amplitude: must be finite and not negative, found {amplitude}")
    for frequency in frequencies:
        if not 0 < frequency < math.inf:
            raise ModelError(f"angular_frequency: must be positive and finite, found {frequency}")
    if modes < 1:
        raise ModelError(f"modes: must be at least 1, found {modes}")


def check_frequency(angular_frequency: float, equations: PulsatingEquations) -> None:
    """Refuse a pulsation that the modes above those kept cannot follow statically."""
    if angular_frequency > equations.highest:
        raise ModelError(
            f"angular_frequency: must not exceed that of the highest mode kept, {equations.highest:.6g}, "
            f"found {angular_frequency:g}; keep more than {len(equations.A)} modes"
        )


def _multipliers(equations: PulsatingEquations, amplitude: float, frequency: float) -> tuple[ComplexArray, float]:
    transition, change = monodromy(equations, np.array([amplitude]), frequency, SETTLED)
    found = np.linalg.eigvals(transition[0]).astype(complex)
    return found[np.argsort(-np.abs(found), kind="stable")], change
