"""The whole reproduction of the paper on a tiny grid, from an empty folder to the report."""

import csv
import json
import math
import re

import pytest

from beal.discretisation import FORMULATIONS
from beal.paper.reproduce import reproduce

POINTS = 4
FIGURES = [f"fig{number:02d}" for number in range(2, 16)]
CLAIMS = [f"C{number}" for number in range(1, 10)]
SMALLEST_PICTURE = 20_000  # bytes; an empty pair of axes has fewer
LARGEST_PAGE = 6_000_000


def rows_of(path):
    """The definition and the rows of a data file."""
    with path.open(encoding="utf-8", newline="") as file:
        return file.readline(), list(csv.DictReader(file))


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def folder(tmp_path_factory, told):
    target = tmp_path_factory.mktemp("paper") / "new"
    report = reproduce(target, points=POINTS, progress=lambda text, done, total: told.append((text, done, total)))
    assert report == target / "report.html"
    return target


def test_the_reproduction_is_complete(folder, told):
    every_figure_is_there(folder)
    the_maps_are_complete(folder)
    the_motions_agree(folder)
    every_claim_is_judged(folder)
    the_page_stands_alone(folder)
    progress_runs_to_its_end(told)


def every_figure_is_there(folder):
    for name in [*FIGURES, "convergence"]:
        assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert (folder / f"{name}.png").stat().st_size > SMALLEST_PICTURE
        assert "<svg" in (folder / f"{name}.svg").read_text(encoding="utf-8")[:1000]
        definition, rows = rows_of(folder / f"{name}.csv")
        assert definition.startswith("# ")
        assert rows


def the_maps_are_complete(folder):
    for name in ("fig04", "fig06", "fig08", "fig11"):
        _, rows = rows_of(folder / f"{name}.csv")
        assert {row["formulation"] for row in rows} == set(FORMULATIONS)
        assert len(rows) == len(FORMULATIONS) * POINTS**2
        assert all(float(row["critical_thrust"]) > 0 for row in rows if row["kind"] != "0")


def the_motions_agree(folder):
    for name in ("fig13", "fig14", "fig15"):
        _, rows = rows_of(folder / f"{name}.csv")
        pairs = [(float(row["displacement"]), float(row["displacement_exact"])) for row in rows]
        largest = max(abs(exact) for _, exact in pairs)
        # Newmark: (omega h)^2 omega t / 12 at omega = 100, h = 5e-4, t = 10
        assert max(abs(newmark - exact) for newmark, exact in pairs) < 0.05 * largest


def every_claim_is_judged(folder):
    records = json.loads((folder / "claims.json").read_text(encoding="utf-8"))
    assert {(r["id"], r["formulation"]) for r in records} == {(c, f) for c in CLAIMS for f in FORMULATIONS}
    assert {r["verdict"] for r in records} <= {"holds", "fails", "holds in part"}
    for record in records:
        assert set(record) == {"id", "claim", "formulation", "verdict", "evidence", "numbers", "grid"}
        assert re.search(r"\d", record["evidence"])
        assert record["numbers"]["parts"]


def the_page_stands_alone(folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert len(page) < LARGEST_PAGE
    assert not re.search(r"(?:src|href)\s*=\s*[\"'](?!data:|#)", page)
    assert not re.search(r"url\(|@import|<script|<link", page)
    assert not re.search(r"https?://", re.sub(r"data:[^\"]*", "", page))
    assert [name for name in [*FIGURES, "convergence"] if f'<figure id="{name}">' not in page] == []
    assert set(re.findall(r'href="#([\w-]+)"', page)) <= set(re.findall(r'id="([\w-]+)"', page))
    assert not re.search(r"\b(?:nan|inf|None)\b", re.sub(r"<style>.*?</style>|data:[^\"]*", "", page, flags=re.DOTALL))


def progress_runs_to_its_end(told):
    maps = [(done, total) for text, done, total in told if text.startswith("map")]
    assert maps[-1] == (math.prod((4, len(FORMULATIONS), POINTS, POINTS)),) * 2
    assert all(0 <= done <= total for _, done, total in told)
