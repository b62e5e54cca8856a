"""Blocks of a grid: what is solved, written and lost or kept together.

Blocks depend on the study alone, never on the machine, so that a run that is resumed elsewhere has the same ones.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.build import RITZ
from beal.study.study import Study

Block = tuple[slice, ...]

ALONE, TOGETHER, TABLES = 8e-3, 5e-6, 0.03  # seconds: of one point by itself, of one with tables, of making the tables
DAMPED = 0.06  # seconds of one damped point, always by itself
SHORT, LONG = 0.2, 1.0  # seconds of a block; writing it takes some 0.01
ENOUGH, MOST = 64, 50_000  # blocks to share among workers, and files of a variable that a folder bears


@dataclass(frozen=True)
class Blocks:
    """A grid cut into blocks of one size, smaller ones at the ends.

    Parameters
    ----------
    shape : tuple of int
        Points along each axis.
    sizes : tuple of int
        Points of a block along each axis.

    Examples
    --------
    >>> blocks = Blocks((3, 4), (2, 4))
    >>> len(blocks), blocks[1], blocks.points
    (2, (slice(2, 3, None), slice(0, 4, None)), array([8, 4]))
    """

    shape: tuple[int, ...]
    sizes: tuple[int, ...]

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Blocks along each axis."""
        return tuple(-(-points // size) for points, size in zip(self.shape, self.sizes, strict=True))

    def __len__(self) -> int:
        return math.prod(self.counts)

    def __getitem__(self, index: int) -> Block:
        corner = np.unravel_index(index, self.counts)
        starts = [int(n) * size for n, size in zip(corner, self.sizes, strict=True)]
        return tuple(slice(a, min(a + b, n)) for a, b, n in zip(starts, self.sizes, self.shape, strict=True))

    @cached_property
    def points(self) -> NDArray[np.int64]:
        """Number of points of each block, shape (blocks,)."""
        sides = (np.diff([*range(0, n, size), n]) for n, size in zip(self.shape, self.sizes, strict=True))
        return np.array([math.prod(side) for side in product(*(side.tolist() for side in sides))])


def together(study: Study) -> bool:
    """Whether enough points share a table for it to pay."""
    if study.solve.formulation in RITZ or _damped(study):
        return False
    return TABLES + _sharing(study) * TOGETHER < _sharing(study) * ALONE


def seconds(study: Study) -> float:
    """Estimated time to solve all points on one core."""
    return math.prod(study.shape) / _sharing(study) * _row(study)


def blocks(study: Study) -> Blocks:
    """Blocks of a study's grid, of about one cost.

    They extend along the axes first whose points share tables, those of joint springs, then along the last axes.

    Parameters
    ----------
    study : Study

    Returns
    -------
    Blocks
    """
    target = min(max(seconds(study) / ENOUGH, SHORT), LONG)
    target = max(target, seconds(study) / MOST)
    rows, sharing = target / _row(study), _sharing(study)
    room = rows * sharing if rows >= 1 else min(sharing, target / (TOGETHER if together(study) else _alone(study)))
    sizes = [1] * len(study.shape)
    shared = [study.tabulated(path) for path in study.axes]
    order = sorted(range(len(sizes)), key=lambda axis: (shared[axis], axis), reverse=True)
    for axis in order:
        fits = max(1, int(room / math.prod(sizes)))
        parts = math.ceil(study.shape[axis] / fits)
        sizes[axis] = math.ceil(study.shape[axis] / parts)
        if parts > 1:
            break
    return Blocks(study.shape, tuple(sizes))


def _sharing(study: Study) -> int:
    """Points that share a table."""
    return math.prod(n for path, n in zip(study.axes, study.shape, strict=True) if study.tabulated(path))


def _row(study: Study) -> float:
    """Seconds for all points that share a table."""
    return TABLES + _sharing(study) * TOGETHER if together(study) else _sharing(study) * _alone(study)


def _alone(study: Study) -> float:
    """Seconds of a point by itself."""
    return DAMPED if _damped(study) else ALONE


def _damped(study: Study) -> bool:
    """Whether some of the vehicles are damped."""
    return study.vehicle.damped or any(path.endswith("damping") for path in study.axes)
