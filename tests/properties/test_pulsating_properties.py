"""Laws of the multipliers that hold for every vehicle."""

import numpy as np
import pytest

import beal
from properties.vehicles import random_vehicles

UNDAMPED = list(random_vehicles(20, 7))


@pytest.mark.parametrize("vehicle", UNDAMPED, ids=range(len(UNDAMPED)))
def test_the_product_of_the_multipliers_is_1_without_damping(vehicle):
    second = beal.spectrum(beal.discretise(vehicle, order=12), 0.0, 2).angular_frequency[1]
    found = beal.floquet(vehicle, 2.0, 0.5, max(1.9 * second, 0.5))
    if found.largest_modulus < 1e3:  # beyond, the small ones are rounding of the large
        assert np.prod(found.multipliers) == pytest.approx(1.0, abs=1e-10)
        assert abs(1 / found.multipliers[-1]) == pytest.approx(found.largest_modulus, rel=1e-5)


@pytest.mark.parametrize("vehicle", UNDAMPED[:6], ids=range(6))
def test_a_damped_vehicle_with_vanishing_damping_is_the_undamped_one(vehicle):
    """Two ways to the lowest roots: of the undamped equations, and of the first-order ones of a damped vehicle."""
    omega = 2.05 * float(beal.spectrum(beal.discretise(vehicle, order=12), 2.0, 1).angular_frequency[0]) + 1.0
    stages = tuple(stage.model_copy(update={"external_damping": 1e-12}) for stage in vehicle.stages)
    plain, damped = (
        beal.floquet(shown, 2.0, 0.5, omega) for shown in (vehicle, vehicle.model_copy(update={"stages": stages}))
    )
    assert damped.growth_rate == pytest.approx(plain.growth_rate, rel=1e-6, abs=1e-6)
