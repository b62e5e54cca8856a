"""Bars that vary along their length, in decks read and written."""

import math

import pytest

from beal.errors import ModelError
from beal.interop.cards import read_deck
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
        (",YESA,.5,,9.\n,YESA,1.,4.,6.,8.,,,1.", (0.0, 3.0, 4.0, 5.0), (30.0, 60.0, 90.0, 30.0)),
        (",NO,.25,,9.", (0.0, 3.0, 3.0, 4.5, 5.0), (30.0, 60.0, 30.0, 90.0, 30.0)),  # a blank end B repeats end A
    ],
)
def test_stations_between_the_ends_of_a_bar_are_stations_of_its_stage(read, row, x, stiffness):
    text = STICK.replace(",YES,1.,4.,6.,8.,,,1.\n,,,,,,,,\n", f"{row}\n")
    table = read(text).vehicle.stages[0].bending_stiffness
    assert (table.x, table.value) == (x, stiffness)


def test_lumps_are_spread_along_bars_without_mass_only(read):
    tail = "GRID,4,,6.\nGRID,5,,7.\nCBAR,3,3,3,4,0.,1.,0.\nCBAR,4,3,4,5,0.,1.,0.\nPBAR,3,2,1.,1.,1.\nMAT1,2,10.,,.3\n"
    lumps = "".join(f"CONM2,{n},{grid},,{m}\n" for n, grid, m in ((50, 3, 1.0), (51, 4, 2.0), (52, 5, 1.0)))
    found = read(STICK + tail + lumps, lumps="spread").vehicle
    (stage,) = found.stages
    assert stage.mass_per_length.x == (0.0, 2.0, 2.0, 5.0, 7.0)
    assert stage.mass_per_length.value == (2.0, 2.0, 7.25, 29.0, 14.5)
    assert found.point_masses == ()


def test_relief_of_shear_is_listed(read):
    found = read(STICK.replace(",,,,,,,,\n,0.,0.\n", ",,,,,,,,\n,0.,0.,.5\n"))
    assert found.ignored == ("line 6, PBEAM 1: relief of shear by taper (S1, S2) is left out",)


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


@pytest.mark.parametrize(
    ("card", "plane", "shear"),
    [
        ("PBAR,1,1,2.,3.,4.,,.5\n", "xy", math.inf),
        ("PBAR,1,1,2.,3.,4.,,.5\n,,,,,,,,\n,.25,.5\n", "xy", 0.25 * 2 * 10 / 2.6),
        ("PBAR,1,1,2.,3.,4.,,.5\n,,,,,,,,\n,.25,.5\n", "xz", 0.5 * 2 * 10 / 2.6),
        ("PBARL,1,1,,ROD\n,2.\n", "xy", math.inf),
        ("PBEAM,1,1,2.,3.,4.,,,.5\n", "xy", 2 * 10 / 2.6),  # K1 of a PBEAM is 1 unless given
        ("PBEAM,1,1,2.,3.,4.,,,.5\n,,,,,,,,\n,0.,0.\n", "xy", math.inf),
    ],
)
def test_shear_factors_give_a_stage_its_shear_stiffness(read, card, plane, shear):
    text = STICK[: STICK.index("CBEAM,2")] + card + "MAT1,1,10.,,.3,7.\n"
    (stage,) = read(text.replace("CBEAM", "CBAR"), plane=plane).vehicle.stages
    assert stage.shear_stiffness == pytest.approx(shear, rel=1e-15)
    assert stage.rotary_inertia_per_length == 0


def test_the_shear_modulus_may_be_given_or_follow(read):
    card = "PBAR,1,1,2.,3.,3.,,.5\n,,,,,,,,\n,.25,.25\n"
    text = STICK[: STICK.index("CBEAM,2")] + card
    for material, shear in (("MAT1,1,10.,4.,,7.", 2.0), ("MAT1,1,,4.,.25,7.", 2.0), ("MAT1,1,10.,,.25,7.", 2.0)):
        assert read(f"{text}{material}\n").vehicle.stages[0].shear_stiffness == pytest.approx(shear, rel=1e-15)
    found = read(f"{text}MAT1,1,10.,,,7.\n")
    assert found.vehicle.stages[0].shear_stiffness == math.inf
    assert any("has no shear modulus or area" in note for note in found.notes)


def test_tables_have_the_units_of_the_deck(read):
    stage = read(STICK.replace("\n,0.,0.\n", "\n,1.,1.\n"), length_unit="mm", force_unit="kN").vehicle.stages[0]
    assert stage.shear_stiffness.x == pytest.approx((0.0, 0.003, 0.005), rel=1e-14)
    assert stage.mass_per_length.value == pytest.approx((7.25e9, 29e9, 14.5e9), rel=1e-14)
    assert stage.bending_stiffness.value == pytest.approx((0.03, 0.06, 0.03), rel=1e-14)
    assert stage.shear_stiffness.value == pytest.approx((1e4 / 2.6, 4e4 / 2.6, 2e4 / 2.6), rel=1e-14)


def test_bars_that_shear_and_bars_that_do_not_are_two_stages(read):
    rigid, flexible = read(STICK.replace(",,,1.\n,,,,,,,,\n,0.,0.", ",,,1.\n,,,,,,,,\n,1.,1.")).vehicle.stages
    assert rigid.shear_stiffness == math.inf
    assert flexible.shear_stiffness.value == pytest.approx((40 / 2.6, 20 / 2.6), rel=1e-15)


def test_uniform_bars_that_shear_unlike_are_two_stages(read):
    sections = "".join(f"PBAR,{n},1,2.,3.,3.,,.5\n,,,,,,,,\n,{k},{k}\n" for n, k in ((1, ".25"), (2, ".5")))
    stages = read(f"{STICK[: STICK.index('PBEAM,1')]}{sections}MAT1,1,10.,,.25,7.\n").vehicle.stages
    assert [stage.shear_stiffness for stage in stages] == [4.0, 2.0]


def test_a_rigid_stage_is_not_written_to_a_deck():
    v = loads("[[stage]]\nlength = 1.0\nmass_per_length = 1.0\nbending_stiffness = inf\nshear_stiffness = 2.0")
    with pytest.raises(ModelError, match=r"stage\[0\].bending_stiffness: is infinite"):
        content(v, "vehicle.bdf")


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
shear_stiffness = 0.3
rotary_inertia_per_length = 0.1
[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 2.0
shear_stiffness = {x = [0.0, 0.4, 1.0], value = [0.3, 3.0, 1.0]}
rotary_inertia_per_length = {x = [0.0, 1.0], value = [0.0, 1.0]}
[[joint]]
[[joint]]
[[joint]]
rotational_stiffness = 4.0
[[point_mass]]
station = 0.70000000000000007
mass = 0.1
"""


def test_tapered_sections_are_written_with_a_row_of_no_recovery_points(tmp_path):
    path = tmp_path / "vehicle.bdf"
    path.write_bytes(content(loads(VARYING), path, 1))
    sections = [card for card in read_deck(path).cards if card.name == "PBEAM"]
    assert sections
    assert [card.fields[8:18] for card in sections] == [[""] * 8 + ["NO", "1."]] * len(sections)


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
