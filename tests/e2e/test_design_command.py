"""``beal design`` as a user runs it."""

import json

import pytest

STUDY = """
model = "model.toml"
[design]
starts = 1
[variables]
"joint[0].rotational_stiffness" = {low = 5.0, high = 50.0}
[scenario.bolts_lost]
multiply = {"joint[0].rotational_stiffness" = 0.2}
"""


@pytest.fixture
def folder(beal, tmp_path):
    beal("example", "tsto", "-o", "model.toml")
    (tmp_path / "study.toml").write_text(STUDY)
    return tmp_path


def test_the_answer_is_one_object_and_the_design_a_model(beal, folder):
    done = beal("design", "study.toml", "--figure", "a.png", "--report", "a.html", "-o", "best.toml", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    (variable,) = found["variables"]
    assert (variable["path"], variable["low"], variable["high"]) == ("joint[0].rotational_stiffness", 5.0, 50.0)
    assert variable["range"]["low_edge"] == "jump"
    assert variable["range"]["low_kind"] == "divergence"
    assert [case["name"] for case in found["scenarios"]] == ["as designed", "bolts_lost"]
    assert found["scenarios"][1]["critical_thrust"] < found["critical_thrust"]
    assert found["gaps"] == []
    again = json.loads(beal("critical", "best.toml", "--json").stdout)
    assert again["critical_thrust"] == pytest.approx(found["critical_thrust"], rel=1e-6)
    assert again["margin"] == pytest.approx(found["margin"], rel=1e-5)
    assert (folder / "a.png").stat().st_size > 10_000
    assert "best.toml" in (folder / "a.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("starts = 1", 'objective = "mass"\ntarget = 1e6', "out of reach: 1000000 asked for"),
        ("starts = 1", "starts = 0", "design.starts"),
        ("high = 50.0", "high = 1.0", "contradictory bounds"),
        ('joint[0].rotational_stiffness" = {low', 'joint[4].rotational_stiffness" = {low', "index out of range"),
        ("[scenario", "[scenarios", "unknown key"),
        ("model.toml", "other.toml", "other.toml"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_a_line(beal, folder, old, new, message):
    (folder / "study.toml").write_text(STUDY.replace(old, new))
    done = beal("design", "study.toml", "--figure", "a.png")
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert not (folder / "a.png").exists()
