"""The points at which energies are integrated, and the properties there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.basis import Array, Segment
from beal.discretisation.polynomials import gauss
from beal.discretisation.varying import Pieces
from beal.vehicle.stations import StationTable
from beal.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Points:
    """Gauss points from nose to tail, all arrays of shape (k,).

    Parameters
    ----------
    vehicle : Vehicle
    segment : ndarray of int
    weight : ndarray
        Of the integral over the vehicle, in m.
    station : ndarray
        In m.
    each : ndarray of int, shape (stages,)
        Number of points on each stage.
    """

    vehicle: Vehicle
    segment: NDArray[np.intp]
    weight: Array
    station: Array
    each: NDArray[np.intp]

    def property(self, name: str) -> Array:
        """A property of the stages at the points."""
        given = [getattr(stage, name) for stage in self.vehicle.laden]
        varying = [n for n, value in enumerate(given) if isinstance(value, StationTable)]
        found = np.repeat([0.0 if n in varying else value for n, value in enumerate(given)], self.each)
        for n in varying:
            last = int(self.each[: n + 1].sum())
            here = slice(last - int(self.each[n]), last)
            found[here] = given[n].at(self.station[here] - self.vehicle.boundaries[n])
        return found

    def finite(self, name: str) -> Array:
        """The same with 0 in place of an infinite stiffness, against which there is no strain."""
        found = self.property(name)
        return np.where(np.isinf(found), 0.0, found)


def quadrature(vehicle: Vehicle, chain: Sequence[Segment], count: int, cut: Mapping[int, Pieces]) -> Points:
    """Points that integrate over a chain of segments: ``count`` of Gauss's on each, or those of its pieces."""
    t, weight = gauss(count)
    start, half = np.array([(segment.start, segment.length / 2) for segment in chain]).T
    if cut:
        placed = [cut[n].xi if n in cut else t for n in range(len(chain))]
        weighted = [cut[n].weights if n in cut else half[n] * weight for n in range(len(chain))]
        counts, xi, weights = [len(x) for x in placed], np.concatenate(placed), np.concatenate(weighted)
    else:
        counts, xi, weights = [count] * len(chain), np.tile(t, len(chain)), np.outer(half, weight).ravel()
    segment = np.repeat(np.arange(len(chain)), counts)
    each = np.zeros(len(vehicle.stages), dtype=np.intp)
    for piece, points in zip(chain, counts, strict=True):
        each[piece.stage] += points
    return Points(vehicle, segment, weights, start[segment] + half[segment] * (1 + xi), each)
