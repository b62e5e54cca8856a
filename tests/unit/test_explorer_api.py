"""The explorer's server: the same answers as the command, every refusal in one form, and who is let in."""

import ast
import base64
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import anyio
import httpx
import numpy as np
import pytest
import schemathesis
from anyio.from_thread import start_blocking_portal
from hypothesis import HealthCheck, settings

import beal
from beal.interop.files import content
from beal.vehicle import catalog
from beal.web.app import LONGEST, application
from beal.web.examples import EXAMPLES, example_text
from beal.web.guard import LARGEST
from beal.web.openapi import description
from beal.web.worker import QUESTIONS

ADDRESS = "http://127.0.0.1:8000"
KR, KS = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
JSON = {"content-type": "application/json"}
TSTO = example_text("tsto")
APP = application()

pytestmark = pytest.mark.filterwarnings("ignore::beal.motion.AliasingWarning")


@pytest.fixture(scope="module", autouse=True)
def loop():
    """One event loop for all questions, which keeps the processes that answer."""
    global portal
    with start_blocking_portal() as portal:
        yield


def request(method, path, **options):
    async def sent():
        transport = httpx.ASGITransport(app=APP)
        async with httpx.AsyncClient(transport=transport, base_url=ADDRESS) as client:
            return await client.request(method, path, **options)

    return portal.call(sent)


def ask(name, /, **question):
    reply = request("POST", f"/api/{name}", json=question)
    assert reply.status_code == 200, reply.text
    return reply.json()


def refused(name, /, status=422, **question):
    reply = request("POST", f"/api/{name}", json=question)
    assert reply.status_code == status, reply.text
    return [(problem["path"], problem["message"]) for problem in reply.json()["errors"]]


def test_the_critical_thrust_is_that_of_the_command():
    found = ask("critical", model=TSTO, values={KR: 1e4, KS: 1e4, "stage.split": 0.8})
    assert found["critical_thrust"] == pytest.approx(108.590391, rel=1e-8)
    assert (found["kind"], found["modes"]) == ("flutter", [1, 2])
    assert "flutters at P L^2/EI = 108.590391" in found["verdict"]


@pytest.mark.parametrize(
    ("formulation", "thrust"),
    [("objective", 106.437231), ("converged", 109.346441), ("corrected-ritz", 109.528403), ("as-printed", 109.615937)],
)
def test_each_formulation_gives_its_own_number(formulation, thrust):
    assert ask("critical", model=TSTO, formulation=formulation)["critical_thrust"] == pytest.approx(thrust, rel=1e-8)


def test_one_move_of_a_slider_gives_verdict_curves_and_shapes():
    found = ask("solve", model=TSTO, values={KR: "inf", KS: "inf"}, thrust=0.0)
    assert found["critical"]["critical_thrust"] == pytest.approx(109.689191958738, rel=1e-9)
    curve, shapes = found["curve"], found["shapes"]
    assert curve["thrust"][-1] == pytest.approx(1.3 * 109.689191958738, rel=1e-9)
    assert np.shape(curve["angular_frequency"]) == (61, 4)
    assert shapes["angular_frequency"][0] == pytest.approx(4.7300407449**2, rel=1e-8)  # a free beam's
    first = np.concatenate(shapes["real"][0])
    x = np.concatenate(shapes["station"])
    beta, ratio = 4.7300407449, 0.98250221
    exact = np.cosh(beta * x) + np.cos(beta * x) - ratio * (np.sinh(beta * x) + np.sin(beta * x))
    assert first / first[0] == pytest.approx(exact / exact[0], abs=1e-6)


@pytest.mark.parametrize(("name", "tolerance"), [("tsto", 1e-6), ("generic_small_launcher", 1e-4)])
def test_a_draft_is_near_the_answer(name, tolerance):
    text = example_text(name)
    answer = ask("solve", model=text)
    rough = ask("draft", model=text, to=answer["curve"]["thrust"][-1])
    there = [row[:3] for row in answer["curve"]["angular_frequency"][::3]]
    highest = max(map(max, there))
    assert [row[:3] for row in rough["curve"]["angular_frequency"]] == pytest.approx(
        np.array(there), abs=tolerance * highest
    )
    assert rough["shapes"]["angular_frequency"][:3] == pytest.approx(
        answer["shapes"]["angular_frequency"][:3], rel=tolerance
    )


def test_a_joint_that_slides_shows_both_of_its_faces():
    shapes = ask("modes", model=TSTO, values={KS: 100.0}, count=1)["shapes"]
    upper, lower = shapes["real"][0]
    assert abs(upper[-1] - lower[0]) > 0.05


def test_points_of_a_map_are_single_answers():
    points = [[1.0, 1e4], [5000.0, 5000.0], [1e4, 100.0]]
    found = ask("map", model=TSTO, axes=[KR, KS], points=points)
    alone = [ask("critical", model=TSTO, values={KR: r, KS: s})["critical_thrust"] for r, s in points]
    assert found["critical_thrust"] == pytest.approx(alone, rel=1e-6)
    assert [found["kinds"][kind] for kind in found["kind"]] == ["divergence", "flutter", "flutter"]


def test_the_response_is_that_of_the_command():
    found = ask("response", model=TSTO, duration=2.0, points=401, mode=1, elastic=False)
    vehicle = beal.loads(TSTO)
    same = beal.response(vehicle, 2.0, method="exact", step=0.005, initial=beal.ModeShape(1, 0.01))
    assert found["sensors"]["imu"]["displacement"] == pytest.approx(same.displacement[0], rel=1e-9, abs=1e-12)
    assert found["growth_rate"] == pytest.approx(0.0, abs=1e-6)


def test_a_control_law_has_a_locus():
    law = "[control]\ngains = [{sensor = 'imu', quantity = 'slope', gain = 0.5}]\n"
    found = ask("locus", model=TSTO + law, over="gain", at=[0.0, 1.0], thrust=10.0)
    assert np.shape(found["real"])[0] == 2
    assert refused("locus", model=TSTO, at=[0.0, 1.0])[0][0] == "control"


def test_a_flight_in_parts_is_that_of_the_command():
    text = example_text("generic_small_launcher")
    parts = [ask("flight", model=text, first=first, count=2) for first in (0, 2)]
    vehicle = beal.loads(text)
    times = vehicle.timeline.time
    same = beal.flight(vehicle, modes=3)
    assert [part["times"] for part in parts] == 2 * [len(times)]
    assert parts[0]["time"] + parts[1]["time"] == list(times[:4])
    found = [value for part in parts for value in part["margin"]]
    assert np.array(found, dtype=float) == pytest.approx(same.margin[:4], rel=1e-9, nan_ok=True)
    assert refused("flight", model=text, first=len(times))[0][0] == "first"
    assert refused("flight", model=TSTO)[0][0] == "timeline"


def test_a_pulsating_thrust_is_judged_as_by_the_command():
    found = ask("pulsation", model=TSTO, thrust=30.0, angular_frequencies=[40.0, 45.0, 50.0], amplitudes=[0.0, 20.0])
    same = [[beal.floquet(beal.loads(TSTO), 30.0, P, w, 6) for P in (0.0, 20.0)] for w in (40.0, 45.0, 50.0)]
    assert found["stable"] == [[each.stable for each in row] for row in same]
    assert np.array(found["largest_modulus"]) == pytest.approx(
        np.array([[each.largest_modulus for each in row] for row in same]), rel=1e-6
    )


def test_margins_of_the_loop_are_those_of_the_command_and_lie_on_the_curve():
    gains = "[{sensor = 'imu', quantity = 'slope', gain = 0.5}, {sensor = 'imu', quantity = 'slope_rate', gain = 0.2}]"
    found = ask("loop", model=f"{TSTO}[control]\nlag = 0.02\ngains = {gains}\n", thrust=10.0)
    vehicle = beal.loads(f"{TSTO}[control]\nlag = 0.02\ngains = {gains}\n")
    margins = beal.stability_margins(vehicle, 10.0)
    assert [each["factor"] for each in found["margins"]["gain"]] == pytest.approx(
        [each.factor for each in margins.gain]
    )
    curve = found["open_loop"]
    size = np.hypot(*np.transpose(curve["value"]))
    phase = found["margins"]["phase"][0]["angular_frequency"]
    assert np.interp(phase, curve["angular_frequency"], size) == pytest.approx(1.0, rel=0.01)
    assert refused("loop", model=TSTO, thrust=10.0)[0][0] == "control"


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_quantity_has_a_slider_that_holds_it(name):
    found = ask("model", model=example_text(name))
    vehicle = beal.loads(example_text(name))
    assert beal.loads(found["model"]) == vehicle
    for quantity in found["quantities"]:
        value, low, high = quantity["value"], quantity["from"], quantity["to"]
        assert low < high, quantity
        assert low > 0 or quantity["scale"] == "linear", quantity
        assert value in (None, "inf") or low <= value <= high, quantity


def test_entries_of_tables_and_damping_ratios_have_sliders():
    text = example_text("generic_small_launcher") + "\n[damping]\nratios = [0.01, 0.005]\n"
    fields = {item["path"]: item for item in ask("model", model=text)["quantities"]}
    entry = fields["stage[0].bending_stiffness.value[1]"]
    assert (entry["name"], entry["unit"], entry["value"]) == ("at 0.1 m", "N*m^2", 226082.0)
    assert fields["damping.ratios[1]"]["value"] == 0.005
    changed = ask("model", model=text, values={"stage[0].bending_stiffness.value[1]": 3e5, "damping.ratios[0]": 0.02})
    vehicle = beal.loads(changed["model"])
    assert vehicle.stages[0].bending_stiffness.value[:2] == (59266.0, 3e5)
    assert vehicle.damping.ratios == (0.02, 0.005)
    wrong = {"stage[0].bending_stiffness.value[1]": -1.0}
    assert refused("model", model=text, values=wrong)[0][0] == "stage[0].bending_stiffness.value[1]"


def test_units_stand_beside_the_quantities():
    units = {
        item["path"]: item["unit"] for item in ask("model", model=example_text("generic_small_launcher"))["quantities"]
    }
    assert units["stage[1].length"] == "m"
    assert units["joint[0].rotational_stiffness"] == "N*m/rad"
    assert {item["unit"] for item in ask("model", model=TSTO)["quantities"]} == {""}


def test_choices_replace_words():
    found = ask(
        "critical", model=example_text("beal"), choices={"support.nose": "clamped", "thrust.axial_force": "constant"}
    )
    assert found["critical_thrust"] == pytest.approx(20.0509536, rel=1e-8)
    assert refused("model", model=TSTO, choices={"support.middle": "free"})[0][0] == "support.middle"
    assert refused("model", model=TSTO, choices={"support.nose": "glued"})[0][0] == "support.nose"


def test_the_model_may_be_a_json_object():
    stage = {"length": 1.0, "mass_per_length": 1.0, "bending_stiffness": 1.0}
    column = {"units": "nondimensional", "stage": [stage], "support": {"nose": "clamped"}}
    assert ask("critical", model=column)["critical_thrust"] == pytest.approx(20.0509536, rel=1e-8)


def model_in(script):
    """The model in an exported script, by Python's own reader."""
    calls = [node for node in ast.walk(ast.parse(script)) if isinstance(node, ast.Call)]
    return next(call.args[0].value for call in calls if getattr(call.func, "attr", "") == "loads")


def test_what_is_exported_gives_the_same_number(tmp_path):
    exported = ask("export", model=TSTO, values={KR: 10.0}, to=20.0)
    vehicle = beal.loads(exported["toml"])
    assert vehicle.joints[0].rotational_stiffness == 10.0
    assert beal.loads(model_in(exported["python"])) == vehicle
    run = subprocess.run([sys.executable, "-c", exported["python"]], capture_output=True, text=True, cwd=tmp_path)
    assert f"{beal.critical_thrust(vehicle).critical_thrust:.6f}" in run.stdout
    assert exported["command"].splitlines()[-2:] == [
        "beal critical vehicle.toml",
        "beal curve vehicle.toml --to 20.0 --points 61 --modes 4",
    ]


def test_a_title_cannot_leave_its_quotes():
    title = 'it is """ \\" \\N{BULLET} \\\\'
    vehicle = catalog.tsto(0.6, 10.0, 20.0).model_copy(update={"title": title})
    exported = ask("export", model=beal.dumps(vehicle))
    assert beal.loads(model_in(exported["python"])) == vehicle


@pytest.mark.parametrize("ending", [".toml", ".csv", ".bdf", ".xlsx"])
def test_files_that_are_dropped_are_read(ending):
    vehicle = catalog.tsto(0.6, 10.0, 20.0)
    file = base64.b64encode(content(vehicle, f"vehicle{ending}")).decode()
    read = beal.loads(ask("open", name=f"Vehicle{ending.upper()}", content=file)["model"])
    assert read.boundaries == pytest.approx(vehicle.boundaries)
    assert read.joints[0].rotational_stiffness == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("name", "text", "path", "message"),
    [
        ("notes.txt", "", "name", "must end with"),
        ("vehicle.toml", "%%%", "content", "base64"),
        ("vehicle.bdf", base64.b64encode(b"GRID,1\n").decode(), "", "CBAR"),
        ("vehicle.xlsx", base64.b64encode(b"PK no").decode(), "", ""),
    ],
)
def test_bad_files_are_refused_with_the_reason(name, text, path, message):
    problems = refused("open", name=name, content=text)
    assert any(path in place and message in text for place, text in problems)


SECRET = "time,thrust\n0,1\n1,2\n"


@pytest.mark.parametrize(
    "part",
    [
        "[timeline]\nfile = '{secret}'\n",
        "[[force]]\nstation = 0.0\nsignal = {{kind = 'table', file = '{secret}'}}\n",
    ],
)
def test_no_file_of_the_machine_is_read(part, tmp_path):
    secret = tmp_path / "secret.csv"
    secret.write_text(SECRET)
    problems = refused("model", model=TSTO + part.format(secret=secret))
    assert any("is not read here" in message for _, message in problems)


def test_no_file_is_included_in_a_deck(tmp_path):
    secret = tmp_path / "secret.bdf"
    secret.write_text("GRID,1,,0.0\n")
    deck = base64.b64encode(f"INCLUDE '{secret}'\n".encode()).decode()
    assert "is not read here" in refused("open", name="deck.bdf", content=deck)[0][1]


@pytest.mark.parametrize(
    ("question", "path"),
    [
        ({"values": {KR: -1.0}}, KR),
        ({"values": {"joint[3].shear_stiffness": 1.0}}, "joint[3].shear_stiffness"),
        ({"values": {"stage[0].length": "12 ft"}}, "stage[0].length"),
        ({"formulation": "exact"}, "formulation"),
        ({"model": "x = 1"}, "x"),
        ({"model": "["}, ""),
        ({"model": 3}, "model"),
        ({"speed": 3}, "speed"),
        ({"points": 10**9}, "points"),
    ],
)
def test_a_problem_is_named_by_its_path(question, path):
    assert any(place.startswith(path) for place, _ in refused("solve", **{"model": TSTO, **question}))


def test_a_formulation_that_does_not_apply_is_told_at_its_field():
    path, message = refused("solve", model=example_text("beck"), formulation="as-printed")[0]
    assert path == "formulation"
    assert "two stages" in message


def test_a_vehicle_of_very_many_stages_is_refused():
    stage = "[[stage]]\nlength = 1.0\nmass_per_length = 1.0\nbending_stiffness = 1.0\n"
    assert refused("solve", model=stage * 61 + "[[joint]]\n" * 60)[0][0] == "stage"


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 200),
        ({"origin": ADDRESS}, 200),
        ({"host": "localhost:8000"}, 200),
        ({"host": "example.org"}, 403),
        ({"host": "127.0.0.1.example.org"}, 403),
        ({"host": "[::"}, 403),
        ({"origin": "https://example.org"}, 403),
        ({"origin": "null"}, 403),
        ({"origin": "http://127.0.0.1:9"}, 403),
        ({"content-type": "text/plain"}, 415),
    ],
)
def test_only_the_own_page_is_let_in(headers, status):
    reply = request("POST", "/api/model", content=json.dumps({"model": TSTO}), headers={**JSON, **headers})
    assert reply.status_code == status
    assert "default-src 'self'" in reply.headers["content-security-policy"]


def test_a_large_body_is_refused():
    reply = request("POST", "/api/open", content=b" " * (LARGEST + 1), headers=JSON)
    assert reply.status_code == 413


STAGE = {"length": 0.02, "mass_per_length": 1.0, "bending_stiffness": 1.0, "internal_damping": 0.001}
SLOW = {"units": "nondimensional", "stage": [STAGE] * 50, "joint": [{"rotational_stiffness": 100.0}] * 49}
SLOW["damping"] = {"ratios": [0.01]}  # which needs dense matrices: half a minute
CHILDREN = Path(f"/proc/{os.getpid()}/task")


def processes():
    """The processes that answer, by their numbers."""
    return {number for thread in CHILDREN.iterdir() for number in (thread / "children").read_text().split()}


def test_answers_that_take_too_long_are_ended_and_the_next_is_soon_there(monkeypatch):
    ask("model", model=TSTO)
    before = processes() if CHILDREN.exists() else set()
    monkeypatch.setattr("beal.web.app.LONGEST", 0.5)
    for _ in range(2 * (os.cpu_count() or 1) + 1):
        assert "took longer" in refused("solve", status=503, model=SLOW)[0][1]
    monkeypatch.undo()
    began = time.monotonic()
    assert ask("critical", model=TSTO)["kind"] == "flutter"
    assert time.monotonic() - began < 10 < LONGEST <= 30
    if CHILDREN.exists():
        assert len(processes() - before) <= 1
        assert before - processes()  # the one that worked on it is gone


def test_an_answer_that_nobody_waits_for_is_ended():
    async def left():
        """Asks, and hangs up after a second."""
        body = json.dumps({"model": SLOW}).encode()
        messages = iter([{"type": "http.request", "body": body}])
        began = time.monotonic()

        async def receive():
            if message := next(messages, None):
                return message
            await anyio.sleep(max(0.0, 1.0 + began - time.monotonic()))
            return {"type": "http.disconnect"}

        async def send(message):
            pass

        headers = [(b"host", b"127.0.0.1:8000"), (b"content-type", b"application/json")]
        scope = {"type": "http", "method": "POST", "path": "/api/solve", "headers": headers, "query_string": b""}
        await APP(scope, receive, send)
        return time.monotonic() - began

    assert portal.call(left) < 0.8 * LONGEST


@pytest.mark.parametrize("path", ["/static/../app.py", "/static/%2e%2e/app.py", "/static//etc/passwd", "/nothing"])
def test_no_other_file_is_served(path):
    assert request("GET", path).status_code == 404


@pytest.mark.parametrize("path", ["/", "/static/main.js", "/static/style.css", "/plotly.js", "/openapi.json"])
def test_the_page_is_served(path):
    assert request("GET", path).status_code == 200


def test_the_page_asks_for_nothing_from_elsewhere():
    static = Path(beal.__file__).parent / "web" / "static"
    for file in static.iterdir():
        assert "https://" not in file.read_text(encoding="utf-8"), file


SCHEMA = schemathesis.openapi.from_dict(description(QUESTIONS))


@SCHEMA.parametrize()
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
def test_nothing_that_the_description_allows_breaks_the_server(case):
    body = json.dumps(case.body) if isinstance(case.body, dict) else "null"
    reply = request(case.method, case.path, content=body, headers=JSON)
    assert reply.status_code < 500, reply.text
    if reply.status_code >= 400:
        assert all({"path", "message"} == problem.keys() for problem in reply.json()["errors"])


@pytest.mark.parametrize("value", [0.0, 5e-324, 1e-300, 1e300])
@pytest.mark.parametrize("path", [KR, "stage[0].length", "stage[0].bending_stiffness", "stage[0].mass_per_length"])
@pytest.mark.parametrize(
    ("name", "more"),
    [
        ("solve", {}),
        ("map", {"axes": [KS, "stage[1].length"], "points": [[1.0, 0.5]]}),
        ("response", {"duration": 1.0}),
    ],
)
def test_extreme_values_are_answered_or_refused(name, more, path, value):
    reply = request("POST", f"/api/{name}", json={"model": TSTO, "values": {path: value}, **more})
    assert reply.status_code in (200, 422), reply.text
