"""Answers that mathematics gives without a discretisation: characteristic equations, Bessel zeros, square roots."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, root
from scipy.special import jv

FINE = 0.05  # step in which roots are bracketed, well below the distance of any two
EXACT = 4 * np.finfo(float).eps


def first_roots(function: Callable[[float], float], count: int, start: float) -> list[float]:
    """The lowest roots of a function above a start.

    Examples
    --------
    >>> first_roots(math.sin, 2, 1.0)
    [3.141592653589793, 6.283185307179586]
    """
    found: list[float] = []
    low = start
    while len(found) < count:
        if function(low) * function(low + FINE) < 0:
            found.append(brentq(function, low, low + FINE, xtol=1e-14, rtol=EXACT))
        low += FINE
    return found


def beck_equation(thrust: float, W: float) -> tuple[float, float]:
    """Characteristic function of Beck's column and its derivative with W = omega^2.

    P^2 + 2 W (1 + cosh a cos b) + P sqrt(W) sinh a sin b, with a^2 and b^2 = sqrt(P^2/4 + W) -+ P/2 (Beck, 1952).
    """
    r = math.sqrt(thrust**2 / 4 + W)
    a, b, omega = math.sqrt(r - thrust / 2), math.sqrt(r + thrust / 2), math.sqrt(W)
    da, db = 1 / (4 * r * a), 1 / (4 * r * b)
    ch, sh, co, si = math.cosh(a), math.sinh(a), math.cos(b), math.sin(b)
    value = thrust**2 + 2 * W * (1 + ch * co) + thrust * omega * sh * si
    slope = 2 * (1 + ch * co) + 2 * W * (sh * co * da - ch * si * db)
    slope += thrust * sh * si / (2 * omega) + thrust * omega * (ch * si * da + sh * co * db)
    return value, slope


@cache
def beck_flutter() -> tuple[float, float]:
    """Thrust and angular frequency at which Beck's column flutters: a double root of its characteristic equation.

    Examples
    --------
    >>> thrust, omega = beck_flutter()
    >>> round(thrust, 10), round(omega, 10)
    (20.050953619, 11.0155576409)
    """

    def equations(x: NDArray[np.float64]) -> tuple[float, float]:
        return beck_equation(x[0], x[1])

    thrust, W = root(equations, (20.0, 121.0), tol=1e-14).x.tolist()
    return thrust, math.sqrt(W)


def beck_frequencies(thrust: float, count: int) -> list[float]:
    """Lowest angular frequencies of Beck's column at a thrust below flutter.

    Examples
    --------
    >>> [round(omega, 8) for omega in beck_frequencies(0.0, 2)]
    [3.51601527, 22.03449156]
    """
    return first_roots(lambda omega: beck_equation(thrust, omega**2)[0], count, 1.0)


def free_frequencies(count: int) -> list[float]:
    """Lowest angular frequencies b^2 of the free-free beam, cos b cosh b = 1.

    Examples
    --------
    >>> [round(omega, 8) for omega in free_frequencies(2)]
    [22.37328545, 61.67282287]
    """
    return [b**2 for b in first_roots(lambda b: math.cos(b) - 1 / math.cosh(b), count, 1.0)]


def pinned_frequencies(load: float, count: int) -> list[float]:
    """Lowest angular frequencies of a pinned column under a dead load (Bokaian, 1988).

    Examples
    --------
    >>> round(pinned_frequencies(math.pi**2 / 2, 1)[0], 10)
    6.9788641996
    """
    waves = [(n * math.pi) ** 2 for n in range(1, count + 1)]
    return [wave * math.sqrt(1 - load / wave) for wave in waves]


def clamped_pinned_load() -> float:
    """Euler load of the clamped and pinned column, x^2 with tan x = x.

    Examples
    --------
    >>> round(clamped_pinned_load(), 10)
    20.1907285564
    """
    return first_roots(lambda x: math.sin(x) - x * math.cos(x), 1, 1.0)[0] ** 2


def bessel_load(order: float) -> float:
    """9/4 j^2, j the first zero of the Bessel function J: a column buckled by a uniform load along it.

    Examples
    --------
    >>> round(bessel_load(1 / 3), 10), round(bessel_load(-1 / 3), 10)
    (18.9562655914, 7.8373474389)
    """
    return 9 / 4 * first_roots(lambda x: float(jv(order, x)), 1, 0.5)[0] ** 2


def subtangential_divergence(tangency: float) -> float:
    """Divergence load of Beck's column at a tangency below one half, cos sqrt(P) = -tangency / (1 - tangency).

    Examples
    --------
    >>> round(subtangential_divergence(0.4), 10)
    5.2924105965
    """
    return math.acos(-tangency / (1 - tangency)) ** 2


def ziegler_flutter(mass_ratio: float) -> tuple[float, float]:
    """Thrust and angular frequency at which Ziegler's pendulum flutters without damping.

    (5 + mu)/2 - sqrt(mu) and mu^(-1/4), where W^2 mu - W (5 + mu - 2 P) + 1 = 0 has a double root.

    Examples
    --------
    >>> round(ziegler_flutter(2.0)[0], 9)  # Ziegler (1952): 7/2 - sqrt(2)
    2.085786438
    """
    return (5 + mass_ratio) / 2 - math.sqrt(mass_ratio), mass_ratio**-0.25


def herrmann_jong(first: float, second: float) -> tuple[float, float]:
    """Thrust and angular frequency at which Ziegler's pendulum flutters with dashpots, its mass ratio being two.

    (4 b^2 + 33 b + 4)/(2 (b + 1)(b + 6)) + first second/2, b = first/second (Herrmann & Jong, 1965).

    Examples
    --------
    >>> round(28 * herrmann_jong(1e-9, 1e-9)[0], 9)  # 41/28 in the limit
    41.0
    """
    limit = 4 * first**2 + 33 * first * second + 4 * second**2
    limit /= 2 * (first + second) * (first + 6 * second)
    return limit + first * second / 2, math.sqrt((first + second) / (first + 6 * second))
