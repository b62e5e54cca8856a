"""Columns under other loads than Beck's."""

from beal.vehicle.catalog.uniform import beam
from beal.vehicle.parts import DistributedThrust, HeldEnd, PointMass, Support, Thrust
from beal.vehicle.stations import LoadTable
from beal.vehicle.vehicle import Vehicle

NO_END_THRUST = Thrust(scale=0.0)


def pflueger(
    mass_ratio: float, rotary_inertia: float = 0.0, internal_damping: float = 0.0, external_damping: float = 0.0
) -> Vehicle:
    """Pflüger's column: Beck's with a point mass at the tail.

    Flutter of modes 1 and 2 at P = 17.595282, 16.061562 and 16.212129 for mass ratios of 0.1, 0.5 and 1. These are
    computed values (exact transfer matrices and finite elements agree), not published ones. A vanishing external
    damping, which leaves Beck's column alone, lowers these loads (Tommasini et al., 2016).

    Parameters
    ----------
    mass_ratio : float
        The point mass over the mass of the beam.
    rotary_inertia : float
        Of the point mass, over m L^3.
    internal_damping, external_damping : float
        As in `beck_damped`.

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
    Tommasini, M., Kirillov, O. N., Misseroni, D., Bigoni, D., 2016. The destabilizing effect of external damping:
    singular flutter instability for the Pflüger column with vanishing external dissipation. Journal of the Mechanics
    and Physics of Solids, 91, 204-215.

    Examples
    --------
    >>> pflueger(0.5).mass
    1.5
    """
    return Vehicle(
        title="Pflüger's column",
        units="nondimensional",
        stages=[beam(internal_damping=internal_damping, external_damping=external_damping)],
        point_masses=[PointMass(station=1.0, mass=mass_ratio, rotary_inertia=rotary_inertia)],
        support=Support(nose="clamped"),
    )


def reut() -> Vehicle:
    """Reut's column: clamped at the nose, a force along the axis of the straight column on a rigid plate at the tail.

    Its equations are the adjoint of Beck's: the flutter load and the frequency are the same, the motions are not.

    Returns
    -------
    Vehicle

    References
    ----------
    Reut, V. I., 1939. About the theory of elastic stability. Proceedings of the Odessa Institute of Civil and Communal
    Engineering, 1.

    Examples
    --------
    >>> reut().thrust.line
    'fixed'
    """
    return Vehicle(
        title="Reut's column",
        units="nondimensional",
        stages=[beam()],
        support=Support(nose="clamped"),
        thrust=Thrust(line="fixed"),
    )


def leipholz(nose: HeldEnd = "clamped", tail: HeldEnd = "free") -> Vehicle:
    """Leipholz's column: a uniform tangential load along it, borne by the nose.

    P is the load per length, q L^3/EI. Clamped and free it flutters at 40.0537365, held at both ends it diverges:
    pinned at 18.9562656 = 9/4 j^2, j the first zero of the Bessel function J of order 1/3. Computed values.

    Parameters
    ----------
    nose, tail : {"free", "clamped", "pinned", "sliding"}
        The tail moves freely along the axis, however it is held across it.

    Returns
    -------
    Vehicle

    References
    ----------
    Leipholz, H., 1962. Die Knicklast des einseitig eingespannten Stabes mit gleichmässig verteilter, tangentialer
    Längsbelastung. Zeitschrift für angewandte Mathematik und Physik, 13, 581-589.

    Examples
    --------
    >>> leipholz().distributed_thrusts[0].tangency
    1.0
    """
    return Vehicle(
        title="Leipholz's column",
        units="nondimensional",
        stages=[beam()],
        support=Support(nose=nose, tail=tail),
        thrust=NO_END_THRUST,
        distributed_thrusts=[DistributedThrust(value=1.0)],
    )


def hauger() -> Vehicle:
    """Hauger's column: clamped at the nose, a tangential load that falls linearly to zero at the free tail.

    P is the load per length at the clamp, q L^3/EI. Flutter at 150.641595, a computed value.

    Returns
    -------
    Vehicle

    References
    ----------
    Hauger, W., 1966. Die Knicklasten elastischer Stäbe unter gleichmässig verteilten und linear veränderlichen,
    tangentialen Druckkräften. Ingenieur-Archiv, 35, 221-229.

    Examples
    --------
    >>> hauger().distributed_thrusts[0].value.mean
    0.5
    """
    return Vehicle(
        title="Hauger's column",
        units="nondimensional",
        stages=[beam()],
        support=Support(nose="clamped"),
        thrust=NO_END_THRUST,
        distributed_thrusts=[DistributedThrust(value=LoadTable(x=(0.0, 1.0), value=(1.0, 0.0)))],
    )


def greenhill() -> Vehicle:
    """Greenhill's mast: a clamped column under its own weight.

    P is the weight per length, q L^3/EI. It buckles at 9/4 j^2 = 7.8373474, j the first zero of the Bessel function J
    of order -1/3.

    Returns
    -------
    Vehicle

    References
    ----------
    Greenhill, A. G., 1881. Determination of the greatest height consistent with stability that a vertical pole or mast
    can be made. Proceedings of the Cambridge Philosophical Society, 4, 65-73.

    Examples
    --------
    >>> greenhill().distributed_thrusts[0].tangency
    0.0
    """
    return Vehicle(
        title="Greenhill's mast",
        units="nondimensional",
        stages=[beam()],
        support=Support(nose="clamped"),
        thrust=NO_END_THRUST,
        distributed_thrusts=[DistributedThrust(value=1.0, tangency=0.0)],
    )


def euler(nose: HeldEnd, tail: HeldEnd) -> Vehicle:
    """Euler's columns: a dead load along the axis.

    Divergence at pi^2 (pinned at both ends), pi^2/4 (clamped and free), 4 pi^2 (clamped), 20.1907286 (clamped and
    pinned). How the frequencies fall with the load is in Bokaian (1988).

    Parameters
    ----------
    nose, tail : {"free", "clamped", "pinned", "sliding"}
        The tail moves freely along the axis, however it is held across it.

    Returns
    -------
    Vehicle

    References
    ----------
    Bokaian, A., 1988. Natural frequencies of beams under compressive axial loads. Journal of Sound and Vibration, 126,
    49-65.

    Examples
    --------
    >>> euler("pinned", "pinned").thrust.tangency
    0.0
    """
    return Vehicle(
        title="Euler's column",
        units="nondimensional",
        stages=[beam()],
        support=Support(nose=nose, tail=tail),
        thrust=Thrust(tangency=0.0),
    )
