"""Segments along which properties vary: where they are integrated, and shapes that suit them.

The bending moment is smooth where the stiffness has kinks and steps, the curvature is not. On such segments the shapes
are therefore those whose bending moments are polynomials, phi'' = P_k(x)/EI(x), made orthonormal in energy; of uniform
stiffness they are the Legendre polynomials of the curvature.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from beal.discretisation.basis import Array, Segment
from beal.discretisation.polynomials import gauss, integrals
from beal.vehicle.parts import Stage
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle

RATIO = 2.0  # of the stiffness at the ends of a piece, at most
DIGITS = 14.0 * math.log(10.0)
FEW_POINTS = 48  # come again for every piece, as Gauss points and ends do
SMOOTH = 5  # Gauss points that a piece takes beyond the half waves that a polynomial may have on it


class Pieces:
    """A segment cut where the slope of a property changes, and the Gauss points of the pieces.

    Parameters
    ----------
    stage : Stage
    start, length : float
        Of the segment, start from the stage's front, in m.
    order : int
        Degree of the curvature or bending moment.
    """

    def __init__(self, stage: Stage, start: float, length: float, order: int) -> None:
        stations = np.concatenate([table.arrays.x for table in stage.tables.values()])
        end = start + length
        margin = 1e-9 * length
        inner = np.unique(stations[(stations > start + margin) & (stations < end - margin)])
        edges = np.concatenate(([start], inner, [end]))
        self.edges = _cut_by_ratio(edges, stage.bending_stiffness) - start
        self.edges[-1] = length
        self.widths = np.diff(self.edges)
        self.length = length
        t, weight = gauss(self._points(stage, order, start))
        self.t, self.weight = t, weight
        self._local = self.edges[:-1, None] + self.widths[:, None] * (1 + t) / 2

    def _points(self, stage: Stage, order: int, start: float) -> int:
        widest = float(self.widths.max()) / self.length
        half_waves = order * math.acos(1 - 2 * min(widest, 1.0)) / math.pi  # of a polynomial, at its ends
        points = min(order + 3, math.ceil(half_waves * math.pi / 2) + SMOOTH) + 1
        if not isinstance(stage.bending_stiffness, StationTable):
            return points
        inside = start + self.edges[:-1, None] + self.widths[:, None] * np.array([1e-6, 1 - 1e-6])
        stiffness = stage.bending_stiffness.at(inside)
        ratio = max(1 + 1e-9, float((stiffness.max(axis=1) / stiffness.min(axis=1)).max()))
        pole = (ratio + 1) / (ratio - 1)  # of 1/EI, in half widths of the piece
        return points + math.ceil(DIGITS / 2 / math.log(pole + math.sqrt(pole**2 - 1)))

    @property
    def xi(self) -> Array:
        """The Gauss points in [-1, 1] of the segment, shape (k,)."""
        return np.asarray(2 * self.x / self.length - 1)

    @property
    def x(self) -> Array:
        """Gauss points of all pieces, from the front of the segment, shape (k,)."""
        return self._local.ravel()

    @property
    def weights(self) -> Array:
        """Weights of the integral over the segment, shape (k,)."""
        return np.asarray((self.widths[:, None] / 2 * self.weight).ravel())


def _cut_by_ratio(edges: Array, stiffness: object) -> Array:
    """More edges where a linear stiffness changes by more than RATIO, in geometric progression of the stiffness."""
    if not isinstance(stiffness, StationTable):
        return edges
    near = 1e-6 * np.diff(edges)
    growth = stiffness.at(edges[1:] - near) / stiffness.at(edges[:-1] + near)
    parts = np.ceil(np.abs(np.log(growth)) / math.log(RATIO)).astype(int)
    more = [edges]
    for n in np.flatnonzero(parts > 1):
        share = (growth[n] ** (np.arange(1, parts[n]) / parts[n]) - 1) / (growth[n] - 1)
        more.append(edges[n] + (edges[n + 1] - edges[n]) * share)
    return np.sort(np.concatenate(more))


class MomentShapes:
    """Deflections of a segment whose bending moments are polynomials.

    Parameters
    ----------
    pieces : Pieces
    stiffness : StationTable
    start : float
        Of the segment, from the stage's front.
    order : int
        Highest degree of the bending moment.
    """

    def __init__(self, pieces: Pieces, stiffness: StationTable, start: float, order: int) -> None:
        self._pieces = pieces
        points = len(pieces.t)
        bending = stiffness.at(start + pieces.x)
        moments = legendre.legvander(2 * pieces.x / pieces.length - 1, order)
        curvature = moments / bending[:, None]
        gram = moments.T @ (curvature * pieces.weights[:, None])
        curvature = np.linalg.solve(np.linalg.cholesky(gram), curvature.T).T.reshape(-1, points, order + 1)
        # On each piece, the polynomial through the Gauss points.
        degree = np.arange(points)
        to_series = (_integrated(points - 1, 0, pieces.t) * pieces.weight[:, None]).T * (degree[:, None] + 0.5)
        self._series = to_series @ curvature
        half = pieces.widths[:, None] / 2
        turn = half * 2 * self._series[:, 0]
        slope = np.vstack((np.zeros(order + 1), np.cumsum(turn, axis=0)))
        end = _integrated(points - 1, 2, np.ones(1))
        rise = 2 * half * slope[:-1] + half**2 * (end @ self._series)[:, 0]
        self._slope = slope[:-1]
        self._deflection = np.vstack((np.zeros(order + 1), np.cumsum(rise, axis=0)))[:-1]

    def at_points(self, derivative: int) -> Array:
        """The same as ``at`` the Gauss points of the pieces."""
        pieces = self._pieces
        half = pieces.widths[:, None, None] / 2
        polynomials = _integrated(len(pieces.t) - 1, 2 - derivative, pieces.t)
        found = (polynomials @ self._series) * half ** (2 - derivative)
        if derivative == 1:
            found += self._slope[:, None]
        elif derivative == 0:
            found += self._deflection[:, None] + (1 + pieces.t[:, None]) * half * self._slope[:, None]
        return np.asarray(found.reshape(-1, found.shape[2]))

    def at(self, xi: Array, derivative: int) -> Array:
        """Deflections, slopes or curvatures at xi in [-1, 1] of the segment, shape (len(xi), order + 1)."""
        pieces = self._pieces
        x = (1 + xi) / 2 * pieces.length
        piece = np.clip(np.searchsorted(pieces.edges, x, side="right") - 1, 0, len(pieces.widths) - 1)
        half = pieces.widths[piece] / 2
        t = (x - pieces.edges[piece]) / half - 1
        polynomials = _integrated(len(pieces.t) - 1, 2 - derivative, t)
        found = np.einsum("kg,kgn->kn", polynomials, self._series[piece]) * half[:, None] ** (2 - derivative)
        if derivative == 1:
            found += self._slope[piece]
        elif derivative == 0:
            found += self._deflection[piece] + ((1 + t) * half)[:, None] * self._slope[piece]
        return np.asarray(found)


def pieces(vehicle: Vehicle, chain: Sequence[Segment], order: int) -> dict[int, Pieces]:
    """The pieces of the segments of stages with tables, by the segments' number."""
    return {
        index: Pieces(stage, segment.start - vehicle.boundaries[segment.stage], segment.length, order)
        for index, segment in enumerate(chain)
        if (stage := vehicle.laden[segment.stage]).tables
    }


def moment_shapes(
    vehicle: Vehicle, chain: Sequence[Segment], cut: dict[int, Pieces], order: int
) -> dict[int, MomentShapes]:
    """The shapes of the segments of varying stiffness, by the segments' number."""
    found = {}
    for index, parts in cut.items():
        segment = chain[index]
        stiffness = vehicle.stages[segment.stage].bending_stiffness
        if isinstance(stiffness, StationTable):
            found[index] = MomentShapes(parts, stiffness, segment.start - vehicle.boundaries[segment.stage], order)
    return found


def _integrated(degree: int, times: int, t: Array) -> Array:
    """P_0..P_degree integrated from -1 ``times`` times, shape (len(t), degree + 1)."""
    return _few_integrated(degree, times, tuple(t)) if len(t) <= FEW_POINTS else _legendre(degree, times, t)


@lru_cache(maxsize=256)
def _few_integrated(degree: int, times: int, t: tuple[float, ...]) -> Array:
    return _legendre(degree, times, np.array(t))


def _legendre(degree: int, times: int, t: Array) -> Array:
    return legendre.legvander(t, degree + 2) @ integrals(degree, times)
