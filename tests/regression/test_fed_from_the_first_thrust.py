"""A mode that damping feeds from the first thrust on: once taken for part of the tumbling, or seen too late."""

import pytest

from beal.stability.critical import critical_thrust
from beal.stability.vanishing import vanishing_damping_limit
from beal.vehicle import Damping, Stage, Thrust, Vehicle


def test_elastic_modes_bear_nothing_where_damping_feeds_one_of_a_tumbling_vehicle():
    stage = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
    vehicle = Vehicle(stages=[stage], thrust=Thrust(tangency=0.9), damping=Damping(ratios=[0.0, 0.01]))
    found = critical_thrust(vehicle)
    assert (found.critical_thrust, found.rigid_body, found.modes) == (0.0, "tumbling", (0, 0))
    assert (found.elastic.critical_thrust, found.elastic.kind, found.elastic.modes) == (0.0, "flutter", (1, 1))


def test_a_mode_fed_from_the_first_thrust_on_has_its_frequency_without_thrust():
    stage = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
    vehicle = Vehicle(stages=[stage], damping=Damping(ratios=[0.0, 0.01]))
    for answer in (critical_thrust, vanishing_damping_limit):  # it once was that of a thrust well above
        found = answer(vehicle)
        assert (found.critical_thrust, found.modes) == (0.0, (1, 1))
        assert found.angular_frequency == pytest.approx(4.7300407448627**2, rel=1e-3)
