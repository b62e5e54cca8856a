"""Floquet's multipliers against exact and independently computed values, and against integration in time.

The edges of the tongues are of Hill's determinants of full finite elements, confirmed by Magnus's method with 16 modes,
and are known to the digits given.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

import beal
from beal.discretisation import discretise
from beal.stability.periodic import monodromy, pulsating_equations
from beal.stability.resonances import resonances
from beal.vehicle import Joint, Stage, Support, Thrust, Vehicle, catalog

PINNED = Vehicle(
    units="nondimensional",
    stages=[Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)],
    support=Support(nose="pinned", tail="pinned"),
    thrust=Thrust(tangency=0.0),
)
EDGES = {  # vehicle, P0, P1, tongue: its edges
    ("beck", 0.0, 0.5, "2 w1"): ("6.97239364", "7.09446950"),
    ("beck", 0.0, 0.5, "2 w2"): ("43.91766821", "44.21935699"),
    ("beck", 0.0, 0.5, "w2 - w1"): ("18.3848363", "18.6512899"),
    ("beck", 0.0, 1.0, "2 w1"): ("6.9154812", "7.1598023"),
    ("beck", 0.0, 1.0, "2 w2"): ("43.76534943", "44.36884149"),
    ("beck", 0.0, 1.0, "w2 - w1"): ("18.2504249", "18.7832089"),
    ("beck", 5.0, 0.5, "2 w1"): ("8.3569766", "8.5186292"),
    ("beck", 5.0, 0.5, "2 w2"): ("40.69987672", "41.04066295"),
    ("beck", 5.0, 0.5, "w2 - w1"): ("16.0660242", "16.3683820"),
    ("beck", 5.0, 1.0, "2 w1"): ("8.283131", "8.607055"),
    ("beck", 5.0, 1.0, "2 w2"): ("40.52576595", "41.20851823"),
    ("beck", 5.0, 1.0, "w2 - w1"): ("15.9126203", "16.5173059"),
    ("beck", 15.0, 0.5, "2 w1"): ("13.06157375", "13.43974796"),
    ("beck", 15.0, 0.5, "2 w2"): ("32.24203919", "32.79202378"),
    ("beck", 15.0, 0.5, "w2 - w1"): ("9.3825986", "9.8824196"),
    ("beck", 15.0, 1.0, "2 w1"): ("12.8558975", "13.6191424"),
    ("beck", 15.0, 1.0, "2 w2"): ("31.95875901", "33.05950347"),
    ("beck", 15.0, 1.0, "w2 - w1"): ("9.1324123", "10.1336727"),
    ("beal", 0.0, 2.0, "2 w1"): ("44.46909026", "45.01938927"),
    ("beal", 0.0, 2.0, "2 w2"): ("122.97159439", "123.71826427"),
    ("beal", 0.0, 2.0, "w2 - w1"): ("39.1465318", "39.4585856"),
    ("beal", 0.0, 5.0, "2 w1"): ("44.040593", "45.422130"),
    ("beal", 0.0, 5.0, "2 w2"): ("122.4079166", "124.2744021"),
    ("beal", 0.0, 5.0, "w2 - w1"): ("38.9259739", "39.7116016"),
    ("beal", 20.0, 2.0, "2 w1"): ("38.68131047", "39.33623723"),
    ("beal", 20.0, 2.0, "2 w2"): ("115.14180970", "115.95756915"),
    ("beal", 80.0, 2.0, "2 w1"): ("23.2276380", "23.3661276"),
    ("beal", 80.0, 2.0, "2 w2"): ("84.52452109", "85.88005690"),
    ("beal", 80.0, 2.0, "w2 - w1"): ("30.3525569", "31.5809443"),
}
UNIFORM = {"beck": catalog.beck(), "beal": catalog.beal()}


def unstable(equations, amplitude, omega):
    transition, _ = monodromy(equations, np.array([amplitude]), omega, 1e-11)
    return np.abs(np.linalg.eigvals(transition[0])).max() > equations.neutral


def assert_edges(equations, amplitude, texts, digits=1.0):
    """Unstable just inside and stable just outside of both, by a unit of their last digit."""
    for text, inward in zip(texts, (1, -1), strict=True):
        last = digits * 10.0 ** -len(text.partition(".")[2])
        assert unstable(equations, amplitude, float(text) + inward * last)
        assert not unstable(equations, amplitude, float(text) - inward * last)


@pytest.mark.parametrize(("vehicle", "thrust", "amplitude", "name"), EDGES)
def test_edges_of_tongues(vehicle, thrust, amplitude, name):
    modes = 14 if name == "2 w2" else 8  # the higher the tongue, the more modes have a say in its last digits
    equations = pulsating_equations(discretise(UNIFORM[vehicle], order=2 * modes + 8), thrust, modes)
    assert name in [found.name for found in resonances(equations)]
    assert_edges(equations, amplitude, EDGES[vehicle, thrust, amplitude, name])


def test_edges_of_a_damped_column():
    column = Vehicle(
        units="nondimensional",
        stages=[Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0, external_damping=0.1)],
        support=Support(nose="clamped"),
    )
    equations = pulsating_equations(discretise(column, order=24), 5.0, 8)
    assert_edges(equations, 1.0, ("8.3171955", "8.5718328"), digits=50.0)  # in 10 modes, which leave an error of 4e-6
    assert_edges(equations, 1.0, ("8.317193", "8.571831"))  # by Magnus's method in all coordinates


@pytest.mark.parametrize(
    ("amplitude", "texts"),
    [
        (1.0, ("19.23615497630", "20.23595305805")),
        (2.0, ("18.72755391716", "20.72590453379")),
        (4.0, ("17.69876728825", "21.68446312538")),
    ],
)
def test_a_pinned_column_under_dead_load_is_mathieus_equation(amplitude, texts):
    def from_mathieu(characteristic, omega):  # x'' + (a - 2 q cos 2t) x = 0 with 2t = Omega t
        return characteristic(1, 2 * amplitude * math.pi**2 / omega**2) - 4 * math.pi**4 / omega**2

    edges = [brentq(lambda w, f=f: from_mathieu(f, w), 15.0, 25.0, xtol=1e-13) for f in (mathieu_a, mathieu_b)]
    assert sorted(edges) == pytest.approx([float(text) for text in texts], abs=1e-10)
    equations = pulsating_equations(discretise(PINNED, order=24), 0.0, 8)
    assert_edges(equations, amplitude, texts, digits=100.0)  # 1e-9: growth below a millionth counts as none


def test_multipliers_of_hills_equations():
    """Each mode n of the pinned column by itself: q'' + (n^4 pi^4 - n^2 pi^2 P1 cos(Omega t)) q = 0."""
    amplitude, omega = 4.0, 18.5
    found = beal.floquet(PINNED, 0.0, amplitude, omega).multipliers
    period = 2 * math.pi / omega
    expected = []
    for n in (1, 2, 3):
        stiff, load = (n * math.pi) ** 4, (n * math.pi) ** 2

        def motion(t, y, stiff=stiff, load=load):
            return [y[1], -(stiff - load * amplitude * math.cos(omega * t)) * y[0]]

        columns = [
            solve_ivp(motion, (0.0, period), y, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
            for y in ([1.0, 0.0], [0.0, 1.0])
        ]
        expected += np.linalg.eigvals(np.transpose(columns)).tolist()
    assert max(np.abs(found - value).min() for value in expected) < 1e-8


@pytest.mark.parametrize("name", UNIFORM)
def test_the_difference_combination_resonates_and_the_sum_does_not(name):
    vehicle = UNIFORM[name]
    first, second = beal.spectrum(discretise(vehicle, order=24), 5.0, 2).angular_frequency
    apart, together = (beal.floquet(vehicle, 5.0, 1.0, omega) for omega in (second - first, second + first))
    assert (apart.stable, together.stable) == (False, True)
    assert apart.resonance.name == "w2 - w1"


def test_the_product_of_the_multipliers_of_an_undamped_vehicle_is_1():
    for omega in (12.0, 30.0, 100.0):
        found = beal.floquet(catalog.tsto(0.6, 5000.0, 5000.0), 50.0, 20.0, omega)
        assert np.prod(found.multipliers) == pytest.approx(1.0, abs=1e-10)
        inverse = 1 / found.multipliers
        assert max(np.abs(found.multipliers - value).min() for value in inverse) < 1e-8


def by_magnus(operators, thrust, amplitude, omega, steps=600):
    """The monodromy matrix of all coordinates by Magnus's method of fourth order."""
    M, size = operators.M, len(operators.M)
    scale = math.sqrt(operators.vehicle.scales.angular_frequency * 1e3)
    damping = np.zeros_like(M) if operators.C is None else np.linalg.solve(M, operators.C)
    h = 2 * math.pi / (omega * steps)

    def generator(t):
        stiffness = operators.stiffness(thrust + amplitude * math.cos(omega * t))
        return np.block([[np.zeros_like(M), scale * np.eye(size)], [-np.linalg.solve(M, stiffness) / scale, -damping]])

    result = np.eye(2 * size)
    for n in range(steps):
        a, b = (generator(h * (n + 0.5 + sign * math.sqrt(3) / 6)) for sign in (-1, 1))
        result = expm(h / 2 * (a + b) + math.sqrt(3) / 12 * h**2 * (b @ a - a @ b)) @ result
    return result


def uniform(**damping):
    return Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0, **damping)


FLEXIBLE = Joint(rotational_stiffness=100.0, shear_stiffness=500.0)
DAMPED = {
    "internal": ([uniform(internal_damping=0.01)] * 2, FLEXIBLE),
    "external": ([uniform(external_damping=0.5), uniform()], FLEXIBLE),
    "joint": ([uniform()] * 2, FLEXIBLE.model_copy(update={"rotational_damping": 1.0, "shear_damping": 3.0})),
}


@pytest.mark.parametrize("name", DAMPED)
def test_multipliers_of_damped_vehicles_are_those_of_all_coordinates(name):
    stages, joint = DAMPED[name]
    vehicle = Vehicle(units="nondimensional", stages=stages, joints=[joint], support=Support(nose="clamped"))
    operators = discretise(vehicle, order=10)
    for omega in (4.0, 8.2, 17.0):
        found = beal.floquet(vehicle, 5.0, 2.0, omega)
        largest = np.abs(np.linalg.eigvals(by_magnus(operators, 5.0, 2.0, omega))).max()
        assert found.largest_modulus == pytest.approx(largest, abs=1e-7)
        assert abs(found.largest_modulus - largest) <= 2 * found.error_estimate + 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_a_simulation_grows_at_the_rate_that_the_multipliers_tell(seed):
    rng = np.random.default_rng(seed)
    vehicle = catalog.tsto(rng.uniform(0.3, 0.7), *(10 ** rng.uniform(2.0, 4.0, 2)))
    if seed % 2:
        joint = vehicle.joints[0].model_copy(update={"rotational_damping": 0.02})
        vehicle = vehicle.model_copy(update={"joints": (joint,)})
    thrust, amplitude = rng.uniform(10.0, 30.0), rng.uniform(8.0, 15.0)
    operators = discretise(vehicle, order=8)
    first, second = beal.spectrum(operators, thrust, 2).angular_frequency
    omega = float((2 * first, second - first, 2 * second)[seed % 3]) * (1 + 0.005 * rng.uniform(-1, 1))
    found = beal.floquet(vehicle, thrust, amplitude, omega)
    transition = by_magnus(operators, thrust, amplitude, omega)
    elastic = np.r_[operators.rigid : len(operators.M)]
    elastic = np.r_[elastic, elastic + len(operators.M)]  # rigid-body motions only follow, and drift
    transition = transition[np.ix_(elastic, elastic)]
    state, growth = rng.normal(size=len(elastic)), []
    for _ in range(400):
        state = transition @ state
        growth.append(math.log(np.linalg.norm(state)))
        state /= np.linalg.norm(state)
    assert not found.stable
    assert np.mean(growth[200:]) * omega / (2 * math.pi) == pytest.approx(found.growth_rate, rel=0.01)
