"""The kernels that maps are solved with, against the searches that look at one vehicle at a time.

    python tests/verification/test_map_kernel.py 1000 20

compares a thousand random groups of twenty vehicles with the complete search and prints how many were left to it.
"""

import math
import sys

import numpy as np
import pytest

import beal
from beal.stability.kernels import scan_compiled, scan_plain
from beal.stability.kernels.rules import FLUTTER, UNDECIDED
from beal.stability.kernels.table_compiled import determinants
from beal.stability.limit import default_limit
from beal.stability.table import TANGENCY, panel, weights
from beal.study.batch import solve_together
from beal.study.study import Solve

ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
KINDS = {0: "stable", 1: "flutter", 2: "divergence"}
SUPPORTS = ({"nose": "clamped"}, {"nose": "pinned", "tail": "pinned"}, {"nose": "sliding"}, {"tail": "clamped"})


def random_vehicle(rng):
    """One to four joints anywhere, stages of different make, point masses, supports with any tangency."""
    while True:
        cuts = np.concatenate(([0.0], np.sort(rng.uniform(0.05, 0.95, rng.integers(1, 5))), [1.0]))
        if np.diff(cuts).min() > 0.03:
            break
    unlike = rng.random() < 0.5
    stages = [
        beal.Stage(
            length=length,
            mass_per_length=10 ** rng.uniform(-0.5, 0.5) if unlike else 1.0,
            bending_stiffness=10 ** rng.uniform(-0.7, 0.7) if unlike else 1.0,
        )
        for length in np.diff(cuts)
    ]
    parts = {}
    if rng.random() < 0.4:
        parts["point_masses"] = tuple(
            beal.PointMass(station=rng.uniform(0, 1), mass=10 ** rng.uniform(-2, 0.5))
            for _ in range(rng.integers(1, 3))
        )
    if rng.random() < 0.4:
        parts["support"] = beal.Support(**SUPPORTS[rng.choice(4, p=[0.6, 0.2, 0.1, 0.1])])
        parts["thrust"] = beal.Thrust(tangency=rng.uniform(0, 1))
    joints = (beal.Joint(rotational_stiffness=1.0, shear_stiffness=1.0),) * (len(stages) - 1)
    return beal.Vehicle(units="nondimensional", stages=tuple(stages), joints=joints, **parts)


def springs_of(vehicle):
    return tuple(f"joint[{j}].{k}_stiffness" for j in range(len(vehicle.joints)) for k in ("rotational", "shear"))


def random_stiffnesses(rng, vehicles, springs):
    stiffnesses = 10 ** rng.uniform(-2, 12, (vehicles, springs))
    stiffnesses[rng.random(stiffnesses.shape) < 0.05] = math.inf
    return stiffnesses


def with_springs(vehicle, stiffnesses):
    pairs = stiffnesses.reshape(-1, 2)
    joints = tuple(beal.Joint(rotational_stiffness=r, shear_stiffness=s) for r, s in pairs)
    return vehicle.model_copy(update={"joints": joints})


def agrees(found, index, one):
    """Whether a vehicle of a group has the kind, the modes and, within the error estimates, the thrust of ``one``."""
    if KINDS[int(found.kind[index])] != one.kind:
        return False
    if one.kind == "stable":
        return True
    error = max(found.error[index] + one.error_estimate, 1e-8 * one.critical_thrust)
    return found.mode[index] == one.modes[0] and abs(found.thrust[index] - one.critical_thrust) <= error


@pytest.mark.parametrize("seed", range(24))
@pytest.mark.parametrize(("formulation", "method"), [("objective", "complete"), ("converged", "fast")])
def test_tables_agree_with_the_search_for_one_vehicle_or_leave_it_to_that(seed, formulation, method):
    rng = np.random.default_rng(seed)
    vehicle = random_vehicle(rng)
    paths = springs_of(vehicle)
    stiffnesses = random_stiffnesses(rng, 20, len(paths))
    found = solve_together(vehicle, paths, stiffnesses, Solve(formulation=formulation))
    assert np.mean(found.kind == UNDECIDED) < 0.2  # else the comparison below would say little
    for index in rng.choice(np.flatnonzero(found.kind != UNDECIDED), 6, replace=False):
        one = beal.critical_thrust(with_springs(vehicle, stiffnesses[index]), formulation=formulation, method=method)
        assert agrees(found, index, one), (stiffnesses[index], found.thrust[index], one)


@pytest.mark.parametrize("split", [0.2, 0.4, 0.6, 0.8])
def test_tables_decide_all_of_the_papers_maps(split):
    grid = np.array([(r, s) for r in np.geomspace(1, 1e4, 40) for s in np.geomspace(1e2, 1e4, 40)])
    vehicle = beal.catalog.tsto(split, 1.0, 1.0)
    found = solve_together(vehicle, (ROTATIONAL, SHEAR), grid, Solve(tolerance=1e-7))
    assert not np.any(found.kind == UNDECIDED)
    assert np.nanmedian(found.error / found.thrust) < 1e-11


def test_the_tangency_of_a_supported_vehicle_shares_the_tables():
    tangencies = np.linspace(0.0, 1.0, 41)
    stiffnesses = np.where(np.arange(41) % 2, 20.0, 3.0)
    vehicle = beal.catalog.tsto(0.5, 1.0, math.inf).model_copy(update={"support": beal.Support(nose="clamped")})
    values = np.column_stack((tangencies, stiffnesses))
    found = solve_together(vehicle, (TANGENCY, ROTATIONAL), values, Solve())
    assert set(found.kind) == {1, 2}
    for index in range(0, 41, 5):
        joint = beal.Joint(rotational_stiffness=stiffnesses[index])
        thrust = beal.Thrust(tangency=tangencies[index])
        one = beal.critical_thrust(vehicle.model_copy(update={"joints": (joint,), "thrust": thrust}))
        assert agrees(found, index, one)


def test_becks_column_is_a_point_of_a_table():
    column = beal.catalog.tsto(0.5, math.inf, math.inf).model_copy(update={"support": beal.Support(nose="clamped")})
    found = solve_together(column, (ROTATIONAL, TANGENCY), np.array([[math.inf, 1.0], [math.inf, 0.0]]), Solve())
    assert found.thrust == pytest.approx([20.0509536, math.pi**2 / 4], rel=2e-9)
    assert found.kind.tolist() == [1, 2]


def kernels_on(vehicle, paths, values, soft, width=0.25):
    tables = panel(vehicle, paths, "objective", (0.0, width * default_limit(vehicle)), soft)
    factors = weights(vehicle, paths, values)
    results = []
    for kernel in (scan_compiled, scan_plain):
        kind, mode, found = np.zeros(len(values), int), np.zeros(len(values), int), np.empty((len(values), 4))
        kernel.scan(tables, factors, kind, mode, found)
        results.append((kind, mode, found))
    return results


@pytest.mark.parametrize("seed", range(8))
def test_the_compiled_kernel_and_its_plain_twin_give_the_same_answers(seed):
    rng = np.random.default_rng(100 + seed)
    vehicle = random_vehicle(rng)
    paths = springs_of(vehicle)[:4]
    stiffnesses = random_stiffnesses(rng, 150, len(paths))
    (kind, mode, found), (twin_kind, twin_mode, twin) = kernels_on(vehicle, paths, stiffnesses, soft=bool(seed % 2))
    precise = ~(np.fmax(found[:, 2], twin[:, 2]) > 1e-6 * np.fmax(found[:, 0], twin[:, 0]))  # else rounding decides
    assert np.mean(precise) > 0.5
    assert np.array_equal(kind[precise], twin_kind[precise])
    assert np.array_equal(mode[precise], twin_mode[precise])
    assert np.array_equal(found[precise, 3], twin[precise, 3])
    unstable = precise & (mode > 0)
    assert np.all(np.abs(found - twin)[unstable, 0] <= 1e-12 * found[unstable, 0] + found[unstable, 2])


@pytest.mark.parametrize("springs", [1, 2, 5])
def test_the_compiled_determinants_are_those_of_numpy(springs):
    rng = np.random.default_rng(springs)
    H = np.triu(rng.normal(size=(12, 12)), -1)
    left, right = rng.normal(size=(2, 12, springs))
    s = rng.uniform(0.1, 2.0, 7)
    found = determinants(H, left, right, s)
    for k, subset in np.ndindex(7, 2**springs):
        A = np.eye(12) - s[k] * H
        G = left.T @ np.linalg.solve(A, right)
        rows = [G[i] if subset >> i & 1 else np.eye(springs)[i] - G[i] for i in range(springs)]
        assert found[subset, k] == pytest.approx(np.linalg.det(A) * np.linalg.det(rows), rel=1e-9)


def border_of(low, high):
    """Rotational stiffness at which the kind of the paper's vehicle changes, by bisection, to rounding."""
    vehicle = beal.catalog.tsto(0.6, 1.0, 1.0)

    def kind(stiffness):
        return solve_together(vehicle, (ROTATIONAL, SHEAR), np.array([[stiffness, 1e4]]), Solve()).kind[0]

    first = kind(low)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if kind(middle) == first else (low, middle)
    return low, high


def test_points_on_a_border_between_kinds_are_reported():
    ends = border_of(5.0, 50.0)
    vehicle = beal.catalog.tsto(0.6, 1.0, 1.0)
    values = np.array([[stiffness, 1e4] for stiffness in (*ends, 5.0, 50.0)])
    found = solve_together(vehicle, (ROTATIONAL, SHEAR), values, Solve())
    assert found.kind[2] != found.kind[3] == FLUTTER
    assert found.border[:2].any()
    assert not found.border[2:].any()


def verify(groups, vehicles):
    """The comparison with the complete search on many random points, printed."""
    compared = left = wrong = 0
    for seed in range(10_000, 10_000 + groups):
        rng = np.random.default_rng(seed)
        vehicle = random_vehicle(rng)
        paths = springs_of(vehicle)
        stiffnesses = random_stiffnesses(rng, vehicles, len(paths))
        found = solve_together(vehicle, paths, stiffnesses, Solve())
        left += int(np.sum(found.kind == UNDECIDED))
        for index in np.flatnonzero(found.kind != UNDECIDED):
            one = beal.critical_thrust(with_springs(vehicle, stiffnesses[index]), method="complete")
            compared += 1
            if not agrees(found, index, one):
                wrong += 1
                print(f"seed {seed}, vehicle {index}: {found.kind[index]} at {found.thrust[index]}, but {one}")
    print(f"{compared} vehicles compared with the complete search, {wrong} differ; {left} left to it")


if __name__ == "__main__":
    verify(*(int(argument) for argument in sys.argv[1:]))
