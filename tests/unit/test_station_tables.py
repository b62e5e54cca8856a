"""Station tables: rows become stages, whatever they are called and wherever x begins."""

import math
from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from beal.errors import ModelError
from beal.interop.cells import csv_text
from beal.interop.files import content, imported
from beal.interop.stations_out import station_rows
from beal.vehicle import catalog, loads

POINTS = "x,mass_per_length,bending_stiffness\n0,2,30\n1,2,30\n1,4,30\n3,4,30\n"


@pytest.fixture
def read(tmp_path):
    def parse(text, **options):
        (tmp_path / "table.csv").write_text(text, encoding="utf-8")
        return imported(tmp_path / "table.csv", **options)

    return parse


@pytest.fixture
def stages_of(read):
    def parse(text, **options):
        stages = read(text, **options).vehicle.stages
        return [(stage.length, stage.mass_per_length, stage.bending_stiffness) for stage in stages]

    return parse


def test_a_station_given_twice_ends_a_stage(stages_of):
    assert stages_of(POINTS) == [(1.0, 2.0, 30.0), (2.0, 4.0, 30.0)]


def test_properties_are_linear_between_stations(read):
    text = "x,mass_per_length,bending_stiffness\n5,2,30\n6,3,30\n7,4,30\n9,4,90\n9,1,30\n10,1,30\n"
    first, second = read(text).vehicle.stages
    assert (first.mass_per_length.x, first.mass_per_length.value) == ((0.0, 2.0, 4.0), (2.0, 4.0, 4.0))
    assert (first.bending_stiffness.x, first.bending_stiffness.value) == ((0.0, 2.0, 4.0), (30.0, 30.0, 90.0))
    assert (second.length, second.mass_per_length, second.bending_stiffness) == (1.0, 1.0, 30.0)


def test_tables_turn_with_their_stages(read):
    text = "x,mass_per_length,bending_stiffness\n0,2,30\n1,3,30\n3,3,30\n"
    (stage,) = read(text, x_from="tail").vehicle.stages
    assert (stage.mass_per_length.x, stage.mass_per_length.value) == ((0.0, 2.0, 3.0), (3.0, 3.0, 2.0))


def test_a_column_says_which_rows_are_one_stage(read):
    text = POINTS.replace("bending_stiffness\n", "bending_stiffness,stage\n").replace("30\n", "30,booster\n")
    (stage,) = read(text).vehicle.stages
    assert (stage.name, stage.mass_per_length.x) == ("booster", (0.0, 1.0, 1.0, 3.0))
    pieces = "x_start,x_end,mass_per_length,bending_stiffness,bay\n0,1,2,30,1\n1,2,4,30,1\n2,3,4,30,2\n"
    first, second = read(pieces, columns={"stage": "bay"}).vehicle.stages
    assert (first.mass_per_length.x, first.mass_per_length.value) == ((0.0, 1.0, 1.0, 2.0), (2.0, 2.0, 4.0, 4.0))
    assert (first.name, second.name, second.mass_per_length) == ("", "", 4.0)


def test_a_foundation_has_a_column_where_it_needs_one(read):
    text = POINTS.replace("\n", ",7\n", 2).replace("bending_stiffness,7", "bending_stiffness,foundation_stiffness")
    found = read(text)
    assert found.ignored == ()
    (first, second) = found.vehicle.stages
    assert first.foundation_stiffness.value == (7.0, 0.0)
    assert second.foundation_stiffness == 0.0


def test_shear_and_rotary_inertia_have_columns(read):
    head = "x,mass_per_length,bending_stiffness,kGA,rotary_inertia_per_length\n"
    text = head + "0,2,30,5,\n1,2,30,7,\n1,2,30,,3\n2,2,30,,3\n"
    first, second = read(text, columns={"shear_stiffness": "kGA"}).vehicle.stages
    assert (first.shear_stiffness.value, first.rotary_inertia_per_length) == ((5.0, 7.0), 0.0)
    assert (second.shear_stiffness, second.rotary_inertia_per_length) == (math.inf, 3.0)


def test_rows_with_both_ends_are_joined_where_they_are_equal(stages_of):
    text = "x_start,x_end,mass_per_length,bending_stiffness\n0,1,2,30\n1,2,4,30\n2,3,4,30\n"
    assert stages_of(text) == [(1.0, 2.0, 30.0), (2.0, 4.0, 30.0)]


@pytest.mark.parametrize(("comment", "options"), [("", {"x_from": "tail"}), ('# beal: x_from = "tail"\n', {})])
def test_x_may_count_from_the_tail(stages_of, comment, options):
    assert stages_of(comment + POINTS, **options) == [(2.0, 4.0, 30.0), (1.0, 2.0, 30.0)]


def test_units_stand_in_brackets(stages_of):
    text = POINTS.replace("x,mass_per_length,", "x [ft],mass_per_length [lb/ft],")
    assert stages_of(text)[0] == pytest.approx((0.3048, 2 * 0.45359237 / 0.3048, 30.0), rel=1e-12)


def test_columns_may_have_names_of_their_own_and_others_are_listed(read):
    text = POINTS.replace("bending_stiffness", "EI").replace("\n", ",7\n").replace("EI,7", "EI,colour")
    found = read(text, columns={"bending_stiffness": "EI"})
    assert found.vehicle.stages[0].bending_stiffness == 30.0
    assert found.ignored == ("columns without a place in a stage, left out: colour",)


TAPER = "x = [0.0, 0.5, 2.0], value = [1.0, 2.0, 4.0]"
VARYING = """
[[stage]]
name = "first"
length = 2.0
mass_per_length = {x = [0.0, 0.7, 0.7, 2.0], value = [1.0, 2.0, 3.0, 4.0]}
bending_stiffness = 3.0
foundation_stiffness = {x = [0.0, 2.0], value = [0.0, 1.0]}
[[stage]]
length = 1.1
mass_per_length = 1.0
bending_stiffness = {x = [0.0, 0.5, 1.1], value = [1.0, 2.0, 1.0]}
internal_damping = 0.01
shear_stiffness = 2.5
[[stage]]
length = 1.0
mass_per_length = 0.0
bending_stiffness = inf
rotary_inertia_per_length = {x = [0.0, 1.0], value = [0.0, 1.0]}
[[joint]]
rotational_stiffness = 4.0
[[joint]]
"""


def test_a_table_without_steps_has_a_row_for_each_station():
    v = loads(
        VARYING[: VARYING.index("[[stage]]", 9)].replace(
            "x = [0.0, 0.7, 0.7, 2.0], value = [1.0, 2.0, 3.0, 4.0]", TAPER
        )
    )
    head, *rows = station_rows(v)[-4:]
    assert head[-1] == "foundation_stiffness [N/m^2]"
    assert rows == [[0.0, 1.0, 3.0, 0.0], [0.5, 2.0, 3.0, 0.25], [2.0, 4.0, 3.0, 1.0]]


@pytest.mark.parametrize("ending", ["csv", "xlsx"])
def test_tables_with_steps_read_back(tmp_path, ending):
    v = loads(VARYING)
    path = tmp_path / f"table.{ending}"
    path.write_bytes(content(v, path))
    again = imported(path).vehicle
    assert again.model_copy(update={"stages": v.stages}) == v
    for stage, before in zip(again.stages, v.stages, strict=True):
        assert (stage.name, stage.internal_damping) == (before.name, before.internal_damping)
        assert stage.tables.keys() == before.tables.keys()
        for name, table in stage.tables.items():
            assert table.x == pytest.approx(before.tables[name].x, rel=1e-15)
            assert table.value == before.tables[name].value


@pytest.mark.parametrize("ending", ["csv", "xlsx"])
def test_a_vehicle_reads_back_with_all_that_it_has(tmp_path, ending):
    v = catalog.tsto(0.6, 5000.0, 7000.0, shear_axis="aft")
    path = tmp_path / f"table.{ending}"
    path.write_bytes(content(v, path))
    again = imported(path).vehicle
    assert again.model_copy(update={"stages": v.stages}) == v
    assert [stage.name for stage in again.stages] == ["upper", "lower"]


def test_quantities_carry_their_units_in_the_head(tmp_path):
    v = catalog.beck().model_copy(update={"units": "SI"})
    assert "x [m],mass_per_length [kg/m],bending_stiffness [N*m^2]\n" in csv_text(station_rows(v))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["a row of names"]),
        ("x,mass_per_length\n0,1\n", ["row 1", "no column bending_stiffness"]),
        (POINTS.replace("3,4,30", "3,4,many"), ["row 5, bending_stiffness", "'many'"]),
        (POINTS.replace("3,4,30", "3,4"), ["row 5, bending_stiffness", "must be a number"]),
        (POINTS.replace("3,4,30", "3,4,nan"), ["row 5, bending_stiffness", "must be a number"]),
        (POINTS.replace("3,4,30", "0.5,4,30"), ["row 5, x", "must not fall"]),
        (POINTS.replace("3,4,30", "1,4,30"), ["row 5", "without length"]),
        (POINTS.replace("\n", ",stage\n", 1).replace("2,30", "2,30,1").replace("\n1,4", "\n2,4"), ["row 4", "repeat"]),
        (POINTS.replace("x,", "x,x,"), ["row 1", "names 'x' twice"]),
        (POINTS.replace("x,", "x [kg],"), ["x [kg]", "converts to m"]),
        (POINTS.replace("0,2,30\n1,2,30", "0,-2,30\n1,-2,30"), ["row 2, mass_per_length", "-2"]),
        (POINTS.replace("0,2,30\n1,2,30", "0,0,30\n1,0,30"), ["stage[0].mass_per_length", "must be positive"]),
        (POINTS.replace("0,2,30", "0,inf,30"), ["row 2, mass_per_length", "must be a number"]),
        ("# beal: x_from = 'top'\n" + POINTS, ["x_from", "nose or tail"]),
        ("# beal: [[joint\n" + POINTS, ["not valid TOML"]),
        ("# beal: [[stage]]\n# beal: name = 'a'\n" + POINTS, ["must be a list of 2 tables"]),
        ("x,mass_per_length,bending_stiffness\n0,1,1\n", ["two stations"]),
        ("x_start,x_end,mass_per_length,bending_stiffness\n0,1,2,3\n2,3,2,3\n", ["row 3, x_start", "row above ends"]),
        ("x_start,x_end,mass_per_length,bending_stiffness\n0,0,2,3\n", ["row 2, x_end", "beyond x_start"]),
    ],
)
def test_a_wrong_table_is_refused_with_its_row(read, text, expected):
    with pytest.raises(ModelError) as error:
        read(text)
    assert [part for part in expected if part not in str(error.value)] == []


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"columns": {"bending_stiffness": "EI"}}, "the table has no 'EI'"),
        ({"columns": {"colour": "x"}}, "'colour' is none of"),
        ({"plane": "xy"}, "plane: does not suit .csv files"),
    ],
)
def test_a_wrong_option_is_refused(read, options, expected):
    with pytest.raises(ModelError, match=expected):
        read(POINTS, **options)


def test_a_damaged_spreadsheet_is_refused(tmp_path):
    path = tmp_path / "table.xlsx"
    sound = content(catalog.beck(), path)
    for place in range(0, len(sound), 97):
        path.write_bytes(sound[:place])
        with pytest.raises(ModelError, match="is not a spreadsheet"):
            imported(path)
    with ZipFile(path, "w") as archive:
        archive.writestr("a", b"0" * 200_000_000, ZIP_DEFLATED)
    with pytest.raises(ModelError, match="larger than 100 MB when unpacked"):
        imported(path)


def test_a_spreadsheet_that_is_none_is_refused(tmp_path):
    (tmp_path / "table.xlsx").write_bytes(b"x,y\n")
    with pytest.raises(ModelError, match="is not a spreadsheet"):
        imported(tmp_path / "table.xlsx")


def test_a_file_of_an_unknown_kind_is_not_written():
    with pytest.raises(ModelError, match=r"must end with \.toml"):
        content(catalog.beck(), "beck.docx")
    with pytest.raises(ModelError, match=r"elements: does not suit \.toml files"):
        content(catalog.beck(), "beck.toml", elements=3)
