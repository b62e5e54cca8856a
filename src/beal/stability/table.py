"""The characteristic function of many vehicles that differ in their joints' springs only, as one table.

With A(P, W) = K(P) - W M of the vehicle without those springs and J the rows that read their deformations,

    D = det(A + J^T k J) = sum over subsets S of springs of prod(k_S) det(A) det((J A^-1 J^T)_S),

multilinear in the stiffnesses. Each coefficient is an entire function of thrust and W = omega^2, so a Chebyshev table
of modest degree holds it to nearly the precision of the machine, and a vehicle costs a few products instead of an
eigenvalue problem for every thrust.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.polynomial import chebyshev

from beal.discretisation import Formulation, discretise
from beal.discretisation.operators import Operators
from beal.stability.pencil import Array, pencil, reduced
from beal.stability.polish import SpringPencil
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

Spring = tuple[int, Literal["rotational_stiffness", "shear_stiffness"]]

MODES = 6  # of the vehicle with these joints rigid, which the range of W holds


@dataclass(frozen=True)
class Degrees:
    """Degrees of a table in thrust and in W, and the order of the discretisation behind it."""

    thrust: int
    W: int
    order: int


@dataclass(frozen=True)
class Table:
    """D over thrusts [low, high] and W in [0, top].

    Parameters
    ----------
    low, high, top : float
    coefficients : ndarray, shape (2**springs, degree in thrust + 1, degree in W + 1)
        Chebyshev coefficients for each subset of springs, the binary digits of its index.
    springs : SpringPencil
        What it was made from.
    """

    low: float
    high: float
    top: float
    coefficients: Array
    springs: SpringPencil

    def weights(self, stiffnesses: Array) -> Array:
        """Factors of the subsets for vehicles with given springs, shape (vehicles, 2**springs).

        D is divided by prod(1 + k/k_ref), which keeps a hinge and a rigid joint alike finite.
        """
        soft = 1 / (1 + stiffnesses / self.springs.references)
        weights = np.ones((len(stiffnesses), 1))
        for spring in soft.T:
            weights = np.hstack((weights * spring[:, None], weights * (1 - spring[:, None])))
        return weights


def tables(
    vehicle: Vehicle,
    springs: Sequence[Spring],
    formulation: Formulation,
    panel: tuple[float, float],
    degrees: Degrees,
) -> Table | None:
    """Table of a vehicle over a panel of thrusts.

    Parameters
    ----------
    vehicle : Vehicle
    springs : sequence of (joint, name)
        The springs that will vary; their values in ``vehicle`` do not matter.
    formulation : {"objective", "converged"}
    panel : (low, high)
        In N.
    degrees : Degrees

    Returns
    -------
    Table or None
        None where a rigid-body root would spoil it, or supports couple a spring with the other coordinates.
    """
    paths = [f"joint[{joint}].{name}" for joint, name in springs]
    operators = discretise(with_values(vehicle, dict.fromkeys(paths, 0.0)), formulation, order=degrees.order)
    rigid = discretise(with_values(vehicle, dict.fromkeys(paths, math.inf)), formulation, order=degrees.order)
    springs_of = _springs(operators, springs)
    if springs_of is None:
        return None
    full = springs_of.pencil
    rows = np.eye(len(full.M))[springs_of.columns]
    top = float(np.sqrt(np.prod(reduced(pencil(rigid)).roots(0.0)[MODES - 1 : MODES + 1].real)))
    x_P, x_W = (np.cos(np.pi * (np.arange(n + 1) + 0.5) / (n + 1)) for n in (degrees.thrust, degrees.W))
    thrusts, W = panel[0] + (panel[1] - panel[0]) * (1 + x_P) / 2, top * (1 + x_W) / 2
    stiffness = full.K0 + thrusts[:, None, None] * full.K1
    A = stiffness[:, None] - W[:, None, None] * full.M
    inverse = rows @ np.linalg.solve(A, np.broadcast_to(rows.T, (*A.shape[:-1], len(rows))))
    values = np.linalg.det(A) * np.array([_minor(inverse, subset) for subset in range(2 ** len(springs))])
    in_W = np.linalg.solve(chebyshev.chebvander(x_W, degrees.W), np.swapaxes(values, 1, 2))
    coefficients = np.linalg.solve(chebyshev.chebvander(x_P, degrees.thrust), np.swapaxes(in_W, 1, 2))
    return Table(panel[0], panel[1], top, np.asarray(coefficients, dtype=np.float64), springs_of)


def _springs(operators: Operators, springs: Sequence[Spring]) -> SpringPencil | None:
    """The pencil and the coordinates of the springs, where each has one of its own."""
    full, basis = pencil(operators), operators.basis
    fronts = {segment.stage: index for index, segment in reversed(list(enumerate(basis.segments)))}
    columns, references = [], []
    for joint, name in springs:
        jump = basis.jump(fronts[joint + 1], 1 if name == "rotational_stiffness" else 0)[operators.rigid :]
        own = np.flatnonzero(np.abs(jump) > 1e-9 * np.abs(jump).max())
        if full.rigid or len(own) != 1:
            return None
        columns.append(own[0])
        references.append(1 / jump[own[0]] ** 2)
    return SpringPencil(full, np.array(columns), np.array(references))


def _minor(matrices: Array, subset: int) -> Array:
    """Principal minors of a stack of matrices for the subset whose binary digits are given."""
    index = [i for i in range(matrices.shape[-1]) if subset >> i & 1]
    return np.linalg.det(matrices[..., index, :][..., index]) if index else np.ones(matrices.shape[:-2])
