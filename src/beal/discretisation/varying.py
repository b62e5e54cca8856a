"""Segments along which properties vary: where they are integrated, and shapes that suit them.

Bending moment and shear force are smooth where the stiffness has kinks and steps, the strains are not. On such segments
the shapes are therefore those whose moments or forces are polynomials, psi' = P_k(x)/EI(x), made orthonormal in
energy; of uniform stiffness they are the Legendre polynomials of the strain.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.polynomial import legendre

from beal.discretisation.basis import Array, Segment
from beal.discretisation.polynomials import gauss, integrated
from beal.discretisation.strains import STRAINS, Strain
from beal.vehicle.parts import Stage
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle

RATIO = 2.0  # of the stiffness at the ends of a piece, at most
DIGITS = 14.0 * math.log(10.0)
SMOOTH = 5  # Gauss points that a piece takes beyond the half waves that a polynomial may have on it


class Pieces:
    """A segment cut where the slope of a property changes, and the Gauss points of the pieces.

    Parameters
    ----------
    stage : Stage
    start, length : float
        Of the segment, start from the stage's front, in m.
    order : int
        Degree of the strains, or of bending moment and shear force.
    """

    def __init__(self, stage: Stage, start: float, length: float, order: int) -> None:
        stations = np.concatenate([table.arrays.x for table in stage.tables.values()])
        end = start + length
        margin = 1e-9 * length
        inner = np.unique(stations[(stations > start + margin) & (stations < end - margin)])
        edges = np.concatenate(([start], inner, [end]))
        for stiffness in _tables(stage):
            edges = _cut_by_ratio(edges, stiffness)
        self.edges = edges - start
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
        inside = start + self.edges[:-1, None] + self.widths[:, None] * np.array([1e-6, 1 - 1e-6])
        more = 0
        for table in _tables(stage):
            stiffness = table.at(inside)
            ratio = max(1 + 1e-9, float((stiffness.max(axis=1) / stiffness.min(axis=1)).max()))
            pole = (ratio + 1) / (ratio - 1)  # of 1/EI, in half widths of the piece
            more = max(more, math.ceil(DIGITS / 2 / math.log(pole + math.sqrt(pole**2 - 1))))
        return points + more

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


def _tables(stage: Stage) -> list[StationTable]:
    """The stage's stiffnesses that vary."""
    return [stage.tables[strain.stiffness] for strain in STRAINS if strain.stiffness in stage.tables]


def _cut_by_ratio(edges: Array, stiffness: StationTable) -> Array:
    """More edges where a linear stiffness changes by more than RATIO, in geometric progression of the stiffness."""
    near = 1e-6 * np.diff(edges)
    growth = stiffness.at(edges[1:] - near) / stiffness.at(edges[:-1] + near)
    parts = np.ceil(np.abs(np.log(growth)) / math.log(RATIO)).astype(int)
    more = [edges]
    for n in np.flatnonzero(parts > 1):
        share = (growth[n] ** (np.arange(1, parts[n]) / parts[n]) - 1) / (growth[n] - 1)
        more.append(edges[n] + (edges[n + 1] - edges[n]) * share)
    return np.sort(np.concatenate(more))


class LoadShapes:
    """Strains of a segment whose bending moments, or shear forces, are polynomials, and their integrals.

    Parameters
    ----------
    pieces : Pieces
    stiffness : StationTable
    start : float
        Of the segment, from the stage's front.
    order : int
        Highest degree of the polynomials.
    """

    def __init__(self, pieces: Pieces, stiffness: StationTable, start: float, order: int) -> None:
        self.order = order
        self._pieces = pieces
        points = len(pieces.t)
        loads = legendre.legvander(2 * pieces.x / pieces.length - 1, order)
        strain = loads / stiffness.at(start + pieces.x)[:, None]
        gram = loads.T @ (strain * pieces.weights[:, None])
        strain = np.linalg.solve(np.linalg.cholesky(gram), strain.T).T.reshape(-1, points, order + 1)
        # On each piece, the polynomial through the Gauss points.
        degree = np.arange(points)
        to_series = (integrated(points - 1, 0, pieces.t) * pieces.weight[:, None]).T * (degree[:, None] + 0.5)
        self._series = to_series @ strain
        half = pieces.widths[:, None] / 2
        once = np.vstack((np.zeros(order + 1), np.cumsum(half * 2 * self._series[:, 0], axis=0)))
        end = integrated(points - 1, 2, np.ones(1))
        rise = 2 * half * once[:-1] + half**2 * (end @ self._series)[:, 0]
        self._once = once[:-1]  # the integrals at the fronts of the pieces
        self._twice = np.vstack((np.zeros(order + 1), np.cumsum(rise, axis=0)))[:-1]

    def at_points(self, times: int) -> Array:
        """The same as ``at`` the Gauss points of the pieces."""
        pieces = self._pieces
        half = pieces.widths[:, None, None] / 2
        found = (integrated(len(pieces.t) - 1, times, pieces.t) @ self._series) * half**times
        if times == 1:
            found += self._once[:, None]
        elif times == 2:
            found += self._twice[:, None] + (1 + pieces.t[:, None]) * half * self._once[:, None]
        return np.asarray(found.reshape(-1, found.shape[2]))

    def at(self, xi: Array, times: int) -> Array:
        """Strains integrated ``times`` times, at xi in [-1, 1] of the segment, shape (len(xi), order + 1)."""
        pieces = self._pieces
        x = (1 + xi) / 2 * pieces.length
        piece = np.clip(np.searchsorted(pieces.edges, x, side="right") - 1, 0, len(pieces.widths) - 1)
        half = pieces.widths[piece] / 2
        t = (x - pieces.edges[piece]) / half - 1
        polynomials = integrated(len(pieces.t) - 1, times, t)
        found = np.einsum("kg,kgn->kn", polynomials, self._series[piece]) * half[:, None] ** times
        if times == 1:
            found += self._once[piece]
        elif times == 2:
            found += self._twice[piece] + ((1 + t) * half)[:, None] * self._once[piece]
        return np.asarray(found)


def pieces(vehicle: Vehicle, chain: Sequence[Segment], order: int) -> dict[int, Pieces]:
    """The pieces of the segments of stages with tables, by the segments' number."""
    return {
        index: Pieces(stage, segment.start - vehicle.boundaries[segment.stage], segment.length, order)
        for index, segment in enumerate(chain)
        if (stage := vehicle.laden[segment.stage]).tables
    }


def load_shapes(
    vehicle: Vehicle, chain: Sequence[Segment], cut: dict[int, Pieces], order: int, strain: Strain
) -> dict[int, LoadShapes]:
    """The shapes of the segments whose stiffness against a strain varies, by the segments' number."""
    found = {}
    for index, parts in cut.items():
        segment = chain[index]
        stiffness = vehicle.stages[segment.stage].tables.get(strain.stiffness)
        if stiffness is not None:
            found[index] = LoadShapes(parts, stiffness, segment.start - vehicle.boundaries[segment.stage], order)
    return found
