"""The integer lattice between the values of a grid: the places that refinement may solve, and its cells."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from beal.errors import ModelError

Integers = NDArray[np.int64]

ONE = 2**32  # steps of the lattice between neighbouring values of the grid
NARROWEST = 1e-9
AXES = 6  # a cell has 2**axes corners
DECADE = 10.0  # an axis of two values is logarithmic from this ratio on


@dataclass(frozen=True)
class Lattice:
    """Places between the values of a grid, in integers, so that equal places are equal exactly.

    Cells of level 0 are those of the grid. From level to level the axes along which cells are widest are halved first,
    then all, each until its cells are no wider than ``width``. Axes with one value have no cells along them.

    Parameters
    ----------
    axes : mapping of str to tuple of float
        Ascending values along each axis.
    width : float
        Widest cell of the last level, as a share of each axis' whole range, in the spacing of the axis.

    Raises
    ------
    ModelError
        If the width is not a share, or an axis has no order or no end.

    Examples
    --------
    >>> lattice = Lattice({"k": (1.0, 100.0, 10000.0), "s": (0.0, 1.0)}, width=0.3)
    >>> lattice.values(np.array([[ONE // 2, ONE // 2], [ONE, ONE]])).tolist()
    [[10.0, 0.5], [100.0, 1.0]]
    >>> (lattice.sizes / ONE).tolist()
    [[1.0, 1.0], [1.0, 0.5], [0.5, 0.25]]
    """

    axes: Mapping[str, tuple[float, ...]]
    width: float

    def __post_init__(self) -> None:
        problems = []
        if not NARROWEST <= self.width < 1:
            problems.append(
                ("refine", f"the width must lie between {NARROWEST} and 1, a share of each axis, found {self.width}")
            )
        for path, values in self.axes.items():
            if not all(math.isfinite(value) for value in values):
                problems.append((f"grid.{path}", "only finite values can be refined between, found an infinite one"))
            elif any(a >= b for a, b in zip(values, values[1:], strict=False)):
                problems.append((f"grid.{path}", "values must ascend without repetition to be refined between"))
        if not 1 <= len(self.free) <= AXES:
            problems.append(
                ("grid", f"between 1 and {AXES} axes of more than one value are refined, found {len(self.free)}")
            )
        if problems:
            raise ModelError(problems)

    @cached_property
    def free(self) -> tuple[str, ...]:
        """The axes along which there are cells."""
        return tuple(path for path, values in self.axes.items() if len(values) > 1)

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Values of the grid along each free axis."""
        return tuple(len(self.axes[path]) for path in self.free)

    @cached_property
    def spacing(self) -> dict[str, Literal["linear", "log"]]:
        """Of each axis: logarithmic where its values are more evenly spaced in their logarithm."""
        return {path: spacing_of(np.array(values)) for path, values in self.axes.items()}

    @cached_property
    def widest(self) -> NDArray[np.float64]:
        """Widest cell of the grid along each free axis, as a share of the axis."""
        return np.array([max(np.diff(self.share(path, np.array(self.axes[path])))) for path in self.free])

    @cached_property
    def sizes(self) -> Integers:
        """Steps of a cell along each free axis, shape (levels, free axes)."""
        halvings = np.maximum(np.ceil(np.log2(self.widest / self.width) - 1e-9), 0).astype(int)
        start = np.round(np.log2(self.widest.max() / self.widest)).astype(int)
        levels = np.arange(max(start + halvings) + 1)[:, None]
        return ONE >> np.clip(levels - start, 0, halvings).astype(np.int64)

    def reached(self, level: int) -> float:
        """Widest cell of a level along any axis, as a share of the axis."""
        return float(np.max(self.widest * self.sizes[level] / ONE))

    @cached_property
    def corners(self) -> Integers:
        """The corners of a cell in its sizes, opposite ones mirrored in order, shape (2**axes, axes)."""
        return np.array(list(product((0, 1), repeat=len(self.free))), dtype=np.int64)

    @property
    def nowhere(self) -> Integers:
        """No places, shape (0, free axes)."""
        return np.empty((0, len(self.shape)), dtype=np.int64)

    def grid_points(self) -> Integers:
        """The points of the grid, in its order, shape (points, free axes)."""
        return np.indices(self.shape, dtype=np.int64).reshape(len(self.shape), -1).T * ONE

    def grid_cells(self) -> Integers:
        """The low corners of the cells of the grid, shape (cells, free axes)."""
        shape = [points - 1 for points in self.shape]
        return np.indices(shape, dtype=np.int64).reshape(len(shape), -1).T * ONE

    def values(self, points: Integers) -> NDArray[np.float64]:
        """The value on every axis, free or not, at points of the lattice, shape (points, axes)."""
        found = np.empty((len(points), len(self.axes)))
        free = iter(points.T)
        for axis, (path, values) in enumerate(self.axes.items()):
            found[:, axis] = values[0] if len(values) == 1 else self._along(path, next(free))
        return found

    def _along(self, path: str, steps: Integers) -> NDArray[np.float64]:
        values = np.array(self.axes[path])
        cell, rest = np.divmod(steps, ONE)
        low, high, share = values[cell], values[np.minimum(cell + 1, len(values) - 1)], rest / ONE
        if self.spacing[path] == "log":
            return np.where(rest == 0, low, low * (high / low) ** share)
        return low + share * (high - low)

    def share(self, path: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where values lie along an axis, 0 at its low end and 1 at its high end, in its spacing."""
        spaced = np.log if self.spacing[path] == "log" else np.asarray
        low, high = spaced(np.array(self.axes[path])[[0, -1]])
        return np.asarray((spaced(values) - low) / (high - low))


class Index:
    """Finds places of a lattice again.

    Parameters
    ----------
    places : ndarray of int, shape (places, axes)
        None twice.

    Examples
    --------
    >>> Index(np.array([[0, 1], [5, 2]])).find(np.array([[5, 2], [2, 5]])).tolist()
    [1, -1]
    """

    def __init__(self, places: Integers) -> None:
        keys = _keys(places)
        self._order = np.argsort(keys)
        self._keys = keys[self._order]

    def find(self, places: Integers) -> NDArray[np.intp]:
        """Which of the places each is, -1 for none."""
        if not len(self._keys):
            return np.full(len(places), -1)
        keys = _keys(places)
        at = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        return np.where(self._keys[at] == keys, self._order[at], -1)


def distinct(places: Integers) -> Integers:
    """Each place once, in order of first appearance."""
    _, first = np.unique(_keys(places), return_index=True)
    return places[np.sort(first)]


def _keys(places: Integers) -> NDArray[np.bytes_]:
    """One sortable key for each place."""
    return np.ascontiguousarray(places, dtype=">i8").view(f"S{8 * places.shape[1]}").ravel()


def spacing_of(values: NDArray[np.float64]) -> Literal["linear", "log"]:
    """In which values are even, or nearer to it."""
    if not np.all((values > 0) & np.isfinite(values)) or len(values) < 2:
        return "linear"
    if len(values) == 2:
        return "log" if values[1] >= DECADE * values[0] else "linear"
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return "log" if np.ptp(ratios) * np.mean(steps) < np.ptp(steps) * np.mean(ratios) else "linear"
