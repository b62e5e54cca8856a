"""Vehicles of rigid stages have as many modes as springs, fewer than commands show unless told otherwise."""

import math

import numpy as np
import pytest

from beal.errors import ModelError
from beal.stability.critical import critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.modes import converged_modes
from beal.vehicle import PointMass, Stage, catalog

# Ziegler's pendulum at rest, 2 W^2 - 7 W + 1 = 0
UNLOADED = [math.sqrt((7 - math.sqrt(41)) / 4), math.sqrt((7 + math.sqrt(41)) / 4)]


def test_all_modes_are_given_unless_told_otherwise():
    found, error = converged_modes(catalog.ziegler(), 0.0)
    assert found.angular_frequency == pytest.approx(UNLOADED, rel=1e-12)
    assert error == pytest.approx([0.0, 0.0], abs=1e-12)
    assert thrust_curve(catalog.ziegler(), 1.0, 2).angular_frequency[0] == pytest.approx(UNLOADED, rel=1e-12)


def test_more_than_there_are_is_refused():
    with pytest.raises(ModelError, match="count: must lie between 1 and 2, found 3"):
        converged_modes(catalog.ziegler(), 0.0, 3)
    with pytest.raises(ModelError, match=r"modes: must lie between 1 and 2 .*, found 3"):
        thrust_curve(catalog.ziegler(), 1.0, 2, modes=3)


def test_a_rod_of_many_rigid_pieces_is_one_rod():
    whole = catalog.ziegler()
    rigid = Stage(length=0.1, mass_per_length=0.0, bending_stiffness=math.inf)
    joint, welded = whole.joints[0], whole.joints[0].model_copy(update={"rotational_stiffness": math.inf})
    joints = [joint if n in (9, 19) else welded for n in range(29)]
    masses = [PointMass(station=station, mass=mass) for station, mass in ((2.0, 2.0), (3.0, 1.0))]
    cut = whole.model_copy(update={"stages": [rigid] * 30, "joints": joints, "point_masses": masses})
    assert critical_thrust(cut).critical_thrust == pytest.approx(7 / 2 - math.sqrt(2), rel=1e-10)
    assert np.sort(converged_modes(cut, 0.0)[0].angular_frequency) == pytest.approx(UNLOADED, rel=1e-10)
