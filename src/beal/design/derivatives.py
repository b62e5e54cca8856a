"""How the matrices of a vehicle change with one of its quantities.

The matrices are smooth functions of every quantity, known to rounding. A stencil of sixth order over some percent of
the quantity therefore gives their derivatives to about 1e-12, and what they are contracted with is exact: no root is
ever found again. The coordinates move with the vehicle. Roots do not depend on coordinates, so the derivative of a root
is right as long as all matrices are differentiated in the same moving coordinates, as they are here.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.pencil import Pencil
from beal.vehicle.paths import paths, value_at, with_values
from beal.vehicle.vehicle import Scales, Vehicle

Array = NDArray[np.float64]
STEP = 1e-2  # of the value
FIRST_STEP = 1e-3  # of its natural size, from zero or infinity
SHRUNK = (1.0, 0.1, 0.01, 0.001)  # steps that are tried where longer ones reach the end of a segment
SETTLED = 1e-7  # relative difference of two formulas that ends the search for a better step
STRETCH = 1.05  # ratio of a segment's lengths above which the stencil is too wide for it

WITHOUT_EFFECT = ("sensor", "force", "control", "timeline", "thrust.nominal")

Solve = Callable[[Vehicle], NDArray[Any]]
Problem = Callable[[Operators], Pencil]


@dataclass(frozen=True)
class Stencil:
    """Offsets in steps, the weights of the first derivative, and those of a formula of lower order beside it."""

    offsets: tuple[int, ...]
    weights: tuple[float, ...]
    coarse: tuple[float, ...]


CENTRAL = Stencil(
    (-3, -2, -1, 1, 2, 3),
    (-1 / 60, 9 / 60, -45 / 60, 45 / 60, -9 / 60, 1 / 60),
    (0.0, 1 / 12, -8 / 12, 8 / 12, -1 / 12, 0.0),
)
FORWARD = Stencil(
    (0, 1, 2, 3, 4, 5, 6),
    (-49 / 20, 6.0, -15 / 2, 20 / 3, -15 / 4, 6 / 5, -1 / 6),
    (-137 / 60, 5.0, -5.0, 10 / 3, -5 / 4, 1 / 5, 0.0),
)
BACKWARD = Stencil(
    tuple(-n for n in FORWARD.offsets), tuple(-w for w in FORWARD.weights), tuple(-w for w in FORWARD.coarse)
)


class Movable(Protocol):
    """Something about a vehicle that can be changed: one of its quantities, or several that move together."""

    @property
    def path(self) -> str:
        """Of the quantity, or of that which the others follow."""

    @property
    def value(self) -> float:
        """Where it is."""

    @property
    def step(self) -> float:
        """By which it is changed."""

    def moved(self, distance: float) -> Vehicle:
        """The vehicle with it changed."""


@dataclass(frozen=True)
class Quantity:
    """One quantity of a vehicle as a variable; where it is infinite, its reciprocal is the variable.

    Parameters
    ----------
    vehicle : Vehicle
    path : str
    """

    vehicle: Vehicle
    path: str

    @property
    def value(self) -> float:
        """In SI units, or non-dimensional where the vehicle is."""
        return value_at(self.vehicle, self.path)

    @property
    def step(self) -> float:
        """Of the variable."""
        if math.isinf(self.value):
            return FIRST_STEP / natural_size(self.path, self.vehicle.scales)
        return STEP * abs(self.value) or FIRST_STEP * natural_size(self.path, self.vehicle.scales)

    def moved(self, distance: float) -> Vehicle:
        """The vehicle with the variable changed."""
        if distance == 0.0:
            return self.vehicle
        value = self.value
        return with_values(self.vehicle, {self.path: 1 / distance if math.isinf(value) else value + distance})


def bare(vehicle: Vehicle) -> Vehicle:
    """The vehicle without what only moves or reads it, whose stations would not follow its length."""
    return vehicle.model_copy(update={"forces": (), "sensors": (), "control": None})


def influential(vehicle: Vehicle) -> list[str]:
    """Paths of the quantities on which critical thrusts and frequencies may depend."""
    return [path for path in paths(vehicle) if not path.startswith(WITHOUT_EFFECT)]


def quantities_of(vehicle: Vehicle, chosen: Iterable[str] | None = None) -> list[Quantity]:
    """The quantities at paths, all that matter by default, of the bare vehicle."""
    quantities = []
    for path in influential(vehicle) if chosen is None else chosen:
        value_at(vehicle, path)
        if path.startswith(WITHOUT_EFFECT):
            raise ModelError([(path, "has no effect on critical thrusts and frequencies")])
        quantities.append(Quantity(bare(vehicle), path))
    return quantities


@dataclass(frozen=True)
class Change:
    """A vehicle's operators along a quantity, from which the derivatives of all that is made of them follow.

    Parameters
    ----------
    operators : tuple of Operators
        At the offsets of the stencil.
    stencil : Stencil
    step : float
    """

    operators: tuple[Operators, ...]
    stencil: Stencil
    step: float

    @property
    def one_sided(self) -> bool:
        """Whether the quantity can go to one side only."""
        return self.stencil is not CENTRAL

    def of(self, problem: Problem) -> tuple[Pencil, Pencil]:
        """Derivatives of the matrices of a problem, by the stencil and by that of lower order."""
        pencils = [problem(operators) for operators in self.operators]
        fine, coarse = (
            _combined(pencils, np.array(weights) / self.step) for weights in (self.stencil.weights, self.stencil.coarse)
        )
        return fine, coarse


def changes(quantity: Movable, build: Callable[[Vehicle], Operators], here: Operators) -> Iterator[Change]:
    """The operators along a quantity, over shorter and shorter steps, where the coordinates stay those of ``here``.

    They do not where a rigid joint becomes flexible, or a mass at an end gets a segment behind it.
    """
    if math.isinf(quantity.value):
        return
    for stencil in (CENTRAL, FORWARD, BACKWARD):
        for share in SHRUNK:
            step = share * quantity.step
            try:
                there = tuple(build(quantity.moved(offset * step)) for offset in stencil.offsets)
            except ModelError:
                break  # beyond what is allowed: to the other side
            if all(_alike(here, other) for other in there):
                yield Change(there, stencil, step)


def differences(quantity: Movable, solve: Solve) -> tuple[NDArray[Any], NDArray[Any]] | None:
    """One-sided derivatives of what ``solve`` finds, and by the formula of lower order; None where it finds nothing.

    Of the steps that are tried, and of both sides where both are allowed, those on which the formulas agree best.
    """
    tried = []
    for stencil in (FORWARD, BACKWARD):
        for share in SHRUNK:
            step = share * quantity.step
            try:
                found = np.array([solve(quantity.moved(offset * step)) for offset in stencil.offsets])
            except (ModelError, ConvergenceError):
                continue
            fine, coarse = (np.tensordot(weights, found, 1) / step for weights in (stencil.weights, stencil.coarse))
            tried.append((fine, coarse))
            if np.all(np.abs(fine - coarse) <= SETTLED * np.abs(fine)):
                return fine, coarse
    return min(tried, key=lambda each: float(np.abs(each[0] - each[1]).max()), default=None)


def slope(quantity: Movable, function: Callable[[Vehicle], float]) -> float:
    """Derivative of what changes smoothly with a quantity, such as the mass."""
    for stencil in (CENTRAL, FORWARD, BACKWARD):
        try:
            there = [function(quantity.moved(offset * quantity.step)) for offset in stencil.offsets]
        except ModelError:
            continue  # beyond what is allowed: to the other side
        return float(np.dot(stencil.weights, there)) / quantity.step
    raise ModelError([(quantity.path, "can be changed to neither side")])


def mass(vehicle: Vehicle) -> float:
    """In kg."""
    return vehicle.mass


def natural_size(path: str, scales: Scales) -> float:
    """What counts as one of a quantity: the product of powers of the vehicle's length, mass and time."""
    name = path.rpartition(".")[2]
    if path.startswith("joint") and name == "shear_stiffness":
        name = "translation"
    length, mass, time = scales.length, scales.mass_per_length * scales.length, scales.time
    powers = SIZES.get(name, (0, 0, 0))
    return length ** powers[0] * mass ** powers[1] * time ** powers[2]


SIZES = {  # powers of length, mass and time
    "length": (1, 0, 0),
    "station": (1, 0, 0),
    "mass": (0, 1, 0),
    "mass_per_length": (-1, 1, 0),
    "rotary_inertia": (2, 1, 0),
    "rotary_inertia_per_length": (1, 1, 0),
    "bending_stiffness": (3, 1, -2),
    "shear_stiffness": (1, 1, -2),
    "foundation_stiffness": (-1, 1, -2),
    "rotational_stiffness": (2, 1, -2),
    "rotation": (2, 1, -2),
    "translation": (0, 1, -2),
    "internal_damping": (0, 0, 1),
    "external_damping": (-1, 1, -1),
    "rotational_damping": (2, 1, -1),
    "shear_damping": (0, 1, -1),
    "force": (1, 1, -2),
    "nominal": (1, 1, -2),
    "gravity": (1, 0, -2),
}


def _alike(here: Operators, there: Operators) -> bool:
    """Whether two vehicles have the same segments, each about as long."""
    ours, theirs = here.basis.segments, there.basis.segments
    if here.M.shape != there.M.shape or [s.stage for s in ours] != [s.stage for s in theirs]:
        return False
    if (here.C is None, here.dead is None) != (there.C is None, there.dead is None):
        return False
    return all(1 / STRETCH < a.length / b.length < STRETCH for a, b in zip(ours, theirs, strict=True))


def _combined(pencils: Sequence[Pencil], weights: Array) -> Pencil:
    """The weighted sum of the matrices of pencils."""

    def total(name: str) -> Any:
        there = [getattr(each, name) for each in pencils]
        return None if there[0] is None else np.tensordot(weights, there, 1)

    return replace(pencils[0], **{name: total(name) for name in ("K0", "K1", "M", "C", "dead")})
