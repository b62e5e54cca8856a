"""Refinement: which cells are divided, what is kept, and what is refused."""

import math

import numpy as np
import pytest
import xarray
import zarr

import beal
from beal.study.lattice import ONE, Lattice
from beal.study.refine import refine
from beal.study.refined import refined_map
from beal.study.solve import solve_points
from beal.study.variables import VARIABLES, empty

ROTATIONAL, SHEAR = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
VEHICLE = beal.catalog.tsto(0.6, 5000.0, 5000.0)
AXES = {ROTATIONAL: np.geomspace(1, 1e4, 9), SHEAR: np.geomspace(1e2, 1e4, 9)}


def square(points=11, width=0.01, axes=2):
    return Lattice({f"axis {n}": tuple(np.linspace(0, 1, points)) for n in range(axes)}, width)


def resolved(lattice, field, **options):
    """Refinement of a map in which the field, of the values, says what is found."""

    def solve(places):
        values = lattice.values(places)
        arrays = empty((len(values),))
        arrays["status"][:] = 1
        for name, column in (
            {"kind": 1, "mode_low": 1, "mode_high": 2, "critical_thrust": 50.0} | field(values)
        ).items():
            arrays[name][:] = column
        return arrays

    return refine(lattice, solve(lattice.grid_points()), solve, **options)


def disc(values, centre=0.47, radius=0.31):
    return {"kind": 1 + (np.linalg.norm(values - centre, axis=1) < radius)}


def ends(lattice, found):
    return lattice.values(found.low), lattice.values(found.high)


def test_every_place_of_a_border_lies_in_a_narrow_cell():
    lattice = square(width=0.004)
    low, high = ends(lattice, resolved(lattice, disc))
    assert np.max(high - low) <= 0.004
    angle = np.linspace(0, 2 * math.pi, 400)[:, None]
    circle = 0.47 + 0.31 * np.hstack((np.cos(angle), np.sin(angle)))
    inside = (low[:, None] <= circle + 1e-3) & (circle - 1e-3 <= high[:, None])
    assert np.all(np.any(np.all(inside, axis=2), axis=0))


@pytest.mark.parametrize(("axes", "finest", "growth"), [(1, 4096, 1.2), (2, 1024, 2.0), (3, 64, 4.0)])
def test_points_grow_like_the_extent_of_the_border(axes, finest, growth):
    counts = [len(resolved(square(9, width, axes), disc).places) for width in (2 / finest, 1 / finest)]
    assert counts[1] / counts[0] < 1.1 * growth


@pytest.mark.parametrize("name", ["kind", "mode_low", "mode_high", "status"])
def test_a_change_of_any_label_is_a_border(name):
    lattice = square()
    found = resolved(lattice, lambda values: {name: 1 + (values[:, 0] > 0.512)})
    low, high = ends(lattice, found)
    assert np.all((low[:, 0] <= 0.512) & (high[:, 0] >= 0.512))
    assert np.sum((high - low)[:, 1]) == pytest.approx(1.0)
    assert np.all(found.sides[name] == [1, 2])


@pytest.mark.parametrize("axes", [1, 2, 4])
def test_a_jump_of_the_thrust_inside_one_region_is_a_border(axes):
    lattice = square(4, 0.1, axes)
    found = resolved(lattice, lambda values: {"critical_thrust": 50 + values[:, -1] + 2 * (values[:, 0] > 0.512)})
    low, high = ends(lattice, found)
    assert len(low) > 0
    assert np.all((low[:, 0] <= 0.512) & (high[:, 0] >= 0.512))
    assert np.prod(high - low, axis=1).sum() == pytest.approx((high - low)[0, 0])  # all along the jump
    assert np.all(found.sides["critical_thrust"][:, 1] > found.sides["critical_thrust"][:, 0] + 1)


def test_a_tongue_that_narrows_inside_one_region_is_followed_to_its_tip():
    lattice = square(width=0.002)

    def tongue(values):
        x, y = values.T
        return {"critical_thrust": np.where(np.abs(y - 0.51) < 0.1 * (0.6 - x), 40.0, 50.0)}

    _, high = ends(lattice, resolved(lattice, tongue))
    assert 0.55 < high[:, 0].max() < 0.602


def test_a_smooth_thrust_is_no_border():
    lattice = square(21, width=0.01)
    found = resolved(lattice, lambda values: {"critical_thrust": np.exp(3 * values[:, 0]) * (1 + values[:, 1] ** 2)})
    assert len(found.low) == 0
    assert len(found.places) == 20**2  # the centres


def test_an_island_at_the_centre_of_a_cell_is_found():
    lattice = square(6, 0.01)
    low, _ = ends(lattice, resolved(lattice, lambda values: disc(values, centre=0.5, radius=0.03)))
    assert np.ptp(low, axis=0) == pytest.approx([0.06, 0.06], abs=0.01)


@pytest.mark.parametrize("name", ["kind", "critical_thrust"])
@pytest.mark.parametrize("turn", [0, 1, 2, 3])
def test_a_border_is_followed_into_cells_that_it_enters_between_their_corners(turn, name):
    lattice = square(6, 0.01)

    def tongue(values):
        """From one edge across to 0.9, clear of the corners and centres of all cells but the first."""
        x, y = (
            (values.T if turn < 2 else values.T[::-1]) if turn % 2 else 1 - (values.T if turn < 2 else values.T[::-1])
        )
        inside = (np.abs(y - 0.44) < 0.03) & (x < 0.9) | (x < 0.1) & (y < 0.44)
        return {name: 1 + inside}

    low, high = ends(lattice, resolved(lattice, tongue))
    along = turn // 2
    reach = high[:, along].max() if turn % 2 else 1 - low[:, along].min()
    assert reach == pytest.approx(0.9, abs=0.01)


def test_a_cell_that_is_divided_late_is_judged_by_the_points_that_its_neighbours_had_before():
    lattice = square(6, 0.01)

    def tongue(values):
        """Down from a border that is resolved long before the face y = 0.6 is seen to be crossed."""
        x, y = values.T
        return {"kind": 1 + ((y > 0.62) | (np.abs(x - 0.538) < 0.008) & (y > 0.45))}

    low, _ = ends(lattice, resolved(lattice, tongue))
    assert low[:, 1].min() == pytest.approx(0.45, abs=0.01)


def test_axes_are_divided_in_their_spacing():
    lattice = Lattice({"log": (1.0, 10.0, 100.0), "even": (1.0, 2.0, 3.0), "two": (1.0, 2.0), "sign": (-1.0, 0.0)}, 0.5)
    assert lattice.spacing == {"log": "log", "even": "linear", "two": "linear", "sign": "linear"}
    assert lattice.values(np.full((1, 4), ONE // 2)) == pytest.approx(np.array([[math.sqrt(10), 1.5, 1.5, -0.5]]))


def test_all_axes_become_as_narrow_and_none_narrower_than_needed():
    lattice = Lattice({"fine": tuple(range(33)), "coarse": (0.0, 1.0, 2.0)}, 1 / 64)
    widths = lattice.widest * lattice.sizes / ONE
    assert widths[-1] == pytest.approx([1 / 64, 1 / 64])
    assert widths[:5, 0] == pytest.approx(1 / 32)  # the coarse axis catches up first


def test_values_of_the_grid_are_exact_on_the_lattice():
    values = tuple(np.geomspace(1, 1e4, 30))
    lattice = Lattice({"k": values}, 0.01)
    assert lattice.values(lattice.grid_points())[:, 0].tolist() == list(values)


def test_more_points_than_the_limit_are_refused_with_what_was_reached():
    message = r"more than 1000 points; the first 625 resolved every border to 0\.025 of the axes, asked for 0\.001"
    with pytest.raises(beal.ModelError, match=message):
        resolved(square(width=0.001), disc, limit=1000)


@pytest.mark.parametrize("width", [0.0, -1.0, 1.0, 2.0, math.nan])
def test_a_width_that_is_no_share_is_refused(width):
    with pytest.raises(beal.ModelError, match="refine: the width must lie between"):
        refined_map(VEHICLE, AXES, width)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([3.0, 2.0, 1.0], "must ascend"),
        ([1.0, 1.0, 2.0], "must ascend without repetition"),
        ([1.0, math.inf], "only finite values"),
    ],
)
def test_an_axis_that_cannot_be_divided_is_refused(values, message):
    with pytest.raises(beal.ModelError, match=message):
        refined_map(VEHICLE, {ROTATIONAL: values}, 0.1)


@pytest.mark.parametrize(("points", "axes"), [(2, 7), (1, 1)])
def test_too_many_axes_or_none_to_divide_are_refused(points, axes):
    with pytest.raises(beal.ModelError, match="between 1 and 6 axes"):
        square(points, 0.5, axes)


def test_an_axis_with_one_value_is_not_divided():
    found = refined_map(VEHICLE, {ROTATIONAL: AXES[ROTATIONAL], SHEAR: [1e3]}, 0.01).refined
    assert np.unique(found[SHEAR]).tolist() == [1e3]
    assert found.sizes["cell"] == 1


def same(one, other):
    return one.sizes == other.sizes and all(np.array_equal(one[name], other[name], equal_nan=True) for name in one)


class Stop(KeyboardInterrupt):
    """What Ctrl-C raises."""


def test_an_interrupted_refinement_resumes_to_the_same_borders_without_solving_again(tmp_path):
    out = tmp_path / "map.zarr"
    undisturbed = refined_map(VEHICLE, AXES, 0.02).refined

    def stop(done, total):
        if done >= 300:
            raise Stop

    with pytest.raises(Stop):
        refined_map(VEHICLE, AXES, 0.02, out=out, progress=stop)
    kept = xarray.open_zarr(str(out), group="refined", chunks=None).sizes["point"]
    assert 0 < kept < undisturbed.sizes["point"]
    seen = []
    resumed = refined_map(
        VEHICLE, AXES, 0.02, out=out, resume=True, progress=lambda done, total: seen.append(done)
    ).refined
    assert seen[-1] == 81 + undisturbed.sizes["point"]
    assert len([done for done in seen if done > 81]) < 8
    assert same(resumed, undisturbed)
    assert resumed.attrs == undisturbed.attrs
    assert set(resumed.coords) == set(undisturbed.coords) == set(AXES)


def test_a_full_disk_keeps_the_points_that_were_solved(tmp_path, monkeypatch):
    out = tmp_path / "map.zarr"
    beal.stability_map(VEHICLE, AXES, out=out)
    variables = len(VARIABLES) + len(AXES) + 1
    write, writes = zarr.Array.__setitem__, []

    def full(array, *arguments):
        writes.append(1)
        if len(writes) > 2 * variables + 5:  # the empty group, one whole part, half of the next
            raise OSError(28, "No space left on device")
        write(array, *arguments)

    with monkeypatch.context() as patch:
        patch.setattr(zarr.Array, "__setitem__", full)
        with pytest.raises(beal.ModelError, match=r"No space left on device.*kept.*--resume"):
            refined_map(VEHICLE, AXES, 0.05, out=out, resume=True)
    assert (
        xarray.open_zarr(str(out), group="refined", chunks=None).sizes["point"] == 55
    )  # centres of cells of one region
    assert same(
        refined_map(VEHICLE, AXES, 0.05, out=out, resume=True).refined, refined_map(VEHICLE, AXES, 0.05).refined
    )


def test_a_smaller_width_goes_on_with_the_points_of_a_larger(tmp_path, monkeypatch):
    out = tmp_path / "map.zarr"
    coarse = refined_map(VEHICLE, AXES, 0.05, out=out)
    kept = coarse.refined.sizes["point"]
    solved = []

    def solve(study, values):
        solved.append(len(values))
        return solve_points(study, values)

    monkeypatch.setattr("beal.study.refined.solve_points", solve)
    fine = refined_map(VEHICLE, AXES, 0.02, out=out, resume=True)
    assert sum(solved) == fine.refined.sizes["point"] - kept
    direct = refined_map(VEHICLE, AXES, 0.02).refined
    assert np.array_equal(fine.refined["low"], direct["low"])
    assert fine.refined.sizes["point"] == direct.sizes["point"]
    again = refined_map(VEHICLE, AXES, 0.02, out=out, resume=True)
    assert same(again.refined, fine.refined)


def test_points_carry_all_variables_and_none_lies_twice():
    found = refined_map(VEHICLE, AXES, 0.02)
    assert set(VARIABLES) < set(found.refined)
    places = found.refined["place"].values
    assert len(np.unique(places, axis=0)) == len(places)
    assert np.any(places % ONE != 0, axis=1).all()  # off the grid
    assert found.refined["kind"].attrs == found.grid["kind"].attrs
