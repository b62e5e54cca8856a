"""Ziegler's double pendulum: rigid massless rods on rotational springs, masses at their ends."""

import math

from beal.vehicle.parts import Joint, PointMass, Stage, Support
from beal.vehicle.vehicle import Vehicle


def ziegler(mass_ratio: float = 2.0, first_damping: float = 0.0, second_damping: float = 0.0) -> Vehicle:
    """Ziegler's double pendulum under a follower force.

    Length of the rods, stiffness of the hinges and mass at the tail are 1. For a mass ratio of two it flutters at
    P = 7/2 - sqrt(2) = 2.0857864 without damping (Ziegler, 1952), at 41/28 = 1.4642857 as equal dashpots vanish, and in
    between for other ratios of the dashpots (Herrmann & Jong, 1965).

    Parameters
    ----------
    mass_ratio : float
        The mass between the rods over that at the tail.
    first_damping, second_damping : float
        Of the hinges' dashpots, b/sqrt(c m l^2).

    Returns
    -------
    Vehicle
        Of three rods: the first is clamped and does not move, so that the first hinge is a joint.

    References
    ----------
    Ziegler, H., 1952. Die Stabilitätskriterien der Elastomechanik. Ingenieur-Archiv, 20, 49-56.
    Herrmann, G., Jong, I.-C., 1965. On the destabilizing effect of damping in nonconservative elastic systems. Journal
    of Applied Mechanics, 32, 592-597.

    Examples
    --------
    >>> ziegler().mass
    3.0
    """
    rod = Stage(length=1.0, mass_per_length=0.0, bending_stiffness=math.inf)
    return Vehicle(
        title="Ziegler's pendulum",
        units="nondimensional",
        stages=[rod, rod, rod],
        joints=[Joint(rotational_stiffness=1.0, rotational_damping=c) for c in (first_damping, second_damping)],
        point_masses=[PointMass(station=2.0, mass=mass_ratio), PointMass(station=3.0, mass=1.0)],
        support=Support(nose="clamped"),
    )
