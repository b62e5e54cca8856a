"""Vehicles of many stages: sparse matrices and a reduction against dense ones, exact values and transfer matrices."""

from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg
from numpy.polynomial import Chebyshev
from scipy.optimize import brentq

from beal.discretisation.build import discretise
from beal.discretisation.linked import linked
from beal.errors import ModelError
from beal.stability import large
from beal.stability.critical import CriticalThrust, critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.limit import default_limit
from beal.stability.modes import converged_modes
from beal.stability.spectrum import spectrum
from beal.vehicle.parts import Force, Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.signals import Step
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_long_vehicle

MANY = 1000
DENSE, SPARSE = 10**9, 0  # segments from which the sparse route is taken
SPRINGS = Joint(rotational_stiffness=2e3, shear_stiffness=2e5)  # each; together as soft as the beam of 1000 stages


def chain(stages: int, joint: Joint | None = None, **parts: object) -> Vehicle:
    """A uniform vehicle of EI = m = L = 1 in equal stages."""
    stage = Stage(length=1 / stages, mass_per_length=1.0, bending_stiffness=1.0)
    return Vehicle(stages=[stage] * stages, joints=[joint or Joint()] * (stages - 1), **parts)


def both_ways(solve: Callable[[], object], monkeypatch: pytest.MonkeyPatch) -> list:
    """What dense and what sparse matrices give."""
    found = []
    for segments in (DENSE, SPARSE):
        monkeypatch.setattr(large, "SEGMENTS", segments)
        found.append(solve())
    return found


def assert_same(dense: CriticalThrust, sparse: CriticalThrust) -> None:
    assert (sparse.kind, sparse.modes, sparse.rigid_body) == (dense.kind, dense.modes, dense.rigid_body)
    assert sparse.searched_to == dense.searched_to
    assert sparse.critical_thrust == pytest.approx(dense.critical_thrust, rel=1e-9)
    # a double root is good to the square root of the thrust's precision, and less where it lies near zero
    assert sparse.angular_frequency == pytest.approx(dense.angular_frequency, rel=1e-6)


@pytest.mark.parametrize("seed", [0, 2, 7, 12, 19, 26, 28, 32])
def test_modes_of_a_random_vehicle_over_thrust_are_those_of_dense_matrices(seed, monkeypatch):
    rng = np.random.default_rng([11, seed])
    vehicle = random_long_vehicle(rng, int(rng.integers(5, 22)))
    formulation = "converged" if seed % 4 == 3 else "objective"
    found = critical_thrust(vehicle, formulation=formulation)
    to = 1.3 * (found.elastic or found).critical_thrust
    dense, sparse = (
        np.sort_complex(curve.angular_frequency + 1j * curve.growth_rate)
        for curve in both_ways(lambda: thrust_curve(vehicle, to, 25, 4, formulation), monkeypatch)
    )
    stable, highest = slice(18), np.abs(dense).max()
    assert np.abs(sparse - dense)[stable].max() < 1e-8 * highest
    assert np.abs(sparse - dense).max() < 1e-5 * highest  # roots that have met go as the square root
    exact = spectrum(discretise(vehicle, formulation, order=14), to, 4)
    assert sparse[-1].imag.max() == pytest.approx(exact.growth_rate.max(), rel=1e-3)


@pytest.mark.parametrize("seed", range(40))
def test_random_vehicle_bears_what_it_does_with_dense_matrices(seed, monkeypatch):
    rng = np.random.default_rng([11, seed])
    vehicle = random_long_vehicle(rng, int(rng.integers(5, 22)))
    formulation = "converged" if seed % 4 == 3 else "objective"
    dense, sparse = both_ways(lambda: critical_thrust(vehicle, formulation=formulation), monkeypatch)
    assert_same(dense.elastic or dense, sparse.elastic or sparse)
    assert (dense.elastic is None) == (sparse.elastic is None)


def test_forty_stages_bear_what_they_do_with_dense_matrices(monkeypatch):
    vehicle = random_long_vehicle(np.random.default_rng(5), 40)
    assert_same(*both_ways(lambda: critical_thrust(vehicle), monkeypatch))


@pytest.mark.parametrize("thrust", [0.0, 50.0, 150.0])  # unloaded, loaded, in flutter
@pytest.mark.parametrize("support", [Support(), Support(nose="clamped"), Support(nose="pinned", tail="pinned")])
def test_frequencies_are_those_of_dense_matrices(thrust, support, monkeypatch):
    vehicle = chain(8, SPRINGS, support=support, point_masses=[PointMass(station=0.3, mass=0.2, rotary_inertia=1e-3)])
    dense, sparse = both_ways(lambda: converged_modes(vehicle, thrust, 8)[0].W, monkeypatch)
    np.testing.assert_allclose(sparse, dense, rtol=1e-8)


def test_all_events_are_those_of_dense_matrices(monkeypatch):
    vehicle = chain(6, Joint(rotational_stiffness=50.0))
    dense, sparse = both_ways(lambda: critical_events(vehicle), monkeypatch)
    assert len(dense) > 1
    assert [event.thrust for event in sparse] == pytest.approx([event.thrust for event in dense], rel=1e-7)
    assert [(e.kind, e.modes, e.change) for e in sparse] == [(e.kind, e.modes, e.change) for e in dense]


@pytest.mark.parametrize("support", [Support(), Support(nose="pinned"), Support(nose="clamped", tail="pinned")])
@pytest.mark.parametrize("spring", ["rotational_stiffness", "shear_stiffness"])
def test_hinges_and_sliders_give_way_as_with_dense_matrices(support, spring, monkeypatch):
    whole = chain(8, SPRINGS, support=support)
    loose = [joint.model_copy(update={spring: 0.0} if n in (2, 4) else {}) for n, joint in enumerate(whole.joints)]
    vehicle = whole.model_copy(update={"joints": loose})
    assert_same(*both_ways(lambda: critical_thrust(vehicle), monkeypatch))


def test_stable_vehicle_is_stable(monkeypatch):
    vehicle = chain(8)
    dense, sparse = both_ways(lambda: critical_thrust(vehicle, max_thrust=100.0), monkeypatch)
    assert (dense, dense.kind) == (sparse, "stable")
    assert dense.watched_modes == sparse.watched_modes == 8


@pytest.mark.parametrize(
    ("parts", "thrust", "digits", "omega"),
    [
        ({}, 109.689191958738, 1e-11, 23.073329884381),
        ({"support": Support(nose="clamped")}, 20.0509536, 5e-8, 11.0155576),
        (
            {"support": Support(nose="clamped"), "point_masses": [PointMass(station=1.0, mass=0.5)]},
            16.061562,
            5e-7,
            7.23706,
        ),
    ],
    ids=["Beal", "Beck", "Pflueger"],
)
def test_a_thousand_rigidly_joined_stages_are_one_beam(parts, thrust, digits, omega):
    found = critical_thrust(chain(MANY, **parts))
    assert (found.kind, found.modes) == ("flutter", (1, 2))
    assert found.critical_thrust == pytest.approx(thrust, rel=0, abs=digits)
    assert found.angular_frequency == pytest.approx(omega, rel=1e-6)
    assert found.error_estimate < 1e-10


def test_all_but_rigid_joints_lose_no_digits():
    joint = Joint(rotational_stiffness=1e17, shear_stiffness=1e17)
    found = critical_thrust(chain(MANY, joint))
    assert found.critical_thrust == pytest.approx(109.689191958738, rel=1e-11)  # compliances together: 1e-12
    assert found.error_estimate < 1e-10


class TransferMatrices:
    """The equations of a uniform vehicle with equal springs at every joint, integrated from nose to tail.

    The state is (y, y', M, S) with M = EI y'' and the transverse force S = M' + N y'; exact up to the fourth power of
    a stage's length where N varies along it (Magnus), which for a thousand stages is 1e-12.
    """

    def __init__(self, stages: int, joint: Joint, clamped: bool) -> None:
        self.stages, self.joint, self.clamped = stages, joint, clamped

    def __call__(self, thrust: float, W: np.ndarray) -> np.ndarray:
        """The determinant of the tail's conditions for several W."""
        step = 1 / self.stages
        middle = thrust * (np.ones(self.stages) if self.clamped else step * (np.arange(self.stages) + 0.5))
        slope = np.zeros((4, 4))
        slope[2, 1] = 0.0 if self.clamped else -thrust
        A = np.zeros((len(W), self.stages, 4, 4))
        A[..., 0, 1] = A[..., 1, 2] = A[..., 2, 3] = 1.0
        A[..., 2, 1] = -middle
        A[..., 3, 0] = W[:, None]
        stages = scipy.linalg.expm(step * A + step**3 / 12 * (slope @ A - A @ slope))
        state = np.zeros((len(W), 4, 2))
        state[:, (2, 3) if self.clamped else (0, 1), (0, 1)] = 1.0
        for index in range(self.stages):
            state = stages[:, index] @ state
            if index < self.stages - 1:
                state = self._across(thrust * (1.0 if self.clamped else step * (index + 1))) @ state
        tail = np.stack((state[:, 2], state[:, 3] - thrust * state[:, 1]), axis=1)
        return np.linalg.det(tail)

    def _across(self, N: float) -> np.ndarray:
        """k_s d = N sigma - S and k_r kappa = M - N d / 2, with sigma the mean slope; the moment drops by N d."""
        springs = np.array([[self.joint.shear_stiffness, -N / 2], [N / 2, self.joint.rotational_stiffness]])
        d, kappa = np.linalg.solve(springs, [[0, N, 0, -1], [0, 0, 1, 0]])
        return np.eye(4) + np.array([d, kappa, -N * d, np.zeros(4)])

    def ridge(self, thrust: float, W: float) -> float:
        """The extremum over W of the determinant next to W."""
        determinant = Chebyshev.interpolate(lambda w: self(thrust, w), 8, [0.95 * W, 1.05 * W])
        extrema = determinant.deriv().roots()
        return float(determinant(extrema[np.abs(extrema - W).argmin()].real))


@pytest.mark.parametrize("clamped", [True, False])
def test_springs_at_every_joint_of_a_thousand_stages(clamped):
    vehicle = chain(MANY, SPRINGS, support=Support(nose="clamped" if clamped else "free"))
    exact = TransferMatrices(MANY, SPRINGS, clamped)
    found = critical_thrust(vehicle)
    assert (found.kind, found.modes) == ("flutter", (1, 2))
    P, W = found.critical_thrust, found.angular_frequency**2
    thrust = brentq(exact.ridge, P * (1 - 1e-6), P * (1 + 1e-6), args=(W,), xtol=1e-11)
    assert thrust == pytest.approx(P, rel=1e-9)
    omega = converged_modes(vehicle, P / 2, 4)[0].angular_frequency
    sides = exact(P / 2, np.concatenate((omega**2 * (1 - 1e-8), omega**2 * (1 + 1e-8))))
    assert np.all(sides[:4] * sides[4:] < 0)


def test_stick_model_of_masses_on_a_light_beam_is_a_beam():
    # The error of lumping equal masses in the middle of equal stages falls with the square of their number.
    stage = Stage(length=1 / 400, mass_per_length=1e-6, bending_stiffness=1.0)
    lumps = [PointMass(station=(i + 0.5) / 400, mass=1 / 400, rotary_inertia=400**-3 / 12) for i in range(400)]
    found = critical_thrust(Vehicle(stages=[stage] * 400, joints=[Joint()] * 399, point_masses=lumps))
    assert found.critical_thrust == pytest.approx(109.689191958738, rel=2e-5)
    assert found.angular_frequency == pytest.approx(23.073329884381, rel=2e-5)


def test_sparse_matrices_are_the_dense_ones_in_other_coordinates():
    free = random_long_vehicle(np.random.default_rng(3), 7)
    vehicle = free.model_copy(update={"support": Support(nose="clamped", tail="pinned")})
    dense, sparse = discretise(vehicle, order=4), linked(vehicle, order=4)
    span = scipy.linalg.null_space(sparse.B.toarray())
    assert span.shape[1] == len(dense.M)
    roots = [
        scipy.linalg.eigvals(M, K0 + sparse.shift * M + 5.0 * K1)
        for M, K0, K1 in (
            (dense.M, dense.K0, dense.K1),
            tuple(span.T @ (matrix @ span) for matrix in (sparse.M, sparse.K0, sparse.K1)),
        )
    ]
    one, other = (np.sort(inverse.real)[-6:] for inverse in roots)
    np.testing.assert_allclose(one, other, rtol=1e-9)


def test_shapes_of_the_reduced_vehicle_are_continuous_and_held():
    vehicle = chain(40, support=Support(nose="clamped"), thrust=Thrust(tangency=0.5))
    operators = large.Reduction(vehicle, "objective").operators
    joints = np.array(vehicle.boundaries[1:-1])
    size = np.abs(operators.shape([1.0])).max()
    for derivative in (0, 1):
        aft, forward = (operators.shape(joints, derivative, side) for side in ("aft", "forward"))
        np.testing.assert_allclose(aft, forward, atol=1e-13 * size)
        np.testing.assert_allclose(operators.shape([0.0], derivative), 0.0, atol=1e-13 * size)


def test_limit_of_the_search_is_that_of_one_beam_and_sees_forces_and_masses_once():
    force = Force(station=0.5, signal=Step(kind="step", amplitude=1.0))
    assert default_limit(chain(MANY, forces=[force])) == pytest.approx(default_limit(chain(1)), rel=1e-2)


def test_dense_matrices_of_a_large_vehicle_are_refused():
    with pytest.raises(ModelError, match="too many for dense matrices"):
        discretise(chain(MANY))
    with pytest.raises(ModelError, match="default basis"):
        critical_thrust(chain(MANY), basis="hermite")


def test_formulations_that_do_not_apply_are_refused():
    with pytest.raises(ModelError, match="formulation: must be one of"):
        critical_thrust(chain(MANY), formulation="exact")
    with pytest.raises(ModelError, match="two stages, found 1000"):
        critical_thrust(chain(MANY), formulation="as-printed")
