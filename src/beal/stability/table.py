"""The characteristic function of many vehicles that share a discretisation, as one table.

With A(P, W) = K(P) - W M of the vehicle with every varying spring at its reference k_ref, E the rows that read those
springs' deformations times sqrt(k_ref), and G = E A^-1 E^T,

    D(k) = det(A) det(I + (k/k_ref - 1) G) / prod(1 + k/k_ref)

is linear in the softness s = 1/(1 + k/k_ref) of each spring, finite from a hinge (s = 1) to a rigid joint (s = 0). It
is linear in the tangency too, which adds a matrix of rank one to K1. Its values at the two ends of each such parameter
are entire functions of the thrust and of W = omega^2: Chebyshev polynomials on patches of W hold them to nearly the
precision of the machine relative to their size there, and a vehicle costs a few products instead of an eigenvalue
problem for every thrust.
"""

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy.linalg
from numpy.polynomial import chebyshev

from beal.discretisation import Formulation, discretise
from beal.discretisation.basis import DEFLECTION, ROTATION
from beal.discretisation.chain import beam_behind
from beal.discretisation.operators import Operators
from beal.stability.kernels import compiled_kernels
from beal.stability.limit import waves
from beal.stability.pencil import Array, pencil, reduced
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

TANGENCY = "thrust.tangency"
SPRING_PATH = re.compile(r"joint\[(\d+)\]\.(rotational_stiffness|shear_stiffness)")

MODES = 8  # of the vehicle with these joints rigid, which the range of W holds
THRUST_DEGREE, W_DEGREE = 15, 15  # of a patch
CROWDED = (1 / 16, 1 / 4)  # edges within the first patch where joints are soft, as shares of it in sqrt(omega)
CELLS = 12  # of the grid in each patch, on which the extrema of D are separated
INTERVALS = 9  # of thrust on a panel, the coarse steps of the search
LOWEST_ORDER, ORDERS_MORE, COARSER = 8, 8, 2  # of the discretisation: at least, for the longest segment, less
SHIFT = 1e-4  # as a share of the range of W


class Panel(NamedTuple):
    """D over a panel of thrusts and W from 0 to the last edge, as Chebyshev coefficients and as values on a grid.

    Parameters
    ----------
    thrusts : ndarray, shape (INTERVALS + 1,)
        In N, where the search looks first.
    W : ndarray, shape (grid,)
        Where the search separates the extrema of D.
    nodes : ndarray, shape (INTERVALS + 1, subsets, 4 grid)
        D, D_W, D_P and D_WP there, for each subset of parameters at their other end: the binary digits of its index.
    series : ndarray, shape (THRUST_DEGREE + 1, subsets, 4 grid)
        The same, as Chebyshev coefficients in thrust.
    edges : ndarray, shape (patches + 1,)
        Of the patches of W.
    patches, coarser : ndarray, shape (patches, subsets, (THRUST_DEGREE + 1) (W_DEGREE + 1))
        Chebyshev coefficients of D in thrust and W, in two discretisations, whose difference is the error estimate.
    degree : int
        THRUST_DEGREE.
    """

    thrusts: Array
    W: Array
    nodes: Array
    series: Array
    edges: Array
    patches: Array
    coarser: Array
    degree: int


def tabulated(vehicle: Vehicle, path: str) -> bool:
    """Whether vehicles that differ from this one in a quantity share a table.

    The tangency of a free-free vehicle is none: below 1 it tumbles, and a rigid-body root would spoil the table.
    """
    if path == TANGENCY:
        return not vehicle.free_free
    return SPRING_PATH.fullmatch(path) is not None


def reference(vehicle: Vehicle, path: str) -> float:
    """k_ref of a spring: the stiffness of the stage behind the joint against the same motion."""
    return beam_behind(vehicle, *_spring(path))


def weights(vehicle: Vehicle, paths: Sequence[str], values: Array) -> Array:
    """Factors of the subsets for vehicles with given values of the parameters, shape (vehicles, subsets)."""
    factors = np.ones((len(values), 1))
    for path, value in zip(paths, values.T, strict=True):
        first = 1 - value if path == TANGENCY else 1 / (1 + value / reference(vehicle, path))
        factors = np.hstack((factors * first[:, None], factors * (1 - first[:, None])))
    return factors


def panel(
    vehicle: Vehicle, paths: Sequence[str], formulation: Formulation, ends: tuple[float, float], soft: bool
) -> Panel | None:
    """Tables of a vehicle over a panel of thrusts.

    Parameters
    ----------
    vehicle : Vehicle
    paths : sequence of str
        Of the parameters that will vary, see `tabulated`; their values in ``vehicle`` do not matter.
    formulation : {"objective", "converged"}
    ends : (low, high)
        In N.
    soft : bool
        Whether joints may be much softer than the stages: the patches then crowd towards W = 0.

    Returns
    -------
    Panel or None
        None where a rigid-body root would spoil it.
    """
    order = _order(vehicle)
    springs = [path for path in paths if path != TANGENCY]
    rigid = with_values(vehicle, dict.fromkeys(springs, math.inf))
    roots = reduced(pencil(discretise(rigid, formulation, order=order))).roots(0.0).real
    shares = np.arange(MODES + 1) / MODES
    if soft:
        shares = np.concatenate(([0.0], shares[1] * np.array(CROWDED), shares[1:]))
    edges = shares**4 * math.sqrt(roots[MODES - 1] * roots[MODES])
    choices = [{**dict.fromkeys(springs, 0.0), **tangency} for tangency in _tangencies(paths)]
    tables = []
    for n in (order, order - COARSER):
        halves = []
        for choice in choices:
            operators = discretise(with_values(vehicle, choice), formulation, order=n)
            if pencil(operators).rigid or reduced(pencil(operators)).held:
                return None
            halves.append(_patches(operators, springs, ends, edges))
        tables.append(_in_order(np.concatenate(halves, axis=1), paths))
    thrusts = np.linspace(*ends, INTERVALS + 1)
    x = 2 * (thrusts - ends[0]) / (ends[1] - ends[0]) - 1
    series = _series(tables[0], ends, edges)
    nodes = np.tensordot(chebyshev.chebvander(x, THRUST_DEGREE), series, 1)
    patches, coarser = (table.reshape(*table.shape[:2], -1) for table in tables)
    return Panel(thrusts, _grid(edges), nodes, series, edges, patches, coarser, THRUST_DEGREE)


def _spring(path: str) -> tuple[int, int]:
    """Number of the joint and what jumps there."""
    match = SPRING_PATH.fullmatch(path)
    if match is None:
        raise ValueError(f"{path} is not a spring of a joint")
    return int(match[1]), ROTATION if match[2] == "rotational_stiffness" else DEFLECTION


def _tangencies(paths: Sequence[str]) -> list[dict[str, float]]:
    return [{TANGENCY: 0.0}, {TANGENCY: 1.0}] if TANGENCY in paths else [{}]


def _in_order(table: Array, paths: Sequence[str]) -> Array:
    """Subsets of the springs and then the tangency, brought to the order of the paths."""
    count = len(paths)
    if TANGENCY not in paths:
        return np.ascontiguousarray(table)
    place = [path for path in paths if path != TANGENCY] + [TANGENCY]
    digits = table.reshape(len(table), *[2] * count, *table.shape[2:])  # the last parameter's digit first
    axes = [1 + count - 1 - place.index(path) for path in reversed(paths)]
    return np.ascontiguousarray(np.transpose(digits, (0, *axes, count + 1, count + 2))).reshape(table.shape)


def _order(vehicle: Vehicle) -> int:
    """Order of the finer discretisation, from the share of the half waves that fall on the longest segment."""
    phases = waves(vehicle)
    return math.ceil(LOWEST_ORDER + ORDERS_MORE * float(phases.max() / phases.sum()) - 1e-9)


def _patches(operators: Operators, springs: Sequence[str], ends: tuple[float, float], edges: Array) -> Array:
    """Chebyshev coefficients, shape (patches, 2**springs, THRUST_DEGREE + 1, W_DEGREE + 1)."""
    full, basis, vehicle = pencil(operators), operators.basis, operators.vehicle
    fronts = {segment.stage: index for index, segment in reversed(list(enumerate(basis.segments)))}
    rows = np.empty((len(full.M), len(springs)))
    for column, path in enumerate(springs):
        joint, reading = _spring(path)
        jump = basis.jump(fronts[joint + 1], reading)[operators.rigid :]
        rows[:, column] = jump * math.sqrt(reference(vehicle, path))
    x_P, x_W = (np.cos(np.pi * (np.arange(n + 1) + 0.5) / (n + 1)) for n in (THRUST_DEGREE, W_DEGREE))
    thrusts = ends[0] + (ends[1] - ends[0]) * (1 + x_P) / 2
    W = edges[:-1, None] + np.diff(edges)[:, None] * (1 + x_W) / 2
    values = characteristic(full.stiffness(0.0) + rows @ rows.T, full.K1, full.M, rows, thrusts, W.ravel())
    to_P, to_W = (np.linalg.inv(chebyshev.chebvander(x, len(x) - 1)) for x in (x_P, x_W))
    return np.einsum("pi,wj,siqj->qspw", to_P, to_W, values.reshape(-1, len(thrusts), *W.shape), optimize=True)


def characteristic(K0: Array, K1: Array, M: Array, springs: Array, thrusts: Array, W: Array) -> Array:
    """D of the vehicles with springs free or rigid, shape (2**springs, thrusts, W).

    For each thrust, B = K(P) + shift M and F = B^-1 M make A = B (I - s F) with s = W + shift; once F is upper
    Hessenberg, each W costs n^2 operations.

    Parameters
    ----------
    K0, K1, M : ndarray, shape (n, n)
        With the springs at their references in K0.
    springs : ndarray, shape (n, springs)
        The columns of E^T.
    thrusts, W : ndarray
    """
    values = np.empty((2 ** springs.shape[1], len(thrusts), len(W)))
    shift = SHIFT * W.max()
    for i, thrust in enumerate(thrusts):
        B = K0 + thrust * K1 + shift * M
        solved = np.linalg.solve(B, np.hstack((M, springs)))
        H, Q = (
            np.asarray(part, dtype=np.float64) for part in scipy.linalg.hessenberg(solved[:, : len(M)], calc_q=True)
        )
        left, right = (np.ascontiguousarray(Q.T @ side, dtype=np.float64) for side in (springs, solved[:, len(M) :]))
        values[:, i] = np.linalg.det(B) * _determinants(H, left, right, W + shift)
    return values


def _determinants(H: Array, left: Array, right: Array, s: Array) -> Array:
    """det(I - s H) times det of rows of G where a spring is rigid, of I - G where it is free, shape (2**springs, k).

    G = left^T (I - s H)^-1 right.
    """
    if compiled_kernels():
        from beal.stability.kernels.table_compiled import determinants

        return determinants(H, left, right, s)
    A, count = np.eye(len(H)) - s[:, None, None] * H, right.shape[1]
    G = left.T @ np.linalg.solve(A, np.broadcast_to(right, (len(s), *right.shape)))
    rigid = np.arange(2**count)[:, None] >> np.arange(count) & 1
    mixed = np.where(rigid[:, None, :, None] == 1, G, np.eye(count) - G)
    return np.linalg.det(A) * np.linalg.det(mixed)


def _grid(edges: Array) -> Array:
    """Values of W on which the search looks, evenly spaced in sqrt(omega) on each patch."""
    roots = edges**0.25
    cells = np.arange(CELLS) / CELLS
    return np.append((roots[:-1, None] + np.diff(roots)[:, None] * cells).ravel(), roots[-1]) ** 4


def _series(patches: Array, ends: tuple[float, float], edges: Array) -> Array:
    """Chebyshev coefficients in thrust of D, D_W, D_P and D_WP on the grid, shape (degree + 1, subsets, 4 grid)."""
    W = _grid(edges)
    patch = np.minimum(np.arange(len(W)) // CELLS, len(edges) - 2)
    width = np.diff(edges)[patch]
    y = 2 * (W - edges[patch]) / width - 1
    value = chebyshev.chebvander(y, W_DEGREE)
    slope = chebyshev.chebvander(y, W_DEGREE - 1) @ chebyshev.chebder(np.eye(W_DEGREE + 1)) * (2 / width)[:, None]
    D, D_W = (np.einsum("gspw,gw->psg", patches[patch], rows, optimize=True) for rows in (value, slope))
    lines = np.concatenate((D, D_W), axis=2)
    in_thrust = np.zeros_like(lines)
    in_thrust[:-1] = chebyshev.chebder(lines) * 2 / (ends[1] - ends[0])
    return np.concatenate((lines, in_thrust), axis=2)
