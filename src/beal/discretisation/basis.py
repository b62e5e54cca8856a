"""Shape functions over a chain of segments: what every basis shares."""

from abc import ABC, abstractmethod
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.cuts import FEW, bends, cuts
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from beal.discretisation.chain import GroundSpring
    from beal.discretisation.varying import Pieces

Array = NDArray[np.float64]
Rows = Any  # ndarray or sparse array of one row per reading of the shapes
SNAP = 1e-9  # share of the length within which a station counts as a segment's end
# What rows read: y, y', psi' (y'' without shear), the section's rotation psi (y' without shear), y' - psi (0 without).
DEFLECTION, SLOPE, CURVATURE, ROTATION, SHEAR = range(5)


@dataclass(frozen=True)
class Segment:
    """A stretch of one stage over which every property is smooth, but for lesser kinks and steps."""

    stage: int
    start: float
    length: float

    @property
    def end(self) -> float:
        return self.start + self.length


def segments(vehicle: Vehicle, pieces: int = 1, few: int = FEW) -> tuple[Segment, ...]:
    """Stretches of the stages between point masses and where loads act or bend, each cut into equal ``pieces``.

    A concentrated load leaves a step in the third derivative; with a segment's end there, polynomials stay accurate.
    So do kinks and steps of the stages' properties; of ``few`` segments at most for each stage, the lesser ones lie
    inside.
    """
    loads = sorted(_loaded(vehicle))
    margin = SNAP * vehicle.length
    chain = []
    for stage, (front, back) in enumerate(zip(vehicle.boundaries, vehicle.boundaries[1:], strict=False)):
        ends = [front]
        inner = loads[bisect_left(loads, front) : bisect_left(loads, back)]
        if vehicle.laden[stage].tables:
            inner = sorted([*inner, *(front + x for x in cuts(vehicle.laden[stage], vehicle.length, few))])
        for station in inner:
            if ends[-1] + margin < station < back - margin:
                ends.append(station)
        ends.append(back)
        for a, b in zip(ends, ends[1:], strict=False):
            parts = np.linspace(a, b, pieces + 1)
            chain += [Segment(stage, float(x), float(y - x)) for x, y in zip(parts, parts[1:], strict=False)]
    return tuple(chain)


def _loaded(vehicle: Vehicle) -> Iterator[float]:
    """Stations where a load sets in or changes its course."""
    for parts in (vehicle.point_masses, vehicle.forces, vehicle.axial_loads):
        yield from (part.station for part in parts)
    for turned in (vehicle.thrust, vehicle.control):
        if turned is not None and turned.station is not None:
            yield turned.station
    for load in vehicle.distributed_thrusts:
        if isinstance(load.value, StationTable):
            yield from bends(load.value)[0].tolist()


class Basis(ABC):
    """Shape functions on segments; a coordinate vector q means the deflection ``rows(...) @ q``.

    The first two columns of every polynomial basis are the rigid-body motions of the whole vehicle, translation and
    rotation about the nose, so that the others carry the strain alone.
    """

    segments: tuple[Segment, ...]
    quadrature: int  # Gauss points per segment that integrate the products of the shapes exactly
    pieces: "Mapping[int, Pieces]" = MappingProxyType({})  # of the segments along which properties vary, by number

    springs: "tuple[GroundSpring, ...]" = ()

    @property
    @abstractmethod
    def size(self) -> int:
        """Number of coordinates."""

    @abstractmethod
    def rows(self, segment: int, xi: Array, reading: int) -> Array:
        """Readings of all shapes at xi in [-1, 1] of a segment, shape (len(xi), size)."""

    def located(self, stations: Array, side: Literal["aft", "forward"]) -> tuple[NDArray[np.intp], Array]:
        """Segments and xi of stations, each of shape (len(stations),); where two meet, the one on the given side."""
        margin = SNAP * self.segments[-1].end
        shift = margin if side == "aft" else -margin
        starts = np.array([segment.start for segment in self.segments])
        lengths = np.array([segment.length for segment in self.segments])
        index = np.clip(np.searchsorted(starts, stations + shift, side="right") - 1, 0, len(starts) - 1)
        return index, np.clip(2 * (stations - starts[index]) / lengths[index] - 1, -1, 1)

    def at(self, stations: Array, reading: int = DEFLECTION, side: Literal["aft", "forward"] = "aft") -> Rows:
        """Readings of all shapes at stations, shape (len(stations), size)."""
        return self.rows_at(*self.located(stations, side), reading)

    def rows_at(self, index: NDArray[np.intp], xi: Array, reading: int) -> Rows:
        """Readings of all shapes at xi of the segments ``index``, shape (len(index), size)."""
        rows = np.empty((len(index), self.size))
        for segment in np.unique(index):
            here = index == segment
            rows[here] = self.rows(int(segment), xi[here], reading)
        return rows

    def end(self, end: int, reading: int) -> Array:
        """A reading at the nose (0) or tail (1), shape (size,)."""
        return np.asarray(self.rows(-end % len(self.segments), np.array([2.0 * end - 1.0]), reading)[0])

    def jump(self, segment: int, reading: int) -> Array:
        """[[f]] = f(aft side) - f(forward side) across the front of a segment, shape (size,)."""
        aft = self.rows(segment, np.array([-1.0]), reading)[0]
        return aft - self.rows(segment - 1, np.array([1.0]), reading)[0]

    def stacked(self, segments: Sequence[int], xi: Array, reading: int) -> Rows:
        """Rows of several segments below each other, shape (len(segments) * len(xi), size)."""
        return np.array([self.rows(i, xi, reading) for i in segments]).reshape(-1, self.size)

    def deformations(self) -> Rows:
        """Deflections and slopes of the ground springs' ends, shape (springs, size)."""
        return np.zeros((0, self.size))

    def at_points(self, segment: int, reading: int) -> Array:
        """A reading of the shapes that live on a segment at its Gauss points, shape (points, shapes)."""
        raise NotImplementedError

    def expanded(self, local: Sequence[Array]) -> Rows:
        """Rows over all shapes from rows over those that live on each segment, below each other, shape (rows, size)."""
        raise NotImplementedError

    def jumps(self, segments: Sequence[int], reading: int) -> Rows:
        """Jumps across the fronts of several segments, shape (len(segments), size)."""
        return np.array([self.jump(i, reading) for i in segments]).reshape(-1, self.size)


@dataclass(frozen=True)
class Combined(Basis):
    """Linear combinations of another basis' shapes.

    Parameters
    ----------
    basis : Basis
    transformation : ndarray, shape (basis.size, size)
    """

    basis: Basis
    transformation: Array

    @property
    def segments(self) -> tuple[Segment, ...]:  # type: ignore[override]
        return self.basis.segments

    @property
    def quadrature(self) -> int:  # type: ignore[override]
        return self.basis.quadrature

    @property
    def size(self) -> int:
        return self.transformation.shape[1]

    def rows(self, segment: int, xi: Array, reading: int) -> Array:
        return self.basis.rows(segment, xi, reading) @ self.transformation

    def rows_at(self, index: NDArray[np.intp], xi: Array, reading: int) -> Rows:
        return self.basis.rows_at(index, xi, reading) @ self.transformation

    def jump(self, segment: int, reading: int) -> Array:
        return self.basis.jump(segment, reading) @ self.transformation

    @property
    def springs(self) -> "tuple[GroundSpring, ...]":  # type: ignore[override]
        return self.basis.springs

    def deformations(self) -> Rows:
        return self.basis.deformations() @ self.transformation
