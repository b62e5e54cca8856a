"""Damped vehicles by sparse matrices and a reduction, against columns of one piece and against dense matrices."""

import math

import numpy as np
import pytest

from beal.stability import critical, modes, vanishing
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.large import is_large
from beal.stability.modes import converged_modes
from beal.stability.vanishing import vanishing_damping_limit
from beal.vehicle import AxialLoad, Damping, Joint, Stage, Support, Thrust, Vehicle
from properties.vehicles import random_long_vehicle, with_random_damping

UNIT = {"mass_per_length": 1.0, "bending_stiffness": 1.0}


def pieces(count, internal=0.0, external=0.0, nose="clamped", foundation=0.0, **parts):
    piece = Stage(
        length=1 / count,
        internal_damping=internal,
        external_damping=external,
        foundation_stiffness=foundation,
        **UNIT,
    )
    return Vehicle(stages=[piece] * count, joints=[Joint()] * (count - 1), support=Support(nose=nose), **parts)


def long_vehicle(seed):
    rng = np.random.default_rng(seed)
    vehicle = with_random_damping(rng, random_long_vehicle(rng, int(rng.integers(12, 15))))
    drag = (AxialLoad(station=0.0, force=-0.3, tangency=1.0),) if seed % 2 else ()
    return vehicle.model_copy(update={"damping": Damping(), "axial_loads": drag})


@pytest.fixture
def dense(monkeypatch):
    """Answers of dense matrices, however large the vehicle is."""

    def ask(function, *arguments):
        with monkeypatch.context() as patch:
            for module in (critical, modes, vanishing):
                patch.setattr(module, "is_large", lambda vehicle: False)
            return function(*arguments)

    return ask


@pytest.mark.parametrize("count", [12, 40, 150])
@pytest.mark.parametrize(
    ("column", "thrust", "omega"),
    [
        ({"internal": 0.01, "external": 1.0}, 17.79406486219, 7.782337374336),
        ({"internal": 0.2}, 21.51013537701, 5.798541273015),
        ({"external": 20.0}, 30.13821341618, 7.325646523015),
        ({"internal": 0.01, "external": 0.5, "gravity": -2.0}, 15.619047681912, 6.738576561543),
    ],
)
def test_a_column_in_many_pieces_is_the_column(count, column, thrust, omega):
    found = critical_thrust(pieces(count, **column))
    assert found.kind == "flutter"
    assert found.critical_thrust == pytest.approx(thrust, rel=1e-10)
    assert found.angular_frequency == pytest.approx(omega, rel=1e-9)
    assert abs(found.critical_thrust - thrust) < found.error_estimate + 1e-10 * thrust


@pytest.mark.parametrize(
    ("column", "thrust", "omega"),
    [
        ({"internal": 1.0}, 10.938849345588, 5.3986138276688),
        ({"internal": 0.01, "external": 1.0}, 17.5476286924, 7.81027044),
        ({"internal": 1.0, "nose": "free"}, 88.152630180421, 11.723908214379),
        ({"internal": 1.0, "nose": "free", "foundation": 100.0}, 88.152630180421, math.hypot(11.723908214379, 10.0)),
    ],
)
def test_the_limit_of_vanishing_damping_of_a_column_in_many_pieces(column, thrust, omega):
    limit = vanishing_damping_limit(pieces(30, **column))
    assert limit.critical_thrust == pytest.approx(thrust, rel=2e-9)
    assert limit.angular_frequency == pytest.approx(omega, rel=2e-9)


@pytest.mark.parametrize("seed", range(4))
def test_random_vehicles_by_dense_matrices(seed, dense):
    vehicle = long_vehicle(seed)
    assert is_large(vehicle)
    for answer in (critical_thrust, vanishing_damping_limit):
        reduced, full = (found.elastic or found for found in (answer(vehicle), dense(answer, vehicle)))
        assert (reduced.kind, reduced.modes) == (full.kind, full.modes)
        assert reduced.critical_thrust == pytest.approx(full.critical_thrust, rel=1e-10)
        assert reduced.angular_frequency == pytest.approx(full.angular_frequency, rel=1e-8)


def test_all_events_by_dense_matrices(dense):
    vehicle = long_vehicle(4)
    reduced, full = critical_events(vehicle), dense(critical_events, vehicle)
    low = [event for event in full if event.thrust < 4 * full[0].thrust]
    assert [event.thrust for event in reduced[: len(low)]] == pytest.approx([event.thrust for event in low], rel=1e-7)
    assert [event.unstable for event in reduced[: len(low)]] == [event.unstable for event in low]


@pytest.mark.parametrize("thrust", [0.0, 5.0])
def test_damped_modes_by_dense_matrices(thrust, dense):
    vehicle = long_vehicle(2)
    (reduced, error), (full, _) = converged_modes(vehicle, thrust, 6), dense(converged_modes, vehicle, thrust, 6)
    assert np.sort_complex(reduced.s) == pytest.approx(np.sort_complex(full.s), rel=1e-8, abs=1e-9)
    assert error.max() < 1e-6


def test_a_drag_turns_a_free_vehicle_of_many_stages_as_one_of_few(dense):
    stages = [Stage(length=1 / 14, external_damping=0.1 if n > 6 else 0.0, **UNIT) for n in range(14)]
    vehicle = Vehicle(stages=stages, joints=[Joint(rotational_stiffness=100.0)] * 13, thrust=Thrust())
    reduced, full = critical_thrust(vehicle), dense(critical_thrust, vehicle)
    assert (reduced.rigid_body, reduced.modes, reduced.kind) == (full.rigid_body, full.modes, full.kind)
    assert reduced.elastic.critical_thrust == pytest.approx(full.elastic.critical_thrust, rel=1e-10)


def test_damping_ratios_keep_to_dense_matrices():
    assert is_large(pieces(14, internal=0.01))
    assert not is_large(pieces(14, damping=Damping(ratios=[0.01])))
