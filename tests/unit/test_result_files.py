"""Results as files of other programs hold the numbers that were computed."""

import numpy as np
import pytest
import xarray
from scipy.io import loadmat

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.interop import results
from beal.interop.files import write_result
from beal.motion import ModeShape
from beal.motion import response as motion_of
from beal.stability.curve import thrust_curve
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog


@pytest.fixture(scope="module")
def operators():
    return discretise(catalog.tsto(0.6, 50.0, 5000.0), order=12)


@pytest.fixture(scope="module")
def shapes(operators):
    return results.mode_shapes(spectrum(operators, 10.0, count=2), operators, points=5)


@pytest.fixture(scope="module")
def histories(operators):
    return results.response(motion_of(operators, 0.3, 10.0, step=0.003, modes=8, initial=ModeShape(1, 0.01)))


def test_mode_shapes_are_scaled_and_kink_at_the_joint(shapes):
    displacement, slope = shapes["displacement_real"], shapes["slope_real"]
    assert np.abs(displacement).max("point").values.tolist() == [1.0, 1.0]
    assert shapes["station"].values[[4, 5]].tolist() == [0.6, 0.6]
    assert shapes["stage"].values.tolist() == [0] * 5 + [1] * 5
    assert abs(slope[0, 4] - slope[0, 5]) > 0.1 > abs(displacement[0, 4] - displacement[0, 5])


@pytest.fixture(scope="module")
def fluttering():
    operators = discretise(catalog.beal(), order=12)
    return results.mode_shapes(spectrum(operators, 120.0, count=2), operators, points=3)


def test_fluttering_modes_have_an_imaginary_part(fluttering):
    assert fluttering["growth_rate"].max() > 1
    assert np.abs(fluttering["displacement_imag"]).max() > 0.01


@pytest.mark.parametrize("kind", ["shapes", "histories"])
def test_netcdf_holds_what_was_computed(request, tmp_path, kind):
    dataset = request.getfixturevalue(kind)
    write_result(dataset, tmp_path / "result.nc", ".nc")
    with xarray.open_dataset(tmp_path / "result.nc") as again:
        xarray.testing.assert_equal(again, dataset)


def test_quantities_carry_units_where_they_have_them():
    v = catalog.beck().model_copy(update={"units": "SI"})
    operators = discretise(v, order=8)
    found = results.mode_shapes(spectrum(operators, count=1), operators)
    assert found["station"].attrs == {"units": "m"}
    assert results.thrust_curve(thrust_curve(v, 5.0, 3, 1, "objective"))["thrust"].attrs == {"units": "N"}


def test_matlab_holds_what_was_computed(tmp_path, histories):
    write_result(histories, tmp_path / "result.mat", ".mat")
    found = loadmat(tmp_path / "result.mat")
    assert found["displacement"].tolist() == histories["displacement"].values.tolist()
    assert found["time"].shape == (histories.sizes["time"], 1)
    assert found["sensor"][0][0].tolist() == ["imu"]
    assert found["thrust"].tolist() == [[10.0]]


def test_the_universal_file_holds_nodes_and_shapes(tmp_path, shapes):
    write_result(shapes, tmp_path / "result.uff", ".uff")
    sets = data_sets(tmp_path / "result.uff")
    assert [lines[0] for lines in sets] == ["    15", "    55", "    55"]
    assert [float(line[40:53]) for line in sets[0][1:]] == pytest.approx(shapes["station"].values, rel=1e-5)
    first = sets[1]
    assert fields(first[6], 10) == [1, 2, 3, 8, 2, 6]
    assert fields(first[8], 13)[0] == pytest.approx(float(shapes["angular_frequency"][0]) / (2 * np.pi), rel=1e-5)
    values = [fields(line, 13) for line in first[10::2]]
    assert [row[1] for row in values] == pytest.approx(shapes["displacement_real"].values[0], abs=1e-5)
    assert [row[5] for row in values] == pytest.approx(shapes["slope_real"].values[0], rel=1e-5, abs=1e-5)


def test_complex_shapes_are_written_as_such(tmp_path, fluttering):
    write_result(fluttering, tmp_path / "result.unv", ".unv")
    first = data_sets(tmp_path / "result.unv")[1]
    assert fields(first[6], 10) == [1, 3, 3, 8, 5, 6]
    values = [fields(a + b, 13) for a, b in zip(first[10::3], first[11::3], strict=True)]
    assert [row[3] for row in values] == pytest.approx(fluttering["displacement_imag"].values[0], abs=1e-5)


def test_the_universal_file_holds_histories(tmp_path, histories):
    write_result(histories, tmp_path / "result.uff", ".uff")
    sets = data_sets(tmp_path / "result.uff")
    names = ["displacement", "rate", "acceleration", "slope", "slope_rate"]
    assert [lines[1].strip() for lines in sets] == [f"imu {name}" for name in names]
    assert fields(sets[0][7][:30], 10) == [4, histories.sizes["time"], 1]
    assert fields(sets[0][7][30:], 13) == pytest.approx([0.0, 0.003, 0.0])
    values = [value for line in sets[1][12:] for value in fields(line, 20)]
    assert values == pytest.approx(histories["rate"].values[0], rel=1e-11)


def test_a_curve_has_no_place_in_the_universal_file(tmp_path):
    dataset = results.thrust_curve(thrust_curve(catalog.beck(), 5.0, 3, 1, "objective"))
    with pytest.raises(ModelError, match=r"\.uff files hold mode shapes and time histories"):
        write_result(dataset, tmp_path / "result.uff", ".uff")


def data_sets(path):
    """The lines of each data set, without its two delimiters."""
    inner = path.read_text().split("    -1\n")
    return [block.splitlines() for block in inner if block]


def fields(line, width):
    texts = [line[start : start + width] for start in range(0, len(line), width)]
    return [float(text) for text in texts]
