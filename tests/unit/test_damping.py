"""Damping in the model, in the matrices and in what is made of them."""

import math

import numpy as np
import pytest

import beal
from beal.discretisation import discretise
from beal.errors import ModelError
from beal.motion import Release, response
from beal.motion.newmark import newmark
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.modes import converged_modes
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.study.map import stability_map
from beal.vehicle import Damping, Force, Joint, Sensor, Sine, Stage, Support, Thrust, Vehicle, catalog, dumps, loads

UNIT = {"mass_per_length": 1.0, "bending_stiffness": 1.0}
MODEL = """
[[stage]]
length = "20 m"
mass_per_length = "500 kg/m"
bending_stiffness = "2e8 N*m^2"
internal_damping = "2 ms"
external_damping = "0.3 kN*s/m^2"
[[joint]]
rotational_stiffness = 1e8
rotational_damping = "2 kN*m*s/rad"
shear_damping = "1 kN*s/m"
[[stage]]
length = 10
mass_per_length = 400
bending_stiffness = 2e8
[damping]
ratios = [0.01, "0.5 %"]
"""


def column(internal=0.0, external=0.0, **parts):
    stage = Stage(length=1.0, internal_damping=internal, external_damping=external, **UNIT)
    return Vehicle(stages=[stage], support=Support(nose="clamped"), **parts)


def jointed(**joint):
    halves = [Stage(length=x, internal_damping=0.002 * x, **UNIT) for x in (0.6, 0.4)]
    return Vehicle(stages=halves, joints=[Joint(rotational_stiffness=50.0, shear_stiffness=900.0, **joint)])


def test_damping_is_read_with_units_and_written_back():
    vehicle = loads(MODEL)
    assert (vehicle.stages[0].internal_damping, vehicle.stages[0].external_damping) == (0.002, 300.0)
    assert (vehicle.joints[0].rotational_damping, vehicle.joints[0].shear_damping) == (2000.0, 1000.0)
    assert vehicle.damping.ratios == pytest.approx((0.01, 0.005))
    assert loads(dumps(vehicle)) == vehicle
    assert not vehicle.undamped.damped


def test_every_wrong_damping_is_reported():
    wrong = MODEL.replace('"2 ms"', "-0.1").replace('"1 kN*s/m"', '"1 kN/m"').replace("[0.01,", "[-0.01,")
    with pytest.raises(ModelError) as raised:
        loads(wrong)
    assert [path for path, _ in raised.value.problems] == [
        "stage[0].internal_damping",
        "joint[0].shear_damping",
        "damping.ratios[0]",
    ]


def test_the_dashpot_of_a_rigid_joint_damps_nothing():
    halves = [Stage(length=0.5, **UNIT)] * 2
    assert not Vehicle(stages=halves, joints=[Joint(rotational_damping=1.0, shear_damping=1.0)]).damped
    assert Vehicle(stages=halves, joints=[Joint(rotational_stiffness=0.0, rotational_damping=1.0)]).damped


def test_an_undamped_vehicle_has_no_damping_matrix():
    assert discretise(catalog.tsto(0.6, 10.0, 100.0)).C is None


@pytest.mark.parametrize("basis", ["legendre", "hermite"])
@pytest.mark.parametrize("formulation", ["objective", "converged"])
def test_damping_matrix_is_the_dissipated_power_of_any_motion(basis, formulation):
    """Rates that are polynomials, so that the integrals are known: y' = x^2 in one piece, without jumps."""
    vehicle = column(internal=0.3, external=0.7)
    operators = discretise(vehicle, formulation, basis, order=6)
    stations = np.linspace(0, 1, 40)
    q = np.linalg.lstsq(operators.shape(stations), stations**2, rcond=None)[0]
    assert q @ operators.C @ q == pytest.approx(0.3 * 4 + 0.7 / 5, rel=1e-9)


def test_dashpots_dissipate_where_the_joint_moves():
    operators = discretise(jointed(rotational_damping=3.0, shear_damping=5.0), order=6)
    without = discretise(jointed(), order=6)
    aft, forward = (np.vstack([operators.shape(0.6, d, side=side) for d in (0, 1)]) for side in ("aft", "forward"))
    jump = aft - forward
    expected = 5.0 * np.outer(jump[0], jump[0]) + 3.0 * np.outer(jump[1], jump[1])
    np.testing.assert_allclose(operators.C - without.C, expected, atol=1e-6 * np.abs(expected).max())  # SNAP apart


def test_rigid_body_motion_feels_the_surroundings_alone():
    vehicle = Vehicle(stages=[Stage(length=1.0, internal_damping=0.1, external_damping=0.4, **UNIT)])
    C, M = (getattr(discretise(vehicle), name) for name in "CM")
    np.testing.assert_allclose(C[:2, :2], 0.4 * M[:2, :2], atol=1e-12)
    assert (
        not discretise(vehicle.model_copy(update={"damping": Damping(ratios=[0.1])})).C[:2, 2:].any()
        or np.abs(C[:2, 2:]).max() < 1e-12
    )


@pytest.mark.parametrize("formulation", ["as-printed", "corrected-ritz"])
def test_the_papers_formulations_refuse_damping(formulation):
    vehicle = catalog.tsto(0.6, 10.0, 100.0).model_copy(update={"damping": Damping(ratios=[0.01])})
    with pytest.raises(ModelError, match="no damping"):
        critical_thrust(vehicle, formulation=formulation)


def test_a_vehicle_without_damping_has_no_limit_of_vanishing_damping():
    with pytest.raises(ModelError, match="found none"):
        vanishing_damping_limit(catalog.beck())


def test_both_methods_and_all_events_agree():
    fast, complete = (critical_thrust(column(internal=0.01), method=method) for method in ("fast", "complete"))
    assert fast == complete
    first = critical_events(column(internal=0.01))[0]
    assert first.thrust == pytest.approx(fast.critical_thrust, rel=1e-11)
    assert (first.modes, first.unstable, first.change) == (fast.modes, 2, "destabilises")
    with pytest.raises(ModelError, match="method"):
        critical_thrust(column(internal=0.01), method="slow")


def test_divergence_does_not_notice_damping():
    vehicle = column(internal=0.02, external=1.0, thrust=Thrust(tangency=0.3))
    damped, still = critical_thrust(vehicle), critical_thrust(vehicle.undamped)
    assert (damped.kind, damped.modes) == (still.kind, still.modes) == ("divergence", (1, 1))
    assert damped.critical_thrust == pytest.approx(still.critical_thrust, rel=1e-12)
    assert vanishing_damping_limit(vehicle).critical_thrust == pytest.approx(4.05501737549, rel=1e-11)


def test_a_damped_vehicle_that_tumbles_tells_what_its_elastic_modes_bear():
    stage = Stage(length=1.0, internal_damping=0.01, **UNIT)
    found = critical_thrust(Vehicle(stages=[stage], thrust=Thrust(tangency=0.9)))
    assert (found.critical_thrust, found.rigid_body, found.modes) == (0.0, "tumbling", (0, 0))
    assert found.elastic.critical_thrust > 0
    assert found.elastic.kind in ("flutter", "divergence")


@pytest.mark.parametrize(("front", "aft", "kind"), [(0.0, 0.1, "tumbling"), (0.1, 0.0, "neutral")])
def test_a_drag_off_the_centre_of_mass_turns_a_free_vehicle(front, aft, kind):
    halves = [Stage(length=0.5, external_damping=c, **UNIT) for c in (front, aft)]
    found = critical_thrust(Vehicle(stages=halves, joints=[Joint()]))
    assert (found.rigid_body, found.modes) == (kind, (0, 0))
    assert found.critical_thrust < 1e-3


def test_a_damping_that_feeds_a_mode_at_once_leaves_no_load():
    vehicle = catalog.beal().model_copy(update={"damping": Damping(ratios=[0.0, 0.01])})
    assert vanishing_damping_limit(vehicle).critical_thrust == 0.0
    found = critical_thrust(vehicle)
    assert (found.critical_thrust, found.kind, found.modes) == (0.0, "flutter", (1, 1))


def test_spectrum_solves_the_quadratic_problem():
    operators = discretise(jointed(rotational_damping=0.1))
    found = spectrum(operators, 30.0, 4)
    for s, x in zip(found.s, found.shapes.T, strict=True):
        left = (s**2 * operators.M + s * operators.C + operators.stiffness(30.0)) @ x
        assert np.linalg.norm(left[2:]) < 1e-8 * abs(s) ** 2 * np.linalg.norm(operators.M[2:] @ x)
    assert np.all(found.growth_rate < 0)


def test_spectrum_lists_both_roots_of_an_overdamped_mode():
    found = spectrum(discretise(column(external=10.0)), 0.0, 3)  # s^2 + 10 s + 12.36 = 0
    root = math.sqrt(25 - 3.5160152685**2)
    assert found.growth_rate[:2] == pytest.approx([root - 5, -root - 5], rel=1e-9)
    assert found.angular_frequency == pytest.approx([0.0, 0.0, math.sqrt(22.03449156**2 - 25)], abs=1e-8)


def test_modes_converge_with_damping():
    found, error = converged_modes(column(internal=0.01), 10.0, 3)
    assert error.max() < 1e-6
    finer = spectrum(discretise(column(internal=0.01), order=24), 10.0, 3)
    assert found.growth_rate == pytest.approx(finer.growth_rate, rel=1e-7)


def test_a_curve_follows_the_damped_roots_into_flutter():
    vehicle = column(internal=0.01)
    critical = critical_thrust(vehicle).critical_thrust
    curve = thrust_curve(vehicle, to=2 * critical, points=3, modes=2)
    assert curve.growth_rate[1, 0] == pytest.approx(0.0, abs=1e-9)
    assert curve.growth_rate[2, 0] > 0 > curve.growth_rate[2, 1]


def test_a_curve_follows_a_mode_through_two_real_roots_into_divergence():
    curve = thrust_curve(column(external=1.0, thrust=Thrust(tangency=0.2)), to=4.0, points=81, modes=2)
    diverged = curve.thrust > 3.32506684487
    assert np.all(curve.growth_rate[diverged, 0] > 0)
    assert np.all(curve.growth_rate[~diverged, 0] < 0)


def test_maps_solve_damped_vehicles_one_by_one():
    values = {"joint[0].rotational_stiffness": [20.0, 50.0], "joint[0].shear_stiffness": np.linspace(600.0, 900.0, 8)}
    chart = stability_map(jointed(), values)
    assert set(np.unique(chart["method"])) == {chart["method"].attrs["flag_values"][-1]}
    assert float(chart["critical_thrust"][1, -1]) == pytest.approx(critical_thrust(jointed()).critical_thrust, rel=1e-6)
    assert chart["mode_low"].equals(chart["mode_high"])


def test_a_map_may_go_from_no_damping_to_some():
    chart = stability_map(column(), {"stage[0].internal_damping": [0.0, 1e-3]})
    assert chart["critical_thrust"].values == pytest.approx([20.05095, 10.93912], rel=1e-6)


@pytest.mark.filterwarnings("ignore::beal.motion.steps.AliasingWarning")
def test_work_of_thrust_damping_and_force_is_the_change_of_energy_in_every_step():
    """With constant mean acceleration, whatever the step: midpoint work is exact for it."""
    force = Force(station=1.0, signal=Sine(kind="sine", amplitude=0.3, angular_frequency=4.0))
    vehicle = jointed(rotational_damping=0.1).model_copy(
        update={"forces": (force,), "sensors": (Sensor(name="imu", station=0.1),)}
    )
    operators = discretise(vehicle, order=4)
    every = len(operators.M) - operators.rigid
    motion = response(operators, 3.0, 40.0, step=0.003, initial=Release(0.01), modes=every)
    q, rate = motion.coordinates, motion.coordinate_rates
    energy = np.einsum("ki,ij,kj->k", rate, operators.M, rate) + np.einsum("ki,ij,kj->k", q, operators.K0, q)
    step, mean, speed = np.diff(q, axis=0), (q[1:] + q[:-1]) / 2, (rate[1:] + rate[:-1]) / 2
    push = 0.3 * np.sin(4.0 * motion.time)
    loads = np.outer((push[1:] + push[:-1]) / 2, operators.shape(1.0)[0])
    work = np.einsum("ki,ki->k", step, loads - speed @ operators.C.T - 40.0 * mean @ operators.K1.T)
    np.testing.assert_allclose(np.diff(energy) / 2, work, atol=1e-9 * energy.max())


def test_newmark_converges_to_the_exact_response_of_a_damped_vehicle():
    vehicle = column(internal=0.01, external=0.5, sensors=(Sensor(name="tip", station=1.0),))
    errors = []
    for step in (4e-3, 2e-3, 1e-3):
        truth, motion = (
            response(vehicle, 1.0, 8.0, step=step, method=method, initial=Release(0.01, 1.0), modes=3)
            for method in ("exact", "newmark")
        )
        errors.append(np.linalg.norm(motion.displacement - truth.displacement) * math.sqrt(step))
    assert [math.log2(a / b) for a, b in zip(errors, errors[1:], strict=False)] == pytest.approx([2, 2], abs=0.1)


@pytest.mark.filterwarnings("ignore::beal.motion.steps.AliasingWarning")
def test_a_damped_response_decays_as_the_spectrum_says():
    vehicle = column(internal=0.01, sensors=(Sensor(name="tip", station=1.0),))
    found = spectrum(discretise(vehicle), 5.0, 1)
    period = 2 * math.pi / found.angular_frequency[0]
    motion = response(vehicle, 20 * period, 5.0, step=period, method="exact", initial=Release(0.01, 1.0))
    late = motion.displacement[0, 10:]  # once the higher modes have died out
    assert late[1:] / late[:-1] == pytest.approx(math.exp(found.growth_rate[0] * period), rel=1e-6)


def test_newmark_damps_an_oscillator():
    start = np.array([1.0]), np.array([0.0])
    loads, damping = np.zeros((2001, 1)), np.array([[0.4]])
    q, _, _ = newmark(np.eye(1), np.array([[4.0]]), loads, start, step=2e-3, damping=damping)
    omega, t = math.sqrt(4 - 0.04), 4.0
    expected = math.exp(-0.2 * t) * (math.cos(omega * t) + 0.2 / omega * math.sin(omega * t))
    assert q[-1, 0] == pytest.approx(expected, abs=1e-5)


def test_the_limit_is_part_of_the_public_list():
    assert beal.vanishing_damping_limit is vanishing_damping_limit
