"""A vehicle as a component of OpenMDAO: its partials against differences, and what it refuses."""

import math

import pytest

import beal
from beal.vehicle import catalog
from beal.vehicle.paths import with_values

om = pytest.importorskip("openmdao.api")
SPRING, SPLIT, MASS = "joint[0].rotational_stiffness", "stage.split", "stage[0].mass_per_length"
DAMPED = with_values(catalog.tsto(0.6, 20.0, 5e3), {"stage[0].internal_damping": 0.01, "thrust.nominal": 50.0})
LINKED = {"stage[0].bending_stiffness": beal.Link(MASS, power=3)}


def problem_of(vehicle, paths, **options):
    problem = om.Problem(reports=None)
    component = beal.StabilityComponent(vehicle=vehicle, paths=paths, **options)
    problem.model.add_subsystem("vehicle", component, promotes=["*"])
    problem.setup()
    return problem


@pytest.mark.filterwarnings("ignore::openmdao.api.DerivativesWarning")  # some partials are zero
@pytest.mark.parametrize(
    ("vehicle", "paths", "links"),
    [
        pytest.param(catalog.tsto(0.6, 20.0, 5e3), [SPRING, SPLIT, MASS], {}, id="flutter"),
        pytest.param(catalog.tsto(0.6, 5.0, 5e3), [SPRING, SPLIT, MASS], {}, id="divergence"),
        pytest.param(DAMPED, [SPRING, "thrust.nominal", "stage[0].internal_damping", MASS], LINKED, id="damped"),
    ],
)
def test_partials_pass_openmdaos_own_check(vehicle, paths, links):
    problem = problem_of(vehicle, paths, links=links)
    problem.run_model()
    found = problem.check_partials(out_stream=None, method="fd", form="central", step=1e-4, step_calc="rel_avg")
    sizes = {"critical_thrust": 100.0, "angular_frequency": 20.0, "mass": 1.0, "margin": 1.0}
    pairs = found["vehicle"]
    assert len(pairs) == len(paths) * (4 if vehicle.thrust.nominal else 3)
    for (output, name), pair in pairs.items():
        value = problem[name].item()
        error = abs(pair["J_fwd"].item() - pair["J_fd"].item()) * value
        assert error <= 1e-6 * sizes[output], (output, name)


def test_outputs_are_those_of_the_vehicle():
    problem = problem_of(DAMPED, [SPRING])
    problem[SPRING.replace("[", "_").replace("].", "_")] = 40.0
    problem.run_model()
    found = beal.critical_thrust(with_values(DAMPED, {SPRING: 40.0}))
    assert problem["critical_thrust"].item() == pytest.approx(found.critical_thrust, rel=1e-9)
    assert problem["angular_frequency"].item() == pytest.approx(found.angular_frequency, rel=1e-7)
    assert problem["margin"].item() == pytest.approx(found.critical_thrust / 50 - 1, rel=1e-8)
    assert problem["mass"].item() == pytest.approx(DAMPED.mass)


def test_inputs_have_units_in_si():
    stage = beal.Stage(length=10.0, mass_per_length=100.0, bending_stiffness=1e8)
    problem = problem_of(beal.Vehicle(stages=[stage]), ["stage[0].bending_stiffness", "stage[0].length"])
    problem.set_val("stage_0_length", 20.0, units="ft")
    problem.run_model()
    assert problem.get_val("mass", units="kg").item() == pytest.approx(100 * 20 * 0.3048)


@pytest.mark.parametrize(
    ("paths", "links", "message"),
    [
        (["stage[3].length"], {}, "index out of range"),
        ([SPRING], {SPRING: beal.Link(SPRING)}, "is an input and linked to one"),
        ([SPRING], {"joint[0].shear_stiffness": beal.Link(SPLIT)}, "follows stage.split, not an input"),
    ],
)
def test_what_cannot_be_an_input_is_refused(paths, links, message):
    with pytest.raises(beal.ModelError, match=message):
        problem_of(catalog.tsto(0.6, 20.0, 5e3), paths, links=links)


def test_an_infinite_input_is_refused():
    with pytest.raises(beal.ModelError, match="is infinite; give the vehicle a finite value"):
        problem_of(catalog.tsto(0.6, math.inf, 5e3), [SPRING])


def test_quantities_that_make_no_vehicle_fail_the_analysis():
    problem = problem_of(catalog.tsto(0.6, 20.0, 5e3), [SPRING])
    problem["joint_0_rotational_stiffness"] = -1.0
    with pytest.raises(om.AnalysisError, match="rotational_stiffness"):
        problem.run_model()
