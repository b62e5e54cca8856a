"""The map of the largest motion against single responses, and the claim of Fig. 15."""

import math

import numpy as np
import pytest
from scipy.linalg import eig
from scipy.optimize import brentq

from beal.discretisation import discretise
from beal.errors import ModelError
from beal.motion import ModeShape, amplitude_map, response
from beal.vehicle import Force, Sine, catalog

PUSH = Sine(kind="sine", amplitude=0.01, angular_frequency=2.0)


def forced(factor=1.0):
    push = PUSH.model_copy(update={"amplitude": factor * PUSH.amplitude})
    return catalog.tsto(0.6, 5000.0, 5000.0).model_copy(update={"forces": (Force(station=1.0, signal=push),)})


@pytest.mark.parametrize("initial", [None, ModeShape(1, 1e-4)])
@pytest.mark.parametrize("quantity", ["displacement", "acceleration"])
def test_every_point_is_the_largest_of_a_response_of_its_own(initial, quantity):
    chart = amplitude_map(forced(), 2.0, [0.0, 60.0, 110.0], [0.5, -2.0], initial=initial, quantity=quantity)
    for n, thrust in enumerate(chart.thrust):
        for m, factor in enumerate(chart.factor):
            options = {"method": "exact", "initial": initial, "modes": 8, "rigid_body": False}
            moved = response(forced(factor), 2.0, thrust, **options)
            assert chart.amplitude[n, m] == pytest.approx(abs(moved.history("imu", quantity)).max(), rel=1e-9)


def test_the_amplitude_grows_with_the_force_and_towards_flutter_but_not_throughout():
    """Irani & Kavianipour (2009), Fig. 15 and claim C9: with the force always, with the thrust not."""
    chart = amplitude_map(forced(), 10.0, [0.0, 50.0, 90.0, 100.0, 106.0, 106.4], [1.0, 2.0, 4.0])
    np.testing.assert_allclose(chart.amplitude, np.outer(chart.amplitude[:, 0], chart.factor), rtol=1e-12)
    assert np.sign(np.diff(chart.amplitude[:, 0])).tolist() == [1, -1, 1, 1, 1]


def test_a_force_at_the_tail_hardly_moves_the_vehicle_where_the_adjoint_mode_has_its_node_there():
    """A force excites a mode by its left eigenvector, which under a follower thrust is not the mode."""
    operators = discretise(forced())

    def adjoint_at_the_tail(thrust):
        elastic = slice(operators.rigid, None)
        matrices = (matrix[elastic, elastic].T for matrix in (operators.stiffness(thrust), operators.M))
        roots, vectors = eig(*matrices)
        nose, tail = operators.shape([0.0, 1.0])[:, elastic] @ vectors[:, roots.real.argmin()].real
        return tail / nose

    silent = brentq(adjoint_at_the_tail, 80.0, 95.0)
    chart = amplitude_map(operators, 10.0, [silent - 15, silent, silent + 15], [1.0])
    assert chart.amplitude[1, 0] < 0.3 * min(chart.amplitude[0, 0], chart.amplitude[2, 0])
    assert silent == pytest.approx(87.1328, abs=1e-3)  # from the reduced equations


def test_a_motion_beyond_all_numbers_is_infinite():
    chart = amplitude_map(forced(), 100.0, [50.0, 160.0], [1.0], modes=2)
    assert math.isfinite(chart.amplitude[0, 0])
    assert chart.amplitude[1, 0] == math.inf


@pytest.mark.parametrize(
    ("vehicle", "options", "message"),
    [
        (forced(), {"thrusts": []}, "thrusts: must be finite numbers, at least one, found"),
        (forced(), {"factors": [1.0, math.nan]}, "factors: must be finite numbers, at least one, found"),
        (forced(), {"sensor": "nose"}, "sensor: must be one of imu, found 'nose'"),
        (forced().model_copy(update={"sensors": ()}), {}, "sensor: a response is read at sensors, found none"),
        (catalog.tsto(0.6, 5000.0, 5000.0), {}, "force: a map of forces needs at least one, found none"),
    ],
)
def test_a_map_refuses(vehicle, options, message):
    with pytest.raises(ModelError, match=message):
        amplitude_map(vehicle, **({"duration": 0.1, "thrusts": [1.0], "factors": [1.0]} | options))
