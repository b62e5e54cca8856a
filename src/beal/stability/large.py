"""Reduction of vehicles too large for dense matrices: few vectors, found and corrected by static solutions.

The lowest modes come from a block Krylov space of static deflections under inertia, as Lanczos's method finds them;
then, as in `beal.stability.pencil.reduced`, what thrust changes in the lowest of them. A critical point of the
reduced problem is corrected by the static deflections under what its right and left vectors leave unbalanced, until
it settles: the error of a double root is the product of the two.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy.linalg

from beal.discretisation.basis import segments
from beal.discretisation.build import Formulation, check_formulation, inertial
from beal.discretisation.cuts import ALL
from beal.discretisation.linked import LinkedOperators, linked
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError
from beal.stability.double_root import CriticalPoint
from beal.stability.imaginary_root import vanishing_root
from beal.stability.limit import waves
from beal.stability.pencil import TWICE_CORRECTED, Array, Pencil, corrections, pencil
from beal.stability.refine import LAST_ORDER, polish
from beal.stability.ridge import Instability
from beal.stability.spectrum import Spectrum, spectrum
from beal.stability.unbalanced import unbalanced
from beal.vehicle.vehicle import Vehicle

SEGMENTS = 12  # from which the dense matrices take longer
WATCHED, MOST_WATCHED, SPARE = 8, 32, 3
BLOCK = 6  # vectors beside one for every mechanism, so that no repeated root is missed
SETTLED = 1e-6  # relative change of the watched inertias in a step of the Krylov space
INDEPENDENT = 1e-7  # share of a vector that must be new
NOISE = 1e-13  # correction of a unit vector that is rounding
CORRECTIONS = 12
EXACT = 3  # thrusts of a curve, at which its modes are exact
SAME = 1e-13  # relative change below which a point, or the roots beside the shift, have settled


def operators_over_thrust(vehicle: Vehicle, formulation: Formulation, to: float, count: int) -> Operators:
    """Dense operators of few coordinates that hold the lowest modes of a large vehicle over a range of thrust.

    Parameters
    ----------
    vehicle : Vehicle
    formulation : {"objective", "converged"}
    to : float
        Last thrust, in N.
    count : int
        Number of elastic modes.

    Returns
    -------
    Operators
        Exact at some thrusts; the vectors that belong to them leave some 1e-7 between.
    """
    found = Reduction(vehicle, formulation, count)
    found.refine()
    for thrust in np.linspace(0.0, to, EXACT):
        found.corrected_modes(float(thrust), count)
    return found.operators


def is_large(vehicle: Vehicle) -> bool:
    """Whether a vehicle has so many segments that its dense matrices take longer than their reduction.

    Damping ratios couple all coordinates, whose matrix then is not sparse. Rigid stages have none of their own.
    """
    return vehicle.deforms and len(segments(vehicle, few=ALL)) >= SEGMENTS and not any(vehicle.damping.ratios)


class Reduction:
    """A large vehicle in a few vectors, among them its lowest modes, to which corrections are added on the way.

    Parameters
    ----------
    vehicle : Vehicle
    formulation : {"objective", "converged"}
    modes : int
        Least number of elastic modes to hold.
    vanishing : bool
        Whether critical points are those of a damping that goes to zero.
    """

    def __init__(
        self, vehicle: Vehicle, formulation: Formulation, modes: int = WATCHED, vanishing: bool = False
    ) -> None:
        check_formulation(formulation)
        converged = formulation == "converged"
        self._vehicle = inertial(vehicle) if converged else vehicle
        self._vanishing = vanishing
        each = waves(vehicle)
        self._order = _first_order(each)
        self._top = _highest_root(vehicle, each)
        self.system = linked(self._vehicle, self._order)
        motions = self.system.motions
        self._motions, self._rigid = motions.shape[1], self.system.rigid
        self._left_out = self._rigid if converged else 0
        self._vectors = _extended(self.system, motions[:, :0], motions)
        self._add_modes(modes)

    @property
    def operators(self) -> Operators:
        """The dense operators in the vectors found so far."""
        return self.system.projected(self._vectors[:, self._left_out :], self._rigid - self._left_out)

    def points(self, found: Instability) -> Iterator[CriticalPoint]:
        """The critical point in finer and finer discretisations, each started from the one before."""
        point = found.point
        while True:
            point = self.corrected(replace(found, point=point))
            if not point.converged:
                raise ConvergenceError(f"critical thrust near {point.thrust:.9g}: lost when it was refined")
            yield point
            if not self.refine():
                return

    def spectra(self, thrust: float, count: int) -> Iterator[Spectrum]:
        """The lowest elastic modes at a thrust in finer and finer discretisations."""
        while True:
            yield self.corrected_modes(thrust, count)
            if not self.refine():
                return

    def refine(self) -> bool:
        """Go on to the next higher order, if there is one."""
        self._order += 2
        if self._order > LAST_ORDER["legendre"]:
            return False
        self.system = linked(self._vehicle, self._order)
        appended = self.system.M.shape[0] - len(self._vectors)
        self._vectors = np.vstack((self._vectors, np.zeros((appended, self._vectors.shape[1]))))
        return True

    def corrected(self, found: Instability) -> CriticalPoint:
        """The critical point next to a guess, corrected until it settles."""
        point = found.point
        for step in range(CORRECTIONS):
            full = pencil(self.operators)
            before, point = point, self._polished(full, replace(found, point=point))
            change = abs(point.thrust - before.thrust)
            if not point.converged or (step and change <= SAME * point.thrust):
                break
            known = self._vectors.shape[1]
            kept = self._vectors[:, known - len(full.M) :]
            for loads in unbalanced(self.system, kept, full, found.kind, point, self._vanishing):
                self._vectors = _extended(self.system, self._vectors, self.system.deflected(loads), NOISE)
            if self._vectors.shape[1] == known:
                return point
        return replace(point, uncertainty=point.uncertainty + change)

    def _polished(self, full: Pencil, guess: Instability) -> CriticalPoint:
        if self._vanishing:
            return vanishing_root(full, guess.point.thrust, guess.point.W)
        return polish(full, guess.kind, guess.point.thrust, guess.point.W)

    def corrected_modes(self, thrust: float, count: int) -> Spectrum:
        """The lowest elastic modes at a thrust, with the vectors that they need."""
        system = self.system
        before = np.full(count, np.inf, dtype=complex)
        for _ in range(CORRECTIONS):
            found = spectrum(self.operators, thrust, count)
            size = np.abs(found.W) + system.shift
            if np.all(np.abs(found.W - before) <= SAME * size):
                break
            before = found.W
            x = self._vectors[:, self._left_out :] @ (found.shapes / np.sqrt(size))
            left = system.stiffness(thrust) @ x - (system.M @ x) * found.W
            if found.s is not None:
                left = left + (system.C @ x) * found.s
            loads = np.hstack((left.real, left.imag))
            self._vectors = _extended(system, self._vectors, system.deflected(loads), NOISE)
        return found

    def _add_modes(self, least: int) -> None:
        """The lowest modes, and what thrust and damping change in the lowest of them."""
        system = self.system
        loose = sum((j.rotational_stiffness == 0) + (j.shear_stiffness == 0) for j in self._vehicle.joints)
        modes = self._lowest_modes(BLOCK + loose, least, max(least, MOST_WATCHED + loose))
        low = np.hstack((system.motions, modes[:, : corrections(self._vehicle, self.watched) + loose]))
        groups = [modes]
        sides = [side for load in (system.K1, system.dead) if load is not None for side in (load, load.T)]
        for side in [*sides, system.C] if self._vehicle.damped else sides:
            first = system.deflected(side @ low)
            groups += [first, system.deflected(side @ first[:, :TWICE_CORRECTED])]
        self._vectors = self._vectors[:, : self._motions]
        for group in groups:
            self._vectors = _extended(system, self._vectors, group)

    def _lowest_modes(self, block: int, least: int, most: int) -> Array:
        """Elastic modes of the unloaded vehicle: the watched ones and a few above."""
        system = self.system
        loads = np.random.default_rng(0).normal(size=(system.M.shape[0], block))
        before = np.zeros(0)
        while True:
            known = self._vectors.shape[1]
            self._vectors = _extended(system, self._vectors, system.deflected(system.M @ loads))
            loads = self._vectors[:, known:]
            elastic = self._vectors[:, self._rigid :]
            inertia, rotation = scipy.linalg.eigh(elastic.T @ (system.M @ elastic))
            inertia, rotation = inertia[::-1], rotation[:, ::-1]
            below = int(np.sum(inertia > 1 / (self._top + system.shift)))
            self.watched = min(max(below, least), most, len(inertia))
            first = inertia[: self.watched]
            settled = len(before) >= len(first) and np.all(np.abs(before[: len(first)] - first) < SETTLED * first)
            if settled or not loads.shape[1]:
                return np.asarray(elastic @ rotation[:, : self.watched + SPARE])
            before = inertia


def _first_order(each: Array) -> int:
    """Lowest order to begin with: the longest segment, measured in waves, decides."""
    return 2 + 2 * math.ceil(3 * float(each.max() / each.sum()) - 1e-9)


def _highest_root(vehicle: Vehicle, each: Array) -> float:
    """W below which the rigidly jointed vehicle would have ``WATCHED`` modes (WKB)."""
    smeared = vehicle.mass / sum(stage.mass for stage in vehicle.laden)  # the point masses
    return ((WATCHED + 0.5) * math.pi / float(each.sum())) ** 4 / smeared


def _extended(system: LinkedOperators, vectors: Array, added: Array, floor: float = 0.0) -> Array:
    """Vectors with what is new in the added ones, orthonormal in the static stiffness (Gram & Schmidt, twice).

    What is left of a vector has the rounding of the whole in its constraints, which are therefore restored. Added
    vectors below the floor, or all but zero beside the largest, are rounding throughout.
    """
    columns = np.hstack((vectors, np.empty((len(vectors), added.shape[1]))))
    count = vectors.shape[1]
    sizes = [_size(system, vector) for vector in added.T]
    for vector, size in zip(added.T, sizes, strict=True):
        if size <= max(floor, INDEPENDENT * max(sizes)):
            continue
        for _ in range(2):
            left = vector - columns[:, :count] @ (columns[:, :count].T @ (system.static @ vector))
            vector = system.admissible(left[:, None])[:, 0]
        new = _size(system, vector)
        if new > INDEPENDENT * size:
            columns[:, count] = vector / new
            count += 1
    return columns[:, :count]


def _size(system: LinkedOperators, vector: Array) -> float:
    return math.sqrt(vector @ (system.static @ vector))
