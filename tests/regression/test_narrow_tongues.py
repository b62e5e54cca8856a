"""First instabilities over a narrow range of thrust, which coarse steps once passed over."""

import numpy as np
import pytest

from beal.stability.critical import critical_thrust
from beal.study.batch import solve_together
from beal.study.study import Solve
from beal.vehicle.parts import Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle


def vehicle(stages, joints, masses, **parts):
    return Vehicle(
        units="nondimensional",
        stages=[Stage(length=a, mass_per_length=b, bending_stiffness=c) for a, b, c in stages],
        joints=[Joint(rotational_stiffness=r, shear_stiffness=s) for r, s in joints],
        point_masses=[PointMass(station=x, mass=m) for x, m in masses],
        **parts,
    )


# Four springs of 0.02: flutter of modes 1 and 2 from 0.184 to 0.370 in a search to 380.
VERY_SOFT = vehicle(
    [(0.3406, 1, 0.3531), (0.07366, 1, 0.3374), (0.0361, 1, 0.6196), (0.3518, 1.09, 1.159), (0.1978, 1, 1)],
    [(31.6, 0.0303), (5.67e7, 1.1e4), (6.98e7, 0.0146), (0.0305, 0.0181)],
    [(0.0638, 0.104), (0.937, 0.0614)],
)
# Flutter of modes 2 and 3 from 10.199 to 10.318, of modes 1 and 2 from 10.936.
TWO_IN_A_ROW = vehicle(
    [(0.2099, 0.9348, 4.553), (0.3186, 1.643, 1.2), (0.2261, 0.8842, 1), (0.1244, 1, 1), (0.1211, 1, 1)],
    [(2.54e10, 7.4e11), (7170, 2.2e8), (6.78e8, 2.07), (2.12e8, 14.4)],
    [(0.559, 0.539)],
    support=Support(nose="clamped"),
    thrust=Thrust(tangency=0.9059367078953212),
)
CASES = pytest.mark.parametrize(
    ("vehicle", "thrust", "modes"),
    [(VERY_SOFT, 0.18355372779, (1, 2)), (TWO_IN_A_ROW, 10.1987394182, (2, 3))],
    ids=["very soft", "two in a row"],
)


@CASES
@pytest.mark.parametrize("method", ["fast", "complete"])
def test_the_search_for_one_vehicle_finds_it(vehicle, thrust, modes, method):
    found = critical_thrust(vehicle, method=method)
    assert (found.kind, found.modes) == ("flutter", modes)
    assert found.critical_thrust == pytest.approx(thrust, rel=1e-9)


@CASES
def test_the_tables_of_a_map_find_it(vehicle, thrust, modes):
    paths = ("joint[2].shear_stiffness", "joint[3].rotational_stiffness", "joint[3].shear_stiffness")
    last = vehicle.joints[3]
    springs = [vehicle.joints[2].shear_stiffness, last.rotational_stiffness, last.shear_stiffness]
    found = solve_together(vehicle, paths, np.array([springs] * 4), Solve())  # for fewer, tables are not worth it
    assert (found.kind[0], found.mode[0]) == (1, modes[0])
    assert found.thrust[0] == pytest.approx(thrust, rel=1e-8)
