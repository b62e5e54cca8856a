"""Station tables: rows become stages, whatever they are called and wherever x begins."""

import pytest

from beal.errors import ModelError
from beal.interop.files import content, imported
from beal.interop.cells import csv_text
from beal.interop.stations_out import station_rows
from beal.vehicle import catalog

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
    text = POINTS.replace("bending_stiffness", "EI").replace("\n", ",7\n").replace("EI,7", "EI,kGA")
    found = read(text, columns={"bending_stiffness": "EI"})
    assert found.vehicle.stages[0].bending_stiffness == 30.0
    assert found.ignored == ("columns without a place in a stage, left out: kGA",)


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
        (POINTS.replace("3,4,30", "3,5,30"), ["row 5", "a step"]),
        (POINTS.replace("x,", "x [kg],"), ["x [kg]", "converts to m"]),
        (POINTS.replace("0,2,30\n1,2,30", "0,-2,30\n1,-2,30"), ["stage[0].mass_per_length", "greater than 0"]),
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


def test_a_spreadsheet_that_is_none_is_refused(tmp_path):
    (tmp_path / "table.xlsx").write_bytes(b"x,y\n")
    with pytest.raises(ModelError, match="is not a spreadsheet"):
        imported(tmp_path / "table.xlsx")


def test_a_file_of_an_unknown_kind_is_not_written():
    with pytest.raises(ModelError, match=r"must end with \.toml"):
        content(catalog.beck(), "beck.docx")
    with pytest.raises(ModelError, match=r"elements: does not suit \.toml files"):
        content(catalog.beck(), "beck.toml", elements=3)
