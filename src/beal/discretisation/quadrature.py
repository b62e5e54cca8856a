"""The points at which energies are integrated, and the properties there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.basis import Array, Segment
from beal.discretisation.polynomials import gauss
from beal.discretisation.varying import Pieces
from beal.vehicle.stations import values
from beal.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Points:
    """Gauss points from nose to tail, all arrays of shape (k,).

    Parameters
    ----------
    vehicle : Vehicle
    segment : ndarray of int
    xi : ndarray
        Place in the segment, in [-1, 1].
    weight : ndarray
        Of the integral over the vehicle, in m.
    station : ndarray
        In m.
    ends : ndarray of int, shape (stages + 1,)
        Where each stage's points begin, and the number of all.
    """

    vehicle: Vehicle
    segment: NDArray[np.intp]
    xi: Array
    weight: Array
    station: Array
    ends: NDArray[np.intp]

    def property(self, name: str) -> Array:
        """A property of the stages at the points."""
        given = [getattr(stage, name) for stage in self.vehicle.stages]
        varying = [n for n, stage in enumerate(self.vehicle.stages) if name in stage.tables]
        for n in varying:
            given[n] = 0.0
        found = np.repeat(np.array(given), np.diff(self.ends))
        for n in varying:
            here = slice(self.ends[n], self.ends[n + 1])
            local = self.station[here] - self.vehicle.boundaries[n]
            found[here] = values(getattr(self.vehicle.stages[n], name), local)
        return found


def quadrature(vehicle: Vehicle, chain: Sequence[Segment], count: int, cut: Mapping[int, Pieces]) -> Points:
    """Points that integrate over a chain of segments: ``count`` of Gauss's on each, or those of its pieces."""
    t, weight = gauss(count)
    start, half = np.array([(segment.start, segment.length / 2) for segment in chain]).T
    stages = np.array([segment.stage for segment in chain])
    if cut:
        xi = [cut[n].xi if n in cut else t for n in range(len(chain))]
        weights = [cut[n].weights if n in cut else half[n] * weight for n in range(len(chain))]
        counts = np.array([len(x) for x in xi])
        all_xi, all_weights = np.concatenate(xi), np.concatenate(weights)
    else:
        counts = np.full(len(chain), len(t))
        all_xi, all_weights = np.tile(t, len(chain)), np.outer(half, weight).ravel()
    segment = np.repeat(np.arange(len(chain)), counts)
    station = start[segment] + half[segment] * (1 + all_xi)
    ends = np.append(0, np.cumsum(np.bincount(stages, counts, len(vehicle.stages)))).astype(np.intp)
    return Points(vehicle, segment, all_xi, all_weights, station, ends)
