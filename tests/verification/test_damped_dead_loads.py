"""Damping beside loads that do not grow with the thrust: weight, drag, axial loads.

The columns' values are those of a shooting method on (1 + tau s) EI y'''' + (N y')' + (m s^2 + c s) y = 0 with the
axial force N(x) of both loads, integrated to 1e-13; tolerances are the digits given.
"""

import math

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.errors import ModelError
from beal.motion import ModeShape, growth_rate, response
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.study.map import stability_map
from beal.vehicle import AxialLoad, Damping, Joint, PointMass, Sensor, Stage, Support, Vehicle

DIGITS = 3e-9
UNIT = {"mass_per_length": 1.0, "bending_stiffness": 1.0}


def column(internal=0.0, external=0.0, nose="clamped", **parts):
    stage = Stage(length=1.0, internal_damping=internal, external_damping=external, **UNIT)
    return Vehicle(stages=[stage], support=Support(nose=nose), **parts)


def at_the_tip(force, tangency=1.0):
    return [AxialLoad(station=1.0, force=force, tangency=tangency)]


def jointed(axial_loads=(), **parts):
    """A free vehicle under drag at its nose, damped in the forward stage and in the joint."""
    halves = [Stage(length=x, internal_damping=tau, **UNIT) for x, tau in ((0.6, 0.004), (0.4, 0.0))]
    joint = Joint(rotational_stiffness=30.0, shear_stiffness=900.0, shear_damping=0.1)
    return Vehicle(stages=halves, joints=[joint], axial_loads=axial_loads, **parts)


def drag(tangency=1.0):
    return [AxialLoad(station=0.0, force=-4.0, tangency=tangency)]


@pytest.mark.parametrize(
    ("vehicle", "thrust", "omega"),
    [
        (column(0.01, 0.5, gravity=-2.0), 15.61904768, 6.73857656),
        (column(0.01, 0.5, gravity=20.0), 21.88781891, 9.63894242),
        (column(0.01, 0.5, axial_loads=at_the_tip(1.0, 0.0)), 14.39165997, 6.66441552),
        (column(0.01, axial_loads=at_the_tip(7.0)), 10.96611165947 - 7.0, 5.399709107),
        (column(0.0, 10.0, axial_loads=at_the_tip(21.0)), 3.26885935, 9.66711714),  # more than Beck's load
    ],
)
def test_columns_under_weight_and_axial_loads(vehicle, thrust, omega):
    found = critical_thrust(vehicle)
    assert (found.kind, found.modes) == ("flutter", (1, 1))
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS)
    assert found.angular_frequency == pytest.approx(omega, rel=DIGITS)
    assert critical_events(vehicle)[0].thrust == pytest.approx(found.critical_thrust, rel=1e-10)


@pytest.mark.parametrize("vehicle", [column(0.01, 0.5, gravity=-2.0), jointed(drag())])
def test_finite_elements_agree(vehicle):
    exact, elements = critical_thrust(vehicle), critical_thrust(vehicle, basis="hermite")
    assert elements.critical_thrust == pytest.approx(exact.critical_thrust, rel=1e-6)
    assert abs(elements.critical_thrust - exact.critical_thrust) < elements.error_estimate


def test_a_dead_load_that_follows_takes_its_part_of_the_limit_of_vanishing_damping():
    limit = vanishing_damping_limit(column(0.3, axial_loads=at_the_tip(7.0)))
    assert limit.critical_thrust == pytest.approx(10.938849345588 - 7.0, rel=1e-11)
    assert limit.angular_frequency == pytest.approx(5.3986138276688, rel=1e-10)


def test_a_small_damping_under_weight_comes_close_to_the_limit():
    limit = vanishing_damping_limit(column(1.0, 50.0, gravity=-2.0)).critical_thrust
    far, near = (critical_thrust(column(e, 50 * e, gravity=-2.0)).critical_thrust - limit for e in (1e-3, 1e-4))
    assert far / near == pytest.approx(100.0, rel=1e-2)


def test_every_change_of_stability_is_one_of_a_sweep():
    vehicle = jointed(drag())
    operators = discretise(vehicle, order=14)
    events = critical_events(vehicle)
    assert events
    edges = [0.0, *(event.thrust for event in events), 1.2 * events[-1].thrust]
    for low, high, count in zip(edges, edges[1:], [0, *(event.unstable for event in events)], strict=False):
        for thrust in np.linspace(low, high, 12)[1:-1]:
            s = spectrum(operators, thrust, 8).s
            assert 2 * np.sum((s.real > 1e-9) & (s.imag > 0)) + np.sum((s.real > 1e-9) & (s.imag == 0)) == count


def test_drag_fixed_in_space_turns_a_free_vehicle_over():
    found = critical_thrust(jointed(drag(0.0)))
    assert (found.rigid_body, found.critical_thrust, found.modes) == ("tumbling", 0.0, (0, 0))
    assert found.elastic.critical_thrust == pytest.approx(
        critical_thrust(jointed(drag(0.0)), basis="hermite").elastic.critical_thrust, rel=1e-6
    )


def test_divergence_under_weight_does_not_notice_damping():
    parts = {"gravity": -2.0, "thrust": {"tangency": 0.2}}
    damped, still = critical_thrust(column(0.02, 1.0, **parts)), critical_thrust(column(**parts))
    assert (damped.kind, damped.modes) == (still.kind, still.modes) == ("divergence", (1, 1))
    assert damped.critical_thrust == pytest.approx(still.critical_thrust, rel=1e-11)


@pytest.mark.parametrize(
    "vehicle",
    [
        column(0.01, axial_loads=at_the_tip(11.0)),  # flutter, which Beck's load of 20.05 would not tell
        column(0.0, 10.0, axial_loads=at_the_tip(25.0)),
        column(0.01, axial_loads=at_the_tip(2.5, 0.0)),  # divergence
        column(0.01, 5.0, gravity=-9.0),
        column(nose="free", damping=Damping(ratios=[0.0, 0.01]), axial_loads=drag()),
    ],
)
def test_dead_loads_that_a_damped_vehicle_does_not_bear_are_refused(vehicle):
    for search in (critical_thrust, critical_events):
        with pytest.raises(ModelError, match="dead loads alone"):
            search(vehicle)
    assert np.any(spectrum(discretise(vehicle, order=14), 0.0, 4).growth_rate > 0)


def test_the_limit_is_none_where_dead_loads_feed_a_mode_as_damping_vanishes():
    vehicle = column(0.1, axial_loads=at_the_tip(12.0))
    assert critical_thrust(vehicle).critical_thrust == pytest.approx(13.6393176099 - 12.0, rel=1e-9)
    assert vanishing_damping_limit(vehicle).critical_thrust == 0.0


def test_curve_map_and_motion_know_the_dead_loads():
    vehicle = column(0.01, gravity=-2.0, sensors=(Sensor(name="tip", station=1.0),))
    critical = critical_thrust(vehicle).critical_thrust
    curve = thrust_curve(vehicle, to=2 * critical, points=3, modes=1)
    assert curve.growth_rate[1, 0] == pytest.approx(0.0, abs=1e-8)
    chart = stability_map(vehicle, {"gravity": [-2.0, 0.0]})
    assert chart["critical_thrust"].values == pytest.approx([critical, 10.96611165947], rel=1e-6)
    period = 2 * math.pi / curve.angular_frequency[2, 0]
    motion = response(
        vehicle, 12 * period, 2 * critical, step=period / 40, method="exact", modes=3, initial=ModeShape(1, 0.01)
    )
    assert growth_rate(motion, "tip") == pytest.approx(curve.growth_rate[2, 0], rel=1e-2)


def test_a_point_mass_under_gravity_presses_as_its_weight_does():
    mass = column(0.01, point_masses=[PointMass(station=1.0, mass=0.3)], gravity=-5.0)
    force = column(0.01, point_masses=[PointMass(station=1.0, mass=0.3)], axial_loads=at_the_tip(1.5, 0.0))
    light = column(0.01, gravity=-5.0)
    difference = [discretise(v).dead for v in (mass, force, light)]
    np.testing.assert_allclose(difference[0] - difference[2], difference[1], atol=1e-12)
