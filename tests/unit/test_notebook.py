"""What a notebook shows: cells run in IPython's shell, and their HTML read back."""

import base64
import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import beal
from beal.shown import Shown

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))
VOID = {"img", "br", "hr"}


class Nesting(HTMLParser):
    """Text of a page whose elements are closed in order."""

    def __init__(self):
        super().__init__()
        self.open, self.text = [], []

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1:] != ["style"]:
            self.text.append(data)


def text_of(html):
    page = Nesting()
    page.feed(html)
    assert page.open == []
    return " ".join(page.text)


def pictures(html):
    """The SVG documents inside, parsed."""
    found = re.findall(r'src="data:image/svg\+xml;base64,([^"]+)"', html)
    return [ElementTree.fromstring(base64.b64decode(content)) for content in found]


@pytest.fixture(scope="module")
def shell():
    """Runs cells in a shell of IPython and gives the HTML that a notebook shows."""
    interactive = pytest.importorskip("IPython.core.interactiveshell").InteractiveShell
    here = interactive.instance()
    formatter = here.display_formatter.formatters["text/html"]

    def run(cell):
        done = here.run_cell(cell, store_history=False)
        done.raise_error()
        return None if done.result is None else formatter(done.result)

    yield run
    interactive.clear_instance()


@pytest.fixture(scope="module")
def tsto():
    return beal.catalog.tsto(0.6, 5000.0, 5000.0)


def controlled(vehicle):
    law = beal.Control(gains=[beal.Gain(sensor="imu", quantity="slope", gain=0.6)])
    return vehicle.model_copy(update={"control": law})


def released(vehicle):
    return beal.response(beal.discretise(vehicle), 0.2, 90.0, initial=beal.Release(0.1))


def delayed(vehicle):
    law = beal.Control(gains=[beal.Gain(sensor="imu", quantity="slope", gain=0.6)], lag=0.02)
    return vehicle.model_copy(update={"control": law})


def scattered(vehicle):
    spring = {"joint[0].shear_stiffness": beal.Distribution.lognormal(median=5000.0, cv=0.3)}
    return beal.sample(beal.Uncertain(vehicle, spring), 64, workers=1)


GRID = {"joint[0].rotational_stiffness": [1.0, 1e2, 1e4], "joint[0].shear_stiffness": [1e2, 1e3, 1e4]}
RESULTS = {
    "critical": (lambda vehicle: beal.critical_thrust(vehicle), "flutter at P = 106.437231", 0),
    "stable": (lambda vehicle: beal.critical_thrust(vehicle, 50.0), "stable up to P = 50, as far as", 0),
    "tumbling": (
        lambda vehicle: beal.critical_thrust(vehicle.model_copy(update={"thrust": beal.Thrust(tangency=0.9)})),
        "tumbles as a rigid body",
        0,
    ),
    "curve": (lambda vehicle: beal.thrust_curve(vehicle, 120.0, 13), "4 modes over thrust, 13 points", 1),
    "response": (lambda vehicle: released(vehicle), "motion under P = 90", 1),
    "spectrum": (lambda vehicle: beal.spectrum(beal.discretise(vehicle), 50.0), "elastic modes at P = 50", 0),
    "floquet": (lambda vehicle: beal.floquet(vehicle, 50.0, 5.0, 30.0), "P = 50 + 5 cos(30 t): unstable", 1),
    "margins": (lambda vehicle: beal.stability_margins(delayed(vehicle), 8.0), "smallest margins at P = 8: ", 0),
    "no margins": (lambda vehicle: beal.stability_margins(controlled(vehicle), 8.0), "no margins at P = 8: ", 0),
    "controlled": (
        lambda vehicle: beal.controlled_thrust(controlled(vehicle)),
        "with the loop closed: divergence at P = 25.61",
        0,
    ),
    "fed": (lambda vehicle: beal.controlled_thrust(delayed(vehicle)), "unstable under any thrust", 0),
    "sensitivity": (lambda vehicle: beal.sensitivity(vehicle), "flutter at P = 106.437231; derivatives: smooth", 1),
    "sample": (lambda vehicle: scattered(vehicle), "64 vehicles: 0 stable, 64 flutter", 1),
    "refined": (lambda vehicle: beal.refined_map(vehicle, GRID, 0.25), "points, and ", 1),
    "closed loop": (lambda vehicle: beal.closed_loop(controlled(vehicle), 8.0, 2), "closed loop at P = 8: ", 0),
    "locus": (lambda vehicle: beal.control_locus(controlled(vehicle), "thrust", [2.0, 4.0], modes=1), "", 1),
    "vehicle": (lambda vehicle: vehicle, "rotational stiffness", 1),
}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_is_shown_with_what_it_says_and_its_figures(tsto, name):
    make, words, figures = RESULTS[name]
    html = make(tsto)._repr_html_()
    assert words in text_of(html)
    assert [picture.tag.endswith("svg") for picture in pictures(html)] == [True] * figures
    assert "http" not in re.sub(r'src="[^"]*"', "", html)


def test_a_flight_is_shown_with_its_least_margin():
    vehicle = beal.catalog.beck().model_copy(
        update={"timeline": beal.Timeline(time=(0.0, 1.0), thrust=(5.0, 10.0)), "thrust": beal.Thrust()}
    )
    html = beal.flight(vehicle)._repr_html_()
    assert "least margin 1.0051 at t = 1" in text_of(html)  # 20.0509536 / 10 - 1
    assert len(pictures(html)) == 1


def test_a_sample_of_which_nothing_could_be_solved_says_so():
    nothing = np.full(64, np.nan)
    found = beal.Sample(("x",), nothing[:, None], nothing, np.full(64, -1, np.int8), 1.0, "monte-carlo", 0, 1)
    assert "64 not solved" in text_of(found._repr_html_())


def test_si_units_are_told():
    stage = beal.Stage(length=20.0, mass_per_length=500.0, bending_stiffness=2e8)
    found = beal.critical_thrust(beal.Vehicle(stages=[stage]))
    assert found.units == "SI"
    assert "flutter at P = 54.8445960 MN" in text_of(found._repr_html_())


def test_names_are_text_and_no_markup():
    stage = beal.Stage(name="<b>x", length=1.0, mass_per_length=1.0, bending_stiffness=1.0)
    html = beal.Vehicle(title="<script>", stages=[stage])._repr_html_()
    assert "<script" not in html
    assert "<b>x" in text_of(html)


def test_without_matplotlib_the_tables_are_shown(tsto, monkeypatch):
    for name in [name for name in sys.modules if name.startswith(("matplotlib", "beal.plot"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delattr(beal, "plot", raising=False)
    words = text_of(tsto._repr_html_())
    assert "Figures need matplotlib" in words
    assert "bending stiffness" in words


def test_what_nobody_knows_how_to_show_is_an_error():
    with pytest.raises(TypeError, match="Shown: no way to show it"):
        Shown()._repr_html_()


def test_a_cell_shows_its_result(shell):
    shell("import beal")
    assert "flutter at P = 20.0509536" in text_of(shell("beal.critical_thrust(beal.catalog.beck())"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_a_notebook_of_the_examples_runs_and_shows_what_it_says(shell, path, monkeypatch):
    monkeypatch.chdir(path.parent)
    notebook = json.loads(path.read_text(encoding="utf-8"))
    assert notebook["nbformat"] == 4
    shown = [shell("".join(cell["source"])) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert not any(cell.get("outputs") for cell in notebook["cells"])  # outputs are made, not kept
    words = " ".join(text_of(html) for html in shown if html)
    told = re.findall(r"`([^`]*P = [^`]*)`", json.dumps(notebook, ensure_ascii=False))
    assert told
    assert [claim for claim in told if claim not in words] == []
    assert sum(len(pictures(html)) for html in shown if html) >= 3
