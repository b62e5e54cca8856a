"""Motions that strain nothing, and where the first thrust drives them: rigid-body motions and mechanisms.

K(P) with the strained coordinates eliminated is P K1_zz - P^2 K1_ze K0_ee^-1 K1_ez + ... on the strainless ones.
"""

from typing import Literal

import numpy as np
import scipy.linalg

from beal.stability.pencil import Array, ComplexArray, Pencil

ZERO = 1e-6  # |W| below this share of the pencil's shift is zero to rounding
STRAINLESS = 1e-9  # share of strain energy below which a coordinate of a reduced pencil strains nothing
FIRST = 1e-4  # share of the thrust searched at which the motions are looked at
ROUNDING = 1e-12
NEARLY_REAL = 3e-2  # relative imaginary part of a thrust up to which a real critical point is looked for beside it
SAME = 1e-9


def rigid_body_root(pencil: Pencil, limit: float) -> Literal["", "neutral", "tumbling"]:
    """Where the strainless root goes under thrust: it stays zero, or turns negative and the vehicle tumbles."""
    gained = _gained(pencil, limit)
    if not len(gained):
        return ""
    nearest = [np.abs(pencil.roots(share * limit)).min() for share in (0.0013, 0.0029)]
    if max(nearest) < ZERO * pencil.shift:
        return "neutral"
    return "tumbling" if pencil.rigid and gained.real.min() < 0 else ""


def mechanism(pencil: Pencil, limit: float) -> Literal["flutter", "divergence"] | None:
    """How a mechanism, a joint without stiffness, gives way under any thrust at all, if it does."""
    gained = _gained(pencil, limit)
    if len(gained) <= pencil.rigid:
        return None
    if np.any(gained.imag != 0):
        return "flutter"
    tumbling = rigid_body_root(pencil, limit) == "tumbling"
    return "divergence" if np.sum(gained.real < 0) > tumbling else None


def _gained(pencil: Pencil, limit: float) -> ComplexArray:
    """Stiffnesses that the strainless motions of a reduced pencil gain from the first thrust."""
    count = int(np.sum(np.diag(pencil.K0) < STRAINLESS))  # the leading coordinates
    K1 = FIRST * limit * pencil.K1 + (0.0 if pencil.dead is None else pencil.dead)
    along, back, forth = K1[:count, :count], K1[:count, count:], K1[count:, :count]
    through = back @ (forth / np.diag(pencil.K0)[count:, None])
    gained = np.linalg.eigvals(along - through).astype(complex)
    significant = np.abs(gained) > ROUNDING * np.abs(K1).max() ** 2  # the second order counts
    nearly_real = np.abs(gained.imag) < np.sqrt(ROUNDING) * np.abs(gained)
    return np.where(significant, np.where(nearly_real, gained.real, gained), 0.0)


def zero_roots(pencil: Pencil, limit: float) -> Array:
    """All nearly real thrusts in (0, limit] at which K(P) is singular."""
    alpha, beta = scipy.linalg.eigvals(-limit * pencil.K1, pencil.stiffness(0.0), homogeneous_eigvals=True)
    finite = np.abs(alpha) > 1e-12 * np.abs(beta)
    return nearly_real(beta[finite] / alpha[finite], limit)


def nearly_real(shares: Array, limit: float) -> Array:
    near = np.abs(shares.imag) <= NEARLY_REAL * np.abs(shares)
    inside = (shares.real > SAME) & (shares.real <= 1 + NEARLY_REAL)
    return np.sort(shares[near & inside].real) * limit
