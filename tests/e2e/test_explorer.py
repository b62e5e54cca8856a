"""The explorer in a real browser, as its users have it."""

import base64
import json
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import beal
from beal.interop.files import content
from beal.vehicle import catalog
from beal.web.examples import example_text

playwright = pytest.importorskip("playwright.sync_api")
axe = pytest.importorskip("axe_playwright_python.sync_playwright")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = "--headless=new --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking"
FLAGS += " --disable-component-update --disable-sync"
PATIENCE = 30_000  # ms, on a machine that does much else
KR = "#q-joint-0-rotational_stiffness"

pytestmark = pytest.mark.skipif(
    CHROMIUM is None, reason="NO BROWSER: the explorer is NOT tested; install chromium (Debian: apt install chromium)"
)


@pytest.fixture(scope="module")
def address():
    """Of a server as the command starts it."""
    command = [Path(sys.executable).with_name("beal"), "explore", "--no-browser", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        yield json.loads(server.stdout.readline())["address"]
        server.terminate()


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as engine:
        playwright.expect.set_options(timeout=PATIENCE)
        chromium = engine.chromium.launch(executable_path=CHROMIUM, args=FLAGS.split())
        yield chromium
        chromium.close()


@pytest.fixture
def page(browser, address):
    """A fresh page, which neither complains nor asks for anything from elsewhere."""
    context = browser.new_context(viewport={"width": 1280, "height": 720}, accept_downloads=True)
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    wrong = []

    def said(message):
        if message.type in ("error", "warning") and "status of 422" not in message.text:  # an answer that refuses
            wrong.append(message.text)

    page.on("console", said)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("request", lambda sent: re.match(rf"{address}|data:|blob:", sent.url) or wrong.append(sent.url))
    page.goto(address)
    says(page, "106.437231")
    yield page
    context.close()
    assert wrong == []


def says(page, text):
    playwright.expect(page.locator("#verdict .words")).to_contain_text(text)


def until(page, condition):
    """Waits for it; the page's own rules forbid what playwright would wait by."""
    deadline = time.monotonic() + PATIENCE / 1000
    while not page.evaluate(condition):
        assert time.monotonic() < deadline, condition
        page.wait_for_timeout(50)


def put(page, field, text):
    page.fill(field, text)
    page.press(field, "Enter")


def drop(page, name, data):
    page.evaluate(
        """([name, data]) => {
            const held = new DataTransfer();
            held.items.add(new File([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))], name));
            document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: held, bubbles: true }));
        }""",
        [name, base64.b64encode(data).decode()],
    )


def test_the_page_opens_with_a_vehicle_and_all_its_charts(page):
    says(page, "modes 1 and 2 meet")
    for chart in ("curve", "locus", "map", "response", "phase"):
        until(page, f"document.getElementById('{chart}').data?.length > 0")
    assert page.locator("#drawing .body").count() == 2
    assert page.locator("#drawing text").all_text_contents() == ["imu", "F(t), sine"]


def test_a_slider_a_field_and_a_switch_change_the_verdict(page):
    put(page, KR, "1")
    says(page, "Diverges at")
    page.locator(f".field:has({KR}) .rigid input").check()
    page.locator(".field:has(#q-joint-0-shear_stiffness) .rigid input").check()
    says(page, "109.689192")
    page.locator(f".field:has({KR}) .rigid input").uncheck()
    slider = page.locator(f".field:has({KR}) input[type=range]")
    slider.evaluate("(slider) => { slider.value = 0; slider.dispatchEvent(new Event('input', { bubbles: true })); }")
    says(page, "Diverges at")
    page.select_option("#q-joint-0-shear_axis", "aft")
    page.click("#reset")
    says(page, "106.437231")


def test_formulations_turn_the_papers_numbers_into_the_right_one(page):
    for name, thrust in (("as-printed", "109.615937"), ("converged", "109.34644"), ("objective", "106.437231")):
        page.select_option("#formulation", name)
        says(page, thrust)


def test_an_error_stands_beside_its_field(page):
    put(page, KR, "-3")
    field = page.locator(f".field:has({KR})")
    playwright.expect(field.locator(".error")).to_contain_text("must be greater than or equal to 0")
    assert field.locator("input.number").get_attribute("aria-invalid") == "true"
    put(page, KR, "5000")
    playwright.expect(field.locator(".error")).to_have_text("")
    page.select_option("#example", "beck")
    says(page, "20.0509536")
    page.select_option("#formulation", "as-printed")
    playwright.expect(page.locator('.error[data-path="formulation"]')).to_contain_text("two stages")


def test_what_is_being_typed_is_not_overwritten_by_an_answer(page):
    put(page, KR, "300")
    page.fill("#q-stage-split", "0.8")
    page.wait_for_timeout(1500)  # in which the answers to the first change come
    assert page.input_value("#q-stage-split") == "0.8"
    page.press("#q-stage-split", "Enter")
    says(page, "106.472038")


def test_changes_are_undone_and_redone(page):
    put(page, KR, "1")
    says(page, "Diverges at")
    page.locator("#undo").focus()
    page.keyboard.press("Control+z")
    says(page, "106.437231")
    page.keyboard.press("Control+Shift+z")
    says(page, "Diverges at")


def test_the_address_holds_the_vehicle_and_the_view(page, browser):
    put(page, KR, "300")
    page.select_option("#formulation", "converged")
    says(page, "108.980564")
    shared = page.url
    page.goto("about:blank")
    page.goto(shared)
    says(page, "108.980564")
    assert page.input_value(KR) == "300"
    assert page.input_value("#formulation") == "converged"


def test_a_joint_is_moved_by_the_keyboard_and_by_the_pointer(page):
    joint = page.locator("#drawing .joint")
    joint.focus()
    page.keyboard.press("ArrowLeft")
    playwright.expect(page.locator("#q-stage-split")).to_have_value("0.59")
    playwright.expect(joint).to_have_attribute("aria-valuenow", "0.59")  # drawn there, too
    page.click("#play")
    box = joint.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 150, y, steps=4)
    page.mouse.up()
    moved = float(page.input_value("#q-stage-split"))
    assert 0.3 < moved < 0.5
    page.click("#undo")
    playwright.expect(page.locator("#q-stage-split")).to_have_value("0.59")


def test_everything_is_reached_and_named_without_a_pointer(page):
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the verdict"
    nameless = page.evaluate(
        """() => [...document.querySelectorAll("button, input:not([hidden]), select, textarea, [role=img], [tabindex]")]
            .filter((one) => !(one.getAttribute("aria-label") || one.labels?.length || one.textContent.trim()))
            .map((one) => one.outerHTML)"""
    )
    assert nameless == []
    seen = set()
    for _ in range(70):
        page.keyboard.press("Tab")
        seen.add(page.evaluate("document.activeElement.id || document.activeElement.getAttribute('aria-label')"))
    assert {"formulation", "example", KR[1:], "thrust", "play", "map-x", "duration", "station of joint 1"} <= seen
    slider = page.locator(f".field:has({KR}) input[type=range]")
    slider.focus()
    page.keyboard.press("Home")
    says(page, "Diverges at")


@pytest.mark.parametrize("size", [(1280, 720), (820, 1180)], ids=str)
def test_axe_finds_no_barrier(page, size):
    page.set_viewport_size({"width": size[0], "height": size[1]})
    until(page, "document.getElementById('map').data?.length === 3")
    page.select_option("#further-kind", "pulsation")
    until(page, "document.getElementById('further').data?.length > 0")
    for _ in ("light", "dark"):
        assert barriers(page) == []
        page.click("#theme")
    put(page, KR, "-3")
    playwright.expect(page.locator(f".field:has({KR}) .error")).not_to_have_text("")
    assert barriers(page) == []
    for opens, dialog in (("#edit", "#text-dialog"), ("#code", "#code-dialog")):
        put(page, KR, "5000")
        page.click(opens)
        playwright.expect(page.locator(dialog)).to_be_visible()
        assert barriers(page) == []
        page.keyboard.press("Escape")


def barriers(page):
    found = axe.Axe().run(page).response["violations"]
    return [(barrier["id"], [node["html"] for node in barrier["nodes"]]) for barrier in found]


def test_the_motion_moves_and_flutters_at_the_instability(page):
    path = page.locator("#drawing .body").first
    before = path.get_attribute("d")
    page.wait_for_timeout(200)
    assert path.get_attribute("d") != before
    page.click("#at-critical")
    playwright.expect(page.locator("#motion")).to_contain_text("flutters")
    playwright.expect(page.locator("#growth")).to_contain_text("grows as exp(")
    page.click("#play")
    page.wait_for_timeout(100)
    still = path.get_attribute("d")
    page.wait_for_timeout(200)
    assert path.get_attribute("d") == still


def test_a_click_on_the_map_sets_the_vehicle(page):
    until(page, "document.getElementById('map').data?.length === 3")
    area = page.locator("#map .nsewdrag").first.bounding_box()
    page.mouse.click(area["x"] + 12, area["y"] + 20)
    says(page, "Diverges at")
    assert float(page.input_value(KR)) < 5


def test_further_charts_are_offered_where_the_vehicle_has_what_they_need(page):
    until(page, "document.querySelector('#further-kind [value=flight]').disabled")
    page.select_option("#further-kind", "pulsation")
    until(page, "document.getElementById('further').getAttribute('aria-label').includes('resonances 2 w1')")
    page.click("#further-stop")
    law = "[control]\nlag = 0.02\ngains = [{sensor = 'imu', quantity = 'slope', gain = 0.5}]\n"
    drop(page, "controlled.toml", (beal.dumps(beal.loads(example_text("tsto"))) + law).encode())
    until(page, "!document.querySelector('#further-kind [value=loop]').disabled")
    page.select_option("#further-kind", "loop")
    until(page, "document.getElementById('further').getAttribute('aria-label').startsWith('Open loop, closed loop')")


@pytest.mark.parametrize(
    ("example", "length", "thrust", "drafted"),
    [("tsto", "0.6", "106.437231", False), ("generic_small_launcher", "1.6", "68.9667258", True)],
)
def test_a_curve_is_that_of_the_command(page, tmp_path, example, length, thrust, drafted):
    page.select_option("#example", example)
    says(page, thrust)
    playwright.expect(page.locator("#q-stage-0-length")).to_have_value(length)
    slider = page.locator(".field:has(#q-stage-0-length) input[type=range]")
    moved = "(slider) => { slider.value = 550; slider.dispatchEvent(new Event('input', { bubbles: true })); }"
    page.evaluate("seen = []; document.getElementById('curve').on('plotly_afterplot', () => "
                  "seen.push(document.getElementById('verdict').className))")  # fmt: skip
    slider.evaluate(moved)
    playwright.expect(page.locator("#verdict .words")).not_to_contain_text(thrust)
    assert ("waiting" in page.evaluate("seen[0]")) == drafted  # of a launcher a draft comes first
    with page.expect_download() as download:
        page.click("#save")
    vehicle = beal.load(saved(download, tmp_path / "vehicle.toml"))
    with page.expect_download() as download:
        page.locator("[data-chart=curve]").select_option("CSV")
    names, *rows = saved(download, tmp_path / "curve.csv").read_text().split()
    shown = dict(zip(names.split(","), np.array([row.split(",") for row in rows], dtype=float).T, strict=True))
    found = beal.thrust_curve(vehicle, shown["thrust"][-1], len(rows), 4)
    drawn = np.array([shown[f"angular_frequency_{mode + 1}"] for mode in range(4)]).T
    assert drawn == pytest.approx(found.angular_frequency, rel=1e-5)


def test_a_flight_is_drawn_with_what_the_vehicle_bears(page):
    page.select_option("#example", "generic_small_launcher")
    until(page, "!document.querySelector('#further-kind [value=flight]').disabled")
    page.select_option("#further-kind", "flight")
    playwright.expect(page.locator("#further-note")).to_contain_text("margin at least")
    until(page, "document.getElementById('further').data?.map(({ name }) => name).includes('thrust')")
    page.click("#further-stop")


def test_files_are_opened_by_drop(page):
    drop(page, "stick.bdf", content(catalog.tsto(0.8, 1e4, 1e4), "stick.bdf"))
    says(page, "108.59")
    drop(page, "column.toml", beal.dumps(catalog.beck()).encode())
    says(page, "20.0509536")
    drop(page, "table.csv", content(catalog.tsto(0.6, 5000.0, 5000.0), "table.csv"))
    says(page, "106.437231")
    drop(page, "table.xlsx", content(catalog.tsto(0.8, 1e4, 1e4), "table.xlsx"))
    says(page, "108.59")


def test_an_entry_of_a_table_has_a_field(page):
    taper = {"x": [0.0, 1.0], "value": [1.0, 1.0]}
    column = {"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": taper}
    vehicle = beal.Vehicle(stages=[column], support={"nose": "clamped"}, units="nondimensional")
    drop(page, "taper.toml", beal.dumps(vehicle).encode())
    says(page, "20.0509536")
    page.locator("summary", has_text="Stage 1 bending stiffness").click()
    put(page, "#q-stage-0-bending_stiffness-value-1-", "0.5")
    softer = {"x": [0.0, 1.0], "value": [1.0, 0.5]}
    vehicle = vehicle.model_copy(update={"stages": [{**column, "bending_stiffness": softer}]})
    says(page, f"{beal.critical_thrust(vehicle).critical_thrust:.9g}")


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("no.xlsx", b"PK no workbook", "xlsx"),
        ("notes.txt", b"hello", "must end with .toml"),
        ("broken.toml", b"[[stage]]\nlength = -1\n", "stage[0].length: must be greater than 0"),
        ("empty.bdf", b"", "CBAR"),
        ("picture.csv", bytes(range(256)), "UTF-8"),
    ],
)
def test_bad_files_are_refused_with_the_reason(page, name, data, reason):
    drop(page, name, data)
    playwright.expect(page.locator("#problem")).to_contain_text(reason)
    says(page, "106.437231")


def test_what_is_seen_is_saved(page, tmp_path):
    put(page, KR, "300")
    says(page, "106.074624")
    with page.expect_download() as download:
        page.click("#save")
    assert beal.load(saved(download, tmp_path / "vehicle.toml")).joints[0].rotational_stiffness == 300.0
    for kind, begins in (("PNG", b"\x89PNG"), ("SVG", b"<svg"), ("CSV", b"thrust,angular_frequency_1")):
        with page.expect_download() as download:
            page.locator("[data-chart=curve]").select_option(kind)
        assert saved(download, tmp_path / "file").read_bytes().startswith(begins)


def saved(download, path):
    download.value.save_as(path)
    return path


def test_code_and_link_are_copied(page):
    put(page, KR, "300")
    says(page, "106.074624")
    page.click("#code")
    page.click("[data-copy=code-python]")
    script = page.evaluate("navigator.clipboard.readText()")
    assert "rotational_stiffness = 300.0" in script
    compile(script, "copied", "exec")
    assert "beal critical vehicle.toml" in page.input_value("#code-command")
    page.keyboard.press("Escape")
    page.click("#share")
    assert page.evaluate("navigator.clipboard.readText()") == page.url


def test_the_text_of_the_model_is_edited_with_its_errors_beside_it(page):
    page.click("#edit")
    playwright.expect(page.locator("#text-dialog")).to_be_visible()
    text = page.input_value("#text")
    page.fill("#text", text.replace("rotational_stiffness = 5000.0", "rotational_stiffness = -1"))
    page.click("#text-use")
    playwright.expect(page.locator("#text-errors")).to_contain_text("joint[0].rotational_stiffness")
    page.fill("#text", text.replace("rotational_stiffness = 5000.0", "rotational_stiffness = 1"))
    page.click("#text-use")
    says(page, "Diverges at")


@pytest.mark.parametrize("size", [(1280, 720), (820, 1180), (390, 844)], ids=str)
def test_nothing_runs_out_of_the_screen(page, size):
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.wait_for_timeout(300)
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    clipped = page.evaluate(
        """() => [...document.querySelectorAll("main .bar *, header *, aside label")].filter((one) =>
            one.getBoundingClientRect().right > innerWidth + 1 && one.id !== "file").map((one) => one.outerHTML)"""
    )
    assert clipped == []


def test_dark_is_chosen_and_remembered(page, address):
    page.click("#theme")
    colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert sum(map(int, re.findall(r"\d+", colour)[:3])) < 200
    page.goto("about:blank")
    page.goto(address)
    assert page.locator("#theme").inner_text() == "Light"
