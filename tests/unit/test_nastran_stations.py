"""Bars that vary along their length, in decks read and written."""

import pytest

from beal.errors import ModelError
from beal.interop.files import content, imported
from beal.vehicle.file import loads

STICK = """GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,5.,0.,0.
CBEAM,1,1,1,2,0.,1.,0.
CBEAM,2,2,2,3,0.,1.,0.
PBEAM,1,1,2.,3.,4.,,,.5
,,,,,,,,
,YES,1.,4.,6.,8.,,,1.
,,,,,,,,
,0.,0.
PBEAM,2,1,4.,6.,8.,,,1.,+
+,NO,1.,1.,3.,8.,,,.25
,0.,0.
MAT1,1,10.,,.3,7.
"""


@pytest.fixture
def read(tmp_path):
    def parse(text, **options):
        (tmp_path / "stick.bdf").write_text(text, encoding="utf-8")
        return imported(tmp_path / "stick.bdf", **options)

    return parse


def test_tapered_bars_in_a_row_are_one_stage_with_tables(read):
    (stage,) = read(STICK).vehicle.stages
    assert (stage.mass_per_length.x, stage.mass_per_length.value) == ((0.0, 3.0, 5.0), (7.25, 29.0, 14.5))
    assert (stage.bending_stiffness.x, stage.bending_stiffness.value) == ((0.0, 3.0, 5.0), (30.0, 60.0, 30.0))


def test_the_ends_of_a_tapered_bar_are_those_of_its_grids(read):
    turned = STICK.replace("CBEAM,1,1,1,2", "CBEAM,1,1,2,1")
    assert read(turned).vehicle.stages[0].mass_per_length.value == (7.25, 29.0, 14.5, 29.0)
    low = read(STICK, nose="low").vehicle.stages[0]
    assert (low.mass_per_length.x, low.mass_per_length.value) == ((0.0, 2.0, 5.0), (14.5, 29.0, 7.25))


def test_the_other_plane_has_its_own_taper(read):
    assert read(STICK, plane="xz").vehicle.stages[0].bending_stiffness.value == (80.0, 80.0, 40.0)


@pytest.mark.parametrize(
    ("row", "x", "stiffness"),
    [
        (",NO,.5,,9.\n,NO,1.,4.,6.,8.,,,1.", (0.0, 3.0, 4.0, 5.0), (30.0, 60.0, 90.0, 30.0)),
        (",NO,.5\n,NO,1.,,6.", (0.0, 3.0, 5.0), (30.0, 60.0, 30.0)),  # a blank lies between the ends
        (",NO,.25,,9.", (0.0, 3.0, 3.0, 4.5, 5.0), (30.0, 60.0, 30.0, 90.0, 30.0)),  # a blank end B repeats end A
    ],
)
def test_stations_between_the_ends_of_a_bar_are_stations_of_its_stage(read, row, x, stiffness):
    text = STICK.replace(",YES,1.,4.,6.,8.,,,1.\n,,,,,,,,\n", f"{row}\n")
    table = read(text).vehicle.stages[0].bending_stiffness
    assert (table.x, table.value) == (x, stiffness)


def test_a_uniform_bar_beside_tapered_ones_is_a_level_part_of_their_table(read):
    text = STICK.replace("PBEAM,2,1,4.,6.,8.,,,1.,+\n+,NO,1.,1.,3.,8.,,,.25\n,0.,0.\n", "PBAR,2,1,4.,6.,8.,,1.\n")
    (stage,) = read(text.replace("CBEAM,2", "CBAR,2")).vehicle.stages
    assert (stage.mass_per_length.x, stage.mass_per_length.value) == ((0.0, 3.0, 5.0), (29.0, 29.0, 14.5))


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        (",YES,1.5,4.", "found x/l = 1.5"),
        (",YES,1.,4.\n,,,,,,,,\n,NO,1.", "each once, found x/l = 1"),
        (",YES,1.,4.,6.,8.,1.", "product of inertia"),
        (",YES,1.,4.,0.", "must be positive and finite, found 0"),
        (",YES,1.,-1.", "must be finite and not negative"),
        (",YES,1.,0.,6.,8.,,,0.", "positive all along, or nowhere"),
    ],
)
def test_a_taper_that_is_none_is_refused(read, row, expected):
    with pytest.raises(ModelError, match=expected):
        read(STICK.replace(",YES,1.,4.,6.,8.,,,1.", row))


VARYING = """
[[stage]]
name = "first"
length = 2.0
mass_per_length = {x = [0.0, 0.7, 0.7, 2.0], value = [1.0, 2.0, 3.0, 4.0]}
bending_stiffness = {x = [0.0, 0.3333333333333333, 0.3333333333333333, 2.0], value = [1.0, 1.0, 2.0, 2.0]}
[[stage]]
name = "steps"
length = 1.1
mass_per_length = {x = [0.0, 0.5, 0.5, 1.1], value = [1.0, 1.0, 2.0, 2.0]}
bending_stiffness = 7.0
foundation_stiffness = {x = [0.0, 1.1], value = [0.0, 1.0]}
[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 2.0
[[joint]]
[[joint]]
rotational_stiffness = 4.0
[[point_mass]]
station = 0.70000000000000007
mass = 0.1
"""


@pytest.mark.parametrize("elements", [1, 8])
def test_tables_come_back_from_a_deck_as_they_were(tmp_path, elements):
    v = loads(VARYING)
    path = tmp_path / "vehicle.bdf"
    path.write_bytes(content(v, path, elements))
    again = imported(path).vehicle
    assert again.model_copy(update={"stages": v.stages, "point_masses": v.point_masses}) == v
    for stage, before in zip(again.stages, v.stages, strict=True):
        assert stage.name == before.name
        assert stage.tables.keys() == before.tables.keys()
        for name, table in stage.tables.items():
            assert table.x == pytest.approx(before.tables[name].x, rel=1e-12)
            assert table.value == pytest.approx(before.tables[name].value, rel=1e-12)


def test_grids_of_a_deck_keep_apart(tmp_path):
    """A mass a rounding away from a station of its own makes no bar without length."""
    v = loads(VARYING.replace("0.70000000000000007", "0.24999999999999997"))
    path = tmp_path / "vehicle.bdf"
    path.write_bytes(content(v, path, 8))
    assert imported(path).vehicle.point_masses[0].station == pytest.approx(0.25, abs=1e-12)
