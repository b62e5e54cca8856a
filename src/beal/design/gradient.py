"""The critical thrust with its gradient and curvature over chosen quantities, as optimisers ask for them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from beal.design.branches import Status, branch, builder, slopes
from beal.design.derivatives import CENTRAL, Array, bare, quantities_of
from beal.design.sensitivity import differentiable, guess
from beal.discretisation.build import Formulation
from beal.errors import ModelError
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
    modes: int | None = None,
) -> CriticalGradient:
    """The critical thrust and its gradient, without the look at rivals that `sensitivity` takes.

    Parameters
    ----------
    vehicle : Vehicle
    paths : sequence of str
    max_thrust : float, optional
        In N, as for `critical_thrust`.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}
    critical : CriticalThrust, optional
        The vehicle's, if it is known.
    modes : int, optional
        Number of modes of the last two.

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
        found = differentiable(critical or critical_thrust(vehicle, max_thrust, formulation, modes=modes))
        build = builder(vehicle, formulation, modes)
        operators = build(bare(vehicle))
        here = [branch(operators, *guess(found))]
        rows = [slopes(each, here, build, operators) for each in quantities_of(vehicle, paths)]
    fine = np.array([row.fine[0] for row in rows]).reshape(-1, 2)
    return CriticalGradient(found, fine[:, 0], fine[:, 1], tuple(row.status for row in rows))


@dataclass(frozen=True)
class CriticalHessian:
    """A critical thrust and its first and second derivatives with respect to some quantities.

    Parameters
    ----------
    critical : CriticalThrust
    gradient : ndarray, shape (paths,)
    hessian : ndarray, shape (paths, paths)
        Symmetric.
    error : float
        The largest change of an entry, in units of thrust over the two values, by a formula of lower order or by
        taking the two derivatives in the other order.
    """

    critical: CriticalThrust
    gradient: Array
    hessian: Array
    error: float


def critical_hessian(
    vehicle: Vehicle,
    paths: Sequence[str],
    max_thrust: float | None = None,
    formulation: Formulation = "objective",
    modes: int | None = None,
) -> CriticalHessian:
    """Second derivatives of the critical thrust: differences of sixth order of its exact gradients.

    The instability is followed, not searched again. It costs as much as six gradients for each quantity.

    Parameters
    ----------
    vehicle : Vehicle
    paths : sequence of str
        Of quantities with finite values that can move to both sides.
    max_thrust, formulation, modes
        As for `critical_gradient`.

    Returns
    -------
    CriticalHessian

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or it cannot move to both sides; or there is no critical thrust.
    ConvergenceError
        If the instability is lost on the way.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> found = critical_hessian(catalog.beck(), ["stage[0].bending_stiffness", "stage[0].length"])
    >>> (found.hessian / found.critical.critical_thrust).round(6).tolist()  # of EI/L^2
    [[0.0, -2.0], [-2.0, 6.0]]
    """
    with one_thread():
        found = differentiable(critical_thrust(vehicle, max_thrust, formulation, modes=modes))
        build, point = builder(vehicle, formulation, modes), guess(found)

        def gradient(moved: Vehicle) -> Array:
            operators = build(moved)
            here = [branch(operators, *point)]
            return np.array([slopes(each, here, build, operators).fine[0, 0] for each in quantities_of(moved, paths)])

        quantities = quantities_of(vehicle, paths)
        rows = []
        for each in quantities:
            try:
                around = [gradient(each.moved(offset * each.step)) for offset in CENTRAL.offsets]
            except ModelError as error:
                raise ModelError(
                    [(each.path, f"has no second derivative, it moves to one side only: {error}")]
                ) from None
            rows.append([np.array(weights) @ around / each.step for weights in (CENTRAL.weights, CENTRAL.coarse)])
        first = gradient(bare(vehicle))
    fine, coarse = np.array(rows).reshape(-1, 2, len(quantities)).transpose(1, 0, 2)
    size = np.array([each.value for each in quantities])
    change = np.maximum(np.abs(fine - fine.T) / 2, np.abs(fine - coarse)) * np.outer(size, size)
    return CriticalHessian(found, first, (fine + fine.T) / 2, float(change.max(initial=0.0)))
