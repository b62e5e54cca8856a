"""Solving one block of a study."""

import re
from collections import defaultdict
from collections.abc import Iterable

import numpy as np

from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.scan import DIVERGENCE, STABLE, UNDECIDED
from beal.stability.table import Spring
from beal.study.batch import WORTHWHILE, solve_springs
from beal.study.store import KINDS, STATUS, Arrays, Block, empty
from beal.study.study import Study

_SPRING = re.compile(r"joint\[(\d+)\]\.(rotational_stiffness|shear_stiffness)")
Index = tuple[int, ...]


def solve_block(study: Study, block: Block) -> Arrays:
    """Critical thrust and its evidence at every point of a block.

    Points that differ in joint springs only are solved together. A point that cannot be solved carries its status, not
    an exception: ``invalid`` where the model is refused there, ``not_converged`` where the numerics fail.
    """
    arrays = empty(tuple(part.stop - part.start for part in block))
    corner = tuple(part.start for part in block)
    for index, record in _solved(study, block):
        inside = tuple(i - start for i, start in zip(index, corner, strict=True))
        for name, value in record.items():
            arrays[name][inside] = value
    return arrays


def _solved(study: Study, block: Block) -> Iterable[tuple[Index, dict[str, float]]]:
    springs = {axis: spring for axis, path in enumerate(study.axes) if (spring := _spring(path))}
    groups: dict[Index, list[Index]] = defaultdict(list)
    for index in np.ndindex(tuple(part.stop - part.start for part in block)):
        point = tuple(part.start + i for part, i in zip(block, index, strict=True))
        groups[tuple(0 if axis in springs else i for axis, i in enumerate(point))].append(point)
    for common, points in groups.items():
        one_by_one = points
        if springs and len(points) >= WORTHWHILE:
            together, one_by_one = _together(study, common, springs, points)
            yield from together
        for point in one_by_one:
            yield point, _alone(study, point)


def _spring(path: str) -> Spring | None:
    match = _SPRING.fullmatch(path)
    if match is None:
        return None
    return int(match[1]), "rotational_stiffness" if match[2].startswith("r") else "shear_stiffness"


def _together(
    study: Study, common: Index, springs: dict[int, Spring], points: list[Index]
) -> tuple[list[tuple[Index, dict[str, float]]], list[Index]]:
    """Records of the points that the tables decide, and the points that they leave."""
    axes = list(study.axes.values())
    stiffnesses = np.array([[axes[axis][point[axis]] for axis in springs] for point in points])
    try:
        vehicle = study.at(common)
    except ModelError:
        return [], points
    if not np.all(stiffnesses >= 0):
        return [], points
    kind, values = solve_springs(vehicle, tuple(springs.values()), stiffnesses, study.solve)
    records = []
    for point, k, (thrust, mode, omega, error) in zip(points, kind, values, strict=True):
        if k == UNDECIDED:
            continue
        record: dict[str, float] = {"kind": int(k), "status": STATUS.index("solved")}
        if k != STABLE:
            record |= {"critical_thrust": thrust, "angular_frequency": omega, "error_estimate": error}
            record |= {"mode_low": mode, "mode_high": mode + (k != DIVERGENCE)}
        records.append((point, record))
    return records, [point for point, k in zip(points, kind, strict=True) if k == UNDECIDED]


def _alone(study: Study, point: Index) -> dict[str, float]:
    solve = study.solve
    try:
        result = critical_thrust(
            study.at(point),
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
