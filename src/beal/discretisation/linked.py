"""Large vehicles: every segment with the deflection and rotation at its front as coordinates of their own.

The strain coordinates of `beal.discretisation.legendre` and these states together have sparse matrices. That each
segment begins where the one before it ends becomes a set of constraints, whose multipliers are the shear forces and
bending moments; integrating along the chain is then the factorisation of a banded matrix, in a time proportional to
the number of segments. Unlike nodal coordinates alone, it keeps the digits of the strains.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, csr_array, vstack
from scipy.sparse.linalg import SuperLU, splu

from beal.discretisation.assembly import energies, normalised
from beal.discretisation.basis import DEFLECTION, ROTATION, Array, Basis, Combined, Rows, segments
from beal.discretisation.chain import ground_springs, held, jump_scales
from beal.discretisation.cuts import ALL
from beal.discretisation.damping import dissipation
from beal.discretisation.operators import Operators
from beal.discretisation.polynomials import gauss
from beal.discretisation.samples import losses, sample
from beal.discretisation.strains import STRAINS, Strain, carried, orthonormal
from beal.discretisation.varying import LoadShapes, load_shapes, pieces
from beal.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class _Family:
    """The coordinates of one strain: on which segments, of what size, in which columns.

    Parameters
    ----------
    strain : Strain
    there : ndarray of bool, shape (segments,)
        The segments that have it.
    first : ndarray of int, shape (segments,)
        Column of P_0 of each segment that has it.
    unit_energy : ndarray, shape (segments,)
    shapes : dict
        Of the segments of varying stiffness, by number.
    """

    strain: Strain
    there: NDArray[np.bool_]
    first: NDArray[np.intp]
    unit_energy: Array
    shapes: dict[int, LoadShapes]


class LinkedBasis(Basis):
    """Strains of degree up to ``order`` on each segment, behind a front of its own.

    Coordinates: deflections and rotations at the fronts; the jumps of the flexible joints; the polynomials, P_0 of all
    segments first, so that a higher order only appends coordinates.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Highest degree of the strains, at least 1.
    """

    def __init__(self, vehicle: Vehicle, order: int) -> None:
        self.segments = segments(vehicle, few=ALL)
        self.pieces = pieces(vehicle, self.segments, order)
        self.quadrature = order + 3
        self._order = order
        count = len(self.segments)
        scales = vehicle.scales
        # Of deflection and rotation: what EI/L^3 and EI/L turn into a unit of energy.
        self.units = np.array([scales.length / scales.thrust, 1 / (scales.length * scales.thrust)]) ** 0.5
        self._lengths = np.array([segment.length for segment in self.segments])
        stages = np.array([segment.stage for segment in self.segments])
        self._jumps = np.zeros((count, 2))  # across the fronts, at a unit of the joints' coordinates
        self._jumps[np.flatnonzero(np.diff(stages)) + 1] = np.array(jump_scales(vehicle)).reshape(-1, 2)
        flexible = self._jumps > 0
        self._jump_columns = 2 * count - 1 + np.cumsum(flexible).reshape(count, 2)
        self.springs = ground_springs(vehicle)
        self._grounds = 2 * count + int(flexible.sum())
        self._families: list[_Family] = []
        column = self._grounds + len(self.springs)
        for strain in STRAINS:
            stiffness = strain.stiffnesses(vehicle, self.segments)
            there = np.isfinite(stiffness)
            first = column - 1 + np.cumsum(there)
            column += int(there.sum())
            unit_energy = (self._lengths * stiffness) ** -0.5
            shapes = load_shapes(vehicle, self.segments, self.pieces, order, strain)
            self._families.append(_Family(strain, there, first, unit_energy, shapes))
        self._stride = column - self._grounds - len(self.springs)  # columns from one degree to the next

    @property
    def size(self) -> int:
        return self._grounds + len(self.springs) + self._stride * (self._order + 1)

    def rows(self, segment: int, xi: Array, reading: int) -> Array:
        return np.asarray(self.stacked([segment], xi, reading).toarray())

    def stacked(self, segments: Sequence[int], xi: Array, reading: int) -> Rows:
        return self.rows_at(np.repeat(np.asarray(segments, dtype=np.intp), len(xi)), xi, reading)

    def rows_at(self, index: NDArray[np.intp], xi: Array, reading: int) -> Rows:
        """As of every basis; the xi may be a period of all."""
        everywhere = np.tile(xi, len(index) // max(len(xi), 1))
        data = [carried(reading, self._lengths[index], everywhere) * self.units]
        columns = [2 * index[:, None] + np.array([0, 1])]
        there: list[NDArray[np.bool_]] = [np.ones(columns[0].shape, dtype=bool)]
        for family in self._families:
            if (times := family.strain.times.get(reading)) is None or not family.there.any():
                continue
            scale = family.unit_energy[index] * (self._lengths[index] / 2) ** times
            polynomials = orthonormal(self._order, times, xi)
            values = scale[:, None] * np.tile(polynomials, (len(index) // max(len(xi), 1), 1))
            for segment in set(index[np.isin(index, list(family.shapes))].tolist()):
                here = index == segment
                values[here] = family.shapes[segment].at(everywhere[here], times)
            data.append(values)
            columns.append(self._columns(family, index))
            there.append(np.broadcast_to(family.there[index, None], values.shape))
        kept = np.hstack(there)
        ends = np.concatenate(([0], np.cumsum(kept.sum(axis=1))))
        return csr_array((np.hstack(data)[kept], np.hstack(columns)[kept], ends), (len(index), self.size))

    def at_points(self, segment: int, reading: int) -> Array:
        xi = self.pieces[segment].xi if segment in self.pieces else gauss(self.quadrature)[0]
        blocks = [carried(reading, self._lengths[segment], xi) * self.units]
        for family in self._families:
            if not family.there[segment]:
                continue
            times = family.strain.times.get(reading)
            if times is None:
                blocks.append(np.zeros((len(xi), self._order + 1)))
            elif segment in family.shapes:
                blocks.append(family.shapes[segment].at_points(times))
            else:
                scale = family.unit_energy[segment] * (self._lengths[segment] / 2) ** times
                blocks.append(scale * orthonormal(self._order, times, xi))
        return np.hstack(blocks)

    def expanded(self, local: Sequence[Array]) -> Rows:
        index = np.arange(len(self.segments))
        fronts = 2 * index[:, None] + [0, 1]
        own = [self._columns(family, index) for family in self._families]
        there = [np.tile(family.there[:, None], self._order + 1) for family in self._families]
        columns, lives = np.hstack((fronts, *own)), np.hstack((np.full_like(fronts, True, dtype=bool), *there))
        each = [np.tile(columns[n, lives[n]], len(rows)) for n, rows in enumerate(local)]
        ends = np.cumsum([0, *(rows.shape[1] for rows in local for _ in rows)])
        data = np.concatenate([rows.ravel() for rows in local])
        return csr_array((data, np.concatenate(each), ends), (len(ends) - 1, self.size))

    def _columns(self, family: _Family, index: NDArray[np.intp]) -> NDArray[np.intp]:
        """Coordinates of a strain on segments that have it, shape (len(index), order + 1)."""
        return np.asarray(family.first[index, None] + self._stride * np.arange(self._order + 1))

    def jumps(self, segments: Sequence[int], reading: int) -> Rows:
        fronts = np.asarray(segments, dtype=np.intp)
        which = (DEFLECTION, ROTATION).index(reading)
        columns, values = self._jump_columns[fronts, which], self._jumps[fronts, which]
        flexible = values > 0
        return csr_array((values[flexible], (np.flatnonzero(flexible), columns[flexible])), (len(fronts), self.size))

    def constraints(self, vehicle: Vehicle) -> Rows:
        """Rows that vanish where segments begin as they should and the supports hold."""
        count = len(self.segments)
        fronts, before = range(1, count), range(count - 1)
        front, end = np.array([-1.0]), np.array([1.0])
        rows = []
        units = dict(zip((DEFLECTION, ROTATION), self.units, strict=True))
        for reading, unit in units.items():
            jumps = self.jumps(fronts, reading)
            rows.append((self.stacked(fronts, front, reading) - self.stacked(before, end, reading) - jumps) / unit)
        ends = ((0, front), (count - 1, end))
        for which, reading in held(vehicle):
            segment, xi = ends[which]
            rows.append(self.stacked([segment], xi, reading) / units[reading])
        for n, spring in enumerate(self.springs):
            segment, xi = ends[spring.end]
            moved = self.stacked([segment], xi, spring.reading) - self.deformations()[[n]]
            rows.append(moved / units[spring.reading])
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
