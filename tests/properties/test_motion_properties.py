"""Laws of the motion of damped vehicles, whatever the vehicle: where its energy goes, and how fast it grows."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from beal.discretisation.basis import Combined
from beal.discretisation.build import discretise
from beal.discretisation.operators import Operators
from beal.motion import Samples, growth_rate, response
from beal.motion.reduction import free_modes
from beal.stability.damped_roots import damped_roots
from beal.stability.pencil import pencil
from beal.vehicle import AxialLoad, Force, Sensor, Sine
from beal.vehicle.vehicle import Vehicle
from properties.vehicles import random_vehicle, with_random_damping

FEW = settings(max_examples=8, deadline=None, derandomize=True)
SEEDS = st.integers(0, 10**6)
ELASTIC = 4  # modes


def damped(rng: np.random.Generator) -> Vehicle:
    """Under a thrust, drag at its nose and a swinging force, with a sensor at its tail."""
    vehicle = with_random_damping(rng, random_vehicle(rng, softest=1.0, stiffest=1e4, absent=0.0))
    drag = AxialLoad(station=0.0, force=-float(rng.uniform(0, 2)), tangency=float(rng.uniform(0, 1)))
    swing = Sine(kind="sine", amplitude=1.0, angular_frequency=float(rng.uniform(2, 20)))
    return vehicle.model_copy(
        update={
            "axial_loads": (drag,),
            "forces": (Force(station=float(rng.uniform(0, vehicle.length)), signal=swing),),
            "sensors": (Sensor(name="tail", station=vehicle.length),),
        }
    )


def few_modes(vehicle: Vehicle) -> Operators:
    """A vehicle that has no more than its lowest modes, all of which a step resolves."""
    full = discretise(vehicle)
    V = free_modes(full)[2][:, : full.rigid + ELASTIC]
    M, K0, K1, C, dead = (V.T @ matrix @ V for matrix in (full.M, full.K0, full.K1, full.C, full.dead))
    basis = Combined(full.basis.basis, full.basis.transformation @ V)
    return replace(full, M=M, K0=K0, K1=K1, C=C, dead=dead, basis=basis)


def bent(rng: np.random.Generator, vehicle: Vehicle) -> Samples:
    stations = np.linspace(0.0, vehicle.length, 12)
    return Samples(stations, np.polyval(rng.normal(size=4), stations), np.polyval(rng.normal(size=3), stations))


def unbalanced(operators: Operators, thrust: float, start: Samples, duration: float, steps: int, **how) -> float:
    """The most that is ever missing of the energy, beside the largest: change - work of the loads + dissipation.

    Simpson's rule, of order four, integrates the powers.
    """
    motion = response(operators, duration, thrust, step=duration / steps, initial=start, modes=ELASTIC, **how)
    q, rate, force = motion.coordinates, motion.coordinate_rates, operators.vehicle.forces[0]
    energy = np.einsum("ki,ij,kj->k", rate, operators.M, rate) + np.einsum("ki,ij,kj->k", q, operators.K0, q)
    push = force.signal.amplitude * np.sin(force.signal.angular_frequency * motion.time)
    power = push * (rate @ operators.shape(force.station)[0])
    power -= np.einsum("ki,ij,kj->k", rate, operators.stiffness(thrust) - operators.K0, q)
    power -= np.einsum("ki,ij,kj->k", rate, operators.C, rate)
    work = np.cumsum(motion.time[1] / 3 * (power[:-2:2] + 4 * power[1::2] + power[2::2]))
    return float(np.abs((energy[2::2] - energy[0]) / 2 - work).max() / energy.max())


@pytest.mark.filterwarnings("ignore::beal.motion.steps.CoarseStepWarning")
@pytest.mark.parametrize(("method", "beta", "order"), [("newmark", 0.25, 2), ("newmark", 1 / 6, 2), ("exact", 0.25, 4)])
@FEW
@given(SEEDS)
def test_the_work_of_all_loads_less_what_is_dissipated_is_the_change_of_energy(method, beta, order, seed):
    """The error falls with the order of the method, or of the rule that integrates the powers where it has none."""
    rng = np.random.default_rng(seed)
    vehicle = damped(rng)
    operators, start, thrust = few_modes(vehicle), bent(rng, vehicle), float(rng.uniform(0, 30))
    highest = float(np.abs(damped_roots(pencil(operators), thrust)).max())
    coarse = 2 * math.ceil(4 * highest)  # steps in a unit of time, of which the highest mode moves on by an eighth
    far, near = (unbalanced(operators, thrust, start, 1.0, n, method=method, beta=beta) for n in (coarse, 2 * coarse))
    assert math.log2(far / near) == pytest.approx(order, abs=0.15)
    assert near < 1e-3


@pytest.mark.parametrize("method", ["newmark", "exact"])
@FEW
@given(SEEDS)
def test_a_motion_grows_as_the_fastest_root_says(method, seed):
    rng = np.random.default_rng(seed)
    vehicle = damped(rng).model_copy(update={"forces": ()})
    operators = few_modes(vehicle)
    for thrust in rng.uniform(5, 200, size=20).tolist():
        s = damped_roots(pencil(operators), thrust)
        s = s[s.imag >= 0][np.argsort(-s.real[s.imag >= 0])]
        apart = s[0].real - s[1].real
        if s[0].real > 0.2 and apart > 0.1:
            break
    else:
        assume(False)
    duration = max(25.0 / apart, 100.0 / (s[0].imag or 1.0))
    assume(duration * s[0].real < 600)
    motion = response(operators, duration, thrust, initial=bent(rng, vehicle), modes=ELASTIC, method=method)
    assert growth_rate(motion, "tail") == pytest.approx(s[0].real, rel=1e-2)
