"""Exact wavenumbers of two equal uniform free-free beams joined by two springs, none lost and none doubled.

At wavenumber lambda a beam that carries the moment phi'' = lambda^2 M and the shear phi''' = lambda^3 Q at
its end answers with a slope and a deflection there that are known in closed form (EI = m = 1),

    slope / lambda = e M + g Q,     deflection = -g M + h Q,

so the joint leaves a symmetric 2 x 2 condition N(lambda) (M, Q) = 0,

    N = [[e1 + e2 + lambda / k_r, g1 - g2], [g1 - g2, lambda^3 / k_s - h1 - h2]].

Between its poles, the frequencies of the free beams, the eigenvalues of N rise through zero and never fall
through it. So the number of roots below lambda is the number of poles below plus the number of positive
eigenvalues there (Wittrick & Williams 1971), also when 1/k_r is negative.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.errors import ConvergenceError

Array = NDArray[np.float64]

# At small a, sin a cosh a - cos a sinh a is a difference of nearly equal numbers: a^3 times this in a^4.
_SERIES = (2 / 3, -1 / 315, 64 / math.factorial(11), -256 / math.factorial(15))


@dataclass(frozen=True)
class JointedBeam:
    """Two free-free beams with EI = m = 1 and a joint between them.

    Parameters
    ----------
    lengths : ndarray, shape (2,)
        Of the forward and the aft beam.
    compliances : ndarray, shape (2,)
        1 / k_r and 1 / k_s, from 0 to infinity.
    rotation : float
        1, or -1 for a rotational spring of negative stiffness, which must not be absent.
    """

    lengths: Array
    compliances: Array
    rotation: float

    def shares(self, wavenumbers: Array) -> tuple[Array, Array]:
        """Weights of the beams' and of the springs' part of N, each of shape (2, n) and at most 1 in size.

        N scaled by this congruence has the same signs, and is exact for rigid and for absent springs.
        """
        beams = 1.0 / (1.0 + self.compliances[:, None] * np.stack([wavenumbers, wavenumbers**3]))
        return beams, np.array([[self.rotation], [1.0]]) * (1.0 - beams)


def wavenumbers(beam: JointedBeam, count: int) -> Array:
    """The lowest positive wavenumbers, ascending: root i is where the count of roots reaches i.

    Parameters
    ----------
    beam : JointedBeam
    count : int
        Number of wavenumbers, rigid-body motions (lambda = 0) not counted.

    Returns
    -------
    ndarray, shape (count,)

    Raises
    ------
    ConvergenceError
        If they cannot be found to the precision of the machine.

    References
    ----------
    Wittrick & Williams (1971); Chandrupatla (1997) for the bracketed iteration.

    Examples
    --------
    >>> wavenumbers(JointedBeam(np.array([0.2, 0.8]), np.zeros(2), 1.0), 2)
    array([4.73004074, 7.85320462])
    """
    # A free beam has at least z/pi - 1.51 frequencies below z, so two of them count + 0.4 below this end.
    end = math.pi * (count + 3.5)
    grid = np.linspace(0.0, end, 20 * (count + 4))[1:]
    condition = _condition(beam, grid)
    below, low, high = condition
    index = np.arange(1, count + 1)
    after = np.searchsorted(below + (low > 0) + (high > 0), index)
    before = np.maximum(after - 1, 0)
    return _bracketed_roots(
        lambda trial: _passed(index, *_condition(beam, trial)),
        np.where(after > 0, grid[before], 0.0),
        grid[after],
        np.where(after > 0, _passed(index, *(part[before] for part in condition)), -1.0),
        _passed(index, *(part[after] for part in condition)),
    )


def _passed(index: NDArray[np.intp], below: Array, low: Array, high: Array) -> Array:
    """Positive where at least `index` roots lie below, negative where fewer do, and continuous in lambda.

    The eigenvalue that decides is the larger one if one root is still missing and the smaller one if two are.
    A pole takes the larger through infinity to the bottom as it raises the count by one, so the function does
    not notice it.
    """
    missing = np.clip(index - below, 0, 3).astype(np.intp)
    one = np.ones_like(low)
    levels = np.stack([one, high / (1.0 + np.abs(high)), low / (1.0 + np.abs(low)), -one])
    return np.asarray(levels[missing, np.arange(index.size)], dtype=np.float64)


def _condition(beam: JointedBeam, trial: Array) -> tuple[Array, Array, Array]:
    """Poles below each trial wavenumber, and the two eigenvalues of N there, N scaled by a congruence.

    An absent spring leaves an eigenvalue at 1 for ever, so the poles are counted from minus their number.
    """
    e, g, h, determinants, poles = _tip_receptances(beam.lengths[:, None] * trial / 2.0)
    beams, springs = beam.shares(trial)
    rotation = beams[0] * (e[0] + e[1]) + springs[0]
    shear = springs[1] - beams[1] * (h[0] + h[1])
    coupling = np.sqrt(beams[0] * beams[1]) * (g[0] - g[1])
    # rotation * shear - coupling**2, but without the squares of poles that cancel in it
    determinant = (
        beams[0] * beams[1] * (determinants.sum(axis=0) + 2.0 * g[0] * g[1] - e[0] * h[1] - e[1] * h[0])
        + beams[0] * (e[0] + e[1]) * springs[1]
        + springs[0] * shear
    )
    mean = (rotation + shear) / 2.0
    large = mean + np.copysign(np.hypot((rotation - shear) / 2.0, coupling), mean)
    small = determinant / large
    absent = np.count_nonzero(np.isinf(beam.compliances))
    return poles.sum(axis=0) - absent, np.minimum(small, large), np.maximum(small, large)


def _tip_receptances(a: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Receptances e, g, h of a free beam's end, -e h - g^2, and its poles below a = lambda length / 2.

    A load at one end is half a symmetric and half an antisymmetric pair of loads, whose poles are the zeros
    of p = sin a cosh a + cos a sinh a and of q = sin a cosh a - cos a sinh a, both scaled by exp(-a).
    """
    s, c = np.sin(a), np.cos(a)
    cosh, sinh = (1.0 + np.exp(-2.0 * a)) / 2.0, -np.expm1(-2.0 * a) / 2.0
    x = np.minimum(a, 0.5) ** 4
    series = a**3 * np.exp(-a) * (_SERIES[0] + x * (_SERIES[1] + x * (_SERIES[2] + x * _SERIES[3])))
    p = s * cosh + c * sinh
    q = np.where(a < 0.5, series, s * cosh - c * sinh)
    p, q = np.where(p == 0.0, 1e-30, p), np.where(q == 0.0, 1e-30, q)
    cc, ss = c * cosh, s * sinh
    e = ss / p - cc / q
    g = (p / q - q / p) / 2.0
    h = cc / p + ss / q
    # From j pi to (j + 1) pi, p changes sign once, away from (-1)^j, and q once, to it (not for j = 0).
    j = np.floor(a / math.pi)
    parity = 1.0 - 2.0 * (j % 2.0)
    poles = 2.0 * j + (p * parity < 0.0) - (q * parity < 0.0)
    return e, g, h, (cc - ss) * (cc + ss) / (p * q), poles


def _bracketed_roots(f: Callable[[Array], Array], a: Array, b: Array, fa: Array, fb: Array) -> Array:
    """Zeros of f between a and b to the last digits, by inverse quadratic steps or bisection."""
    t = np.full_like(a, 0.5)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for _ in range(200):
            x = a + t * (b - a)
            fx = f(x)
            same = np.sign(fx) == np.sign(fa)
            c, fc = np.where(same, a, b), np.where(same, fa, fb)
            b, fb = np.where(same, b, a), np.where(same, fb, fa)
            a, fa = x, fx
            best = np.where(np.abs(fa) < np.abs(fb), a, b)
            smallest = 2.0 * np.finfo(float).eps * best / np.abs(b - a)
            if np.all((smallest > 0.5) | (fa == 0.0) | (fb == 0.0)):
                return best
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            step = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            t = np.where((phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi), step, 0.5)
            smallest = np.minimum(smallest, 0.5)
            t = np.clip(t, smallest, 1.0 - smallest)
    raise ConvergenceError("joint modes: the wavenumbers did not settle; bring the stiffnesses nearer to 1")
