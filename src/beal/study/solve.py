"""Solving one block of a study."""

import numpy as np

from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.study.store import KINDS, STATUS, Arrays, Block, empty
from beal.study.study import Study


def solve_block(study: Study, block: Block) -> Arrays:
    """Critical thrust and its evidence at every point of a block.

    A point that cannot be solved carries its status, not an exception: ``invalid`` where the model is refused there,
    ``not_converged`` where the numerics fail.
    """
    shape = tuple(part.stop - part.start for part in block)
    arrays = empty(shape)
    for inside in np.ndindex(shape):
        index = tuple(part.start + i for part, i in zip(block, inside, strict=True))
        for name, value in _point(study, index).items():
            arrays[name][inside] = value
    return arrays


def _point(study: Study, index: tuple[int, ...]) -> dict[str, float]:
    solve = study.solve
    try:
        vehicle = study.at(index)
        result = critical_thrust(
            vehicle,
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
