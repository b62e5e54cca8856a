"""Modes followed over thrust."""

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.stability.curve import thrust_curve
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle


def crossing() -> Vehicle:
    """A symmetric column under a dead load: its lowest two modes cross, the antisymmetric one shearing the joint."""
    half = Stage(length=0.5, mass_per_length=1, bending_stiffness=1)
    return Vehicle(
        stages=[half, half],
        joints=[Joint(shear_stiffness=6.0)],
        support=Support(nose="pinned", tail="pinned"),
        thrust=Thrust(tangency=0.0),
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"points": 1}, "points: must be at least 2, found 1"),
        ({"to": 0.0}, "to: must be a positive thrust, found 0.0"),
        ({"to": float("nan")}, "to: must be a positive thrust, found nan"),
        ({"modes": 0}, "modes: must lie between 1 and .*, found 0"),
    ],
)
def test_unusable_option_is_named(options, message):
    with pytest.raises(ModelError, match=message):
        thrust_curve(catalog.beck(), **options)


def test_curve_starts_from_free_vibration_and_passes_through_the_spectrum():
    curve = thrust_curve(catalog.beal(), to=100.0, points=11, modes=3)
    operators = discretise(catalog.beal(), order=14)
    for thrust, row in zip(curve.thrust, curve.angular_frequency, strict=True):
        np.testing.assert_allclose(np.sort(row), spectrum(operators, thrust, 3).angular_frequency, rtol=1e-8)
    assert np.abs(curve.growth_rate).max() < 1e-6


def test_pair_coalesces_and_goes_on_as_one_growing_and_one_decaying():
    curve = thrust_curve(catalog.beck(), to=30.0, points=61, modes=3)
    above = curve.thrust > 20.06
    np.testing.assert_allclose(curve.angular_frequency[above, 0], curve.angular_frequency[above, 1], rtol=1e-9)
    np.testing.assert_allclose(curve.growth_rate[above, 0], -curve.growth_rate[above, 1], rtol=1e-9)
    assert np.abs(curve.growth_rate[~above]).max() < 1e-6
    assert np.abs(curve.growth_rate[:, 2]).max() < 1e-6
    assert np.all(np.abs(curve.growth_rate[above, 0]) > 0.1)


@pytest.mark.parametrize("points", [12, 101])
def test_modes_keep_their_columns_where_they_cross(points):
    curve = thrust_curve(crossing(), to=9.5, points=points, modes=2)
    squares = curve.angular_frequency**2
    assert squares[0, 0] < squares[0, 1]
    assert squares[-1, 0] > squares[-1, 1]
    np.testing.assert_allclose(squares[:, 1], np.pi**2 * (np.pi**2 - curve.thrust), rtol=1e-8)  # the symmetric mode


def test_mode_that_diverges_grows_without_frequency():
    curve = thrust_curve(catalog.tsto(0.6, 1.0, 1e4), to=40.0, points=21, modes=2)
    assert curve.angular_frequency[-1, 0] == pytest.approx(0, abs=1e-9)
    assert curve.growth_rate[-1, 0] > 1


def test_the_reduction_of_a_large_vehicle_keeps_its_curves(monkeypatch):
    """Five digits, above the critical thrust too; the reduction to fewer modes alone has two."""
    launcher = discretise(catalog.generic_small_launcher(), order=6)
    found = thrust_curve(launcher, to=9e7, points=4)
    monkeypatch.setattr("beal.stability.curve.MANY", len(launcher.M))
    whole = thrust_curve(launcher, to=9e7, points=4)
    assert found.angular_frequency == pytest.approx(whole.angular_frequency, rel=3e-5)
    assert found.growth_rate == pytest.approx(whole.growth_rate, rel=3e-5, abs=1e-6)
