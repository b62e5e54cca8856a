"""A free vehicle on a foundation in proportion to its mass, whose search once lost itself in two equal frequencies.

K + c M shifts every W by c: translation and rotation, two zero roots without the foundation, are at c for every thrust.
Rotation drives translation, so they have one eigenvector only, and rounding parts them by the square root of itself.
"""

import math

import numpy as np
import pytest
import scipy.linalg

from beal.discretisation.build import discretise
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.study.map import stability_map
from beal.vehicle import Joint, Stage, Thrust, Vehicle

HINGE = {"rotational_stiffness": 50.0, "shear_stiffness": 900.0}
MASSES = {
    "uniform": ([(1.0, 1.0)], {}),
    "two stages": ([(0.6, 1.0), (0.4, 2.0)], {}),
    "joint": ([(0.6, 1.0), (0.4, 1.0)], HINGE),
    "joint that slides in a direction fixed in space": ([(0.6, 1.0), (0.4, 1.0)], HINGE | {"shear_axis": "inertial"}),
    "many": ([(1 / 14, 1.0)] * 14, {}),
}


def vehicle(stages, joint, foundation=0.0, share=1.0, **parts):
    """A foundation of so many times the mass, ``share`` of it at the last stage; drags by stage."""
    drags = parts.pop("drags", [0.0] * len(stages))
    internal = parts.pop("internal", 0.0)
    shares = [1.0] * (len(stages) - 1) + [share]
    return Vehicle(
        stages=[
            Stage(
                length=length,
                mass_per_length=mass,
                bending_stiffness=1.0,
                foundation_stiffness=foundation * mass * part,
                external_damping=drag,
                internal_damping=internal,
            )
            for (length, mass), part, drag in zip(stages, shares, drags, strict=True)
        ],
        joints=[Joint(**joint)] * (len(stages) - 1),
        **parts,
    )


def roots(beam, thrust, count=10):
    """The lowest W of a converged discretisation."""
    operators = discretise(beam, order=14)
    W = scipy.linalg.eigvals(operators.stiffness(thrust), operators.M)
    return W[np.argsort(W.real)][:count]


@pytest.mark.parametrize("method", ["fast", "complete"])
@pytest.mark.parametrize("foundation", [1e-3, 1.0, 1e2, 1e4])
@pytest.mark.parametrize("case", MASSES)
def test_a_foundation_in_proportion_to_the_mass_shifts_the_roots_alone(case, foundation, method):
    free, founded = (critical_thrust(vehicle(*MASSES[case], c), method=method) for c in (0.0, foundation))
    assert founded.critical_thrust == pytest.approx(free.critical_thrust, rel=1e-10)
    assert founded.angular_frequency == pytest.approx(math.sqrt(free.angular_frequency**2 + foundation), rel=1e-9)
    assert founded.modes == tuple(mode + 2 for mode in free.modes)
    assert founded.rigid_body == "held"


@pytest.mark.parametrize("case", MASSES)
def test_a_sweep_of_eigenvalues_sees_the_same(case):
    beam = vehicle(*MASSES[case], 100.0)
    critical = critical_thrust(beam).critical_thrust
    for share in (0.01, 0.3, 0.6, 0.9, 0.999, 1.001, 1.01):
        W = roots(beam, share * critical)
        assert np.any(np.abs(W.imag) > 1e-5 * np.abs(W)) == (share > 1)


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_the_least_other_foundation_may_flutter_much_earlier(share):
    beam = vehicle([(0.6, 1.0), (0.4, 1.0)], {}, 100.0, share)
    found = critical_thrust(beam)
    assert (found.modes, found.critical_thrust < 57.0) == ((1, 2), True)
    for factor in (0.1, 0.9, 0.99, 1.01, 1.1):
        W = roots(beam, factor * found.critical_thrust)
        assert np.any(np.abs(W.imag) > 1e-5 * np.abs(W)) == (factor > 1)


@pytest.mark.parametrize("tangency", [0.9, 0.5])
def test_translation_is_left_out_where_rotation_has_a_frequency_of_its_own(tangency):
    beam = vehicle(*MASSES["uniform"], 100.0, thrust=Thrust(tangency=tangency))
    fast, complete = (critical_thrust(beam, method=method) for method in ("fast", "complete"))
    assert (fast.modes, fast.critical_thrust) == (complete.modes, pytest.approx(complete.critical_thrust, rel=1e-11))
    below, above = (roots(beam, factor * fast.critical_thrust) for factor in (0.999, 1.001))
    assert np.abs(below.imag).max() < 1e-5 * np.abs(below).max() < np.abs(above.imag).max()
    assert fast.modes == (2, 3)  # translation, rotation, which falls to meet the first bending mode


@pytest.mark.parametrize("foundation", [1.0, 1e2, 1e4])
def test_internal_damping_lets_the_motions_on_the_foundation_alone(foundation):
    beam = vehicle(*MASSES["uniform"], foundation, internal=0.01)
    found = critical_thrust(beam)
    for factor in (0.01, 0.5, 0.999, 1.001):
        s = spectrum(discretise(beam, order=14), factor * found.critical_thrust, 8).s
        s = s[np.abs(s.imag - math.sqrt(foundation)) > 1e-5 * math.sqrt(foundation)]
        assert np.any(s.real > 0) == (factor > 1)
    limit, free = (vanishing_damping_limit(vehicle(*MASSES["uniform"], c, internal=0.01)) for c in (foundation, 0.0))
    assert limit.critical_thrust == pytest.approx(free.critical_thrust, rel=1e-10)
    assert limit.angular_frequency == pytest.approx(math.sqrt(free.angular_frequency**2 + foundation), rel=1e-9)


@pytest.mark.parametrize(
    ("stages", "drags", "power"),
    [
        ([(0.6, 1.0), (0.4, 1.0)], [0.1, 0.2], 1.0),  # couples the two
        ([(1 / 3, 1.0)] * 3, [0.1, 0.3, 0.1], 0.5),  # through bending, in which thrust has a part
    ],
)
def test_a_drag_that_couples_the_two_motions_leaves_no_load_as_it_vanishes(stages, drags, power):
    def dragged(share):
        return vehicle(stages, {}, 100.0, drags=[share * drag for drag in drags])

    loads = [critical_thrust(dragged(share), tolerance=1e-6).critical_thrust for share in (1e-1, 1e-2, 1e-3)]
    falls = [math.log10(a / b) for a, b in zip(loads, loads[1:], strict=False)]
    assert falls == pytest.approx([power, power], abs=1e-2)
    limit = vanishing_damping_limit(dragged(1.0))
    assert (limit.critical_thrust, limit.kind, limit.angular_frequency) == (0.0, "flutter", pytest.approx(10.0))


def test_events_and_maps_number_the_modes_alike():
    beam = vehicle(*MASSES["joint"], 100.0)
    first = critical_events(beam)[0]
    assert (first.modes, first.before, first.unstable) == ((3, 4), 0, 2)
    chart = stability_map(beam, {"joint[0].rotational_stiffness": [20.0, 50.0]})
    assert chart["critical_thrust"].values[-1] == pytest.approx(first.thrust, rel=1e-6)
    assert chart["mode_low"].values.tolist() == [3, 3]
