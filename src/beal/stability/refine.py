"""From a critical point of a reduced problem to that of the vehicle, with an estimate of what is left of the error."""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from beal.discretisation.build import BasisName, Formulation, discretise
from beal.errors import ConvergenceError
from beal.stability.damped import with_rates
from beal.stability.double_root import CriticalPoint, coalescence, divergence
from beal.stability.imaginary_root import imaginary_root
from beal.stability.pencil import Pencil, pencil, reduced
from beal.stability.ridge import Instability, Kind
from beal.stability.zero_roots import rigid_body_root
from beal.vehicle.vehicle import Vehicle

FIRST_ORDER = {"legendre": 8, "hermite": 8}
SHEARED_ORDER = {"legendre": 16, "hermite": 8}  # shear waves are shorter than those of bending
LAST_ORDER = {"legendre": 26, "hermite": 64}
TOLERANCE = {"legendre": 1e-10, "hermite": 1e-6}
SHEARED_TOLERANCE = 1e-9  # modes of shear and of bending may be coupled so weakly that rounding leaves more
MODAL_TOLERANCE = 1e-8  # where damping ratios reach up to modes that no discretisation resolves
LEAST_TOLERANCE = 1e-7  # relative error that is told, not refused, where none was asked for
FALLING = 0.3  # ratio of successive corrections below which they count as a geometric sequence
STEADY = 1e-2  # ratio that the next correction is not trusted to fall below: one of 1/1000 was followed by one of 1/170
SAMPLED = 3  # times the larger of two differences that are rounding, which the error may well be


def first_order(vehicle: Vehicle, basis: BasisName) -> int:
    """Order that resolves the watched modes well enough to find their instabilities."""
    return (SHEARED_ORDER if vehicle.shears else FIRST_ORDER)[basis]


def default_tolerance(vehicle: Vehicle, basis: BasisName) -> float:
    """Relative error of the critical thrust that is reached without effort."""
    modal = MODAL_TOLERANCE if any(vehicle.damping.ratios) else 0.0
    return max(TOLERANCE[basis], modal, SHEARED_TOLERANCE if vehicle.shears else 0.0)


def polish(full: Pencil, kind: Kind, thrust: float, W: float) -> CriticalPoint:
    """The critical point of a full pencil next to a guess."""
    if full.C is not None:
        return imaginary_root(full, thrust, W) if kind == "flutter" else divergence(with_rates(full), thrust)
    if kind == "flutter":
        return coalescence(full, thrust, W)
    return divergence(full, thrust, rigid_body_root(reduced(full), thrust) == "neutral")


def settled(found: Instability, full: Pencil) -> tuple[CriticalPoint, float]:
    """The critical point of one discretisation, with what rounding leaves uncertain."""
    if found.point.thrust == 0.0:  # a mechanism
        return found.point, 0.0
    point = polish(full, found.kind, found.point.thrust, found.point.W)
    return point, point.uncertainty


def refined(
    found: Instability, points: Iterable[CriticalPoint], tolerance: float, least: float = 0.0
) -> tuple[CriticalPoint, float]:
    """The first of ever finer discretisations' critical points whose own error estimate meets the tolerance.

    The finest one will do with a larger error, the least accuracy that is needed: modes that are coupled so weakly that
    they only just meet leave the thrust at which they do to rounding.
    """
    if found.point.thrust == 0.0:
        return found.point, 0.0
    thrusts: list[float] = []
    error = math.inf
    for point in points:
        thrusts.append(point.thrust)
        if len(thrusts) < 3:
            continue
        before, last = abs(thrusts[-2] - thrusts[-3]), abs(thrusts[-1] - thrusts[-2])
        error = _remaining(before, last, point.uncertainty) + point.uncertainty
        if error <= tolerance * point.thrust:
            return point, error
    if error <= least * point.thrust:
        return point, error
    raise ConvergenceError(
        f"critical thrust {point.thrust:.9g}: relative error {error / point.thrust:.1e} with the finest "
        f"discretisation, {tolerance:.1e} was asked for; ask for less"
    )


def _remaining(before: float, last: float, rounding: float) -> float:
    """Error left after two successive corrections: that of a geometric sequence, or of rounding, sampled twice."""
    if last >= FALLING * before:
        return SAMPLED * max(last, before)
    return last * max(last / before, STEADY) if last > rounding else SAMPLED * last


Polish = Callable[[Pencil, Kind, float, float], CriticalPoint]


def ladder(
    vehicle: Vehicle, formulation: Formulation, basis: BasisName, found: Instability, polish: Polish = polish
) -> Iterator[CriticalPoint]:
    """The critical point in finer and finer discretisations, each started from the one before."""
    thrust, W = found.point.thrust, found.point.W
    order = first_order(vehicle, basis)
    coarse = None
    while order <= LAST_ORDER[basis]:
        full = pencil(discretise(vehicle, formulation, basis, order))
        point = polish(full, found.kind, thrust, W)
        if not point.converged:
            raise ConvergenceError(f"critical thrust near {thrust:.9g}: lost when the discretisation was refined")
        thrust, W = point.thrust, point.W
        if basis == "legendre":
            order += 2
            yield point
        else:
            order *= 2  # errors fall with the fourth power of the element: Richardson
            if coarse is not None:
                extrapolated = (thrust + (thrust - coarse.thrust) / 15, W + (W - coarse.W) / 15)
                yield replace(point, thrust=extrapolated[0], W=extrapolated[1])
            coarse = point
