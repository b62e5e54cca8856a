"""beal floquet as a user runs it."""

from importlib.resources import files

import pytest
import xarray


@pytest.fixture
def beck(written):
    return written((files("beal.vehicle.catalog") / "models" / "beck.toml").read_text(encoding="utf-8"), "beck.toml")


def at(thrust, amplitude, omega):
    return "--thrust", thrust, "--amplitude", amplitude, "--angular-frequency", omega


def test_one_pulsation_is_given_as_json(result_of, beck):
    found = result_of("floquet", beck, *at(5, 0.5, 8.4))
    assert found["stable"] is False
    assert found["multipliers"][0] == pytest.approx([-1.0270728, 0.0], abs=1e-7)
    assert found["largest_modulus"] == pytest.approx(1.0270728, abs=1e-7)
    assert (found["resonance"]["name"], found["resonance"]["modes"]) == ("2 w1", [1, 1])
    assert (found["thrust"], found["amplitude"], found["angular_frequency"]) == (5.0, 0.5, 8.4)
    assert (found["steady_growth_rate"], found["rigid_body_modes"]) == (0.0, 0)
    assert 0 <= found["error_estimate"] < 1e-8


def test_one_pulsation_is_told_in_sentences(beal_here, beck):
    assert beal_here("floquet", beck, *at(5, 0.5, 8.3)).stdout == (
        "P = 5 + 0.5 cos(8.3 t): stable\n"
        "largest modulus of the multipliers: 1.00000000\n"
        "nearest resonance: 2 w1 = 8.43535\n"
    )
    shown = beal_here("floquet", beck, *at(22, 0.5, 8.3)).stdout
    assert "already unstable under P = 22 alone, its motion grows as exp(" in shown


def test_a_grid_becomes_a_chart(result_of, beck, tmp_path):
    grid = at(5, "0:2:9", "6:12:7")
    found = result_of("floquet", beck, *grid, "-o", "chart.zarr", "--figure", "chart.svg")
    with xarray.open_zarr(tmp_path / "chart.zarr", chunks=None) as chart:
        assert dict(chart.sizes) == {"angular_frequency": 7, "amplitude": 9, "resonance": 2}
        assert (found["points"], found["unstable"]) == (63, int((~chart.stable).sum()))
        assert found["largest_modulus"] == float(chart.largest_modulus.max())
    assert [resonance["name"] for resonance in found["resonances"]] == ["(w2 - w1)/2", "2 w1"]
    assert (tmp_path / "chart.svg").read_bytes().startswith(b"<?xml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["beck.toml", "chart.svg", "chart.zarr"]


def test_a_grid_of_one_of_the_two_is_a_chart_too(beal_here, beck):
    assert beal_here("floquet", beck, *at(5, 0.5, "8:9:3")).stdout.startswith("3 points: 2 stable, 1 unstable\n")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (at(5, 0.5, 0), "angular_frequency: must be positive and finite, found 0.0"),
        (at(5, 0.5, "nan"), "angular_frequency: must be positive and finite, found nan"),
        (at(5, "x", 8), "--amplitude: must be a number, or a grid as FROM:TO:POINTS"),
        (at(5, "0:2", 8), "--amplitude: must be a number, or a grid as FROM:TO:POINTS"),
        (at(5, "2:0:5", 8), "in ascending order, found '2:0:5'"),
        (at(5, "0:nan:5", 8), "in ascending order, found '0:nan:5'"),
        (at(5, "0:2:1", 8), "with more than one point, in ascending order, found '0:2:1'"),
        (at(5, "-1:2:3", 8), "amplitude: must be finite and not negative, found -1.0"),
        ((*at(5, 1, 8), "-o", "chart.zarr"), "--output: holds a chart; give a number, or a grid"),
        ((*at(5, 1, 8), "--figure", "chart.png"), "--figure: holds a chart; give a number, or a grid"),
        ((*at(5, 1, "8:9:2"), "--figure", "chart.png"), "--figure: draws charts over a grid of both"),
        ((*at(5, "0:1:2", "8:9:2"), "-o", "beck.toml"), "beck.toml: cannot be written: is a file"),
        (("--amplitude", 1, "--angular-frequency", 8), "--thrust: give one, or set thrust.nominal in the model"),
    ],
)
def test_wrong_options_are_refused(beal_here, beck, options, message):
    done = beal_here("floquet", beck, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("beal: ")
    assert message in done.stderr


def test_a_chart_that_is_there_is_not_replaced(beal_here, beck):
    grid = (*at(5, "0:1:2", "8:9:2"), "-o", "chart.zarr")
    assert beal_here("floquet", beck, *grid).returncode == 0
    done = beal_here("floquet", beck, *grid)
    assert (done.returncode, done.stderr) == (
        2,
        "beal: chart.zarr: exists already; name another place or remove it\n",
    )
