"""What the README and the examples show is what happens."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
README = (ROOT / "README.md").read_text(encoding="utf-8")
BEAL = [str(Path(sys.executable).with_name("beal"))]

PRINTED = {
    "critical_thrust.py": "k_r L/EI =    10: divergence at P L^2/EI = 63.245852, modes (1, 1)",
    "imu_response.py": "P L^2/EI = 128: largest deflection",
    "overview.py": "flutter at P L^2/EI = 86.652119, modes (1, 2)",
}


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


@pytest.fixture
def readme_folder(tmp_path):
    (tmp_path / "two_stages.toml").write_text(blocks("toml")[0])
    return tmp_path


def test_every_console_command_of_the_readme_prints_what_is_shown(readme_folder):
    for block in blocks("console"):
        command, _, shown = block.partition("\n")
        words = shlex.split(command.removeprefix("$ "))
        printed = run([*BEAL, *words[1:]], readme_folder)
        assert words[0] == "beal"
        assert without_rounding(printed) == without_rounding(shown)


def without_rounding(text):
    """The relative error that rounding leaves differs between machines; everything else must be the same."""
    return re.sub(r"relative error about \S+", "relative error about ...", text).strip()


def test_the_python_of_the_readme_prints_what_it_says(readme_folder):
    for block in blocks("python"):
        expected = re.findall(r"#\s*(.+)$", block, re.MULTILINE)[-1]
        assert run([sys.executable, "-c", block], readme_folder).strip() == expected


@pytest.mark.parametrize("formulation", ["as-printed", "corrected-ritz", "converged", "objective"])
def test_the_table_of_formulations_in_the_readme_is_right(readme_folder, formulation):
    shown = re.search(rf"\| `{formulation}` \| ([\d.]+) \|", README)
    printed = run([*BEAL, "critical", "two_stages.toml", "--formulation", formulation], readme_folder)
    value = re.search(r"= ([\d.]+):", printed)
    assert f"{float(value[1]):.2f}" == shown[1]


@pytest.mark.parametrize("script", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.name)
def test_an_example_runs_and_prints_its_answer(tmp_path, script):
    arguments = [str(tmp_path / "picture.png")] if script.name == "overview.py" else []
    assert PRINTED[script.name] in run([sys.executable, str(script), *arguments], tmp_path)


def test_the_benchmark_runs(tmp_path):
    printed = run([sys.executable, str(ROOT / "benchmarks" / "critical_thrust.py"), "4"], tmp_path)
    assert "times the plain way's points per second" in printed


@pytest.mark.parametrize("model", ["two_stages.toml", "sounding_rocket.toml"])
@pytest.mark.parametrize("command", ["check", "modes", "critical"])
def test_an_example_model_is_understood_by_every_command(model, command):
    assert run([*BEAL, command, str(EXAMPLES / model)], EXAMPLES)


def test_the_example_study_gives_a_map(tmp_path):
    run([*BEAL, "map", str(EXAMPLES / "joint_map.toml"), "-o", str(tmp_path / "map.zarr")], tmp_path)
    assert (tmp_path / "map.zarr" / "critical_thrust").is_dir()
