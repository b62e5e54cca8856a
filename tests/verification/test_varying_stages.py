"""Stages whose properties vary: exact values, other discretisations, and tables as rough as data are."""

import numpy as np
import pytest

from beal.discretisation import cuts
from beal.discretisation.basis import segments
from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle import Joint, PointMass, Stage, Support, Vehicle, catalog, with_values

CLAMPED = Support(nose="clamped")


def table(x, value):
    return {"x": x, "value": value}


def beam(mass=1.0, stiffness=1.0, length=1.0, **more):
    return Stage(length=length, mass_per_length=mass, bending_stiffness=stiffness, **more)


@pytest.mark.parametrize(
    ("taper", "thrust", "frequency"), [(0.2, 18.2669761063, 11.5381164097), (0.5, 15.6265309645, 12.731591193)]
)
def test_a_tapered_becks_column(taper, thrust, frequency):
    slope = table([0, 1], [1, 1 - taper])
    for basis, tolerance in (("legendre", 4e-12), ("hermite", 1e-9)):
        found = critical_thrust(Vehicle(stages=[beam(slope, slope)], support=CLAMPED), basis=basis)
        assert found.critical_thrust == pytest.approx(thrust, rel=tolerance)
        assert found.angular_frequency == pytest.approx(frequency, rel=3e-9)


@pytest.mark.parametrize(
    ("mass", "thrust"), [(table([0, 1], [1, 2]), 213.805340125), (1.0, 181.034532811)], ids=["mass too", "stiffness"]
)
def test_a_tapered_beam_in_flight(mass, thrust):
    vehicle = Vehicle(stages=[beam(mass, table([0, 1], [1, 2]))])
    found = critical_thrust(vehicle)
    assert found.critical_thrust == pytest.approx(thrust, rel=5e-12)
    assert found.rigid_body == "neutral"


def test_a_table_of_many_stations_tends_to_the_smooth_beam():
    errors = []
    for count in (20, 100, 1000):
        x = np.linspace(0, 1, count + 1)
        vehicle = Vehicle(stages=[beam(table(x, (1 + x) ** 2), table(x, (1 + x) ** 4))])
        errors.append(critical_thrust(vehicle).critical_thrust / 507.36825869 - 1)
    assert errors == pytest.approx([1.176183e-3, 4.705697e-5, 4.7058e-7], rel=1e-4)  # falls with the square
    assert len(segments(vehicle)) <= 12


@pytest.mark.parametrize("order", [4, 9])
@pytest.mark.parametrize("basis", ["legendre", "hermite"])
def test_a_table_of_one_value_is_that_value(basis, order):
    flat = beam(table([0, 0.1, 0.2, 0.6], [2, 2, 2, 2]), table([0, 0.5, 0.6], [3, 3, 3]), 0.6)
    plain = beam(2.0, 3.0, 0.6)
    joint = Joint(rotational_stiffness=7.0, shear_stiffness=70.0)
    found, expected = (
        discretise(Vehicle(stages=[stage, plain], joints=[joint]), basis=basis, order=order) for stage in (flat, plain)
    )
    for thrust in (0.0, 30.0):
        W = [spectrum(operators, thrust, 5).W for operators in (found, expected)]
        np.testing.assert_allclose(*W, rtol=1e-11, atol=1e-9)


def test_a_steep_line_is_the_same_line_with_more_stations():
    found = []
    for count in (2, 40):
        x = np.linspace(0, 1, count)
        vehicle = Vehicle(stages=[beam(1.0, table(x, 1000.0 - 999.0 * x))], support=CLAMPED)
        found.append(
            critical_thrust(vehicle, tolerance=1e-9)
        )  # all but singular at the tip: polynomials are slow there
    assert found[0].critical_thrust == pytest.approx(found[1].critical_thrust, rel=1e-11)
    elements = critical_thrust(vehicle, basis="hermite", tolerance=1e-4)
    assert elements.critical_thrust == pytest.approx(found[0].critical_thrust, rel=1e-4)


def test_splitting_a_tapered_stage_changes_nothing():
    x = np.array([0.0, 0.3, 0.3, 0.7, 1.0])
    mass, stiffness = np.array([1, 2, 0.5, 1, 3]), np.array([2, 1, 1.5, 0.7, 0.8])
    whole = beam(table(x, mass), table(x, stiffness))

    def part(a, b):
        inside = (x > a) & (x < b)

        def cut(values):
            front, back = np.interp([a, b], x, values)
            return table(np.concatenate(([a], x[inside], [b])) - a, np.concatenate(([front], values[inside], [back])))

        return beam(cut(mass), cut(stiffness), b - a)

    lump = PointMass(station=0.5, mass=0.2)
    for support in (Support(), CLAMPED):
        parts = [part(0.0, 0.15), part(0.15, 0.5), part(0.5, 1.0)]
        one = Vehicle(stages=[whole], point_masses=[lump], support=support)
        three = Vehicle(stages=parts, joints=[Joint(), Joint()], point_masses=[lump], support=support)
        assert (three.mass, three.centre_of_mass) == pytest.approx((one.mass, one.centre_of_mass), rel=1e-14)
        assert three.moment_of_inertia == pytest.approx(one.moment_of_inertia, rel=1e-13)
        found = [critical_thrust(vehicle).critical_thrust for vehicle in (one, three)]
        assert found[0] == pytest.approx(found[1], rel=1e-10)
        elements = critical_thrust(one, basis="hermite")
        assert elements.critical_thrust == pytest.approx(found[0], rel=1e-7)


def rough(kind, stations, seed):
    """Values that jump by factors of up to e^3 and e^2.4 from station to station, linear or constant in between."""
    rng = np.random.default_rng(seed)

    def values(spread):
        if kind == "kinks":
            x = np.sort(np.append(rng.uniform(0, 1, stations - 1), [0, 1]))
            return table(x, np.exp(spread * rng.uniform(-1, 1, stations + 1)))
        x = np.repeat(np.concatenate(([0], np.sort(rng.uniform(0, 1, stations - 1)), [1])), 2)[1:-1]
        return table(x, np.repeat(np.exp(spread * rng.uniform(-1, 1, stations)), 2))

    stage = beam(values(1.5), values(1.2))
    return Vehicle(stages=[stage], support=CLAMPED if seed % 2 else Support())


@pytest.mark.parametrize("kind", ["kinks", "steps"])
@pytest.mark.parametrize("stations", [4, 10, 40])
def test_the_error_estimate_holds_for_rough_tables(kind, stations, monkeypatch):
    for seed in (0, 1):
        vehicle = rough(kind, stations, seed)
        found = critical_thrust(vehicle)
        coarse = critical_thrust(discretise(vehicle, order=8))
        with monkeypatch.context() as patch:  # an end at every station
            patch.setattr(cuts, "NOTICED", 0.0)
            cuts.cuts.cache_clear()
            exact = critical_thrust(vehicle)
        cuts.cuts.cache_clear()
        error = abs(found.critical_thrust - exact.critical_thrust)
        assert error <= found.error_estimate + exact.error_estimate <= 1e-9 * exact.critical_thrust
        assert coarse.critical_thrust == pytest.approx(exact.critical_thrust, rel=1e-6)


def test_kinks_in_many_short_stages_that_shear_count_too():
    count = 40
    half = 0.5 / count
    pointed = beam(1.0, table([0, half, 2 * half], [1.0, 1.5, 1.0]), 2 * half, shear_stiffness=1e4)
    rising, falling = (beam(1.0, table([0, half], ends), half, shear_stiffness=1e4) for ends in ([1, 1.5], [1.5, 1]))
    whole, halved = (
        critical_thrust(Vehicle(stages=parts * count, joints=[Joint()] * (len(parts) * count - 1)))
        for parts in ([pointed], [rising, falling])
    )
    assert whole.error_estimate < 1e-9 * whole.critical_thrust
    assert whole.critical_thrust == pytest.approx(halved.critical_thrust, rel=1e-10)


def test_dense_matrices_stay_small_however_long_the_table():
    vehicle = rough("kinks", 400, 0)
    assert len(segments(vehicle)) <= cuts.FEW
    assert discretise(vehicle).M.shape[0] <= 2 + 11 * cuts.FEW


def test_moving_a_joint_stretches_the_tables():
    upper = beam(table([0, 0.3, 0.6], [1, 2, 1]), 1.0, 0.6)
    lower = beam(1.0, table([0, 0.4], [2, 1]), 0.4)
    load = {"value": table([0.0, 1.0], [1.0, 0.0])}
    vehicle = Vehicle(stages=[upper, lower], joints=[Joint()], distributed_thrust=[load])
    moved = with_values(vehicle, {"stage.split": 0.3})
    assert moved.stages[0].mass_per_length.x == pytest.approx((0.0, 0.15, 0.3))
    assert moved.stages[0].mass == pytest.approx(vehicle.stages[0].mass / 2)
    assert moved.stages[1].bending_stiffness.value == (2.0, 1.0)
    longer = with_values(vehicle, {"stage[1].length": 1.4})
    assert longer.stages[1].bending_stiffness.x == (0.0, 1.4)
    assert longer.distributed_thrusts[0].value.x == (0.0, 2.0)
    assert with_values(vehicle, {"stage[1].length": 0.4}) == vehicle


def test_a_tapered_vehicle_has_a_map_and_no_formulation_of_the_paper():
    from beal.errors import ModelError
    from beal.study.map import stability_map

    stages = [beam(1.0, table([0, 0.6], [1.0, 2.0]), 0.6), beam(table([0, 0.2, 0.4], [1, 3, 1]), 1.0, 0.4)]
    vehicle = Vehicle(stages=stages, joints=[Joint(rotational_stiffness=50.0, shear_stiffness=500.0)])
    axis = np.geomspace(5.0, 500.0, 3)
    chart = stability_map(vehicle, {"joint[0].rotational_stiffness": axis})
    one_by_one = [
        critical_thrust(with_values(vehicle, {"joint[0].rotational_stiffness": k})).critical_thrust for k in axis
    ]
    np.testing.assert_allclose(chart.critical_thrust, one_by_one, rtol=1e-8)
    with pytest.raises(ModelError, match="uniform mass per length"):
        discretise(vehicle, "as-printed")
    assert critical_thrust(catalog.beck()).critical_thrust == pytest.approx(20.050953618973761, rel=2e-12)
