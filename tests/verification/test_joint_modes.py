"""Jointed-beam modes against published frequencies, their equations and an independent count of roots."""

import math
from itertools import product

import numpy as np
import pytest
from numpy.polynomial import Legendre

from beal.discretisation.joint_modes import JointModes, joint_modes
from beal.errors import ModelError

INF = math.inf
# Free-free uniform beam: cos(b) cosh(b) = 1.
UNIFORM = [4.7300407448627, 7.85320462409584, 10.9956078380017, 14.1371654912575]
# Everyday cases, corners of the ranges, splits where a stage's frequency meets the other's or the whole's.
CASES = [
    (split, rotational, shear, sign)
    for split, (rotational, shear), sign in product(
        (0.05, 0.2, UNIFORM[0] / UNIFORM[2], UNIFORM[0] / (UNIFORM[0] + UNIFORM[1]), 0.5, 0.8),
        ((3e3, 3e3), (1, 1e4), (1e-2, 1e-2), (1e12, 1e12), (1e-2, 1e12), (INF, 1e-2), (0, INF), (0, 0)),
        ("natural", "printed"),
    )
]


def random_cases(number: int) -> list[tuple[float, float, float, str]]:
    rng = np.random.default_rng(2009)
    drawn = []
    for _ in range(number):
        springs = np.where(rng.random(2) < 0.1, rng.choice([0.0, INF], 2), 10.0 ** rng.uniform(-2, 12, 2))
        drawn.append((rng.uniform(0.05, 0.95), *springs.tolist(), str(rng.choice(["natural", "printed"]))))
    return drawn


class LegendreBeams:
    """The same vehicle in Legendre polynomials, with the loads at the joint as Lagrange multipliers.

    Springs enter by their compliance, so rigid joints need no penalty. The matrix [[K - mu M, B], [B^T, -C]]
    has one negative eigenvalue per root below, after the four rigid-body motions of the separate stages.
    """

    def __init__(self, split: float, rotational: float, shear: float, sign: str, highest: float) -> None:
        lengths = (split, 1 - split)
        sizes = [14 + math.ceil(0.75 * highest * length) for length in lengths]
        border = sum(sizes)
        self.matrix = np.zeros((border + 2, border + 2))
        self.mass = np.zeros((border + 2, border + 2))
        for length, size, start, side in zip(lengths, sizes, (0, sizes[0]), (1.0, -1.0), strict=True):
            # of unit strain energy, apart from the rigid-body motions
            norm = [1.0, 1.0] + [length**1.5 / n**2.5 for n in range(2, size)]
            basis = [Legendre.basis(n) * scale for n, scale in enumerate(norm)]
            x, w = np.polynomial.legendre.leggauss(size)
            curvature = np.array([p.deriv(2)(x) for p in basis]) * (2 / length) ** 2
            squares = [length * scale**2 / (2 * n + 1) for n, scale in enumerate(norm)]
            at = slice(start, start + size)
            self.matrix[at, at] = curvature * w @ curvature.T * length / 2
            self.mass[at, at] = np.diag(squares)
            for row, order in ((border, 1), (border + 1, 0)):
                jump = [side * p.deriv(order)(side) * (2 / length) ** order for p in basis]
                self.matrix[at, row] = self.matrix[row, at] = jump
        turn = 1 if sign == "printed" else -1
        springs = [(border, turn, rotational), (border + 1, -1, shear)]
        kept = [*range(border), *(row for row, _, k in springs if k > 0)]
        for row, direction, k in springs:
            self.matrix[row, row] = direction / k if k > 0 else 0.0
        self.matrix, self.mass = self.matrix[np.ix_(kept, kept)], self.mass[np.ix_(kept, kept)]

    def roots_below(self, wavenumber: float) -> int:
        matrix = self.matrix - wavenumber**4 * self.mass
        scale = 1 / np.sqrt(np.abs(matrix).max(axis=0))  # a congruence, which keeps the signs
        return int(np.count_nonzero(np.linalg.eigvalsh(matrix * scale * scale[:, None]) < 0)) - 4


def mass_and_stiffness(modes: JointModes) -> tuple[np.ndarray, np.ndarray]:
    """Gram matrices of deflection and of strain energy by Gauss quadrature."""
    points, weights = np.polynomial.legendre.leggauss(120)
    mass = stiffness = np.zeros((modes.wavenumbers.size,) * 2)
    for stage, length in ((0, modes.split), (1, 1 - modes.split)):
        x, w = (points + 1) * length / 2, (weights * length / 2)[:, None]
        shape, curvature = modes.evaluate(stage, x), modes.evaluate(stage, x, 2)
        mass = mass + shape.T @ (w * shape)
        stiffness = stiffness + curvature.T @ (w * curvature)
    rotational = modes.rotational_stiffness * (-1 if modes.sign == "printed" else 1)
    for k, derivative in ((rotational, 1), (modes.shear_stiffness, 0)):
        if math.isfinite(k):
            jump = modes.evaluate(1, 0.0, derivative)[0] - modes.evaluate(0, modes.split, derivative)[0]
            stiffness = stiffness + k * np.outer(jump, jump)
    return mass, stiffness


@pytest.mark.parametrize(
    ("sign", "expected"),
    [("printed", [4.7209, 7.8285, 10.9961, 13.9661]), ("natural", [4.7206, 7.8266, 10.9920, 13.9618])],
)
def test_wavenumbers_of_the_papers_second_figure(sign, expected):
    np.testing.assert_allclose(joint_modes(0.2, 3000, 3000, 4, sign).wavenumbers, expected, atol=5.1e-5)


@pytest.mark.parametrize("split", [0.05, 0.37, 0.5, UNIFORM[0] / UNIFORM[2]])
@pytest.mark.parametrize("sign", ["natural", "printed"])
def test_rigid_joint_gives_the_uniform_beam(split, sign):
    modes = joint_modes(split, INF, INF, 4, sign)
    np.testing.assert_allclose(modes.wavenumbers, UNIFORM, rtol=1e-14)
    assert not modes.jumps.any()


@pytest.mark.parametrize(
    ("split", "rotational", "shear", "omega"),
    [  # rotational joints, the hinge included
        (0.5, 0, INF, [61.6728229, 89.4931418, 199.859448]),
        (0.4, 0, INF, [51.1142228, 112.586228]),
        (0.3, 0, INF, [39.7090254, 110.839291]),
        (0.25, 0, INF, [35.3897324, 99.0913982]),
        (0.5, 1, INF, [11.81821231, 61.67282287, 95.75679336]),
        (0.5, 10, INF, [19.97949333, 61.67282287, 112.1218065]),
        (0.5, 100, INF, [22.0961309, 61.67282287, 119.749152]),
        (0.5, 1000, INF, [22.34512121, 61.67282287, 120.7843085]),
        (0.4, 1, INF, [12.40472897, 53.52177895, 114.6002063]),
        (0.4, 10, INF, [20.29339834, 59.11267743, 119.0092498]),
        (0.4, 100, INF, [22.1395416, 61.35186777, 120.6705937]),
        (0.3, 1, INF, [14.40297983, 44.29958857, 112.5608692]),
        (0.3, 10, INF, [21.09960322, 56.19689875, 117.7110313]),
        (0.25, 1, INF, [16.12189208, 41.58692343, 102.171032]),
        (0.25, 10, INF, [21.55529224, 56.21981836, 113.1576517]),
        (0.25, 100, INF, [22.29008085, 61.03958174]),
        # shear joints, slope continuous
        (0.5, INF, 10, [12.49869258, 22.37328545, 90.39640677]),
        (0.5, INF, 100, [22.37328545, 35.41373155, 99.1230029]),
        (0.5, INF, 1000, [22.37328545, 57.64933246, 120.9033917]),
        (0.25, INF, 10, [10.27851877, 35.92625198, 64.58245962]),
        (0.25, INF, 100, [19.83617605, 53.51500846, 69.37815897]),
        (0.25, INF, 1000, [22.11171906, 61.33911234, 116.3656159]),
    ],
)
def test_frequencies_of_single_springs(split, rotational, shear, omega):
    found = joint_modes(split, rotational, shear, len(omega)).wavenumbers ** 2
    np.testing.assert_allclose(found, omega, rtol=2e-9)  # the references carry nine or ten digits


def test_very_soft_hinge_folds_two_rigid_rods():
    # Mobilities of the ends of rods of unit mass per length: 4/l, 6/l^2 and 12/l^3.
    forward, aft, stiffness = 0.05, 0.95, 1e-13
    deflection, slope = 4 / forward + 4 / aft, 12 / forward**3 + 12 / aft**3
    coupling = 6 / forward**2 - 6 / aft**2
    expected = (stiffness * (slope - coupling**2 / deflection)) ** 0.25
    modes = joint_modes(forward, stiffness, INF, 1)
    np.testing.assert_allclose(modes.wavenumbers, expected, rtol=1e-12)  # they bend by 2.4 times the stiffness


def test_separate_stages_vibrate_on_their_own_even_at_equal_frequencies():
    modes = joint_modes(0.5, 0, 0, 6)
    np.testing.assert_allclose(modes.wavenumbers, np.repeat(2 * np.array(UNIFORM[:3]), 2), rtol=1e-14)
    np.testing.assert_allclose(mass_and_stiffness(modes)[0], np.eye(6), atol=1e-12)


@pytest.mark.parametrize("case", [*CASES, *random_cases(200)])
def test_no_root_is_lost_or_doubled(case):
    wavenumbers = joint_modes(*case[:3], 8, case[3]).wavenumbers
    beams = LegendreBeams(*case, highest=wavenumbers[-1])
    for index, wavenumber in enumerate(wavenumbers):
        assert beams.roots_below(wavenumber * (1 - 1e-11)) <= index
        assert beams.roots_below(wavenumber * (1 + 1e-11)) >= index + 1


@pytest.mark.parametrize("case", random_cases(5))
def test_no_root_is_lost_among_forty(case):
    wavenumbers = joint_modes(*case[:3], 40, case[3]).wavenumbers
    beams = LegendreBeams(*case, highest=wavenumbers[-1])
    for index in (9, 19, 29, 39):
        assert beams.roots_below(wavenumbers[index] * (1 - 1e-11)) <= index
        assert beams.roots_below(wavenumbers[index] * (1 + 1e-11)) >= index + 1


@pytest.mark.parametrize("count", [1, 8, 40])
@pytest.mark.parametrize("case", [*CASES, *random_cases(100)])
def test_modes_are_orthonormal_and_orthogonal_in_energy(case, count):
    modes = joint_modes(*case[:3], count, case[3])
    mass, stiffness = mass_and_stiffness(modes)
    omega = modes.wavenumbers**2
    np.testing.assert_allclose(mass, np.eye(count), atol=1e-9)
    np.testing.assert_allclose(stiffness / np.outer(omega, omega), np.eye(count), atol=1e-9)


@pytest.mark.parametrize("case", [*CASES, *random_cases(100)])
def test_modes_satisfy_equation_12(case):
    split, rotational, shear, sign = case
    modes = joint_modes(split, rotational, shear, 8, sign)
    scale = modes.wavenumbers
    tip = [modes.evaluate(0, split, d)[0] for d in range(4)]
    front = [modes.evaluate(1, 0.0, d)[0] for d in range(4)]
    for stage, x in ((0, 0.0), (1, 1 - split)):
        np.testing.assert_allclose(modes.evaluate(stage, x, 2)[0] / scale**2, 0, atol=1e-9)
        np.testing.assert_allclose(modes.evaluate(stage, x, 3)[0] / scale**3, 0, atol=1e-9)
    np.testing.assert_allclose((tip[2] - front[2]) / scale**2, 0, atol=1e-9)
    np.testing.assert_allclose((tip[3] - front[3]) / scale**3, 0, atol=1e-9)
    opening = (front[1] - tip[1]) * (1 if sign == "natural" else -1)
    for k, order, jump, load in ((rotational, 1, opening, tip[2]), (shear, 3, tip[0] - front[0], tip[3])):
        # load = k jump, divided by load + k so that soft and stiff springs are both judged in fair units
        soft = 1.0 if k == 0 else 0.0 if math.isinf(k) else 1 / (1 + k / scale**order)
        residual = load / scale**order * soft - jump * (1 - soft)
        np.testing.assert_allclose(residual / scale ** (3 - order if order == 1 else 0), 0, atol=1e-9)


def test_jumps_are_the_loads_over_the_stiffnesses():
    for sign, turn in (("natural", 1), ("printed", -1)):
        modes = joint_modes(0.3, 1e12, 1e11, 5, sign)
        slope, deflection = modes.jumps
        np.testing.assert_allclose(slope * 1e12 * turn, modes.evaluate(0, 0.3, 2)[0], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(deflection * -1e11, modes.evaluate(0, 0.3, 3)[0], rtol=1e-9, atol=1e-6)
        soft = joint_modes(0.3, 0.5, 2.0, 5, sign)
        for row, derivative in ((0, 1), (1, 0)):
            across = soft.evaluate(1, 0.0, derivative)[0] - soft.evaluate(0, 0.3, derivative)[0]
            np.testing.assert_allclose(soft.jumps[row], across, rtol=1e-9, atol=1e-11)


def test_coefficients_of_equation_10_give_the_same_shapes():
    modes = joint_modes(0.2, 3000, 3000, 4)
    for stage, length in ((0, 0.2), (1, 0.8)):
        x = np.linspace(0, length, 7)
        phase = x[:, None] * modes.wavenumbers
        functions = [np.sin(phase), np.cos(phase), np.sinh(phase), np.cosh(phase)]
        amplitudes = modes.paper_coefficients[:, 4 * stage : 4 * stage + 4].T
        shapes = sum(a * f for a, f in zip(amplitudes, functions, strict=True))
        # cosh(0.8 * 14) is 4e4, so cancellation costs five digits
        np.testing.assert_allclose(shapes, modes.evaluate(stage, x), atol=1e-10)


@pytest.mark.parametrize("sign", ["natural", "printed"])
def test_nose_deflects_to_the_positive_side(sign):
    assert np.all(joint_modes(0.6, 5000, 5000, 8, sign).evaluate(0, 0.0) > 0)


def test_mirrored_vehicle_has_the_same_frequencies():
    np.testing.assert_allclose(
        joint_modes(0.3, 20, 700, 8, "printed").wavenumbers,
        joint_modes(0.7, 20, 700, 8, "printed").wavenumbers,
        rtol=1e-14,
    )


def test_printed_sign_leaves_out_the_folding_mode():
    # A spring this soft hardly moves the higher frequencies, whichever its sign.
    natural = joint_modes(0.6, 1e-6, INF, 6).wavenumbers
    printed = joint_modes(0.6, 1e-6, INF, 5, "printed").wavenumbers
    assert natural[0] < 0.2
    np.testing.assert_allclose(printed, natural[1:], rtol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "path"),
    [
        ((1.0, 1, 1, 4), "split"),
        ((0.5, -1, 1, 4), "rotational_stiffness"),
        ((0.5, 1, math.nan, 4), "shear_stiffness"),
        ((0.5, 1, 1, 0), "count"),
        ((0.5, 1, 1, 4, "left"), "sign"),
    ],
)
def test_unusable_arguments_are_named(arguments, path):
    with pytest.raises(ModelError, match=f"^{path}: must"):
        joint_modes(*arguments)
