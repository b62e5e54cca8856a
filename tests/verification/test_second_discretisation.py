"""Polynomials on each stage against cubic finite elements, on vehicles drawn at random."""

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicles

PART = 50


def frequencies(vehicle: Vehicle, thrust: float, basis: str) -> np.ndarray:
    """W of the first three modes; of elements extrapolated from 16 and 32 of them, the error being of fourth order."""
    if basis == "legendre":
        return spectrum(discretise(vehicle, order=14), thrust, 3).W
    coarse, fine = (spectrum(discretise(vehicle, basis=basis, order=order), thrust, 3).W for order in (16, 32))
    return fine + (fine - coarse) / 15


@pytest.mark.parametrize("part", range(4))
def test_both_discretisations_agree(part):
    for vehicle in random_vehicles(PART, seed=1971 + part, absent=0.0):
        found = critical_thrust(vehicle)
        found = found.elastic or found
        other = critical_thrust(vehicle, basis="hermite", tolerance=1e-6)
        other = other.elastic or other
        assert (found.kind, found.modes) == (other.kind, other.modes)
        assert other.critical_thrust == pytest.approx(found.critical_thrust, rel=1e-6)
        half = found.critical_thrust / 2
        smooth, elements = (frequencies(vehicle, half, basis) for basis in ("legendre", "hermite"))
        np.testing.assert_allclose(elements, smooth, rtol=2e-6, atol=1e-6 * abs(smooth[1]))  # 1e-6 of the frequency
