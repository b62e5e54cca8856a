"""The reference values of the theory page: loads, frequencies, kinds and modes under each formulation."""

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
    ("vehicle", "formulation", "thrust", "omega", "kind", "modes"),
    [
        (catalog.beal(), "objective", "109.689191958738", "23.0733298844", "flutter", (1, 2)),
        (catalog.beck(), "objective", "20.0509536", "11.0156", "flutter", (1, 2)),
        (catalog.pflueger(0.1), "objective", "17.595282", "9.43278", "flutter", (1, 2)),
        (catalog.pflueger(0.5), "objective", "16.061562", "7.23706", "flutter", (1, 2)),
        (catalog.pflueger(1.0), "objective", "16.212129", "6.27450", "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3), "objective", "106.437231", "22.8073", "flutter", (1, 2)),
        (catalog.tsto(0.8, 1e4, 1e4), "objective", "108.590391", "22.7822", "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3), "converged", "109.34644", "23.01319", "flutter", (1, 2)),
        (catalog.tsto(0.8, 200, 600), "converged", "107.78176", "26.42055", "flutter", (1, 2)),
        (catalog.tsto(0.2, 1, 100), "converged", "44.92481", "0", "divergence", (1, 1)),
        (catalog.tsto(0.6, 5e3, 5e3), "corrected-ritz", "109.528403", None, "flutter", (1, 2)),
        (catalog.tsto(0.8, 1e4, 1e4), "corrected-ritz", "116.786285", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3), "as-printed", "109.615937", None, "flutter", (1, 2)),
        (catalog.tsto(0.8, 200, 600), "as-printed", "98.836918", None, "flutter", (3, 4)),
        (catalog.tsto(0.6, 1, 1e4), "as-printed", "107.650146", None, "divergence", (1, 1)),
        # the text: a soft rotational spring, slow convergence of modes, the couple of the axial force
        (catalog.tsto(0.6, 1, 1e4), "corrected-ritz", "13.941080", None, "divergence", (1, 1)),
        (catalog.tsto(0.6, 1, 1e4), "converged", "13.898275", "0", "divergence", (1, 1)),
        (catalog.tsto(0.8, 1e4, 1e4), "converged", "109.622066", None, "flutter", (1, 2)),
        (catalog.tsto(0.8, 200, 600), "corrected-ritz", "108.204074", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3, "mean"), "objective", "106.437231", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3, "forward"), "objective", "106.432496", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3, "aft"), "objective", "106.441715", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3, "inertial"), "objective", "107.989003", None, "flutter", (1, 2)),
        (catalog.tsto(0.6, 5e3, 5e3), "converged", "109.346441", None, "flutter", (1, 2)),
    ],
)
def test_critical_thrust_is_the_reference_value(vehicle, formulation, thrust, omega, kind, modes):
    found = critical_thrust(vehicle, formulation=formulation)
    assert (found.kind, found.modes) == (kind, modes)
    assert found.critical_thrust == printed(thrust)
    assert omega is None or found.angular_frequency == printed(omega)


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
