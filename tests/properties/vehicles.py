"""Seeded random vehicles, non-dimensional in the sense that length, mass and stiffness are of order one."""

import math
from collections.abc import Iterator

import numpy as np

from beal.vehicle.parts import Damping, Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle

AXES = ("mean", "forward", "aft", "inertial")
SUPPORTS = (
    ("clamped", "free"),
    ("clamped", "pinned"),
    ("clamped", "sliding"),
    ("pinned", "free"),
    ("pinned", "pinned"),
    ("sliding", "free"),
    ("free", "clamped"),
    ("free", "pinned"),
)


def random_vehicles(count: int, seed: int, **options: float) -> Iterator[Vehicle]:
    """Independent draws of `random_vehicle`: the same seed gives the same vehicles, whatever is asked of them."""
    for child in np.random.default_rng(seed).spawn(count):
        yield random_vehicle(child, **options)


def random_vehicle(
    rng: np.random.Generator, softest: float = 1e-2, stiffest: float = 1e12, absent: float = 0.03, held: float = 0.5
) -> Vehicle:
    """One to five stages of unlike properties, any joints, masses and supports.

    Springs are log-uniform from ``softest`` to ``stiffest`` in units of EI/L and EI/L^3, one in five is rigid and a
    share ``absent`` of them is missing; a share ``held`` of the vehicles is supported.
    """
    stages = random_stages(rng)
    return Vehicle(
        stages=stages,
        joints=[random_joint(rng, softest, stiffest, absent) for _ in stages[1:]],
        point_masses=random_masses(rng, sum(stage.length for stage in stages)),
        support=random_support(rng) if rng.random() < held else Support(),
        thrust=Thrust(tangency=1.0 if rng.random() < 0.6 else rng.uniform(0.0, 1.2)),
    )


def sheared(vehicle: Vehicle, rng: np.random.Generator) -> Vehicle:
    """The vehicle with stages that shear, have rotary inertia, both, or neither, and now and then a rigid one."""
    stages = [
        stage.model_copy(
            update={
                "shear_stiffness": 10 ** rng.uniform(2, 5) if rng.random() < 0.7 else math.inf,
                "rotary_inertia_per_length": 10 ** rng.uniform(-5, -3) if rng.random() < 0.5 else 0.0,
                "bending_stiffness": math.inf if rng.random() < 0.1 else stage.bending_stiffness,
            }
        )
        for stage in vehicle.stages
    ]
    forms = {"along": ("slope", "section")[rng.integers(2)], "axial_term": ("engesser", "haringx")[rng.integers(2)]}
    return vehicle.model_copy(update={"stages": stages, "thrust": vehicle.thrust.model_copy(update=forms)})


def random_long_vehicle(rng: np.random.Generator, stages: int) -> Vehicle:
    """A vehicle of many stages, from alike to very unlike in length, on joints from soft to rigid."""
    lengths = np.maximum(rng.dirichlet(np.full(stages, rng.choice([0.5, 2.0, 20.0]))), 1e-4)
    return Vehicle(
        stages=[
            Stage(
                length=x, mass_per_length=10 ** rng.uniform(-0.5, 0.5), bending_stiffness=10 ** rng.uniform(-0.5, 0.5)
            )
            for x in lengths.tolist()
        ],
        joints=[random_joint(rng, 1.0, 1e12, absent=0.0) for _ in range(stages - 1)],
        point_masses=random_masses(rng, float(lengths.sum())),
        support=random_support(rng) if rng.random() < 0.5 else Support(),
        thrust=Thrust(tangency=1.0 if rng.random() < 0.6 else rng.uniform(0.0, 1.2)),
    )


def random_stages(rng: np.random.Generator) -> list[Stage]:
    """One to five stages of total length 1, none shorter than 0.05."""
    number = int(rng.integers(1, 6))
    lengths = 0.05 + (1 - 0.05 * number) * rng.dirichlet(np.ones(number))
    return [
        Stage(
            length=length, mass_per_length=10 ** rng.uniform(-0.5, 0.5), bending_stiffness=10 ** rng.uniform(-0.5, 0.5)
        )
        for length in lengths.tolist()
    ]


def random_joint(rng: np.random.Generator, softest: float, stiffest: float, absent: float) -> Joint:
    """A joint along any shear axis."""
    springs = [random_spring(rng, softest, stiffest, absent) for _ in range(2)]
    return Joint(rotational_stiffness=springs[0], shear_stiffness=springs[1], shear_axis=AXES[rng.integers(4)])


def random_spring(rng: np.random.Generator, softest: float, stiffest: float, absent: float) -> float:
    """Log-uniform, sometimes infinite, rarely zero."""
    kind = rng.random()
    if kind < 0.2:
        return math.inf
    return 0.0 if kind < 0.2 + absent else float(10 ** rng.uniform(math.log10(softest), math.log10(stiffest)))


def random_masses(rng: np.random.Generator, length: float) -> list[PointMass]:
    """None to two, one in three with rotary inertia; one in four sits at the tail."""
    return [
        PointMass(
            station=length if rng.random() < 0.25 else rng.uniform(0.0, length),
            mass=10 ** rng.uniform(-2, 0),
            rotary_inertia=10 ** rng.uniform(-4, -2) if rng.random() < 1 / 3 else 0.0,
        )
        for _ in range(rng.integers(3))
    ]


def random_support(rng: np.random.Generator) -> Support:
    """Any of the usual pairs of ends."""
    nose, tail = SUPPORTS[rng.integers(len(SUPPORTS))]
    return Support(nose=nose, tail=tail)


def with_random_damping(rng: np.random.Generator, vehicle: Vehicle) -> Vehicle:
    """The vehicle with losses inside its stages, and around them, in its joints and of its modes, each there or not."""

    def some(lowest: float, highest: float) -> float:
        return float(10 ** rng.uniform(lowest, highest)) if rng.random() < 0.7 else 0.0

    stages = [
        s.model_copy(update={"internal_damping": 10 ** rng.uniform(-4, -2), "external_damping": some(-1, 1)})
        for s in vehicle.stages
    ]
    joints = [
        j.model_copy(update={"rotational_damping": some(-3, 0), "shear_damping": some(-3, 0)}) for j in vehicle.joints
    ]
    ratios = tuple(rng.uniform(0.005, 0.03, size=2).tolist()) if rng.random() < 0.5 else ()
    parts = {"stages": tuple(stages), "joints": tuple(joints), "damping": Damping(ratios=ratios)}
    return vehicle.model_copy(update=parts)
