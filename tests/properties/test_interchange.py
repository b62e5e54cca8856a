"""Whatever the vehicle, it survives the way through other formats; whatever the file, it is read or refused."""

import math
import random

import numpy as np
import pytest
from vehicles import random_vehicles

from beal.errors import ModelError
from beal.interop.files import content, imported
from beal.stability.modes import converged_modes
from beal.vehicle import catalog

ZOO = """$ every card that is read
SPC = 1
BEGIN BULK
CORD2R,3,0,0.,0.,0.,0.,0.,1.,+
+,1.,0.,0.
GRID,1,3,0.,0.,0.,,1345
GRID,2,,1.,0.,0.
GRID,3,,1.,0.,0.
GRID*                  4                             2.0
*
GRID,5,,3.,0.,0.
GRID,6,,2.,0.,0.
$ lower
CBAR,1,1,1,2,0.,1.,0.
CBEAM,2,2,3,4,0.,1.,0.
CBAR,3,3,4,5,0.,1.,0.
PBAR,1,1,2.,3.,3.,,.5
PBEAM,2,1,2.,3.,3.,,,.5,+
+,,,,,,,,,+
+,YES,1.,2.,3.,3.,,,.5,+
+,,,,,,,,,+
+,0.,0.
PBARL,3,1,,TUBE,,,,,+T
+T,1.,.9,.1
MAT1,1,1.+3,,.3,2.
CBUSH,9,9,2,3,,,,0
PBUSH,9,K,,2.+3,,,,3.+3
CELAS2,10,5.+2,2,2,3,2
RBE2,11,4,123456,6
$ payload
CONM2,50,5,,1.,,,,,+
+,.1,,.1,,,.1
CONM2,51,6,,2.
SPC1,1,26,1,THRU,1
SPC,1,5,2,0.
PARAM,WTMASS,.5
ENDDATA
"""
PIECES = (
    *("", "0", "-1", "1.+400", "nan", "inf", "99", "*", "+", "+A", "=", "$", ",", ",,", "'", "\0", "é", "1.0-", "THRU"),
    *(
        "CBAR",
        "CQUAD4",
        "INCLUDE x",
        "BEGIN BULK",
        "ENDDATA",
        "\t",
        "$ beal: stage = 1",
        "K",
        "YES",
        "1" * 30,
        "\n",
        "[",
        "]",
    ),
)


@pytest.mark.parametrize("ending", ["bdf", "csv"])
def test_a_vehicle_comes_back_from_another_format(tmp_path, ending):
    path = tmp_path / f"vehicle.{ending}"
    for v in random_vehicles(30, seed=5):
        path.write_bytes(content(v, path))
        again = imported(path).vehicle
        assert (again.support, again.thrust, again.title) == (v.support, v.thrust, v.title)
        assert [joint.shear_axis for joint in again.joints] == [joint.shear_axis for joint in v.joints]
        for kind in ("stages", "joints", "point_masses"):
            assert numbers(getattr(again, kind)) == pytest.approx(numbers(getattr(v, kind)), rel=1e-12, abs=1e-12)


def numbers(parts):
    found = [value for part in parts for value in part.model_dump().values() if isinstance(value, float)]
    return np.where(np.isinf(found), -1.0, found)  # rigid


def test_frequencies_survive_a_deck(tmp_path):
    path = tmp_path / "vehicle.bdf"
    for v in random_vehicles(10, seed=6, softest=1.0, absent=0.0, held=0.0):
        path.write_bytes(content(v, path))
        there, here = (converged_modes(each, 0.0, 3)[0].angular_frequency for each in (imported(path).vehicle, v))
        assert there == pytest.approx(here, rel=1e-9)


def mangled(text, rng):
    """The text after a few accidents."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        lines = text.split("\n")
        line = rng.randrange(len(lines))
        place = rng.randrange(len(text) + 1)
        match rng.randrange(6):
            case 0:
                text = text[:place]
            case 1:
                text = text[:place] + rng.choice(PIECES) + text[place:]
            case 2:
                text = "\n".join(lines[:line] + lines[line + rng.choice((1, 3)) :])
            case 3:
                text = "\n".join([*lines[:line], lines[rng.randrange(len(lines))], *lines[line:]])
            case 4:
                fields = lines[line].split(",")
                fields[rng.randrange(len(fields))] = rng.choice(PIECES)
                text = "\n".join([*lines[:line], ",".join(fields), *lines[line + 1 :]])
            case 5:
                text = text[:place] + chr(rng.randrange(32, 127)) + text[place + 1 :]
    return text


@pytest.mark.parametrize("ending", ["bdf", "csv"])
def test_a_mangled_file_is_read_or_refused(tmp_path, ending):
    path = tmp_path / f"vehicle.{ending}"
    sound = ZOO if ending == "bdf" else content(catalog.tsto(0.6, 5e3, 5e3), path).decode()
    outcomes = set()
    for seed in range(400):
        path.write_text(mangled(sound, random.Random(seed)), encoding="utf-8")
        try:
            outcomes.add(math.isfinite(imported(path).vehicle.mass))
        except ModelError as error:
            outcomes.add("refused" if str(error) else "without a reason")
    assert outcomes == {True, "refused"}


def test_the_deck_that_is_mangled_is_sound(tmp_path):
    (tmp_path / "zoo.bdf").write_text(ZOO)
    v = imported(tmp_path / "zoo.bdf").vehicle
    assert [stage.name for stage in v.stages] == ["", "", "lower"]
    assert [joint.rotational_stiffness for joint in v.joints] == [math.inf, 3000.0]
    assert [(mass.name, mass.mass, mass.station) for mass in v.point_masses] == [("payload", 0.5, 0.0), ("", 1.0, 1.0)]
    assert (v.support.nose, v.support.tail) == ("pinned", "clamped")
