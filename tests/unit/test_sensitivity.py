"""What a sensitivity says: laws that its numbers obey, one-sided values, ties, refusals."""

import math

import numpy as np
import pytest

import beal
from beal import catalog
from beal.vehicle.paths import with_values

STAGES = [0, 1]


def test_stiffnesses_scale_the_critical_thrust_together():
    found = beal.sensitivity(catalog.tsto(0.6, 20.0, 100.0))
    stiff = [each for each in found.parameters if "stiffness" in each.path and 0 < each.value < math.inf]
    assert sum(each.elasticity for each in stiff) == pytest.approx(1.0, abs=1e-9)
    assert sum(each.frequency_elasticity for each in stiff) == pytest.approx(0.5, abs=1e-9)


def test_masses_scale_the_frequency_and_not_the_critical_thrust():
    found = beal.sensitivity(catalog.tsto(0.6, 20.0, 100.0), [f"stage[{n}].mass_per_length" for n in STAGES])
    assert sum(each.elasticity for each in found.parameters) == pytest.approx(0.0, abs=1e-9)
    assert sum(each.frequency_elasticity for each in found.parameters) == pytest.approx(-0.5, abs=1e-9)


def test_the_split_is_a_longer_stage_and_a_shorter_one():
    vehicle = catalog.tsto(0.6, 20.0, 100.0)
    found = beal.sensitivity(vehicle, ["stage.split", "stage[0].length", "stage[1].length"])
    split, longer, shorter = found.parameters
    assert split.derivative == pytest.approx(longer.derivative - shorter.derivative, rel=1e-9)


def test_a_rigid_joint_has_a_derivative_over_its_compliance():
    rigid, soft = (catalog.tsto(0.6, stiffness, 5000.0) for stiffness in (math.inf, 1e7))
    path = "joint[0].rotational_stiffness"
    at_infinity, near = (beal.sensitivity(vehicle, [path])[path] for vehicle in (rigid, soft))
    assert (at_infinity.derivative, at_infinity.elasticity, at_infinity.status) == (0.0, 0.0, "differenced")
    assert at_infinity.compliance_derivative == pytest.approx(-near.derivative * 1e14, rel=1e-4)


def test_a_mass_at_the_tail_moves_forward_only():
    vehicle = with_mass(1.0)
    path = "point_mass[0].station"
    at_tail = beal.sensitivity(vehicle, [path])[path]
    inside = [beal.sensitivity(with_mass(1.0 - d), [path])[path] for d in (2e-3, 1e-3)]
    assert at_tail.status == "differenced"
    assert at_tail.derivative == pytest.approx(2 * inside[1].derivative - inside[0].derivative, rel=1e-3)


def test_the_least_foundation_under_a_free_vehicle_makes_the_critical_thrust_jump():
    path = "stage[0].foundation_stiffness"
    assert beal.sensitivity(catalog.tsto(0.6, 20.0, 100.0), [path])[path].status == "not differentiable"
    assert beal.sensitivity(catalog.beck(), [path])[path].status == "one-sided"


@pytest.mark.parametrize("formulation", ["corrected-ritz", "as-printed"])
def test_a_ritz_formulation_is_differentiated_where_its_two_equal_stages_allow(formulation):
    vehicle = catalog.tsto(0.6, 20.0, 100.0)
    paths = ["joint[0].rotational_stiffness", "stage.split", "stage[0].mass_per_length"]
    *allowed, mass = beal.sensitivity(vehicle, paths, formulation=formulation, modes=6).parameters
    assert (mass.status, math.isnan(mass.derivative)) == ("not differentiable", True)
    for each in allowed:
        step = 1e-5 * each.value
        high, low = (
            beal.critical_thrust(with_values(vehicle, {each.path: each.value + d}), None, formulation, modes=6)
            for d in (step, -step)
        )
        slope = (high.critical_thrust - low.critical_thrust) / (2 * step)
        assert each.derivative == pytest.approx(slope, rel=1e-6), each.path


def test_frequencies_have_derivatives_over_the_compliance_of_a_rigid_joint_and_over_a_first_damping():
    path = "joint[0].rotational_stiffness"
    rigid = catalog.tsto(0.6, math.inf, 5000.0)
    near = beal.frequency_sensitivity(catalog.tsto(0.6, 1e6, 5000.0), 30.0, [path]).frequency_derivative
    found = beal.frequency_sensitivity(rigid, 30.0, [path, "stage[0].internal_damping"])
    np.testing.assert_allclose(found.frequency_derivative[0], -1e12 * near[0], rtol=1e-5)
    small = with_values(rigid, {"stage[0].internal_damping": 1e-8})
    damped = beal.frequency_sensitivity(small, 30.0, ["stage[0].internal_damping"])
    np.testing.assert_allclose(found.growth_derivative[1], damped.growth_derivative[0], rtol=1e-6)


def strut(foundation):
    """Buckles with one half wave at pi^2 EI + k/pi^2 and with two at 4 pi^2 EI + k/(4 pi^2), equal at k = 4 pi^4."""
    stage = beal.Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0, foundation_stiffness=foundation)
    return beal.Vehicle(stages=[stage], support=beal.Support(nose="pinned", tail="pinned"), units="nondimensional")


@pytest.mark.parametrize("off", [0.0, 1e-9, -1e-9, 1e-8, 3e-7, -3e-7])
def test_a_tie_has_the_derivative_of_one_instability_below_and_of_the_other_above(off):
    paths = ["stage[0].foundation_stiffness", "stage[0].bending_stiffness"]
    found = beal.sensitivity(strut(4 * math.pi**4 * (1 + off)), paths)
    assert found.status == "tie"
    foundation, bending = found.parameters
    assert (foundation.below, foundation.above) == (
        pytest.approx(1 / math.pi**2, rel=1e-8),
        pytest.approx(0.25 / math.pi**2, rel=1e-8),
    )
    assert (bending.below, bending.above) == (
        pytest.approx(4 * math.pi**2, rel=1e-8),
        pytest.approx(math.pi**2, rel=1e-8),
    )


@pytest.mark.parametrize("off", [1e-2, 1e-4, 1e-5, 1e-6, -1e-5, -1e-3])
def test_of_two_divergences_that_all_but_tie_the_lower_one_is_critical(off):
    foundation = 4 * math.pi**4 * (1 + off)
    lower = min(math.pi**2 + foundation / math.pi**2, 4 * math.pi**2 + foundation / (4 * math.pi**2))
    assert beal.critical_thrust(strut(foundation)).critical_thrust == pytest.approx(lower, rel=1e-12)


@pytest.mark.parametrize(("turning", "kind"), [(20.0, "flutter"), (5.0, "divergence")])
def test_second_derivatives_obey_the_laws_of_scaling_and_follow_differences(turning, kind):
    """A thrust of first degree in all stiffnesses has a gradient of degree 0: the Hessian times them is 0."""
    vehicle = catalog.tsto(0.6, turning, 5e3)
    springs = [f"joint[0].{name}_stiffness" for name in ("rotational", "shear")]
    stiff = [*springs, *(f"stage[{n}].bending_stiffness" for n in STAGES)]
    found = beal.critical_hessian(vehicle, stiff)
    assert found.critical.kind == kind
    values = np.array([turning, 5e3, 1.0, 1.0])
    assert values @ found.gradient == pytest.approx(found.critical.critical_thrust, rel=1e-9)
    np.testing.assert_allclose(values * (found.hessian @ values), 0.0, atol=1e-8 * found.critical.critical_thrust)
    step = 1e-3 * turning
    low, high = (beal.critical_gradient(catalog.tsto(0.6, turning + d, 5e3), stiff).thrust for d in (-step, step))
    np.testing.assert_allclose(found.hessian[0], (high - low) / (2 * step), rtol=1e-4)


def test_a_quantity_at_its_bound_has_no_second_derivative():
    with pytest.raises(beal.ModelError, match="foundation_stiffness: has no second derivative"):
        beal.critical_hessian(catalog.beck(), ["stage[0].foundation_stiffness"])


def with_mass(station):
    return catalog.beck().model_copy(update={"point_masses": (beal.PointMass(station=station, mass=0.5),)})


def test_the_first_damping_makes_the_critical_thrust_jump():
    found = beal.sensitivity(catalog.beck(), ["stage[0].internal_damping"])
    assert found.parameters[0].status == "not differentiable"
    assert math.isnan(found.parameters[0].derivative)


def test_a_vehicle_without_instability_has_no_derivative():
    with pytest.raises(beal.ModelError, match="nothing to differentiate"):
        beal.sensitivity(catalog.beck(), max_thrust=5.0)


def test_an_unknown_quantity_is_named():
    with pytest.raises(beal.ModelError, match=r"stage\[0\].lenght"):
        beal.sensitivity(catalog.beck(), ["stage[0].lenght"])


@pytest.mark.parametrize("thrust", [0.0, 60.0])
def test_frequencies_follow_their_derivatives(thrust):
    vehicle, path, step = catalog.tsto(0.6, 20.0, 100.0), "stage.split", 1e-4
    found = beal.frequency_sensitivity(vehicle, thrust, [path], count=3)
    ends = [
        beal.frequency_sensitivity(with_values(vehicle, {path: 0.6 + n * step}), thrust, [path], count=3)
        for n in (-2, -1, 1, 2)
    ]
    by_differences = np.array([1, -8, 8, -1]) / 12 @ [each.angular_frequency for each in ends] / step
    assert found.frequency_derivative[0] == pytest.approx(by_differences, rel=1e-7)


def test_derivatives_go_through_the_timeline():
    line = beal.Timeline(time=[0.0, 10.0], thrust=[9.0, 9.0], fill={"fuel": [1.0, 0.25]})
    tank = beal.Tank(name="fuel", forward_end=0.2, aft_end=0.5, mass_per_length=3.0)
    flying = catalog.tsto(0.6, 20.0, 100.0).model_copy(update={"tanks": (tank,), "timeline": line})
    emptied = tank.model_copy(update={"fill": 0.25})
    still = flying.model_copy(update={"tanks": (emptied,), "timeline": None})
    path = "tank[0].mass_per_length"
    in_flight, on_its_own = beal.sensitivity(flying, [path], time=10.0)[path], beal.sensitivity(still, [path])[path]
    assert in_flight.derivative == pytest.approx(on_its_own.derivative, rel=1e-8)
    assert in_flight.derivative != pytest.approx(beal.sensitivity(flying, [path], time=0.0)[path].derivative, rel=1e-2)


def test_a_time_that_the_timeline_does_not_list_is_refused():
    with pytest.raises(beal.ModelError, match="timeline"):
        beal.sensitivity(catalog.beck(), time=3.0)
