"""Free-free beams under a follower force at the tail."""

import math

from beal.vehicle.catalog.uniform import beam, divided
from beal.vehicle.control import Control, Gain
from beal.vehicle.parts import Joint, PointMass, Sensor, ShearAxis
from beal.vehicle.vehicle import Vehicle


def beal(internal_damping: float = 0.0) -> Vehicle:
    """Beal's missile: a uniform free-free beam under a follower force at the tail.

    Flutter of modes 1 and 2 at P = 109.9 (Beal, 1965, as Irani & Kavianipour, 2009, quote it); more exactly
    109.689191958738, at an angular frequency of 23.0733299. With an internal damping that goes to zero, 88.1526302.

    Parameters
    ----------
    internal_damping : float
        Kelvin-Voigt time constant, over sqrt(m L^4/EI).

    Returns
    -------
    Vehicle

    References
    ----------
    Beal, T. R., 1965. Dynamic stability of a flexible missile under constant and pulsating thrusts. AIAA Journal, 3(3),
    486-494.

    Examples
    --------
    >>> beal().free_free, beal().axial_force
    (True, 'inertia')
    """
    return Vehicle(title="Beal's missile", units="nondimensional", stages=[beam(internal_damping=internal_damping)])


def beal_controlled(gain: float, station: float) -> Vehicle:
    """Beal's missile, its thrust turned against the slope at a station.

    A zero-frequency root at 25.6381814 whatever the gain and the station; a high gain on a sensor far forward makes the
    attitude and the first bending mode flutter before that. Computed values.

    Parameters
    ----------
    gain : float
        Angle of the thrust over the slope; positive restores the attitude.
    station : float
        Of the sensor, as a share of the length from the nose.

    Returns
    -------
    Vehicle

    References
    ----------
    Wu, J. J., 1975. On the stability of a free-free beam under axial thrust subjected to directional control. Journal
    of Sound and Vibration, 43(1), 45-52.

    Examples
    --------
    >>> beal_controlled(0.5, 0.3).control.gains[0].gain
    0.5
    """
    return Vehicle(
        title="Beal's missile with directional control",
        units="nondimensional",
        stages=[beam()],
        sensors=[Sensor(name="imu", station=station)],
        control=Control(gains=[Gain(sensor="imu", quantity="slope", gain=gain)]),
    )


def park_mote(mass_ratio: float, station: float, rotary_inertia: float = 0.0) -> Vehicle:
    """Park & Mote's missile: Beal's with a concentrated mass.

    Without the directional control of the paper. A mass of a tenth of the beam's lowers the flutter load to 96.7183810
    at the nose and raises it to 139.072631 at three quarters of the length; heavier ones make it diverge. Computed
    values.

    Parameters
    ----------
    mass_ratio : float
        The concentrated mass over the mass of the beam.
    station : float
        Of the mass, as a share of the length from the nose.
    rotary_inertia : float
        Of the mass, over m L^3.

    Returns
    -------
    Vehicle

    References
    ----------
    Park, Y. P., Mote, C. D., 1985. The maximum controlled follower force on a free-free beam carrying a concentrated
    mass. Journal of Sound and Vibration, 98, 247-256.

    Examples
    --------
    >>> park_mote(1.0, 0.0).centre_of_mass
    0.25
    """
    return Vehicle(
        title="missile with a concentrated mass",
        units="nondimensional",
        stages=[beam()],
        point_masses=[PointMass(station=station, mass=mass_ratio, rotary_inertia=rotary_inertia)],
    )


def mladenov_sugiyama(
    station: float,
    rotational_stiffness: float = math.inf,
    shear_stiffness: float = math.inf,
    internal_damping: float = 0.0,
    rotational_damping: float = 0.0,
    shear_damping: float = 0.0,
    shear_axis: ShearAxis = "mean",
) -> Vehicle:
    """Mladenov & Sugiyama's missile: two viscoelastic beams on a viscoelastic rotational and shear joint.

    It flutters or diverges, depending on the joint's stiffness and on the internal damping (Mladenov & Sugiyama,
    1997); the loads that go with it here are computed ones.

    Parameters
    ----------
    station : float
        Of the joint, as a share of the length from the nose.
    rotational_stiffness, shear_stiffness : float
        k_r L/EI and k_s L^3/EI of the joint; infinite is rigid.
    internal_damping : float
        Kelvin-Voigt time constant of both beams, over sqrt(m L^4/EI).
    rotational_damping, shear_damping : float
        Of the joint's dashpots: stiffness times a time over sqrt(m L^4/EI).
    shear_axis : {"mean", "forward", "aft", "inertial"}
        Direction along which the joint slides.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If the station is not between 0 and 1, or a property is negative.

    References
    ----------
    Mladenov, K. A., Sugiyama, Y., 1997. Stability of a jointed free-free beam under end rocket thrust. Journal of Sound
    and Vibration, 199(1), 1-15.

    Examples
    --------
    >>> mladenov_sugiyama(0.75, rotational_stiffness=10.0).boundaries
    (0.0, 0.75, 1.0)
    """
    joint = Joint(
        rotational_stiffness=rotational_stiffness,
        shear_stiffness=shear_stiffness,
        rotational_damping=rotational_damping,
        shear_damping=shear_damping,
        shear_axis=shear_axis,
    )
    stages = divided(station, "station", internal_damping=internal_damping)
    return Vehicle(title="missile of two beams", units="nondimensional", stages=stages, joints=[joint])


def tsto(split: float, rotational_stiffness: float, shear_stiffness: float, shear_axis: ShearAxis = "mean") -> Vehicle:
    """Two-stage vehicle: a uniform free-free beam with a flexible joint.

    Irani & Kavianipour (2009) report flutter at P = 109.7 for a split of 0.6 and both stiffnesses 5000. Their shear
    spring is fixed in space (``shear_axis="inertial"``) and their basis of eight modes leaves out rigid motion; the
    converged load is then 109.34644, and 106.437231 with the mean axis, whose joint balances moments.

    Parameters
    ----------
    split : float
        Station of the joint as a share of the length.
    rotational_stiffness : float
        k_r L/EI of the joint.
    shear_stiffness : float
        k_s L^3/EI of the joint.
    shear_axis : {"mean", "forward", "aft", "inertial"}
        Direction along which the joint slides.

    Returns
    -------
    Vehicle
        With the sensor ``imu`` in the upper stage, at a fifth of its length.

    Raises
    ------
    ModelError
        If the split is not between 0 and 1, or a stiffness is negative.

    References
    ----------
    Irani, S., Kavianipour, O., 2009. Effects of a flexible joint on instability of a free-free jointed bipartite beam
    under the follower and transversal forces. Journal of Zhejiang University SCIENCE A. doi:10.1631/jzus.A0820621

    Examples
    --------
    >>> tsto(0.6, 5000.0, 5000.0).boundaries
    (0.0, 0.6, 1.0)
    """
    joint = Joint(rotational_stiffness=rotational_stiffness, shear_stiffness=shear_stiffness, shear_axis=shear_axis)
    return Vehicle(
        title="two-stage vehicle",
        units="nondimensional",
        stages=divided(split, "split", ("upper", "lower")),
        joints=[joint],
        sensors=[Sensor(name="imu", station=0.2 * split)],
    )
