"""Frequencies of a vehicle, its discretisation refined until they no longer change."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from beal.discretisation.build import RITZ, Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.large import Reduction, is_large
from beal.stability.pencil import Array
from beal.stability.spectrum import Spectrum, spectrum
from beal.stability.threads import one_thread
from beal.vehicle.vehicle import Vehicle

ORDERS = (10, 14, 20, 28, 40, 56, 80, 112)
MODES, MOST_MODES = 6, 40  # unless told otherwise, and at most
GOOD, POOR = 1e-9, 1e-4  # relative change from one order to the next at which to stop, and above which to give up


def converged_modes(
    vehicle: Vehicle, thrust: float, count: int | None = None, formulation: Formulation = "objective"
) -> tuple[Spectrum, Array | None]:
    """The lowest elastic modes at a thrust.

    Parameters
    ----------
    vehicle : Vehicle
    thrust : float
        In N.
    count : int, optional
        Number of modes; by default 6, or all that rigid stages have.
    formulation : {"objective", "converged", "corrected-ritz", "as-printed"}

    Returns
    -------
    spectrum : Spectrum
    error : ndarray, shape (count,), or None
        How much each angular frequency, in ascending order, changed in the last refinement; None where a few modes
        are part of the formulation.

    Raises
    ------
    ModelError
        If the number of modes is out of range.
    ConvergenceError
        If so many do not converge.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> converged_modes(catalog.beck(), 10.0, 2)[0].angular_frequency.round(6).tolist()
    [5.175762, 18.586795]
    """
    if formulation in RITZ:
        return spectrum(discretise(vehicle, formulation), thrust, count or MODES), None
    most = MOST_MODES if vehicle.deforms else min(MOST_MODES, _elastic(discretise(vehicle, formulation)))
    count = min(MODES, most) if count is None else count
    if not 1 <= count <= most:
        raise ModelError(f"count: must lie between 1 and {most}, found {count}")
    before: Array | None = None
    best: tuple[float, Spectrum, Array] | None = None
    with one_thread():
        large = is_large(vehicle)
        spectra = Reduction(vehicle, formulation, count).spectra if large else partial(_spectra, vehicle, formulation)
        for found in spectra(thrust, count):
            omega = np.sort(found.angular_frequency)
            if before is not None:
                error = np.abs(omega - before)
                change = float(np.max(error / np.maximum(omega, vehicle.scales.angular_frequency)))
                if best is None or change < best[0]:
                    best = change, found, error
                if change < GOOD:
                    break
            before = omega
    if best is None or best[0] > POOR:
        raise ConvergenceError(f"modes: {count} frequencies do not converge; ask for fewer")
    return best[1:]


def _spectra(vehicle: Vehicle, formulation: Formulation, thrust: float, count: int) -> Iterator[Spectrum]:
    """The lowest elastic modes in finer and finer discretisations."""
    for order in ORDERS:
        operators = discretise(vehicle, formulation, order=order)
        if _elastic(operators) >= count:
            yield spectrum(operators, thrust, count)


def _elastic(operators: Operators) -> int:
    """Number of elastic coordinates."""
    return len(operators.M) - operators.rigid
