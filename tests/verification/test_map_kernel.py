"""The tables that maps over joints are solved with, against the search that looks at one vehicle at a time."""

import math

import numpy as np
import pytest

import beal
from beal.stability.scan import UNDECIDED
from beal.study.batch import solve_springs
from beal.study.study import Solve

SPRINGS = ((0, "rotational_stiffness"), (0, "shear_stiffness"))
KINDS = {0: "stable", 1: "flutter", 2: "divergence"}


def random_vehicle(rng):
    vehicle = beal.catalog.tsto(rng.uniform(0.05, 0.95), 1.0, 1.0)
    changes = {}
    if rng.random() < 0.4:
        lump = beal.PointMass(station=rng.uniform(0, 1), mass=10 ** rng.uniform(-2, 0.5))
        changes["point_masses"] = (lump,)
    if rng.random() < 0.3:
        changes["support"] = beal.Support(nose="clamped")
        changes["thrust"] = beal.Thrust(tangency=rng.uniform(0, 1))
    return vehicle.model_copy(update=changes)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("formulation", ["objective", "converged"])
def test_tables_agree_with_the_search_for_one_vehicle_or_leave_it_to_that(seed, formulation):
    rng = np.random.default_rng(seed)
    vehicle = random_vehicle(rng)
    springs = 10 ** rng.uniform(-2, 12, (60, 2))
    springs[::15, 0] = math.inf
    springs[1::15, 1] = math.inf
    kinds, values = solve_springs(vehicle, SPRINGS, springs, Solve(formulation=formulation))
    assert np.mean(kinds == UNDECIDED) < 0.5  # else the comparison below would say little
    for index in rng.choice(np.flatnonzero(kinds != UNDECIDED), 12, replace=False):
        rotational, shear = springs[index]
        joint = beal.Joint(rotational_stiffness=rotational, shear_stiffness=shear)
        one = beal.critical_thrust(vehicle.model_copy(update={"joints": (joint,)}), formulation=formulation)
        assert KINDS[int(kinds[index])] == one.kind
        if one.kind == "stable":
            continue
        thrust, mode, omega, error = values[:, index]
        assert mode == one.modes[0]
        assert abs(thrust - one.critical_thrust) <= error + one.error_estimate
        assert omega == pytest.approx(one.angular_frequency, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("split", [0.2, 0.4, 0.6, 0.8])
def test_tables_decide_nearly_all_of_the_papers_maps(split):
    grid = [(r, s) for r in np.geomspace(1, 1e4, 20) for s in np.geomspace(1e2, 1e4, 20)]
    kinds, values = solve_springs(beal.catalog.tsto(split, 1.0, 1.0), SPRINGS, np.array(grid), Solve(tolerance=1e-8))
    assert np.mean(kinds == UNDECIDED) < 0.02
    assert np.nanmax(values[3] / values[0]) < 1e-8
