"""Contour lines of a function that can be evaluated anywhere: found on a grid, and as exact as wanted between."""

from collections.abc import Callable

import numpy as np

from beal.stability.pencil import Array

STEPS = 14  # of the regula falsi


class Contour:
    """The curve in a plane on which a function vanishes.

    Parameters
    ----------
    left : callable
        Values, shape (n,), at points of shape (n, 2).
    """

    def __init__(self, left: Callable[[Array], Array]) -> None:
        self.left = left

    def middle(self, here: Array, there: Array) -> Array:
        """Where the contour crosses the line midway between two of its points and square to their connection."""
        step = (there - here) / 2
        unit = np.maximum(np.abs(step).max(axis=0), np.finfo(float).tiny)
        across = np.stack((-step[:, 1] / unit[1], step[:, 0] / unit[0]), axis=1) * unit
        low, high = here + step - across, here + step + across
        met = np.sign(self.left(low)) != np.sign(self.left(high))
        return np.where(met[:, None], self._root(low, high), here + step)

    def _root(self, low: Array, high: Array) -> Array:
        """Between two points of opposite sign, by the Illinois form of the regula falsi."""
        f_low, f_high = self.left(low), self.left(high)
        for _ in range(STEPS):
            with np.errstate(divide="ignore", invalid="ignore"):
                share = f_low / (f_low - f_high)
            share = np.where(np.isfinite(share), np.clip(share, 0.0, 1.0), 0.5)[:, None]
            middle = low + share * (high - low)
            f = self.left(middle)
            same = np.sign(f) == np.sign(f_low)
            f_low, f_high = np.where(same, f, f_low / 2), np.where(same, f_high / 2, f)
            low, high = np.where(same[:, None], middle, low), np.where(same[:, None], high, middle)
        return middle

    def lines(self, across: Array, up: Array) -> list[Array]:
        """Contour lines by marching squares, each of shape (n, 2)."""
        grid = np.stack(np.meshgrid(across, up, indexing="ij"), axis=-1)
        above = (self.left(grid.reshape(-1, 2)) > 0).reshape(grid.shape[:2])
        corner = np.arange(above.size).reshape(above.shape)
        pairs = [(corner[:-1], corner[1:]), (corner[:, :-1], corner[:, 1:])]
        ends = np.concatenate([np.stack(pair, axis=-1).reshape(-1, 2) for pair in pairs])
        ends = ends[above.ravel()[ends[:, 0]] != above.ravel()[ends[:, 1]]]
        flat = grid.reshape(-1, 2)
        places = self._root(flat[ends[:, 0]], flat[ends[:, 1]])
        number = {(int(a), int(b)): n for n, (a, b) in enumerate(ends)}
        neighbours: list[list[int]] = [[] for _ in places]
        parted = above[:-1, :-1] + above[1:, :-1].astype(int) + above[:-1, 1:] + above[1:, 1:]
        for i, j in np.argwhere((parted > 0) & (parted < 4)):
            a, b, c, d = (int(corner[i + p, j + q]) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)))
            sides = [number[side] for side in ((a, b), (b, c), (d, c), (a, d)) if side in number]
            for one, other in zip(sides[::2], sides[1::2], strict=True):
                neighbours[one].append(other)
                neighbours[other].append(one)
        return [places[line] for line in _chains(neighbours)]


def _chains(neighbours: list[list[int]]) -> list[list[int]]:
    """Paths through a graph whose nodes have two neighbours at most, open ones first."""
    left = set(range(len(neighbours)))
    found = []
    for start in sorted(left, key=lambda node: len(neighbours[node])):
        if start not in left:
            continue
        left.remove(start)
        chain = [start]
        while onward := [node for node in neighbours[chain[-1]] if node in left]:
            chain.append(onward[0])
            left.remove(onward[0])
        if len(neighbours[start]) == 2:  # closed
            chain.append(start)
        found.append(chain)
    return found
