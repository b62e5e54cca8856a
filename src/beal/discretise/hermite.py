"""Cubic Hermite elements: the finite elements that most structural codes use, kept as a second opinion."""

import numpy as np

from beal.discretise.basis import Array, Basis, segments
from beal.discretise.chain import Chain
from beal.vehicle.vehicle import Vehicle


class HermiteBasis(Basis):
    """Deflection and slope at the nodes, relative to the rigid-body motion of the nose; cubic between them.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Elements per segment.
    """

    def __init__(self, vehicle: Vehicle, order: int) -> None:
        self.segments = segments(vehicle, pieces=order)
        self.quadrature = 4  # exact to degree 7, the mass integrand has 6
        chain = Chain(vehicle, self.segments, per_segment=2)
        self._size = chain.size
        self._ends = np.zeros((len(self.segments), 4, self._size))  # deflection, slope in front and behind
        rigid = state = chain.nose()
        for index, segment in enumerate(self.segments):
            stiffness = vehicle.stages[segment.stage].bending_stiffness
            front = state + chain.jumps(index)
            state = np.array([rigid[0] + segment.end * rigid[1], rigid[1]])
            own = chain.columns[index].start
            state[0, own] = (segment.length**3 / (12 * stiffness)) ** 0.5
            state[1, own + 1] = (segment.length / (4 * stiffness)) ** 0.5
            self._ends[index] = np.vstack((front, state))

    @property
    def size(self) -> int:
        return self._size

    def rows(self, segment: int, xi: Array, derivative: int) -> Array:
        return _cubics(xi, self.segments[segment].length, derivative) @ self._ends[segment]


def _cubics(xi: Array, h: float, derivative: int) -> Array:
    """The four Hermite cubics of an element of length h, or a derivative of them, shape (len(xi), 4)."""
    s = (1 + xi) / 2
    if derivative == 0:
        columns = (1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2))
    elif derivative == 1:
        columns = (6 * (s**2 - s) / h, 1 - 4 * s + 3 * s**2, 6 * (s - s**2) / h, 3 * s**2 - 2 * s)
    else:
        columns = ((12 * s - 6) / h**2, (6 * s - 4) / h, (6 - 12 * s) / h**2, (6 * s - 2) / h)
    return np.stack(columns, axis=1)
