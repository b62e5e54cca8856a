"""Bases and matrices: shapes, supports, and finite elements as textbooks write them."""

import numpy as np
import pytest
import scipy.linalg

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.stability.pencil import pencil, reduced
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, Stage, Support
from beal.vehicle.vehicle import Vehicle

BEAM = Stage(length=0.5, mass_per_length=1, bending_stiffness=1)


def textbook_column(elements: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, K0, K1 of Beck's column in nodal deflections and slopes, with the usual element matrices."""
    h = 1 / elements
    mass = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * h / 420
    bending = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / h**3
    geometric = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / (30 * h)
    scale = np.outer([1, h, 1, h], [1, h, 1, h])
    M, K0, K1 = (np.zeros((2 * elements + 2, 2 * elements + 2)) for _ in range(3))
    for node in range(elements):
        at = slice(2 * node, 2 * node + 4)
        M[at, at] += mass * scale
        K0[at, at] += bending * scale
        K1[at, at] -= geometric * scale
    K1[-2, -1] += 1.0  # the follower force turns with the slope of the tail
    return M[2:, 2:], K0[2:, 2:], K1[2:, 2:]


@pytest.mark.parametrize("elements", [2, 5, 12])
@pytest.mark.parametrize("thrust", [0.0, 15.0, 30.0])
def test_cubic_elements_are_those_of_the_textbooks(elements, thrust):
    M, K0, K1 = textbook_column(elements)
    expected = np.sort_complex(scipy.linalg.eigvals(K0 + thrust * K1, M))[:4]
    found = spectrum(discretise(catalog.beck(), basis="hermite", order=elements), thrust, 4).W
    np.testing.assert_allclose(np.sort_complex(found), expected, rtol=1e-9)


@pytest.mark.parametrize("basis", ["legendre", "hermite"])
@pytest.mark.parametrize(("nose", "tail"), [("clamped", "free"), ("pinned", "sliding"), ("free", "clamped")])
def test_shapes_satisfy_the_supports(basis, nose, tail):
    vehicle = Vehicle(
        stages=[BEAM, BEAM],
        joints=[Joint(rotational_stiffness=2.0, shear_stiffness=3.0)],
        support=Support(nose=nose, tail=tail),
    )
    operators = discretise(vehicle, basis=basis, order=4)
    held = {"clamped": (0, 1), "pinned": (0,), "sliding": (1,), "free": ()}
    for station, end in ((0.0, nose), (1.0, tail)):
        for derivative in held[end]:
            assert np.abs(operators.shape([station], derivative)).max() < 1e-12


@pytest.mark.parametrize("basis", ["legendre", "hermite"])
def test_shapes_jump_at_the_joint_alone_and_only_as_its_springs_allow(basis):
    vehicle = Vehicle(stages=[BEAM, BEAM], joints=[Joint(rotational_stiffness=2.0)])
    operators = discretise(vehicle, basis=basis, order=4)
    jumps = [np.abs(operators.shape([0.5], d) - operators.shape([0.5], d, side="forward")).max() for d in (0, 1)]
    assert jumps[0] < 1e-12
    assert jumps[1] > 0.1


@pytest.mark.parametrize("basis", ["legendre", "hermite"])
def test_rigid_body_motions_lead_and_strain_nothing(basis):
    operators = discretise(catalog.tsto(0.4, 10.0, 20.0), basis=basis, order=6)
    assert operators.rigid == 2
    assert not operators.K0[:2].any()
    assert np.abs(operators.M[:2, 2:]).max() < 1e-12 * np.abs(operators.M).max()
    assert np.abs(operators.shape([0.1, 0.9], 2)[:, :2]).max() == 0.0


def test_low_roots_survive_a_joint_of_1e12():
    stiff = Vehicle(stages=[BEAM, BEAM], joints=[Joint(rotational_stiffness=1e12, shear_stiffness=1e12)])
    small = reduced(pencil(discretise(stiff, order=12)))
    thrust = 80.0
    exact = spectrum(discretise(catalog.beal(), order=16), thrust, 3).W.real
    np.testing.assert_allclose(small.roots(thrust)[:3].real, exact, rtol=1e-7)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"formulation": "exact"}, "formulation: must be one of objective, .*found 'exact'"),
        ({"basis": "splines"}, "basis: must be one of legendre, hermite, found 'splines'"),
        ({"order": 0}, "order: must be at least 1, found 0"),
    ],
)
def test_unusable_option_is_named(options, message):
    with pytest.raises(ModelError, match=message):
        discretise(catalog.beal(), **options)


@pytest.mark.parametrize("count", [0, 200])
def test_spectrum_refuses_modes_that_it_does_not_hold(count):
    with pytest.raises(ModelError, match=f"count: must lie between 1 and .*, found {count}"):
        spectrum(discretise(catalog.beck()), 0.0, count)


def test_spectrum_refuses_a_thrust_that_is_no_number():
    with pytest.raises(ModelError, match="thrust: must be a finite number, found nan"):
        spectrum(discretise(catalog.beck()), float("nan"))
