"""NASTRAN-95 demonstration problem D10-01: a rocket, its attitude control and the servo of its nozzle.

The deck's matrices: fifteen massless bars with the masses of their grids from beal's cubic elements, a third section as
four simply supported modes, transfer functions on extra points. x counts from the tail there; the thrust does not
compress the structure. The roots are those that NASTRAN printed, to its digits.
"""

import numpy as np
import pytest
from scipy.linalg import block_diag, eigh

import beal
from beal import PointMass, Stage, Vehicle, discretise
from beal.control.loop import roots

GRIDS = np.arange(16) * 250 / 15  # of the first two sections, from the tail
THIRD = 50.0
MASSES = [3333.333, *[6666.667] * 8, 5000.0, *[3333.333] * 5, 2500.0]
AFT, SENSOR = 0, 10  # grids of the nozzle and, 0.491 behind, of the sensor
OFFSET = 0.491
NOSE = 833.333
THRUST, MASS, NOZZLE, ARM, INERTIA = 4.25e6, 8.5e4, 50.0, 3.0, 500.0
PRINTED = [-1.414853, -0.5075583 + 0.8188429j, 0.5202224 + 3.824517j]
RIGID = [-1.67591, -0.53968 + 0.82130j, 0.75110 + 5.96175j]  # an independent replica in the two rigid-body motions


def structure():
    """M and K in y and theta of 16 grids (the last slope left out), y of the nose, four modes; rows of y and theta."""
    bars = [(624e9, 1e-6), (208e9, 1e-6)]
    stiffness = [bars[0][0]] * 9 + [bars[1][0]] * 6
    length = float(GRIDS[1])
    stages = [Stage(length=length, mass_per_length=1e-6, bending_stiffness=EI) for EI in reversed(stiffness)]
    masses = [PointMass(station=250.0 - x, mass=mass) for x, mass in zip(GRIDS, MASSES, strict=True)]
    operators = discretise(Vehicle(stages=stages, joints=[{}] * 14, point_masses=masses), basis="hermite", order=1)
    shapes = np.linalg.inv(np.vstack((operators.shape(250.0 - GRIDS), -operators.shape(250.0 - GRIDS, 1))))
    y, theta, nose, sines = np.split(np.eye(37), [16, 32, 33])
    nose = nose[0]
    M = block_diag(shapes.T @ operators.M @ shapes, NOSE, np.zeros((4, 4)))
    K = block_diag(shapes.T @ operators.K0 @ shapes, np.zeros((5, 5)))
    for number, mode in enumerate(sines, 1):
        carried = mode + 2 / (number * np.pi) * (y[-1] - (-1) ** number * nose)  # the ends' motion as sines
        M += 2500.0 * np.outer(carried, carried)
        K += number**4 * 2.0261e7 * np.outer(mode, mode)
    turned = (nose - y[-1]) / THIRD + sum(number * np.pi / THIRD * mode for number, mode in enumerate(sines, 1))
    T = np.delete(np.eye(37), 31, axis=1)
    T[31] = np.delete(turned, 31)
    return T.T @ M @ T, T.T @ K @ T, y @ T, theta @ T


def modes(M, K, count):
    """The lowest omega^2 and shapes of unit modal mass."""
    size = 1 / np.sqrt(np.diag(K + M))
    nu, shapes = eigh(M * np.outer(size, size), (K + M) * np.outer(size, size))
    return (1 / nu - 1)[::-1][:count], (size[:, None] * shapes / np.sqrt(np.abs(nu)))[:, ::-1][:, :count]


def closed_roots(count):
    """Roots in the lowest modes, with the nozzle and its servo as the deck writes them."""
    M, K, y, theta = structure()
    W, shapes = modes(M, K, count)
    readings = (row @ shapes for row in (y[AFT], theta[AFT], y[SENSOR] - OFFSET * theta[SENSOR], theta[SENSOR]))
    return guided(np.eye(count), np.diag(np.where(W < 1e-3, 0.0, W)), *readings, turned_apart=True)


def guided(M, K, y1, theta1, sensed, tilt, turned_apart):
    """Roots of a structure with the nozzle and its servo; what the turned thrust moves may stand apart."""
    count = len(M)
    n = count + 1 + turned_apart  # with gamma and the motion that large rotations add, y_theta
    P0, P1, P2 = (np.zeros((n, n)) for _ in range(3))
    g, r = count, count + 1
    P0[:count, :count], P2[:count, :count] = K, M
    # the nozzle pulls at y1 and turns theta1 by its servo's moment T = 500 ((16 + 28 s) e_y + (15 + 7 s) e_theta
    # - (100 + 14.14 s) gamma)
    P2[:count, :count] += NOZZLE * np.outer(y1, y1) - ARM * NOZZLE * np.outer(y1, theta1)
    P0[:count, g] -= THRUST * y1
    P2[:count, g] -= ARM * NOZZLE * y1
    moment0, moment1 = np.zeros(n), np.zeros(n)
    moment0[:count], moment1[:count] = 500 * (16 * sensed + 1500 * tilt), 500 * (28 * sensed + 700 * tilt)
    moment0[r:], moment1[r:] = 500 * 16, 500 * 28
    moment0[g], moment1[g] = -500 * 100, -500 * 14.14
    P0[:count] += np.outer(theta1, moment0)
    P1[:count] += np.outer(theta1, moment1)
    P2[g, g], P2[g, :count] = INERTIA, INERTIA * theta1 - ARM * NOZZLE * y1
    P0[g] -= moment0
    P1[g] -= moment1
    if turned_apart:
        P2[r, r], P0[r, :count] = MASS, -THRUST * theta1
    zero, one = np.zeros((n, n)), np.eye(n)
    return roots(np.block([[one, zero], [zero, P2]]), np.block([[zero, one], [-P0, -P1]]), 1.0)


def test_the_bending_frequencies_are_those_printed():
    M, K, _, _ = structure()
    W, _ = modes(M, K, 7)
    np.testing.assert_allclose(
        np.sqrt(W[2:7]) / (2 * np.pi), [1.421022, 3.831627, 6.637491, 11.05952, 16.58343], rtol=1e-6
    )


@pytest.mark.parametrize(("count", "printed"), [(4, PRINTED), (2, RIGID)])
def test_the_closed_loop_has_the_roots_printed(count, printed):
    found = closed_roots(count)
    for root in printed:
        assert np.abs(found - root).min() < 5e-6 * abs(root)  # five digits; NASTRAN worked in single precision


def stick():
    """The same rocket as three uniform beams."""
    sections = [(50.0, 100.0, 52e9), (100.0, 200.0, 208e9), (150.0, 400.0, 624e9)]
    stages = [Stage(length=length, mass_per_length=m, bending_stiffness=EI) for length, m, EI in sections]
    return Vehicle(stages=stages, joints=[{}] * 2)


@pytest.mark.parametrize(("basis", "order", "tolerance"), [("legendre", 14, 1e-6), ("hermite", 16, 1e-4)])
@pytest.mark.parametrize(
    ("thrust", "hertz", "expected"),
    [  # the first three from another program, see verification
        (0.0, [1.496964, 4.017792, 7.011363], [-1.275314, -0.441654 + 0.836412j, 0.401724 + 4.425926j]),
        (THRUST, [1.489819, 4.010846, 7.002772], [-1.327613, -0.452559 + 0.825421j, 0.415428 + 4.317638j]),
    ],
)
def test_axial_force_and_follower_thrust_change_little(basis, order, tolerance, thrust, hertz, expected):
    operators = discretise(stick(), basis=basis, order=order)
    found = beal.spectrum(operators, thrust, 3).angular_frequency / (2 * np.pi)
    np.testing.assert_allclose(found, hertz, rtol=max(tolerance / 10, 4e-7))
    aft, sensor = 300.0, 300.0 - GRIDS[SENSOR]
    y1, y = operators.shape([aft, sensor])
    theta1, tilt = -operators.shape([aft, sensor], 1)
    K = operators.K0 + thrust * operators.K1
    s = guided(operators.M, K, y1, theta1, y - OFFSET * tilt, tilt, turned_apart=not thrust)
    for root in expected:
        assert np.abs(s - root).min() < tolerance * abs(root)


def test_the_rocket_diverges_at_a_hundred_times_its_thrust():
    found = beal.critical_thrust(stick())
    assert (found.kind, found.modes) == ("divergence", (1, 1))
    assert found.critical_thrust / THRUST == pytest.approx(105.341, abs=1e-3)
    assert beal.critical_thrust(stick(), basis="hermite").critical_thrust == pytest.approx(
        found.critical_thrust, rel=1e-6
    )
