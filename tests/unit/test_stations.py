"""Station tables: what they refuse, with the place of each problem, and what they add up to."""

import math
import re

import numpy as np
import pytest

from beal.errors import ModelError
from beal.vehicle import Stage, Vehicle, dumps, loads
from beal.vehicle.stations import StationTable
from beal.vehicle.summary import summary

HEAD = "[[stage]]\nlength = 2.0\nbending_stiffness = 1.0\nmass_per_length = "


def beam(**more):
    return Stage(**{"length": 2.0, "mass_per_length": 1.0, "bending_stiffness": 1.0} | more)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("{x = [0, 2], value = [1, -1]}", "mass_per_length.value[1]: must be greater than or equal to 0, found -1"),
        ("{x = [0, 2], value = [1, nan]}", "mass_per_length.value[1]: must be a number, found nan"),
        ("{x = [0, 2], value = [1, '3 N']}", "mass_per_length.value[1]: expected a number, or a number with a unit"),
        ("{x = [0, 3, 2], value = [1, 2, 3]}", "mass_per_length.x[2]: must not be below the one before, 3, found 2"),
        ("{x = [0.1, 2], value = [1, 2]}", "mass_per_length.x[0]: must be 0, the front, found 0.1"),
        ("{x = [0, 1], value = [1, 2]}", "mass_per_length.x: must end at the length, 2, found 1"),
        ("{x = [0], value = [1]}", "mass_per_length.x: must have at least two stations, found 1"),
        ("{x = [0, 2], value = [1, 2, 3]}", "mass_per_length: x and value must be equally long, found 2 and 3"),
        ("{x = [0, 1, 1, 1, 2], value = [1, 1, 2, 3, 3]}", "mass_per_length.x[3]: may come twice, inside the table"),
        ("{x = [0, 2, 2], value = [1, 1, 2]}", "mass_per_length.x[2]: may come twice, inside the table"),
        ("{x = [0, 2], value = [1, 2], y = 1}", "mass_per_length.y: unknown key; known here: x, value"),
        ("{x = 3, value = [1, 2]}", "mass_per_length.x: must be a list"),
        ("{x = [0, 2]}", "mass_per_length.value: is required and missing"),
        ("[1, 2]", "mass_per_length: must be a valid number, found [1, 2]"),
    ],
)
def test_a_table_refuses(table, message):
    with pytest.raises(ModelError, match=re.escape(f"model: stage[0].{message}")):
        loads(HEAD + table)


def test_a_load_table_reaches_over_the_whole_vehicle():
    load = {"value": {"x": [0.0, 1.0], "value": [1.0, 1.0]}}
    with pytest.raises(ModelError, match=r"distributed_thrust\[0\].value.x: must end at the length, 2, found 1"):
        Vehicle(stages=[beam()], distributed_thrust=[load])


def test_loads_that_miss_the_vehicle_or_vanish_are_refused():
    with pytest.raises(ModelError, match=r"axial_load\[0\].station: must lie on the vehicle, 0 to 2, found 3"):
        Vehicle(stages=[beam()], axial_load=[{"station": 3.0, "force": 1.0}])
    with pytest.raises(ModelError, match=r"thrust.station: must lie on the vehicle, 0 to 2, found 3"):
        Vehicle(stages=[beam()], thrust={"station": 3.0})
    with pytest.raises(ModelError, match=r"thrust.scale: must be positive where there is no distributed thrust"):
        Vehicle(stages=[beam()], thrust={"scale": 0.0})


def test_units_hold_in_tables():
    found = loads(HEAD.replace("2.0", "'2 ft'") + "{x = ['0 ft', '24 inch'], value = ['1 lb/ft', 2.0]}").stages[0]
    assert found.mass_per_length.x == pytest.approx((0.0, 0.6096))
    assert found.mass_per_length.value == pytest.approx((1.48816394, 2.0))
    with pytest.raises(ModelError, match="nondimensional model takes plain numbers"):
        loads("units = 'nondimensional'\n" + HEAD + "{x = [0, 2], value = ['1 lb/ft', 2.0]}")


def test_a_table_is_linear_with_steps():
    table = StationTable(x=[0.0, 1.0, 1.0, 3.0], value=[1.0, 3.0, 5.0, 1.0])
    np.testing.assert_allclose(table.at([0.5, 0.999999999, 2.0]), [2.0, 3.0, 3.0])
    np.testing.assert_allclose(table.integral(np.array([0.0, 0.5, 1.0, 2.0, 3.0])), [0.0, 0.75, 2.0, 6.0, 8.0])
    x = np.linspace(0, 3, 300001)
    sampled = [np.trapezoid(table.at(x) * x**n, x) for n in range(3)]
    assert table.moments == pytest.approx(sampled, rel=1e-4)
    assert table.mean == pytest.approx(8 / 3)


def test_mass_centre_and_inertia_are_those_of_the_table():
    wedge = Stage(length=3.0, mass_per_length={"x": [0.0, 3.0], "value": [1e-9, 2.0]}, bending_stiffness=1.0)
    vehicle = Vehicle(stages=[wedge])
    assert vehicle.mass == pytest.approx(3.0, rel=1e-8)
    assert vehicle.centre_of_mass == pytest.approx(2.0, rel=1e-8)
    assert vehicle.moment_of_inertia == pytest.approx(3.0 * 9.0 / 18, rel=1e-8)  # of a wedge, m L^2/18


def test_tables_and_springs_survive_a_file_and_show_in_the_summary():
    table = {"x": (0.0, 1.0, 2.0), "value": (1.0, 2.0, 1.0)}
    end = {"translation": math.inf, "rotation": 3.0}
    vehicle = Vehicle(stages=[beam(bending_stiffness=table)], support={"nose": end})
    assert vehicle == Vehicle(stages=[beam(bending_stiffness=table)], support={"nose": end})
    assert vehicle.stages[0].bending_stiffness.mean == 1.5
    assert loads(dumps(vehicle)) == vehicle
    resolved = summary(vehicle)
    assert resolved["stages"][0]["bending_stiffness"] == table
    assert resolved["support"]["nose"] == {"translation": "rigid", "rotation": 3.0}
    assert resolved["nondimensional"]["reference_bending_stiffness"] == 1.5
