"""Options, refusals and result fields of the critical thrust."""

import math

import pytest

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.limit import default_limit
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle


def jointed(joint: Joint, support: Support | None = None, tangency: float = 1.0) -> Vehicle:
    stage = Stage(length=0.5, mass_per_length=1, bending_stiffness=1)
    return Vehicle(
        stages=[stage, stage], joints=[joint], support=support or Support(), thrust=Thrust(tangency=tangency)
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"formulation": "exact"}, "formulation: must be one of objective, .*found 'exact'"),
        ({"basis": "fourier"}, "basis: must be one of legendre, hermite, found 'fourier'"),
        ({"modes": 8}, "modes: applies to corrected-ritz and as-printed only, found formulation 'objective'"),
        ({"max_thrust": -1.0}, "max_thrust: must be a positive number, found -1.0"),
        ({"max_thrust": 0.0}, "max_thrust: must be a positive number, found 0.0"),
        ({"max_thrust": math.nan}, "max_thrust: must be a positive number, found nan"),
        ({"max_thrust": math.inf}, "max_thrust: must be a positive number, found inf"),
        ({"max_thrust": 1e9}, "max_thrust: at most .* is resolved for this vehicle, found 1e\\+09"),
        ({"method": "slow"}, "method: must be fast or complete, found 'slow'"),
        ({"formulation": "as-printed", "modes": 0}, "order: must be at least 1, found 0"),
    ],
)
def test_unusable_option_is_named(options, message):
    arguments = {"basis": "legendre", **options}
    if "basis" in options:
        with pytest.raises(ModelError, match=message):
            discretise(catalog.beal(), **options)
        return
    with pytest.raises(ModelError, match=message):
        critical_thrust(catalog.tsto(0.6, 5e3, 5e3), **arguments)


@pytest.mark.parametrize("formulation", ["corrected-ritz", "as-printed"])
@pytest.mark.parametrize(
    ("vehicle", "reason"),
    [
        (catalog.beal(), "two stages, found 1"),
        (jointed(Joint(rotational_stiffness=1), Support(nose="clamped")), "free ends, found clamped nose"),
        (
            jointed(Joint(rotational_stiffness=1)).model_copy(
                update={"point_masses": [PointMass(station=0.2, mass=1.0)]}
            ),
            "no point masses, found 1",
        ),
    ],
)
def test_formulation_of_the_paper_is_refused_elsewhere_with_the_reason(formulation, vehicle, reason):
    with pytest.raises(ModelError, match=f"formulation {formulation}: applies to the paper's vehicle only, .*{reason}"):
        critical_thrust(vehicle, formulation=formulation)


def test_result_says_how_far_and_among_how_many_modes_was_searched():
    found = critical_thrust(catalog.beal(), max_thrust=100.0)
    assert (found.kind, found.critical_thrust, found.modes, found.error_estimate) == ("stable", None, None, None)
    assert (found.searched_to, found.watched_modes, found.rigid_body) == (100.0, 8, "neutral")
    assert found.elastic is None


def test_each_spring_adds_a_watched_mode():
    assert critical_thrust(catalog.tsto(0.6, 5e3, 5e3)).watched_modes == 10
    assert critical_thrust(catalog.tsto(0.6, 5e3, math.inf)).watched_modes == 9


def test_search_ends_at_five_half_waves_of_the_dead_load():
    assert default_limit(catalog.beck()) == pytest.approx(25 * math.pi**2)
    assert critical_thrust(catalog.beck()).searched_to == default_limit(catalog.beck())


@pytest.mark.parametrize(
    ("vehicle", "rigid_body"),
    [
        (catalog.beal(), "neutral"),
        (catalog.beck(), "held"),
        (jointed(Joint(), tangency=0.5), "tumbling"),
        (catalog.tsto(0.6, 5e3, 5e3, "inertial"), "neutral"),
    ],
)
def test_rigid_body_motion_is_reported(vehicle, rigid_body):
    assert critical_thrust(vehicle).rigid_body == rigid_body


@pytest.mark.parametrize("method", ["fast", "complete"])
def test_hinge_folds_under_any_thrust(method):
    found = critical_thrust(jointed(Joint(rotational_stiffness=0.0)), method=method)
    assert (found.kind, found.modes, found.critical_thrust) == ("divergence", (1, 1), 0.0)
    assert (found.angular_frequency, found.error_estimate) == (0.0, 0.0)


@pytest.mark.parametrize("method", ["fast", "complete"])
@pytest.mark.parametrize("axis", ["mean", "inertial"])
def test_separate_stages_give_way_under_any_thrust(method, axis):
    found = critical_thrust(
        jointed(Joint(rotational_stiffness=0.0, shear_stiffness=0.0, shear_axis=axis)), method=method
    )
    assert found.critical_thrust == 0.0


@pytest.mark.parametrize("stiffness", [1e-2, 1e-4, 1e-6])
def test_soft_hinge_folds_in_proportion_to_its_stiffness(stiffness):
    found = critical_thrust(jointed(Joint(rotational_stiffness=stiffness)))
    assert found.kind == "divergence"
    assert found.critical_thrust / stiffness == pytest.approx(16, rel=10 * stiffness)


def test_restabilisation_is_an_event():
    events = critical_events(jointed(Joint(rotational_stiffness=10.0)))
    assert [event.change for event in events[:2]] == ["destabilises", "restabilises"]
    assert [event.thrust for event in events[:2]] == pytest.approx([63.2458520104, 113.896718262], rel=1e-9)


def test_events_begin_with_the_critical_thrust():
    vehicle = catalog.tsto(0.6, 5e3, 5e3)
    first, found = critical_events(vehicle)[0], critical_thrust(vehicle)
    assert first.thrust == pytest.approx(found.critical_thrust, rel=1e-9)
    assert (first.kind, first.modes, first.before, first.unstable) == ("flutter", (1, 2), 0, 2)


@pytest.mark.parametrize(
    ("given", "limit", "kind", "thrust"),
    [
        pytest.param((0.6, 11.02383, 1e4), None, "divergence", 81.86769290906, id="window of 0.03 %"),
        pytest.param((0.6, 250.582061, 5e3), 132.5, "flutter", 106.0000002208, id="next to a step"),
    ],
)
def test_the_fast_search_neither_steps_over_a_window_nor_gives_up_beside_a_step(given, limit, kind, thrust):
    vehicle = catalog.tsto(*given)
    for method in ("fast", "complete"):
        found = critical_thrust(vehicle, limit, method=method)
        assert (found.kind, found.critical_thrust) == (kind, pytest.approx(thrust, rel=1e-9))
