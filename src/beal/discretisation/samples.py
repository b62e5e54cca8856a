"""The shapes at the points of the integrals, with their weights: what energies are summed from."""

from dataclasses import dataclass, fields

import numpy as np
from scipy.sparse import vstack

from beal.discretisation.axial import axial_force, dead_axial_force, has_dead_loads
from beal.discretisation.basis import Array, Basis, Rows
from beal.discretisation.polynomials import gauss
from beal.discretisation.quadrature import Points, quadrature
from beal.vehicle.stations import values
from beal.vehicle.vehicle import Vehicle


def products(rows: Rows, weights: Array, right: Rows | None = None) -> Rows:
    """Sum of weight * row right^T; right is row if not given."""
    return rows.T @ ((rows if right is None else right) * weights[:, None])


@dataclass(frozen=True)
class Integral:
    """The matrix sum of weight * row right^T, an integral over the vehicle by its terms; right is row if not given."""

    rows: Rows
    weights: Array
    right: Rows | None = None

    def matrix(self) -> Rows:
        return products(self.rows, self.weights, self.right)

    def combined(self, transformation: Array) -> "Integral":
        right = None if self.right is None else self.right @ transformation
        return Integral(self.rows @ transformation, self.weights, right)


@dataclass(frozen=True)
class Samples:
    """The integrals over the vehicle: m phi phi^T, EI phi'' phi''^T n phi' phi'^T, k phi phi^T of a
    foundation and p phi phi'^T of distributed loads; N phi' phi'^T of the dead ones."""

    mass: Integral
    bending: Integral
    axial: Integral
    foundation: Integral | None = None
    load: Integral | None = None
    dead: Integral | None = None

    def combined(self, transformation: Array) -> "Samples":
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        return Samples(**{name: each and each.combined(transformation) for name, each in given.items()})


def sample(vehicle: Vehicle, basis: Basis) -> Samples:
    """A basis and the vehicle's properties at the points of the integrals."""
    points = quadrature(vehicle, basis.segments, basis.quadrature, basis.pieces)
    integral = _compressed if basis.pieces else _at_points
    return Samples(
        mass=integral(basis, points, 0, points.property("mass_per_length")),
        bending=integral(basis, points, 2, points.property("bending_stiffness")),
        axial=integral(basis, points, 1, axial_force(vehicle, points.station)),
        foundation=integral(basis, points, 0, points.property("foundation_stiffness")) if vehicle.founded else None,
        load=integral(basis, points, 0, _distributed(vehicle, points.station), 1)
        if vehicle.distributed_thrusts
        else None,
        dead=integral(basis, points, 1, dead_axial_force(vehicle, points.station)) if has_dead_loads(vehicle) else None,
    )


def losses(vehicle: Vehicle, basis: Basis) -> tuple[Integral, Integral]:
    """What the stages dissipate: tau EI phi'' phi''^T inside and c phi phi^T outside."""
    points = quadrature(vehicle, basis.segments, basis.quadrature, basis.pieces)
    integral = _compressed if basis.pieces else _at_points
    inside = points.property("internal_damping") * points.property("bending_stiffness")
    return integral(basis, points, 2, inside), integral(basis, points, 0, points.property("external_damping"))


def _distributed(vehicle: Vehicle, stations: Array) -> Array:
    """Distributed loads over P, as far as they turn with the tangents."""
    return np.sum([load.tangency * values(load.value, stations) for load in vehicle.distributed_thrusts], axis=0)


def _at_points(basis: Basis, points: Points, derivative: int, density: Array, right: int | None = None) -> Integral:
    xi = gauss(basis.quadrature)[0]
    rows = [None if d is None else basis.stacked(range(len(basis.segments)), xi, d) for d in (derivative, right)]
    return Integral(rows[0], points.weight * density, rows[1])


def _compressed(basis: Basis, points: Points, derivative: int, density: Array, right: int | None = None) -> Integral:
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
