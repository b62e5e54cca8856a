"""What tanks refuse, how full they are, and where their mass counts."""

import math
import re

import numpy as np
import pytest

from beal.discretisation.axial import axial_force, axial_force_in_joints
from beal.discretisation.basis import segments
from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.interop.nastran_deck import nastran_text
from beal.interop.stations import read_stations, stations_text
from beal.stability.critical import critical_thrust
from beal.stability.limit import waves
from beal.study.map import stability_map
from beal.vehicle import Joint, PointMass, Stage, Support, Tank, Vehicle, catalog, dumps, loads, value_at, with_values
from beal.vehicle.summary import summary

FRONT = Stage(length=2.0, mass_per_length=3.0, bending_stiffness=5.0)
TAPER = Stage(length=1.0, mass_per_length={"x": [0.0, 1.0], "value": [6.0, 2.0]}, bending_stiffness=7.0)
FUEL = {"name": "fuel", "forward_end": 1.0, "aft_end": 2.5, "mass_per_length": 4.0, "fill": 0.5}
DOMED = {"x": [0.0, 0.5, 1.0, 1.0, 1.5], "value": [0.0, 2.0, 4.0, 8.0, 8.0]}
GOOD = {"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": 1.0}


def rocket(*tanks, **parts):
    return Vehicle(stages=[FRONT, TAPER], joints=[Joint(rotational_stiffness=9.0)], tanks=tanks, **parts)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"aft_end": 1.0}, "aft_end: must lie aft of forward_end, 1, found 1"),
        ({"forward_end": -1.0}, "forward_end: must be greater than or equal to 0, found -1.0"),
        ({"fill": 1.1}, "fill: must be less than or equal to 1, found 1.1"),
        ({"fill": -0.1}, "fill: must be greater than or equal to 0, found -0.1"),
        ({"fill": math.nan}, "fill: must be a number, found nan"),
        ({"mass_per_length": 0.0}, "mass_per_length: must be greater than 0, found 0.0"),
        ({"mass_per_length": "3 kg"}, "mass_per_length: expected a number, or a number with a unit that converts to"),
        (
            {"mass_per_length": {"x": [0, 1], "value": [1, 1]}},
            "mass_per_length.x: must end at the length, 1.5, found 1",
        ),
        ({"mass_per_length": {"x": [0, 1.5], "value": [1, -1]}}, "mass_per_length.value[1]: must be greater than or"),
        ({"depth": 1.0}, "depth: unknown key; known here: name, forward_end, aft_end, mass_per_length, fill"),
    ],
)
def test_a_tank_refuses(change, message):
    with pytest.raises(ModelError, match=re.escape(message)):
        Tank(**FUEL | change)


def test_all_problems_of_tanks_are_reported_at_once():
    wrong = [FUEL | {"aft_end": 3.5}, FUEL | {"fill": 2.0}, FUEL | {"forward_end": 4.0, "aft_end": 3.0, "name": "gas"}]
    with pytest.raises(ModelError) as caught:
        Vehicle(stage=[GOOD | {"length": 3.0}], tank=wrong)
    assert caught.value.problems == [
        ("tank[1].fill", "must be less than or equal to 1, found 2.0"),
        ("tank[2].aft_end", "must lie aft of forward_end, 4, found 3"),
        ("tank[0].aft_end", "must lie on the vehicle, 0 to 3, found 3.5"),
        ("tank[2].forward_end", "must lie on the vehicle, 0 to 3, found 4"),
        ("tank[1].name", "must be unique, found 'fuel' again"),
    ]


def test_fill_is_a_share_of_the_mass_that_lies_at_the_aft_end():
    tank = Tank(**FUEL | {"mass_per_length": DOMED})
    assert Tank(**FUEL).surface == 1.75
    assert tank.mass == 3.0  # of 0.5 + 1.5 + 4
    assert tank.surface == pytest.approx(2.5 - 3 / 8)
    # The last of the 6 kg lies in the cone, m = 4 x: 2 x^2 = 6 - 5.9.
    assert tank.model_copy(update={"fill": 5.9 / 6}).surface == pytest.approx(1 + math.sqrt(0.05))
    assert [tank.model_copy(update={"fill": fill}).surface for fill in (0.0, 2 / 3, 1.0)] == [2.5, 2.0, 1.0]


def test_propellant_is_added_to_the_stages_that_it_lies_in():
    front, aft = rocket(Tank(**FUEL), Tank(**FUEL | {"name": "gas", "fill": 1.0, "mass_per_length": DOMED})).laden
    assert front.mass_per_length.x == (0.0, 1.0, 1.5, 1.75, 1.75, 2.0)
    assert front.mass_per_length.value == pytest.approx((3.0, 3.0, 5.0, 6.0, 10.0, 11.0), rel=1e-15)
    assert aft.mass_per_length.x == (0.0, 0.5, 0.5, 1.0)
    assert aft.mass_per_length.value == pytest.approx((6.0 + 12, 4.0 + 12, 4.0, 2.0), rel=1e-15)


def test_stages_without_propellant_are_themselves():
    dry = rocket(Tank(**FUEL | {"fill": 0.0}), Tank(**FUEL | {"name": "gas", "aft_end": 2.0}))
    assert rocket().laden == rocket().stages
    assert dry.laden[1] is dry.stages[1]
    assert dry.stages[0].mass_per_length == 3.0


def test_a_tank_that_ends_at_a_stage_s_end_up_to_rounding_leaves_no_sliver():
    tank = Tank(name="fuel", forward_end=2.0 - 1e-13, aft_end=3.0, mass_per_length=4.0)
    assert rocket(tank).laden[0] is rocket(tank).stages[0]
    assert rocket(tank).laden[1].mass_per_length.x == (0.0, 1.0)
    short = tank.model_copy(update={"aft_end": 3.0 - 1e-13})
    assert rocket(short).laden[1].mass_per_length.x == (0.0, 1.0)


def by_hand():
    """`rocket` with half its fuel, as tables."""
    mass = {"x": [0.0, 1.75, 1.75, 2.0], "value": [3.0, 3.0, 7.0, 7.0]}
    aft = {"x": [0.0, 0.5, 0.5, 1.0], "value": [10.0, 8.0, 4.0, 2.0]}
    stages = [FRONT.model_copy(update={"mass_per_length": mass}), TAPER.model_copy(update={"mass_per_length": aft})]
    return rocket().model_copy(update={"stages": stages})


def test_a_tank_counts_wherever_mass_counts():
    tank, hand = rocket(Tank(**FUEL)), by_hand()
    assert tank.mass == pytest.approx(10.0 + 3.0, rel=1e-15)
    assert tank.centre_of_mass == pytest.approx((6 * 1 + 4 * 2 + (3 - 4 / 3) + 3 * 2.125) / 13)
    for name in ("mass", "centre_of_mass", "moment_of_inertia"):
        assert getattr(tank, name) == pytest.approx(getattr(hand, name), rel=1e-15)
    x = np.linspace(0.0, 3.0, 61)
    np.testing.assert_allclose(axial_force(tank, x), axial_force(hand, x), rtol=1e-14)
    np.testing.assert_allclose(axial_force_in_joints(tank), (6.0 + 1.0) / 13, rtol=1e-14)
    np.testing.assert_allclose(waves(tank), waves(hand), rtol=1e-14)
    assert [s.start for s in segments(tank)] == [s.start for s in segments(hand)] == [0.0, 1.75, 2.0, 2.5]
    for matrix in ("M", "K0", "K1"):
        np.testing.assert_array_equal(getattr(discretise(tank), matrix), getattr(discretise(hand), matrix))
    assert critical_thrust(tank) == critical_thrust(hand)


def test_a_tank_bears_on_the_nose_that_holds_the_vehicle():
    parts = {"support": Support(nose="clamped"), "gravity": 2.0}
    hanging = rocket(Tank(**FUEL), **parts)
    np.testing.assert_array_equal(discretise(hanging).dead, discretise(by_hand().model_copy(update=parts)).dead)


def test_a_large_vehicle_carries_its_tanks_too():
    """Of a dozen segments and more, by sparse matrices; the same as lumps where the columns are short."""
    stages = [Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)] * 14
    vehicle = Vehicle(stages=stages, joints=[Joint()] * 13)
    short = [Tank(name=f"{n}", forward_end=0.4 + n, aft_end=0.4 + n + 1e-4, mass_per_length=1e4) for n in range(5)]
    lumps = [PointMass(station=0.4 + n + 0.5e-4, mass=1.0, rotary_inertia=1e-8 / 12) for n in range(5)]
    tanks, points = (vehicle.model_copy(update=parts) for parts in ({"tanks": short}, {"point_masses": lumps}))
    one, other = critical_thrust(tanks), critical_thrust(points)
    assert (one.kind, one.modes) == (other.kind, other.modes)
    assert one.critical_thrust == pytest.approx(other.critical_thrust, rel=1e-7)
    assert one.angular_frequency == pytest.approx(other.angular_frequency, rel=1e-7)


def test_a_vehicle_with_tanks_is_written_as_it_was_given():
    text = dumps(rocket(Tank(**FUEL), Tank(**FUEL | {"name": "gas", "mass_per_length": DOMED})))
    assert "mass_per_length = 3.0\n" in text
    assert text.count("[[tank]]") == 2
    assert dumps(loads(text)) == text


def test_quantities_of_tanks_have_paths():
    vehicle = rocket(Tank(**FUEL), Tank(**FUEL | {"name": "gas", "mass_per_length": DOMED}))
    assert value_at(vehicle, "tank[1].fill") == 0.5
    assert with_values(vehicle, {"tank[0].fill": 0.25}).mass == vehicle.mass - 1.5
    longer = with_values(vehicle, {"tank[1].forward_end": 0.5, "tank[0].mass_per_length": "8 kg/m"}).tanks
    assert longer[1].mass_per_length.x == pytest.approx((0.0, 2 / 3, 4 / 3, 4 / 3, 2.0))
    assert longer[0].mass == 6.0
    with pytest.raises(ModelError, match=re.escape("tank[2].fill: index out of range: this vehicle has 2 tanks")):
        value_at(vehicle, "tank[2].fill")


def test_the_resolved_model_shows_tanks_apart_from_stages():
    resolved = summary(rocket(Tank(**FUEL)))
    assert resolved["mass"] == pytest.approx(13.0)
    assert [stage["mass"] for stage in resolved["stages"]] == [6.0, 4.0]
    assert resolved["tanks"] == [{"name": "fuel", "from": 1.0, "to": 2.5, "fill": 0.5, "surface": 1.75, "mass": 3.0}]


def test_a_station_table_keeps_the_tanks_and_a_deck_refuses_them(tmp_path):
    vehicle = Vehicle(stages=[FRONT], tanks=[Tank(**FUEL | {"aft_end": 2.0})])
    (tmp_path / "stations.csv").write_text(stations_text(vehicle))
    assert read_stations(tmp_path / "stations.csv").vehicle.model_copy(update={"title": ""}) == vehicle
    with pytest.raises(ModelError, match=re.escape("tank[0]: is not written to decks")):
        nastran_text(vehicle)


def test_the_paper_s_formulations_refuse_propellant():
    vehicle = catalog.tsto(0.6, 10.0, 10.0)
    tank = Tank(name="fuel", forward_end=0.7, aft_end=0.9, mass_per_length=1.0)
    with pytest.raises(ModelError, match="two stages of equal, uniform mass per length"):
        discretise(vehicle.model_copy(update={"tanks": [tank]}), "as-printed")


def test_a_map_over_fill_is_solved():
    vehicle = rocket(Tank(**FUEL))
    found = stability_map(vehicle, {"tank[0].fill": [0.0, 0.5]}, workers=1)
    expected = [critical_thrust(v).critical_thrust for v in (rocket(), vehicle)]
    np.testing.assert_allclose(found.critical_thrust, expected, rtol=1e-6)


def test_propellant_beyond_the_range_of_numbers_is_refused_without_a_warning():
    with pytest.raises(ModelError, match="leave the range of numbers"):
        rocket(Tank(**FUEL | {"mass_per_length": 1e308, "fill": 1.0}))
