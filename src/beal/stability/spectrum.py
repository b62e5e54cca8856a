"""Free vibration of the loaded vehicle: frequencies, growth rates and mode shapes at one thrust."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.linalg

from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.shown import Shown
from beal.stability.damped_roots import NEUTRAL, damped_modes
from beal.stability.pencil import Array, ComplexArray, Pencil, pencil
from beal.stability.zero_roots import ZERO


@dataclass(frozen=True)
class Spectrum(Shown):
    """The lowest elastic modes at a thrust, undamped in order of frequency.

    Parameters
    ----------
    thrust : float
        In N.
    W : ndarray, shape (count,)
        Roots omega^2, complex in flutter and negative in divergence, in rad^2/s^2.
    shapes : ndarray, shape (n, count)
        Coordinates of the mode shapes, to be read with ``operators.shape(x) @ shapes``.
    rigid_body_modes : int
        Number of rigid-body motions of the unloaded vehicle, which are not listed.
    s : ndarray, shape (count,), or None
        Roots of a damped vehicle with Im s >= 0, in order of modulus, W being -s^2; an overdamped mode is there with
        both of its real roots. None where nothing is damped: s = sqrt(-W).
    units : {"SI", "nondimensional"}
    """

    thrust: float
    W: ComplexArray
    shapes: ComplexArray
    rigid_body_modes: int
    s: ComplexArray | None = None
    units: Literal["SI", "nondimensional"] = "SI"

    @property
    def angular_frequency(self) -> Array:
        """Im s of the root s = sqrt(-W), in rad/s, shape (count,)."""
        return np.abs(self._exponents.imag)

    @property
    def growth_rate(self) -> Array:
        """Re s, in 1/s, shape (count,); a coalesced pair has one positive and one negative."""
        return np.asarray(self._exponents.real)

    @property
    def _exponents(self) -> ComplexArray:
        return exponents(self.W) if self.s is None else self.s


def exponents(W: ComplexArray) -> ComplexArray:
    """The roots s of s^2 = -W with Im s >= 0, of a diverging pair the growing one; same shape as W."""
    s = np.sqrt(-W.astype(complex))
    return np.where(s.imag < 0, -s, s)


def spectrum(operators: Operators, thrust: float = 0.0, count: int = 6) -> Spectrum:
    """Lowest elastic modes of a vehicle at a constant thrust.

    Parameters
    ----------
    operators : Operators
    thrust : float
        In N.
    count : int
        Number of modes.

    Returns
    -------
    Spectrum

    Raises
    ------
    ModelError
        If more modes are asked for than the discretisation holds, or the thrust is not a finite number.

    Examples
    --------
    >>> from beal.discretisation.build import discretise
    >>> from beal.vehicle import catalog
    >>> spectrum(discretise(catalog.beal(), order=12), thrust=80.0, count=2).angular_frequency.round(5).tolist()
    [11.63004, 42.60333]
    """
    if not np.isfinite(thrust):
        raise ModelError(f"thrust: must be a finite number, found {thrust}")
    full = pencil(operators)
    elastic = len(full.M) - full.rigid
    if not 1 <= count <= elastic:
        raise ModelError(f"count: must lie between 1 and {elastic} for this discretisation, found {count}")
    if full.C is not None:
        return _damped(operators, full, thrust, count)
    W, shapes = elastic_modes(full, thrust, count)
    embedded = np.zeros((len(operators.M), count), dtype=complex)
    embedded[len(operators.M) - len(shapes) :] = shapes
    return Spectrum(float(thrust), W, embedded, operators.rigid, units=operators.vehicle.units)


def _damped(operators: Operators, full: Pencil, thrust: float, count: int) -> Spectrum:
    s, shapes = damped_modes(full, thrust, count + 2 * full.rigid)
    elastic = np.argsort(np.abs(s) < NEUTRAL * np.sqrt(full.shift), kind="stable")[:count]  # zero roots last
    embedded = np.zeros((len(operators.M), count), dtype=complex)
    embedded[len(operators.M) - len(shapes) :] = shapes[:, elastic]
    return Spectrum(float(thrust), -(s[elastic] ** 2), embedded, operators.rigid, s[elastic], operators.vehicle.units)


def elastic_modes(full: Pencil, thrust: float, count: int) -> tuple[ComplexArray, ComplexArray]:
    """The ``count`` roots of smallest real part without that of the rigid-body motion, with M-normalised vectors.

    The smallest root is that of the rigid-body motion, unless none is zero: the vehicle tumbles.
    """
    W, shapes = lowest(full, thrust, count + full.rigid)
    if not full.rigid:
        return W, shapes
    tumbles = np.abs(W).min() > ZERO * full.shift and W[0].real < -ZERO * full.shift
    rigid = 0 if tumbles else np.abs(W).argmin()
    return np.delete(W, rigid), np.delete(shapes, rigid, axis=1)


def lowest(full: Pencil, thrust: float, count: int) -> tuple[ComplexArray, ComplexArray]:
    """The ``count`` roots of smallest real part, with M-normalised right vectors.

    From the inverse (K + shift M)^-1 M, whose largest eigenvalues are the low modes: those of the stiffness itself
    would drown in the rounding of the highest polynomials.
    """
    shifted = full.stiffness(thrust) + full.shift * full.M
    inverse, vectors = scipy.linalg.eig(np.linalg.solve(shifted, full.M))
    nearest = np.argsort(-np.abs(inverse))[: min(2 * count + 4, len(inverse))]
    W = 1 / inverse[nearest] - full.shift
    order = np.argsort(W.real)[:count]
    W, vectors = W[order], vectors[:, nearest[order]]
    size = np.sqrt(np.abs(np.einsum("ij,ik,kj->j", vectors.conj(), full.M, vectors)))
    return W, vectors / size
