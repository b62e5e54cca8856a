"""Exact free-vibration modes of two equal uniform free-free beams joined by two springs.

The admissible functions of Irani & Kavianipour (2009), Eqs. (10)-(12), in their non-dimensional form:
EI = m = 1, total length 1, joint at x = split.
"""

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from beal.discretisation.joint_wavenumbers import Array, JointedBeam, wavenumbers
from beal.errors import ModelError

JointSign = Literal["natural", "printed"]


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
        Per stage, of cos(lambda s), sin(lambda s), exp(-lambda s) and exp(-lambda (l - s)), where s runs from
        the free end of the stage towards the joint and l is the stage's length.
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
        return np.asarray((-1.0) ** derivative * mirrored)

    @property
    def jumps(self) -> Array:
        """Jumps of slope and of deflection across the joint, aft minus forward, shape (2, count).

        Across a stiff spring they are the load divided by the stiffness, so exactly zero at a rigid joint.
        """
        signed = self.rotational_stiffness if self.sign == "natural" else -self.rotational_stiffness
        return np.array([self._jump(1, 2, signed), self._jump(0, 3, -self.shear_stiffness)])

    def _jump(self, derivative: int, load: int, stiffness: float) -> Array:
        if abs(stiffness) >= 1.0:
            return np.asarray(self.evaluate(1, 0.0, load)[0] / stiffness)
        aft, forward = self.evaluate(1, 0.0, derivative)[0], self.evaluate(0, self.split, derivative)[0]
        return np.asarray(aft - forward)

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

    They satisfy phi1''(L1) = phi2''(0) = k_r [phi2'(0) - phi1'(L1)] for the natural sign, which follows from
    the strain energy, or the opposite for the sign printed in Eq. (12), and for both
    phi1'''(L1) = phi2'''(0) = k_s [phi1(L1) - phi2(0)]. The printed sign is a spring of negative stiffness:
    while it is finite, the mode in which the vehicle folds has a negative lambda^4 and is left out.

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
    compliances = [1.0 / k if k > 0 else math.inf for k in (rotational_stiffness, shear_stiffness)]
    beam = JointedBeam(
        lengths=np.array([split, 1.0 - split]),
        compliances=np.array(compliances),
        rotation=-1.0 if sign == "printed" and compliances[0] < math.inf else 1.0,
    )
    found = wavenumbers(beam, count)
    coefficients = _normalised(beam, found, _coefficients(beam, found))
    return JointModes(split, rotational_stiffness, shear_stiffness, sign, found, coefficients)


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


def _shapes(wavenumbers: Array, coefficients: Array, length: float, s: Array, derivative: int) -> Array:
    """Derivative of the shapes of one stage at distances s from its free end, shape (len(s), count)."""
    phase = s[:, None] * wavenumbers
    turned = phase + derivative * math.pi / 2.0
    a, b, c, d = coefficients
    shapes = a * np.cos(turned) + b * np.sin(turned) + d * np.exp(phase - wavenumbers * length)
    return np.asarray(wavenumbers**derivative * (shapes + (-1.0) ** derivative * c * np.exp(-phase)))


def _coefficients(beam: JointedBeam, found: Array) -> Array:
    """Mode shapes up to a factor, shape (2, 4, count): the null vectors of the four conditions at the joint.

    The free end fixes cosine and sine in terms of the two exponentials, so each stage has two unknowns. They
    do not vanish, as the loads at the joint do, where a spring is absent or a free beam's frequency is hit.
    """
    z = beam.lengths[:, None] * found
    end, one = np.exp(-z), np.ones_like(z)
    # (stage, unknown, count, function) of cosine, sine and the two exponentials
    free = np.stack([np.stack([one, -one, one, 0 * one], axis=-1), np.stack([end, end, 0 * one, one], axis=-1)], axis=1)
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
    beams, springs = (share[..., None, None] for share in beam.shares(found))
    forward = np.array([[1.0], [0.0]])
    rows = [
        moment * mirror,
        shear,
        beams[0] * slope + springs[0] * moment * forward,
        beams[1] * deflection * mirror - springs[1] * shear * forward,
    ]
    vectors = np.linalg.svd(np.stack(rows, axis=1).reshape(-1, 4, 4))[2]
    # Two wavenumbers that agree to the last digits share a plane of null vectors: take one of each.
    double = np.diff(found, prepend=0.0) < 1e-12 * found
    null = np.where(double[:, None], vectors[:, 2], vectors[:, 3]).reshape(-1, 2, 2)
    return np.asarray(np.einsum("nsu,sunf->sfn", null, free))


def _normalised(beam: JointedBeam, found: Array, coefficients: Array) -> Array:
    """Scale to unit generalised mass; the Gram matrix also parts modes that share a frequency."""
    points, weights = _gauss(16 + 2 * found.size)  # lambda < pi (count + 3.5): exact to rounding
    gram = np.zeros((found.size, found.size))
    for stage, length in enumerate(beam.lengths):
        shapes = _shapes(found, coefficients[stage], length, points * length, 0)
        gram += shapes.T @ (shapes * (length * weights)[:, None])
    scale = 1.0 / np.sqrt(np.diag(gram))
    factor = np.linalg.cholesky(gram * scale * scale[:, None])
    coefficients = np.einsum("sfj,ij->sfi", coefficients * scale, np.linalg.inv(factor))
    nose, tail = 2.0 * coefficients[:, 0]  # at a free end the exponentials add up to the cosine
    return np.asarray(coefficients * np.sign(np.where(np.abs(nose) > 1e-9 * np.abs(tail), nose, tail)))


@cache
def _gauss(order: int) -> tuple[Array, Array]:
    points, weights = np.polynomial.legendre.leggauss(order)
    return (points + 1.0) / 2.0, weights / 2.0
