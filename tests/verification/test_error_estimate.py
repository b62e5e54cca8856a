"""The error estimate against the true error, with a much finer discretisation as the truth.

Both may be all rounding. The truth is known to its own rounding only, so an error below that counts as covered, and
estimates are compared in size where the true error is ten times above it.
"""

from functools import cache

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.double_root import coalescence, divergence
from beal.stability.pencil import pencil, reduced
from beal.stability.zero_roots import rigid_body_root
from beal.vehicle import catalog
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicles

COUNT, FINEST = 500, 24


def reference(vehicle: Vehicle, kind: str, thrust: float, omega: float) -> tuple[float, float]:
    """The critical thrust next to a guess at the finest discretisation, and what rounding leaves uncertain in it."""
    full = pencil(discretise(vehicle, order=FINEST))
    if kind == "flutter":
        point = coalescence(full, thrust, omega**2)
    else:
        point = divergence(full, thrust, rigid_body_root(reduced(full), thrust) == "neutral")
    assert point.converged
    return point.thrust, point.uncertainty


@cache
def solved(tolerance: float | None, basis: str, count: int) -> np.ndarray:
    """True error, estimate and rounding of the truth, relative, shape (vehicles, 3)."""
    rows = []
    for vehicle in random_vehicles(count, seed=2009, absent=0.0):
        found = critical_thrust(vehicle, tolerance=tolerance, basis=basis)
        found = found.elastic or found
        if found.critical_thrust:
            truth, rounding = reference(vehicle, found.kind, found.critical_thrust, found.angular_frequency)
            rows.append(np.array([abs(found.critical_thrust - truth), found.error_estimate, rounding]) / truth)
    return np.array(rows)


# Polynomials are at rounding with the first three orders; elements, of the same code, show the discretisation part.
CASES = [(None, "legendre", COUNT), (1e-4, "legendre", COUNT), (1e-6, "hermite", 30), (1e-3, "hermite", 30)]


@pytest.mark.parametrize(("tolerance", "basis", "count"), CASES)
def test_true_error_lies_below_the_estimate(tolerance, basis, count):
    error, estimate, rounding = solved(tolerance, basis, count).T
    assert np.mean(error <= estimate + rounding) >= 0.99


def test_estimate_of_converged_polynomials_stays_within_a_hundred_times_the_error():
    error, estimate, _ = solved(None, "legendre", COUNT).T
    assert np.mean(error <= estimate) >= 0.99
    assert np.median(estimate / np.maximum(error, 1e-16)) < 100


@pytest.mark.parametrize(("tolerance", "basis", "count"), CASES[2:])
def test_estimate_is_not_idle(tolerance, basis, count):
    error, estimate, rounding = solved(tolerance, basis, count).T
    above = error > 10 * rounding
    assert above.sum() > count / 6
    assert np.median(estimate[above] / error[above]) < 100


@pytest.mark.parametrize(("tolerance", "basis", "count"), CASES)
def test_estimate_meets_the_tolerance(tolerance, basis, count):
    assert solved(tolerance, basis, count)[:, 1].max() <= (tolerance or 1e-10)


def test_operators_are_taken_as_they_are():
    found = critical_thrust(discretise(catalog.beck(), basis="hermite", order=4))
    assert found.error_estimate < 1e-10  # rounding alone: the discretisation is the user's
    assert found.critical_thrust - 20.0509536 == pytest.approx(0.0471461, abs=1e-6)
