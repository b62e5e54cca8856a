"""Columns and beams under follower forces, beyond the known answers: modes, orders of convergence, rigid-body roots.

Values are those on which exact transfer matrices and finite elements agree; tolerances are the digits given.
"""

import math

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.pencil import pencil
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog
from beal.vehicle.parts import PointMass
from beal.verification.joints import SHEAR
from verification.known import thrust

COALESCING = 1e-8  # frequencies of a double root, nine or more digits


def test_becks_column_flutters_in_its_first_two_modes():
    found = critical_thrust(catalog.beck())
    assert (found.kind, found.modes) == ("flutter", (1, 2))


@pytest.mark.parametrize(
    ("elements", "load", "omega"),
    [
        (2, 20.1923616, 11.138166),
        (3, 20.1779236, 11.090939),
        (4, 20.0980997, 11.042698),
        (6, 20.0611695, 11.021346),
        (16, 20.0511676, 11.015678),
        (32, 20.0509671, 11.015565),
    ],
)
def test_becks_column_in_cubic_elements(elements, load, omega):
    found = critical_thrust(discretise(catalog.beck(), basis="hermite", order=elements))
    assert found.critical_thrust == pytest.approx(load, rel=0, abs=6e-8)
    assert found.angular_frequency == pytest.approx(omega, rel=0, abs=6e-7)


@pytest.mark.parametrize(
    ("vehicle", "exact", "elements"),
    [(catalog.beck(), thrust("beck()"), (16, 32)), (catalog.beal(), thrust("beal()"), (16, 32))],
)
def test_error_of_cubic_elements_falls_with_the_fourth_power(vehicle, exact, elements):
    coarse, fine = (
        critical_thrust(discretise(vehicle, basis="hermite", order=order)).critical_thrust - exact for order in elements
    )
    assert math.log2(coarse / fine) == pytest.approx(4, abs=0.05)


@pytest.mark.parametrize("mass", [0.01, 0.5, 1.0, 1000.0])
def test_pfluegers_column_flutters_in_its_first_two_modes(mass):
    found = critical_thrust(catalog.pflueger(mass))
    assert (found.kind, found.modes) == ("flutter", (1, 2))


@pytest.mark.parametrize(
    ("mass", "station", "load"),
    [
        (0.5, 0.25, 19.4076399306),
        (0.5, 0.5, 22.8770428843),
        (0.5, 0.75, 23.98396228),
        (1, 0.25, 18.9964589584),
        (1, 0.5, 27.5412561896),
        (1, 0.75, 25.9200774641),
        (2, 0.25, 18.7427059116),
        (2, 0.5, 39.6313327389),
        (2, 0.75, 27.9641598099),
    ],
)
def test_becks_column_with_a_mass_on_the_way(mass, station, load):
    lump = PointMass(station=station, mass=mass)
    found = critical_thrust(catalog.beck().model_copy(update={"point_masses": (lump,)}))
    assert found.critical_thrust == pytest.approx(load, rel=3e-10)  # ten digits for one of them


def test_beals_missile_flutters_in_its_first_two_modes():
    found = critical_thrust(catalog.beal())
    assert (found.kind, found.modes, found.rigid_body) == ("flutter", (1, 2), "neutral")


@pytest.mark.parametrize("thrust", [0.0, 30.0, 90.0, 120.0])
def test_rigid_body_motion_of_beals_missile_is_a_fourfold_zero_root(thrust):
    operators = discretise(catalog.beal(), order=12)
    K = operators.stiffness(thrust)
    small = 1e-12 * max(np.abs(K).max(), 1.0)
    assert operators.rigid == 2
    assert pencil(operators).rigid == 0
    assert np.abs(K[1:, :2]).max() < small  # a tilted vehicle is pushed sideways, K[0, 1], and that is all
    assert abs(K[0, 0]) < small
    assert abs(K[0, 1]) >= 0.5 * thrust


@pytest.mark.parametrize(
    ("elements", "load"),
    [
        (3, 112.7150912),
        (4, 110.9610325),
        (6, 110.2062752),
        (16, 109.7019204),
        (32, 109.6900052),
    ],
)
def test_beals_missile_in_cubic_elements(elements, load):
    found = critical_thrust(discretise(catalog.beal(), basis="hermite", order=elements))
    assert found.critical_thrust == pytest.approx(load, rel=0, abs=6e-8)


@pytest.mark.parametrize(
    ("station", "expected"),
    [
        (0.5, [0, 61.6728229, 89.4931418, 199.859448]),
        (0.4, [0, 51.1142228, 112.586228]),
        (0.3, [0, 39.7090254, 110.839291]),
        (0.25, [0, 35.3897324, 99.0913982]),
    ],
)
def test_frequencies_with_a_hinge(station, expected):
    operators = discretise(catalog.mladenov_sugiyama(station, rotational_stiffness=0.0), order=16)
    found = spectrum(operators, 0.0, len(expected)).angular_frequency
    assert found == pytest.approx(expected, rel=1e-8, abs=1e-5)


@pytest.mark.parametrize("axis", ["forward", "aft"])
@pytest.mark.parametrize(("station", "stiffness"), SHEAR)
def test_all_objective_shear_axes_are_the_same_where_the_slope_is_continuous(axis, station, stiffness):
    joint = {"station": station, "shear_stiffness": stiffness}
    found, mean = (critical_thrust(catalog.mladenov_sugiyama(**joint, shear_axis=a)) for a in (axis, "mean"))
    assert found.kind == mean.kind
    assert found.critical_thrust == pytest.approx(mean.critical_thrust, rel=1e-11)
    assert found.angular_frequency == pytest.approx(mean.angular_frequency, rel=COALESCING)
