"""What a reader at a terminal sees, and a pipe does not."""

import os
import re
import subprocess

import pytest

from beal.cli.models import EXAMPLES
from beal.interop.files import load
from beal.stability import curve
from e2e.conftest import COMMAND

COLOR = re.compile(r"\x1b\[[\d;]*3\d[\d;]*m")


@pytest.fixture
def terminal(tmp_path):
    """Runs the command on a terminal of some columns; gives what it shows."""
    pty = pytest.importorskip("pty")

    def run(*arguments, columns=80, **environment):
        ours, theirs = pty.openpty()
        ordinary = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
        given = ordinary | {"COLUMNS": str(columns), "TERM": "xterm-256color"} | environment
        process = subprocess.Popen(
            [COMMAND, *arguments], cwd=tmp_path, stdout=theirs, stderr=subprocess.DEVNULL, env=given
        )
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 65536):
                shown += part
        except OSError:  # how Linux says that the other end is closed
            pass
        os.close(ours)
        assert process.wait(timeout=60) == 0
        return shown.decode("utf-8").replace("\r\n", "\n")

    return run


@pytest.fixture
def tsto(beal_here):
    beal_here("example", "tsto", "-o", "tsto.toml")
    return "tsto.toml"


def test_a_terminal_shows_the_frequencies_in_colour(terminal, tsto):
    shown = terminal("critical", tsto, columns=60)
    assert "●" in shown
    assert COLOR.search(shown)
    plain = re.sub(r"\x1b\[[\d;]*m", "", shown)
    assert max(len(line) for line in plain.splitlines()[3:]) == 60
    assert plain.splitlines()[0].startswith("two-stage vehicle: flutters at P L^2/EI = 106.437231")


def test_no_color_is_respected(terminal, tsto):
    shown = terminal("critical", tsto, "--all", NO_COLOR="1")
    assert "●" in shown
    assert not COLOR.search(shown)


def test_a_terminal_of_another_encoding_gets_ascii(terminal, tsto):
    shown = terminal("critical", tsto, "--all", PYTHONIOENCODING="ascii")
    assert shown.isascii()
    assert "dotted: unstable" in shown


def test_no_plot_leaves_the_words(terminal, tsto):
    assert len(terminal("critical", tsto, "--no-plot").splitlines()) == 3


def test_a_pipe_gets_the_words_alone_unless_it_asks_for_more(beal_here, tsto):
    words = beal_here("critical", tsto).stdout
    assert len(words.splitlines()) == 3
    drawn = beal_here("critical", tsto, "--plot").stdout
    assert drawn.startswith(words)
    assert "●" in drawn
    assert "\x1b" not in drawn
    assert "dotted: unstable" in beal_here("curve", tsto, "--to", 150, "--plot").stdout
    assert "dotted: unstable" not in beal_here("curve", tsto, "--to", 150).stdout


@pytest.mark.parametrize("command", [["critical"], ["curve", "--to", "9"]])
def test_nothing_is_drawn_into_json(beal_here, tsto, command):
    done = beal_here(*command, tsto, "--plot", "--json")
    assert (done.returncode, done.stdout) == (2, "")
    assert "--plot: is given beside --json" in done.stderr


def test_a_large_vehicle_is_drawn_from_its_reduction(beal_here, monkeypatch):
    asked, follow = [], curve.thrust_curve
    monkeypatch.setattr(curve, "thrust_curve", lambda *given: asked.append(given[0]) or follow(*given))
    beal_here("example", "generic_small_launcher", "-o", "launcher.toml")
    assert "thrust [MN]" in beal_here("critical", "launcher.toml", "--plot").stdout
    assert len(asked[0].M) < 100  # its own matrices have some 800 rows


def test_example_without_a_name_lists_them(beal_here, result_of):
    lines = beal_here("example").stdout.splitlines()
    assert [line.split()[0] for line in lines] == list(EXAMPLES)
    assert "beal: --output: holds one model" in beal_here("example", "-o", "a.toml").stderr
    listed = result_of("example")["examples"]
    assert [f"{item['name']} {item['description']}".split() for item in listed] == [line.split() for line in lines]


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_explains_itself_and_loads(beal_here, tmp_path, name):
    beal_here("example", name, "-o", "model.toml")
    first, *_ = text = (tmp_path / "model.toml").read_text(encoding="utf-8").splitlines()
    assert first.startswith("# ")
    assert first.endswith((".", ")."))
    keys = {line.split("]]")[0] for line in text if line.startswith("[[")}
    explained = {line.split("]]")[0] for line in text if line.startswith("[[") and "#" in line}
    assert keys == explained
    assert load(tmp_path / "model.toml").mass > 0


def test_the_shell_completes_commands_and_examples(beal):
    assert beal("--show-completion", "bash").returncode in (0, 1)  # 1 where no shell is found
    for words, position, expected in (("beal fl", 1, ["flight", "floquet"]), ("beal example ts", 2, ["tsto"])):
        given = os.environ | {"COMP_WORDS": words, "COMP_CWORD": str(position), "_BEAL_COMPLETE": "complete_bash"}
        assert subprocess.run([COMMAND], env=given, capture_output=True, text=True).stdout.split() == expected
