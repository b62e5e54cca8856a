"""The vehicle under a pulsating thrust P0 + P1 cos(Omega t) in its lowest modes, over one period."""

import math
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.pencil import Array, Pencil, pencil, reduced

APART = 1.01  # ratio of |mu| above which two modes may be separated; closer ones are kept or left out together
COARSEST = 2.0  # highest frequency times the first step; the free motion is exact, its beat with the kicks is not
FEWEST_STEPS = 8
MOST_OSCILLATIONS = 20_000
SPARE = 4  # modes beside those kept in which damped ones are sought
HALVINGS = 9
UNSHIFTED = 6  # steps in which the shift, small beside the roots left out, is taken from what follows
TERMS, NEGLIGIBLE = 6, 1e-15  # of the exponential of a kick
STEEP = 1e3  # largest entry of half a period that is still mirrored: its inverse loses as many digits twice
ROUNDING = 1e-12  # of the multipliers
POOR = 1e-6  # change that counts as settled once another halving does not make it smaller


@dataclass(frozen=True)
class PulsatingEquations:
    """z' = (F + f G + f^2 H) z with f = P1 cos(Omega t): the lowest modes at P0 and what a change of thrust does.

    Parameters
    ----------
    F : ndarray, shape (2k, 2k)
        Its roots are the lowest of the vehicle under P0. Undamped, z = (q, q'/scale).
    G : ndarray, shape (2k, 2k)
        Change per thrust.
    H : ndarray, shape (2k, 2k)
        What the higher modes, which follow f G z at once, give back.
    A, B : ndarray, shape (k, k)
        Stiffness at P0, in rad^2/s^2, and per thrust in the invariant subspace of the lowest modes without damping.
    highest : float
        The largest frequency kept, in rad/s.
    rigid : int
        How many of the lowest modes are of rigid-body motions, which are kept where they drive the elastic ones.
    damped : bool
    """

    F: Array
    G: Array
    H: Array
    A: Array
    B: Array
    highest: float
    rigid: int
    damped: bool

    @property
    def neutral(self) -> float:
        """Modulus up to which a multiplier counts as no growth.

        On the unit circle a double one, at every edge and crossing, is good to the root of the rounding only; damping
        takes them off it.
        """
        return 1 + (ROUNDING if self.damped else math.sqrt(ROUNDING))


def pulsating_equations(operators: Operators, thrust: float, modes: int) -> PulsatingEquations:
    """The lowest modes of the vehicle at a thrust, and what a change of thrust does to them.

    Rigid-body motions that drive no elastic coordinate are left out (theory, section 5). The modes above respond to the
    changing thrust as if they had no inertia.

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
    A, B, S, square = _lowest(-full.stiffness(thrust), full.M, -full.K1, full.shift, full.rigid + modes)
    highest, damped = math.sqrt(square), full.C is not None
    scale = math.sqrt(math.sqrt(full.shift) * highest)
    if damped:
        F, G, H, highest = _lowest_damped(reduced(full, modes + SPARE, modes), thrust, 2 * len(A), highest, scale)
    else:
        one, none = np.eye(len(A)), np.zeros_like(A)
        F = np.block([[none, scale * one], [A / scale, none]])
        G, H = (np.block([[none, none], [change / scale, none]]) for change in (B, S))
    return PulsatingEquations(F, G, H, -A, -B, highest, full.rigid, damped)


def _lowest_damped(
    full: Pencil, thrust: float, count: int, highest: float, scale: float
) -> tuple[Array, Array, Array, float]:
    """F, G, H and the largest modulus, all roots up to the highest frequency kept, as of overdamped modes too."""
    M, C = full.M, np.asarray(full.C)
    one, none = np.eye(len(M)), np.zeros_like(M)
    return _lowest(
        np.block([[none, scale * one], [-full.stiffness(thrust) / scale, -C]]),
        np.block([[one, none], [none, M]]),
        np.block([[none, none], [-full.K1 / scale, none]]),
        math.sqrt(full.shift),
        count,
        highest,
    )


def _lowest(
    N: Array, E: Array, N1: Array, shift: float, count: int, at_least: float = 0.0
) -> tuple[Array, Array, Array, float]:
    """E z' = (N + f N1) z in the lowest roots, those above following at once: z' = (N_ + f N1_ + f^2 N2_) z.

    Parameters
    ----------
    N, E, N1 : ndarray, shape (n, n)
    shift : float
        Not a root.
    count : int
        Roots of smallest modulus to keep, or a few more where the next one is close by.
    at_least : float
        Modulus up to which all are kept.

    Returns
    -------
    N, N1, N2 : ndarray, shape (k, k)
    float
        The largest modulus kept.
    """
    shifted = N - shift * E
    inverse, transposed = (np.asarray(np.linalg.solve(side, E), dtype=np.float64) for side in (shifted, shifted.T))
    images = np.linalg.eigvals(inverse).astype(complex)
    moduli = np.sort(np.abs(shift + 1 / images[np.abs(images) > 0]))
    keep = min(max(count, int(np.sum(moduli <= at_least))), len(moduli))
    while keep < len(moduli) and moduli[keep] < APART * moduli[keep - 1]:
        keep += 1
    limit = math.sqrt(moduli[keep - 1] * moduli[keep]) if keep < len(moduli) else math.inf
    right, left = (_invariant(image, shift, limit) for image in (inverse, transposed))
    left = np.asarray(np.linalg.solve(left.T @ E @ right, left.T), dtype=np.float64)
    first = np.linalg.solve(shifted, N1 @ right)
    first -= right @ (left @ E @ first)
    follow = first
    for _ in range(UNSHIFTED):
        follow = first - shift * inverse @ follow
    return left @ N @ right, left @ N1 @ right, -left @ N1 @ follow, float(moduli[keep - 1])


def _invariant(inverse: Array, shift: float, limit: float) -> Array:
    """Columns that span the invariant subspace of (N - shift E)^-1 E that belongs to roots of modulus below a limit."""
    if math.isinf(limit):
        return np.eye(len(inverse))

    def is_low(re: float, im: float) -> bool:
        return abs(1 + shift * complex(re, im)) < limit * math.hypot(re, im)

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
        Of z.
    change : float
        By the last halving, beside the largest entry.

    Raises
    ------
    ModelError
        If a period holds too many oscillations or too much growth.
    ConvergenceError
        If it does not settle.
    """
    oscillations = equations.highest / angular_frequency
    if oscillations > MOST_OSCILLATIONS:
        raise ModelError(
            f"angular_frequency: a period holds {oscillations:.0f} oscillations of the highest mode kept, "
            f"at most {MOST_OSCILLATIONS} are followed; raise it or keep fewer modes"
        )
    if not equations.damped:
        half, change = _settled(equations, amplitudes, angular_frequency, math.pi, tolerance)
        if np.abs(half).max() <= STEEP:
            return _mirrored(half), change
    return _settled(equations, amplitudes, angular_frequency, 2 * math.pi, tolerance)


def _settled(
    equations: PulsatingEquations, amplitudes: Array, angular_frequency: float, turn: float, tolerance: float
) -> tuple[Array, float]:
    """State transition until Omega t = ``turn``, and its change by the last halving."""
    count = max(FEWEST_STEPS, math.ceil(turn * equations.highest / (angular_frequency * COARSEST)))
    before: list[Array] = []
    change = math.inf
    for halving in range(HALVINGS):
        with np.errstate(over="ignore", invalid="ignore"):
            row = [_split(equations, amplitudes, angular_frequency, turn, count << halving)]
        if not np.isfinite(row[0]).all():
            raise ModelError(
                f"angular_frequency: at {angular_frequency:g} a motion outgrows all numbers in a period; "
                "raise it, or lower the thrust or the amplitude"
            )
        for power, coarser in enumerate(before, 1):
            row.append(row[-1] + (row[-1] - coarser) / (4**power - 1))
        moved = float(np.max(_largest(row[-1] - before[-1]) / _largest(row[-1]))) if before else math.inf
        exhausted = change <= moved <= POOR
        if exhausted or moved <= tolerance:
            return row[-1], moved
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
    size = len(equations.F)
    half = scipy.linalg.expm(equations.F * (step / 2))
    whole = half @ half
    felt, pushed = (slice(None),) * 2 if equations.damped else (slice(size // 2), slice(size // 2, None))
    powers = _kick(equations, step, float(amplitudes.max()))[:, pushed, felt]
    stacked = powers.reshape(-1, powers.shape[-1])
    state = np.tile(half, len(amplitudes))
    repeated = np.repeat(amplitudes, size)
    for cosine in np.cos((np.arange(count) + 0.5) * (turn / count)):
        f = cosine * repeated
        first, *higher = (stacked @ state[felt]).reshape(len(powers), -1, len(f))
        moved = 0.0
        for change in reversed(higher):
            moved = f * (change + moved)
        state[pushed] += f * (first + moved)
        state = whole @ state
    back = np.linalg.solve(half, state)
    return np.asarray(back.reshape(size, len(amplitudes), size).transpose(1, 0, 2))


def _kick(equations: PulsatingEquations, step: float, largest: float) -> Array:
    """Coefficients of f, f^2, ... in exp(step (f G + f^2 H)) - 1, as many as matter, shape (powers, 2k, 2k).

    Without damping they are the two of the exponent: displacements push rates, which do not push.
    """
    exponent = step * np.array([equations.G, equations.H])
    if not equations.damped:
        return exponent
    none = np.zeros((2 * TERMS, *equations.F.shape))
    term, total = none.copy(), none.copy()
    term[:2] = total[:2] = exponent
    for number in range(2, TERMS + 1):
        following = none.copy()
        for power, change in enumerate(exponent, 1):
            following[power:] += change @ term[:-power] / number
        term = following
        total += term
    size = np.abs(total).max(axis=(1, 2)) * largest ** np.arange(1.0, len(total) + 1)
    matters = np.flatnonzero(size > NEGLIGIBLE)
    return total[: max(2, matters.max(initial=0) + 1)]
