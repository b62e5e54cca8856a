"""Whatever the vehicle, it survives the way through other formats; whatever the file, it is read or refused."""

import math
import random

import numpy as np
import pytest
from vehicles import random_vehicles

from beal.errors import ModelError
from beal.interop.files import content, imported
from beal.stability.modes import converged_modes
from beal.vehicle import ElasticEnd, Support, catalog

ZOO = """$ every card that is read
SPC = 9
PARAM,WTMASS,.5
BEGIN BULK
CORD2R,3,0,0.,0.,0.,0.,0.,1.,+
+,1.,0.,0.
GRDSET,,,,,,,1345
BEAMOR,,,,,0.,1.,0.
GRID,1,3,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,0.,0.
GRID*                  4                             2.0
*
GRID,5,,3.,0.,0.
GRID,6,,2.,0.,0.
GRID,7,,3.
GRID,8,,4.
$ lower
CBAR,1,1,1,2,0.,1.,0.
CBEAM,2,2,3,4
CBAR,3,3,4,5,0.,1.,0.
CBEAM*                 4               4               7               8
*
PBAR,1,1,2.,3.,3.,,.5
PBEAM,2,1,2.,3.,3.,,,.5,+
+,,,,,,,,,+
+,YES,1.,2.,3.,3.,,,.5,+
+,,,,,,,,,+
+,0.,0.
PBEAM,4,1,2.,3.,3.,,,.5
,,,,,,,,
,NO,.5,,4.,4.
,YES,1.,1.,5.,5.,,,.25
,,,,,,,,
,0.,0.
PBARL,3,1,,TUBE,,,,,+T
+T,1.,.9,.1
MAT1,1,1.+3,,.3,2.
CBUSH,9,9,2,3,,,,0
PBUSH,9,K,,2.+3,,,,3.+3
,,B,,2.,,,,3.
CELAS2,10,5.+2,2,2,3,2
RBE2,11,4,123456,6
RBAR,12,5,7,123456,,,26
$ payload
CONM2,50,8,,1.,,,,,+
+,.1,,.1,,,.1
CONM2,51,6,,2.
CBUSH,52,52,8,,,,,0
PBUSH,52,K,,7.+2
CELAS2,53,5.+3,8,6
SPC1,1,26,1,THRU,1
SPC,2,1,345,0.
SPCADD,9,1,2
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


def varied(v, seed):
    """The vehicle with tables, dashpots and elastic ends at random."""
    rng = np.random.default_rng(seed)

    def table(length, middle):
        inner = sorted(rng.uniform(0, length, rng.integers(1, 4)).tolist())
        x = [0.0, *inner[: rng.integers(0, 2)], *inner, length]  # the first may be a step
        return {"x": x, "value": (middle * 10 ** rng.uniform(-0.3, 0.3, len(x))).tolist()}

    def stage(s):
        middles = {
            "mass_per_length": s.mass_per_length,
            "bending_stiffness": s.bending_stiffness,
            "shear_stiffness": 10.0,
            "rotary_inertia_per_length": 0.01,
            "foundation_stiffness": 1.0,
        }
        tables = {name: table(s.length, middle) for name, middle in middles.items() if rng.random() < 0.5}
        return s.model_copy(update={**tables, "external_damping": rng.choice([0.0, 0.1])})

    def end():
        return ElasticEnd(translation=rng.choice([0.0, 3.3, math.inf]), rotation=rng.choice([0.0, 0.71, math.inf]))

    damping = [rng.choice([0.0, 0.3], 2).tolist() for _ in v.joints]
    joints = [
        j.model_copy(update=dict(zip(("shear_damping", "rotational_damping"), c, strict=True)))
        for j, c in zip(v.joints, damping, strict=True)
    ]
    parts = {"stages": tuple(stage(s) for s in v.stages), "joints": tuple(joints)}
    return v.model_copy(update={**parts, "support": Support(nose=end(), tail=end())})


@pytest.mark.parametrize("ending", ["bdf", "csv"])
def test_a_vehicle_comes_back_from_another_format(tmp_path, ending):
    path = tmp_path / f"vehicle.{ending}"
    plain = list(random_vehicles(30, seed=5))
    for v in (*plain, *map(varied, plain, range(30))):
        path.write_bytes(content(v, path))
        again = imported(path).vehicle
        assert (again.thrust, again.title) == (v.thrust, v.title)
        assert again.support.stiffness == v.support.stiffness
        assert [joint.shear_axis for joint in again.joints] == [joint.shear_axis for joint in v.joints]
        for kind in ("stages", "joints", "point_masses"):
            assert numbers(getattr(again, kind)) == pytest.approx(numbers(getattr(v, kind)), rel=1e-12, abs=1e-12)


def numbers(parts):
    found = []
    for part in parts:
        for value in part.model_dump().values():
            if isinstance(value, dict):
                found += [*value["x"], *value["value"]]
            elif isinstance(value, float):
                found.append(value)
    return np.where(np.isinf(found), -1.0, found)  # rigid


def test_frequencies_survive_a_deck(tmp_path):
    path = tmp_path / "vehicle.bdf"
    plain = list(random_vehicles(10, seed=6, softest=1.0, absent=0.0, held=0.0))
    for v in (*plain, *map(varied, plain[:4], range(4))):
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


def test_a_misspelt_card_is_listed_or_the_deck_refused(tmp_path):
    path = tmp_path / "zoo.bdf"
    head, bulk = ZOO.split("BEGIN BULK\n")
    lines = bulk.splitlines()
    listed = 0
    for n, line in enumerate(lines):
        if line[0].isalpha():
            path.write_text("\n".join([f"{head}BEGIN BULK", *lines[:n], f"Q{line[1:]}", *lines[n + 1 :]]))
            try:
                told = imported(path).ignored
            except ModelError:
                continue
            assert any("is unknown, left out" in text and f"Q{line[1:3]}" in text for text in told)
            listed += 1
    assert listed > 5


def test_the_deck_that_is_mangled_is_sound(tmp_path):
    (tmp_path / "zoo.bdf").write_text(ZOO)
    found = imported(tmp_path / "zoo.bdf")
    v = found.vehicle
    assert found.ignored == ()
    assert [stage.name for stage in v.stages] == ["", "", "", "lower"]
    assert (v.stages[0].bending_stiffness.x, v.stages[0].bending_stiffness.value) == ((0.0, 1.0), (5000.0, 3000.0))
    assert [joint.rotational_stiffness for joint in v.joints] == [math.inf, math.inf, 3000.0]
    assert [joint.rotational_damping for joint in v.joints] == [0.0, 0.0, 3.0]
    assert [(mass.name, mass.mass, mass.station) for mass in v.point_masses] == [("payload", 0.5, 0.0), ("", 1.0, 2.0)]
    assert v.support.nose == ElasticEnd(translation=700.0, rotation=5000.0)
    assert v.support.tail == "clamped"
