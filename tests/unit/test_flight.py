"""A flight: one vehicle for each time, and what is said where there is no margin."""

import math
import re

import numpy as np
import pytest

from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import critical_thrust
from beal.stability.modes import converged_modes
from beal.study import flight as module
from beal.study.flight import COASTS, flight
from beal.vehicle import AxialLoad, Joint, Stage, Support, Tank, Thrust, Timeline, Vehicle, with_values

STAGE = Stage(length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
TANK = Tank(name="fuel", forward_end=1.2, aft_end=1.9, mass_per_length=5.0)
ASCENT = Timeline(
    time=[0.0, 10.0, 10.0, 12.0],
    thrust=[2.0, 3.0, 0.0, 50.0],
    fill={"fuel": [1.0, 0.25, 0.25, 0.25]},
    stages=["1-2", "1-2", "1", "1"],
)
ROCKET = Vehicle(stages=[STAGE, STAGE], joints=[Joint(rotational_stiffness=5.0)], tanks=[TANK], timeline=ASCENT)


def test_each_time_is_a_vehicle_of_its_own():
    found = flight(ROCKET, modes=3)
    half = with_values(ROCKET, {"tank[0].fill": 0.25})
    np.testing.assert_allclose(found.mass, [5.5, 2.875, 1.0, 1.0], rtol=1e-14)
    assert [state.stages for state in found.states] == [(1, 2), (1, 2), (1, 1), (1, 1)]
    np.testing.assert_allclose(
        found.angular_frequency[1], converged_modes(half, 3.0, 3)[0].angular_frequency, rtol=1e-9
    )
    assert found.states[1].critical == critical_thrust(half)
    assert found.margin[1] == critical_thrust(half).critical_thrust / 3.0 - 1
    assert found.margin[3] == pytest.approx(109.689191958738 / 50 - 1)  # a uniform free beam
    assert all(state.status == "solved" for state in found.states)
    assert not found.at_least.any()


def test_a_coasting_vehicle_has_a_critical_thrust_and_no_margin():
    found = flight(ROCKET, modes=1)
    assert math.isnan(found.margin[2])
    assert found.states[2].reason == COASTS
    assert found.critical_thrust[2] == pytest.approx(109.689191958738)
    assert [state.reason for state in found.states].count("") == 3


def test_a_vehicle_that_stays_the_same_is_solved_once(monkeypatch):
    solved = []
    monkeypatch.setattr(
        module, "critical_thrust", lambda vehicle, tolerance: solved.append(vehicle) or critical_thrust(vehicle)
    )
    flight(ROCKET)
    assert len(solved) == 3


def test_a_margin_up_to_where_was_searched_is_a_lower_bound():
    # A dead load that pulls.
    hanging = Vehicle(
        stages=[STAGE],
        support=Support(tail="clamped"),
        thrust=Thrust(tangency=0.0, station=0.0, axial_force="constant"),
        timeline={"time": [0.0], "thrust": [2.0]},
    )
    found = flight(hanging)
    (state,) = found.states
    assert (state.critical.kind, state.at_least) == ("stable", True)
    assert math.isnan(found.critical_thrust[0])
    assert state.margin == found.searched_to[0] / 2.0 - 1


def test_a_vehicle_that_tumbles_has_no_margin_and_says_what_its_elastic_modes_bear():
    (state,) = flight(
        Vehicle(stages=[STAGE], thrust=Thrust(tangency=0.5), timeline={"time": [0], "thrust": [1]})
    ).states
    assert state.margin == -1.0
    assert re.fullmatch(r"tumbles under any thrust; its elastic modes alone bear [\d.]+", state.reason)


def test_a_time_at_which_the_numerics_fail_carries_the_reason(monkeypatch):
    def fails(vehicle, tolerance):
        if vehicle.mass > 3:
            raise ConvergenceError("lost")
        return critical_thrust(vehicle)

    monkeypatch.setattr(module, "critical_thrust", fails)
    found = flight(ROCKET)
    assert [state.status for state in found.states] == ["not_converged", "solved", "solved", "solved"]
    assert found.states[0].reason == "lost"
    assert np.isnan([found.margin[0], found.critical_thrust[0], found.searched_to[0]]).all()
    assert np.isfinite(found.angular_frequency).all()


def test_a_time_at_which_the_vehicle_is_refused_carries_the_reason():
    drag = Vehicle(
        stages=[STAGE],
        tanks=[TANK.model_copy(update={"forward_end": 0.0, "aft_end": 0.1})],
        axial_loads=[AxialLoad(station=0.0, force=-1000.0)],
        timeline={"time": [0.0], "thrust": [1.0]},
    )
    (state,) = flight(drag).states
    assert state.status == "invalid"
    assert "dead loads alone" in state.reason


def test_a_timeline_is_given_beside_the_vehicle_or_as_a_table(tmp_path):
    dry = ROCKET.model_copy(update={"timeline": None})
    (tmp_path / "ascent.csv").write_text("time,thrust,fill.fuel\n0,2,1\n1,2,0\n")
    line = Timeline(time=[0.0, 1.0], thrust=[2.0, 2.0], fill={"fuel": [1.0, 0.0]})
    assert flight(dry, tmp_path / "ascent.csv") == flight(dry, line) == flight(ROCKET, line)


def test_progress_is_told():
    told = []
    flight(ROCKET, progress=lambda done, total: told.append((done, total)))
    assert told == [(1, 4), (2, 4), (3, 4), (4, 4)]


def test_a_flight_needs_a_timeline():
    with pytest.raises(ModelError, match="timeline: is needed and missing"):
        flight(ROCKET.model_copy(update={"timeline": None}))


@pytest.mark.parametrize("modes", [0, 41])
def test_the_number_of_modes_is_limited(modes):
    with pytest.raises(ModelError, match="modes: must lie between 1 and 40"):
        flight(ROCKET, modes=modes)


def test_a_table_that_does_not_suit_the_vehicle_is_refused_under_its_name(tmp_path):
    path = tmp_path / "ascent.csv"
    path.write_text("time,thrust,fill.gas,stages\n0,2,1,1-3\n")
    with pytest.raises(ModelError, match=r"ascent.csv: 2 problems\n  timeline.fill.gas: .*\n  timeline.stages\[0\]: "):
        flight(ROCKET, path)


def test_a_separation_that_cannot_be_is_refused_before_anything_is_solved():
    across = ROCKET.model_copy(update={"tanks": [TANK.model_copy(update={"forward_end": 0.5})]})
    told = []
    with pytest.raises(ModelError) as caught:
        flight(across, progress=lambda done, total: told.append(done))
    message = "'fuel' holds propellant on both sides of a separation"
    assert (caught.value.problems, told) == ([("timeline.stages[2], tank[0]", message)], [])
