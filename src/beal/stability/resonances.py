"""Where a small pulsation of the thrust is in resonance with the modes, by first-order perturbation."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Literal, get_args

import numpy as np

from beal.stability.periodic import PulsatingEquations

Kind = Literal["principal", "sum", "difference"]
KINDS: tuple[Kind, ...] = get_args(Kind)
ORDERS = (1, 2)
STEADY = 1e-9  # |Im mu| beside |mu| above which a mode flutters at the mean thrust
COUPLED = 1e-9  # b_ij b_ji beside b_ii b_jj below which two modes do not feel each other


@dataclass(frozen=True)
class Resonance:
    """A pulsation in resonance with one mode or two, k Omega = 2 w_i, w_j + w_i or w_j - w_i.

    Parameters
    ----------
    kind : {"principal", "sum", "difference"}
    modes : tuple of int
        Numbers of the modes, from 1; twice the same in a principal resonance.
    order : int
        k.
    angular_frequency : float
        Omega where the tongue of instability starts from the axis of no amplitude, in rad/s.
    opening : float or None
        How fast half of the tongue's width grows with the amplitude, in rad/s per N; None at higher order, where it is
        not in proportion.

    Notes
    -----
    With modes normalised by the mass, left ones to right ones, and b the stiffness per thrust between them, the half
    width is P1 |b_ii|/(2 w_i) beside 2 w_i and P1 sqrt(|b_ij b_ji|/(w_i w_j))/2 beside a combination: of the sum if
    b_ij b_ji > 0 and of the difference if it is negative, as a follower force makes it (Bolotin, 1964; Hsu, 1963).
    """

    kind: Kind
    modes: tuple[int, int]
    order: int
    angular_frequency: float
    opening: float | None

    @property
    def name(self) -> str:
        """Such as 2 w1, w2 - w1 or 2 w1/2."""
        return resonance_name(self.kind, self.modes, self.order)

    def share(self, angular_frequency: float, amplitude: float) -> float:
        """Distance from the middle of the tongue in half widths, infinite where those are not known or zero."""
        half = (self.opening or 0.0) * amplitude
        return abs(angular_frequency - self.angular_frequency) / half if half else np.inf


def resonance_name(kind: Kind, modes: tuple[int, int], order: int) -> str:
    """What a resonance is called.

    Examples
    --------
    >>> resonance_name("principal", (1, 1), 1), resonance_name("difference", (1, 2), 2)
    ('2 w1', '(w2 - w1)/2')
    """
    low, high = modes
    if kind == "principal":
        return f"2 w{low}" if order == 1 else f"2 w{low}/{order}"
    text = f"w{high} {'+' if kind == 'sum' else '-'} w{low}"
    return text if order == 1 else f"({text})/{order}"


def resonances(equations: PulsatingEquations) -> list[Resonance]:
    """Resonances of the modes that swing at the mean thrust, in order of frequency.

    Parameters
    ----------
    equations : PulsatingEquations

    Returns
    -------
    list of Resonance
        At first order, of each two modes the sum or the difference, whichever resonates; at second order the same and
        the principal ones.
    """
    mu, right = np.linalg.eig(equations.A)
    b = np.linalg.solve(right, equations.B @ right)
    order = np.argsort(np.abs(mu), kind="stable")[equations.rigid :]
    swings = {n: i for n, i in enumerate(order, 1) if mu[i].real > 0 and abs(mu[i].imag) <= STEADY * abs(mu[i])}
    found = []
    for first, second in combinations_with_replacement(swings, 2):
        i, j = swings[first], swings[second]
        w_i, w_j = np.sqrt(mu[[i, j]].real).tolist()
        coupling = float((b[i, j] * b[j, i]).real)
        if abs(coupling) <= COUPLED * abs(b[i, i] * b[j, j]):
            continue
        opening = float(np.sqrt(abs(coupling) / (w_i * w_j)) / 2)
        sign = 1 if coupling > 0 else -1
        kind: Kind = "principal" if i == j else "sum" if sign > 0 else "difference"
        found += [
            Resonance(kind, (first, second), k, (w_j + sign * w_i) / k, opening if k == 1 else None) for k in ORDERS
        ]
    return sorted(found, key=lambda resonance: resonance.angular_frequency)


def nearest(found: Sequence[Resonance], angular_frequency: float, amplitude: float) -> Resonance | None:
    """The resonance in whose tongue a pulsation lies, deepest, or else the one with the nearest frequency."""

    def distance(resonance: Resonance) -> tuple[float, float]:
        share = resonance.share(angular_frequency, amplitude)
        return (share if share < 1 else np.inf), abs(angular_frequency - resonance.angular_frequency)

    return min(found, key=distance, default=None)
