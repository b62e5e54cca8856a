"""Columns and beams under follower forces: values on which exact transfer matrices and finite elements agree.

Tolerances are the digits given, 2e-12 the rounding of the longest.
"""

import math

import numpy as np
import pytest

from beal.discretisation.build import discretise
from beal.stability.critical import critical_thrust
from beal.stability.pencil import pencil
from beal.stability.spectrum import spectrum
from beal.vehicle import catalog
from beal.vehicle.parts import Joint, PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle

DIGITS = 1e-11  # twelve digits are given
COALESCING = 1e-8  # frequencies of a double root, nine or more digits
PI = math.pi


def beam(length: float = 1.0) -> Stage:
    return Stage(length=length, mass_per_length=1.0, bending_stiffness=1.0)


def column(tangency: float = 1.0, nose: str = "clamped", tail: str = "free") -> Vehicle:
    return Vehicle(stages=[beam()], support=Support(nose=nose, tail=tail), thrust=Thrust(tangency=tangency))


def jointed(station: float, joint: Joint, nose: str = "free") -> Vehicle:
    return Vehicle(stages=[beam(station), beam(1 - station)], joints=[joint], support=Support(nose=nose))


def frequencies(vehicle: Vehicle, thrust: float, count: int = 3) -> list[float]:
    return spectrum(discretise(vehicle, order=16), thrust, count).angular_frequency.tolist()


@pytest.mark.parametrize(
    ("thrust", "expected"),
    [
        (0, [3.51601527, 22.03449156, 61.69721441]),
        (5, [4.21767523, 20.43562243, 59.80704426]),
        (10, [5.17576226, 18.58679489, 57.85303450]),
        (15, [6.62740668, 16.25982976, 55.82924722]),
        (20, [10.52894218, 11.51061663, 53.72904325]),
    ],
)
def test_frequencies_of_becks_column(thrust, expected):
    assert frequencies(catalog.beck(), thrust) == pytest.approx(expected, rel=0, abs=6e-9)


def test_becks_column_flutters():
    found = critical_thrust(catalog.beck())
    assert (found.kind, found.modes) == ("flutter", (1, 2))
    assert found.critical_thrust == pytest.approx(20.050953618973761, rel=2e-12)
    assert found.angular_frequency == pytest.approx(11.015557640922874, rel=COALESCING)


@pytest.mark.parametrize(
    ("elements", "thrust", "omega"),
    [
        (2, 20.1923616, 11.138166),
        (3, 20.1779236, 11.090939),
        (4, 20.0980997, 11.042698),
        (6, 20.0611695, 11.021346),
        (8, 20.0542838, 11.017436),
        (16, 20.0511676, 11.015678),
        (32, 20.0509671, 11.015565),
    ],
)
def test_becks_column_in_cubic_elements(elements, thrust, omega):
    found = critical_thrust(discretise(catalog.beck(), basis="hermite", order=elements))
    assert found.critical_thrust == pytest.approx(thrust, rel=0, abs=6e-8)
    assert found.angular_frequency == pytest.approx(omega, rel=0, abs=6e-7)


@pytest.mark.parametrize(
    ("vehicle", "exact", "elements"),
    [(catalog.beck(), 20.050953618973761, (16, 32)), (catalog.beal(), 109.689191958738, (16, 32))],
)
def test_error_of_cubic_elements_falls_with_the_fourth_power(vehicle, exact, elements):
    coarse, fine = (
        critical_thrust(discretise(vehicle, basis="hermite", order=order)).critical_thrust - exact for order in elements
    )
    assert math.log2(coarse / fine) == pytest.approx(4, abs=0.05)


@pytest.mark.parametrize(
    ("tangency", "kind", "thrust", "omega"),
    [
        (0.0, "divergence", 2.46740110027, 0),
        (0.1, "divergence", 2.82958603444, 0),
        (0.2, "divergence", 3.32506684487, 0),
        (0.3, "divergence", 4.05501737549, 0),
        (0.36, "divergence", 4.70110313666, 0),
        (0.4, "divergence", 5.29241059646, 0),
        (0.55, "flutter", 16.1085099717, 7.76273176244),
        (0.6, "flutter", 16.2589695962, 8.33444171003),
        (0.8, "flutter", 17.5891735398, 9.94656438804),
        (0.9, "flutter", 18.6683837522, 10.5295522885),
        (1.1, "flutter", 21.7628266336, 11.4128470427),
        (1.2, "flutter", 23.7972167295, 11.7176817467),
        (1.5, "flutter", 30.6280672201, 12.055584233),
    ],
)
def test_partial_follower_force(tangency, kind, thrust, omega):
    found = critical_thrust(column(tangency))
    assert found.kind == kind
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS)
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING)


@pytest.mark.parametrize("tangency", [0.0, 0.15, 0.35, 0.45, 0.49])
def test_partial_follower_force_diverges_where_the_closed_form_says(tangency):
    found = critical_thrust(column(tangency))
    assert found.kind == "divergence"
    assert math.cos(math.sqrt(found.critical_thrust)) == pytest.approx(-tangency / (1 - tangency), abs=1e-9)


@pytest.mark.parametrize(
    ("mass", "thrust", "omega"),
    [
        (0.01, 19.67131352678, 10.80318231182),
        (0.05, 18.50727807815, 10.09194861373),
        (0.1, 17.59528223473, 9.432781694329),
        (0.2, 16.67616959605, 8.551691596708),
        (0.4, 16.12290723298, 7.558963816295),
        (0.5, 16.0615619664, 7.237055824457),
        (0.6, 16.0541205594, 6.977244632218),
        (0.8, 16.11376507986, 6.576223954778),
        (1, 16.2121289425, 6.274504077761),
        (1.5, 16.47952866121, 5.75036027353),
        (2, 16.71678857174, 5.398578939063),
        (3, 17.08564114211, 4.931766582472),
        (10, 18.16343552782, 3.739525487693),
        (20, 18.66839439634, 3.174721694773),
        (100, 19.45437492106, 2.15237199865),
        (1000, 19.94775832368, 1.220240908),
    ],
)
def test_pfluegers_column(mass, thrust, omega):
    found = critical_thrust(catalog.pflueger(mass))
    assert (found.kind, found.modes) == ("flutter", (1, 2))
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS)
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING)


@pytest.mark.parametrize(
    ("mass", "inertia", "thrust", "omega"),
    [
        (0.5, 0.01, 14.1167106745, 6.35978890611),
        (1, 0.01, 14.8522932418, 5.60966565152),
        (0, 0.01, 14.2478088351, 8.82267327204),
        (2, 0.2, 8.56743306015, 2.57191029569),
    ],
)
def test_pfluegers_column_with_rotary_inertia_at_the_tip(mass, inertia, thrust, omega):
    tip = PointMass(station=1.0, mass=mass, rotary_inertia=inertia)
    found = critical_thrust(Vehicle(stages=[beam()], point_masses=[tip], support=Support(nose="clamped")))
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS)
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING)


@pytest.mark.parametrize(
    ("mass", "station", "thrust"),
    [
        (0.5, 0.25, 19.4076399306),
        (0.5, 0.5, 22.8770428843),
        (0.5, 0.75, 23.98396228),
        (1, 0.25, 18.9964589584),
        (1, 0.5, 27.5412561896),
        (1, 0.75, 25.9200774641),
        (2, 0.25, 18.7427059116),
        (2, 0.5, 39.6313327389),
        (2, 0.75, 27.9641598099),
    ],
)
def test_becks_column_with_a_mass_on_the_way(mass, station, thrust):
    lump = PointMass(station=station, mass=mass)
    found = critical_thrust(Vehicle(stages=[beam()], point_masses=[lump], support=Support(nose="clamped")))
    assert found.critical_thrust == pytest.approx(thrust, rel=3e-10)  # ten digits for one of them


CRACKS = {
    0.1: (19.7615315894, 19.2705204209, 19.4669773559, 19.6843825821, 19.8810074249, 19.9615032848),
    0.25: (20.11758764, 19.9996500513, 20.0164467307, 20.0310950476, 20.0423264709, 20.046520818),
    0.5: (6.15884102509, 12.9267275327, 15.7364033548, 17.6576935876, 19.030370157, 19.5295842493),
}


@pytest.mark.parametrize(
    ("station", "stiffness", "thrust"),
    [
        (station, stiffness, thrust)
        for station, row in CRACKS.items()
        for stiffness, thrust in zip((1, 5, 10, 20, 50, 100), row, strict=True)
    ],
)
def test_becks_column_with_a_crack(station, stiffness, thrust):
    found = critical_thrust(jointed(station, Joint(rotational_stiffness=stiffness), nose="clamped"))
    assert found.critical_thrust == pytest.approx(thrust, rel=3e-10)  # ten digits for one of them


@pytest.mark.parametrize(
    ("thrust", "expected"),
    [
        (5, [21.6799291328, 60.7299372973, 119.875309102]),
        (10, [20.9746208872, 59.7670833121, 118.835956919]),
        (20, [19.5293673376, 57.7752726764, 116.72202804]),
        (40, [16.5307021782, 53.469416197, 112.342324166]),
        (80, [11.6300375901, 42.6033307991, 102.868931147]),
        (100, [13.9482741447, 34.0618162988, 97.6980376812]),
        (109, [20.328167441, 25.9266195294, 95.2585521461]),
    ],
)
def test_frequencies_of_beals_missile(thrust, expected):
    assert frequencies(catalog.beal(), thrust) == pytest.approx(expected, rel=5e-11)


def test_beals_missile_flutters():
    found = critical_thrust(catalog.beal())
    assert (found.kind, found.modes, found.rigid_body) == ("flutter", (1, 2), "neutral")
    assert found.critical_thrust == pytest.approx(109.689191958738, rel=2e-12)
    assert found.angular_frequency == pytest.approx(23.073329884381, rel=COALESCING)


@pytest.mark.parametrize("thrust", [0.0, 30.0, 90.0, 120.0])
def test_rigid_body_motion_of_beals_missile_is_a_fourfold_zero_root(thrust):
    operators = discretise(catalog.beal(), order=12)
    K = operators.stiffness(thrust)
    small = 1e-12 * max(np.abs(K).max(), 1.0)
    assert operators.rigid == 2
    assert pencil(operators).rigid == 0
    assert np.abs(K[1:, :2]).max() < small  # a tilted vehicle is pushed sideways, K[0, 1], and that is all
    assert abs(K[0, 0]) < small
    assert abs(K[0, 1]) >= 0.5 * thrust


@pytest.mark.parametrize(
    ("elements", "thrust"),
    [(3, 112.7150912), (4, 110.9610325), (6, 110.2062752), (8, 109.8742190), (16, 109.7019204), (32, 109.6900052)],
)
def test_beals_missile_in_cubic_elements(elements, thrust):
    found = critical_thrust(discretise(catalog.beal(), basis="hermite", order=elements))
    assert found.critical_thrust == pytest.approx(thrust, rel=0, abs=6e-8)


@pytest.mark.parametrize(
    ("mass", "station", "kind", "thrust", "omega"),
    [
        (0.1, 0, "flutter", 96.7183810369, 19.2519689),
        (0.1, 0.25, "flutter", 104.940010365, 21.4758374),
        (0.1, 0.5, "flutter", 101.036089357, 26.5732568),
        (0.1, 0.75, "flutter", 139.072631372, 20.1114221),
        (0.1, 0.9, "divergence", 95.4478890246, 0),
        (0.1, 1, "flutter", 102.484308544, 18.3515935),
        (0.5, 0, "divergence", 45.4509031972, 0),
        (0.5, 0.25, "divergence", 79.2876752928, 0),
        (0.5, 0.5, "flutter", 86.2418360735, 30.5152476),
        (0.5, 0.75, "divergence", 131.314319477, 0),
        (0.5, 0.9, "divergence", 84.8796602322, 0),
        (0.5, 1, "divergence", 67.5443922216, 0),
        (1, 0, "divergence", 34.2716146895, 0),
        (1, 0.25, "divergence", 60.2391085235, 0),
        (1, 0.5, "flutter", 79.4360982272, 31.5958684),
        (1, 0.75, "divergence", 167.576895044, 0),
        (1, 0.9, "divergence", 102.578695786, 0),
        (1, 1, "divergence", 78.0657245382, 0),
    ],
)
def test_beals_missile_with_a_point_mass(mass, station, kind, thrust, omega):
    found = critical_thrust(Vehicle(stages=[beam()], point_masses=[PointMass(station=station, mass=mass)]))
    assert found.kind == kind
    # the root that passes through zero meets the double one of the rotation there: the values lose two digits
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS if kind == "flutter" else 2e-10)
    assert found.angular_frequency == pytest.approx(omega, rel=0, abs=1e-7)


@pytest.mark.parametrize(
    ("station", "mass", "inertia", "thrust", "omega"),
    [
        (0, 0.2, 0.01, 62.759575606, 17.102910101),
        (0, 0.1, 0.001, 92.0138898797, 19.5083724285),
        (1, 0.1, 0.001, 94.9043930268, 17.7856480645),
    ],
)
def test_beals_missile_with_rotary_inertia_at_an_end(station, mass, inertia, thrust, omega):
    lump = PointMass(station=station, mass=mass, rotary_inertia=inertia)
    found = critical_thrust(Vehicle(stages=[beam()], point_masses=[lump]))
    assert found.critical_thrust == pytest.approx(thrust, rel=1e-11)
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING)


@pytest.mark.parametrize(
    ("nose", "tail", "thrust"),
    [
        ("pinned", "pinned", PI**2),
        ("clamped", "free", PI**2 / 4),
        ("clamped", "pinned", 20.1907285564266),
        ("clamped", "clamped", 4 * PI**2),
        ("clamped", "sliding", PI**2),
        ("pinned", "sliding", PI**2 / 4),
    ],
)
def test_euler_loads(nose, tail, thrust):
    found = critical_thrust(column(0.0, nose, tail))
    assert (found.kind, found.modes) == ("divergence", (1, 1))
    assert found.critical_thrust == pytest.approx(thrust, rel=2e-12)


DEAD_LOADS = {
    ("pinned", "pinned", PI**2): {
        0: [9.8696044011, 39.4784176044, 88.8264396098],
        0.25: [8.5473281366, 38.2248134791],
        0.5: [6.9788641996, 36.9286782119, 86.3237827259],
        0.75: [4.9348022005, 35.5853647367],
        0.9: [3.1210429512, 34.7544634374],
    },
    ("clamped", "free", PI**2 / 4): {
        0: [3.5160152685, 22.0344915647, 61.6972144136],
        0.25: [3.07349918564, 21.5753681666],
        0.5: [2.53456021607, 21.1051723546, 60.9194430451],
        0.75: [1.81130345957, 20.623377714],
        0.9: [1.15327608015, 20.3285100384],
    },
    ("clamped", "pinned", 20.1907285564266): {
        0: [15.418205717, 49.9648620318, 104.247696459],
        0.25: [13.3917717711, 47.7483310087],
        0.5: [10.970422211, 45.4229028237, 99.589874528],
        0.75: [7.7863231887, 42.9717381141],
        0.9: [4.93683803673, 41.4319692434],
    },
    ("clamped", "clamped", 4 * PI**2): {
        0: [22.3732854481, 61.6728228679, 120.903391727],
        0.25: [19.4516833932, 57.8622383502],
        0.5: [15.9512876053, 53.7626429074, 112.534223341],
        0.75: [11.3341546151, 49.3000748602],
        0.9: [7.19135854758, 46.4041655301],
    },
}


@pytest.mark.parametrize(
    ("nose", "tail", "thrust", "expected"),
    [
        (nose, tail, share * euler, expected)
        for (nose, tail, euler), rows in DEAD_LOADS.items()
        for share, expected in rows.items()
    ],
)
def test_frequencies_under_a_dead_load(nose, tail, thrust, expected):
    assert frequencies(column(0.0, nose, tail), thrust, len(expected)) == pytest.approx(expected, rel=5e-11)


@pytest.mark.parametrize(
    ("station", "stiffness", "expected"),
    [
        (0.5, 0, [0, 61.6728229, 89.4931418, 199.859448]),
        (0.4, 0, [0, 51.1142228, 112.586228]),
        (0.3, 0, [0, 39.7090254, 110.839291]),
        (0.25, 0, [0, 35.3897324, 99.0913982]),
        (0.5, 1, [11.81821231, 61.67282287, 95.75679336]),
        (0.5, 10, [19.97949333, 61.67282287, 112.1218065]),
        (0.5, 100, [22.0961309, 61.67282287, 119.749152]),
        (0.4, 1, [12.40472897, 53.52177895, 114.6002063]),
        (0.4, 10, [20.29339834, 59.11267743, 119.0092498]),
        (0.4, 100, [22.1395416, 61.35186777, 120.6705937]),
        (0.3, 1, [14.40297983, 44.29958857, 112.5608692]),
        (0.3, 10, [21.09960322, 56.19689875, 117.7110313]),
        (0.3, 100, [22.23959828, 60.99210326]),
        (0.25, 1, [16.12189208, 41.58692343, 102.171032]),
        (0.25, 10, [21.55529224, 56.21981836, 113.1576517]),
        (0.25, 100, [22.29008085, 61.03958174]),
    ],
)
def test_frequencies_with_a_rotational_joint(station, stiffness, expected):
    vehicle = jointed(station, Joint(rotational_stiffness=stiffness))
    assert frequencies(vehicle, 0.0, len(expected)) == pytest.approx(expected, rel=1e-8, abs=1e-5)


@pytest.mark.parametrize(
    ("station", "stiffness", "expected"),
    [
        (0.5, 10, [12.49869258, 22.37328545, 90.39640677]),
        (0.5, 100, [22.37328545, 35.41373155, 99.1230029]),
        (0.5, 1000, [22.37328545, 57.64933246, 120.9033917]),
        (0.25, 10, [10.27851877, 35.92625198, 64.58245962]),
        (0.25, 100, [19.83617605, 53.51500846, 69.37815897]),
        (0.25, 1000, [22.11171906, 61.33911234, 116.3656159]),
    ],
)
def test_frequencies_with_a_shear_joint(station, stiffness, expected):
    vehicle = jointed(station, Joint(shear_stiffness=stiffness))
    assert frequencies(vehicle, 0.0) == pytest.approx(expected, rel=1e-9)


ROTATIONAL_JOINT = [
    (0.5, 0.25, "divergence", 17.1519271093, 0),
    (0.5, 0.5, "divergence", 7.40974340307, 0),
    (0.5, 0.75, "divergence", 11.3942088165, 0),
    (1, 0.25, "divergence", 31.1373614773, 0),
    (1, 0.5, "divergence", 13.7930387096, 0),
    (1, 0.75, "divergence", 23.6384177091, 0),
    (5, 0.25, "flutter", 97.8518924844, 16.2437769595),
    (5, 0.5, "divergence", 44.5051840758, 0),
    (5, 0.75, "flutter", 53.3785384478, 23.754873741),
    (10, 0.25, "flutter", 102.7115938, 19.904661568),
    (10, 0.5, "divergence", 63.2458520104, 0),
    (10, 0.75, "flutter", 71.3309931076, 24.5333365567),
    (20, 0.25, "flutter", 106.057182519, 21.5374211925),
    (20, 0.5, "flutter", 113.46346307, 19.8763511475),
    (20, 0.75, "flutter", 87.0886221376, 24.3121817941),
    (100, 0.25, "flutter", 108.952415377, 22.7747211195),
    (100, 0.5, "flutter", 110.412006099, 22.4925304022),
    (100, 0.75, "flutter", 104.617059496, 23.4431018155),
    (1000, 0.25, "flutter", 109.615432144, 23.0436807179),
    (1000, 0.5, "flutter", 109.760838872, 23.0163387465),
    (1000, 0.75, "flutter", 109.171330768, 23.1136897997),
]


@pytest.mark.parametrize(("stiffness", "station", "kind", "thrust", "omega"), ROTATIONAL_JOINT)
def test_free_beam_with_a_rotational_joint(stiffness, station, kind, thrust, omega):
    found = critical_thrust(jointed(station, Joint(rotational_stiffness=stiffness)))
    assert found.kind == kind
    assert found.critical_thrust == pytest.approx(thrust, rel=1e-10)  # ten digits for one of them
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING)


# Inertial axis: k_s s = V, moments not balanced. Forward or aft axis would tie the force to one face; with the slope
# continuous all three objective axes are the one in which the force is normal to the section and M jumps by -N s.
SHEAR_JOINT = [
    (0.5, 100, ("flutter", 57.7307499924, 19.8467), ("flutter", 56.2243725932, 18.9742761935)),
    (0.5, 200, ("flutter", 82.6162584078, 21.9520), ("flutter", 71.2277304722, 19.3299383556)),
    (0.5, 500, ("flutter", 99.0764464744, 23.1888), ("flutter", 88.0542657525, 20.5275679736)),
    (0.5, 1000, ("flutter", 104.438764357, 23.2420), ("flutter", 97.0976231714, 21.4833884793)),
    (0.5, 10000, ("flutter", 109.168763367, 23.0998), ("flutter", 108.215379962, 22.8763885284)),
    (0.25, 100, ("divergence", 70.5830304976, 0), ("flutter", 107.588603372, 16.9882742872)),
    (0.25, 1000, ("flutter", 111.350105886, 22.0826), ("flutter", 108.913118546, 22.2327370053)),
    (0.75, 100, ("flutter", 35.6264382315, 30.2490), ("divergence", 47.3659010172, 0)),
    (0.75, 200, ("flutter", 41.9125457334, 56.9792), ("divergence", 58.7647802837, 0)),
    (0.75, 1000, ("flutter", 105.159470608, 26.1359), ("flutter", 109.578525386, 20.8954404129)),
]


@pytest.mark.parametrize(
    ("axis", "station", "stiffness", "kind", "thrust", "omega"),
    [("inertial", station, stiffness, *plain) for station, stiffness, plain, _ in SHEAR_JOINT]
    + [
        (axis, station, stiffness, *balanced)
        for axis in ("mean", "forward", "aft")
        for station, stiffness, _, balanced in SHEAR_JOINT
    ],
)
def test_free_beam_with_a_shear_joint(axis, station, stiffness, kind, thrust, omega):
    found = critical_thrust(jointed(station, Joint(shear_stiffness=stiffness, shear_axis=axis)))
    assert found.kind == kind
    assert found.critical_thrust == pytest.approx(thrust, rel=DIGITS)
    # four decimals are given for the inertial axis
    assert found.angular_frequency == pytest.approx(omega, rel=COALESCING, abs=6e-5 if axis == "inertial" else 0)
