"""The growth of energy below the critical thrust: closed forms, a time simulation, and its bounds."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from beal.discretisation import discretise
from beal.errors import ModelError
from beal.motion import State, TransientGrowth, response, transient_growth
from beal.vehicle import Damping, Sensor, catalog

SENSOR = Sensor(name="imu", station=0.12)
CRITICAL = 106.437231  # theory.md, section 9


def tsto():
    return catalog.tsto(0.6, 5000.0, 5000.0)


def energy(operators, motion):
    q, rate = motion.coordinates, motion.coordinate_rates
    return (np.einsum("ki,ij,kj->k", rate, operators.M, rate) + np.einsum("ki,ij,kj->k", q, operators.K0, q)) / 2


@pytest.mark.parametrize("vehicle", [catalog.beck(), tsto(), catalog.beal()])
@pytest.mark.parametrize("ratio", [0.0, 0.02])
def test_energy_does_not_grow_without_thrust(vehicle, ratio):
    """The modes are orthogonal in energy: a normal system."""
    found = transient_growth(vehicle.model_copy(update={"damping": Damping(ratios=[ratio])}), 0.0)
    assert found.growth == pytest.approx(1.0, abs=1e-9)
    assert found.history.max() == pytest.approx(1.0, abs=1e-9)
    assert found.lower_bound == pytest.approx(1.0, abs=1e-6)
    assert found.upper_bound < 1.1


@pytest.mark.parametrize(("thrust", "ratio"), [(30.0, 0.0), (90.0, 0.0), (105.0, 0.0), (30.0, 0.01), (80.0, 0.01)])
def test_a_simulation_from_the_worst_start_reaches_the_growth_and_no_other_start_does(thrust, ratio):
    operators = discretise(tsto().model_copy(update={"damping": Damping(ratios=[ratio])}))
    found = transient_growth(operators, thrust)
    options = {"method": "exact", "step": found.instant / 400, "rigid_body": False}
    motion = response(operators, found.instant, thrust, initial=found.initial, **options)
    assert energy(operators, motion)[[0, -1]] == pytest.approx([1.0, found.growth], rel=1e-8)
    assert energy(operators, motion).max() <= found.growth * (1 + 1e-9)
    rng = np.random.default_rng(1)
    for _ in range(10):
        q, rate = found.initial.q * (1 + 1e-3 * rng.normal(size=len(operators.M))), found.initial.q_rate
        other = response(operators, found.instant, thrust, initial=State(q, rate), **options)
        growth = energy(operators, other)[-1] / energy(operators, other)[0]
        assert growth < found.growth
        assert growth == pytest.approx(found.growth, rel=1e-3)  # a maximum is flat


@pytest.mark.parametrize("thrust", [50.0, 90.0, 106.0, 106.43])
def test_growth_lies_between_its_bounds(thrust):
    found = transient_growth(tsto(), thrust)
    assert 1.0 < found.lower_bound < found.growth < found.upper_bound
    assert found.growth >= found.history.max() * (1 - 1e-12)


def test_growth_rises_as_one_over_the_distance_from_flutter():
    """Two modes that merge at a distance d have frequencies sqrt(d) apart and eigenvectors as close."""
    distances = np.array([0.04, 0.02, 0.01])
    products = [transient_growth(tsto(), CRITICAL - d).growth * d for d in distances]
    assert products == pytest.approx([np.mean(products)] * 3, rel=0.05)


def test_growth_of_two_modes_is_the_largest_over_all_times_and_starts():
    """Beck's column in two modes: exp(S t) sampled a hundred times as closely, over starts all around."""
    found = transient_growth(catalog.beck(), 15.0, modes=2)
    times = np.linspace(0.0, found.time[-1], 20001)
    step, motion, largest = expm(found.matrix * times[1]), np.eye(4), 1.0
    rng = np.random.default_rng(2)
    starts = rng.normal(size=(4, 4000))
    starts /= np.linalg.norm(starts, axis=0)
    for _ in times[1:]:
        motion = step @ motion
        largest = max(largest, np.abs(np.linalg.eigvalsh(motion.T @ motion)).max())
    assert found.growth == pytest.approx(largest, rel=1e-5)
    assert found.growth >= largest * (1 - 1e-12)
    sampled = (np.linalg.norm(expm(found.matrix * found.instant) @ starts, axis=0) ** 2).max()
    assert 0.9 * found.growth < sampled <= found.growth


def test_the_resolvent_has_the_norm_of_the_inverse():
    """Resolvent by inversion, not by singular values."""
    found = transient_growth(catalog.beck(), 15.0, modes=3)
    for s in (1.0 + 5.0j, -2.0 + 12.0j, 0.01 + 7.9j):
        inverse = np.linalg.inv(s * np.eye(6) - found.matrix)
        assert float(found.resolvent_norm(s)) == pytest.approx(np.linalg.norm(inverse, 2), rel=1e-10)
    assert found.resolvent_norm([[1.0, 2j]]).shape == (1, 2)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"thrust": -1.0}, "thrust: must be finite and not negative, found -1.0"),
        ({"thrust": math.nan}, "thrust: must be finite and not negative, found nan"),
        ({"thrust": 21.0}, r"thrust: must lie below the critical one, found 21, where motions grow as exp\("),
        ({"thrust": 10.0, "modes": 0}, "modes: must be at least 1, found 0"),
        ({"thrust": 10.0, "duration": 0.0}, "duration: must be positive and finite, found 0.0"),
    ],
)
def test_transient_growth_refuses(options, message):
    with pytest.raises(ModelError, match=message):
        transient_growth(catalog.beck(), **options)


def test_a_state_belongs_to_its_operators():
    found = transient_growth(discretise(catalog.beck(), order=8), 5.0)
    column = discretise(catalog.beck().model_copy(update={"sensors": (SENSOR,)}), order=12)
    with pytest.raises(ModelError, match=r"initial: needs .* coordinates and as many rates, found"):
        response(column, 1.0, 5.0, initial=found.initial)


def test_a_given_time_span_is_kept():
    found = transient_growth(catalog.beck(), 15.0, duration=0.3)
    assert isinstance(found, TransientGrowth)
    assert (found.time[-1], found.instant <= 0.3) == (0.3, True)
    assert found.growth < transient_growth(catalog.beck(), 15.0).growth
