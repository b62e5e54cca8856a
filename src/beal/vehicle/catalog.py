"""Vehicles from the literature, non-dimensional: EI = m = L = 1."""

from beal.errors import ModelError
from beal.vehicle.parts import Joint, PointMass, Sensor, ShearAxis, Stage, Support
from beal.vehicle.vehicle import Vehicle


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
    return Vehicle(
        title="Beck's column",
        units="nondimensional",
        stages=[_beam(1.0)],
        support=Support(nose="clamped"),
    )


def beal() -> Vehicle:
    """Beal's missile: a uniform free-free beam under a follower force at the tail.

    Flutter of modes 1 and 2 at P = 109.9 (Beal, 1965, as Irani & Kavianipour, 2009, quote it); more exactly
    109.689191958738, at an angular frequency of 23.0733299.

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
    return Vehicle(title="Beal's missile", units="nondimensional", stages=[_beam(1.0)])


def pflueger(mass_ratio: float) -> Vehicle:
    """Pflüger's column: Beck's with a point mass at the tail.

    Flutter of modes 1 and 2 at P = 17.595282, 16.061562 and 16.212129 for mass ratios of 0.1, 0.5 and 1. These are
    computed values (exact transfer matrices and finite elements agree), not published ones.

    Parameters
    ----------
    mass_ratio : float
        The point mass over the mass of the beam.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If the ratio is negative or not a number.

    References
    ----------
    Pflüger, A., 1955. Zur Stabilität des tangential gedrückten Stabes. Zeitschrift für angewandte Mathematik und
    Mechanik, 35(5), 191.

    Examples
    --------
    >>> pflueger(0.5).mass
    1.5
    """
    return Vehicle(
        title="Pflüger's column",
        units="nondimensional",
        stages=[_beam(1.0)],
        point_masses=[PointMass(station=1.0, mass=mass_ratio)],
        support=Support(nose="clamped"),
    )


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
    if not 0 < split < 1:
        raise ModelError([("split", f"must lie between 0 and 1, found {split}")])
    joint = Joint(rotational_stiffness=rotational_stiffness, shear_stiffness=shear_stiffness, shear_axis=shear_axis)
    return Vehicle(
        title="two-stage vehicle",
        units="nondimensional",
        stages=[_beam(split, "upper"), _beam(1.0 - split, "lower")],
        joints=[joint],
        sensors=[Sensor(name="imu", station=0.2 * split)],
    )


def _beam(length: float, name: str = "") -> Stage:
    return Stage(name=name, length=length, mass_per_length=1.0, bending_stiffness=1.0)
