"""The sliders of a notebook: what Python answers, and the page's module in a browser, with no notebook between."""

import json
import shutil

import pytest

import beal
from beal.notebook.explorer import HERE

ROTATIONAL = "joint[0].rotational_stiffness"
BROWSER = shutil.which("chromium")
FLAGS = ["--no-sandbox", "--disable-background-networking"]
STAND_IN = """async (source) => {
  const made = await import(URL.createObjectURL(new Blob([source], {type: "text/javascript"})));
  const state = await window.state();
  let heard;
  const model = {
    get: (name) => state[name],
    set: (name, value) => (state[name] = value),
    save_changes: async () => { state.answer = await window.moved(state.values); heard(); },
    on: (name, call) => (heard = call),
    off: () => (heard = null),
  };
  made.default.render({model, el: document.body});
}"""


@pytest.fixture
def explorer():
    return beal.explore(beal.catalog.tsto(0.6, 5000.0, 5000.0))


def test_an_explorer_begins_with_the_joint_and_the_verdict(explorer):
    there = [quantity["path"] for quantity in explorer.quantities]
    assert there == [ROTATIONAL, "joint[0].shear_stiffness", "stage.split"]
    assert "flutter at P = 106.437231" in explorer.answer["html"]


def test_what_is_moved_is_answered_by_the_vehicle_that_it_makes(explorer):
    explorer.values = {ROTATIONAL: 10.0, "stage.split": 0.4}
    expected = beal.critical_thrust(beal.catalog.tsto(0.4, 10.0, 5000.0))
    assert f"{expected.kind} at P = {expected.critical_thrust:.9g}" in explorer.answer["html"]
    assert explorer.vehicle.boundaries == (0.0, 0.4, 1.0)
    assert explorer.answer["values"] == explorer.values


def test_a_value_that_cannot_be_is_answered_with_the_reason(explorer):
    explorer.values = {ROTATIONAL: -1.0}
    assert f"{ROTATIONAL}: must be greater than or equal to 0" in explorer.answer["html"]


def test_a_quantity_that_is_not_there_is_refused():
    with pytest.raises(beal.ModelError, match="nearest are"):
        beal.explore(beal.catalog.tsto(0.6, 1.0, 1.0), ["joint[0].rotational_stifness"])


def test_what_goes_to_the_page_is_strict_json(explorer):
    json.dumps([explorer.quantities, explorer.values, explorer.answer], allow_nan=False)
    rigid = beal.explore(beal.catalog.tsto(0.6, float("inf"), 5000.0))
    json.dumps(rigid.quantities, allow_nan=False)


@pytest.mark.skipif(BROWSER is None, reason="no chromium here")
def test_a_slider_in_a_browser_moves_the_vehicle(explorer):
    def moved(values):
        explorer.values = values
        return explorer.answer

    with pytest.importorskip("playwright.sync_api").sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=BROWSER, args=["--no-sandbox", "--disable-background-networking"]
        )
        page = browser.new_page()
        failures = []
        page.on("pageerror", lambda error: failures.append(error))
        page.expose_function("moved", moved)
        names = ("quantities", "values", "answer")
        page.expose_function("state", lambda: {name: getattr(explorer, name) for name in names})
        page.evaluate(STAND_IN, (HERE / "explorer.js").read_text(encoding="utf-8"))
        page.get_by_label(ROTATIONAL).evaluate("""slider => {
            for (const value of [4, 3, 2]) { slider.value = value; slider.dispatchEvent(new Event("input")); }
        }""")
        page.wait_for_function("document.body.innerText.includes('divergence at')")
        page.wait_for_timeout(500)  # the last of the three is answered too
        words = page.inner_text("body")
        browser.close()
    stiffness = explorer.vehicle.joints[0].rotational_stiffness
    assert stiffness == pytest.approx(2.718281828**2, rel=0.05)  # of a slider in 200 steps
    assert f"P = {beal.critical_thrust(explorer.vehicle).critical_thrust:.9g}" in words
    assert failures == []
