"""Nastran bulk data: formats, what becomes what, and what is refused."""

import math

import pytest

from beal.errors import ModelError
from beal.interop.nastran import read_nastran
from beal.interop.nastran_deck import nastran_text
from beal.vehicle import catalog
from beal.vehicle.file import loads
from beal.vehicle.parts import PointMass

BARS = "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,2,2,3,0.,1.,0.\n"
GRIDS = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,5.,0.,0.\n"
PROPERTIES = "PBAR,1,1,2.,3.,4.,,.5\nPBAR,2,1,1.,1.,1.\nMAT1,1,10.,,.3,7.\n"
DECK = GRIDS + BARS + PROPERTIES
JOINTED = DECK.replace("CBAR,2,2,2,3", "CBAR,2,2,4,3") + "GRID,4,,2.,0.,0.\n"
BUSH = "CBUSH,9,9,2,4,,,,0\nPBUSH,9,K,,20.,30.,,50.,60.\n"


@pytest.fixture
def read(tmp_path):
    def parse(text, **options):
        (tmp_path / "stick.bdf").write_text(text, encoding="utf-8")
        return read_nastran(tmp_path / "stick.bdf", **options)

    return parse


@pytest.fixture
def vehicle_of(read):
    return lambda text, **options: read(text, **options).vehicle


@pytest.fixture
def refusal(read):
    def refuse(text, **options):
        with pytest.raises(ModelError) as error:
            read(text, **options)
        return str(error.value)

    return refuse


def test_bars_become_stages_from_the_nose_at_the_highest_coordinate(vehicle_of):
    stages = vehicle_of(DECK).stages
    assert [(s.length, s.mass_per_length, s.bending_stiffness) for s in stages] == [(3.0, 7.0, 10.0), (2.0, 14.5, 30.0)]
    assert [(j.rotational_stiffness, j.shear_stiffness) for j in vehicle_of(DECK).joints] == [(math.inf, math.inf)]


def test_the_nose_may_be_at_the_lowest_coordinate(vehicle_of):
    assert [stage.length for stage in vehicle_of(DECK, nose="low").stages] == [2.0, 3.0]


CARDS = [line.split(",") for line in DECK.splitlines()]


def columns(name, *fields, width, star=""):
    """A card in fields of fixed width, with as many lines as it needs."""
    per_line = 64 // width
    rows = [fields[start : start + per_line] for start in range(0, len(fields), per_line)]
    heads = [name + star, *[star] * (len(rows) - 1)]
    return "".join(
        f"{head:<8}" + "".join(f"{field:>{width}}" for field in row) + "\n"
        for head, row in zip(heads, rows, strict=True)
    )


SMALL = "".join(columns(*card, width=8) for card in CARDS)
LARGE = "".join(columns(*card, width=16, star="*") for card in CARDS)
SECTIONED = f"SOL 103\nCEND\n  SPC = 4\nBEGIN BULK\n{DECK}ENDDATA\nthis is not read\n"


@pytest.mark.parametrize(
    "text",
    [
        SMALL,
        LARGE,
        LARGE.replace("             .5+1", "            .5E+1"),
        SECTIONED,
        DECK.replace("\n", "\r\n"),
        DECK.lower(),
    ],
)
def test_every_format_of_fields_reads_the_same(vehicle_of, text):
    assert vehicle_of(text) == vehicle_of(DECK)


@pytest.mark.parametrize(
    "pbar",
    [
        "PBAR,1,1,2.,3.,4.,,.5,,+\n+,,,,,,,,,\n+,,,0.\n",
        "PBAR,1,1,2.,3.,4.,,.5,,+P1\n+P1,0.,0.\n",
        "PBAR,1,1,2.,3.,4.,,.5\n,0.,0.\n",
        "PBAR           1       1      2.      3.      4.              .5        +P1\n+P1           0.\n",
        "PBAR           1       1      2.      3.      4.              .5\n              0.\n",
    ],
)
def test_continuations_belong_to_their_card(vehicle_of, pbar):
    assert vehicle_of(DECK.replace("PBAR,1,1,2.,3.,4.,,.5\n", pbar)) == vehicle_of(DECK)


def test_a_named_continuation_is_found_wherever_it_stands(vehicle_of):
    head, tail = "PBAR,1,1,2.,3.,4.,,.5,,+XY\n", "+XY,,,,,,,,\n+,,,0.\n"
    text = DECK.replace("PBAR,1,1,2.,3.,4.,,.5\n", head) + tail
    assert vehicle_of(text) == vehicle_of(DECK)


def test_a_line_that_follows_half_a_card_does_not_fill_its_gap(refusal):
    half = columns("PBAR", "1", "1", "2.", "3.", width=16, star="*") + "+,9.\n"
    message = refusal(DECK.replace("PBAR,1,1,2.,3.,4.,,.5\n", half), plane="xz")
    assert "CBAR 1: its bending stiffness in the plane xz must be positive" in message


def test_included_files_are_read_in_their_place(vehicle_of, tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "bars.bdf").write_text(f"$ bars\n{BARS}INCLUDE 'more.bdf'\n")
    (tmp_path / "parts" / "more.bdf").write_text(PROPERTIES)
    text = f"BEGIN BULK\n{GRIDS}INCLUDE 'parts/\nbars.bdf'\nENDDATA\n"
    assert vehicle_of(text).stages[0].bending_stiffness == 10.0


@pytest.mark.parametrize("name", ["nowhere.bdf", "stick.bdf", "."])
def test_a_file_that_cannot_be_included_is_refused(refusal, name):
    assert refusal(f"{DECK}INCLUDE '{name}'\n")


def test_files_that_are_too_large_together_are_refused(refusal, tmp_path):
    (tmp_path / "half.bdf").write_text("$ nothing\n" * 300_000)
    message = refusal(DECK + "INCLUDE 'half.bdf'\nINCLUDE 'half.bdf'\n")
    assert "half.bdf: is larger than 5 MB with what was read before it" in message


@pytest.mark.parametrize("axis", "xyz")
def test_the_stick_may_lie_along_any_axis(vehicle_of, axis):
    turn = {"x": "{0},0.,0.", "y": "0.,{0},0.", "z": "0.,0.,{0}"}[axis]
    text = DECK
    for x in ("0.", "2.", "5."):
        text = text.replace(f",,{x},0.,0.", ",," + turn.format(x))
    other = "1.,0.,0." if axis == "y" else "0.,1.,0."
    assert vehicle_of(text.replace("0.,1.,0.", other)).stages == vehicle_of(DECK).stages


def test_the_plane_chooses_the_second_moment_of_area(vehicle_of):
    assert vehicle_of(DECK, plane="xy").stages[1].bending_stiffness == 30.0
    assert vehicle_of(DECK, plane="xz").stages[1].bending_stiffness == 40.0
    assert vehicle_of(DECK.replace("0.,1.,0.", "0.,0.,1."), plane="xz").stages[1].bending_stiffness == 30.0


def test_a_third_grid_may_orient_a_bar(vehicle_of):
    text = DECK.replace("0.,1.,0.", "7") + "GRID,7,,0.,0.,9.\n"
    assert vehicle_of(text, plane="xz").stages[1].bending_stiffness == 30.0


@pytest.mark.parametrize(
    ("card", "mass", "stiffness"),
    [
        ("PBARL,1,1,,ROD,,,,,+\n+,2.,.5", 7 * math.pi * 4 + 0.5, 10 * math.pi * 4),
        ("PBARL,1,1,,TUBE,,,,,+\n+,2.,1.", 7 * math.pi * 3, 10 * math.pi * 15 / 4),
        ("PBARL,1,1,,TUBE2,,,,,+\n+,2.,1.", 7 * math.pi * 3, 10 * math.pi * 15 / 4),
        ("PBARL,1,1,,BAR,,,,,+\n+,3.,2.", 42.0, 20.0),
        ("PBARL,1,1,,BOX,,,,,+\n+,3.,2.,.5,.5", 7 * 4.0, 10 * (2 - 1 / 6)),
        ("PBEAM,1,1,2.,3.,4.,,,.5", 14.5, 30.0),
        ("PBEAM,1,1,2.,3.,4.,,,.5,+\n+,,,,,,,,,+\n+,YES,1.,2.,3.,4.,,,.5,+\n+,,,,,,,,,+\n+,0.,0.", 14.5, 30.0),
    ],
)
def test_sections_have_their_mass_and_stiffness(vehicle_of, card, mass, stiffness):
    stage = vehicle_of(DECK.replace("PBAR,1,1,2.,3.,4.,,.5", card)).stages[1]
    assert (stage.mass_per_length, stage.bending_stiffness) == pytest.approx((mass, stiffness), rel=1e-14)


def test_bars_of_equal_properties_are_one_stage(vehicle_of):
    text = DECK.replace("PBAR,2,1,1.,1.,1.", "PBAR,2,1,2.,3.,4.,,.5")
    assert [stage.length for stage in vehicle_of(text).stages] == [5.0]


def test_a_comment_before_a_bar_begins_a_stage_and_names_it(vehicle_of):
    text = DECK.replace("PBAR,2,1,1.,1.,1.", "PBAR,2,1,2.,3.,4.,,.5").replace("CBAR,2", "$ upper\nCBAR,2")
    assert [(stage.name, stage.length) for stage in vehicle_of(text).stages] == [("upper", 3.0), ("", 2.0)]


@pytest.mark.parametrize(
    ("links", "rotational", "shear"),
    [
        (BUSH, 60.0, 20.0),
        ("CELAS2,8,20.,2,2,4,2\nCELAS2,9,60.,2,6,4,6\n", 60.0, 20.0),
        (BUSH + "CELAS2,8,20.,4,2,2,2\n", 60.0, 40.0),
        ("CELAS2,8,20.,2,2,4,2\nRBE2,9,2,6,4\n", math.inf, 20.0),
        ("RBE2,9,4,123456,2\n", math.inf, math.inf),
        ("CELAS2,8,20.,2,2,4,2\n", 0.0, 20.0),
    ],
)
def test_springs_between_grids_at_one_station_are_a_joint(vehicle_of, links, rotational, shear):
    joint = vehicle_of(JOINTED + links).joints[0]
    assert (joint.rotational_stiffness, joint.shear_stiffness) == (rotational, shear)


def test_the_joint_of_the_other_plane_has_its_own_springs(vehicle_of):
    joint = vehicle_of(JOINTED + BUSH, plane="xz").joints[0]
    assert (joint.rotational_stiffness, joint.shear_stiffness) == (50.0, 30.0)


def test_lumps_keep_their_names_and_turn_about_the_axis_of_bending(vehicle_of):
    text = DECK + "$ payload\nCONM2,50,3,,11.\n,1.,,2.,,,3.\n"
    mass = vehicle_of(text).point_masses[0]
    assert (mass.name, mass.station, mass.mass, mass.rotary_inertia) == ("payload", 0.0, 11.0, 3.0)
    assert vehicle_of(text, plane="xz").point_masses[0].rotary_inertia == 2.0


def test_a_lump_stays_on_its_face_of_a_joint(vehicle_of):
    aft, forward = (vehicle_of(f"{JOINTED}{BUSH}CONM2,50,{grid},,11.\n").point_masses[0].station for grid in (2, 4))
    assert aft == 3.0
    assert 2.99 < forward < 3.0


def test_a_lump_on_a_stiff_spring_moves_with_the_stick_and_this_is_said(read):
    found = read(DECK + "GRID,7,,2.,0.,0.\nCONM2,50,7,,1.\nCBUSH,9,9,2,7,,,,0\nPBUSH,9,K,,1.+6,,,,1.+6\n")
    assert found.vehicle.point_masses[0].station == 3.0
    assert "CONM2 50: hangs on a spring of 1e+03 rad/s, which is taken as rigid" in found.ignored[0]


def test_a_lump_on_a_soft_spring_is_refused(refusal):
    text = DECK + "GRID,7,,2.,0.,0.\nCONM2,50,7,,1.\nCBUSH,9,9,2,7,,,,0\nPBUSH,9,K,,1.,,,,1.\n"
    assert "a vehicle has no sprung masses" in refusal(text)


@pytest.mark.parametrize(
    ("card", "nose", "tail"),
    [
        ("SPC1,1,123456,1", "free", "clamped"),
        ("SPC1,1,26,3", "clamped", "free"),
        ("SPC1,1,2,1,THRU,1\nSPC,1,3,6,0.", "sliding", "pinned"),
        ("SPC1,1,1345,1,2,3", "free", "free"),
    ],
)
def test_held_ends_are_supports(vehicle_of, card, nose, tail):
    support = vehicle_of(f"{DECK}{card}\n").support
    assert (support.nose, support.tail) == (nose, tail)


def test_a_grid_can_be_held_by_its_own_card(vehicle_of):
    assert vehicle_of(DECK.replace("GRID,1,,0.,0.,0.", "GRID,1,,0.,0.,0.,,123456")).support.tail == "clamped"


def test_only_the_selected_constraints_act(read):
    cards = f"BEGIN BULK\n{DECK}SPC1,1,123456,1\nSPC1,2,123456,3\nENDDATA\n"
    assert read(f"SPC = 2\n{cards}").vehicle.support.nose == "clamped"
    found = read(cards)
    assert found.vehicle.free_free
    assert "selects no SPC" in found.ignored[0]


def test_quantities_are_converted_from_the_units_of_the_deck(vehicle_of):
    v = vehicle_of(JOINTED + BUSH + "CONM2,50,3,,11.\n", length_unit="inch", force_unit="lbf")
    inch, pound = 0.0254, 4.4482216152605
    found = [
        v.length,
        v.stages[1].mass_per_length,
        v.stages[1].bending_stiffness,
        v.joints[0].rotational_stiffness,
        v.joints[0].shear_stiffness,
        v.point_masses[0].mass,
    ]
    factors = [inch, pound / inch**2, pound * inch**2, pound * inch, pound / inch, pound / inch]
    values = [5.0, 14.5, 30.0, 60.0, 20.0, 11.0]
    assert found == pytest.approx([a * b for a, b in zip(factors, values, strict=True)], rel=1e-12)


def test_a_weight_density_is_turned_into_mass(vehicle_of):
    assert vehicle_of(DECK + "PARAM,WTMASS,.5\n").mass == vehicle_of(DECK).mass / 2


def test_what_is_left_out_is_listed(read):
    found = read(
        DECK.replace("PBAR,2,1,1.,1.,1.", "PBAR,2,1,1.,1.,1.,,,,+\n+\n+,.5,.5") + "FOO,3\nEIGRL,1\nGRID,9,,9.\n"
    )
    assert [line for line in found.ignored if "shear" in line or "FOO 3" in line] == list(found.ignored)
    assert any("EIGRL (1)" in note for note in found.notes)
    assert any("1 grids carry neither" in note for note in found.notes)


REFUSED = {
    "a missing grid": (DECK.replace("GRID,2,,2.,0.,0.\n", ""), ["CBAR 1", "CBAR 2", "GRID 2"]),
    "a missing property": (DECK.replace("PBAR,2,", "PBAR,5,"), ["line 5, CBAR 2", "property 2"]),
    "a missing material": (DECK.replace("MAT1,1,", "MAT1,6,"), ["CBAR 1", "MAT1 1"]),
    "a grid off the line": (DECK.replace("2.,0.,0.", "2.,.1,0."), ["GRID 2", "off the line", "y = 0.1"]),
    "bars side by side": (DECK + "CBAR,3,1,1,3,0.,1.,0.\n", ["CBAR 3", "lies beside"]),
    "a gap": (DECK + "GRID,5,,6.\nGRID,6,,7.\nCBAR,3,1,5,6,0.,1.,0.\n", ["CBAR 3", "two sticks"]),
    "untied grids": (JOINTED, ["grid 4", "is not tied"]),
    "pin flags": (DECK.replace("3,0.,1.,0.", "3,0.,1.,0.,,+\n+,6"), ["CBAR 2", "pin flags"]),
    "offsets": (DECK.replace("3,0.,1.,0.", "3,0.,1.,0.,,+\n+,,,.1"), ["CBAR 2", "offsets"]),
    "a skew section": (DECK.replace("0.,1.,0.", "0.,1.,1."), ["CBAR 1", "turned against the plane"]),
    "no orientation": (DECK.replace("0.,1.,0.", "0.,0.,0."), ["CBAR 1", "no orientation"]),
    "coupled planes": (DECK.replace("4.,,.5", "4.,,.5,,+\n+\n+,,,.1"), ["CBAR 1", "product of inertia"]),
    "no stiffness": (DECK.replace("2.,3.,4.", "2.,0.,4."), ["CBAR 1", "must be positive"]),
    "an offset lump": (DECK + "CONM2,50,3,,11.,.1\n", ["CONM2 50", "offset"]),
    "a lost lump": (DECK + "GRID,7,,2.\nCONM2,50,7,,11.\n", ["CONM2 50", "not on the stick"]),
    "a shell": (DECK + "CQUAD4,60,1,1,2,3,4\n", ["CQUAD4 60", "is not read"]),
    "a rigid bar": (DECK + "RBE3,60,,1,123456\n", ["RBE3 60", "is not read"]),
    "a tie along the stick": (DECK + "RBE2,60,1,123456,3\n", ["RBE2 60", "ties grids 1 and 3"]),
    "a spring to ground inside": (DECK + "CELAS2,60,5.,2,2\n", ["CELAS2 60", "stands on the ground"]),
    "turned axes": (
        DECK.replace("GRID,2,", "GRID,2,5") + "CORD2R,5,,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\n",
        ["GRID 2", "uses the coordinate system 5", "basic axes"],
    ),
    "a held grid inside": (DECK + "SPC1,1,2,2\n", ["GRID 2", "only the ends"]),
    "a bad number": (DECK.replace("2.,0.,0.", "2x,0.,0."), ["line 2, GRID 2", "field 4", "'2x'"]),
    "a number too large": (DECK.replace("2.,0.,0.", "2.+999,0.,0."), ["GRID 2", "must be a number"]),
    "an unknown section": (DECK.replace("PBAR,1,1,2.,3.,4.,,.5", "PBARL,1,1,,HAT,,,,,+\n+,1."), ["PBARL 1", "HAT"]),
    "a number twice": (DECK + "GRID,2,,3.,0.,0.\n", ["line 9, GRID 2", "number of another card (line 2)"]),
    "a cut deck": (f"BEGIN BULK\n{DECK}", ["ENDDATA", "cut off"]),
    "nothing": ("", ["needs CBAR or CBEAM"]),
    "prose": ("Dear reader,\nthis is a letter.\n", ["line 1"]),
    "nulls": ("GRID\0", ["null bytes"]),
    "replication": (DECK + "=,*1,=,*2.\n", ["replication"]),
    "too many fields": (DECK + "GRID,1,2,3,4,5,6,7,8,9\n", ["more than 8 fields"]),
    "no mass": (DECK.replace(",7.", "").replace(",,.5", ""), ["have no mass"]),
    "sizes without bound": (
        DECK.replace("PBAR,1,1,2.,3.,4.,,.5", "PBARL,1,1,,ROD,,,,,+\n+,1.+99"),
        ["PBARL 1", "range of numbers"],
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_vehicle_cannot_be_is_refused_with_its_place(refusal, name):
    text, expected = REFUSED[name]
    message = refusal(text)
    assert [part for part in expected if part not in message] == []


def test_all_problems_are_reported_at_once(refusal):
    text = DECK.replace("GRID,2,,2.", "GRID,2,,2x").replace("MAT1,1,10.", "MAT1,1,-10.") + "CQUAD4,60,1,1,2,3,4\n"
    message = refusal(text)
    assert [part for part in ("GRID 2", "MAT1 1", "CQUAD4 60", "problems") if part not in message] == []


def test_a_thousand_problems_are_told_by_their_kinds(refusal):
    message = refusal(DECK + "".join(f"CQUAD4,{n},1\n" for n in range(100, 1100)) + "MPC,7,1,1,1.\n")
    assert "line 9, CQUAD4 100 and 1000 more: is not read" in message
    many = refusal(DECK + "".join(f"GRID,{n},,0.,.{n},0.\nCBAR,{n},1,1,{n},0.,1.,0.\n" for n in range(100, 400)))
    assert len(many.splitlines()) == 202
    assert many.endswith("more kinds of problems")


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"plane": "xx"}, "plane: must be one of xy"),
        ({"plane": "yz"}, "plane: must hold the stick's axis x"),
        ({"nose": "up"}, "nose: must be one of high, low"),
        ({"lumps": "melt"}, "lumps: must be one of keep, spread"),
        ({"length_unit": "kg"}, "length_unit: expected"),
        ({"lumps": "spread"}, "every bar has mass"),
    ],
)
def test_a_wrong_option_is_refused(refusal, options, expected):
    assert expected in refusal(DECK, **options)


def test_lumps_that_no_uniform_bars_leave_are_not_spread(refusal):
    bare = "".join(f"GRID,{n},,{n}.\n" for n in range(1, 6)) + "".join(
        f"CBAR,{n},1,{n},{n + 1},0.,1.,0.\n" for n in range(1, 5)
    )
    lumps = "".join(f"CONM2,5{n},{n},,{m}\n" for n, m in enumerate((1.0, 2.0, 2.0, 1.5, 1.0), 1))
    assert "must be 2 at least" in refusal(f"{bare}{lumps}PBAR,1,1,1.,1.,1.\nMAT1,1,1.,,.3\n", lumps="spread")


def test_an_engine_beside_the_lumps_of_a_stage_stays_a_point_mass(vehicle_of):
    bare = "".join(f"GRID,{n},,{n}.\n" for n in range(1, 6)) + "".join(
        f"CBAR,{n},1,{n},{n + 1},0.,1.,0.\n" for n in range(1, 5)
    )
    lumps = "".join(f"CONM2,5{n},{n},,{m}\n" for n, m in enumerate((4.0, 2.0, 2.0, 2.0, 1.0), 1))
    v = vehicle_of(f"{bare}{lumps}PBAR,1,1,1.,1.,1.\nMAT1,1,1.,,.3\n", lumps="spread")
    assert [(s.length, s.mass_per_length) for s in v.stages] == [(4.0, 2.0)]
    assert [(p.station, p.mass) for p in v.point_masses] == [(4.0, 3.0)]


def test_numbers_keep_ten_digits_and_fit_their_fields():
    text = nastran_text(
        loads("[[stage]]\nlength = 0.3333333333333333\nmass_per_length = 1e-20\nbending_stiffness = 7e50")
    )
    assert max(map(len, text.splitlines())) <= 80
    assert ".33333333333333" in text


def test_what_bulk_data_cannot_say_is_kept(vehicle_of):
    v = catalog.tsto(0.6, 5000.0, 7000.0, shear_axis="aft")
    again = vehicle_of(nastran_text(v))
    assert (again.title, again.units, again.sensors, again.joints) == (v.title, v.units, v.sensors, v.joints)
    assert [stage.name for stage in again.stages] == ["upper", "lower"]


@pytest.mark.parametrize("forward", [0.0, 1e-9])
def test_a_lump_at_a_joint_is_written_on_its_face(vehicle_of, forward):
    v = catalog.tsto(0.6, 5000.0, 7000.0)
    v = v.model_copy(update={"point_masses": (PointMass(station=0.6 - forward, mass=1.0),)})
    assert vehicle_of(nastran_text(v)).point_masses[0].station == pytest.approx(0.6 - forward, abs=1e-12)


def test_names_that_no_comment_can_carry_are_kept_too(vehicle_of):
    names = ["12", "beal: odd", "two\nlines", "Ü", " "]
    v = catalog.beck()
    v = v.model_copy(
        update={
            "stages": tuple(v.stages[0].model_copy(update={"name": name}) for name in names),
            "joints": tuple(catalog.tsto(0.5, 1.0, 1.0).joints) * 4,
        }
    )
    assert [stage.name for stage in vehicle_of(nastran_text(v)).stages] == names


def test_comments_that_do_not_fit_the_cards_are_refused(refusal):
    assert "must be a list of 2 tables" in refusal("$ beal: [[stage]]\n$ beal: name = 'a'\n" + DECK)
    assert "not valid TOML" in refusal("$ beal: [[stage\n" + DECK)
    assert "thrust.colour" in refusal("$ beal: [thrust]\n$ beal: colour = 1\n" + DECK)


def test_a_nondimensional_deck_takes_no_units(refusal):
    assert "do not suit a deck that says it is nondimensional" in refusal(nastran_text(catalog.beck()), force_unit="kN")


def test_a_deck_without_bars_is_not_written():
    with pytest.raises(ModelError, match="elements: must be at least 1"):
        nastran_text(catalog.beck(), elements=0)
