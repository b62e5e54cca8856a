"""Damped columns and jointed beams: values on which exact transfer matrices and finite elements agree.

Tolerances are the digits given: all to 1e-10 of the value, the last of some being those of finite elements.
"""

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
from beal.vehicle import Damping, Joint, PointMass, Stage, Support, Thrust, Vehicle, catalog

DIGITS = 1e-10
NINE = 2e-9  # where nine digits are given
UNIT = {"mass_per_length": 1.0, "bending_stiffness": 1.0}


def column(internal=0.0, external=0.0, mass=0.0, tangency=1.0):
    return Vehicle(
        stages=[Stage(length=1.0, internal_damping=internal, external_damping=external, **UNIT)],
        point_masses=[PointMass(station=1.0, mass=mass)] if mass else [],
        support=Support(nose="clamped"),
        thrust=Thrust(tangency=tangency),
    )


def jointed(station, internal=0.0, **joint):
    halves = [Stage(length=x, internal_damping=internal, **UNIT) for x in (station, 1 - station)]
    return Vehicle(stages=halves, joints=[Joint(**joint)])


def hinged(station, stiffness, internal, damping):
    return jointed(station, internal, rotational_stiffness=stiffness, rotational_damping=damping)


def assert_flutters(vehicle, thrust, omega, digits=DIGITS, limit=False):
    found = vanishing_damping_limit(vehicle) if limit else critical_thrust(vehicle)
    assert found.kind == "flutter"
    assert found.critical_thrust == pytest.approx(thrust, rel=digits)
    assert found.angular_frequency == pytest.approx(omega, rel=digits)
    assert abs(found.critical_thrust - thrust) < found.error_estimate + digits * thrust


@pytest.mark.parametrize(
    ("internal", "external", "thrust", "omega"),
    [
        (1e-4, 0.0, 10.9388520721, 5.398613937228),
        (1e-3, 0.0, 10.93912199698, 5.398624783601),
        (0.005, 0.0, 10.945665459, 5.398887706941),
        (0.01, 0.0, 10.96611165947, 5.399709107125),
        (0.02, 0.0, 11.04786449167, 5.402991156265),
        (0.05, 0.0, 11.61873610921, 5.42580985753),
        (0.1, 0.0, 13.6393176099, 5.50525777434),
        (0.2, 0.0, 21.51013537701, 5.798541273015),
        (0.0, 0.1, 20.05148217776, 11.01540038453),
        (0.0, 1.0, 20.10368483253, 10.9998564319),
        (0.0, 5.0, 21.29674511226, 10.63751647547),
        (0.0, 20.0, 30.13821341618, 7.325646523015),
        (0.001, 0.1, 17.5501075086, 7.809990484701),
        (0.01, 1.0, 17.79406486219, 7.782337374336),
        (0.02, 2.0, 18.51610192857, 7.699308027545),
    ],
)
def test_becks_column_with_internal_and_external_damping(internal, external, thrust, omega):
    assert_flutters(column(internal, external), thrust, omega)


@pytest.mark.parametrize(
    ("vehicle", "thrust", "omega"),
    [
        (hinged(0.75, 5.0, 1e-4, 0.0), 47.8040495228, 18.14016833),
        (hinged(0.75, 5.0, 1e-3, 0.005), 45.359131156, 17.5097692853),
        (hinged(0.75, 10.0, 1e-3, 0.1), 47.4890190666, 16.2063590505),
        (hinged(0.75, 20.0, 1e-3, 0.02), 71.0978348932, 15.1987012931),
        (hinged(0.75, 100.0, 1e-3, 0.1), 84.3212214035, 12.6673304853),
        (hinged(0.25, 5.0, 1e-2, 0.05), 83.8877542747, 7.19206861766),
        (hinged(0.25, 100.0, 1e-3, 0.1), 87.7955777444, 11.6109662383),
        (hinged(0.5, 20.0, 1e-2, 0.2), 90.106719889, 3.37149452534),
        (hinged(0.5, 100.0, 1e-2, 1.0), 89.810392317, 9.98423981524),
        (jointed(0.5, 1e-3, shear_stiffness=100.0, shear_damping=0.1), 52.7804503216, 16.7576018599),
        (jointed(0.5, 1e-3, shear_stiffness=1e3, shear_damping=1.0), 81.2478882784, 12.817543573),
    ],
)
def test_viscoelastic_beams_on_a_viscoelastic_joint(vehicle, thrust, omega):
    """The class of vehicles of Mladenov & Sugiyama (1997)."""
    assert_flutters(vehicle, thrust, omega)


@pytest.mark.parametrize(("station", "thrust", "omega"), [(0.75, 37.7625673832, 16.8701651616), (0.25, None, None)])
@pytest.mark.parametrize(("stiffness", "damping"), [(30.0, 1.0), (30.0, 1e-3), (300.0, 1.0)])
def test_a_dashpot_in_the_joint_alone_gives_one_load_whatever_joint_and_dashpot(
    station, thrust, omega, stiffness, damping
):
    """A root i omega at all stiffnesses k + i omega c is one of the rigid and of the hinged beam at once."""
    vehicle = hinged(station, stiffness, 0.0, damping)
    if thrust is None:
        thrust, omega = 96.680075518826, 12.975176596149  # where the two undamped beams' frequencies meet
    assert_flutters(vehicle, thrust, omega)
    assert_flutters(vehicle, thrust, omega, limit=True)


@pytest.mark.parametrize(
    ("vehicle", "thrust", "omega"),
    [
        (column(internal=0.3), 10.938849345588, 5.3986138276688),
        (column(internal=1.0, external=10.0), 12.88176102716, 5.92253885),
        (column(internal=0.01, external=1.0), 17.5476286924, 7.81027044),
        (column(internal=1.0, external=1000.0), 19.90111812581, 10.1865348),
        (column(internal=1.0, tangency=0.6), 9.378831982011, 2.610127965411),
        (column(internal=1.0, tangency=0.8), 9.527962726592, 4.21377039267),
        (column(internal=1.0, mass=0.1), 9.541813193013, 4.551275377373),
        (column(internal=1.0, mass=1.0), 7.905071679219, 2.387238534226),
        (column(external=1.0, mass=0.1), 17.4537613673, 10.2145158162),
        (column(external=1.0, mass=1.0), 16.1215533151, 5.72611441924),
        (Vehicle(stages=[Stage(length=1.0, internal_damping=1.0, **UNIT)]), 88.152630180421, 11.723908214379),
    ],
)
def test_limit_of_vanishing_damping(vehicle, thrust, omega):
    """Kelvin-Voigt damping alone, with a ratio of external damping, and external damping beside a tip mass."""
    assert_flutters(vehicle, thrust, omega, digits=NINE, limit=True)


def test_vanishing_external_damping_leaves_becks_column_alone():
    assert vanishing_damping_limit(column(external=3.0)) == critical_thrust(
        catalog.beck().model_copy(update={"thrust": Thrust()})
    )


def test_a_small_damping_comes_close_to_the_limit():
    limit = vanishing_damping_limit(column(internal=1.0)).critical_thrust
    distance = [critical_thrust(column(internal=tau)).critical_thrust - limit for tau in (1e-2, 1e-3)]
    assert distance[0] / distance[1] == pytest.approx(100.0, rel=1e-3)  # quadratic in the damping
    assert critical_thrust(column(internal=1e-9)).critical_thrust == pytest.approx(limit, rel=1e-11)


@pytest.mark.parametrize(("first", "second"), [(0.1, 0.1), (0.1, 0.01), (0.01, 0.1), (0.5, 0.5)])
def test_zieglers_pendulum(first, second):
    """Herrmann & Jong (1965): masses 2:1, (4 b^2 + 33 b + 4)/(2 (b + 1)(b + 6)) + B1 B2/2 with b = B1/B2, exactly."""
    M, C = np.array([[3.0, 1.0], [1.0, 1.0]]), np.array([[first + second, -second], [-second, second]])
    K0, K1 = np.array([[2.0, -1.0], [-1.0, 1.0]]), np.array([[-1.0, 1.0], [0.0, 0.0]])
    undamped = Pencil(K0, K1, M, 0, 0.1).projected(np.eye(2))
    damped = Pencil(K0, K1, M, 0, 0.1, C).projected(np.eye(2))
    b = first / second
    limit = (4 * b**2 + 33 * b + 4) / (2 * (b + 1) * (b + 6))
    event = damped_events(damped, undamped, limit=3.0, watched=2)[0]
    assert (event.kind, event.before, event.unstable) == ("flutter", 0, 2)
    assert event.thrust == pytest.approx(limit + first * second / 2, rel=1e-13)
    assert crossings(damped, 3.0, vanishing=True) == pytest.approx([limit], rel=1e-12)


@pytest.mark.parametrize("vehicle", [column(0.01, 1.0), hinged(0.75, 10.0, 1e-3, 0.1)])
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
