"""``--report``: one page that needs nothing else."""

import re
import shlex

import pytest

MODEL = """
title = "a <stick>"
units = "nondimensional"

[[stage]]
length = 1.0
mass_per_length = 1.0
bending_stiffness = 1.0

[thrust]
nominal = 10.0

[[sensor]]
name = "imu"
station = 0.5

[[force]]
station = 1.0
signal = {kind = "step", amplitude = 0.01}

[control]
gains = [{sensor = "imu", quantity = "slope", gain = 1.0}]
"""
RUNS = {
    "response": (("--duration", 0.5), "stable; "),
    "floquet": (("--amplitude", 1, "--angular-frequency", 44), "Largest modulus of the multipliers: 1.0"),
    "control": (("--modes", 2), "2 zero roots of rigid-body drift."),
}
CHART = ("--amplitude", "0:2:3", "--angular-frequency", "40:48:3")


@pytest.fixture
def model(written):
    return written(MODEL)


@pytest.mark.parametrize("command", RUNS)
def test_a_page_holds_question_model_answer_and_command_and_needs_nothing_else(model, beal_here, tmp_path, command):
    options, answer = RUNS[command]
    done = beal_here(command, model, *options, "--report", "run.html")
    assert (done.returncode, done.stderr) == (0, "beal: report written to run.html\n")
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert "a &lt;stick&gt;</h1>" in page
    assert answer in page
    for title in ("The model", "The vehicle, from nose to tail", "Do it again"):
        assert title in page
    assert shlex.join(["beal", command, model, *map(str, options), "--report", "run.html"]) in page
    assert {address[:19] for address in re.findall(r'(?:src|href)="([^"]+)', page)} == {"data:image/svg+xml;"}


@pytest.mark.parametrize("command", RUNS)
def test_a_report_changes_nothing_of_the_answer(model, result_of, command):
    options, _ = RUNS[command]
    found = result_of(command, model, *options, "--report", "run.html")
    assert found.pop("report") == "run.html"
    assert found == result_of(command, model, *options)


@pytest.mark.parametrize(("options", "pictures"), [(CHART, 2), ((*CHART[:3], "44"), 1)])
def test_a_chart_is_on_the_page_where_it_has_two_axes(model, beal_here, tmp_path, options, pictures):
    assert beal_here("floquet", model, *options, "--report", "run.html").returncode == 0
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert page.count("<figure") == pictures
    assert ("Resonances: 2 w1 = " in page) == (options is CHART)


def test_warnings_are_on_the_page_and_on_standard_error(model, beal, tmp_path):
    done = beal("response", model, "--duration", 1, "--step", 0.1, "--report", "run.html")
    assert "beal: warning: the step 0.1 is longer than a tenth of the shortest period" in done.stderr
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert re.search(r'class="warning".*<li>the step 0.1 is longer than a tenth', page, re.DOTALL)


@pytest.mark.parametrize("command", RUNS)
def test_another_ending_is_refused_before_any_work(model, beal_here, tmp_path, command):
    done = beal_here(command, model, *RUNS[command][0], "--report", "run.pdf")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "beal: run.pdf: --report: must end with .html, found .pdf\n"
    assert not (tmp_path / "run.pdf").exists()


def test_a_run_that_fails_leaves_no_page(model, beal_here, tmp_path):
    assert beal_here("response", model, "--duration", -1, "--report", "run.html").returncode == 2
    assert [path.name for path in tmp_path.iterdir()] == ["model.toml"]
