"""Flutter of two modes that only just meet: a search has to have their frequencies to a part of their distance."""

import numpy as np
import pytest
import scipy.sparse.linalg

import beal
from beal import Joint, Stage, Support, Vehicle
from beal.design.overlooked import overlooked

AREAS = (0.74755971, 1.48525607, 1.67890800, 0.82722669, 0.82762036, 0.43342917)
COLUMN = Vehicle(
    stages=[Stage(length=1 / 6, mass_per_length=a, bending_stiffness=a**2) for a in AREAS],
    joints=[Joint()] * 5,
    support=Support(nose="clamped"),
    units="nondimensional",
)


def roots_of_elements(thrust, near, each=96):
    """The two W nearest to a guess, of cubic elements of its own."""
    n = 6 * each
    h = 1 / n
    scale = np.outer([1, h, 1, h], [1, h, 1, h])
    bending = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) * scale / h**3
    string = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) * scale / (30 * h)
    inertia = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * scale * h / 420
    K, M = (scipy.sparse.lil_matrix((2 * n + 2, 2 * n + 2)) for _ in range(2))
    for i in range(n):
        area, at = AREAS[i // each], slice(2 * i, 2 * i + 4)
        K[at, at] += area**2 * bending - thrust * string
        M[at, at] += area * inertia
    K[-2, -1] += thrust  # which follows the tangent at the free end
    K, M = (matrix[2:, 2:].tocsc() for matrix in (K, M))
    return scipy.sparse.linalg.eigs(K, 2, M, sigma=near, return_eigenvectors=False)


@pytest.mark.parametrize("method", ["fast", "complete"])
def test_a_reduction_that_has_the_pair_too_far_apart_is_mended(method):
    found = beal.critical_thrust(COLUMN, method=method)
    assert (found.kind, found.modes) == ("flutter", (3, 4))
    assert found.critical_thrust == pytest.approx(81.178, abs=2e-3)
    assert found.error_estimate < 1e-6 * found.critical_thrust
    assert found.angular_frequency == pytest.approx(54.52, abs=0.02)
    assert overlooked(COLUMN, found.critical_thrust, 12) is None


def test_the_interval_ends_and_the_modes_meet_again_elsewhere():
    (first, last, *_) = beal.critical_events(COLUMN, 100.0)
    assert (first.change, last.change) == ("destabilises", "restabilises")
    assert 0.03 < last.thrust - first.thrust < 0.05
    around = [end.thrust + side * 2e-3 for end in (first, last) for side in (-1, 1)]
    assert [bool(np.any(roots_of_elements(thrust, first.W + 10.0).imag)) for thrust in around] == [
        False,
        True,
        True,
        False,
    ]
