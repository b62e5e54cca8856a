"""Cubic Hermite elements: the finite elements that most structural codes use, kept as a second opinion.

Deflections that are cubic on each element, with deflection and slope continuous at the nodes, are those whose curvature
is linear on each element. Nodal deflections and slopes as coordinates lose (length / element)^4 of the digits; the
elements' curvatures span the same space and lose none. Where a stage shears, its shear strain is cubic on each element:
a follower force reads that strain at one point, where the error falls as fast as the strain's, not as its square.
"""

from beal.discretisation.legendre import LegendreBasis
from beal.vehicle.vehicle import Vehicle


class HermiteBasis(LegendreBasis):
    """Deflections that are piecewise cubic, with continuous slope.

    Parameters
    ----------
    vehicle : Vehicle
    order : int
        Elements per segment.
    """

    def __init__(self, vehicle: Vehicle, order: int) -> None:
        super().__init__(vehicle, order=1, parts=order, loads=False, shear_order=3)
