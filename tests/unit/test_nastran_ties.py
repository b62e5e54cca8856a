"""What holds and joins the bars of a deck: springs, dashpots, rigid ties and constraints, read and written."""

import math

import pytest

from beal.errors import ModelError
from beal.interop.files import content, imported
from beal.vehicle import ElasticEnd, Joint, Support, catalog

DECK = """GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,5.,0.,0.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,2.,3.,3.,,.5
MAT1,1,10.,,.3,7.
"""
JOINTED = DECK.replace("CBAR,2,1,2,3", "CBAR,2,1,4,3") + "GRID,4,,2.,0.,0.\n"


@pytest.fixture
def read(tmp_path):
    def parse(text, **options):
        (tmp_path / "stick.bdf").write_text(text, encoding="utf-8")
        return imported(tmp_path / "stick.bdf", **options)

    return parse


def elastic(translation, rotation):
    return ElasticEnd(translation=translation, rotation=rotation)


@pytest.mark.parametrize(
    ("cards", "tail"),
    [
        ("CELAS2,60,5.,1,2\n", elastic(5.0, 0.0)),
        ("CELAS2,60,5.,,,1,6\n", elastic(0.0, 5.0)),
        ("CELAS2,60,5.,1,2\nCELAS2,61,7.,1,2\nCELAS2,62,3.,1,6\n", elastic(12.0, 3.0)),
        ("CELAS2,60,5.,1,2\nSPC1,1,6,1\n", elastic(5.0, math.inf)),
        ("CELAS2,60,5.,1,2\nSPC1,1,26,1\n", "clamped"),
        ("CBUSH,60,60,1,,,,,0\nPBUSH,60,K,9.,5.,,,,3.\n", elastic(5.0, 3.0)),
        ("GRID,9,,0.,0.,0.,,123456\nCELAS2,60,5.,1,2,9,2\n", elastic(5.0, 0.0)),
        ("GRID,9,,0.,0.,0.\nSPC1,1,26,9\nCBUSH,60,60,9,1,,,,0\nPBUSH,60,K,,5.\n", elastic(5.0, 0.0)),
        ("GRID,9,,0.,0.,0.,,123456\nRBE2,60,9,2,1\n", "pinned"),
    ],
)
def test_springs_from_an_end_to_the_ground_are_an_elastic_end(read, cards, tail):
    support = read(DECK + cards).vehicle.support
    assert (support.nose, support.tail) == ("free", tail)


def test_the_springs_of_an_end_have_the_units_of_the_deck(read):
    tail = read(DECK + "CELAS2,60,5.,1,2\nCELAS2,62,3.,1,6\n", length_unit="mm", force_unit="kN").vehicle.support.tail
    assert (tail.translation, tail.rotation) == pytest.approx((5e6, 3.0), rel=1e-15)


@pytest.mark.parametrize("nose", [elastic(3.0, 0.25), elastic(0.0, 1 / 3), elastic(math.inf, 2.0), "sliding", "free"])
def test_elastic_ends_come_back_from_a_deck(tmp_path, nose):
    v = catalog.beck().model_copy(update={"support": Support(nose=nose, tail=elastic(0.5, math.inf))})
    path = tmp_path / "vehicle.bdf"
    path.write_bytes(content(v, path))
    again = imported(path).vehicle.support
    assert again.stiffness == tuple(pytest.approx(end, rel=1e-13) for end in v.support.stiffness)


def test_row_b_of_a_bush_is_the_dashpots_of_a_joint(read):
    found = read(JOINTED + "CBUSH,9,9,2,4,,,,0\nPBUSH,9,K,,20.,,,,30.\n,,B,,4.,,,,6.\n,,GE,.01\n")
    (joint,) = found.vehicle.joints
    assert (joint.shear_stiffness, joint.rotational_stiffness) == (20.0, 30.0)
    assert (joint.shear_damping, joint.rotational_damping) == (4.0, 6.0)
    assert found.ignored == ("line 10, PBUSH 9: structural damping (GE) is left out",)


@pytest.mark.parametrize(
    "joint",
    [
        Joint(rotational_stiffness=3.0, shear_stiffness=4.0, rotational_damping=0.5, shear_damping=0.25),
        Joint(rotational_stiffness=3.0, rotational_damping=0.5, shear_damping=0.25),
        Joint(rotational_damping=0.5),
        Joint(),
    ],
)
def test_dashpots_come_back_from_a_deck(tmp_path, joint):
    v = catalog.tsto(0.6, 1.0, 1.0).model_copy(update={"joints": (joint,)})
    path = tmp_path / "vehicle.bdf"
    path.write_bytes(content(v, path))
    assert imported(path).vehicle == v


@pytest.mark.parametrize(
    ("card", "rotational", "shear"),
    [
        ("RBAR,9,2,4,123456\n", math.inf, math.inf),
        ("RBAR,9,4,2,123456,,,1235\n", 0.0, math.inf),
    ],
)
def test_a_rigid_bar_between_grids_at_one_station_ties_them(read, card, rotational, shear):
    (joint,) = read(JOINTED + card).vehicle.joints
    assert (joint.rotational_stiffness, joint.shear_stiffness) == (rotational, shear)


def test_constraints_may_be_united(read):
    cards = "SPC1,1,2,1\nSPC1,2,6,1\nSPC1,3,26,3\nSPCADD,9,1,2\n"
    found = read(f"SPC = 9\nBEGIN BULK\n{DECK}{cards}ENDDATA\n")
    assert (found.vehicle.support.nose, found.vehicle.support.tail) == ("free", "clamped")
    assert found.ignored == ("line 12, SPC1 3: these constraints are left out: set 9 is in use",)


def test_ranges_hold_the_grids_that_are_there(read):
    found = read(DECK + "SPC1,1,1345,3,1,THRU,2\nSPC1,1,26,1,THRU,1\nSPC1,1,2,77\n")
    assert found.vehicle.support.tail == "clamped"
    assert found.ignored == ("line 10, SPC1 1: holds grids that are missing",)


@pytest.mark.parametrize(
    ("cards", "expected"),
    [
        ("CELAS2,60,5.,2,2\n", "CELAS2 60: stands on the ground"),
        ("CELAS2,60,5.\n", "the same component of two grids, found none"),
        ("CELAS2,60,5.,1,7\n", "the same component of two grids, found '7'"),
        ("GRID,4,,2.\nRBAR,60,2,4,12\n", "must have 123456"),
        ("CBUSH,60,60,1\n", "PBUSH 60 is missing"),
        ("CBUSH,60,60,1,,,,,0\nPBUSH,60,K,,-5.\n", "must not be negative"),
        ("CBUSH,60,60,1,,,,,0\nPBUSH,60,M,,5.\n", "its row M is not read"),
        ("SPC1,1,1345,3,THRU,1\n", "found 3 THRU 1"),
        ("SPC1,1,7,1\n", "components must be digits"),
        ("SPC,1,1,2,.5\n", "enforces a motion"),
        ("CONM2,50,77,,1.\nRBE2,60,2,123456,77\n", "sits on grid 77, which is missing"),
    ],
)
def test_what_holds_no_stick_is_refused(read, cards, expected):
    with pytest.raises(ModelError) as error:
        read(DECK + cards)
    assert expected in str(error.value)


def test_the_dashpot_of_an_end_is_listed(read):
    found = read(DECK + "CBUSH,60,60,1,,,,,0\nPBUSH,60,K,,5.\n,,B,,1.\n")
    assert found.ignored == ("line 8, CBUSH 60: the dashpot of an end is left out",)
