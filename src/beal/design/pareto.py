"""What a critical thrust costs in mass: the designs of which none is both lighter and stronger than another."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from beal.design.cases import Case
from beal.design.optimise import Optimum, optimise
from beal.design.variables import DesignSpace
from beal.discretisation.build import Formulation
from beal.errors import ConvergenceError, ModelError

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]

BELOW = 1e-6  # share of the largest thrust found by which the first target stays below it
ANY = 1e-6  # the same that any design is asked to bear where only its mass counts


@dataclass(frozen=True)
class ParetoFront:
    """Designs from the lightest to the strongest.

    Parameters
    ----------
    points : tuple of Optimum
        In order of mass and of critical thrust.
    targets : tuple of float
        Critical thrusts that were asked for, in N.
    gaps : tuple of str
        Targets for which no design was confirmed, and why.
    units : {"SI", "nondimensional"}
    """

    points: tuple[Optimum, ...]
    targets: tuple[float, ...]
    gaps: tuple[str, ...]
    units: Literal["SI", "nondimensional"]

    @property
    def mass(self) -> Array:
        """In kg, shape (points,)."""
        return np.array([point.mass for point in self.points])

    @property
    def critical_thrust(self) -> Array:
        """In N, shape (points,)."""
        return np.array([point.critical.critical_thrust for point in self.points])

    @property
    def cliff(self) -> NDArray[np.bool_]:
        """Which designs stand at a cliff, shape (points,)."""
        return np.array([point.cliff for point in self.points])


def pareto(
    space: DesignSpace,
    points: int = 9,
    start: Mapping[str, float] | None = None,
    starts: int = 1,
    formulation: Formulation = "objective",
    modes: int | None = None,
    iterations: int = 100,
    progress: Progress | None = None,
    cases: Sequence[Case] = (),
    quantile: float = 0.0,
) -> ParetoFront:
    """The least mass for a row of critical thrusts, from the lightest design to the strongest.

    Each design is a local optimum; the search for one target begins at the design for the next higher one, which bears
    it already. What another design beats in both is left out.

    Parameters
    ----------
    space : DesignSpace
    points : int
        Targets, even in thrust between the lightest and the strongest design.
    start, starts
        For the search of the strongest design, as for `optimise`.
    formulation, modes, iterations, cases, quantile
        As for `optimise`.
    progress : callable, optional
        Called with the searches done and their number.

    Returns
    -------
    ParetoFront

    Raises
    ------
    ModelError
        If there are less than two points, or an option does not apply.
    ConvergenceError
        If the strongest or the lightest design is not confirmed.

    Examples
    --------
    >>> from beal.design.variables import Link, Variable
    >>> from beal.vehicle.catalog import beck
    >>> stiff = {"stage[0].bending_stiffness": Link("stage[0].mass_per_length", power=2)}
    >>> front = pareto(DesignSpace(beck(), {"stage[0].mass_per_length": Variable(1.0, 2.0)}, stiff), points=3)
    >>> (front.critical_thrust / front.mass**2).round(5).tolist()
    [20.05095, 20.05095, 20.05095]
    """
    if points < 2:
        raise ModelError([("points", f"must be 2 or more, found {points}")])
    search = partial(
        optimise, space, formulation=formulation, modes=modes, iterations=iterations, cases=cases, quantile=quantile
    )
    tell = progress or _silent
    strongest = search(start=start, starts=starts)
    tell(1, points + 1)
    most = _thrust(strongest)
    lightest = search("mass", ANY * most, strongest.values)
    tell(2, points + 1)
    targets = np.linspace(min(_thrust(lightest), most), (1 - BELOW) * most, points)
    found, gaps, values = [lightest], [], strongest.values
    for number, target in enumerate(targets[:0:-1].tolist(), start=3):
        try:
            found.append(search("mass", target, values))
            values = found[-1].values
        except (ModelError, ConvergenceError) as error:
            gaps.append(f"{target:.9g}: {error}")
        tell(number, points + 1)
    return ParetoFront(_undominated([*found, strongest]), tuple(targets.tolist()), tuple(gaps), space.vehicle.units)


def _thrust(found: Optimum) -> float:
    return found.critical.critical_thrust or 0.0


def _undominated(found: Sequence[Optimum]) -> tuple[Optimum, ...]:
    """In order of mass, each stronger than all that are lighter by more than the searches tell apart."""
    kept: list[Optimum] = []
    for one in sorted(found, key=lambda each: (each.mass, -_thrust(each))):
        if not kept or _thrust(one) > (1 + 2 * BELOW) * _thrust(kept[-1]):
            kept.append(one)
    return tuple(kept)


def _silent(done: int, total: int) -> None:
    pass
