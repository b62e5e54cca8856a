"""How a quantity is computed, each in two ways.

A critical thrust comes from polynomials and, second, from cubic finite elements extrapolated to vanishing size. Where
few modes or elements are part of the question the second way is the complete search. A limit of vanishing damping comes
from the undamped modes and, second, from two small dampings, extrapolated to none.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from beal.control import ClosedLoop, ControlledThrust, closed_loop, controlled_thrust
from beal.control.loop import loop
from beal.discretisation.build import RITZ, BasisName, Formulation, discretise
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.modes import converged_modes
from beal.stability.pencil import Array
from beal.stability.spectrum import spectrum
from beal.stability.vanishing import vanishing_damping_limit
from beal.vehicle.parts import Joint, Stage
from beal.vehicle.vehicle import Vehicle

FINER = (14, 18)  # orders of the polynomials that a flutter frequency is compared with
SAMPLED = 3  # times the largest of a few differences, which the error may well be
ROUNDING = 1e-12  # of frequencies, beside the largest
ELEMENTS = (24, 48)
SMALL = 1e-3  # share of the damping from which its limit is extrapolated


@dataclass(frozen=True)
class Measured:
    """A quantity, its error estimate, and the same found in a second way; nan where it was not found."""

    value: float = math.nan
    error_estimate: float = math.nan
    second: float = math.nan


Measure = Callable[[Vehicle], dict[str, Measured]]


def critical(vehicle: Vehicle, formulation: Formulation = "objective") -> dict[str, Measured]:
    """The critical thrust and, of flutter, the frequency; under names that say the kind."""
    found = critical_thrust(vehicle, formulation=formulation)
    if formulation in RITZ:
        second = critical_thrust(vehicle, formulation=formulation, method="complete")
        return _compared(found, _point(second, found.kind), [second], suffix(formulation))
    second = critical_thrust(vehicle, formulation=formulation, basis="hermite")
    peers = [critical_thrust(discretise(vehicle, formulation, order=n), formulation=formulation) for n in FINER]
    return _compared(found, _point(second, found.kind), peers, suffix(formulation))


def in_elements(vehicle: Vehicle, count: int) -> dict[str, Measured]:
    """The same in so many cubic elements, far from converged."""
    operators = discretise(vehicle, basis="hermite", order=count)
    found, second = critical_thrust(operators), critical_thrust(operators, method="complete")
    return _compared(found, _point(second, found.kind), [second], f", {count} cubic elements")


def vanishing(vehicle: Vehicle) -> dict[str, Measured]:
    """The limit of the critical thrust as all damping vanishes, and the frequency of flutter there."""
    found = vanishing_damping_limit(vehicle)
    far, near = (
        np.array(_point(critical_thrust(_less_damped(vehicle, share)), found.kind)) for share in (SMALL, SMALL / 2)
    )
    thrust, omega = (near + (near - far) / 3).tolist()  # the distance is quadratic in the damping
    return _compared(found, (thrust, omega), [found], ", vanishing damping")


def frequencies(vehicle: Vehicle, thrust: float, count: int) -> dict[str, Measured]:
    """The lowest angular frequencies at a thrust below the critical one."""
    found, change = converged_modes(vehicle, thrust, count)
    coarse, fine = (
        np.sort(spectrum(discretise(vehicle, basis="hermite", order=n), thrust, count).angular_frequency)
        for n in ELEMENTS
    )
    second = fine + (fine - coarse) / 15  # the error is of fourth order
    omega = np.sort(found.angular_frequency)
    error = (0.0 if change is None else change) + ROUNDING * omega[-1]
    rows = zip(omega.tolist(), error.tolist(), second.tolist(), strict=True)
    return {frequency_name(number, thrust): Measured(*row) for number, row in enumerate(rows, 1)}


def controlled(vehicle: Vehicle) -> dict[str, Measured]:
    """The largest thrust with the control law closed, of a law without damping and delay, and the frequency there."""
    found = controlled_thrust(vehicle)

    def fixed(basis: BasisName, order: int) -> CriticalThrust:
        return critical_thrust(loop(discretise(vehicle, basis=basis, order=order)).closed())

    coarse, fine = (np.array(_point(fixed("hermite", n), found.kind)) for n in ELEMENTS)
    thrust, omega = (fine + (fine - coarse) / 15).tolist()
    return _compared(found, (thrust, omega), [fixed("legendre", n) for n in FINER], ", controlled")


def controlled_frequencies(vehicle: Vehicle, thrust: float, count: int) -> dict[str, Measured]:
    """The lowest angular frequencies of the closed loop at a thrust, the attitude's first."""

    def upper(found: ClosedLoop) -> Array:
        return np.sort(found.roots.imag[found.roots.imag > 0])[:count]

    found = closed_loop(vehicle, thrust, count)
    coarse, fine = (upper(closed_loop(discretise(vehicle, basis="hermite", order=n), thrust, count)) for n in ELEMENTS)
    omega, second = upper(found), fine + (fine - coarse) / 15
    error = float(found.error_estimate.max()) + ROUNDING * float(omega[-1])
    rows = zip(omega.tolist(), second.tolist(), strict=True)
    return {
        frequency_name(number, thrust) + ", controlled": Measured(value, error, other)
        for number, (value, other) in enumerate(rows, 1)
    }


def frequency_name(number: int, thrust: float) -> str:
    """What the frequency of a mode at a thrust is called."""
    return f"frequency {number} at P = {thrust:.6g}"


def suffix(formulation: Formulation) -> str:
    """What a quantity is called by beside its own name, unless the formulation is the default."""
    return "" if formulation == "objective" else f", {formulation}"


def _compared(
    found: CriticalThrust | ControlledThrust, second: tuple[float, float], peers: list[CriticalThrust], note: str = ""
) -> dict[str, Measured]:
    """Thrust and frequency beside their second values; what peers move is part of the error."""
    thrust, omega = _point(found, found.kind)
    moved = np.abs(np.array([_point(peer, found.kind) for peer in peers]) - (thrust, omega)).max(axis=0).tolist()
    estimate = found.error_estimate or 0.0
    measured = {f"{found.kind} thrust{note}": Measured(thrust, estimate + moved[0], second[0])}
    if found.kind == "flutter":
        error = SAMPLED * moved[1] + omega * (estimate / thrust + ROUNDING)
        measured[f"flutter frequency{note}"] = Measured(omega, error, second[1])
    return measured


def _point(found: CriticalThrust | ControlledThrust, kind: str) -> tuple[float, float]:
    """Thrust and frequency of an instability of this kind."""
    thrust, omega = found.critical_thrust, found.angular_frequency
    return (math.nan, math.nan) if thrust is None or omega is None or found.kind != kind else (thrust, omega)


def _less_damped(vehicle: Vehicle, share: float) -> Vehicle:
    """The vehicle with a share of the damping of its stages and joints."""

    def lessened(part: Stage | Joint, *names: str) -> Any:
        return part.model_copy(update={name: share * getattr(part, name) for name in names})

    stages = tuple(lessened(stage, "internal_damping", "external_damping") for stage in vehicle.stages)
    joints = tuple(lessened(joint, "rotational_damping", "shear_damping") for joint in vehicle.joints)
    return vehicle.model_copy(update={"stages": stages, "joints": joints})
