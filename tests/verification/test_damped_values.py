"""Damped columns and jointed beams, beyond the known answers: laws, limits and every change of stability."""

import math

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.damped import crossings, damped_events
from beal.stability.damped_roots import damped_roots
from beal.stability.pencil import Pencil, pencil, reduced
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.vehicle import Damping, Joint, Stage, Support, Vehicle, catalog
from beal.verification.closed_forms import herrmann_jong
from verification.known import frequency, thrust

DIGITS = 1e-10
DAMPED = [
    catalog.beck_damped(0.01, 1.0),
    catalog.mladenov_sugiyama(0.75, 10.0, internal_damping=1e-3, rotational_damping=0.1),
]


@pytest.mark.parametrize("station", [0.75, 0.25])
@pytest.mark.parametrize(("stiffness", "damping"), [(30.0, 1e-3), (300.0, 1.0)])
def test_a_dashpot_in_the_joint_alone_gives_one_load_whatever_joint_and_dashpot(station, stiffness, damping):
    """A root i omega at all stiffnesses k + i omega c is one of the rigid and of the hinged beam at once."""
    vehicle = catalog.mladenov_sugiyama(station, stiffness, rotational_damping=damping)
    name = f"mladenov_sugiyama({station}, 30.0, internal_damping=0.0, rotational_damping=1.0)"
    for found in (critical_thrust(vehicle), vanishing_damping_limit(vehicle)):
        assert found.kind == "flutter"
        assert found.critical_thrust == pytest.approx(thrust(name), rel=DIGITS)
        assert found.angular_frequency == pytest.approx(frequency(name), rel=DIGITS)


def test_vanishing_external_damping_leaves_becks_column_alone():
    assert vanishing_damping_limit(catalog.beck_damped(external_damping=3.0)) == critical_thrust(catalog.beck())


def test_a_small_damping_comes_close_to_the_limit():
    limit = vanishing_damping_limit(catalog.beck_damped(1.0)).critical_thrust
    distance = [critical_thrust(catalog.beck_damped(tau)).critical_thrust - limit for tau in (1e-2, 1e-3)]
    assert distance[0] / distance[1] == pytest.approx(100.0, rel=1e-3)  # quadratic in the damping
    assert critical_thrust(catalog.beck_damped(1e-9)).critical_thrust == pytest.approx(limit, rel=1e-11)


@pytest.mark.parametrize(("first", "second"), [(0.1, 0.1), (0.1, 0.01), (0.01, 0.1), (0.5, 0.5)])
def test_zieglers_pendulum(first, second):
    """The matrices of its two angles, without a beam."""
    M, C = np.array([[3.0, 1.0], [1.0, 1.0]]), np.array([[first + second, -second], [-second, second]])
    K0, K1 = np.array([[2.0, -1.0], [-1.0, 1.0]]), np.array([[-1.0, 1.0], [0.0, 0.0]])
    undamped = Pencil(K0, K1, M, 0, 0.1).projected(np.eye(2))
    damped = Pencil(K0, K1, M, 0, 0.1, C).projected(np.eye(2))
    exact, _ = herrmann_jong(first, second)
    event = damped_events(damped, undamped, limit=3.0, watched=2)[0]
    assert (event.kind, event.before, event.unstable) == ("flutter", 0, 2)
    assert event.thrust == pytest.approx(exact, rel=1e-13)
    assert crossings(damped, 3.0, vanishing=True) == pytest.approx([exact - first * second / 2], rel=1e-12)


@pytest.mark.parametrize("vehicle", DAMPED)
def test_finite_elements_agree(vehicle):
    exact, elements = critical_thrust(vehicle), critical_thrust(vehicle, basis="hermite")
    assert elements.critical_thrust == pytest.approx(exact.critical_thrust, rel=1e-6)
    assert abs(elements.critical_thrust - exact.critical_thrust) < elements.error_estimate


def test_damping_ratios_are_those_of_the_unloaded_modes():
    vehicle = catalog.tsto(0.6, 50.0, 500.0).model_copy(update={"damping": Damping(ratios=[0.02, 0.1, 0.03])})
    still, damped = (spectrum(discretise(v, order=16), 0.0, 5) for v in (vehicle.undamped, vehicle))
    assert -damped.growth_rate / still.angular_frequency == pytest.approx([0.02, 0.1, 0.03, 0.03, 0.03], rel=1e-9)
    assert np.hypot(damped.growth_rate, damped.angular_frequency) == pytest.approx(still.angular_frequency, rel=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_every_change_of_stability_is_one_of_a_fine_sweep(seed):
    rng = np.random.default_rng(seed)
    stages = [
        Stage(
            length=rng.uniform(0.2, 0.6),
            mass_per_length=10 ** rng.uniform(-0.3, 0.3),
            bending_stiffness=10 ** rng.uniform(-0.3, 0.3),
            internal_damping=10 ** rng.uniform(-4, -2) * (rng.random() < 0.7),
            external_damping=10 ** rng.uniform(-1, 1) * (rng.random() < 0.5),
        )
        for _ in range(2)
    ]
    joint = Joint(
        rotational_stiffness=10 ** rng.uniform(0, 3),
        shear_stiffness=10 ** rng.uniform(2, 4),
        rotational_damping=10 ** rng.uniform(-3, 0),
    )
    vehicle = Vehicle(stages=stages, joints=[joint], support=Support(nose="clamped" if seed % 2 else "pinned"))
    limit = 150.0
    full = reduced(pencil(discretise(vehicle, order=8)), 14)
    top = math.sqrt(np.sort(full.roots(0.0).real)[10])
    found = critical_events(vehicle, limit)

    def unstable(thrust):
        s = damped_roots(full, thrust)
        return int(np.sum((np.abs(s) > 1e-5) & (np.abs(s) < top) & (s.real > 1e-9 * np.abs(s))))

    edges = [0.0, *(event.thrust for event in found), limit]
    expected = [*(event.before for event in found), found[-1].unstable if found else 0]
    for low, high, count in zip(edges, edges[1:], expected, strict=False):
        inside = np.linspace(low, high, 60)[1:-1]  # the sweep's modes are not as converged as the events
        assert {unstable(thrust) for thrust in inside[(inside > low * 1.001) & (inside < high * 0.999)]} <= {count}
