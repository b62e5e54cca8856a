"""The formulations: modes that meet, wavenumbers, rigid-body roots."""

import pytest

from beal.discretisation.build import discretise
from beal.discretisation.joint_modes import joint_modes
from beal.stability.critical import critical_thrust
from beal.stability.pencil import pencil
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog

HALF = 0.5001  # of the last digit given, with the rounding of the quotient


def digits(text: str) -> float:
    """Half a unit in the last digit of a printed number."""
    return HALF * 10.0 ** -len(text.partition(".")[2])


def printed(text: str) -> object:
    """A printed number that is matched to all its digits."""
    return pytest.approx(float(text), rel=0, abs=digits(text))


@pytest.mark.parametrize(
    ("vehicle", "formulation", "modes"),
    [
        (catalog.tsto(0.6, 5e3, 5e3), "objective", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3), "converged", (1, 2)),
        (catalog.tsto(0.2, 1, 100), "converged", (1, 1)),
        (catalog.tsto(0.6, 1, 1e4), "converged", (1, 1)),
        (catalog.tsto(0.8, 200, 600), "converged", (1, 2)),
        (catalog.tsto(0.8, 200, 600), "corrected-ritz", (1, 2)),
        (catalog.tsto(0.8, 200, 600), "as-printed", (3, 4)),
        (catalog.tsto(0.6, 1, 1e4), "as-printed", (1, 1)),
    ],
)
def test_formulations_differ_in_the_modes_that_meet(vehicle, formulation, modes):
    assert critical_thrust(vehicle, formulation=formulation).modes == modes


@pytest.mark.parametrize(
    ("vehicle", "omega"), [(catalog.tsto(0.6, 5e3, 5e3), 23.01319), (catalog.tsto(0.8, 200, 600), 26.42055)]
)
def test_frequency_at_coalescence_is_the_limit_of_the_mean_of_the_pair(vehicle, omega):
    # Each frequency alone is off by the square root of the distance to the critical thrust, their mean W by itself.
    thrust = critical_thrust(vehicle, formulation="converged").critical_thrust
    pair = spectrum(discretise(vehicle, "converged", order=16), thrust * (1 - 1e-7), 2).W.real
    assert pair.mean() ** 0.5 == pytest.approx(omega, rel=0, abs=1e-5)
    assert pair[1] ** 0.5 - pair[0] ** 0.5 > 0.01


@pytest.mark.parametrize(
    ("sign", "wavenumbers"),
    [
        ("printed", ["4.7209", "7.8285", "10.9961", "13.9661"]),
        ("natural", ["4.7206", "7.8266", "10.9920", "13.9618"]),
    ],
)
def test_wavenumbers_of_the_second_figure_follow_the_sign_of_the_rotational_spring(sign, wavenumbers):
    found = joint_modes(0.2, 3000, 3000, 4, sign).wavenumbers
    assert list(found) == [printed(wavenumber) for wavenumber in wavenumbers]


@pytest.mark.parametrize(
    ("axis", "formulation", "W"),
    [("inertial", "converged", "243.697"), ("inertial", "objective", "319.220"), ("mean", "objective", "203.302")],
)
def test_rigid_body_modes_act_on_an_inertial_joint(axis, formulation, W):
    operators = discretise(catalog.tsto(0.6, 5000, 200, axis), formulation, order=14)
    assert spectrum(operators, 50.0, 1).W[0].real == printed(W)


@pytest.mark.parametrize("axis", ["mean", "forward", "aft"])
def test_rigid_body_modes_leave_an_objective_joint_alone(axis):
    operators = discretise(catalog.tsto(0.6, 5000, 200, axis), order=14)
    assert operators.rigid == 2
    assert pencil(operators).rigid == 0


def test_ten_polynomials_per_stage_give_six_digits():
    vehicle = catalog.tsto(0.6, 5e3, 5e3)
    found = critical_thrust(discretise(vehicle, "converged", order=8))  # of the curvature: degree 10 of the deflection
    assert found.critical_thrust == pytest.approx(109.34644, rel=1e-6)
