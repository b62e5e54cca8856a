"""The ridge scan against the search that finds all critical thrusts from one eigenvalue problem."""

import pytest

from beal.stability.critical import critical_thrust
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, PointMass, Stage
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicles

COUNT = 240


@pytest.mark.parametrize("part", range(4))
def test_both_searches_find_the_same_first_instability(part):
    different = []
    for number, vehicle in enumerate(random_vehicles(COUNT // 4, seed=1965 + part, absent=0.0)):
        fast, complete = (critical_thrust(vehicle, method=method) for method in ("fast", "complete"))
        fast, complete = fast.elastic or fast, complete.elastic or complete
        assert fast.rigid_body == complete.rigid_body
        same = fast.critical_thrust == pytest.approx(complete.critical_thrust, rel=1e-9, abs=0)
        if not same or (fast.kind, fast.modes) != (complete.kind, complete.modes):
            different.append(
                f"{number}: {fast.kind} {fast.modes} {fast.critical_thrust}, "
                f"{complete.kind} {complete.modes} {complete.critical_thrust}"
            )
    assert different == []


@pytest.mark.parametrize("split", [0.2, 0.4, 0.6, 0.8])
@pytest.mark.parametrize("springs", [(1.0, 100.0), (30.0, 3e3), (200.0, 600.0), (1e4, 1e4)])
def test_both_searches_agree_on_the_two_stage_vehicle(split, springs):
    fast, complete = (critical_thrust(catalog.tsto(split, *springs), method=method) for method in ("fast", "complete"))
    assert (fast.kind, fast.modes) == (complete.kind, complete.modes)
    assert fast.critical_thrust == pytest.approx(complete.critical_thrust, rel=1e-9)


@pytest.mark.parametrize("method", ["fast", "complete"])
def test_tongue_of_flutter_just_below_divergence_is_seen(method):
    # Unstable from 3.9128 to 3.9494, stable again, then divergence at 4.0725, where a scan from zero would stop.
    stages = [
        Stage(length=0.23827952630257337, mass_per_length=0.5089969932604754, bending_stiffness=0.4346029966927606),
        Stage(length=0.10014775237733975, mass_per_length=0.49511933472379804, bending_stiffness=0.8064786565321896),
        Stage(length=0.4623072959945113, mass_per_length=2.1982522599187644, bending_stiffness=0.46462619726100596),
        Stage(length=0.19926542532557373, mass_per_length=0.3957317640374284, bending_stiffness=0.44319992188975665),
    ]
    soft = Joint(rotational_stiffness=0.03594360131253341, shear_stiffness=0.011166473109681729, shear_axis="aft")
    lump = PointMass(station=0.9135647574429268, mass=0.37011713461662393)
    vehicle = Vehicle(stages=stages, joints=[soft, Joint(), Joint()], point_masses=[lump])
    found = critical_thrust(vehicle, method=method)
    assert (found.kind, found.modes) == ("flutter", (1, 2))
    assert found.critical_thrust == pytest.approx(3.9128421, rel=1e-6)
