"""Energies and virtual work as matrices, for any basis (the theory's section on energies, term by term)."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.axial import axial_force_in_joints, dead_axial_force_in_joints
from beal.discretisation.basis import DEFLECTION, ROTATION, SLOPE, Array, Basis, Combined, Rows
from beal.discretisation.chain import held
from beal.discretisation.operators import Operators
from beal.discretisation.samples import Samples, products, sample, total
from beal.vehicle.vehicle import Vehicle


def assemble(vehicle: Vehicle, basis: Basis, supports: bool = True, rigid_body: bool = True) -> Operators:
    """M, K0 and K1 of a vehicle in a basis.

        M  = int (m phi phi^T + rho I psi psi^T) dx + sum (m_p phi phi^T + J_p psi psi^T)
        K0 = int (EI psi' psi'^T + kGA gamma gamma^T + k_f phi phi^T) dx
             + sum (k_r [[psi]] [[psi]]^T + k_s [[phi]] [[phi]]^T)
        K1 = - int n phi' phi'^T dx - sum n_j ([[phi]] sigma^T + sigma [[phi]]^T) + eta phi(L) phi'(L)^T

    with n = N/P, phi the deflection, psi the rotation of the sections and gamma = phi' - psi, which is 0 where a stage
    does not shear. sigma is a mean of the two faces' psi. Haringx's axial force adds + int n gamma gamma^T dx to K1, a
    thrust along the section has psi(L) in place of phi'(L). Springs to the ground are in K0 as those of joints. Dead
    loads make a matrix like K1. Supports are imposed exactly and the rigid-body motions that they leave are made
    M-orthogonal to the elastic coordinates.

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
    mass, elastic, load, dead = energies(vehicle, basis, samples)
    elastic[:rigid] = elastic[:, :rigid] = 0.0
    return Operators(vehicle, mass, elastic, load, rigid, basis, dead=dead)


def energies(vehicle: Vehicle, basis: Basis, samples: Samples) -> tuple[Rows, Rows, Rows, Rows | None]:
    """M, K0, K1 and the stiffness of dead loads, if there are any, in a basis: dense or sparse, as its rows are."""
    elastic, geometric = total(samples.elastic), total(samples.axial)
    for reading, name in ((DEFLECTION, "shear_stiffness"), (ROTATION, "rotational_stiffness")):
        aft, flexible = _flexible(vehicle, basis, name)
        if aft:
            springs = np.array([getattr(joint, name) for joint in vehicle.joints])
            elastic = elastic + products(basis.jumps(aft, reading), springs[flexible])
    geometric = geometric + _couples(vehicle, basis, axial_force_in_joints(vehicle))
    if basis.springs:
        elastic = elastic + products(basis.deformations(), np.array([spring.stiffness for spring in basis.springs]))
    dead = _dead_loads(vehicle, basis, samples) if samples.dead else None
    return _mass(vehicle, basis, samples), elastic, _follower(vehicle, basis, samples) - geometric, dead


def _dead_loads(vehicle: Vehicle, basis: Basis, samples: Samples) -> Rows:
    """Stiffness of the loads that do not grow with the thrust."""
    stiffness = -total(samples.dead) - _couples(vehicle, basis, dead_axial_force_in_joints(vehicle))
    stations = np.array([load.station for load in vehicle.axial_loads])
    if len(stations):
        follower = np.array([load.tangency * load.force for load in vehicle.axial_loads])
        deflection, slope = (basis.at(stations, reading) for reading in (DEFLECTION, SLOPE))
        stiffness = stiffness + deflection.T @ (slope * follower[:, None])
    return stiffness


def _flexible(vehicle: Vehicle, basis: Basis, name: str) -> tuple[list[int], NDArray[np.intp]]:
    """The segments aft of the joints of finite stiffness, and the joints' numbers."""
    flexible = np.flatnonzero([math.isfinite(getattr(joint, name)) for joint in vehicle.joints])
    chain = basis.segments
    fronts = [index for index in range(1, len(chain)) if chain[index - 1].stage != chain[index].stage]
    return [fronts[joint] for joint in flexible], flexible


def _couples(vehicle: Vehicle, basis: Basis, forces: Array) -> Rows | float:
    """Work of the axial forces through sheared joints."""
    aft, flexible = _flexible(vehicle, basis, "shear_stiffness")
    if not aft:
        return 0.0
    axes = _shear_axes(basis, aft, [vehicle.joints[joint].shear_axis for joint in flexible])
    couples = basis.jumps(aft, DEFLECTION).T @ (axes * forces[flexible, None])
    return couples + couples.T


def _follower(vehicle: Vehicle, basis: Basis, samples: Samples) -> Rows:
    """Work of the loads that turn with the tangent, and of those that do not move with the vehicle."""
    thrust = vehicle.thrust
    readings = DEFLECTION, SLOPE if thrust.along == "slope" else ROTATION
    if thrust.station is None:
        rows = [basis.stacked([len(basis.segments) - 1], np.array([1.0]), reading) for reading in readings]
    else:
        rows = [basis.at(np.array([thrust.station]), reading) for reading in readings]
    deflection, slope = rows if thrust.line == "moving" else rows[::-1]
    follower = (thrust.tangency * thrust.scale) * (deflection.T @ slope)
    return follower + total(samples.load) if samples.load else follower


def _mass(vehicle: Vehicle, basis: Basis, samples: Samples) -> Rows:
    mass = total(samples.mass)
    if vehicle.point_masses:
        stations = np.array([lump.station for lump in vehicle.point_masses])
        for reading, name in ((DEFLECTION, "mass"), (ROTATION, "rotary_inertia")):
            inertia = np.array([getattr(lump, name) for lump in vehicle.point_masses])
            mass = mass + products(basis.at(stations, reading), inertia)
    return mass


def _shear_axes(basis: Basis, segments: Sequence[int], axes: Sequence[str]) -> Rows:
    """Rows of sigma, the slope of the direction along which each shear spring slides: that of the faces."""
    share = np.array([{"forward": 1.0, "mean": 0.5, "aft": 0.0, "inertial": 0.0}[axis] for axis in axes])
    fixed = np.array([axis == "inertial" for axis in axes])
    forward = basis.stacked([index - 1 for index in segments], np.array([1.0]), ROTATION)
    aft = basis.stacked(segments, np.array([-1.0]), ROTATION)
    return forward * share[:, None] + aft * (1.0 - share - fixed)[:, None]


def _admissible(vehicle: Vehicle, basis: Basis, samples: Samples, rigid_body: bool) -> tuple[Array, int]:
    """Combinations of the raw coordinates that satisfy the supports: rigid-body motions first, then elastic ones."""
    rows = [basis.end(end, reading) for end, reading in held(vehicle)]
    rows += [basis.end(spring.end, spring.reading) for spring in basis.springs]
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
