"""Stages that shear, turn their inertia, or are rigid: against each other, and against what they are limits of."""

import math

import numpy as np
import pytest

import beal
from beal.stability.large import is_large
from properties.vehicles import random_vehicle, sheared

BECK = 20.050953618973761


def column(shear=math.inf, inertia=0.0, tip=0.0, nose="clamped", pieces=1, **thrust):
    stage = beal.Stage(
        length=1 / pieces,
        mass_per_length=1.0,
        bending_stiffness=1.0,
        shear_stiffness=shear,
        rotary_inertia_per_length=inertia,
    )
    return beal.Vehicle(
        units="nondimensional",
        stages=[stage] * pieces,
        joints=[beal.Joint()] * (pieces - 1),
        point_masses=[beal.PointMass(station=1.0, mass=tip)] if tip else [],
        support=beal.Support(nose=nose),
        thrust=beal.Thrust(**thrust),
    )


def load(vehicle, **options):
    return beal.critical_thrust(vehicle, **options).critical_thrust


@pytest.mark.parametrize("seed", range(16))
def test_all_searches_and_discretisations_agree_on_stages_that_shear(seed):
    rng = np.random.default_rng(seed)
    vehicle = sheared(random_vehicle(rng, softest=1.0, absent=0.0), rng)
    fast, complete = (beal.critical_thrust(vehicle, **way) for way in SEARCHES)
    elements = beal.critical_thrust(beal.discretise(vehicle, basis="hermite", order=12))
    one, other, third = (found.elastic or found for found in (fast, complete, elements))
    assert one.kind == other.kind == third.kind
    if one.kind != "stable":
        assert one.modes == other.modes == third.modes
        assert other.critical_thrust == pytest.approx(one.critical_thrust, rel=1e-9)
        assert third.critical_thrust == pytest.approx(one.critical_thrust, rel=1e-3)  # a dozen cubic elements a stage


SEARCHES = ({}, {"method": "complete"})


def test_haringx_is_engesser_with_the_axial_force_added_to_the_shear_stiffness():
    haringx = load(column(30.0, axial_term="haringx"))
    assert load(column(30.0 + haringx)) == pytest.approx(haringx, rel=1e-10)


@pytest.mark.parametrize("nose", ["clamped", "free"])
def test_slope_and_section_are_one_at_a_bare_end(nose):
    of_slope, of_section = (load(column(50.0, 0.01, nose=nose, along=along)) for along in ("slope", "section"))
    assert of_section == pytest.approx(of_slope, rel=1e-9)


@pytest.mark.parametrize(("inertia", "limit"), [(0.0, BECK), (0.01, 18.168487409583)])
def test_stiff_shear_tends_to_none_with_the_first_power_of_its_compliance(inertia, limit):
    missing = [limit - load(column(shear, inertia)) for shear in (1e4, 1e5, 1e6)]
    assert missing[0] / missing[1] == pytest.approx(10, rel=1e-2)
    assert missing[1] / missing[2] == pytest.approx(10, rel=1e-3)
    assert load(column(1e15, inertia)) == pytest.approx(limit, rel=1e-11)  # and locks nowhere


def test_elements_that_shear_converge_with_the_fourth_power_of_their_length():
    exact = load(column(1000.0))
    errors = [load(beal.discretise(column(1000.0), basis="hermite", order=n)) - exact for n in (8, 16, 32)]
    assert [errors[0] / errors[1], errors[1] / errors[2]] == pytest.approx([16, 16], rel=0.05)


def test_many_pieces_that_shear_are_one():
    pieces = column(100.0, 0.0025, pieces=20)
    assert is_large(pieces)
    assert load(pieces) == pytest.approx(load(column(100.0, 0.0025)), rel=1e-10)


def test_tables_of_constant_shear_stiffness_and_rotary_inertia_are_numbers():
    x = [0.0, 0.3, 1.0]
    tables = {
        "shear_stiffness": {"x": x, "value": [100.0] * 3},
        "rotary_inertia_per_length": {"x": x, "value": [0.0025] * 3},
    }
    plain = column(100.0, 0.0025)
    table = plain.model_copy(update={"stages": [plain.stages[0].model_copy(update=tables)]})
    assert load(table) == pytest.approx(load(plain), rel=1e-10)


def test_a_short_stage_that_shears_is_a_joint_with_haringx_axial_force():
    """A layer of thickness h and shear stiffness k_s h slides like a shear joint; the couple of theory 6c included."""
    joint = load(beal.catalog.tsto(0.6, math.inf, 500.0))
    errors = []
    for thickness in (1e-3, 1e-4):
        layer = beal.Stage(
            length=thickness, mass_per_length=1.0, bending_stiffness=math.inf, shear_stiffness=500.0 * thickness
        )
        around = [beal.Stage(length=x, mass_per_length=1.0, bending_stiffness=1.0) for x in (0.6 - thickness, 0.4)]
        vehicle = beal.Vehicle(
            units="nondimensional",
            stages=[around[0], layer, around[1]],
            joints=[beal.Joint(), beal.Joint()],
            thrust=beal.Thrust(axial_term="haringx"),
        )
        errors.append(load(vehicle) - joint)
    assert abs(errors[1]) < 1e-2 * joint
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)


def test_a_rigid_stage_is_the_limit_of_a_stiff_one():
    def held(stiffness):
        stages = [beal.Stage(length=0.5, mass_per_length=1.0, bending_stiffness=k) for k in (1.0, stiffness)]
        return load(
            beal.Vehicle(
                units="nondimensional", stages=stages, joints=[beal.Joint()], support=beal.Support(nose="clamped")
            )
        )

    missing = [held(math.inf) - held(stiffness) for stiffness in (1e4, 1e5)]
    assert missing[0] / missing[1] == pytest.approx(10, rel=1e-2)


def pendulum(upper, lower):
    rod = beal.Stage(length=1.0, mass_per_length=0.0, bending_stiffness=math.inf)
    return beal.Vehicle(
        units="nondimensional",
        stages=[rod, rod],
        joints=[beal.Joint(rotational_stiffness=1.0)],
        point_masses=[beal.PointMass(station=1.0, mass=upper), beal.PointMass(station=2.0, mass=lower)],
        support=beal.Support(nose={"translation": math.inf, "rotation": 1.0}),
    )


@pytest.mark.parametrize(
    ("masses", "thrust"), [((2, 1), 7 / 2 - math.sqrt(2)), ((1, 1), 2.0), ((1, 2), 11 / 4 - math.sqrt(2) / 2)]
)
@pytest.mark.parametrize("way", [*SEARCHES, {"basis": "hermite"}])
def test_massless_rigid_rods_make_zieglers_pendulum(masses, thrust, way):
    assert load(pendulum(*masses), **way) == pytest.approx(thrust, rel=1e-12)


def test_a_stage_without_mass_must_be_rigid():
    with pytest.raises(beal.ModelError, match=r"mass_per_length: must be positive where the stage bends, found 0"):
        beal.Stage(length=1.0, mass_per_length=0.0, bending_stiffness=1.0)


def test_a_rigid_body_is_no_vehicle():
    with pytest.raises(beal.ModelError, match=r"some stage must bend or shear"):
        beal.Vehicle(stages=[beal.Stage(length=1.0, mass_per_length=1.0, bending_stiffness=math.inf)])
