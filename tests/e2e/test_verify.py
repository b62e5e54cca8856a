"""``beal verify``: its table, its JSON, its page, and how it fails."""

import dataclasses

import pytest

import beal as package
from beal.verification import run
from beal.verification.case import printed

KEYS = {
    *("name", "title", "source", "quantity", "published", "published_as", "reference", "value", "error_estimate"),
    *("second", "verdict", "reason"),
}


def test_json_holds_one_object_per_value(result_of):
    thrust, frequency = result_of("verify", "--case", "reut")["cases"]
    assert set(thrust) == set(frequency) == KEYS
    assert (thrust["name"], thrust["source"], thrust["quantity"]) == ("reut()", "Reut (1939)", "flutter thrust")
    assert thrust["value"] == pytest.approx(thrust["published"], rel=1e-12)
    assert abs(thrust["value"] - thrust["published"]) <= thrust["error_estimate"]
    assert thrust["value"] != thrust["second"] == pytest.approx(thrust["value"], rel=1e-8)
    assert (thrust["verdict"], frequency["verdict"]) == ("agrees", "no published value")
    assert frequency["published"] is None


def test_table_says_why_a_value_differs(beal_here):
    done = beal_here("verify", "--case", "Beal's missile")
    assert done.returncode == 0
    assert "109.9" in done.stdout
    assert "differs" in done.stdout
    assert "beal(), flutter thrust: 0.19 % above the exact load" in done.stdout


def test_page_is_that_of_the_documentation(beal_here):
    done = beal_here("verify", "--case", "hauger", "--markdown")
    assert done.stdout.startswith("# Known answers\n")
    assert "## Hauger's column\n\nHauger (1966).\n" in done.stdout
    assert "3 values: 0 agree, 0 differ, 3 have no published counterpart." in done.stdout


@pytest.mark.parametrize("options", [("--case", "nosuch"), ("--markdown", "--json")])
def test_bad_options_are_refused(beal_here, options):
    done = beal_here("verify", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert "nosuch" in done.stderr or "--markdown" in done.stderr


def test_a_value_that_differs_without_a_reason_fails(beal_here, monkeypatch, strict):
    case = run.chosen("reut")[0]
    wrong = {name: dataclasses.replace(known, published=printed("21")) for name, known in case.expected.items()}
    monkeypatch.setattr(run, "CASES", (dataclasses.replace(case, expected=wrong),))
    done = beal_here("verify", "--json")
    assert done.returncode == 3
    assert [row["verdict"] for row in strict(done.stdout)["cases"]] == ["differs", "differs"]
    assert "2 of 2 values differ without a known reason: reut(), flutter thrust; reut(), flutter" in done.stderr


def test_progress_is_told():
    seen = []
    rows = package.verify("hauger", lambda done, total: seen.append((done, total)))
    assert seen == [(1, 2), (2, 2)]
    assert {row.title for row in rows} == {"Hauger's column"}
