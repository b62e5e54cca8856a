"""First instabilities beside a rigid-body root, which were once mistaken for it or missed."""

import pytest

from beal.stability.critical import critical_events, critical_thrust
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle

METHODS = pytest.mark.parametrize("method", ["fast", "complete"])


@METHODS
def test_a_tumbling_root_that_comes_back_to_zero_is_no_divergence(method):
    # It passes zero upwards at 3.674175 and meets the first bending mode at 3.674375.
    vehicle = Vehicle(
        stages=[
            Stage(length=0.23343248739776268, mass_per_length=1.9827213939389412, bending_stiffness=2.563436181248658),
            Stage(length=0.7665675126022373, mass_per_length=2.3787264429530826, bending_stiffness=0.35057373002012693),
        ],
        joints=[Joint(rotational_stiffness=13312499574.393494, shear_axis="forward")],
        support=Support(nose="pinned"),
        thrust=Thrust(tangency=0.3246326452611893),
    )
    elastic = critical_thrust(vehicle, method=method).elastic
    assert (elastic.kind, elastic.modes) == ("flutter", (0, 1))
    assert elastic.critical_thrust == pytest.approx(3.6743751822, rel=1e-9)


@METHODS
def test_divergence_through_a_zero_root_that_stays_is_seen(method):
    soft = {"shear_axis": "inertial", "shear_stiffness": 13.429051840785021}
    vehicle = Vehicle(
        stages=[
            Stage(
                length=0.14838863260210972, mass_per_length=0.3179356851851542, bending_stiffness=0.38592471418153007
            ),
            Stage(length=0.14468958809550186, mass_per_length=1.4388045237542064, bending_stiffness=1.2777030883721394),
            Stage(length=0.1985910838742745, mass_per_length=1.1640177630234911, bending_stiffness=1.2808342002577207),
            Stage(length=0.4004098731476393, mass_per_length=1.3766143274455043, bending_stiffness=0.36179609396605633),
            Stage(length=0.10792082228047459, mass_per_length=0.716122212886525, bending_stiffness=1.921445490684796),
        ],
        joints=[
            Joint(**soft),
            Joint(rotational_stiffness=325106.46765369014, shear_stiffness=0.9788287217523939),
            Joint(rotational_stiffness=3329938.543177691, shear_stiffness=40633.033571083986, shear_axis="forward"),
            Joint(rotational_stiffness=286543336855.74445, shear_stiffness=1.1401210605899073, shear_axis="aft"),
        ],
        point_masses=[
            PointMass(station=0.4213429824756523, mass=0.38341623421836646, rotary_inertia=0.0003602962052779362)
        ],
        support=Support(nose="pinned"),
    )
    found = critical_thrust(vehicle, method=method)
    assert (found.kind, found.modes) == ("divergence", (1, 1))
    assert found.critical_thrust == pytest.approx(2.7420367006, rel=1e-9)


def test_a_flutter_pair_that_parts_into_two_diverging_roots_is_no_change_of_stability():
    vehicle = Vehicle(
        stages=[
            Stage(length=20.0, mass_per_length=500.0, bending_stiffness=2e8),
            Stage(length=10.0, mass_per_length=300.0, bending_stiffness=1e8),
        ],
        joints=[Joint(shear_stiffness=1e7)],
    )
    found = critical_events(vehicle)
    assert [(event.kind, event.modes, event.unstable) for event in found] == [
        ("flutter", (1, 2), 2),
        ("flutter", (3, 4), 4),
    ]


def test_a_tongue_of_flutter_ends_where_it_ends():
    events = critical_events(catalog.tsto(0.8, 25.0, 300.0), max_thrust=120.0)
    assert [(event.modes, event.change) for event in events] == [
        ((3, 4), "destabilises"),
        ((3, 4), "restabilises"),
        ((1, 2), "destabilises"),
    ]
    assert [event.thrust for event in events] == pytest.approx([7.654975486, 8.754092393, 86.257487381], rel=1e-8)
