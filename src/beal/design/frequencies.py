"""Derivatives of the elastic frequencies under a thrust with respect to every quantity of a vehicle."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from beal.design.branches import builder
from beal.design.derivatives import Array, Movable, bare, changes, differences, quantities_of
from beal.discretisation.build import Formulation
from beal.discretisation.operators import Operators
from beal.stability.pencil import ComplexArray, Pencil, pencil
from beal.stability.spectrum import spectrum
from beal.stability.threads import one_thread
from beal.study.flight import vehicle_at
from beal.vehicle.vehicle import Vehicle

DOUBLE = 1e-9  # (y^T M x)^2 / (y^T y x^T x of M) below which a root is double and has no derivative


@dataclass(frozen=True)
class FrequencySensitivity:
    """Derivatives of elastic roots s, i omega where nothing is damped, at one thrust.

    Parameters
    ----------
    thrust : float
        In N.
    s : ndarray, shape (modes,)
        The roots with Im s >= 0 in order of frequency, in rad/s.
    paths : tuple of str
    values : ndarray, shape (paths,)
    derivatives : ndarray, shape (paths, modes)
        Of the roots, complex; with respect to 1/value where a value is infinite. They are nan where two roots meet, and
        where the vehicle allows no change of the quantity.
    """

    thrust: float
    s: ComplexArray
    paths: tuple[str, ...]
    values: Array
    derivatives: ComplexArray

    @property
    def angular_frequency(self) -> Array:
        """In rad/s, shape (modes,)."""
        return np.asarray(self.s.imag)

    @property
    def frequency_derivative(self) -> Array:
        """Of the angular frequencies, shape (paths, modes)."""
        return np.asarray(self.derivatives.imag)

    @property
    def growth_derivative(self) -> Array:
        """Of the growth rates Re s, shape (paths, modes)."""
        return np.asarray(self.derivatives.real)

    @property
    def elasticity(self) -> Array:
        """Percent of frequency per percent of the quantity, shape (paths, modes)."""
        finite = np.where(np.isfinite(self.values), self.values, 0.0)
        return np.asarray(self.frequency_derivative * finite[:, None] / self.angular_frequency)


def frequency_sensitivity(
    vehicle: Vehicle,
    thrust: float = 0.0,
    paths: Iterable[str] | None = None,
    count: int = 4,
    formulation: Formulation = "objective",
    time: float | None = None,
) -> FrequencySensitivity:
    """Exact derivatives of the elastic frequencies, and of the damping, under a thrust.

    With left and right vectors of s^2 M + s C + K,

        s' = - y^T (s^2 M' + s C' + K') x / (y^T (2 s M + C) x)

    Parameters
    ----------
    vehicle : Vehicle
    thrust : float
        In N.
    paths : iterable of str, optional
        By default all that the vehicle has and that may have an effect.
    count : int
        Number of modes.
    formulation : {"objective", "converged"}
    time : float, optional
        In s: of the vehicle as it flies at a time of its timeline, under the thrust given.

    Returns
    -------
    FrequencySensitivity

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or more modes are asked for than there are.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> found = frequency_sensitivity(catalog.beck(), 0.0, ["stage[0].bending_stiffness"], count=2)
    >>> found.elasticity.round(9).tolist()
    [[0.5, 0.5]]
    """
    quantities = quantities_of(vehicle, paths)
    names = tuple(quantity.path for quantity in quantities)
    values = np.array([quantity.value for quantity in quantities])

    def flown(moved: Vehicle) -> Vehicle:
        return moved if time is None else vehicle_at(moved, time)

    now = flown(bare(vehicle))
    discretised = builder(now, formulation)
    with one_thread():
        operators = discretised(now)
        everything = np.ones(len(operators.M), dtype=bool)

        def problem(each: Operators) -> Pencil:
            return pencil(each, everything)

        full = problem(operators)
        roots = _roots(operators, thrust, count)
        vectors = [_vectors(full, thrust, s) for s in roots]
        rows = []
        for quantity in quantities:
            moves = next(changes(quantity, lambda moved: discretised(flown(moved)), operators), None)
            if moves is None:
                rows.append(_from_one_side(quantity, roots, lambda moved: discretised(flown(moved)), thrust))
            else:
                turned = moves.of(problem)[0]
                rows.append(np.array([_root(turned, thrust, s, *pair) for s, pair in zip(roots, vectors, strict=True)]))
    return FrequencySensitivity(thrust, roots, names, values, np.array(rows).reshape(len(names), len(roots)))


def _roots(operators: Operators, thrust: float, count: int) -> ComplexArray:
    """In order of frequency."""
    found = spectrum(operators, thrust, count)
    roots = 1j * np.sqrt(found.W.astype(complex)) if found.s is None else found.s.astype(complex)
    return roots[np.argsort(np.abs(roots.imag), kind="stable")]


def _from_one_side(
    quantity: Movable, roots: ComplexArray, build: Callable[[Vehicle], Operators], thrust: float
) -> ComplexArray:
    """Derivatives where the vehicle gets a coordinate that it does not have here."""

    def nearest(vehicle: Vehicle) -> ComplexArray:
        there = _roots(build(vehicle), thrust, len(roots))
        return there[np.abs(there - roots[:, None]).argmin(axis=1)]

    sides = differences(quantity, nearest)
    return np.full(len(roots), complex(math.nan, math.nan)) if sides is None else sides[0]


def _vectors(full: Pencil, thrust: float, s: complex) -> tuple[ComplexArray, ComplexArray]:
    """Null vectors of the dynamic stiffness, scaled so that y^T (2 s M + C) x = 1; nan where the root is double."""
    dynamic = full.stiffness(thrust) + s**2 * full.M + (0.0 if full.C is None else s * full.C)
    u, _, vh = scipy.linalg.svd(dynamic)
    x, y = vh[-1].conj(), u[:, -1].conj()
    feed = 2 * s * full.M + (0.0 if full.C is None else full.C)
    scale = y @ feed @ x
    size = 2 * abs(s) * math.sqrt(abs((x.conj() @ full.M @ x) * (y.conj() @ full.M @ y)))
    return x, y / scale if abs(scale) > DOUBLE * size else np.full_like(y, math.nan)


def _root(change: Pencil, thrust: float, s: complex, x: ComplexArray, y: ComplexArray) -> complex:
    turned = change.stiffness(thrust) + s**2 * change.M + (0.0 if change.C is None else s * change.C)
    return complex(-(y @ turned @ x))
