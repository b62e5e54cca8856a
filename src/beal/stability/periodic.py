"""The vehicle under a pulsating thrust P0 + P1 cos(Omega t) in its lowest modes, over one period."""

import math
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.pencil import Array, ComplexArray, pencil

APART = 1.01  # ratio of |mu| above which two modes may be separated; closer ones are kept or left out together
COARSEST = 2.0  # highest frequency times the first step; the free motion is exact, its beat with the kicks is not
FEWEST_STEPS = 8
MOST_OSCILLATIONS = 20_000
HALVINGS = 9
ROUNDING = 1e-12  # of the multipliers
POOR = 1e-6  # change that counts as settled once another halving does not make it smaller


@dataclass(frozen=True)
class PulsatingEquations:
    """q'' + D q' + (A + f B - f^2 S) q = 0 with f = P1 cos(Omega t), the roots of A being the lowest ones at P0.

    Parameters
    ----------
    A : ndarray, shape (k, k)
        Stiffness at P0 in the invariant subspace of the lowest modes, in rad^2/s^2.
    B : ndarray, shape (k, k)
        Stiffness per thrust.
    S : ndarray, shape (k, k)
        What the higher modes, which follow f B q without inertia, give back.
    D : ndarray, shape (k, k)
        Damping, in 1/s.
    mu : ndarray of complex, shape (k,)
        Eigenvalues of A in ascending order of modulus.
    rigid : int
        How many of the leading ones belong to rigid-body motions, which are kept where they drive the elastic ones.
    """

    A: Array
    B: Array
    S: Array
    D: Array
    mu: ComplexArray
    rigid: int

    @property
    def highest(self) -> float:
        """The largest frequency kept, in rad/s."""
        return math.sqrt(abs(self.mu[-1]))

    @property
    def neutral(self) -> float:
        """Modulus up to which a multiplier counts as no growth.

        On the unit circle a double one, at every edge and crossing, is good to the root of the rounding only; damping
        takes them off it.
        """
        return 1 + (ROUNDING if self.D.any() else math.sqrt(ROUNDING))

    @property
    def scale(self) -> float:
        """By which rates are divided, in rad/s, so that they compare with displacements."""
        return math.sqrt(max(abs(self.mu[0]), abs(self.mu[-1]) * 1e-6) ** 0.5 * self.highest)

    @property
    def generator(self) -> Array:
        """F of z' = F z with z = (q, q'/scale) under P0 alone, shape (2k, 2k)."""
        return np.block([[np.zeros_like(self.A), self.scale * np.eye(len(self.A))], [-self.A / self.scale, -self.D]])


def pulsating_equations(operators: Operators, thrust: float, modes: int) -> PulsatingEquations:
    """The lowest modes of the vehicle at a thrust, and what a change of thrust does to them.

    Rigid-body motions that drive no elastic coordinate are left out (theory, section 5). The modes above respond to the
    changing thrust as if they had no inertia: their share of the deflection under f B q is static.

    Parameters
    ----------
    operators : Operators
    thrust : float
        P0, in N.
    modes : int
        Elastic modes to keep, or a few more where the next one is close by; all where there are fewer.

    Returns
    -------
    PulsatingEquations
    """
    full = pencil(operators)
    shifted = full.stiffness(thrust) + full.shift * full.M
    inverse = np.asarray(np.linalg.solve(shifted, full.M), dtype=np.float64)
    inertia = np.linalg.eigvals(inverse).astype(complex)
    mu = 1 / inertia[np.abs(inertia) > 0] - full.shift
    mu = mu[np.argsort(np.abs(mu), kind="stable")]
    keep = min(full.rigid + modes, len(mu))
    while keep < len(mu) and abs(mu[keep]) < APART * abs(mu[keep - 1]):
        keep += 1
    limit = math.sqrt(abs(mu[keep - 1] * mu[keep])) if keep < len(mu) else math.inf
    right = _invariant(inverse, full.shift, limit)
    transposed = np.asarray(np.linalg.solve(shifted.T, full.M), dtype=np.float64)
    left = _invariant(transposed, full.shift, limit)
    left = np.asarray(np.linalg.solve(left.T @ full.M @ right, left.T), dtype=np.float64)
    follow = np.linalg.solve(shifted, full.K1 @ right)
    follow -= right @ (left @ full.M @ follow)
    A = left @ full.stiffness(thrust) @ right
    D = np.zeros_like(A) if full.C is None else left @ full.C @ right
    return PulsatingEquations(A, left @ full.K1 @ right, left @ full.K1 @ follow, D, mu[:keep], full.rigid)


def _invariant(inverse: Array, shift: float, limit: float) -> Array:
    """Columns that span the invariant subspace of (K + shift M)^-1 M with |mu| below a limit."""
    if math.isinf(limit):
        return np.eye(len(inverse))

    def is_low(re: float, im: float) -> bool:
        return abs(1 - shift * complex(re, im)) < limit * math.hypot(re, im)

    _, vectors, count = scipy.linalg.schur(inverse, sort=is_low)
    return np.asarray(vectors[:, :count])


def monodromy(
    equations: PulsatingEquations, amplitudes: Array, angular_frequency: float, tolerance: float
) -> tuple[Array, float]:
    """State transition over one period, for many amplitudes at once.

    Each step is half a step of free motion under P0, which is exact, a kick by the change of thrust, and another half
    (Strang's splitting). The error has even powers of the step, which is halved, and the results extrapolated as by
    Romberg until they settle. Without damping the second half of the period is the first one reversed.

    Parameters
    ----------
    equations : PulsatingEquations
    amplitudes : ndarray, shape (b,)
        P1, in N.
    angular_frequency : float
        Omega, in rad/s.
    tolerance : float
        Change of each matrix, beside its largest entry, at which to stop.

    Returns
    -------
    transition : ndarray, shape (b, 2k, 2k)
        Of (q, q'/scale).
    change : float
        By the last halving, beside the largest entry.

    Raises
    ------
    ModelError
        If a period holds too many oscillations.
    ConvergenceError
        If it does not settle.
    """
    oscillations = equations.highest / angular_frequency
    if oscillations > MOST_OSCILLATIONS:
        raise ModelError(
            f"angular_frequency: a period holds {oscillations:.0f} oscillations of the highest mode kept, "
            f"at most {MOST_OSCILLATIONS} are followed; raise it or keep fewer modes"
        )
    reversible = not equations.D.any()
    turn = math.pi if reversible else 2 * math.pi  # Omega t followed
    count = max(FEWEST_STEPS, math.ceil(turn * oscillations / COARSEST))
    before: list[Array] = []
    change = math.inf
    for halving in range(HALVINGS):
        row = [_split(equations, amplitudes, angular_frequency, turn, count << halving)]
        for power, coarser in enumerate(before, 1):
            row.append(row[-1] + (row[-1] - coarser) / (4**power - 1))
        moved = float(np.max(_largest(row[-1] - before[-1]) / _largest(row[-1]))) if before else math.inf
        exhausted = change <= moved <= POOR
        if exhausted or moved <= tolerance:
            return (_mirrored(row[-1]) if reversible else row[-1]), moved
        before, change = row, moved
    raise ConvergenceError(
        f"monodromy matrix at an angular frequency of {angular_frequency:.6g}: still changes by {change:.1e}; "
        "lower the amplitude"
    )


def _mirrored(half: Array) -> Array:
    """The whole period from its first half: the second is the first with time reversed."""
    sign = np.repeat([1.0, -1.0], half.shape[-1] // 2)
    return np.asarray(sign[:, None] * np.linalg.solve(half, sign[:, None] * half))


def _largest(matrices: Array) -> Array:
    return np.asarray(np.abs(matrices).max(axis=(1, 2)))


def _split(
    equations: PulsatingEquations, amplitudes: Array, angular_frequency: float, turn: float, count: int
) -> Array:
    """The product of ``count`` steps, shape (b, 2k, 2k)."""
    step = turn / (angular_frequency * count)
    half = scipy.linalg.expm(equations.generator * (step / 2))
    whole = half @ half
    size = len(equations.A)
    kick = np.vstack((equations.B, -equations.S)) * (step / equations.scale)
    state = np.tile(half, len(amplitudes))
    repeated = np.repeat(amplitudes, 2 * size)
    for cosine in np.cos((np.arange(count) + 0.5) * (turn / count)):
        f = cosine * repeated
        force = kick @ state[:size]
        state[size:] -= f * (force[:size] + f * force[size:])
        state = whole @ state
    back = np.linalg.solve(half, state)
    return np.asarray(back.reshape(2 * size, len(amplitudes), 2 * size).transpose(1, 0, 2))
