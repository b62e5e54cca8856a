"""Other programs' files in place of a model file, and ``beal convert`` between them."""

import shutil
from pathlib import Path

import pytest

from beal.interop.files import imported, load
from beal.vehicle.file import dumps

STICK = Path(__file__).parents[2] / "examples" / "plain_stick.bdf"
LAUNCHER = Path(__file__).parents[1] / "data" / "generic_small_launcher.bdf"


@pytest.fixture
def folder(tmp_path):
    shutil.copy(STICK, tmp_path / "stick.bdf")
    shutil.copy(STICK, tmp_path / "stick.DAT")
    shutil.copy(LAUNCHER, tmp_path / "launcher.bdf")
    return tmp_path


@pytest.mark.parametrize("name", ["stick.bdf", "stick.DAT"])
def test_a_deck_is_a_model(folder, result_of, name):
    assert result_of("modes", name, "--count", 1)["frequency_hz"] == pytest.approx([1.480870], rel=5e-7)


def test_check_lists_how_a_deck_was_read(folder, result_of, beal_here):
    resolved = result_of("check", "launcher.bdf")
    assert resolved["mass"] == pytest.approx(16765.0, abs=1e-3)
    assert any("the nose is at the highest x" in line for line in resolved["notes"])
    assert any("taken as rigid" in line for line in resolved["ignored"])
    printed = beal_here("check", "launcher.bdf").stdout
    assert [line for line in (*resolved["notes"], *resolved["ignored"]) if line not in printed] == []


def test_what_is_left_out_of_a_deck_is_said_by_every_command(folder, beal, strict):
    done = beal("modes", "launcher.bdf", "--count", 1, "--json")
    assert done.returncode == 0
    assert "line 568, CONM2 9008: hangs on a spring of 1.26e+03 rad/s, which is taken as rigid" in done.stderr
    assert strict(done.stdout)["rigid_body_modes"] == 2


def test_a_study_may_name_a_deck(folder, beal, written):
    written('model = "stick.bdf"\n[grid]\n"thrust.tangency" = {values = [1.0]}\n', "study.toml")
    assert beal("map", "study.toml", "-o", "out.zarr", "--workers", 1).returncode == 0


@pytest.mark.parametrize("middle", ["bdf", "dat", "csv", "xlsx"])
def test_a_model_comes_back_through_another_format(folder, beal_here, result_of, middle):
    assert beal_here("example", "tsto", "-o", "a.toml").returncode == 0
    assert beal_here("convert", "a.toml", f"b.{middle}").returncode == 0
    assert beal_here("convert", f"b.{middle}", "c.toml").returncode == 0
    for thrust in (0, 90):
        before, after = (
            result_of("modes", name, "--count", 4, "--thrust", thrust)["angular_frequency"]
            for name in ("a.toml", "c.toml")
        )
        assert after == pytest.approx(before, rel=1e-9)
    assert load(folder / "c.toml").sensors == load(folder / "a.toml").sensors


def test_convert_takes_the_options_of_a_deck(folder, result_of):
    options = ("--nose", "low", "--lumps", "spread", "--length-unit", "ft", "--force-unit", "lbf", "--plane", "xy")
    notes = result_of("convert", "stick.bdf", "stick.toml", *options)["notes"]
    assert "the nose is at the lowest x, bending in the plane xy" in notes
    v = load(folder / "stick.toml")
    assert [round(stage.length / 0.3048) for stage in v.stages] == [150, 100, 50]
    assert v.mass == pytest.approx(85000.001 * 4.4482216152605 / 0.3048, rel=1e-12)


def test_convert_takes_the_options_of_a_table(folder, beal_here, written):
    written("x,m,bending_stiffness\n0,2,30\n1,2,30\n1,4,30\n3,4,30\n", "table.csv")
    done = beal_here("convert", "table.csv", "table.toml", "--x-from", "tail", "--column", "mass_per_length=m")
    assert (done.returncode, done.stdout) == (0, "table.toml: 2 stages, 0 point masses, mass 10\n")
    assert [stage.length for stage in load(folder / "table.toml").stages] == [2.0, 1.0]


def test_a_deck_may_be_written_with_any_number_of_bars(folder, beal_here):
    beal_here("example", "tsto", "-o", "a.toml")
    beal_here("convert", "a.toml", "a.bdf", "--elements", "3")
    text = (folder / "a.bdf").read_text()
    assert text.count("CBAR,") == 6
    assert dumps(imported(folder / "a.bdf").vehicle).count("[[stage]]") == 2


@pytest.mark.parametrize("ending", ["csv", "uff", "nc", "mat"])
def test_mode_shapes_are_written(folder, beal_here, ending):
    done = beal_here("modes", "stick.bdf", "--count", 2, "-o", f"shapes.{ending}")
    assert (done.returncode, done.stderr) == (0, f"beal: mode shapes written to shapes.{ending}\n")
    assert (folder / f"shapes.{ending}").stat().st_size > 1000


@pytest.mark.parametrize("ending", ["uff", "nc", "mat"])
def test_histories_are_written(folder, beal_here, ending):
    beal_here("example", "tsto", "-o", "a.toml")
    out = f"motion.{ending}"
    assert beal_here("response", "a.toml", "--duration", 1, "--initial", "mode:1:0.01", "-o", out).returncode == 0
    assert (folder / out).stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("convert", "stick.bdf", "stick.docx"), "must end with .toml"),
        (("convert", "stick.bdf", "nowhere/stick.toml"), "nowhere/stick.toml: cannot be written"),
        (("convert", "nowhere.bdf", "stick.toml"), "nowhere.bdf: cannot be read: No such file"),
        (("convert", "stick.bdf", "stick.toml", "--x-from", "tail"), "x_from: does not suit .bdf files"),
        (("convert", "a.toml", "stick.bdf", "--nose", "low"), "nose: does not suit .toml files"),
        (("convert", "stick.bdf", "stick.toml", "--nose", "up"), "nose: must be one of high, low"),
        (("convert", "stick.bdf", "a.csv", "--column", "mass"), "--column: must be NAME=COLUMN"),
        (("curve", "stick.bdf", "--to", "1", "-o", "curve.uff"), ".uff files hold mode shapes and time histories"),
        (("modes", "cut.bdf"), "cut.bdf: 19 problems\n  line 47: the deck ends without ENDDATA: it may be cut off"),
        (("check", "cut.bdf"), "ENDDATA"),
    ],
)
def test_what_cannot_be_converted_is_refused(folder, beal_here, arguments, expected):
    text = (folder / "stick.bdf").read_text()
    (folder / "cut.bdf").write_text(text[: text.index("PBAR          30")])
    done = beal_here(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert expected in done.stderr
    assert "Traceback" not in done.stderr
    assert not (folder / "stick.toml").exists()
