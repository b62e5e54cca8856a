"""What is written outside the code agrees with the code."""

import importlib.metadata
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import beal

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
MACHINE_PATH = re.compile(r"(?<![\w.~})])/(?:home|root|Users|work|workspace|farm|tmp|mnt|opt)/\w")
KINDS = "added|changed|fixed|removed"


def code_in(markdown: str) -> list[str]:
    """Lines of code blocks, fenced or indented, and inline code."""
    fenced = re.findall(r"^```\w*\n(.*?)^```", markdown, re.DOTALL | re.MULTILINE)
    indented = re.findall(r"^ {4}(\S.*)", markdown, re.MULTILINE)
    inline = re.findall(r"(?<!`)`([^`\n]+)`(?!`)", markdown)
    return [line for block in (*fenced, *indented, *inline) for line in block.splitlines()]


def commands(program: str) -> set[str]:
    """The commands of a program that the README tells the reader to type."""
    typed = rf"^(?:\$ |.*(?:&&|\|) )?(?:\S*/)?{program} ([a-z][a-z-]*)"
    return {match[1] for line in code_in(README) if (match := re.match(typed, line.strip()))}


def repository_files() -> list[Path]:
    """What is or would be committed; without git, all outside hidden and generated folders."""
    if (ROOT / ".git").exists():
        listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(listing, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    else:
        generated = {"out", "build", "dist", "__pycache__"}
        paths = (path.relative_to(ROOT) for path in ROOT.rglob("*"))
        names = [
            str(path)
            for path in paths
            if not any(part in generated or part.startswith(".") for part in path.parts[:-1])
        ]
    return [ROOT / name for name in names if (ROOT / name).is_file()]


def test_make_targets_in_the_readme_exist():
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert {"demo", "test"} <= commands("make") <= targets


def test_commands_in_the_readme_exist():
    beal_command = Path(sys.executable).with_name("beal")
    runs = {name: subprocess.run([beal_command, name, "--help"], capture_output=True) for name in commands("beal")}
    assert [name for name, run in runs.items() if run.returncode != 0] == []


def test_the_version_is_the_same_everywhere():
    assert beal.__version__ == importlib.metadata.version("beal") == PROJECT["version"]


def test_every_dependency_is_pinned_by_a_plain_line():
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if not re.fullmatch(r"[a-z0-9-]+==[0-9a-z.]+", line)] == []
    asked = [
        *PROJECT["dependencies"],
        *(line for extra in PROJECT["optional-dependencies"].values() for line in extra),
    ]
    names = {re.match(r"[\w-]+", line)[0].lower() for line in asked} - {"beal"}
    assert names - {line.split("==")[0] for line in lines} == set()


def test_change_fragments_are_named_by_the_rule():
    names = [path.name for path in (ROOT / "changes").iterdir() if path.name != "README.md"]
    assert [name for name in names if not re.fullmatch(rf"[a-z0-9-]+\.({KINDS})\.md", name)] == []


def test_no_file_names_a_place_on_somebodys_machine():
    found = []
    for path in repository_files():
        content = path.read_bytes()
        if b"\0" not in content:
            lines = content.decode("utf-8").splitlines()
            found += [f"{path.relative_to(ROOT)}:{n}" for n, line in enumerate(lines, 1) if MACHINE_PATH.search(line)]
    assert found == []


def test_a_place_on_a_machine_is_seen():
    places = ["".join(("see ", "/", folder, "/x")) for folder in ("home", "root", "Users", "tmp")]
    assert all(map(MACHINE_PATH.search, places))
    assert not MACHINE_PATH.search("https://example.org/home/x and tests/tmp/x")


def test_code_in_markdown_is_found_in_blocks_and_in_lines():
    assert code_in("Say `a b`.\n\n    c d\n\n```sh\ne f\n```\n") == ["e f", "c d", "a b"]
