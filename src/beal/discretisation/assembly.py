"""Energies and virtual work as matrices, for any basis (the theory's section on energies, term by term)."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.legendre import leggauss

from beal.discretisation.axial import axial_force, axial_force_in_joint
from beal.discretisation.basis import Array, Basis, Combined
from beal.discretisation.operators import Operators
from beal.vehicle.vehicle import Vehicle


def assemble(vehicle: Vehicle, basis: Basis, supports: bool = True, rigid_body: bool = True) -> Operators:
    """M, K0 and K1 of a vehicle in a basis.

        M  = int m phi phi^T dx + sum (m_p phi phi^T + J_p phi' phi'^T)
        K0 = int EI phi'' phi''^T dx + sum (k_r [[phi']] [[phi']]^T + k_s [[phi]] [[phi]]^T)
        K1 = - int n phi' phi'^T dx - sum n_j ([[phi]] sigma^T + sigma [[phi]]^T) + eta phi(L) phi'(L)^T

    with n = N/P. Supports are imposed exactly and the rigid-body motions that they leave are made M-orthogonal to the
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
    samples = _sample(vehicle, basis)
    if supports:
        transformation, rigid = _admissible(vehicle, basis, samples, rigid_body)
        basis = Combined(basis, transformation)
        samples = samples.combined(transformation)
    else:
        rigid = 0
    mass = _mass(vehicle, basis, samples)
    bending = samples.curvature.T @ (samples.bending_stiffness[:, None] * samples.curvature)
    geometric = samples.slope.T @ (samples.axial_force[:, None] * samples.slope)
    for index, segment in enumerate(basis.segments):
        if index == 0 or basis.segments[index - 1].stage == segment.stage:
            continue
        joint = vehicle.joints[segment.stage - 1]
        for derivative, spring in ((0, joint.shear_stiffness), (1, joint.rotational_stiffness)):
            if np.isfinite(spring):
                jump = basis.jump(index, derivative)
                bending += spring * np.outer(jump, jump)
        if np.isfinite(joint.shear_stiffness):
            shear = np.outer(basis.jump(index, 0), _shear_axis(basis, index, joint.shear_axis))
            geometric += axial_force_in_joint(vehicle, segment.stage - 1) * (shear + shear.T)
    tail, tail_slope = (basis.rows(len(basis.segments) - 1, np.array([1.0]), d)[0] for d in (0, 1))
    follower = vehicle.thrust.tangency * np.outer(tail, tail_slope)
    bending[:rigid] = bending[:, :rigid] = 0.0
    return Operators(vehicle, mass, bending, follower - geometric, rigid, basis)


gauss = cache(leggauss)


@dataclass(frozen=True)
class _Samples:
    """Shapes at the Gauss points of all segments, with the weights of the integrals."""

    deflection: Array
    slope: Array
    curvature: Array
    mass: Array
    bending_stiffness: Array
    axial_force: Array

    def combined(self, transformation: Array) -> "_Samples":
        return _Samples(
            self.deflection @ transformation,
            self.slope @ transformation,
            self.curvature @ transformation,
            self.mass,
            self.bending_stiffness,
            self.axial_force,
        )


def _sample(vehicle: Vehicle, basis: Basis) -> _Samples:
    xi, weight = gauss(basis.quadrature)
    chain = basis.segments
    half = np.array([segment.length / 2 for segment in chain])
    weights = np.outer(half, weight)
    stations = np.array([segment.start for segment in chain])[:, None] + np.outer(half, 1 + xi)
    stages = [vehicle.stages[segment.stage] for segment in chain]
    deflection, slope, curvature = (np.vstack([basis.rows(i, xi, d) for i in range(len(chain))]) for d in (0, 1, 2))
    return _Samples(
        deflection,
        slope,
        curvature,
        mass=(weights * np.array([[stage.mass_per_length] for stage in stages])).ravel(),
        bending_stiffness=(weights * np.array([[stage.bending_stiffness] for stage in stages])).ravel(),
        axial_force=(weights * axial_force(vehicle, stations)).ravel(),
    )


def _mass(vehicle: Vehicle, basis: Basis, samples: _Samples) -> Array:
    mass = samples.deflection.T @ (samples.mass[:, None] * samples.deflection)
    for lump in vehicle.point_masses:
        for derivative, inertia in ((0, lump.mass), (1, lump.rotary_inertia)):
            row = basis.at(np.array([lump.station]), derivative)[0]
            mass += inertia * np.outer(row, row)
    return mass


def _shear_axis(basis: Basis, segment: int, axis: str) -> Array:
    """Row of sigma, the slope of the direction along which the shear spring slides."""
    forward = basis.rows(segment - 1, np.array([1.0]), 1)[0]
    aft = basis.rows(segment, np.array([-1.0]), 1)[0]
    return {"forward": forward, "aft": aft, "mean": (forward + aft) / 2, "inertial": np.zeros(basis.size)}[axis]


def _admissible(vehicle: Vehicle, basis: Basis, samples: _Samples, rigid_body: bool) -> tuple[Array, int]:
    """Combinations of the raw coordinates that satisfy the supports: rigid-body motions first, then elastic ones."""
    held = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,)}
    last = len(basis.segments) - 1
    rows = [basis.rows(0, np.array([-1.0]), d)[0] for d in held[vehicle.support.nose]]
    rows += [basis.rows(last, np.array([1.0]), d)[0] for d in held[vehicle.support.tail]]
    constraints = np.array(rows).reshape(-1, basis.size)
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
        lower = np.linalg.cholesky(modal)
        rigid = np.linalg.solve(lower, rigid.T).T * vehicle.scales.time  # as large as the elastic coordinates
    if not rigid_body:
        rigid = rigid[:, :0]
    return np.hstack((rigid, elastic)), rigid.shape[1]


def _null_space(constraints: Array) -> Array:
    """Orthonormal null space of a full-rank set of constraints, shape (n, n - constraints)."""
    count, size = constraints.shape
    if count == 0:
        return np.eye(size)
    return np.linalg.qr(constraints.T, mode="complete")[0][:, count:]
