"""Derivatives against differences of critical points, against the characteristic function, and against closed forms."""

import math

import numpy as np
import pytest

import beal
from beal import catalog
from beal.design.branches import builder
from beal.design.derivatives import influential
from beal.design.sensitivity import differentiable
from beal.errors import ConvergenceError, ModelError
from beal.stability.pencil import pencil
from beal.stability.refine import polish
from beal.vehicle.paths import value_at, with_values
from properties.vehicles import random_vehicles, with_random_damping
from verification.transfer_matrix import TransferMatrix, damped_flutter, divergence

PER_VEHICLE = 2


def followed(vehicle, path, critical, step=2e-4):
    """Derivative of (thrust, omega) by differences of sixth order of polished critical points; nan across a step."""
    build = builder(vehicle, "objective")
    value = value_at(vehicle, path)
    points = []
    for offset in (-3, -2, -1, 1, 2, 3):
        try:
            moved = build(with_values(vehicle, {path: value * (1 + offset * step)}))
        except ModelError:
            return np.full(2, np.nan)
        point = polish(pencil(moved), critical.kind, critical.critical_thrust, critical.angular_frequency**2)
        points.append((point.thrust, math.sqrt(max(point.W, 0.0))))
    return np.array([-1, 9, -45, 45, -9, 1]) / 60 @ np.array(points) / (step * value)


def designs(count, seed, damped):
    """Random vehicles of at most four stages with the critical thrust that they have, and some of their paths."""
    rng = np.random.default_rng(seed)
    for vehicle in random_vehicles(count, seed, softest=0.1, stiffest=1e6, absent=0.0):
        if len(vehicle.stages) > (2 if damped else 4):
            continue
        chosen = with_random_damping(rng, vehicle) if damped else vehicle
        try:
            critical = differentiable(beal.critical_thrust(chosen))
        except (ModelError, ConvergenceError):
            continue
        finite = [path for path in influential(chosen) if 0 < value_at(chosen, path) < math.inf]
        yield chosen, critical, [str(path) for path in rng.choice(finite, PER_VEHICLE, replace=False)]


@pytest.mark.parametrize(("count", "seed", "damped"), [(290, 77, False), (16, 78, True)])
def test_derivatives_are_those_of_differences_at_random_designs(count, seed, damped):
    compared, wrong = {"flutter": 0, "divergence": 0}, []
    for vehicle, critical, paths in designs(count, seed, damped):
        found = beal.critical_gradient(vehicle, paths, critical=critical)
        for n, path in enumerate(paths):
            if found.status[n] != "exact":
                continue
            mine = np.array([found.thrust[n], found.angular_frequency[n]])
            reference = followed(vehicle, path, critical)
            scale = np.array([critical.critical_thrust, critical.angular_frequency or 1.0]) / value_at(vehicle, path)
            if not np.all(np.abs(mine - reference) < 1e-6 * (np.abs(reference) + 1e-3 * scale)):
                wrong.append((path, mine.tolist(), reference.tolist()))
            compared[critical.kind] += 1
    assert not wrong
    assert sum(compared.values()) > (8 if damped else 200)
    assert min(compared.values()) > 0


def implicit(vehicle, path, thrust, omega):
    """Derivatives of (thrust, omega) from the characteristic function F(P, omega^2) = 0 = F_W."""

    def F(moved, P, W):
        return TransferMatrix(moved)(P, 1j * np.sqrt(W + 0j)).real

    value, W = value_at(vehicle, path), omega**2

    def derivative(function, at, step):
        weights = np.array([-1, 9, -45, 45, -9, 1]) / 60
        return weights @ [function(at + n * step) for n in (-3, -2, -1, 1, 2, 3)] / step

    def F_p(w):
        return derivative(lambda p: F(with_values(vehicle, {path: p}), thrust, w), value, 1e-3 * value)

    def F_P(w):
        return derivative(lambda P: F(vehicle, P, w), thrust, 1e-3 * thrust)

    def F_W(w):
        return derivative(lambda v: F(vehicle, thrust, v), w, 1e-2 * W)

    of_thrust = -F_p(W) / F_P(W)
    mixed = derivative(F_p, W, 1e-2 * W) + of_thrust * derivative(F_P, W, 1e-2 * W)
    return of_thrust, -mixed / derivative(F_W, W, 1e-2 * W) / (2 * omega)


@pytest.mark.parametrize(
    "path", ["stage.split", "stage[0].mass_per_length", "stage[1].length", "joint[0].rotational_stiffness"]
)
def test_derivatives_follow_from_the_characteristic_function(path):
    vehicle = catalog.tsto(0.6, 20.0, 100.0)
    found = beal.critical_gradient(vehicle, [path])
    critical = found.critical
    thrust, omega = implicit(vehicle, path, critical.critical_thrust, critical.angular_frequency)
    assert found.thrust[0] == pytest.approx(thrust, rel=1e-6)
    assert found.angular_frequency[0] == pytest.approx(omega, rel=1e-6)


HELD = with_values(
    catalog.tsto(0.6, 20.0, 5e3).model_copy(update={"support": beal.Support(nose="clamped")}), {"thrust.tangency": 0.3}
)


@pytest.mark.parametrize(
    ("vehicle", "solve"),
    [
        pytest.param(HELD, lambda v, P, omega: divergence(v, P), id="divergence"),
        pytest.param(
            with_values(catalog.tsto(0.6, 20.0, 100.0), {"stage[0].internal_damping": 0.01}),
            lambda v, P, omega: damped_flutter(v, P, omega)[0],
            id="damped",
        ),
    ],
)
@pytest.mark.parametrize("path", ["stage.split", "joint[0].rotational_stiffness"])
def test_derivatives_are_those_of_critical_thrusts_by_transfer_matrices(vehicle, solve, path):
    found = beal.critical_gradient(vehicle, [path])
    critical, value = found.critical, value_at(vehicle, path)
    step = 3e-3 * value
    around = [
        solve(with_values(vehicle, {path: value + n * step}), critical.critical_thrust, critical.angular_frequency)
        for n in (-3, -2, -1, 1, 2, 3)
    ]
    slope = np.array([-1, 9, -45, 45, -9, 1]) / 60 @ around / step
    assert found.thrust[0] == pytest.approx(slope, rel=1e-6)
