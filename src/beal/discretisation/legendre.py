"""Legendre polynomials of the curvature on each segment, and the joints' own deformations: strain coordinates.

Deflection and slope follow by integrating from the nose. In these coordinates the bending and spring stiffness is
diagonal, each coordinate is scaled by its own stiffness, and a joint of 1e12 is as harmless as one of 1; a rigid
joint has no coordinate at all.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from beal.discretisation.basis import Array, Basis, segments
from beal.discretisation.chain import Chain
from beal.discretisation.polynomials import gauss, integrals
from beal.discretisation.varying import moment_shapes, pieces
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle


class LegendreBasis(Basis):
    """Curvature of degree up to ``order`` on each segment, so deflections of degree ``order + 2``.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Highest degree of the curvature, at least 1 (0 and 1 carry the segment's end rotation and deflection).
    parts : int
        Equal parts into which each segment is cut.
    moments : bool
        Whether the bending moments, rather than the curvatures, are polynomials where the stiffness varies.
    """

    def __init__(self, vehicle: Vehicle, order: int, parts: int = 1, moments: bool = True) -> None:
        self.segments = segments(vehicle, parts)
        self.pieces = pieces(vehicle, self.segments, order)
        self._shapes = moment_shapes(vehicle, self.segments, self.pieces, order) if moments else {}
        self.quadrature = order + 3  # exact to degree 2 * order + 5, the mass integrand has 2 * order + 4
        self._order = order
        chain = Chain(vehicle, self.segments, per_segment=order + 1)
        self._size = chain.size
        self._columns = chain.columns
        self.springs, self.deformations = chain.springs, chain.deformations  # type: ignore[method-assign]
        self._stiffness = [mean(vehicle.stages[segment.stage].bending_stiffness) for segment in self.segments]
        self._front = np.zeros((len(self.segments), 2, self._size))  # deflection and slope at the fronts
        state = chain.nose()
        for index, segment in enumerate(self.segments):
            state = state + chain.jumps(index)
            self._front[index] = state
            state = self._advance(index, state, segment.length)

    @property
    def size(self) -> int:
        return self._size

    def _advance(self, index: int, state: Array, length: float) -> Array:
        """Deflection and slope at the aft end of a segment from those at its front."""
        end = np.array([state[0] + length * state[1], state[1]])
        columns = self._columns[index]
        for derivative in (0, 1):
            end[derivative, columns] += self._local(index, np.array([1.0]), derivative)[0]
        return end

    def _local(self, index: int, xi: Array, derivative: int) -> Array:
        """Deflection, slope or curvature that the segment's own coordinates add behind its front."""
        if index in self._shapes:
            return self._shapes[index].at(xi, derivative)
        length = self.segments[index].length
        values = _polynomials(self._order, 2 - derivative, tuple(xi))
        degree = np.arange(self._order + 1)
        unit_energy = np.sqrt((2 * degree + 1) / (length * self._stiffness[index]))
        return np.asarray(values * unit_energy * (length / 2) ** (2 - derivative))

    def rows(self, segment: int, xi: Array, derivative: int) -> Array:
        deflection, slope = self._front[segment]
        rows = np.zeros((len(xi), self._size))
        if derivative == 0:
            rows += deflection + np.outer(self.segments[segment].length * (1 + xi) / 2, slope)
        elif derivative == 1:
            rows += slope
        rows[:, self._columns[segment]] += self._local(segment, xi, derivative)
        return rows

    def at_points(self, segment: int, derivative: int) -> Array:
        xi = self.pieces[segment].xi if segment in self.pieces else gauss(self.quadrature)[0]
        shapes = self._shapes.get(segment)
        own = shapes.at_points(derivative) if shapes else self._local(segment, xi, derivative)
        return self._behind(segment, xi, derivative, own)

    def expanded(self, segment: int, local: Array) -> Array:
        rows = local[:, :2] @ self._front[segment]
        rows[:, self._columns[segment]] += local[:, 2:]
        return rows

    def _behind(self, segment: int, xi: Array, derivative: int, own: Array) -> Array:
        """A segment's own shapes beside those of a unit deflection and slope at its front."""
        front = np.zeros((len(xi), 2))
        if derivative < 2:
            front[:, derivative] = 1.0
        if derivative == 0:
            front[:, 1] = self.segments[segment].length * (1 + xi) / 2
        return np.hstack((front, own))


@lru_cache(maxsize=256)
def _polynomials(order: int, times: int, xi: tuple[float, ...]) -> Array:
    """P_0..P_order integrated from -1 ``times`` times, at xi; the same few points come again for every segment."""
    return legendre.legvander(np.array(xi), order + 2) @ integrals(order, times)
