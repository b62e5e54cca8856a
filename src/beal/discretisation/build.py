"""From a vehicle to its operators, under each of the formulations that the program names."""

from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from beal.discretisation.assembly import assemble
from beal.discretisation.basis import Basis, segments
from beal.discretisation.damping import damping_matrix
from beal.discretisation.hermite import HermiteBasis
from beal.discretisation.legendre import LegendreBasis
from beal.discretisation.modes import ModeBasis
from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle

Formulation = Literal["objective", "converged", "corrected-ritz", "as-printed"]
BasisName = Literal["legendre", "hermite"]
FORMULATIONS: tuple[Formulation, ...] = get_args(Formulation)
RITZ: dict[str, Literal["natural", "printed"]] = {"corrected-ritz": "natural", "as-printed": "printed"}
DEFAULT_ORDER = {"legendre": 10, "hermite": 16}
PAPER_MODES = 8
LARGEST = 5000


def discretise(
    vehicle: Vehicle,
    formulation: Formulation = "objective",
    basis: BasisName = "legendre",
    order: int | None = None,
) -> Operators:
    """Matrices of a vehicle, M q'' + C q' + (K0 + P K1) q = F.

    Parameters
    ----------
    vehicle : Vehicle
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
        ``objective``: each joint slides along its own shear axis. ``converged``: every joint slides along a direction
        fixed in space and rigid-body motions are dropped, the equations of Irani & Kavianipour (2009) solved to
        convergence. ``corrected-ritz``, ``as-printed``: the same equations in the lowest modes of the unloaded
        vehicle, with the right and with the printed sign of their Eq. (12).
    basis : {"legendre", "hermite"}
        Polynomials on each segment, or cubic finite elements. The last two formulations have their own basis.
    order : int, optional
        Degree of the strains, elements per segment, or number of modes.

    Returns
    -------
    Operators

    Raises
    ------
    ModelError
        If the formulation does not apply to the vehicle, or an option is out of range.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> discretise(catalog.beck(), order=8).K0.shape
    (9, 9)
    """
    check_formulation(formulation)
    if order is not None and order < 1:
        raise ModelError(f"order: must be at least 1, found {order}")
    if formulation in RITZ:
        check_ritz(vehicle, formulation)
        modes = ModeBasis(vehicle, order or PAPER_MODES, RITZ[formulation])
        return assemble(inertial(vehicle), modes, supports=False)
    if basis not in DEFAULT_ORDER:
        raise ModelError(f"basis: must be one of {', '.join(DEFAULT_ORDER)}, found {basis!r}")
    degree = order or DEFAULT_ORDER[basis]
    size = len(segments(vehicle)) * (degree + 1 if basis == "legendre" else 2 * degree) + 2 * len(vehicle.joints)
    if size > LARGEST:
        raise ModelError(
            f"order: {degree} gives some {size} coordinates, too many for dense matrices (at most {LARGEST}): "
            "lower it, or ask for the critical thrust or the modes, which reduce a large vehicle in the default basis"
            + (" if it has no damping ratios" if any(vehicle.damping.ratios) else "")
        )
    shapes: Basis
    shapes = (LegendreBasis if basis == "legendre" else HermiteBasis)(vehicle, degree)
    if formulation == "converged":
        operators = assemble(inertial(vehicle), shapes, rigid_body=False)
    else:
        operators = assemble(vehicle, shapes)
    return replace(operators, C=damping_matrix(operators)) if vehicle.damped else operators


def check_formulation(formulation: str) -> None:
    """Refuse what is not the name of a formulation."""
    if formulation not in FORMULATIONS:
        raise ModelError(f"formulation: must be one of {', '.join(FORMULATIONS)}, found {formulation!r}")


def inertial(vehicle: Vehicle) -> Vehicle:
    """The vehicle with every joint sliding along a direction fixed in space."""
    joints = tuple(joint.model_copy(update={"shear_axis": "inertial"}) for joint in vehicle.joints)
    return vehicle.model_copy(update={"joints": joints})


def check_ritz(vehicle: Vehicle, formulation: str) -> None:
    """Refuse vehicles to which the modes of Irani & Kavianipour (2009), Eq. (10), do not belong."""
    stages = vehicle.laden
    reasons = []
    if len(stages) != 2:
        reasons.append(f"two stages, found {len(stages)}")
    elif any(stage.tables for stage in stages) or not np.allclose(
        [mean(stage.mass_per_length) / vehicle.scales.mass_per_length for stage in stages]
        + [mean(stage.bending_stiffness) / vehicle.scales.bending_stiffness for stage in stages],
        1.0,
        rtol=1e-12,
    ):
        reasons.append("two stages of equal, uniform mass per length and bending stiffness")
    if not vehicle.free_free:
        reasons.append(f"free ends, found {vehicle.support.nose} nose and {vehicle.support.tail} tail")
    if vehicle.shears or vehicle.turns_inertia:
        reasons.append("stages that neither shear nor have rotary inertia")
    if vehicle.founded:
        reasons.append("no foundation")
    if vehicle.point_masses:
        reasons.append(f"no point masses, found {len(vehicle.point_masses)}")
    if vehicle.damped:
        reasons.append("no damping")
    if reasons:
        raise ModelError(f"formulation {formulation}: applies to the paper's vehicle only, {'; '.join(reasons)}")
