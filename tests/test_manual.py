"""What the manual's own pages show is what happens, and all that is written is in the manual."""

import importlib
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from sphinx.errors import SphinxError

import beal

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
INDEX = (DOCS / "index.md").read_text(encoding="utf-8")
PAGES = ("commands", "first_ten_minutes", "index", "limits", "moving", "scaling", "theory", "tutorial")
BEAL = str(Path(sys.executable).with_name("beal"))


def blocks(page):
    return re.findall(
        r"^```(\w+)\n(.*?)^```$", (DOCS / f"{page}.md").read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


def run(words, folder):
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def matches(printed, shown):
    """Line by line, without what rounding leaves; a last line of three dots stands for all the rest."""
    printed, shown = (
        [
            re.sub(r"relative error about \S+|\s+(\d\.\d+e-\d+|0) │$", "", line).rstrip()
            for line in text.strip().splitlines()
        ]
        for text in (printed, shown)
    )
    return printed[: len(shown) - 1] == shown[:-1] if shown[-1:] == ["..."] else printed == shown


@pytest.mark.parametrize("page", PAGES)
def test_the_blocks_of_a_page_do_what_it_says(page, tmp_path):
    printed = None
    for language, block in blocks(page):
        first, _, rest = block.partition("\n")
        if language in ("toml", "csv"):
            (tmp_path / first.removeprefix("# ")).write_text(block, encoding="utf-8")
        elif language == "console":
            command = shlex.split(first.removeprefix("$ "))
            assert command[0] == "beal"
            assert matches(run([BEAL, *command[1:]], tmp_path), rest)
        elif language == "python":
            printed = run([sys.executable, "-c", block], tmp_path)
        else:
            assert language == "text"
            assert matches(printed, block)


def test_every_page_is_in_the_contents():
    listed = set(re.findall(r"^(\w[\w-]*)$", INDEX, re.MULTILINE))
    assert {path.stem for path in DOCS.glob("*.md")} - listed == {"index"}


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", *(f"docs/{path.name}" for path in DOCS.glob("*.md"))])
def test_links_lead_somewhere(name):
    text = re.sub(r"^```.*?^```$", "", (ROOT / name).read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    targets = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text)
    inside = [target for target in targets if "://" not in target]
    assert [target for target in inside if not (ROOT / name).parent.joinpath(target).exists()] == []


def test_words_are_spelled_right():
    codespell = shutil.which("codespell", path=Path(sys.executable).parent)
    names = ["README.md", "CONTRIBUTING.md", "docs", "changes", "examples", "benchmarks", "src"]
    options = [
        "--skip=generated,*.png,*.csv",
        "--ignore-words-list=commun,suport,unter,whats,worstcase",
    ]  # Nastran's, German, a test function
    done = subprocess.run([codespell, *options, *names], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout == ""


@pytest.fixture
def offline(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS / "_extensions"))
    return importlib.import_module("offline")


def test_what_a_page_would_load_from_a_network_is_seen(offline):
    asking = '<script async src="https://cdn.org/a.js"></script><link rel="stylesheet" href="//fonts.org/b.css">'
    assert offline.fetched(asking + "a { background: url('http://c.org/d.png') }") == [
        "https://cdn.org/a.js",
        "//fonts.org/b.css",
        "http://c.org/d.png",
    ]
    assert offline.fetched('<a href="https://doi.org/1">a link</a><script src="_static/a.js"></script>') == []


def test_a_build_that_would_load_from_a_network_fails(offline, tmp_path):
    (tmp_path / "page.html").write_text('<img src="https://a.org/b.png">', encoding="utf-8")
    with pytest.raises(SphinxError, match=r"page\.html: https://a\.org/b\.png"):
        offline.check(SimpleNamespace(outdir=tmp_path), None)


def test_the_version_to_cite_is_this_one():
    assert f"version {beal.__version__}." in (DOCS / "limits.md").read_text(encoding="utf-8")
    assert f"\nversion: {beal.__version__}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_the_manual_is_built_without_a_warning(tmp_path):
    options = ["-W", "--keep-going", "--quiet", "-b", "html"]
    run([sys.executable, "-m", "sphinx", *options, str(DOCS), str(tmp_path)], ROOT)
    assert (tmp_path / "index.html").exists()
