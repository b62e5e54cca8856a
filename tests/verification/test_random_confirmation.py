"""What the frequency domain says of random vehicles, seen in time: growth above the critical thrust, none below."""

from itertools import islice

import numpy as np
import pytest

from beal.discretisation import discretise
from beal.motion import Samples, growth_rate, response
from beal.stability.critical import critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle import Sensor
from properties.vehicles import random_vehicles

ABOVE, BELOW = 1.02, 0.98
FOLDS = 16.0  # times e that the motion grows: its second half is that of the fastest mode alone


def unstable_vehicles():
    """Those that flutter or diverge in an elastic mode."""
    for vehicle in random_vehicles(200, seed=20261125, softest=1.0, stiffest=1e4, absent=0.0):
        found = critical_thrust(vehicle)
        if found.critical_thrust and found.modes != (0, 0):
            yield vehicle, found


CASES = list(islice(unstable_vehicles(), 20))


def test_both_kinds_of_instability_are_among_the_cases():
    assert {found.kind for _, found in CASES} == {"flutter", "divergence"}


@pytest.mark.parametrize("number", range(len(CASES)))
def test_a_random_vehicle_grows_above_its_critical_thrust_as_its_root_says_and_not_below(number):
    vehicle, found = CASES[number]
    vehicle = vehicle.model_copy(update={"sensors": (Sensor(name="tail", station=vehicle.length),)})
    operators = discretise(vehicle)
    rate = spectrum(operators, ABOVE * found.critical_thrust, count=12).growth_rate.max()
    stations = np.linspace(0.0, vehicle.length, 12)
    start = Samples(stations, np.polyval(np.random.default_rng(number).normal(size=4), stations))
    above, below = (
        response(operators, FOLDS / rate, share * found.critical_thrust, method="exact", initial=start)
        for share in (ABOVE, BELOW)
    )
    assert growth_rate(above, "tail") == pytest.approx(rate, rel=0.01)
    early, late = np.array_split(abs(below.elastic_displacement[0]), 2)
    assert late.max() < 1.5 * early.max()  # a beat may be higher later; growth would be by a factor of e^8
