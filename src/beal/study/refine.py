"""Adaptive refinement of a map: the cells that a border crosses are halved until they are narrow.

A border is where what comes first changes: the kind of instability, its pair of modes, stable or not, solved or not;
or where the critical thrust jumps though the names stay the same. Every cell is judged by its corners and its centre,
and a cell that is left whole also by the points that its halved neighbours put on its faces, so that a border that
enters a cell through the middle of a face is followed. What is missed is a region that lies between these points
everywhere: an island in a cell that reaches neither its corners nor its centre, or a tongue as thin as that all along.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.study.lattice import Index, Integers, Lattice, distinct
from beal.study.variables import Arrays

Indices = NDArray[np.intp]
Booleans = NDArray[np.bool_]
Solver = Callable[[Integers], Arrays]

JUMP = 0.02  # relative change of the critical thrust from one side of a cell to the other that is a border in itself
LIMIT = 2_000_000  # points of the grid and of its refinement
LABELS = ("status", "kind", "mode_low", "mode_high")


@dataclass(frozen=True)
class Refined:
    """What refinement adds to a grid.

    Parameters
    ----------
    places : ndarray of int, shape (points, axes)
        Points off the grid, on the lattice, in the order in which they were asked for.
    arrays : dict of str to ndarray, shape (points,)
        What was found there.
    low, high : ndarray of int, shape (cells, axes)
        Corners of the cells on borders, all of the last level.
    sides : dict of str to ndarray, shape (cells, 2)
        What was found at the low corner of each cell, and at that point of it which is across the border.
    """

    places: Integers
    arrays: Arrays
    low: Integers
    high: Integers
    sides: Arrays


@dataclass(frozen=True)
class _Cells:
    """Cells by level and low corner, shapes (cells,) and (cells, axes)."""

    level: Integers
    low: Integers

    def __getitem__(self, chosen: Any) -> "_Cells":
        return _Cells(self.level[chosen], self.low[chosen])

    def __add__(self, others: "_Cells") -> "_Cells":
        return _Cells(np.concatenate((self.level, others.level)), np.concatenate((self.low, others.low)))


class _Points:
    """What is known where: places, the region each lies in, and the logarithm of the critical thrust there."""

    def __init__(self, places: Integers, arrays: Arrays) -> None:
        self.places, self.arrays = places, arrays
        self.find = Index(places).find
        labels = np.stack([np.asarray(arrays[name], dtype=np.int64) for name in LABELS])
        self.region = np.ravel_multi_index(tuple(labels), (256,) * len(LABELS))
        with np.errstate(divide="ignore"):
            self.height = np.log(arrays["critical_thrust"])

    def joined(self, places: Integers, arrays: Arrays) -> "_Points":
        """These and more."""
        joined = {name: np.concatenate((values, arrays[name])) for name, values in self.arrays.items()}
        return _Points(np.concatenate((self.places, places)), joined)


def refine(lattice: Lattice, grid: Arrays, solve: Solver, limit: int = LIMIT) -> Refined:
    """Resolves the borders of a map to the width of a lattice.

    Parameters
    ----------
    lattice : Lattice
        With at least one free axis.
    grid : dict of str to ndarray
        What was found at the points of the grid.
    solve : callable
        Finds the same at other places of the lattice, shape (places, axes).
    limit : int
        Number of points, those of the grid included.

    Returns
    -------
    Refined

    Raises
    ------
    ModelError
        If more points than the limit are needed.
    """
    given, low = lattice.grid_points(), lattice.grid_cells()
    points = _Points(given, {name: np.ravel(values) for name, values in grid.items()})
    todo = _Cells(np.zeros(len(low), dtype=np.int64), low)
    whole = border = todo[:0]
    while len(todo.level):
        before = len(points.places)
        points = _solved(lattice, points, todo, _corners(lattice, todo).reshape(-1, low.shape[1]), solve, limit)
        alike = todo[_alike(lattice, points, todo)]
        points = _solved(lattice, points, todo, _centres(lattice, alike), solve, limit)
        torn, last = _torn(lattice, points, todo), todo.level == len(lattice.sizes) - 1
        border = border + todo[torn & last]
        new = todo[~torn]
        old_crossed = _crossed(lattice, points, points.places[before:], whole)
        new_crossed = _crossed(lattice, points, points.places, new)
        todo = _halves(lattice, todo[torn & ~last] + whole[old_crossed] + new[new_crossed])
        whole = whole[~old_crossed] + new[~new_crossed]
    found = slice(len(given), None)
    across = _sides(lattice, points, border)
    return Refined(
        points.places[found],
        {name: values[found] for name, values in points.arrays.items()},
        border.low,
        border.low + lattice.sizes[border.level],
        {name: values[across] for name, values in points.arrays.items()},
    )


def _corners(lattice: Lattice, cells: _Cells) -> Integers:
    """Shape (cells, corners, axes)."""
    return cells.low[:, None] + lattice.corners * lattice.sizes[cells.level][:, None]


def _centres(lattice: Lattice, cells: _Cells) -> Integers:
    return cells.low + lattice.sizes[cells.level] // 2


def _at_corners(lattice: Lattice, points: _Points, cells: _Cells) -> Indices:
    """Which points are the corners, shape (cells, corners)."""
    corners = _corners(lattice, cells)
    return points.find(corners.reshape(-1, corners.shape[2])).reshape(corners.shape[:2])


def _alike(lattice: Lattice, points: _Points, cells: _Cells) -> Booleans:
    """Whether all corners of a cell lie in the same region."""
    region = points.region[_at_corners(lattice, points, cells)]
    return np.asarray(np.all(region == region[:, :1], axis=1))


def _solved(lattice: Lattice, points: _Points, cells: _Cells, places: Integers, solve: Solver, limit: int) -> _Points:
    """The points with those at places, which the cells need."""
    missing = distinct(places[points.find(places) < 0])
    if not len(missing):
        return points
    if len(points.places) + len(missing) > limit:
        reached = lattice.reached(max(int(cells.level.min()) - 1, 0))
        raise ModelError(
            f"refine: needs more than {limit} points; the first {len(points.places)} resolved every border to "
            f"{reached:.3g} of the axes, asked for {lattice.width:g}; give a larger width, or fewer axes"
        )
    return points.joined(missing, solve(missing))


def _torn(lattice: Lattice, points: _Points, cells: _Cells) -> Booleans:
    """Whether the corners and the centre of a cell tell of a border in it.

    A jump that parts them parts the ends of a diagonal, or both ends from the centre: the mean of the ends is then off
    what is found at the centre by half the jump at least, and a smooth thrust is off by its curvature alone.
    """
    at, centre = _at_corners(lattice, points, cells), points.find(_centres(lattice, cells))
    region, height = points.region[at], points.height[at]
    with np.errstate(invalid="ignore"):
        off = np.abs((height + height[:, ::-1]) / 2 - points.height[centre][:, None]) > JUMP / 2
    parted = np.any(region != region[:, :1], axis=1)  # then the centre may be unknown
    return np.asarray(parted | (points.region[centre] != region[:, 0]) | np.any(off, axis=1))


def _halves(lattice: Lattice, cells: _Cells) -> _Cells:
    """The cells of the next level that make up these."""
    made = cells[:0]
    for level in np.unique(cells.level):
        low, size = cells.low[cells.level == level], lattice.sizes[level + 1]
        parts = lattice.corners[np.all(lattice.corners <= (size < lattice.sizes[level]), axis=1)]
        parted = (low[:, None] + parts * size).reshape(-1, low.shape[1])
        made = made + _Cells(np.full(len(parted), level + 1), parted)
    return made


def _crossed(lattice: Lattice, points: _Points, places: Integers, cells: _Cells) -> Booleans:
    """Which cells disagree with a point on their faces."""
    crossed = np.zeros(len(cells.level), dtype=bool)
    for level in np.unique(cells.level):
        members, size = np.flatnonzero(cells.level == level), lattice.sizes[level]
        index = Index(cells.low[members])
        finer = places[np.any(places % size != 0, axis=1)]  # the others are corners
        for side in product((0, 1), repeat=finer.shape[1]):  # a face belongs to the cells on both its sides
            low = (finer - side) // size * size
            found = index.find(low)
            here = found >= 0
            cell, point = members[found[here]], points.find(finer[here])
            at = _at_corners(lattice, points, cells[cell])
            share = ((finer - low)[here] / size)[:, None]
            weight = np.prod(np.where(lattice.corners == 1, share, 1 - share), axis=2)
            with np.errstate(invalid="ignore"):
                off = np.abs(np.sum(weight * points.height[at], axis=1) - points.height[point]) > JUMP / 2
            crossed[cell[off | (points.region[point] != points.region[at[:, 0]])]] = True
    return crossed


def _sides(lattice: Lattice, points: _Points, cells: _Cells) -> Indices:
    """The low corner and the first point in another region, else that farthest in thrust, shape (cells, 2)."""
    at, centre = _at_corners(lattice, points, cells), points.find(_centres(lattice, cells))
    at = np.column_stack((at, np.where(centre < 0, at[:, 0], centre)))
    with np.errstate(invalid="ignore"):
        far = np.nan_to_num(np.abs(points.height[at] - points.height[at[:, :1]]))
    far[points.region[at] != points.region[at[:, :1]]] = np.inf
    return np.column_stack((at[:, 0], np.take_along_axis(at, np.argmax(far, axis=1)[:, None], 1)[:, 0]))
