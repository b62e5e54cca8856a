"""Beck's column and its variants: clamped at the nose, a follower force at the tail."""

import math

from beal.errors import ModelError
from beal.vehicle.catalog.uniform import beam, divided
from beal.vehicle.parts import ElasticEnd, Joint, Stage, Support, Thrust
from beal.vehicle.stations import MassTable, StiffnessTable
from beal.vehicle.vehicle import Vehicle

CLAMPED = Support(nose="clamped")


def beck() -> Vehicle:
    """Beck's column: clamped at the nose, a follower force at the free tail.

    Flutter of modes 1 and 2 at P = 20.05 (Beck, 1952); more exactly 20.0509536, at an angular frequency of 11.0155576.

    Returns
    -------
    Vehicle

    References
    ----------
    Beck, M., 1952. Die Knicklast des einseitig eingespannten, tangential gedrückten Stabes. Zeitschrift für
    angewandte Mathematik und Physik, 3, 225-228.

    Examples
    --------
    >>> beck().support.nose, beck().axial_force
    ('clamped', 'constant')
    """
    return Vehicle(title="Beck's column", units="nondimensional", stages=[beam()], support=CLAMPED)


def beck_damped(internal_damping: float = 0.0, external_damping: float = 0.0, tangency: float = 1.0) -> Vehicle:
    """Beck's column with Kelvin-Voigt and viscous damping.

    The flutter load drops to 10.9388493 as the internal damping alone goes to zero, to 17.5476287 as both go to zero
    with an external damping of a hundred times the internal one. These are computed values.

    Parameters
    ----------
    internal_damping : float
        Time constant of the material, over sqrt(m L^4/EI).
    external_damping : float
        Force per length and rate, over sqrt(m EI)/L^2.
    tangency : float
        1 for a follower force, 0 for one fixed in space.

    Returns
    -------
    Vehicle

    References
    ----------
    Bolotin, V. V., Zhinzher, N. I., 1969. Effects of damping on stability of elastic systems subjected to
    nonconservative forces. International Journal of Solids and Structures, 5, 965-989.

    Examples
    --------
    >>> beck_damped(internal_damping=0.01).damped
    True
    """
    stage = beam(internal_damping=internal_damping, external_damping=external_damping)
    return Vehicle(
        title="damped Beck's column",
        units="nondimensional",
        stages=[stage],
        support=CLAMPED,
        thrust=Thrust(tangency=tangency),
    )


def beck_on_foundation(stiffness: float) -> Vehicle:
    """Beck's column on a Winkler foundation.

    The foundation adds to every omega^2 and leaves the flutter load where it is, at 20.0509536, however stiff it is
    (Smith & Herrmann, 1972).

    Parameters
    ----------
    stiffness : float
        k L^4/EI, k being the force per length and deflection.

    Returns
    -------
    Vehicle

    References
    ----------
    Smith, T. E., Herrmann, G., 1972. Stability of a beam on an elastic foundation subjected to a follower force.
    Journal of Applied Mechanics, 39, 628-629.

    Examples
    --------
    >>> beck_on_foundation(100.0).founded
    True
    """
    return Vehicle(
        title="Beck's column on a foundation",
        units="nondimensional",
        stages=[beam(foundation_stiffness=stiffness)],
        support=CLAMPED,
    )


def beck_on_springs(nose_rotation: float = math.inf, tail_translation: float = 0.0) -> Vehicle:
    """Beck's column with a spring against rotation at the nose or against deflection at the tail.

    A nose spring k gives the flutter load of Pflüger's column of mass ratio 1/k. A tail spring turns flutter into
    divergence from some 34.8 on. Computed values.

    Parameters
    ----------
    nose_rotation : float
        k L/EI; infinite is clamped. The nose does not deflect.
    tail_translation : float
        k L^3/EI; zero is free.

    Returns
    -------
    Vehicle

    References
    ----------
    Kounadis, A. N., 1977. Stability of elastically restrained Timoshenko cantilevers with attached masses subjected to
    a follower force. Journal of Applied Mechanics, 44, 731-736.

    Examples
    --------
    >>> beck_on_springs(nose_rotation=10.0).support.stiffness
    ((inf, 10.0), (0.0, 0.0))
    """
    nose = ElasticEnd(translation=math.inf, rotation=nose_rotation)
    support = Support(nose=nose, tail=ElasticEnd(translation=tail_translation))
    return Vehicle(title="Beck's column on springs", units="nondimensional", stages=[beam()], support=support)


def beck_subtangential(tangency: float) -> Vehicle:
    """Beck's column under a force that follows the tail's slope only in part.

    Up to a tangency of one half the column diverges at cos sqrt(P) = -tangency/(1 - tangency), beyond it flutters
    (Bolotin, 1963).

    Parameters
    ----------
    tangency : float
        1 for Beck's column, 0 for Euler's; above 1 the force turns further than the tail.

    Returns
    -------
    Vehicle

    References
    ----------
    Bolotin, V. V., 1963. Nonconservative problems of the theory of elastic stability. Pergamon.

    Examples
    --------
    >>> beck_subtangential(0.5).thrust.tangency
    0.5
    """
    title = "Beck's column under a sub-tangential force"
    thrust = Thrust(tangency=tangency)
    return Vehicle(title=title, units="nondimensional", stages=[beam()], support=CLAMPED, thrust=thrust)


def beck_tapered(taper: float) -> Vehicle:
    """Beck's column with mass and bending stiffness that fall linearly from nose to tail.

    m = EI = 1 - taper x. Flutter at P = 18.2669761 and 15.6265310 for tapers of 0.2 and 0.5: computed values.

    Parameters
    ----------
    taper : float
        Share of the mass per length and of the bending stiffness that is lost at the tail, below 1.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If nothing is left at the tail.

    Examples
    --------
    >>> beck_tapered(0.5).mass
    0.75
    """
    if not taper < 1:
        raise ModelError(f"taper: must be below 1, found {taper}")
    x, value = (0.0, 1.0), (1.0, 1.0 - taper)
    mass, stiffness = MassTable(x=x, value=value), StiffnessTable(x=x, value=value)
    stage = Stage(length=1.0, mass_per_length=mass, bending_stiffness=stiffness)
    return Vehicle(title="tapered Beck's column", units="nondimensional", stages=[stage], support=CLAMPED)


def beck_cracked(station: float, rotational_stiffness: float) -> Vehicle:
    """Beck's column with a crack, a rotational spring between two rigidly aligned halves.

    The model is that of Wang (2004); the loads that go with it here are computed ones.

    Parameters
    ----------
    station : float
        Of the crack, as a share of the length from the clamp.
    rotational_stiffness : float
        k L/EI of the cracked section.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If the station is not between 0 and 1.

    References
    ----------
    Wang, Q., 2004. A comprehensive stability analysis of a cracked beam subjected to follower compression.
    International Journal of Solids and Structures, 41, 4875-4888.

    Examples
    --------
    >>> beck_cracked(0.25, 10.0).boundaries
    (0.0, 0.25, 1.0)
    """
    return Vehicle(
        title="cracked Beck's column",
        units="nondimensional",
        stages=divided(station, "station"),
        joints=[Joint(rotational_stiffness=rotational_stiffness)],
        support=CLAMPED,
    )
