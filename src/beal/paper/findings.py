"""The three findings about the printed equations, each as numbers that a reader can check, computed anew."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy.linalg

from beal.discretisation import discretise
from beal.discretisation.basis import Combined
from beal.discretisation.build import Formulation
from beal.discretisation.joint_modes import joint_modes
from beal.discretisation.operators import Operators
from beal.paper import cases
from beal.paper.evidence import START, sampled
from beal.stability.critical import critical_thrust
from beal.stability.spectrum import spectrum
from beal.vehicle.catalog import tsto
from beal.vehicle.parts import ShearAxis

SIZES = (8, 16, 32, 64)
CURVE_SIZES = (4, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64)
ORDERS = (2, 3, 4, 5, 6, 7, 8, 9, 10)
SHEARED = ((0.8, 1e4, 1e4), (0.8, 200.0, 600.0), (0.6, 5000.0, 5000.0))
FOLDING = (0.6, 1.0, 1e4)
SLIDING = (0.6, 5000.0, 200.0)
SLIDING_THRUST = 50.0
AXES: tuple[ShearAxis, ...] = ("inertial", "mean", "forward", "aft")
ORDER = 14

Joint = tuple[float, float, float]


@dataclass(frozen=True)
class Sign:
    """Finding a: the sign of the rotational line of Eq. (12).

    Parameters
    ----------
    joint : (float, float, float)
    printed : list of float
        The lowest four lambda^4 from the printed boundary conditions.
    energy : list of float
        The lowest five lambda^4 from the energies with -k_r in place of k_r.
    right : list of float
        The lowest four lambda^4 with the right sign.
    loads : list of (int, float, float)
        Number of modes, critical thrust with the printed sign, with the right one.
    converged : float
        Critical thrust.
    """

    joint: Joint
    printed: Sequence[float]
    energy: Sequence[float]
    right: Sequence[float]
    loads: Sequence[tuple[int, float, float]]
    converged: float


@dataclass(frozen=True)
class Couple:
    """Finding c: one shear axis, with and without the rigid-body motions.

    Parameters
    ----------
    axis : str
    mu_without, mu_with : float
        Lowest elastic omega^2 of the sliding joint.
    load_without, load_with : float
        Critical thrust of (0.6, 5000, 5000).
    """

    axis: ShearAxis
    mu_without: float
    mu_with: float
    load_without: float
    load_with: float


@dataclass(frozen=True)
class Findings:
    """All numbers of the section on findings."""

    sign: Sign
    truncation: Mapping[Joint, tuple[Sequence[tuple[int, float]], Sequence[tuple[int, float]], float]]
    couple: Sequence[Couple]
    transposed_roots: float
    transposed_motion: float


def findings() -> Findings:
    """Compute all of them.

    Returns
    -------
    Findings
    """
    roots, motion = _transposition()
    return Findings(
        _sign(), {joint: _truncation(joint) for joint in SHEARED}, [_couple(a) for a in AXES], roots, motion
    )


def convergence_curves(found: Findings) -> dict[str, dict[str, list[tuple[int, float]]]]:
    """Relative errors over the number of unknowns, for the figure.

    Parameters
    ----------
    found : Findings

    Returns
    -------
    dict of case to dict of basis to list of (unknowns, error)
    """
    curves = {}
    for joint, (modes, polynomials, exact) in found.truncation.items():
        curves[cases.joint_text(joint)] = {
            "modes, right sign": [(n, abs(load / exact - 1)) for n, load in modes],
            "polynomials": [(n, abs(load / exact - 1)) for n, load in polynomials],
        }
    return curves


def _load(joint: Joint, formulation: Formulation, modes: int | None = None) -> float:
    return _thrust(critical_thrust(tsto(*joint), formulation=formulation, modes=modes).critical_thrust)


def _thrust(value: float | None) -> float:
    return np.nan if value is None else value


def _sign() -> Sign:
    split, rotational, shear = FOLDING
    operators = discretise(tsto(*FOLDING, shear_axis="inertial"), "converged", order=20)
    fold = operators.basis.jump(1, 1)
    negative = operators.K0 - 2 * rotational * np.outer(fold, fold)
    loads = [(n, _load(FOLDING, "as-printed", n), _load(FOLDING, "corrected-ritz", n)) for n in SIZES]
    return Sign(
        joint=FOLDING,
        printed=(joint_modes(split, rotational, shear, 4, "printed").wavenumbers ** 4).tolist(),
        energy=scipy.linalg.eigh(negative, operators.M, eigvals_only=True)[:5].tolist(),
        right=(joint_modes(split, rotational, shear, 4, "natural").wavenumbers ** 4).tolist(),
        loads=loads,
        converged=_load(FOLDING, "converged"),
    )


def _truncation(joint: Joint) -> tuple[list[tuple[int, float]], list[tuple[int, float]], float]:
    """Loads over the number of modes and over the number of polynomials, and the converged one."""
    modes = [(n, _load(joint, "corrected-ritz", n)) for n in CURVE_SIZES]
    polynomials = []
    for order in ORDERS:
        operators = discretise(tsto(*joint), "converged", order=order)
        polynomials.append((len(operators.M), _thrust(critical_thrust(operators).critical_thrust)))
    return modes, polynomials, _load(joint, "converged")


def _couple(axis: ShearAxis) -> Couple:
    sliding = discretise(tsto(*SLIDING, shear_axis=axis), order=ORDER)
    stiff = discretise(tsto(*cases.RESPONSE_JOINT, shear_axis=axis), order=ORDER)
    return Couple(
        axis,
        *(float(spectrum(o, SLIDING_THRUST, 1).W[0].real) for o in (_elastic(sliding), sliding)),
        *(_thrust(critical_thrust(o).critical_thrust) for o in (_elastic(stiff), stiff)),
    )


def _elastic(operators: Operators) -> Operators:
    """The same without the rigid-body motions."""
    kept = slice(operators.rigid, None)
    basis = Combined(operators.basis, np.eye(len(operators.M))[:, kept])
    M, K0, K1 = (matrix[kept, kept] for matrix in (operators.M, operators.K0, operators.K1))
    return replace(operators, M=M, K0=K0, K1=K1, rigid=0, basis=basis)


def _transposition() -> tuple[float, float]:
    """Largest relative change of the roots, and of a motion, when the follower term of Eq. (9) is taken as printed."""
    operators = discretise(tsto(*cases.RESPONSE_JOINT), "as-printed")
    tail, slope = (operators.shape(1.0, derivative)[0] for derivative in (0, 1))
    follower = np.outer(tail, slope)
    swapped = replace(operators, K1=operators.K1 - follower + follower.T)
    thrust = cases.RESPONSE_THRUSTS[13]
    roots = [np.sort(spectrum(o, thrust, 8).W.real) for o in (operators, swapped)]
    options: dict[str, Any] = {"step": 0.005, "initial": START}
    right, wrong = (sampled(o, 3.0, thrust, **options).displacement[0] for o in (operators, swapped))
    return float(abs(roots[1] / roots[0] - 1).max()), float(abs(wrong - right).max() / abs(right).max())
