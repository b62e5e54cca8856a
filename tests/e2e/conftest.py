"""The command as a user runs it: another process, its output, its messages and its exit code."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from beal.cli import main

COMMAND = Path(sys.executable).with_name("beal")


@pytest.fixture
def beal(tmp_path):
    """Runs the command in an empty folder."""

    def run(*arguments):
        return subprocess.run(
            [COMMAND, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", timeout=120
        )

    return run


@pytest.fixture
def beal_here(tmp_path, monkeypatch, capfd):
    """Runs the command in this process, a second faster."""

    def run(*arguments):
        monkeypatch.chdir(tmp_path)
        monkeypatch.setattr(sys, "argv", ["beal", *map(str, arguments)])
        with pytest.raises(SystemExit) as end:
            main()
        return subprocess.CompletedProcess(arguments, end.value.code, *capfd.readouterr())

    return run


@pytest.fixture
def result_of(beal_here, strict):
    """Runs the command with --json and reads its result: one object, nothing else, strict JSON."""

    def run(*arguments):
        done = beal_here(*arguments, "--json")
        assert (done.returncode, done.stderr) == (0, "")
        return strict(done.stdout)

    return run


@pytest.fixture
def written(tmp_path):
    """Writes a file into the folder that the command runs in."""

    def write(text, name="model.toml"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return name

    return write


@pytest.fixture
def strict():
    """Reads the one JSON object in a text; NaN and Infinity are no JSON."""

    def refuse(token):
        raise ValueError(f"{token} is not JSON")

    def read(text):
        value = json.loads(text, parse_constant=refuse)
        assert isinstance(value, dict)
        return value

    return read
