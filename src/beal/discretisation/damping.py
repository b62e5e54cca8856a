"""Damping as a matrix: what beams, surroundings and dashpots dissipate, and ratios of the elastic modes."""

import numpy as np
import scipy.linalg

from beal.discretisation.basis import DEFLECTION, ROTATION, Array, Basis, Combined, Rows
from beal.discretisation.operators import Operators
from beal.discretisation.samples import Integrals, losses, products, total
from beal.vehicle.vehicle import Vehicle


def damping_matrix(operators: Operators) -> Array:
    """C of a damped vehicle in the coordinates of its operators, symmetric.

        C = int (tau EI psi' psi'^T + tau kGA gamma gamma^T + c phi phi^T) dx
            + sum_j (c_r [[psi]] [[psi]]^T + c_s [[phi]] [[phi]]^T) + sum_i 2 zeta_i omega_i (M v_i) (M v_i)^T

    with tau and c the stages' internal and external damping, c_r and c_s the joints' dashpots, and zeta_i the ratios
    of the unloaded elastic modes v_i, v_i^T M v_i = 1.

    Parameters
    ----------
    operators : Operators

    Returns
    -------
    ndarray, shape (n, n)

    Examples
    --------
    >>> from beal.discretisation.build import discretise
    >>> from beal.vehicle import Stage, Support, Vehicle
    >>> stage = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0, internal_damping=0.02)
    >>> column = discretise(Vehicle(stages=[stage], support=Support(nose="clamped")))
    >>> np.allclose(column.C, 0.02 * column.K0)
    True
    """
    vehicle, basis, rigid = operators.vehicle, operators.basis, operators.rigid
    if not isinstance(basis, Combined):
        raise TypeError(f"the basis of operators with supports imposed is Combined, found {type(basis).__name__}")
    inside, outside = dissipation(
        vehicle,
        basis,
        *(tuple(loss.combined(basis.transformation) for loss in each) for each in losses(vehicle, basis.basis)),
    )
    damping = np.asarray(inside)
    damping[:rigid] = damping[:, :rigid] = 0.0  # rounding: rigid-body motions strain nothing
    damping = damping + outside
    damping[rigid:, rigid:] += _modal(vehicle, operators.M[rigid:, rigid:], operators.K0[rigid:, rigid:])
    return np.asarray((damping + damping.T) / 2)


def dissipation(vehicle: Vehicle, basis: Basis, inside: Integrals, outside: Integrals) -> tuple[Rows, Rows]:
    """What strains and joints dissipate, and what the surroundings do, given the stages' `losses` in a basis."""
    damping, chain = total(inside), basis.segments
    fronts = [index for index in range(1, len(chain)) if chain[index - 1].stage != chain[index].stage]
    for reading, name in ((DEFLECTION, "shear_damping"), (ROTATION, "rotational_damping")):
        dashpots = np.array([getattr(joint, name) for joint in vehicle.joints])
        there = np.flatnonzero(dashpots)
        if len(there):
            damping = damping + products(basis.jumps([fronts[j] for j in there], reading), dashpots[there])
    return damping, total(outside)


def _modal(vehicle: Vehicle, M: Array, K0: Array) -> Array:
    """Damping that gives the unloaded elastic modes their ratios.

    From M v = nu (K0 + s M) v, in which the highest modes, all rounding, are the smallest eigenvalues.
    """
    given = vehicle.damping.ratios
    if not any(given):
        return np.zeros_like(M)
    shift = vehicle.scales.angular_frequency**2
    static = K0 + shift * M
    nu, V = scipy.linalg.eigh(M, static)
    nu, forces = np.clip(nu[::-1], 0.0, 1 / shift), static @ V[:, ::-1]
    ratios = np.array([*given, *[given[-1]] * len(nu)])[: len(nu)]
    return np.asarray(forces * (2 * ratios * np.sqrt(nu - shift * nu**2)) @ forces.T)
