"""The critical thrust with its gradient over chosen quantities, as optimisers ask for it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from beal.design.branches import Status, branch, builder, slopes
from beal.design.derivatives import Array, bare, quantities_of
from beal.design.sensitivity import differentiable, guess
from beal.discretisation.build import Formulation
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class CriticalGradient:
    """A critical thrust and its exact derivatives with respect to some quantities.

    Parameters
    ----------
    critical : CriticalThrust
        Of a vehicle that tumbles, that of its elastic modes.
    thrust, angular_frequency : ndarray, shape (paths,)
        Derivatives of the critical thrust and of its frequency; with respect to 1/value where a value is infinite.
    status : tuple of str
        Of each, as the one of a `beal.Parameter`.
    """

    critical: CriticalThrust
    thrust: Array
    angular_frequency: Array
    status: tuple[Status, ...]


def critical_gradient(
    vehicle: Vehicle,
    paths: Sequence[str],
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    critical: CriticalThrust | None = None,
) -> CriticalGradient:
    """The critical thrust and its gradient, without the look at rivals that `sensitivity` takes.

    Parameters
    ----------
    vehicle : Vehicle
    paths : sequence of str
    max_thrust : float, optional
        In N, as for `critical_thrust`.
    formulation : {"objective", "converged"}
    critical : CriticalThrust, optional
        The vehicle's, if it is known.

    Returns
    -------
    CriticalGradient

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or no critical thrust that could be differentiated.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> found = critical_gradient(catalog.beck(), ["stage[0].bending_stiffness"])
    >>> found.thrust.round(7).tolist()
    [20.0509536]
    """
    with one_thread():
        found = differentiable(critical or critical_thrust(vehicle, max_thrust, formulation))
        build = builder(vehicle, formulation)
        operators = build(bare(vehicle))
        here = [branch(operators, *guess(found))]
        rows = [slopes(each, here, build, operators) for each in quantities_of(vehicle, paths)]
    fine = np.array([row.fine[0] for row in rows]).reshape(-1, 2)
    return CriticalGradient(found, fine[:, 0], fine[:, 1], tuple(row.status for row in rows))
