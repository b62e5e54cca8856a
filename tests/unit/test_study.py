"""Studies: the grid, the study file, and what happens at points that cannot be solved."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import beal
from beal.study.file import load_study
from beal.study.map import study_map
from beal.study.study import Solve, Study, spaced
from beal.study.variables import METHODS

ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
VEHICLE = beal.catalog.tsto(0.6, 5000.0, 5000.0)


def study_file(folder: Path, text: str) -> Path:
    (folder / "tsto.toml").write_text(beal.dumps(VEHICLE))
    path = folder / "study.toml"
    path.write_text(text)
    return path


def test_a_study_file_resolves_ranges_and_values(tmp_path):
    path = study_file(
        tmp_path,
        f"""
        model = "tsto.toml"
        [grid]
        "{ROTATIONAL}" = {{from = 1, to = 1e4, points = 5, spacing = "log"}}
        "stage.split" = {{values = [0.2, 0.4]}}
        [solve]
        max_thrust = 300
        formulation = "converged"
        """,
    )
    study = load_study(path)
    assert study.axes[ROTATIONAL] == pytest.approx((1, 10, 100, 1000, 10000), rel=1e-15)
    assert study.axes["stage.split"] == (0.2, 0.4)
    assert (study.solve.max_thrust, study.solve.formulation, study.shape) == (300.0, "converged", (5, 2))
    assert study.at((10.0, 0.2)).boundaries[1] == 0.2


def test_an_axis_takes_the_units_that_the_model_file_takes(tmp_path):
    (tmp_path / "rocket.toml").write_text(
        beal.dumps(beal.Vehicle(stages=[beal.Stage(length=2.0, mass_per_length=1.0, bending_stiffness=1.0)]))
    )
    path = tmp_path / "study.toml"
    path.write_text(
        """
        model = "rocket.toml"
        [grid]
        "stage[0].bending_stiffness" = {from = "1 kN*m^2", to = 4e3, points = 4}
        "stage[0].length" = {values = ["200 cm", 3]}
        """
    )
    axes = load_study(path).axes
    assert axes["stage[0].bending_stiffness"] == pytest.approx((1e3, 2e3, 3e3, 4e3), rel=1e-15)
    assert axes["stage[0].length"] == pytest.approx((2.0, 3.0), rel=1e-15)
    path.write_text('model = "rocket.toml"\n[grid]\n"stage[0].length" = {values = ["2 kg"]}\n')
    with pytest.raises(beal.ModelError, match=r"grid\.stage\[0\]\.length: expected .* converts to m, found '2 kg'"):
        load_study(path)


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ('"joint[0].rotational_stifness" = {values = [1]}', "nearest are joint"),
        (f'"{ROTATIONAL}" = {{from = 0, to = 10, points = 3, spacing = "log"}}', "positive ends"),
        (f'"{ROTATIONAL}" = {{from = 1, to = 10}}', "either values or all of"),
        (f'"{ROTATIONAL}" = {{from = 1, to = 10, points = 3, values = [1]}}', "either values or all of"),
        (f'"{ROTATIONAL}" = {{from = 1, to = 10, points = 0}}', "points"),
        (f'"{ROTATIONAL}" = {{values = []}}', "at least one value"),
        (f'"{ROTATIONAL}" = {{values = [-1.0]}}', r"joint\[0\].rotational_stiffness"),
        (f'"{ROTATIONAL}" = {{values = [nan]}}', "nan"),
        (f'"{ROTATIONAL}" = {{values = [true]}}', "must be a number"),
        (f'"{ROTATIONAL}" = {{values = ["3 N"]}}', "expected a pure number"),
        (f'"{ROTATIONAL}" = {{from = 1, to = inf, points = 3}}', "finite"),
        ("", "at least one axis"),
    ],
)
def test_a_bad_grid_is_refused_with_its_path(tmp_path, grid, message):
    path = study_file(tmp_path, f'model = "tsto.toml"\n[grid]\n{grid}\n')
    with pytest.raises(beal.ModelError, match=message):
        load_study(path)


def test_all_problems_of_a_study_file_come_together(tmp_path):
    path = study_file(tmp_path, 'modle = "tsto.toml"\n[grid]\n[solve]\ntolerance = 2\nformulation = "printed"\n')
    with pytest.raises(beal.ModelError) as error:
        load_study(path)
    for part in ("modle", "model", "solve.tolerance", "solve.formulation"):
        assert part in str(error.value)


def test_a_study_of_a_missing_model_says_which(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text('model = "nowhere.toml"\n[grid]\n"stage.split" = {values = [0.2]}\n')
    with pytest.raises(beal.ModelError, match=r"nowhere\.toml"):
        load_study(path)


def test_spacing_holds_both_ends_exactly():
    assert spaced(1.0, 1e4, 7, "log")[::6] == (1.0, 1e4)
    assert spaced(0.1, 0.9, 4, "linear") == pytest.approx((0.1, 0.1 + 0.8 / 3, 0.1 + 1.6 / 3, 0.9))


@pytest.mark.parametrize(
    ("path", "refused", "others"), [("stage.split", 1.2, (0.2, 0.8)), (ROTATIONAL, -1.0, (1.0, 10.0, 100.0, 1e3))]
)
@pytest.mark.parametrize("place", [0, 1])
def test_a_point_that_the_model_refuses_is_invalid_and_the_others_are_solved(path, refused, others, place):
    result = beal.stability_map(VEHICLE, {path: [*others[:place], refused, *others[place:]]})
    invalid = np.arange(len(others) + 1) == place
    assert result["status"].values.tolist() == np.where(invalid, 3, 1).tolist()
    assert np.isnan(result["critical_thrust"].values).tolist() == invalid.tolist()
    assert result["status"].attrs["flag_meanings"].split()[3] == "invalid"


def test_linked_quantities_follow_their_axis(tmp_path):
    path = study_file(
        tmp_path,
        f"""
        model = "tsto.toml"
        [grid]
        "stage[0].bending_stiffness" = {{values = [1.0, 2.0]}}
        "{ROTATIONAL}" = {{values = [5.0, 500.0]}}
        [links]
        "{SHEAR}" = {{of = "{ROTATIONAL}", factor = 40.0}}
        "stage[0].mass_per_length" = {{of = "stage[0].bending_stiffness", power = 0.5}}
        """,
    )
    study = load_study(path)
    assert not study.tabulated(ROTATIONAL)
    found = study_map(study, tmp_path / "out.zarr")
    by_hand = beal.dumps(VEHICLE).replace("5000.0", "500.0", 1).replace("5000.0", "20000.0", 1)
    changed = beal.loads(by_hand)
    first = changed.stages[0].model_copy(update={"bending_stiffness": 2.0, "mass_per_length": math.sqrt(2)})
    direct = beal.critical_thrust(changed.model_copy(update={"stages": (first, changed.stages[1])}))
    assert found.critical_thrust.values[1, 1] == pytest.approx(direct.critical_thrust, rel=1e-9)


@pytest.mark.parametrize(
    ("path", "of", "message"),
    [
        (ROTATIONAL, ROTATIONAL, "is an axis and linked to one"),
        (SHEAR, "stage.split", "follows stage.split, which is not an axis"),
        ("joint[3].shear_stiffness", ROTATIONAL, "index out of range"),
    ],
)
def test_a_link_that_cannot_be_followed_is_refused(path, of, message):
    with pytest.raises(beal.ModelError, match=re.escape(message)):
        Study(VEHICLE, {ROTATIONAL: (1.0, 2.0)}, Solve(), {path: beal.Link(of)})


def test_a_vehicle_stable_to_the_limit_has_kind_stable_and_no_thrust():
    result = beal.stability_map(VEHICLE, {ROTATIONAL: [1e3, 1e4]}, max_thrust=50.0)
    assert result["kind"].values.tolist() == [0, 0]
    assert np.all(np.isnan(result["critical_thrust"].values))
    assert result["status"].values.tolist() == [1, 1]


def test_a_map_says_what_it_was_made_from():
    result = beal.stability_map(VEHICLE, {SHEAR: [1e3]}, formulation="corrected-ritz", modes=6)
    assert result.attrs["formulation"] == "corrected-ritz"
    assert result.attrs["units"] == "nondimensional"
    assert "solve.modes" in result.attrs["inputs"]
    assert len(result.attrs["inputs_sha256"]) == 64
    assert result["critical_thrust"].dims == (SHEAR,)


def test_infinite_stiffness_is_a_value_like_any_other():
    result = beal.stability_map(VEHICLE, {ROTATIONAL: [math.inf] * 7 + [1e12] * 7, SHEAR: [math.inf]})
    thrust = result["critical_thrust"].values
    assert thrust == pytest.approx(109.689191958738, rel=1e-9)


def test_a_long_axis_is_known_by_its_hash():
    axes = [tuple(np.linspace(1, 2, 20_000)), (*np.linspace(1, 2, 20_000)[:-1], 2.5)]
    one, other = (Study(VEHICLE, {SHEAR: axis}, Solve()).inputs[f"grid.{SHEAR}"] for axis in axes)
    assert one.startswith("20000 values from 1.0 to 2.0, SHA-256 ")
    assert len(one) < 200
    assert one != other


def test_a_map_that_exceeds_the_memory_is_refused_with_the_way_out():
    axes = {SHEAR: np.linspace(1, 2, 10_000), ROTATIONAL: np.linspace(1, 2, 10_000)}
    with pytest.raises(beal.ModelError, match=r"at most 10000000 points in memory, found 100000000; name an output"):
        beal.stability_map(VEHICLE, axes)


def test_a_point_says_whether_tables_or_a_search_of_its_own_found_it():
    axes = {ROTATIONAL: [1e3], SHEAR: np.geomspace(1e2, 1e4, 20)}
    assert set(beal.stability_map(VEHICLE, axes)["method"].values.ravel()) == {METHODS.index("tables")}
    alone = beal.stability_map(VEHICLE, {"stage.split": [0.4, 1.5]})["method"]
    assert set(alone.values) == {METHODS.index("single")}
    assert alone.attrs["flag_meanings"].split()[1:] == ["tables", "single"]


@pytest.mark.parametrize("workers", [0, -1])
def test_workers_must_be_positive(workers):
    with pytest.raises(beal.ModelError, match="workers"):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, workers=workers)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"modes": 6}, r"solve\.modes: applies to corrected-ritz and as-printed only"),
        ({"max_thrust": -1.0}, r"solve\.max_thrust: must be a positive number"),
        ({"max_thrust": math.nan}, r"solve\.max_thrust: must be a positive number"),
        ({"formulation": "printed"}, r"solve\.formulation: must be one of"),
    ],
)
def test_an_option_that_suits_no_point_is_refused_before_any_is_solved(options, message):
    with pytest.raises(beal.ModelError, match=message):
        beal.stability_map(VEHICLE, {SHEAR: [1e3]}, **options)


def test_a_ritz_formulation_is_refused_with_the_reason_where_it_does_not_apply():
    held = VEHICLE.model_copy(update={"support": beal.Support(nose="clamped")})
    with pytest.raises(beal.ModelError, match=r"as-printed: applies to the paper's vehicle only.*free ends"):
        beal.stability_map(held, {SHEAR: [1e3]}, formulation="as-printed")


def test_the_tangency_of_a_vehicle_that_tumbles_does_not_spoil_the_tables_of_the_others():
    axes = {"thrust.tangency": [1.0, 0.9], ROTATIONAL: np.geomspace(10, 1e4, 6)}
    found = beal.stability_map(VEHICLE, axes)
    method = found["method"].attrs["flag_meanings"].split()
    assert {method[n] for n in found["method"].values[0]} == {"tables"}
    assert {method[n] for n in found["method"].values[1]} == {"single"}
    assert found["critical_thrust"].values[1].tolist() == [0.0] * 6
