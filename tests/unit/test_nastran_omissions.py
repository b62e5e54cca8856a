"""Nothing in a deck is dropped without a word: it is used, listed or refused."""

import pytest

from beal.errors import ModelError
from beal.interop.files import imported

CARDS = """GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
CBAR,1,1,1,2,0.,1.,0.
PBAR,1,1,2.,3.,3.,,.5
MAT1,1,10.,,.3,7.
CONM2,5,2,,11.
"""
DECK = f"SOL 103\nCEND\nSPC = 1\nBEGIN BULK\n{CARDS}SPC1,1,1345,1,2\nENDDATA\n"


@pytest.fixture
def read(tmp_path):
    def parse(text, **options):
        (tmp_path / "stick.bdf").write_text(text, encoding="utf-8")
        return imported(tmp_path / "stick.bdf", **options)

    return parse


@pytest.fixture
def refusal(read):
    def refuse(text):
        with pytest.raises(ModelError) as error:
            read(text)
        return str(error.value)

    return refuse


def test_the_deck_itself_is_sound(read):
    assert read(DECK).ignored == ()


def test_parameters_of_the_case_control_section_count(read):
    found = read(DECK.replace("SPC = 1", "SPC = 1\nPARAM,WTMASS,.5\nPARAM,G,.02"))
    assert found.vehicle.mass == (14.5 * 2 + 11) / 2
    assert "all masses are multiplied by 0.5 (PARAM,WTMASS)" in found.notes
    assert found.ignored == ("line 5, PARAM G: structural damping (G) is left out",)


def test_subcases_with_unlike_supports_are_refused(refusal):
    text = DECK.replace("SPC = 1", "SUBCASE 1\n  SPC = 1\nSUBCASE 2\n  SPC = 2")
    assert "case control: selects SPC 1 and 2: keep the subcase of one support" in refusal(text)


def test_a_set_that_is_not_there_is_listed(read):
    assert read(DECK.replace("SPC = 1", "SPC = 7")).ignored == (
        "SPC 7: is in use, but the deck has no constraints of this number",
        "line 11, SPC1 1: these constraints are left out: set 7 is in use",
    )


@pytest.mark.parametrize(
    ("card", "expected"),
    [
        ("CONM2,5,2,,11.", "line 12, CONM2 5: has the number of another card (line 10)"),
        ("CBAR,01,1,1,2,0.,1.,0.", "CBAR 01: has the number of another card (line 7)"),
        ("CELAS2,1,5.,1,2", "CELAS2 1: has the number of another card (line 7)"),
        ("CONM2,-6,2,,11.", "field 2 must be positive, found -6"),
        ("PBAR,1,1,9.", "PBAR 1: has the number of another card (line 8)"),
    ],
)
def test_elements_have_numbers_of_their_own(refusal, card, expected):
    assert expected in refusal(DECK.replace("ENDDATA", f"{card}\nENDDATA"))


def test_a_property_may_be_repeated_word_for_word(read):
    assert read(DECK.replace("ENDDATA", "PBAR,1,1,2.,3.,3.,,.5\nENDDATA")).vehicle == read(DECK).vehicle


def test_coordinate_systems_that_nothing_uses_have_no_influence(read):
    found = read(DECK.replace("ENDDATA", "CORD2C,1,,0.,0.,0.,0.,0.,1.,+C\n+C,1.,0.,1.\nENDDATA"))
    assert "no part of a vehicle, left out: CORD2C (1)" in found.notes


def test_equal_remarks_are_told_once(read):
    ignored = read(DECK.replace("ENDDATA", "FOO,1\nFOO,2\nBAR,3\nENDDATA")).ignored
    assert ignored == (
        "line 12, FOO 1 and 1 more: FOO is unknown, left out",
        "line 14, BAR 3: BAR is unknown, left out",
    )


def test_material_damping_is_listed(read):
    assert read(DECK.replace("7.\n", "7.,,,.02\n", 1)).ignored == (
        "line 9, MAT1 1: structural damping (GE) is left out",
    )


def test_a_continuation_that_never_comes_is_listed(read):
    ignored = read(DECK.replace("PBAR,1,1,2.,3.,3.,,.5", "PBAR,1,1,2.,3.,3.,,.5,,+P1")).ignored
    assert ignored == ("line 8, PBAR 1: names a continuation that does not come",)


def test_two_cards_cannot_wait_for_one_continuation(refusal):
    text = DECK.replace("3.,,.5", "3.,,.5,,+A").replace("11.\n", "11.,,,,,+A\n+A,0.\n+A,0.\n")
    assert "line 10: names the continuation A, as line 8, PBAR 1 does" in refusal(text)


def test_a_deck_without_an_end_is_said_to_be_one(read):
    assert "the deck has no ENDDATA: nothing says that it is whole" in read(CARDS).notes


@pytest.mark.parametrize(
    ("default", "text"),
    [
        ("GRDSET,,,,,,,26", CARDS.replace("2.,0.,0.\n", "2.,0.,0.,,1\n")),
        ("BAROR,,1,,,0.,1.,0.", CARDS.replace("CBAR,1,1,1,2,0.,1.,0.", "CBAR,1,,1,2")),
        ("BEAMOR,,1,,,0.,1.,0.", CARDS.replace("CBAR,1,1,1,2,0.,1.,0.", "CBEAM,1,,1,2")),
    ],
)
def test_blank_fields_take_the_defaults_of_the_deck(read, refusal, default, text):
    v = read(f"{text}{default}\n").vehicle
    assert v.stages == read(CARDS).vehicle.stages
    assert (v.support.nose, v.support.tail) == ("free", "clamped" if default.startswith("GRDSET") else "free")
    assert "may come once" in refusal(f"{text}{default}\n{default}\n")


def test_a_truncated_deck_is_refused_wherever_it_ends(tmp_path):
    path = tmp_path / "cut.bdf"
    for end in range(DECK.index("ENDDATA")):
        path.write_text(DECK[:end])
        with pytest.raises(ModelError):
            imported(path)


def test_a_deck_of_too_many_constraints_is_refused(refusal):
    many = "".join(f"GRID,{n},,{n}.\n" for n in range(10, 1200)) + "SPC1,1,1345,1,THRU,9999\n" * 1000
    assert "more than 1000000 grids" in refusal(DECK.replace("ENDDATA", f"{many}ENDDATA"))
