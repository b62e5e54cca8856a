"""Large vehicles: every segment with the deflection and slope at its front as coordinates of their own.

The strain coordinates of `beal.discretisation.legendre` and these states together have sparse matrices. That each
segment begins where the one before it ends becomes a set of constraints, whose multipliers are the shear forces and
bending moments; integrating along the chain is then the factorisation of a banded matrix, in a time proportional to
the number of segments. Unlike nodal coordinates alone, it keeps the digits of the strains.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, csr_array, vstack
from scipy.sparse.linalg import SuperLU, splu

from beal.discretisation.assembly import energies, normalised
from beal.discretisation.basis import Array, Basis, Combined, Rows, segments
from beal.discretisation.chain import ground_springs, held, jump_scales
from beal.discretisation.cuts import ALL
from beal.discretisation.damping import dissipation
from beal.discretisation.operators import Operators
from beal.discretisation.polynomials import gauss, integrals
from beal.discretisation.samples import losses, sample
from beal.discretisation.varying import moment_shapes, pieces
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


class LinkedBasis(Basis):
    """Curvature of degree up to ``order`` on each segment, behind a front of its own.

    Coordinates: deflections and slopes at the fronts; the jumps of the flexible joints; the polynomials, P_0 of all
    segments first, so that a higher order only appends coordinates.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Highest degree of the curvature, at least 1.
    """

    def __init__(self, vehicle: Vehicle, order: int) -> None:
        self.segments = segments(vehicle, few=ALL)
        self.pieces = pieces(vehicle, self.segments, order)
        self._shapes = moment_shapes(vehicle, self.segments, self.pieces, order)
        self.quadrature = order + 3
        self._order = order
        count = len(self.segments)
        scales = vehicle.scales
        # Of deflection and slope: what EI/L^3 and EI/L turn into a unit of energy.
        self.units = np.array([scales.length / scales.thrust, 1 / (scales.length * scales.thrust)]) ** 0.5
        self._lengths = np.array([segment.length for segment in self.segments])
        stages = np.array([segment.stage for segment in self.segments])
        stiffness = np.array([mean(stage.bending_stiffness) for stage in vehicle.stages])[stages]
        self._unit_energy = (self._lengths * stiffness) ** -0.5
        self._jumps = np.zeros((count, 2))  # across the fronts, at a unit of the joints' coordinates
        self._jumps[np.flatnonzero(np.diff(stages)) + 1] = np.array(jump_scales(vehicle)).reshape(-1, 2)
        flexible = self._jumps > 0
        self._jump_columns = 2 * count - 1 + np.cumsum(flexible).reshape(count, 2)
        self.springs = ground_springs(vehicle)
        self._grounds = 2 * count + int(flexible.sum())
        self._polynomials = self._grounds + len(self.springs)

    @property
    def size(self) -> int:
        return self._polynomials + len(self.segments) * (self._order + 1)

    def rows(self, segment: int, xi: Array, derivative: int) -> Array:
        return np.asarray(self.stacked([segment], xi, derivative).toarray())

    def stacked(self, segments: Sequence[int], xi: Array, derivative: int) -> Rows:
        index = np.repeat(np.asarray(segments, dtype=np.intp), len(xi))
        return self._rows(index, np.tile(xi, len(segments)), self._integrated(xi, derivative), derivative)

    def rows_at(self, index: NDArray[np.intp], xi: Array, derivative: int) -> Rows:
        return self._rows(index, xi, self._integrated(xi, derivative), derivative)

    def at_points(self, segment: int, derivative: int) -> Array:
        xi = self.pieces[segment].xi if segment in self.pieces else gauss(self.quadrature)[0]
        front = np.zeros((len(xi), 2))
        if derivative < 2:
            front[:, derivative] = self.units[derivative]
        if derivative == 0:
            front[:, 1] = self.units[1] * self._lengths[segment] * (1 + xi) / 2
        shapes = self._shapes.get(segment)
        return np.hstack((front, shapes.at_points(derivative) if shapes else self._own(segment, xi, derivative)))

    def expanded(self, segment: int, local: Array) -> Rows:
        columns = np.tile(self._columns(np.array([segment])), (len(local), 1))
        ends = local.shape[1] * np.arange(len(local) + 1)
        return csr_array((local.ravel(), columns.ravel(), ends), (len(local), self.size))

    def _own(self, segment: int, xi: Array, derivative: int) -> Array:
        scale = self._unit_energy[segment] * (self._lengths[segment] / 2) ** (2 - derivative)
        return scale * self._integrated(xi, derivative) * np.sqrt(2 * np.arange(self._order + 1) + 1)

    def _columns(self, index: NDArray[np.intp]) -> NDArray[np.intp]:
        """Coordinates of the shapes that live on segments, shape (len(index), 2 + order + 1)."""
        polynomials = self._polynomials + index[:, None] + len(self.segments) * np.arange(self._order + 1)
        return np.hstack((2 * index[:, None], 2 * index[:, None] + 1, polynomials))

    def jumps(self, segments: Sequence[int], derivative: int) -> Rows:
        fronts = np.asarray(segments, dtype=np.intp)
        columns, values = self._jump_columns[fronts, derivative], self._jumps[fronts, derivative]
        flexible = values > 0
        return csr_array((values[flexible], (np.flatnonzero(flexible), columns[flexible])), (len(fronts), self.size))

    def constraints(self, vehicle: Vehicle) -> Rows:
        """Rows that vanish where segments begin as they should and the supports hold."""
        count = len(self.segments)
        fronts, before = range(1, count), range(count - 1)
        front, end = np.array([-1.0]), np.array([1.0])
        rows = []
        for d, unit in enumerate(self.units):
            jumps = self.jumps(fronts, d)
            rows.append((self.stacked(fronts, front, d) - self.stacked(before, end, d) - jumps) / unit)
        ends = ((0, front), (count - 1, end))
        rows += [self.stacked([ends[which][0]], ends[which][1], d) / self.units[d] for which, d in held(vehicle)]
        for n, spring in enumerate(self.springs):
            segment, xi = ends[spring.end]
            moved = self.stacked([segment], xi, spring.derivative) - self.deformations()[[n]]
            rows.append(moved / self.units[spring.derivative])
        return vstack(rows, format="csr")

    def deformations(self) -> Rows:
        index = np.arange(len(self.springs))
        return csr_array(
            ([spring.scale for spring in self.springs], (index, self._grounds + index)), (len(index), self.size)
        )

    def rigid_body(self) -> Array:
        """Translation, and rotation about the nose by 1/L, shape (size, 2)."""
        motions = np.zeros((self.size, 2))
        states = motions[: 2 * len(self.segments)].reshape(-1, 2, 2)
        last = self.segments[-1]
        states[:, 0, 0] = 1 / self.units[0]
        states[:, 0, 1] = [segment.start / last.end / self.units[0] for segment in self.segments]
        states[:, 1, 1] = 1 / last.end / self.units[1]
        return motions

    def _integrated(self, xi: Array, derivative: int) -> Array:
        return legendre.legvander(xi, self._order + 2) @ integrals(self._order, 2 - derivative)

    def _rows(self, index: NDArray[np.intp], xi: Array, values: Array, derivative: int) -> Rows:
        """Rows at xi of the segments ``index``; ``values`` holds the polynomials there, or a period of them."""
        length = self._lengths[index]
        data = np.zeros((len(index), 2 + self._order + 1))
        if derivative == 0:
            data[:, 0] = self.units[0]
            data[:, 1] = self.units[1] * length * (1 + xi) / 2
        elif derivative == 1:
            data[:, 1] = self.units[1]
        scale = self._unit_energy[index] * (length / 2) ** (2 - derivative)
        degree = np.arange(self._order + 1)
        repeated = np.tile(values, (len(index) // max(len(values), 1), 1))
        data[:, 2:] = scale[:, None] * repeated * np.sqrt(2 * degree + 1)
        for segment in set(index[np.isin(index, list(self._shapes))].tolist()):
            here = index == segment
            data[here, 2:] = self._shapes[segment].at(xi[here], derivative)
        columns = self._columns(index)
        ends = data.shape[1] * np.arange(len(index) + 1)
        return csr_array((data.ravel(), columns.ravel(), ends), (len(index), self.size))


@dataclass(frozen=True)
class LinkedOperators:
    """M, K0 and K1 of coordinates q with the constraints B q = 0, all sparse.

    Parameters
    ----------
    vehicle : Vehicle
    M, K0, K1 : sparse arrays, shape (n, n)
    B : sparse array, shape (constraints, n)
    motions : ndarray, shape (n, motions)
        The rigid-body motions that the supports leave, M-orthogonal.
    basis : LinkedBasis
    dead : sparse array, shape (n, n), optional
        Stiffness of the loads that do not grow with the thrust.
    inside, outside : sparse array, shape (n, n), optional
        Damping by strains and joints, and by the surroundings, of a damped vehicle.
    """

    vehicle: Vehicle
    M: Rows
    K0: Rows
    K1: Rows
    B: Rows
    motions: Array
    basis: LinkedBasis
    dead: Rows | None = None
    inside: Rows | None = None
    outside: Rows | None = None

    @cached_property
    def C(self) -> Rows:
        """Damping, zero where there is none, shape (n, n)."""
        return csr_array(self.M.shape) if self.inside is None else (self.inside + self.outside).tocsr()

    def stiffness(self, thrust: float) -> Rows:
        """K0 + P K1, and that of dead loads."""
        stiffness = self.K0 + thrust * self.K1
        return stiffness if self.dead is None else stiffness + self.dead

    @property
    def shift(self) -> float:
        """The square of the vehicle's reference frequency, in rad^2/s^2."""
        return self.vehicle.scales.angular_frequency**2

    @property
    def rigid(self) -> int:
        """Number of the motions that strain nothing, not even a foundation."""
        return 0 if self.vehicle.founded else self.motions.shape[1]

    @cached_property
    def static(self) -> Rows:
        """K0 + shift M, which is definite, shape (n, n)."""
        return (self.K0 + self.shift * self.M).tocsr()

    @cached_property
    def _factor(self) -> SuperLU:
        return splu(csc_array(block_array([[self.static, self.B.T], [self.B, None]])))

    def deflected(self, loads: Array) -> Array:
        """Admissible coordinates under static loads with the stiffness ``static``, shape (n, loads)."""
        return self._solved(loads, np.zeros((self.B.shape[0], loads.shape[1])))

    def admissible(self, vectors: Array) -> Array:
        """The nearest coordinates that satisfy the constraints to rounding, shape (n, vectors)."""
        return vectors - self._solved(np.zeros_like(vectors), self.B @ vectors)

    def _solved(self, loads: Array, gaps: Array) -> Array:
        return np.asarray(self._factor.solve(np.vstack((loads, gaps)))[: len(loads)])

    def projected(self, vectors: Array, rigid: int) -> Operators:
        """The dense operators in the span of admissible vectors, the first of which are rigid-body motions."""
        M, K0, K1 = (np.asarray(vectors.T @ (matrix @ vectors)) for matrix in (self.M, self.K0, self.K1))
        K0[:rigid] = K0[:, :rigid] = 0.0
        dead, inside, outside = (
            None if matrix is None else np.asarray(vectors.T @ (matrix @ vectors))
            for matrix in (self.dead, self.inside, self.outside)
        )
        if inside is not None:
            inside[:rigid] = inside[:, :rigid] = 0.0
        C = None if inside is None else inside + outside
        return Operators(self.vehicle, M, K0, K1, rigid, Combined(self.basis, vectors), C, dead)


def linked(vehicle: Vehicle, order: int) -> LinkedOperators:
    """Sparse operators of a vehicle, in time proportional to its segments.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Highest degree of the curvature on each segment.

    Returns
    -------
    LinkedOperators

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> beck = linked(catalog.beck(), order=8)
    >>> beck.M.shape, beck.B.shape, beck.motions.shape
    ((11, 11), (2, 11), (11, 0))
    """
    basis = LinkedBasis(vehicle, order)
    M, K0, K1, dead = energies(vehicle, basis, sample(vehicle, basis))
    B = basis.constraints(vehicle)
    motions = basis.rigid_body()
    _, singular, vt = np.linalg.svd(B[2 * len(basis.segments) - 2 :] @ motions, full_matrices=True)
    motions = motions @ vt[int(np.sum(singular > 1e-12)) :].T
    motions = normalised(vehicle, motions.T @ (M @ motions), motions)
    lost = dissipation(vehicle, basis, *losses(vehicle, basis)) if vehicle.damped else (None, None)
    return LinkedOperators(vehicle, M.tocsr(), K0.tocsr(), K1.tocsr(), B, motions, basis, dead, *lost)
