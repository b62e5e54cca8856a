"""Frequencies of decks that others wrote, against other programs' answers."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

from beal.interop.nastran import read_nastran
from beal.interop.stations import read_stations
from beal.stability.modes import converged_modes
from beal.vehicle.parts import Joint, PointMass
from beal.vehicle.vehicle import Vehicle

ROOT = Path(__file__).parents[2]
STICK = ROOT / "examples" / "plain_stick.bdf"
DATA = ROOT / "tests" / "data"
LUMPED = [1.480870, 3.940794, 6.803498, 11.32002, 16.76928]
CONTINUOUS = [1.496964, 4.017792, 7.011363, 11.71220, 17.49524]


def hertz(vehicle: Vehicle, count: int) -> np.ndarray:
    return converged_modes(vehicle, 0.0, count)[0].angular_frequency / (2 * math.pi)


# The numbers of NASA's NASTRAN-95 demonstration D10-01 as a plain stick: six digits, from another program. Its lumps
# are given with seven digits, its grids with six.
@pytest.mark.parametrize(("lumps", "expected"), [("keep", LUMPED), ("spread", CONTINUOUS)])
def test_the_stick_of_d10_01_has_its_frequencies_lumped_and_continuous(lumps, expected):
    assert hertz(read_nastran(STICK, lumps=lumps).vehicle, 5) == pytest.approx(expected, rel=5e-7)


@pytest.mark.parametrize("lumps", ["keep", "spread"])
def test_both_readings_of_the_stick_have_all_its_mass(lumps):
    assert read_nastran(STICK, lumps=lumps).vehicle.mass == pytest.approx(85000.001, rel=1e-14)


def test_masses_on_massless_bars_are_exact():
    """Cubic elements between lumps are exact where the bars have no mass: 18 of them are the deck itself."""
    v = read_nastran(STICK).vehicle
    stiffness, mass = np.zeros((38, 38)), np.zeros((38, 38))
    for n, stage in enumerate(v.stages):
        h, part = stage.length, slice(2 * n, 2 * n + 4)
        element = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]]
        element += [[-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
        stiffness[part, part] += stage.bending_stiffness / h**3 * np.array(element)
    for n, point in enumerate(sorted(v.point_masses, key=lambda point: point.station)):
        mass[2 * n, 2 * n] = point.mass / (1 - 1e-9)
    inverse = scipy.linalg.eigh(mass, stiffness + mass, eigvals_only=True)
    expected = np.sort(1 / inverse[inverse > 1e-12] - 1)[2:7]  # after translation and rotation
    assert (2 * math.pi * hertz(v, 5)) ** 2 == pytest.approx(expected, rel=2e-8)


# Computed by elements that shear, with the masses of its bars and without rotary inertia, on this deck as pyNastran
# reads it: three and six to a bar, extrapolated by their order, the square of the length. The payload, which hangs on
# the stiff spring of its clamp band, is tied rigidly as the importer does it.
def test_the_small_launcher_s_deck_has_its_frequencies():
    found = read_nastran(DATA / "generic_small_launcher.bdf")
    assert hertz(found.vehicle, 4) == pytest.approx([6.302330, 17.918121, 26.709679, 37.502347], rel=1e-6)
    assert found.vehicle.mass == pytest.approx(16765.0, abs=1e-3)
    assert [line for line in found.ignored if "CONM2 9008" in line] == list(found.ignored)


# The same by cubic elements that do not shear.
def test_the_small_launcher_without_shear_has_the_frequencies_of_euler_and_bernoulli():
    v = read_nastran(DATA / "generic_small_launcher.bdf").vehicle
    stages = tuple(stage.model_copy(update={"shear_stiffness": math.inf}) for stage in v.stages)
    found = hertz(v.model_copy(update={"stages": stages}), 4)
    assert found == pytest.approx([6.53797156, 20.25564031, 31.57644907, 50.24238922], rel=1e-7)


# Its published frequencies with shear and rotary inertia, whose elements take the nodes' rotations for slopes in their
# masses (see test_small_launcher.py): they come out lower, by a share that grows as the square of the frequency.
def test_the_small_launcher_s_station_table_gives_its_frequencies_with_shear_and_rotary_inertia():
    v = small_launcher(
        Joint(rotational_stiffness=1.25e8, shear_stiffness=6e8),
        shear_stiffness="kGA_N",
        rotary_inertia_per_length="rotary_inertia_kg_m",
    )
    published = np.array([6.2974, 17.9051, 26.6439, 37.3658])
    assert (hertz(v, 4) / published - 1 < 2e-6 * published**2).all()
    assert (hertz(v, 4) > published - 5e-5).all()


# Its authors' Euler-Bernoulli frequencies, whose payload moves on the clamp band: up to 0.03 % lower.
@pytest.mark.parametrize(
    ("rotational", "shear", "expected"),
    [
        (math.inf, math.inf, [6.6328, 21.5882, 34.277, 50.6335]),
        (1.25e8, 6e8, [6.5379, 20.2925, 31.609, 50.2604]),
        (3.125e7, 6e8, [6.2766, 17.1337, 28.9305, 50.1095]),
    ],
    ids=["rigid", "nominal", "soft"],
)
def test_the_small_launcher_s_station_table_gives_its_published_frequencies(rotational, shear, expected):
    v = small_launcher(Joint(rotational_stiffness=rotational, shear_stiffness=shear))
    assert v.mass == pytest.approx(16765.0, abs=5e-3)  # the table has four decimals
    assert hertz(v, 4) == pytest.approx(expected, rel=5e-4)


def small_launcher(separation: Joint, **columns: str) -> Vehicle:
    """Stages of the station table, x from the tail, and the lumps beside it."""
    names = {
        "x_start": "x_aft_m",
        "x_end": "x_fwd_m",
        "mass_per_length": "m_liftoff_kg_m",
        "bending_stiffness": "EI_N_m2",
        **columns,
    }
    stages = read_stations(DATA / "generic_small_launcher_stations.csv", "tail", names).vehicle
    with (DATA / "generic_small_launcher_lumps.csv").open() as file:
        masses = [
            PointMass(
                station=max(stages.length - float(row["x_m"]), 0.0),
                mass=float(row["mass_kg"]),
                rotary_inertia=float(row["transverse_inertia_kg_m2"]),
            )
            for row in csv.DictReader(file)
        ]
    at = stages.length - 11.43
    joints = [separation if abs(x - at) < 1e-6 else Joint() for x in stages.boundaries[1:-1]]
    return stages.model_copy(update={"joints": tuple(joints), "point_masses": tuple(masses)})
