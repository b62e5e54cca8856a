"""Exact free-vibration modes of two equal uniform free-free beams joined by two springs.

The admissible functions of Irani & Kavianipour (2009), Eqs. (10)-(12), in their non-dimensional form: EI = m = 1,
total length 1, joint at x = split. At wavenumber lambda a beam that carries the moment phi'' = lambda^2 M and the
shear phi''' = lambda^3 Q at its end answers with a deflection and a slope there that are known in closed form,

    slope / lambda = e M + g Q,     deflection = -g M + h Q,

so the joint leaves a symmetric 2 x 2 condition N(lambda) (M, Q) = 0,

    N = [[e1 + e2 + lambda / k_r, g1 - g2], [g1 - g2, lambda^3 / k_s - h1 - h2]].

Unscaled, N grows with lambda between its poles, which are the frequencies of the free beams. So the number of roots
below lambda is the number of poles below it plus the number of positive eigenvalues of N there (Wittrick & Williams
1971), also when 1/k_r is negative: no root is lost or found twice, however close two of them are.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beal.errors import ConvergenceError, ModelError

Array = NDArray[np.float64]
JointSign = Literal["natural", "printed"]

# Below 0.5, sin a cosh a - cos a sinh a is a difference of nearly equal numbers; its series is a^3 times this in a^4.
_SERIES = (2 / 3, -1 / 315, 64 / math.factorial(11), -256 / math.factorial(15))


@dataclass(frozen=True)
class JointModes:
    """Modes phi_i of the jointed beam, of unit generalised mass and with positive deflection at the nose.

    Where the nose is at rest (no spring couples the stages) the tail's deflection is positive.

    Parameters
    ----------
    split : float
        Length of the first stage; the second has 1 - split.
    rotational_stiffness, shear_stiffness : float
        k_r L / EI and k_s L^3 / EI, possibly 0 or infinite.
    sign : {"natural", "printed"}
        Sign of the rotational line of Eq. (12).
    wavenumbers : ndarray, shape (count,)
        lambda_i, ascending; the angular frequencies are lambda_i^2.
    coefficients : ndarray, shape (2, 4, count)
        Per stage, of cos(lambda s), sin(lambda s), exp(-lambda s) and exp(-lambda (l - s)), where s runs from the
        free end of the stage towards the joint and l is the stage's length.
    """

    split: float
    rotational_stiffness: float
    shear_stiffness: float
    sign: JointSign
    wavenumbers: Array
    coefficients: Array

    def evaluate(self, stage: int, x: ArrayLike, derivative: int = 0) -> Array:
        """The modes of one stage, or a derivative of them.

        Parameters
        ----------
        stage : int
            0 for the forward stage, 1 for the aft one.
        x : array_like, shape (n,)
            From the front of the stage.
        derivative : int
            Order of the derivative, from 0.

        Returns
        -------
        ndarray, shape (n, count)
        """
        points = np.atleast_1d(np.asarray(x, dtype=float))
        if stage == 0:
            return _shapes(self.wavenumbers, self.coefficients[0], self.split, points, derivative)
        length = 1.0 - self.split
        mirrored = _shapes(self.wavenumbers, self.coefficients[1], length, length - points, derivative)
        return -mirrored if derivative % 2 else mirrored

    @property
    def jumps(self) -> Array:
        """Jumps of slope and of deflection across the joint, aft minus forward, shape (2, count).

        Across a stiff spring they are the load divided by the stiffness, so exactly zero at a rigid joint.
        """
        signed = self.rotational_stiffness if self.sign == "natural" else -self.rotational_stiffness
        return np.array([self._jump(1, 2, signed), self._jump(0, 3, -self.shear_stiffness)])

    def _jump(self, derivative: int, load: int, stiffness: float) -> Array:
        if abs(stiffness) >= 1.0:
            return self.evaluate(1, 0.0, load)[0] / stiffness
        return self.evaluate(1, 0.0, derivative)[0] - self.evaluate(0, self.split, derivative)[0]

    @property
    def paper_coefficients(self) -> Array:
        """A1 to A8 of Eq. (10), shape (count, 8).

        Do not evaluate shapes from them at a high lambda, where cosh and sinh cancel; `evaluate` does not.
        """
        (a1, b1, c1, d1), (a2, b2, c2, d2) = self.coefficients
        z = self.wavenumbers * (1.0 - self.split)
        cos, sin, end = np.cos(z), np.sin(z), np.exp(-z)
        aft = [a2 * sin - b2 * cos, a2 * cos + b2 * sin, c2 * end - d2, c2 * end + d2]
        decayed = d1 * np.exp(-self.wavenumbers * self.split)
        return np.column_stack([b1, a1, decayed - c1, decayed + c1, *aft])


def joint_modes(
    split: float,
    rotational_stiffness: float,
    shear_stiffness: float,
    count: int,
    sign: JointSign = "natural",
) -> JointModes:
    """The lowest modes of positive lambda of two equal uniform beams joined by two springs.

    They satisfy phi1''(L1) = phi2''(0) = k_r [phi2'(0) - phi1'(L1)] for the natural sign, which is what the strain
    energy asks for, or the opposite for the sign printed in Eq. (12), and phi1''' = phi2''' = k_s [phi1 - phi2].
    The printed sign is a spring of negative stiffness: it has one mode less, whose lambda^4 is negative.

    Parameters
    ----------
    split : float
        Station of the joint, between 0 and 1.
    rotational_stiffness, shear_stiffness : float
        k_r L / EI and k_s L^3 / EI, from 0 to infinity.
    count : int
        Number of modes, rigid-body motions (lambda = 0) not counted.
    sign : {"natural", "printed"}
        Sign of the rotational condition.

    Raises
    ------
    ModelError
        If an argument is out of its range.
    ConvergenceError
        If the wavenumbers cannot be found to the precision of the machine.

    References
    ----------
    Irani & Kavianipour (2009), Eqs. (10)-(12); Wittrick & Williams (1971).

    Examples
    --------
    >>> joint_modes(0.2, 3000.0, 3000.0, 4).wavenumbers.round(4).tolist()
    [4.7206, 7.8266, 10.992, 13.9618]
    >>> joint_modes(0.2, 3000.0, 3000.0, 4, sign="printed").wavenumbers.round(4).tolist()
    [4.7209, 7.8285, 10.9961, 13.9661]
    """
    _check(split, rotational_stiffness, shear_stiffness, count, sign)
    joint = _Joint(
        lengths=np.array([split, 1.0 - split]),
        compliances=np.array([1.0 / k if k > 0 else math.inf for k in (rotational_stiffness, shear_stiffness)]),
        rotation=-1.0 if sign == "printed" and rotational_stiffness > 0 else 1.0,
    )
    wavenumbers = _wavenumbers(joint, count)
    coefficients = _normalised(joint, wavenumbers, _coefficients(joint, wavenumbers))
    return JointModes(split, rotational_stiffness, shear_stiffness, sign, wavenumbers, coefficients)


def _check(split: float, rotational_stiffness: float, shear_stiffness: float, count: int, sign: str) -> None:
    problems = []
    if not 0.0 < split < 1.0:
        problems.append(("split", f"must lie between 0 and 1, found {split}"))
    for path, stiffness in (
        ("rotational_stiffness", rotational_stiffness),
        ("shear_stiffness", shear_stiffness),
    ):
        if not stiffness >= 0.0:
            problems.append((path, f"must be zero, positive or inf, found {stiffness}"))
    if count < 1:
        problems.append(("count", f"must be at least 1, found {count}"))
    if sign not in ("natural", "printed"):
        problems.append(("sign", f"must be 'natural' or 'printed', found {sign!r}"))
    if problems:
        raise ModelError(problems)


@dataclass(frozen=True)
class _Joint:
    lengths: Array
    compliances: Array  # of rotation and shear, 0 to inf
    rotation: float  # -1 turns the rotational spring into one of negative stiffness

    def shares(self, wavenumbers: Array) -> tuple[Array, Array]:
        """Weights of the beams' and of the springs' part of N, each 0 to 1, so that both extremes are exact."""
        beams = 1.0 / (1.0 + self.compliances[:, None] * np.stack([wavenumbers, wavenumbers**3]))
        return beams, np.array([[self.rotation], [1.0]]) * (1.0 - beams)


def _wavenumbers(joint: _Joint, count: int) -> Array:
    """Zeros of the functions of `_passed`: root i is where the count of roots reaches i."""
    # A free beam has at least z/pi - 1.51 frequencies below z, so two of them count + 0.4 below this end.
    end = math.pi * (count + 3.5)
    grid = np.linspace(0.0, end, 20 * (count + 4))[1:]
    condition = _condition(joint, grid)
    below, low, high = condition
    index = np.arange(1, count + 1)
    after = np.searchsorted(below + (low > 0) + (high > 0), index)
    before = np.maximum(after - 1, 0)
    return _bracketed_roots(
        lambda wavenumbers: _passed(index, *_condition(joint, wavenumbers)),
        np.where(after > 0, grid[before], 0.0),
        grid[after],
        np.where(after > 0, _passed(index, *(part[before] for part in condition)), -1.0),
        _passed(index, *(part[after] for part in condition)),
    )


def _passed(index: NDArray[np.intp], below: Array, low: Array, high: Array) -> Array:
    """Positive where at least `index` roots lie below, negative where fewer do, and continuous in lambda.

    The eigenvalue that decides is the larger one if one is still missing and the smaller one if two are. A pole takes
    the larger through infinity to the bottom as it raises the count by one, so the function does not notice it.
    """
    missing = np.clip(index - below, 0, 3).astype(np.intp)
    one = np.ones_like(low)
    levels = np.stack([one, high / (1.0 + np.abs(high)), low / (1.0 + np.abs(low)), -one])
    return np.asarray(levels[missing, np.arange(index.size)], dtype=np.float64)


def _condition(joint: _Joint, wavenumbers: Array) -> tuple[Array, Array, Array]:
    """Poles below each wavenumber, and the two eigenvalues of N there, N scaled by a congruence.

    Absent springs leave an eigenvalue at 1 for ever; the poles are counted from minus their number.
    """
    e, g, h, determinants, poles = _tip_receptances(joint.lengths[:, None] * wavenumbers / 2.0)
    beams, springs = joint.shares(wavenumbers)
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
    absent = np.count_nonzero(np.isinf(joint.compliances))
    return poles.sum(axis=0) - absent, np.minimum(small, large), np.maximum(small, large)


def _tip_receptances(a: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Receptances e, g, h of a free beam's end, -e h - g^2, and its poles below; a is half of lambda times length.

    A load at one end is half a symmetric and half an antisymmetric pair of loads, whose poles are the zeros of
    p = sin a cosh a + cos a sinh a and of q = sin a cosh a - cos a sinh a. All hyperbolic functions are scaled by exp(-a).
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
    # Between j pi and (j + 1) pi both p and q have one zero (q none for j = 0) and start with the sign of (-1)^j, -(-1)^j.
    j = np.floor(a / math.pi)
    parity = 1.0 - 2.0 * (j % 2.0)
    poles = 2.0 * j + (p * parity < 0.0) - (q * parity < 0.0)
    return e, g, h, (cc - ss) * (cc + ss) / (p * q), poles


def _bracketed_roots(f: Callable[[Array], Array], a: Array, b: Array, fa: Array, fb: Array) -> Array:
    """Zeros of f between a and b, to the last digits: inverse quadratic steps or bisection (Chandrupatla 1997)."""
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
    raise ConvergenceError("joint modes: the wavenumbers did not settle; check that the stiffnesses are sensible")


def _shapes(wavenumbers: Array, coefficients: Array, length: float, s: Array, derivative: int) -> Array:
    """Derivative of the shapes of one stage at distances s from its free end, shape (len(s), count)."""
    phase = s[:, None] * wavenumbers
    turned = phase + derivative * math.pi / 2.0
    a, b, c, d = coefficients
    shapes = a * np.cos(turned) + b * np.sin(turned) + d * np.exp(phase - wavenumbers * length)
    return np.asarray(wavenumbers**derivative * (shapes + (-1.0) ** derivative * c * np.exp(-phase)))


def _coefficients(joint: _Joint, wavenumbers: Array) -> Array:
    """Mode shapes up to a factor, shape (2, 4, count): the null vectors of the four conditions at the joint.

    The free end fixes cosine and sine in terms of the two exponentials, so each stage has two unknowns. Unlike the
    loads at the joint, these do not vanish where the springs are soft or a frequency of a free beam is hit.
    """
    z = joint.lengths[:, None] * wavenumbers
    end, one = np.exp(-z), np.ones_like(z)
    # (stage, unknown, count, function) of cosine, sine and the two exponentials
    free = np.stack(
        [np.stack([one, -one, one, 0 * one], axis=-1), np.stack([end, end, 0 * one, one], axis=-1)], axis=1
    )
    cos, sin = np.cos(z), np.sin(z)
    # (derivative over lambda^derivative, stage, count, function) at the joint
    tip = np.stack(
        [
            np.stack([cos, sin, end, one], axis=-1),
            np.stack([-sin, cos, -end, one], axis=-1),
            np.stack([-cos, -sin, end, one], axis=-1),
            np.stack([sin, -cos, -end, one], axis=-1),
        ]
    )
    deflection, slope, moment, shear = np.einsum("dsnf,sunf->dnsu", tip, free)
    mirror = np.array([[1.0], [-1.0]])  # stage, unknown: the aft stage is seen from the tail
    beams, springs = (share[..., None, None] for share in joint.shares(wavenumbers))
    forward = np.array([[1.0], [0.0]])
    rows = [
        moment * mirror,
        shear,
        beams[0] * slope + springs[0] * moment * forward,
        beams[1] * deflection * mirror - springs[1] * shear * forward,
    ]
    vectors = np.linalg.svd(np.stack(rows, axis=1).reshape(-1, 4, 4))[2]
    # Two wavenumbers that agree to the last digits share a plane of null vectors: take one of each.
    double = np.diff(wavenumbers, prepend=0.0) < 1e-12 * wavenumbers
    null = np.where(double[:, None], vectors[:, 2], vectors[:, 3]).reshape(-1, 2, 2)
    return np.asarray(np.einsum("nsu,sunf->sfn", null, free))


def _normalised(joint: _Joint, wavenumbers: Array, coefficients: Array) -> Array:
    """Scale to unit generalised mass; the Gram matrix also parts modes that share a frequency."""
    points, weights = _gauss(16 + 2 * wavenumbers.size)  # lambda < pi (count + 3.5): exact to rounding
    gram = np.zeros((wavenumbers.size, wavenumbers.size))
    for stage, length in enumerate(joint.lengths):
        shapes = _shapes(wavenumbers, coefficients[stage], length, points * length, 0)
        gram += shapes.T @ (shapes * (length * weights)[:, None])
    scale = 1.0 / np.sqrt(np.diag(gram))
    factor = np.linalg.cholesky(gram * scale * scale[:, None])
    coefficients = np.linalg.solve(factor, (coefficients * scale).reshape(8, -1).T).T.reshape(coefficients.shape)
    nose, tail = 2.0 * coefficients[:, 0]  # at a free end the exponentials add up to the cosine
    return np.asarray(coefficients * np.sign(np.where(np.abs(nose) > 1e-9 * np.abs(tail), nose, tail)))


@cache
def _gauss(order: int) -> tuple[Array, Array]:
    points, weights = np.polynomial.legendre.leggauss(order)
    return (points + 1.0) / 2.0, weights / 2.0
