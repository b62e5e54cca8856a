"""Energies and virtual work as matrices, for any basis (the theory's section on energies, term by term)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import vstack

from beal.discretisation.axial import axial_force, axial_force_in_joints
from beal.discretisation.basis import Array, Basis, Combined, Rows
from beal.discretisation.chain import held
from beal.discretisation.operators import Operators
from beal.discretisation.polynomials import gauss
from beal.discretisation.quadrature import Points, quadrature
from beal.vehicle.stations import values
from beal.vehicle.vehicle import Vehicle


def assemble(vehicle: Vehicle, basis: Basis, supports: bool = True, rigid_body: bool = True) -> Operators:
    """M, K0 and K1 of a vehicle in a basis.

        M  = int m phi phi^T dx + sum (m_p phi phi^T + J_p phi' phi'^T)
        K0 = int (EI phi'' phi''^T + k_f phi phi^T) dx + sum (k_r [[phi']] [[phi']]^T + k_s [[phi]] [[phi]]^T)
        K1 = - int n phi' phi'^T dx - sum n_j ([[phi]] sigma^T + sigma [[phi]]^T) + eta phi(L) phi'(L)^T

    with n = N/P, and springs to the ground in K0 as those of joints. Supports are imposed exactly and the rigid-body motions that they leave are made M-orthogonal to the
    elastic coordinates.

    Parameters
    ----------
    vehicle : Vehicle
    basis : Basis
    supports : bool
        False for shapes that satisfy the supports already and hold no rigid-body motion.
    rigid_body : bool
        Whether to keep the rigid-body motions.

    Returns
    -------
    Operators
    """
    samples = sample(vehicle, basis)
    if supports:
        transformation, rigid = _admissible(vehicle, basis, samples, rigid_body)
        basis = Combined(basis, transformation)
        samples = samples.combined(transformation)
    else:
        rigid = 0
    mass, bending, load = energies(vehicle, basis, samples)
    bending[:rigid] = bending[:, :rigid] = 0.0
    return Operators(vehicle, mass, bending, load, rigid, basis)


def energies(vehicle: Vehicle, basis: Basis, samples: "Samples") -> tuple[Rows, Rows, Rows]:
    """M, K0 and K1 in the coordinates of a basis: dense or sparse, as its rows are."""
    bending, geometric = samples.bending.matrix(), samples.axial.matrix()
    chain = basis.segments
    fronts = [index for index in range(1, len(chain)) if chain[index - 1].stage != chain[index].stage]
    for derivative, name in ((0, "shear_stiffness"), (1, "rotational_stiffness")):
        springs = np.array([getattr(joint, name) for joint in vehicle.joints])
        flexible = np.flatnonzero(np.isfinite(springs))
        if not len(flexible):
            continue
        aft = [fronts[joint] for joint in flexible]
        jumps = basis.jumps(aft, derivative)
        bending = bending + _products(jumps, springs[flexible])
        if derivative == 0:
            axes = _shear_axes(basis, aft, [vehicle.joints[joint].shear_axis for joint in flexible])
            couples = jumps.T @ (axes * axial_force_in_joints(vehicle)[flexible, None])
            geometric = geometric + couples + couples.T
    if basis.springs:
        bending = bending + _products(basis.deformations(), np.array([spring.stiffness for spring in basis.springs]))
    if samples.foundation:
        bending = bending + samples.foundation.matrix()
    return _mass(vehicle, basis, samples), bending, _follower(vehicle, basis, samples) - geometric


def _follower(vehicle: Vehicle, basis: Basis, samples: "Samples") -> Rows:
    """Work of the loads that turn with the tangent, and of those that do not move with the vehicle."""
    thrust = vehicle.thrust
    if thrust.station is None:
        rows = [basis.stacked([len(basis.segments) - 1], np.array([1.0]), d) for d in (0, 1)]
    else:
        rows = [basis.at(np.array([thrust.station]), d) for d in (0, 1)]
    deflection, slope = rows if thrust.line == "moving" else rows[::-1]
    follower = (thrust.tangency * thrust.scale) * (deflection.T @ slope)
    return follower + samples.load.matrix() if samples.load else follower


def _products(rows: Rows, weights: Array) -> Rows:
    """Sum of weight * row row^T."""
    return rows.T @ (rows * weights[:, None])


@dataclass(frozen=True)
class Integral:
    """The matrix sum of weight * row right^T, an integral over the vehicle by its terms; right is row if not given."""

    rows: Rows
    weights: Array
    right: Rows | None = None

    def matrix(self) -> Rows:
        return self.rows.T @ ((self.rows if self.right is None else self.right) * self.weights[:, None])

    def combined(self, transformation: Array) -> "Integral":
        right = None if self.right is None else self.right @ transformation
        return Integral(self.rows @ transformation, self.weights, right)


@dataclass(frozen=True)
class Samples:
    """The integrals over the vehicle: m phi phi^T, EI phi'' phi''^T n phi' phi'^T, k phi phi^T of a
    foundation and p phi phi'^T of distributed loads."""

    mass: Integral
    bending: Integral
    axial: Integral
    foundation: Integral | None = None
    load: Integral | None = None

    def combined(self, transformation: Array) -> "Samples":
        integrals = (self.mass, self.bending, self.axial, self.foundation, self.load)
        return Samples(*(each and each.combined(transformation) for each in integrals))


def sample(vehicle: Vehicle, basis: Basis) -> Samples:
    """A basis and the vehicle's properties at the points of the integrals."""
    points = quadrature(vehicle, basis.segments, basis.quadrature, basis.pieces)
    integral = _compressed if basis.pieces else _at_points
    load = np.zeros(len(points.station))
    for part in vehicle.distributed_thrusts:
        load += part.tangency * values(part.value, points.station)
    return Samples(
        mass=integral(basis, points, 0, points.property("mass_per_length")),
        bending=integral(basis, points, 2, points.property("bending_stiffness")),
        axial=integral(basis, points, 1, axial_force(vehicle, points.station)),
        foundation=integral(basis, points, 0, points.property("foundation_stiffness")) if vehicle.founded else None,
        load=integral(basis, points, 0, load, 1) if vehicle.distributed_thrusts else None,
    )


def _at_points(
    basis: Basis, points: Points, derivative: int, density: Array, right: int | None = None
) -> Integral:
    xi = gauss(basis.quadrature)[0]
    rows = [None if d is None else basis.stacked(range(len(basis.segments)), xi, d) for d in (derivative, right)]
    return Integral(rows[0], points.weight * density, rows[1])


def _compressed(
    basis: Basis, points: Points, derivative: int, density: Array, right: int | None = None
) -> Integral:
    """As many terms for each segment as shapes live there, however many pieces it has."""
    ends = np.searchsorted(points.segment, np.arange(len(basis.segments) + 1))
    weighted = points.weight * density
    rows, weights, rights = [], [], []
    for segment, (a, b) in enumerate(zip(ends, ends[1:], strict=False)):
        local = basis.at_points(segment, derivative)
        if right is None:
            principal, directions = np.linalg.eigh(local.T @ (local * weighted[a:b, None]))
            rows.append(basis.expanded(segment, directions.T))
        else:
            beside = basis.at_points(segment, right)
            left, principal, across = np.linalg.svd(local.T @ (beside * weighted[a:b, None]))
            rows.append(basis.expanded(segment, left.T))
            rights.append(basis.expanded(segment, across))
        weights.append(principal)
    stack = np.vstack if isinstance(rows[0], np.ndarray) else vstack
    return Integral(stack(rows), np.concatenate(weights), stack(rights) if rights else None)


def _mass(vehicle: Vehicle, basis: Basis, samples: Samples) -> Rows:
    mass = samples.mass.matrix()
    if vehicle.point_masses:
        stations = np.array([lump.station for lump in vehicle.point_masses])
        for derivative, name in ((0, "mass"), (1, "rotary_inertia")):
            inertia = np.array([getattr(lump, name) for lump in vehicle.point_masses])
            mass = mass + _products(basis.at(stations, derivative), inertia)
    return mass


def _shear_axes(basis: Basis, segments: Sequence[int], axes: Sequence[str]) -> Rows:
    """Rows of sigma, the slope of the direction along which each shear spring slides."""
    share = np.array([{"forward": 1.0, "mean": 0.5, "aft": 0.0, "inertial": 0.0}[axis] for axis in axes])
    fixed = np.array([axis == "inertial" for axis in axes])
    forward = basis.stacked([index - 1 for index in segments], np.array([1.0]), 1)
    aft = basis.stacked(segments, np.array([-1.0]), 1)
    return forward * share[:, None] + aft * (1.0 - share - fixed)[:, None]


def _admissible(vehicle: Vehicle, basis: Basis, samples: Samples, rigid_body: bool) -> tuple[Array, int]:
    """Combinations of the raw coordinates that satisfy the supports: rigid-body motions first, then elastic ones."""
    rows = [basis.end(end, derivative) for end, derivative in held(vehicle)]
    rows += [basis.end(spring.end, spring.derivative) for spring in basis.springs]
    constraints = np.array(rows).reshape(-1, basis.size)
    constraints[len(constraints) - len(basis.springs) :] -= basis.deformations()
    on_rigid, on_strain = constraints[:, :2] * (1.0, 1 / vehicle.length), constraints[:, 2:]
    u, singular, vt = np.linalg.svd(on_rigid, full_matrices=True)
    rank = int(np.sum(singular > 1e-12))
    motions = vt[rank:].T * np.array([[1.0], [1 / vehicle.length]])
    strains = _null_space(u[:, rank:].T @ on_strain)
    inverse = vt[:rank].T / singular[:rank] @ u[:, :rank].T
    carried = -np.array([[1.0], [1 / vehicle.length]]) * (inverse @ on_strain @ strains)
    elastic = np.vstack((carried, strains))
    rigid = np.vstack((motions, np.zeros((basis.size - 2, motions.shape[1]))))
    if rigid.shape[1]:
        mass = _mass(vehicle, basis, samples)
        modal = rigid.T @ mass @ rigid
        elastic = elastic - rigid @ np.linalg.solve(modal, rigid.T @ mass @ elastic)
        rigid = normalised(vehicle, modal, rigid)
    if vehicle.founded:  # then these motions strain the foundation
        return np.hstack((rigid, elastic)), 0
    if not rigid_body:
        rigid = rigid[:, :0]
    return np.hstack((rigid, elastic)), rigid.shape[1]


def normalised(vehicle: Vehicle, modal: Array, rigid: Array) -> Array:
    """Rigid-body motions M-orthogonal and as large as the elastic coordinates; ``modal`` is their M."""
    return np.asarray(np.linalg.solve(np.linalg.cholesky(modal), rigid.T).T * vehicle.scales.time)


def _null_space(constraints: Array) -> Array:
    """Orthonormal null space of a full-rank set of constraints, shape (n, n - constraints)."""
    count, size = constraints.shape
    if count == 0:
        return np.eye(size)
    return np.linalg.qr(constraints.T, mode="complete")[0][:, count:]
