"""Which parts of the curves of a joint's two springs part vehicles that bear a target from vehicles that do not."""

import math

import numpy as np

from beal.design.border_curves import Curve, Points, normal, value
from beal.design.border_surface import Surface
from beal.design.ranges import LOOSE
from beal.errors import ConvergenceError
from beal.stability.critical import critical_thrust
from beal.stability.kernels.rules import STABLE
from beal.stability.pencil import Array
from beal.stability.table import reference
from beal.study.solve import solve_points
from beal.study.study import Study
from beal.study.variables import STATUS

ASIDE, FARTHEST = 1e-6, 0.1  # distance in ln k at which both sides of a border are looked at: least, and most
SEEN, GAP = 1e-6, 1e-4  # shares of the thrust: its change, or the length of a new instability, to be met there
CUTS = 22  # halvings between neighbours where a piece ends


class Sides:
    """What the search for the critical thrust says on both sides of a curve."""

    def __init__(self, study: Study, surface: Surface, target: float) -> None:
        self.study, self.surface, self.target = study, surface, target
        self.unit = np.array([reference(study.vehicle, path) for path in study.axes])

    def thrusts(self, place: Array) -> Array:
        found = solve_points(self.study, self.unit * np.exp(place))
        thrust = np.where(found["kind"] == STABLE, math.inf, found["critical_thrust"])
        thrust[found["status"] != STATUS.index("solved")] = math.nan
        return thrust

    def _complete(self, place: Array) -> float:
        vehicle, solve = self.study.at(self.unit * np.exp(place)), self.study.solve
        try:
            found = critical_thrust(vehicle, solve.max_thrust, solve.formulation, tolerance=LOOSE, method="complete")
        except ConvergenceError:
            return math.nan
        return math.inf if found.critical_thrust is None else found.critical_thrust

    def beyond(self, curve: Curve, at: Points) -> Array:
        """On which side of each point, 1 up or -1 down the gradient of D, this instability is the first of all.

        0 where the target holds on both sides, or on none, or where another instability comes first.
        """
        across = normal(self.surface, at)
        steep = np.linalg.norm(across, axis=1)
        aside = np.clip(self._aside(curve, at) / steep, ASIDE, FARTHEST)[:, None] * across / steep[:, None]
        places = np.stack((at.place - aside, at.place + aside))
        down, up = sides = self.thrusts(places.reshape(-1, 2)).reshape(2, -1)
        if (curve.kind, curve.edge) == ("flutter", "jump"):  # the quick search may step over a tongue
            for n in np.flatnonzero(np.all(sides >= self.target, axis=0)):
                sides[:, n] = [self._complete(place) for place in places[:, n]]
        first = np.abs(np.fmin(down, up) - at.thrust) <= 10 * GAP * self.target
        return np.where(first, np.sign((down >= self.target).astype(float) - (up >= self.target)), 0.0)

    def _aside(self, curve: Curve, at: Points) -> Array:
        """Change of D that moves a crossing by SEEN, or makes a new instability last for GAP."""
        if curve.edge == "crossing":
            return SEEN * at.thrust * np.abs(value(self.surface, at, 1))
        bend = value(self.surface, at, 2)
        if curve.kind == "flutter":  # at the W that follows
            bend -= value(self.surface, at, 1, 1) ** 2 / value(self.surface, at, 0, 2)
        return (GAP * at.thrust) ** 2 / 2 * np.abs(bend)

    def pieces(self, curve: Curve) -> list[Points]:
        """Parts of a curve that belong to the border, their ends found by halving.

        The springs that do not bear the target are on the right.
        """
        at, beyond = curve.at, self.beyond(curve, curve.at)
        changes = np.flatnonzero(beyond[1:] != beyond[:-1])
        if len(changes):
            on = beyond[changes] != 0
            inner = curve.parameters[np.where(on, changes, changes + 1)]
            outer = curve.parameters[np.where(on, changes + 1, changes)]
            wanted = beyond[np.where(on, changes, changes + 1)]
            for _ in range(CUTS):
                middle = curve.middle(inner, outer)
                still = (self.beyond(curve, curve.points(middle)) == wanted)[:, None]
                inner, outer = np.where(still, middle, inner), np.where(still, outer, middle)
            ends = curve.points(inner)
            at = Points(*(np.insert(old, changes + 1, end, axis=0) for old, end in zip(at, ends, strict=True)))
            beyond = np.insert(beyond, changes + 1, wanted)
        runs = np.split(np.arange(len(beyond)), np.flatnonzero(beyond[1:] != beyond[:-1]) + 1)
        kept = [run for run in runs if beyond[run[0]] and len(run) > 1]
        return [self._turned(Points(*(part[run] for part in at)), float(beyond[run[0]])) for run in kept]

    def _turned(self, at: Points, beyond: float) -> Points:
        """Neighbours in the order that has what lies beyond on the right."""
        along = np.diff(at.place, axis=0)
        across = beyond * normal(self.surface, at)[:-1]
        left = np.sum(np.sign(along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0])) > 0
        return Points(*(part[::-1] for part in at)) if left else at
