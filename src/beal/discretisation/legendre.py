"""Legendre polynomials of the strains on each segment, and the joints' own deformations: strain coordinates.

Deflection and rotation follow by integrating from the nose. In these coordinates the stiffness of beams and springs is
diagonal, each coordinate is scaled by its own stiffness, and a joint or a shear stiffness of 1e12 is as harmless as one
of 1; a rigid joint, or a segment without a strain, has no coordinate for it at all.
"""

import math
from collections.abc import Sequence

import numpy as np

from beal.discretisation.basis import DEFLECTION, ROTATION, Array, Basis, segments
from beal.discretisation.chain import Chain
from beal.discretisation.polynomials import gauss
from beal.discretisation.strains import STRAINS, Strain, UniformShapes, carried
from beal.discretisation.varying import LoadShapes, load_shapes, pieces
from beal.vehicle.vehicle import Vehicle

Shapes = UniformShapes | LoadShapes


class LegendreBasis(Basis):
    """Strains of degree up to ``order`` on each segment, so deflections of degree ``order + 2``.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Highest degree of the strains, at least 1 (0 and 1 carry the segment's end rotation and deflection).
    parts : int
        Equal parts into which each segment is cut.
    loads : bool
        Whether bending moments and shear forces, rather than strains, are polynomials where the stiffness varies.
    shear_order : int, optional
        Highest degree of the shear strain, ``order`` by default.
    """

    def __init__(
        self, vehicle: Vehicle, order: int, parts: int = 1, loads: bool = True, shear_order: int | None = None
    ) -> None:
        self.segments = segments(vehicle, parts)
        highest = max(order, shear_order or 0)
        self.pieces = pieces(vehicle, self.segments, highest)
        self.quadrature = highest + 3  # exact to degree 2 * order + 5, the mass integrand has 2 * order + 4
        self._own: list[list[tuple[Strain, Shapes]]] = [[] for _ in self.segments]
        for strain, degree in zip(STRAINS, (order, shear_order or order), strict=True):
            varying = load_shapes(vehicle, self.segments, self.pieces, degree, strain) if loads else {}
            for index, stiffness in enumerate(strain.stiffnesses(vehicle, self.segments)):
                if math.isfinite(stiffness):
                    uniform = UniformShapes(degree, self.segments[index].length, stiffness)
                    self._own[index].append((strain, varying.get(index, uniform)))
        chain = Chain(vehicle, self.segments, [sum(shapes.order + 1 for _, shapes in own) for own in self._own])
        self._size = chain.size
        self._columns = chain.columns
        self.springs, self.deformations = chain.springs, chain.deformations  # type: ignore[method-assign]
        self._front = np.zeros((len(self.segments), 2, self._size))  # deflection and rotation at the fronts
        state = chain.nose()
        for index, segment in enumerate(self.segments):
            state = state + chain.jumps(index)
            self._front[index] = state
            state = self._advance(index, state, segment.length)

    @property
    def size(self) -> int:
        return self._size

    def _advance(self, index: int, state: Array, length: float) -> Array:
        """Deflection and rotation at the aft end of a segment from those at its front."""
        end = np.array([state[0] + length * state[1], state[1]])
        columns = self._columns[index]
        for row, reading in enumerate((DEFLECTION, ROTATION)):
            end[row, columns] += self._local(index, np.array([1.0]), reading)[0]
        return end

    def _local(self, index: int, xi: Array, reading: int, points: bool = False) -> Array:
        """What the segment's own coordinates add behind its front; ``points``: at the Gauss points of its pieces."""
        blocks = []
        for strain, shapes in self._own[index]:
            if reading not in strain.times:
                blocks.append(np.zeros((len(xi), shapes.order + 1)))
            elif points and isinstance(shapes, LoadShapes):
                blocks.append(shapes.at_points(strain.times[reading]))
            else:
                blocks.append(shapes.at(xi, strain.times[reading]))
        return blocks[0] if len(blocks) == 1 else np.hstack([np.zeros((len(xi), 0)), *blocks])

    def rows(self, segment: int, xi: Array, reading: int) -> Array:
        rows = carried(reading, self.segments[segment].length, xi) @ self._front[segment]
        rows[:, self._columns[segment]] += self._local(segment, xi, reading)
        return rows

    def at_points(self, segment: int, reading: int) -> Array:
        xi = self.pieces[segment].xi if segment in self.pieces else gauss(self.quadrature)[0]
        front = carried(reading, self.segments[segment].length, xi)
        return np.hstack((front, self._local(segment, xi, reading, points=True)))

    def expanded(self, local: Sequence[Array]) -> Array:
        rows = [own[:, :2] @ front for own, front in zip(local, self._front, strict=True)]
        for row, own, columns in zip(rows, local, self._columns, strict=True):
            row[:, columns] += own[:, 2:]
        return np.vstack(rows)
