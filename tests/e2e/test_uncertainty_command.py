"""``beal uncertainty`` as a user runs it."""

import json

import pytest

STUDY = """
model = "model.toml"
[uncertain]
"joint[0].rotational_stiffness" = {distribution = "lognormal", median = 10.0, cv = 0.5}
"joint[0].shear_stiffness" = {distribution = "uniform", low = 100.0, high = 300.0}
[sampling]
samples = 512
[scenario.bolts_lost]
multiply = {"joint[0].rotational_stiffness" = 0.7}
"""
CORRELATED = """[correlation]
pairs = [{between = ["joint[0].rotational_stiffness", "joint[0].shear_stiffness"], value = 0.5}]
"""


@pytest.fixture
def folder(beal, tmp_path):
    beal("example", "tsto", "-o", "model.toml")
    (tmp_path / "study.toml").write_text(STUDY)
    return tmp_path


def test_the_result_is_one_object_with_a_figure_and_a_table(beal, folder):
    names = ("study.toml", "--thrust", 50, "--indices", 64, "--morris", 4, "--figure", "a.png", "-o", "a.csv", "--json")
    done = beal("uncertainty", *names)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["samples"] == sum(found["kind"].values()) == 512
    assert found["probability_of_instability"]["low"] < found["probability_of_instability"]["high"] < 0.2
    assert [case["name"] for case in found["scenarios"]] == ["as designed", "bolts_lost"]
    assert len(found["sobol"]["total"]) == len(found["morris"]["mean_absolute"]) == 2
    assert (folder / "a.png").stat().st_size > 10_000
    assert len((folder / "a.csv").read_text().splitlines()) == 513
    assert beal("uncertainty", *names).stdout == done.stdout


@pytest.mark.parametrize(
    ("old", "new", "options", "message"),
    [
        ('"lognormal", median = 10.0', '"normal", mean = 10.0', (), "of its probability to others"),
        ("samples = 512", "samples = 8", (), "samples: must lie between 64"),
        ("joint[0].shear", "joint[7].shear", (), "joint[7].shear_stiffness: index out of range"),
        ("[sampling]", CORRELATED + "[sampling]", ("--indices", 64), "indices need independent quantities"),
        ("[sampling]", "[sampling]", ("--thrust", 1e9), "searched to"),
    ],
)
def test_a_study_that_cannot_be_is_refused_in_a_line(beal, folder, old, new, options, message):
    (folder / "study.toml").write_text(STUDY.replace(old, new))
    done = beal("uncertainty", "study.toml", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert "Traceback" not in done.stderr
