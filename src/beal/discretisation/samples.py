"""The shapes at the points of the integrals, with their weights: what energies are summed from."""

from dataclasses import dataclass, fields
from functools import partial, reduce
from operator import add

import numpy as np

from beal.discretisation.axial import axial_force, dead_axial_force, has_dead_loads
from beal.discretisation.basis import DEFLECTION, ROTATION, SHEAR, SLOPE, Array, Basis, Rows
from beal.discretisation.polynomials import gauss
from beal.discretisation.quadrature import Points, quadrature
from beal.discretisation.strains import BENDING, STRAINS, Strain
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


Integrals = tuple[Integral, ...]


def total(integrals: Integrals) -> Rows:
    """The sum of their matrices."""
    return reduce(add, (integral.matrix() for integral in integrals))


@dataclass(frozen=True)
class Samples:
    """The integrals over the vehicle that make its matrices.

    Parameters
    ----------
    mass : sequence of Integral
        m phi phi^T, and rho I psi psi^T.
    elastic : sequence of Integral
        EI psi' psi'^T, kGA gamma gamma^T, and k phi phi^T of a foundation.
    axial, dead : sequence of Integral
        N phi' phi'^T of the thrust's axial force and of the dead loads', and for Haringx - N gamma gamma^T.
    load : sequence of Integral
        p phi phi'^T of distributed loads.
    """

    mass: Integrals
    elastic: Integrals
    axial: Integrals
    dead: Integrals
    load: Integrals

    def combined(self, transformation: Array) -> "Samples":
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        return Samples(**{name: tuple(each.combined(transformation) for each in of) for name, of in given.items()})


def sample(vehicle: Vehicle, basis: Basis) -> Samples:
    """A basis and the vehicle's properties at the points of the integrals."""
    points = quadrature(vehicle, basis.segments, basis.quadrature, basis.pieces)
    integral = partial(_compressed if basis.pieces else _at_points, basis, points)
    mass = [integral(DEFLECTION, points.property("mass_per_length"))]
    if vehicle.turns_inertia:
        mass.append(integral(ROTATION, points.property("rotary_inertia_per_length")))
    elastic = [integral(strain.reading, points.finite(strain.stiffness)) for strain in _strains(vehicle)]
    if vehicle.founded:
        elastic.append(integral(DEFLECTION, points.property("foundation_stiffness")))
    haringx = vehicle.shears and vehicle.thrust.axial_term == "haringx"

    def pressed(force: Array) -> Integrals:
        return (integral(SLOPE, force), *([integral(SHEAR, -force)] if haringx else []))

    load = [integral(DEFLECTION, _distributed(vehicle, points.station), SLOPE)] if vehicle.distributed_thrusts else []
    return Samples(
        mass=tuple(mass),
        elastic=tuple(elastic),
        axial=pressed(axial_force(vehicle, points.station)),
        dead=pressed(dead_axial_force(vehicle, points.station)) if has_dead_loads(vehicle) else (),
        load=tuple(load),
    )


def losses(vehicle: Vehicle, basis: Basis) -> tuple[Integrals, Integrals]:
    """What the stages dissipate: tau EI psi' psi'^T and tau kGA gamma gamma^T inside, c phi phi^T outside."""
    points = quadrature(vehicle, basis.segments, basis.quadrature, basis.pieces)
    integral = partial(_compressed if basis.pieces else _at_points, basis, points)
    time = points.property("internal_damping")
    inside = tuple(integral(each.reading, time * points.finite(each.stiffness)) for each in _strains(vehicle))
    return inside, (integral(DEFLECTION, points.property("external_damping")),)


def _strains(vehicle: Vehicle) -> tuple[Strain, ...]:
    return STRAINS if vehicle.shears else (BENDING,)


def _distributed(vehicle: Vehicle, stations: Array) -> Array:
    """Distributed loads over P, as far as they turn with the tangents."""
    return np.sum([load.tangency * values(load.value, stations) for load in vehicle.distributed_thrusts], axis=0)


def _at_points(basis: Basis, points: Points, reading: int, density: Array, right: int | None = None) -> Integral:
    xi = gauss(basis.quadrature)[0]
    rows = [None if d is None else basis.stacked(range(len(basis.segments)), xi, d) for d in (reading, right)]
    return Integral(rows[0], points.weight * density, rows[1])


def _compressed(basis: Basis, points: Points, reading: int, density: Array, right: int | None = None) -> Integral:
    """As many terms for each segment as shapes live there, however many pieces it has."""
    ends = np.searchsorted(points.segment, np.arange(len(basis.segments) + 1))
    weighted = points.weight * density
    rows, weights, rights = [], [], []
    for segment, (a, b) in enumerate(zip(ends, ends[1:], strict=False)):
        local = basis.at_points(segment, reading)
        if right is None:
            principal, directions = np.linalg.eigh(local.T @ (local * weighted[a:b, None]))
            rows.append(directions.T)
        else:
            beside = basis.at_points(segment, right)
            left, principal, across = np.linalg.svd(local.T @ (beside * weighted[a:b, None]))
            rows.append(left.T)
            rights.append(across)
        weights.append(principal)
    return Integral(basis.expanded(rows), np.concatenate(weights), basis.expanded(rights) if rights else None)
