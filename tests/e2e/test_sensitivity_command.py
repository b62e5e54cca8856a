"""beal sensitivity as a user runs it."""

import pytest

MODEL = """units = "nondimensional"
[[stage]]
length = 0.6
mass_per_length = 1.0
bending_stiffness = 1.0
[[stage]]
length = 0.4
mass_per_length = 1.0
bending_stiffness = 1.0
[[joint]]
rotational_stiffness = 20.0
shear_stiffness = 100.0
"""


@pytest.fixture
def model(written):
    return written(MODEL)


def test_derivatives_are_given_as_json(result_of, model):
    found = result_of("sensitivity", model)
    each = {entry["path"]: entry for entry in found["parameters"]}
    scale = each["thrust.scale"]
    assert scale["derivative"] == pytest.approx(-found["critical_thrust"])
    assert scale["elasticity"] == pytest.approx(-1.0)
    assert {"path", "value", "derivative", "elasticity"} <= set(scale)


def test_frequencies_under_a_thrust_are_differentiated_on_request(result_of, model):
    path = "stage[0].bending_stiffness"
    found = result_of("sensitivity", model, "--thrust", 10, "--count", 2, "--path", path)
    (entry,) = found["parameters"]
    assert entry["path"] == path
    assert len(entry["derivative"]) == len(found["angular_frequency"]) == 2


def test_an_unknown_quantity_is_refused(beal_here, model):
    done = beal_here("sensitivity", model, "--path", "stage[0].stiffnes")
    assert done.returncode == 2
    assert "stage[0].stiffnes" in done.stderr


def test_a_quantity_without_effect_is_refused(beal_here, written):
    sensor = '[[sensor]]\nname = "imu"\nstation = 0.1\n'
    done = beal_here("sensitivity", written(MODEL + sensor), "--path", "sensor[0].station")
    assert done.returncode == 2
    assert "has no effect" in done.stderr
