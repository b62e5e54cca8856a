"""Supports, foundations and loads of the literature, each in polynomials, in elements, split into stages and large.

Values are those of `beal.verification`; tolerances are their digits (twelve, of some ten), and those of the elements'
own error estimates.
"""

import math

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle import Joint, Stage, Vehicle
from verification.known import frequency, thrust

PI = math.pi
BECK, BECK_OMEGA = thrust("beck()"), frequency("beck()")
LARGE = 14  # stages, which go by sparse matrices


def column(pieces=1, nose="clamped", tail="free", foundation=0.0, **parts):
    piece = Stage(length=1 / pieces, mass_per_length=1.0, bending_stiffness=1.0, foundation_stiffness=foundation)
    support = {"nose": nose, "tail": tail}
    return Vehicle(stages=[piece] * pieces, joints=[Joint()] * (pieces - 1), support=support, **parts)


def distributed(value, **more):
    return {"thrust": {"scale": 0.0}, "distributed_thrust": [{"value": value, **more}]}


def spring(translation=math.inf, rotation=math.inf):
    return {"translation": translation, "rotation": rotation}


CASES = {
    "leipholz()": distributed(1.0),
    "leipholz('pinned', 'pinned')": distributed(1.0) | {"nose": "pinned", "tail": "pinned"},
    "leipholz('clamped', 'pinned')": distributed(1.0) | {"tail": "pinned"},
    "leipholz('clamped', 'clamped')": distributed(1.0) | {"tail": "clamped"},
    "hauger()": distributed({"x": [0, 1], "value": [1, 0]}),
    "greenhill()": distributed(1.0, tangency=0.0),
    "reut()": {"thrust": {"line": "fixed"}},
    "beck_on_springs(nose_rotation=0.1)": {"nose": spring(rotation=0.1)},
    "beck_on_springs(nose_rotation=10.0)": {"nose": spring(rotation=10.0)},
    "beck_on_springs(tail_translation=1.0)": {"tail": spring(1.0, 0.0)},
    "beck_on_springs(tail_translation=34.8)": {"tail": spring(34.8, 0.0)},
    "beck_on_springs(tail_translation=35.0)": {"tail": spring(35.0, 0.0)},
    "beck_on_springs(tail_translation=1000.0)": {"tail": spring(1000.0, 0.0)},
    "beck_on_foundation(100.0)": {"foundation": 100.0},
}
VARIANTS = {
    "a table": (distributed({"x": [0, 1], "value": [1, 1]}), "flutter", thrust("leipholz()"), frequency("leipholz()")),
    "half of the parameter": ({"thrust": {"scale": 0.5}}, "flutter", 2 * BECK, BECK_OMEGA),
    "the tail as a station": ({"thrust": {"station": 1.0}}, "flutter", BECK, BECK_OMEGA),
    # A dead load that turns with the tail takes its part of Beck's load; one fixed in space its part of Euler's.
    "dead follower": (
        {"axial_load": [{"station": 1.0, "force": 7.0, "tangency": 1.0}]}, "flutter", BECK - 7.0, BECK_OMEGA,
    ),
    "dead pull": (
        {"axial_load": [{"station": 1.0, "force": -1.0}], "thrust": {"tangency": 0.0}}, "divergence", PI**2 / 4 + 1, 0,
    ),
}  # fmt: skip
KNOWN = {
    name: (parts, "flutter" if frequency(name) else "divergence", thrust(name), frequency(name))
    for name, parts in CASES.items()
} | VARIANTS


@pytest.mark.parametrize("case", KNOWN)
def test_each_case_of_the_literature_in_four_ways(case):
    parts, kind, load, omega = KNOWN[case]
    ways = ((1, "legendre"), (3, "legendre"), (LARGE, "legendre"), (1, "hermite"))
    for pieces, basis in ways:
        found = critical_thrust(column(pieces, **parts), basis=basis)
        assert found.kind == kind
        assert found.critical_thrust == pytest.approx(load, rel=3e-11 if basis == "legendre" else 2e-9)
        assert found.angular_frequency == pytest.approx(omega, rel=3e-9, abs=1e-12)


@pytest.mark.parametrize("stiffness", [1e6, 1e12])
def test_a_stiff_end_is_a_held_one(stiffness):
    soft = critical_thrust(column(tail=spring(stiffness, 0.0))).critical_thrust
    assert soft == pytest.approx(critical_thrust(column(tail="pinned")).critical_thrust, rel=30 / stiffness + 1e-11)
    clamp = critical_thrust(column(nose=spring(stiffness, stiffness))).critical_thrust
    assert clamp == pytest.approx(BECK, rel=30 / stiffness + 1e-11)
    assert column(nose=spring()).support.stiffness == column().support.stiffness


def test_becks_column_changes_its_kind_at_a_tangency_of_one_half():
    below, above = (critical_thrust(column(thrust={"tangency": eta})) for eta in (0.49, 0.51))
    assert (below.kind, above.kind) == ("divergence", "flutter")
    assert below.critical_thrust == pytest.approx(math.acos(-0.49 / 0.51) ** 2, rel=1e-10)


def test_reuts_column_is_the_adjoint_of_becks():
    beck, reut = (discretise(column(thrust={"line": line, "tangency": 0.7})).K1 for line in ("moving", "fixed"))
    np.testing.assert_allclose(reut, beck.T, atol=1e-14)
    assert np.abs(reut - beck).max() > 0.1


def test_a_thrust_at_the_middle_presses_on_the_forward_half_only():
    # The aft half is a mass that the forward half carries: heavier than half the column, no more than its length away.
    middle = critical_thrust(column(thrust={"station": 0.5}))
    assert middle.critical_thrust == pytest.approx(
        critical_thrust(column(2, thrust={"station": 0.5}), basis="hermite").critical_thrust, rel=1e-9
    )
    straight = spectrum(discretise(column(thrust={"station": 0.0})), 50.0, 3).angular_frequency
    np.testing.assert_allclose(straight, spectrum(discretise(column()), 0.0, 3).angular_frequency, rtol=1e-10)


def test_drag_at_the_nose_is_a_thrust_from_the_other_end():
    drag = [{"station": 0.0, "force": -100.0, "tangency": 1.0}]
    under_drag = spectrum(discretise(column(nose="free", axial_load=drag), order=16), 0.0, 3)
    np.testing.assert_allclose(under_drag.angular_frequency, [13.9482741447, 34.0618162988, 97.6980376812], rtol=1e-10)


def test_drag_leaves_the_attitude_of_a_vehicle_in_flight_alone():
    drag = {"station": 0.0, "force": -30.0, "tangency": 1.0}
    ways = [critical_thrust(column(n, nose="free", axial_load=[drag])) for n in (1, 3, LARGE)]
    assert {way.rigid_body for way in ways} == {"neutral"}
    assert [way.critical_thrust for way in ways] == pytest.approx([ways[0].critical_thrust] * 3, rel=1e-11)
    fixed = critical_thrust(column(nose="free", axial_load=[drag | {"force": -3.0, "tangency": 0.0}]))
    assert (fixed.rigid_body, fixed.critical_thrust) == ("tumbling", 0.0)


def test_gravity_presses_on_what_stands_below():
    weight = 5.0
    hanging = column(gravity=weight)  # by the nose
    standing = column(nose="free", tail="clamped", gravity=weight)
    upside_down = column(gravity=-weight)
    low = [spectrum(discretise(vehicle), 0.0, 1).angular_frequency[0] for vehicle in (hanging, standing, upside_down)]
    assert low[1] == pytest.approx(low[2], rel=1e-12)
    assert low[1] < 3.516015 < low[0]
    # A dead thrust p at the tip and the weight r p along the column, both as parts of one parameter.
    p = critical_thrust(column(gravity=-weight, thrust={"tangency": 0.0})).critical_thrust
    both = column(thrust={"tangency": 0.0}, distributed_thrust=[{"value": weight / p, "tangency": 0.0}])
    assert critical_thrust(both).critical_thrust == pytest.approx(p, rel=1e-11)
    assert discretise(column(nose="free", gravity=9.81)).dead is None


@pytest.mark.parametrize("search", [critical_thrust, critical_events])
def test_dead_loads_that_are_too_large_alone_are_refused(search):
    with pytest.raises(ModelError, match="dead loads alone"):
        search(column(axial_load=[{"station": 1.0, "force": 21.0, "tangency": 1.0}]))
    with pytest.raises(ModelError, match="dead loads alone"):
        search(column(LARGE, axial_load=[{"station": 1.0, "force": 2.5}]))


def test_both_searches_agree_beside_dead_loads():
    vehicle = column(axial_load=[{"station": 1.0, "force": 7.0, "tangency": 1.0}])
    assert critical_thrust(vehicle, method="complete").critical_thrust == pytest.approx(BECK - 7.0, rel=1e-11)
    assert critical_events(vehicle)[0].thrust == pytest.approx(BECK - 7.0, rel=1e-11)


def test_a_free_vehicle_on_a_foundation_bounces_at_its_frequency():
    vehicle = column(nose="free", foundation=7.0)
    free = spectrum(discretise(column(nose="free")), 0.0, 1)
    found = spectrum(discretise(vehicle), 0.0, 3).angular_frequency
    np.testing.assert_allclose(found, np.sqrt(7.0 + np.array([0.0, 0.0, free.angular_frequency[0] ** 2])), rtol=1e-12)


@pytest.mark.parametrize(
    "parts",
    [
        {"axial_load": [{"station": 0.0, "force": -20.0, "tangency": 1.0}]},
        {"distributed_thrust": [{"value": {"x": [0.0, 0.3, 0.3, 1.0], "value": [1.0, 2.0, 0.0, 0.1]}}]},
        {"thrust": {"station": 0.5}},
        {"thrust": {"scale": 0.5}, "distributed_thrust": [{"value": 0.5}]},
    ],
)
def test_loads_pass_through_a_joint_that_shears_without_turning_the_vehicle(parts):
    half = Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
    joint = Joint(rotational_stiffness=50.0, shear_stiffness=500.0)
    vehicle = Vehicle(stages=[half, half], joints=[joint], **parts)
    found = critical_thrust(vehicle)
    assert found.rigid_body == "neutral"
    assert critical_thrust(vehicle, basis="hermite").critical_thrust == pytest.approx(found.critical_thrust, rel=1e-9)
