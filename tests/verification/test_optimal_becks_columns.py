"""Beck's columns of six equal segments and of one volume: the optimum reaches what local searches had found.

Lower bounds on the gain over the uniform column, from searches with an exact transfer matrix: 3.3591 for EI ~ A and
3.5671 for EI ~ A^2, 3.1528 for EI ~ A^3.
"""

import numpy as np
import pytest

from beal import DesignSpace, Joint, LinearBound, Link, Stage, Support, Variable, Vehicle, critical_events, optimise
from beal.design.worth import Task

BECK = 20.0509536
AREAS = [f"stage[{n}].mass_per_length" for n in range(6)]
NEAR = {  # where long searches led
    1: (0.7565, 2.0328, 1.6126, 0.7923, 0.5671, 0.2387),
    2: (0.7395015531, 1.5069641324, 1.6646097446, 0.8281137363, 0.8273342511, 0.4334765826),  # at a cliff
    3: (0.8136, 1.3525, 1.368, 0.992, 0.8732, 0.6007),
}


def columns(power):
    stages = tuple(Stage(length=1 / 6, mass_per_length=1.0, bending_stiffness=1.0) for _ in AREAS)
    column = Vehicle(
        stages=stages,
        joints=tuple(Joint() for _ in AREAS[1:]),
        support=Support(nose="clamped", tail="free"),
        units="nondimensional",
    )
    links = {path.replace("mass_per_length", "bending_stiffness"): Link(path, power=power) for path in AREAS}
    volume = LinearBound(dict.fromkeys(AREAS, 1.0), 6.0, 6.0)
    return DesignSpace(column, dict.fromkeys(AREAS, Variable(0.1, 3.0)), links, [volume])


def first_unstable(areas, power, thrusts):
    """The first thrust of a sweep at which a root is not real and positive: cubic elements of its own."""
    each = 16  # eight would let modes meet that only come close, those of EI ~ A^2 at 74
    n = 6 * each
    h = 1 / n
    K, G, M = np.zeros((3, 2 * n + 2, 2 * n + 2))
    bending = np.array(
        [[12, 6 * h, -12, 6 * h], [0, 4 * h * h, -6 * h, 2 * h * h], [0, 0, 12, -6 * h], [0, 0, 0, 4 * h * h]]
    )
    string = np.array(
        [[36, 3 * h, -36, 3 * h], [0, 4 * h * h, -3 * h, -h * h], [0, 0, 36, -3 * h], [0, 0, 0, 4 * h * h]]
    )
    inertia = np.array(
        [[156, 22 * h, 54, -13 * h], [0, 4 * h * h, 13 * h, -3 * h * h], [0, 0, 156, -22 * h], [0, 0, 0, 4 * h * h]]
    )
    bending, string, inertia = (np.triu(one) + np.triu(one, 1).T for one in (bending, string, inertia))
    for e in range(n):
        area, at = areas[e // each], slice(2 * e, 2 * e + 4)
        K[at, at] += area**power * bending / h**3
        G[at, at] += string / (30 * h)
        M[at, at] += area * inertia * h / 420
    G[-2, -1] -= 1.0  # follower: + P y'(L) dy(L)
    K, G, M = (matrix[2:, 2:] for matrix in (K, G, M))
    for thrust in thrusts:
        inverse = np.linalg.eigvals(np.linalg.solve(K - thrust * G, M))
        lowest = 1 / inverse[np.argsort(-np.abs(inverse))][:10]
        if lowest.real.min() < 0 or np.any(np.abs(lowest.imag) > 1e-6 * lowest.real):
            return thrust
    return None


@pytest.mark.parametrize(("power", "known", "gain"), [(1, 3.3591, 4.47), (2, 3.5671, 4.31), (3, 3.1528, 3.53)])
def test_the_optimum_is_beyond_what_was_known_and_true(power, known, gain):
    best = optimise(columns(power), start=dict(zip(AREAS, NEAR[power], strict=True)), iterations=2)
    thrust = best.critical.critical_thrust
    assert sum(best.values.values()) == pytest.approx(6.0, abs=1e-9)
    assert thrust > gain * BECK > known * BECK
    assert best.second.critical_thrust == pytest.approx(thrust, rel=1e-4)
    sweep = np.append(np.arange(0.1, thrust * (1 - 1e-3), 0.6), thrust * (1 + 1e-3))
    assert first_unstable(list(best.values.values()), power, sweep) == sweep[-1]


def test_slopes_of_all_instabilities_are_those_of_differences():
    space = columns(2)
    place = space.shares(dict(zip(AREAS, (1.5, 1.3, 1.1, 0.9, 0.7, 0.5), strict=True)))

    def thrusts(at):
        return np.array([event.thrust for event in critical_events(space.at(at), 200.0)])

    task = Task(space)
    found = np.array([cut.slope for cut in task.cuts(task.seen(place), 10.0) if cut.ratio < 200.0])
    for axis, side in enumerate(1e-4 * np.eye(6)):
        wide, narrow = ((thrusts(place + h * side) - thrusts(place - h * side)) / (2e-4 * h) for h in (2, 1))
        assert found[:, axis] == pytest.approx((4 * narrow - wide) / 3, rel=1e-6, abs=1e-5)
