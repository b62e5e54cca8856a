"""Every critical thrust of a damped reduced pencil at once, without a step in thrust that could pass one over.

A root i omega and its conjugate add up to zero. With s X -> A X + X A^T, the Lyapunov operator of the equations in
first-order form, A = [0 1; -M^-1 K, -M^-1 C], has the eigenvalues s_i + s_j, and on antisymmetric X each pair i < j
once (the bialternate product; Guckenheimer, Myers & Sturmfels 1997). Eliminated blockwise and freed of the inverses
of M, it is singular where

    M X K^T - K X M + M Y C^T + C Y M = 0        X antisymmetric
    C X K^T + K X C^T + K Y M - M Y K^T = 0      Y symmetric

has a solution: n^2 equations that are linear in K and so in the thrust. All thrusts with a root on the imaginary axis
are the eigenvalues of one matrix. For a damping e C with e -> 0, X = e X' gives the same equations with e^2 before
the first two terms of the second line: without these two they are the limit itself.
"""

from dataclasses import replace

import numpy as np

from beal.errors import ConvergenceError
from beal.stability.complete import REFERENCE, Event, inverse_roots
from beal.stability.damped_roots import NEUTRAL, damped_roots
from beal.stability.double_root import divergence
from beal.stability.imaginary_root import damping_of, imaginary_root
from beal.stability.pairs import matrix, pairs
from beal.stability.pencil import UNCOUPLED, Array, ComplexArray, Pencil
from beal.stability.ridge import Kind
from beal.stability.zero_roots import SAME, ZERO, rigid_body_root, zero_roots

Crossing = tuple[float, float, Kind]  # thrust, W = omega^2, kind
FLUTTER: Kind = "flutter"
DIVERGENCE: Kind = "divergence"
ON_AXIS = 1e-4  # Re s, beside |s|
FIRST_SHARES = np.array([1e-5, 1e-4, 1e-3, 1e-2])  # of the limit
SAMPLES = 24  # thrusts at which the unstable roots are counted to see that no crossing is missing
BISECTIONS = 40
GROWING = 1e-9  # Re s, beside |s|, from which a root counts as growing
CLOSEST, BESIDE_AXIS = 3, 0.1  # roots that are tried at an approximate thrust: so many, |Re s| up to this share of |s|


def damped_events(pencil: Pencil, undamped: Pencil, limit: float, watched: int) -> list[Event]:
    """All critical thrusts of a damped reduced pencil from 0 to a limit, in order.

    Parameters
    ----------
    pencil : Pencil
        Reduced, with diagonal M; the cost grows with the sixth power of its size.
    undamped : Pencil
        Reduced, of the same vehicle without its damping: numbers the modes.
    limit : float
    watched : int
        Number of elastic modes whose frequencies are looked at.

    Returns
    -------
    list of Event
        ``modes`` is twice the number of the undamped vehicle's mode that is closest at this thrust.
    """
    top = highest_frequency(undamped, watched)
    static = with_rates(pencil)
    drifts = pencil.rigid > undamped.rigid
    found: list[Crossing] = []
    for thrust in crossings(pencil, limit):
        found += _flutter(pencil, thrust, top)
    for thrust in zero_roots(static, limit):
        found += _divergence(static, thrust)
    for thrust in _missed(pencil, [thrust for thrust, _, _ in found], limit, top):
        resolved = _flutter(pencil, thrust, top, len(pencil.M), 1.0) + _divergence(static, thrust)
        slow = len(_growing(pencil, thrust / 2, top, GROWING / 10)) > 0  # grows from the start, and is seen only here
        if not resolved and not slow and _on_axis(pencil, thrust, top):
            raise ConvergenceError(f"critical thrust near {thrust:.6g}: an instability there cannot be resolved")
        found += resolved
    found = distinct(found, limit)
    between = np.array([0.0, *(point[0] for point in found), limit])
    counts = [unstable_roots(pencil, P, top) for P in (between[1:] + between[:-1]) / 2]
    return [
        Event(thrust, W, kind, (closest_mode(undamped, thrust, W, limit, drifts),) * 2, after, before)
        for (thrust, W, kind), before, after in zip(found, counts, counts[1:], strict=False)
        if before != after
    ]


def distinct(found: list[Crossing], limit: float) -> list[Crossing]:
    """Crossings up to a limit in order of thrust, each once."""
    kept: list[Crossing] = []
    for crossing in sorted(found):
        again = kept and crossing[0] - kept[-1][0] < SAME * limit and crossing[2] == kept[-1][2]
        if 0 < crossing[0] <= limit and not again:
            kept.append(crossing)
    return kept


def _flutter(
    pencil: Pencil, thrust: float, top: float, closest: int = CLOSEST, beside: float = BESIDE_AXIS
) -> list[Crossing]:
    """Crossings of complex roots next to an approximate thrust."""
    s = damped_roots(pencil, thrust)
    s = s[(s.imag > 0) & (np.abs(s) < top) & (np.abs(s.real) <= beside * np.abs(s))]
    points = []
    for root in s[np.argsort(np.abs(s.real) / np.abs(s))[:closest]]:
        point = imaginary_root(pencil, thrust, root.imag**2)
        if point.converged and ZERO * pencil.shift < point.W < top**2:
            points.append((point.thrust, point.W, FLUTTER))
    return points


def _divergence(static: Pencil, thrust: float) -> list[Crossing]:
    """Crossings of real roots next to an approximate thrust."""
    point = divergence(static, thrust)
    return [(point.thrust, 0.0, DIVERGENCE)] if point.converged else []


def _on_axis(pencil: Pencil, thrust: float, top: float) -> bool:
    """Whether a root is all but on the imaginary axis."""
    s = damped_roots(pencil, thrust)
    s = s[(np.abs(s) < top) & (np.abs(s) > NEUTRAL * np.sqrt(pencil.shift))]
    return bool(np.any(np.abs(s.real) < ON_AXIS * np.abs(s)))


def _missed(pencil: Pencil, known: list[float], limit: float, top: float) -> list[float]:
    """Thrusts at which the number of unstable roots changes away from the known ones."""
    even = limit * np.concatenate((FIRST_SHARES, np.linspace(0.0, 1.0, SAMPLES + 1)[1:]))
    counts = [unstable_roots(pencil, P, top) for P in even]
    missed = []
    for low, high, before, after in zip(even, even[1:], counts, counts[1:], strict=False):
        if before == after or any(low < P <= high for P in known):
            continue
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if unstable_roots(pencil, middle, top) == before else (low, middle)
        missed.append((low + high) / 2)
    return missed


def crossings(pencil: Pencil, limit: float, vanishing: bool = False) -> Array:
    """Real parts of all nearly real thrusts in (0, limit] with a root on the imaginary axis.

    Parameters
    ----------
    pencil : Pencil
        Damped, reduced.
    limit : float
    vanishing : bool
        Whether the damping goes to zero in the ratios of C.

    Returns
    -------
    ndarray
    """
    M, C = pencil.shift * pencil.M, np.sqrt(pencil.shift) * damping_of(pencil)  # time without units
    every = np.ones(len(M), dtype=bool)
    of_X, of_Y = pairs(every, diagonal=False), pairs(every, diagonal=True)

    def operator(K: Array, *damping: tuple[Array, Array]) -> Array:
        """Both lines on both unknowns; the thrust changes K alone."""
        fed = np.zeros((len(of_X[0]),) * 2) if vanishing else matrix(of_X, of_X, -1, (C, K), (K, C))
        return np.block(
            [
                [matrix(of_Y, of_X, -1, (M, K), (-K, M)), matrix(of_Y, of_Y, 1, *damping)],
                [fed, matrix(of_X, of_Y, 1, (K, M), (-M, K))],
            ]
        )

    inertia = np.diag(M)
    X, Y = (inertia[i] * inertia[j] for i, j in (of_X, of_Y))
    scale = np.outer(np.concatenate((Y, X)) ** -0.5, np.concatenate((X, Y)) ** -0.25)
    at = scale * operator(pencil.stiffness(REFERENCE * limit), (M, C), (C, M))
    change = scale * operator(limit * pencil.K1)
    return inverse_roots(at, change, limit)


def unstable_roots(pencil: Pencil, thrust: float, top: float) -> int:
    """Number of roots below a frequency that grow."""
    return len(_growing(pencil, thrust, top))


def fed_modes(pencil: Pencil, undamped: Pencil, thrust: float, limit: float, top: float) -> list[int]:
    """Numbers of the elastic modes below a frequency that grow as they swing, the fastest first."""
    s = _growing(pencil, thrust, top)
    s = s[s.imag > 0]
    drifts = pencil.rigid > undamped.rigid
    modes = [closest_mode(undamped, thrust, W, limit, drifts) for W in s[np.argsort(-s.real)].imag ** 2]
    return [mode for mode in modes if mode]


def unloaded(undamped: Pencil, mode: int) -> float:
    """W of an elastic mode without thrust."""
    roots = np.append(undamped.roots(0.0).real[undamped.rigid :], undamped.held)
    return float(np.sort(roots)[mode - 1])


def _growing(pencil: Pencil, thrust: float, top: float, least: float = GROWING) -> ComplexArray:
    """Roots below a frequency that grow at least at a share of their modulus."""
    s = damped_roots(pencil, thrust)
    size = np.abs(s)
    seen = (size < top) & (size > NEUTRAL * np.sqrt(pencil.shift))
    return np.asarray(s[seen & (s.real > least * size)])


def highest_frequency(undamped: Pencil, watched: int) -> float:
    """Frequency between the last of the watched modes and the first of the others, of the unloaded vehicle."""
    W = undamped.roots(0.0).real[undamped.rigid :]
    last = min(watched, len(W) - 1)
    return float(np.abs(W[last - 1] * W[last]) ** 0.25) if last < len(W) and last else float(np.sqrt(2 * W[-1]))


def closest_mode(undamped: Pencil, thrust: float, W: float, limit: float, drifts: bool = False) -> int:
    """Number of the elastic mode closest to a W = omega^2 at a thrust, counted from 1; 0 is a rigid-body root.

    ``drifts`` says that rigid-body motions are damped which are not in the undamped pencil.
    """
    roots: ComplexArray = undamped.roots(thrust)
    rigid = undamped.rigid
    if rigid_body_root(undamped, limit) == "neutral":
        roots, rigid = np.delete(roots, np.abs(roots).argmin()), 0
    if drifts and not rigid:
        roots, rigid = np.append(0.0, roots), 1
    if undamped.held:
        roots = np.sort_complex(np.append(roots, undamped.held))
    distance = np.abs(roots - W)
    return int(np.argmax(distance <= distance.min() * (1 + 1e-6))) + 1 - rigid


def with_rates(pencil: Pencil) -> Pencil:
    """The static problem, with the rates of motions that meet no stiffness in place of the motions."""
    free = free_motions(pencil)
    K0 = pencil.K0 + damping_of(pencil) @ free @ free.T
    dead = None if pencil.dead is None else pencil.dead - pencil.dead @ free @ free.T
    return replace(pencil, K0=K0, K1=pencil.K1 - pencil.K1 @ free @ free.T, C=None, dead=dead)


def free_motions(pencil: Pencil) -> Array:
    """Rigid-body motions on which no load acts, as orthonormal columns among zero ones, shape (n, rigid)."""
    loads = [load / np.abs(load).max() for load in (pencil.K1, pencil.dead) if load is not None and load.any()]
    free = np.zeros((len(pencil.M), pencil.rigid))
    if pencil.rigid:
        _, size, motions = np.linalg.svd(np.vstack(loads)[:, : pencil.rigid])
        free[: pencil.rigid] = motions.T * (size < UNCOUPLED)
    return free
