"""Beck's column and Beal's missile of beams that shear and whose sections have inertia."""

from typing import Literal

from beal.vehicle.parts import PointMass, Stage, Support, Thrust
from beal.vehicle.vehicle import Vehicle

AxialTerm = Literal["engesser", "haringx"]


def beck_timoshenko(
    shear_stiffness: float,
    rotary_inertia: float = 0.0,
    axial_term: AxialTerm = "engesser",
    mass_ratio: float = 0.0,
    along: Literal["slope", "section"] = "slope",
) -> Vehicle:
    """Beck's column of a Timoshenko beam, with a point mass at the tail if one is given.

    A shear stiffness of a hundred lowers the flutter load from 20.0509536 to 15.3750698, where the axial force goes
    along the axis (Engesser), or to 15.8773905, where it goes along the section's normal (Haringx). Computed values.

    Parameters
    ----------
    shear_stiffness : float
        kGA L^2/EI; infinite for a beam that does not shear.
    rotary_inertia : float
        I/(A L^2) of the sections.
    axial_term : {"engesser", "haringx"}
    mass_ratio : float
        The point mass over the mass of the beam.
    along : {"slope", "section"}
        What the thrust follows; without a point mass the two are the same.

    Returns
    -------
    Vehicle

    References
    ----------
    Nemat-Nasser, S., 1967. Instability of a cantilever under a follower force according to Timoshenko beam theory.
    Journal of Applied Mechanics, 34, 484-485.

    Examples
    --------
    >>> beck_timoshenko(100.0).thrust.axial_term
    'engesser'
    """
    return Vehicle(
        title="Beck's column of a Timoshenko beam",
        units="nondimensional",
        stages=[_beam(shear_stiffness, rotary_inertia)],
        point_masses=[PointMass(station=1.0, mass=mass_ratio)] if mass_ratio else [],
        support=Support(nose="clamped"),
        thrust=Thrust(axial_term=axial_term, along=along),
    )


def beal_timoshenko(shear_stiffness: float, rotary_inertia: float = 0.0, axial_term: AxialTerm = "engesser") -> Vehicle:
    """Beal's missile of a Timoshenko beam, without the directional control of Park (1987).

    Flutter at 102.131076 for a shear stiffness of a thousand and no rotary inertia. Computed values.

    Parameters
    ----------
    shear_stiffness, rotary_inertia, axial_term
        As in `beck_timoshenko`.

    Returns
    -------
    Vehicle

    References
    ----------
    Park, Y. P., 1987. Dynamic stability of a free Timoshenko beam under a controlled follower force. Journal of Sound
    and Vibration, 113, 407-415.

    Examples
    --------
    >>> beal_timoshenko(1000.0, 0.0025).free_free
    True
    """
    return Vehicle(
        title="Beal's missile of a Timoshenko beam",
        units="nondimensional",
        stages=[_beam(shear_stiffness, rotary_inertia)],
        thrust=Thrust(axial_term=axial_term),
    )


def _beam(shear_stiffness: float, rotary_inertia: float) -> Stage:
    return Stage(
        length=1.0,
        mass_per_length=1.0,
        bending_stiffness=1.0,
        shear_stiffness=shear_stiffness,
        rotary_inertia_per_length=rotary_inertia,
    )
