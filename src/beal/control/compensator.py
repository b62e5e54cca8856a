"""Filters, actuator and delay as one realisation: z' = A z + B e, delta = C z + D e."""

import math
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from beal.vehicle.control import Control

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Compensator:
    """One input e, one output delta.

    Parameters
    ----------
    A : ndarray, shape (k, k)
        In 1/s.
    B : ndarray, shape (k, 1)
    C : ndarray, shape (1, k)
    D : float
    """

    A: Array
    B: Array
    C: Array
    D: float

    @property
    def acceleration(self) -> tuple[Array, float]:
        """Rows of delta'' = c z + d e, shape (1, k), where the relative degree is 2 or more."""
        return self.C @ self.A @ self.A, float((self.C @ self.A @ self.B).sum())


def compensator(control: Control) -> Compensator:
    """The realisation of a control law's filters, actuator and delay in series.

    Parameters
    ----------
    control : Control

    Returns
    -------
    Compensator

    Examples
    --------
    >>> from beal.vehicle.control import Filter, Gain
    >>> gain = Gain(sensor="imu", quantity="slope", gain=1.0)
    >>> slow = Filter(numerator=[6.0], denominator=[1.0, 2.0])
    >>> found = compensator(Control(lag=0.1, delay=0.2, gains=[gain], filters=[slow]))
    >>> len(found.A), found.D
    (4, 0.0)
    """
    parts = [(part.proper_numerator, part.denominator) for part in control.filters]
    if control.lag:
        parts.append(((1.0,), (control.lag, 1.0)))
    if control.actuator:
        parts.append(((1.0,), control.actuator.denominator))
    if control.delay:
        parts.append(pade(control.delay, control.delay_order))
    nothing = Compensator(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), 1.0)
    return reduce(_in_series, (_realised(*part) for part in parts), nothing)


def pade(delay: float, order: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Numerator and denominator of the diagonal Padé approximant of exp(-s delay).

    Parameters
    ----------
    delay : float
        In s.
    order : int

    Returns
    -------
    numerator, denominator : tuple of float
        Coefficients of the powers of s, highest first.

    References
    ----------
    Golub, G. H., Van Loan, C. F., 2013. Matrix computations. Johns Hopkins, section 9.3.1.

    Examples
    --------
    >>> pade(1.0, 1)
    ((-0.5, 1.0), (0.5, 1.0))
    """
    powers = range(order, -1, -1)
    share = [math.comb(order, k) * math.factorial(2 * order - k) / math.factorial(2 * order) for k in powers]
    terms = [value * delay**k for value, k in zip(share, powers, strict=True)]
    return tuple((-1) ** k * term for term, k in zip(terms, powers, strict=True)), tuple(terms)


def _realised(numerator: tuple[float, ...], denominator: tuple[float, ...]) -> Compensator:
    """Companion form in a time that makes the lowest coefficient of the denominator, 0 aside, 1."""
    order = len(denominator) - 1
    moving = order if denominator[-1] else order - 1  # poles other than an integrator's
    speed = abs(denominator[moving] / denominator[0]) ** (1 / moving) if moving > 0 else 1.0
    powers = speed ** -np.arange(order + 1.0)
    a = np.array(denominator) / denominator[0] * powers
    b = np.array([0.0] * (order + 1 - len(numerator)) + [*numerator]) / denominator[0] * powers
    A = np.vstack((-a[1:], np.eye(order)[:-1])) if order else np.zeros((0, 0))
    return Compensator(speed * A, speed * np.eye(order, 1), (b[1:] - b[0] * a[1:])[None], float(b[0]))


def _in_series(first: Compensator, second: Compensator) -> Compensator:
    """What the second makes of the first one's output."""
    blocks = [[first.A, np.zeros((len(first.A), len(second.A)))], [second.B @ first.C, second.A]]
    return Compensator(
        np.block(blocks),
        np.vstack((first.B, second.B * first.D)),
        np.hstack((second.D * first.C, second.C)),
        second.D * first.D,
    )
