"""Inverse design of a joint: the border of all pairs of springs that bear a thrust."""

import math
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from beal.design.border_curves import REACH, Curve, Edge, Kind, Points, curves
from beal.design.border_sides import ASIDE, Sides
from beal.design.border_surface import Surface
from beal.design.ranges import BEYOND, LOOSE, allowed_range, thrust_asked
from beal.discretisation.build import Formulation
from beal.errors import ModelError
from beal.stability.critical import critical_thrust
from beal.stability.limit import default_limit
from beal.stability.table import panel, reference
from beal.stability.threads import one_thread
from beal.study.batch import GRADED, PANELS, TABULATED
from beal.study.study import Solve, Study
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

Array = NDArray[np.float64]

APART = 10.0  # factor on a stiffness beyond the last border
SPRINGS = ("rotational_stiffness", "shear_stiffness")
INSIDE, CHECKED = 0.99, 25  # share of the reach, and springs along it, of the grid that looks for missing pieces


@dataclass(frozen=True)
class BorderPiece:
    """A part of the border over which one instability comes first outside.

    Parameters
    ----------
    kind : {"flutter", "divergence"}
    edge : {"crossing", "jump"}
        Whether the critical thrust passes through the target, or falls from above it at once.
    rotational_stiffness, shear_stiffness : ndarray, shape (n,)
        In N m/rad and N/m, neighbours less than a tenth apart, in the order that has the springs that do not bear the
        target on the right, the rotational one drawn across and the shear one up.
    critical_thrust : ndarray, shape (n,)
        Of the vehicle just outside, in N: the target at a crossing, less at a jump.
    angular_frequency : ndarray, shape (n,)
        There, in rad/s.
    """

    kind: Kind
    edge: Edge
    rotational_stiffness: Array
    shear_stiffness: Array
    critical_thrust: Array
    angular_frequency: Array

    def met(self, along: int, at: float) -> list[float]:
        """Where the piece meets a line along one spring, 0 the rotational one, at a stiffness of the other.

        Straight in the logarithms between neighbours; in ascending order.
        """
        springs = np.log((self.rotational_stiffness, self.shear_stiffness))
        x, y = springs[along], springs[1 - along] - math.log(at)
        cells = np.flatnonzero((y[1:] > 0) != (y[:-1] > 0))
        share = y[cells] / (y[cells] - y[cells + 1])
        return sorted(np.exp(x[cells] + share * (x[cells + 1] - x[cells])).tolist())


@dataclass(frozen=True)
class SpringBorder:
    """The pairs of springs of a joint at which a vehicle just bears a thrust.

    Parameters
    ----------
    vehicle : Vehicle
        Its own springs of that joint are of no account.
    joint : int
    target : float
        In N.
    formulation : {"objective", "converged"}
    pieces : tuple of BorderPiece
        None where all pairs bear the target.
    best_rotational, best_shear, best_thrust : float
        The largest critical thrust of a coarse grid of springs and where it is; infinite if it lies beyond what was
        searched, a quarter above the target.
    unexplained : int
        Neighbours of that grid of which one bears the target and the other does not, without a piece between them.
    """

    vehicle: Vehicle = field(repr=False)
    joint: int
    target: float
    formulation: Formulation
    pieces: tuple[BorderPiece, ...]
    best_rotational: float
    best_shear: float
    best_thrust: float
    unexplained: int

    def least(self, spring: Literal["rotational_stiffness", "shear_stiffness"], at: float) -> float | None:
        """The least stiffness of one spring that bears the target, for a stiffness of the other.

        It starts the lowest interval that does, which need not go up to a rigid joint.

        Parameters
        ----------
        spring : {"rotational_stiffness", "shear_stiffness"}
        at : float
            Stiffness of the other spring, infinite where the joint is rigid.

        Returns
        -------
        float or None
            To 4e-9, confirmed by the complete search; 0 where a hinge or slide bears it, None where nothing does.

        Raises
        ------
        ModelError
            If there is no such spring, or the stiffness of the other is not positive.
        """
        if spring not in SPRINGS:
            raise ModelError([("spring", f"must be {' or '.join(SPRINGS)}, found {spring!r}")])
        if not at > 0:
            raise ModelError([("at", f"must be a positive stiffness, found {at:g}")])
        along = SPRINGS.index(spring)
        own, other = (f"joint[{self.joint}].{SPRINGS[n]}" for n in (along, 1 - along))
        most = reference(self.vehicle, other) * REACH
        met = sorted(
            k for piece in self.pieces for k in piece.met(along, min(max(at, most / REACH**2), most * (1 - ASIDE)))
        )
        unit = reference(self.vehicle, own)
        ends = np.array([met[0] / APART, *met, met[-1] * APART] if met else [unit, unit])
        vehicle = with_values(self.vehicle, {other: at})
        between = np.sqrt(ends[1:] * ends[:-1])
        for n, middle in enumerate(between):
            if self._bears(with_values(vehicle, {own: float(middle)})):
                if n == 0:
                    return 0.0
                low = float(between[n - 1])
                found = allowed_range(
                    vehicle, own, low, float(middle), self.target, spacing="log", points=2, formulation=self.formulation
                )
                return found.intervals[0].low
        return None

    def _bears(self, vehicle: Vehicle) -> bool:
        found = critical_thrust(vehicle, BEYOND * self.target, self.formulation, tolerance=LOOSE, method="complete")
        return found.critical_thrust is None or found.critical_thrust >= self.target

    @property
    def record(self) -> dict[str, Any]:
        """All but the vehicle as one JSON object."""
        pieces = [
            {name: part.tolist() if isinstance(part, np.ndarray) else part for name, part in vars(piece).items()}
            for piece in self.pieces
        ]
        plain = {name: part for name, part in vars(self).items() if name != "vehicle"}
        return {**plain, "pieces": pieces, "best_thrust": self.best_thrust if math.isfinite(self.best_thrust) else None}


def spring_border(
    vehicle: Vehicle,
    target: float | None = None,
    factor: float | None = None,
    joint: int = 0,
    formulation: Formulation = "objective",
) -> SpringBorder:
    """All pairs of springs of a joint at which the critical thrust passes a target, and the region that bears it.

    In the compliances of both springs the characteristic function is bilinear, so the curves on which an instability
    arrives at the target, or first arrives below it, are explicit: a fraction for divergence, a quadratic for each
    frequency of flutter, a contour line for a flutter that begins to exist below the target. Of these curves the parts
    are kept on which the search finds the target borne on one side and not on the other.

    Parameters
    ----------
    vehicle : Vehicle
        Undamped. The springs of the joint themselves are of no account.
    target : float, optional
        Thrust that the vehicle has to bear, in N.
    factor : float, optional
        The same, as a multiple of the vehicle's nominal thrust.
    joint : int
        Number of the joint, from 0.
    formulation : {"objective", "converged"}

    Returns
    -------
    SpringBorder

    Raises
    ------
    ModelError
        If there is no such joint, the vehicle is damped or tumbles, the formulation is one of the paper's few modes, or
        no pair of springs bears the target.

    Notes
    -----
    Springs are looked at from 1e-5 to 1e5 times the stiffness of the stage behind the joint. A curve between two
    neighbouring points of its grid of thrust and frequency could be missed: ``unexplained`` counts what a coarse grid
    of springs sees of that. What it does not see are tongues of flutter narrower than its cells, where two modes that
    hardly couple meet below the target; nor are parts of a tongue
    narrower than 1e-6 kept.

    Examples
    --------
    >>> import math
    >>> from beal.vehicle import catalog
    >>> found = spring_border(catalog.tsto(0.6, 10.0, 1e4), target=90.0)
    >>> sorted((piece.kind, piece.edge) for piece in found.pieces)
    [('divergence', 'jump'), ('flutter', 'crossing')]
    >>> round(found.least("rotational_stiffness", at=1e4), 4)
    11.0238
    """
    goal = thrust_asked(vehicle, target, factor)
    springs = _springs(vehicle, joint)
    surface = _surface(vehicle, springs, formulation, goal)
    study = Study(vehicle, dict.fromkeys(springs, (1.0,)), Solve(BEYOND * goal, LOOSE, formulation))
    sides = Sides(study, surface, goal)
    found = [(curve, at) for curve in curves(surface, goal) for at in sides.pieces(curve)]
    pieces = tuple(_piece(curve, at, sides.unit) for curve, at in found)
    axis = np.linspace(-1.0, 1.0, CHECKED) * INSIDE * math.log(REACH)
    thrust = sides.thrusts(np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2))
    best = int(np.nanargmax(thrust))
    rotational, shear = (float(k) for k in sides.unit * np.exp(axis[list(divmod(best, CHECKED))]))
    if not pieces and thrust[best] < goal:
        where = f"the best found is {thrust[best]:.6g}, at {rotational:.3g} and {shear:.3g}"
        raise ModelError([("target", f"no springs of joint[{joint}] bear {goal:g}; {where}")])
    holds = thrust.reshape(CHECKED, CHECKED) >= goal
    missing = sum(_unexplained(pieces, sides.unit, axis, holds, along) for along in (0, 1))
    return SpringBorder(vehicle, joint, goal, formulation, pieces, rotational, shear, float(thrust[best]), missing)


def _springs(vehicle: Vehicle, joint: int) -> tuple[str, str]:
    """Paths of the two springs of a joint."""
    if not 0 <= joint < len(vehicle.joints):
        raise ModelError([(f"joint[{joint}]", f"there is no such joint; the vehicle has {len(vehicle.joints)}")])
    return f"joint[{joint}].rotational_stiffness", f"joint[{joint}].shear_stiffness"


def _surface(vehicle: Vehicle, springs: tuple[str, str], formulation: Formulation, target: float) -> Surface:
    if formulation not in TABULATED:
        choices = " or ".join(TABULATED)
        raise ModelError([("formulation", f"a border needs {choices}, found {formulation}")])
    if vehicle.damped:
        raise ModelError([("vehicle", "a border is that of undamped vehicles, found damping")])
    natural = default_limit(vehicle) / PANELS
    between = np.concatenate((natural * np.array(GRADED), natural * np.arange(1, math.ceil(target / natural) + 1)))
    ends = [0.0, *between[between < target], target]
    with one_thread():
        panels = [panel(vehicle, springs, formulation, part, True) for part in zip(ends[:-1], ends[1:], strict=True)]
    known = [one for one in panels if one is not None]
    if len(known) < len(panels):
        raise ModelError([("vehicle", "its rigid-body motions take part in the instability; found no border")])
    return Surface(known, ends)


def _piece(curve: Curve, at: Points, unit: Array) -> BorderPiece:
    rotational, shear = (unit * np.exp(at.place)).T
    return BorderPiece(curve.kind, curve.edge, rotational, shear, at.thrust, np.sqrt(at.W))


def _unexplained(
    pieces: tuple[BorderPiece, ...], unit: Array, axis: Array, holds: NDArray[np.bool_], along: int
) -> int:
    """Neighbours on lines along one spring between which the answer changes and no piece runs."""
    count = 0
    lines = holds if along else holds.T
    for place, line in zip(axis, lines, strict=True):
        met = [k for piece in pieces for k in piece.met(along, unit[1 - along] * math.exp(place))]
        cells = np.searchsorted(unit[along] * np.exp(axis), met)
        changes = np.flatnonzero(line[1:] != line[:-1]) + 1
        count += int(np.sum(~np.isin(changes, cells)))
    return count
