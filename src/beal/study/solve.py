"""Solving points of a study, together where they share a discretisation."""

import numpy as np
from numpy.typing import NDArray

from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.kernels.rules import DIVERGENCE, STABLE, UNDECIDED
from beal.stability.table import TANGENCY
from beal.study.batch import WORTHWHILE, solve_together
from beal.study.blocks import Block
from beal.study.study import Study
from beal.study.variables import KINDS, METHODS, STATUS, Arrays, empty

Values = NDArray[np.float64]


def solve_block(study: Study, block: Block) -> Arrays:
    """Critical thrust and its evidence at every point of a block of the grid."""
    axes = [np.array(axis)[part] for axis, part in zip(study.axes.values(), block, strict=True)]
    grid = np.meshgrid(*axes, indexing="ij")
    found = solve_points(study, np.stack([axis.ravel() for axis in grid], axis=1))
    return {name: values.reshape(grid[0].shape) for name, values in found.items()}


def solve_points(study: Study, values: Values) -> Arrays:
    """Critical thrust and its evidence at any points.

    Points that share tables, because they differ in joint springs or tangency only, are solved together. A point that
    cannot be solved carries its status, not an exception: ``invalid`` where the model is refused there,
    ``not_converged`` where the numerics fail.

    Parameters
    ----------
    study : Study
    values : ndarray, shape (points, axes)
        A value on each axis of the study, on its grid or not.

    Returns
    -------
    dict of str to ndarray, shape (points,)
        The variables of `beal.study.variables.VARIABLES`.
    """
    arrays = empty((len(values),))
    shared = {axis: path for axis, path in enumerate(study.axes) if study.tabulated(path)}
    others = [axis for axis in range(values.shape[1]) if axis not in shared]
    _, group = np.unique(values[:, others], axis=0, return_inverse=True)
    for points in np.split(np.argsort(group, kind="stable"), np.cumsum(np.bincount(group))[:-1]):
        left = points
        if shared and len(points) >= WORTHWHILE:
            left = points[_together(study, shared, values, points, arrays)]
        arrays["method"][left] = METHODS.index("single")
        for point in left:
            for name, value in _alone(study, values[point]).items():
                arrays[name][point] = value
    return arrays


def _together(
    study: Study, shared: dict[int, str], values: Values, points: NDArray[np.intp], arrays: Arrays
) -> NDArray[np.bool_]:
    """Fills in the points that the tables decide and says which they leave, shape (points,)."""
    axes = np.array(tuple(shared))
    parameters, common = values[points[:, None], axes], values[points[0]].copy()
    most = np.array([2.0 if path == TANGENCY else np.inf for path in shared.values()])
    common[axes] = np.where(most == 2.0, 1.0, np.inf)  # the tables are made for any value
    try:
        vehicle = study.at(common)
    except ModelError:
        return np.ones(len(points), dtype=bool)
    if not np.all((parameters >= 0) & (parameters <= most)):
        return np.ones(len(points), dtype=bool)
    found = solve_together(vehicle, tuple(shared.values()), parameters, study.solve)
    kind, mode = found.kind, found.mode
    decided, unstable = points[kind != UNDECIDED], (kind != UNDECIDED) & (kind != STABLE)
    arrays["kind"][decided] = kind[kind != UNDECIDED]
    arrays["border"][decided] = found.border[kind != UNDECIDED]
    arrays["method"][decided] = METHODS.index("tables")
    arrays["status"][decided] = STATUS.index("solved")
    columns = {
        "critical_thrust": found.thrust,
        "angular_frequency": np.sqrt(found.W),
        "error_estimate": found.error,
        "mode_low": mode,
        "mode_high": mode + (kind != DIVERGENCE),
    }
    for name, column in columns.items():
        arrays[name][points[unstable]] = column[unstable]
    return kind == UNDECIDED


def _alone(study: Study, values: Values) -> dict[str, float]:
    solve = study.solve
    try:
        result = critical_thrust(
            study.at(values),
            solve.max_thrust,
            solve.formulation,
            modes=solve.modes,
            tolerance=solve.tolerance,
        )
    except ModelError:
        return {"status": STATUS.index("invalid")}
    except ConvergenceError:
        return {"status": STATUS.index("not_converged")}
    return _record(result)


def _record(result: CriticalThrust) -> dict[str, float]:
    record: dict[str, float] = {"kind": KINDS.index(result.kind), "status": STATUS.index("solved")}
    if result.critical_thrust is not None and result.modes and result.angular_frequency is not None:
        record |= {
            "critical_thrust": result.critical_thrust,
            "mode_low": result.modes[0],
            "mode_high": result.modes[1],
            "angular_frequency": result.angular_frequency,
            "error_estimate": result.error_estimate or 0.0,
        }
    return record
