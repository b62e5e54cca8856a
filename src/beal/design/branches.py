"""Critical points of one discretisation of a vehicle, and how they follow its quantities."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from beal.design.derivatives import SHRUNK, STEP, Array, Change, Movable, Problem, changes, differences
from beal.design.implicit import Follow, damped, twins, undamped
from beal.discretisation.build import RITZ, Formulation, discretise
from beal.discretisation.operators import Operators
from beal.errors import ConvergenceError, ModelError
from beal.stability.damped import with_rates
from beal.stability.double_root import CriticalPoint
from beal.stability.pencil import acting, pencil, reduced
from beal.stability.refine import first_order, polish
from beal.stability.ridge import Kind
from beal.stability.zero_roots import rigid_body_root
from beal.vehicle.vehicle import Vehicle

AGREED = 1e-5  # relative difference of the two stencils above which the coordinates did not move smoothly
FINER = 4  # degrees beyond those that find the instability
Status = Literal["exact", "one-sided", "differenced", "not differentiable"]
Flown = Callable[[Vehicle], Vehicle]


@dataclass(frozen=True)
class Branch:
    """A critical point, the matrices that it is one of, and how it follows their changes."""

    kind: Kind
    point: CriticalPoint
    problem: Problem
    follow: Follow


@dataclass(frozen=True)
class Slopes:
    """Derivatives of (thrust, omega) of each branch, shape (branches, 2), and by the formula of lower order."""

    fine: Array
    coarse: Array
    status: Status


def builder(vehicle: Vehicle, formulation: Formulation, modes: int | None = None) -> Callable[[Vehicle], Operators]:
    """The discretisation that is differentiated, the same for all vehicles near this one."""
    ritz = formulation in RITZ
    return partial(
        discretise, formulation=formulation, order=modes if ritz else first_order(vehicle, "legendre") + FINER
    )


def branch(operators: Operators, kind: Kind, thrust: float, omega: float) -> Branch:
    """The critical point next to a guess.

    Flutter keeps rigid-body motions that only follow, since a change of the vehicle may make them act.
    """
    kept = acting(operators) if kind == "divergence" else np.ones(len(operators.M), dtype=bool)
    problem: Problem = partial(pencil, kept=kept)
    full = problem(operators)
    point = polish(full, kind, thrust, omega**2)
    if not point.converged:
        raise ConvergenceError(f"critical thrust near {thrust:.9g}: lost in the discretisation that is differentiated")
    if full.C is not None and kind == "flutter":
        return Branch(kind, point, problem, damped(full, point))
    if full.C is not None:
        return Branch(kind, point, lambda each: with_rates(pencil(each, kept)), undamped(with_rates(full), point, kind))
    neutral = kind == "divergence" and rigid_body_root(reduced(full), thrust) == "neutral"
    return Branch(kind, point, problem, undamped(full, point, kind, neutral))


def tied(operators: Operators, one: Branch) -> list[Branch]:
    """The two divergences where two zero roots meet, each with its own vector; else the branch alone."""
    pair = twins(one.problem(operators), one.point.thrust) if one.kind == "divergence" else None
    return [replace(one, follow=follow) for follow in pair or (one.follow,)]


def no_slopes(branches: Sequence[Branch]) -> Slopes:
    """Of what has none."""
    unknown = np.full((len(branches), 2), np.nan)
    return Slopes(unknown, unknown, "not differentiable")


def slopes(
    quantity: Movable, branches: Sequence[Branch], build: Callable[[Vehicle], Operators], here: Operators
) -> Slopes:
    """How critical points move with a quantity."""
    nothing = no_slopes(branches)
    if here.C is None and _damps(quantity.path):
        return nothing
    for found in changes(quantity, build, here):
        if _sets_adrift(found, here, branches):
            return nothing
        fine, coarse = (
            np.array(rows)
            for rows in zip(*([each.follow(side) for side in found.of(each.problem)] for each in branches), strict=True)
        )
        size = np.array([[each.point.thrust, np.sqrt(abs(each.point.W))] for each in branches])
        if np.all(np.abs(fine - coarse) <= AGREED * (np.abs(fine) + STEP / quantity.step * size)):
            return Slopes(fine, coarse, "one-sided" if found.one_sided else "exact")
    sides = differences(quantity, lambda vehicle: _again(build(vehicle), branches))
    if sides is None and not any(_possible(quantity, build, sign) for sign in (-1, 1)):
        return nothing
    if sides is None:
        raise ConvergenceError(f"{quantity.path}: the critical thrust is lost when it moves")
    return Slopes(*sides, "differenced")


def _possible(quantity: Movable, build: Callable[[Vehicle], Operators], sign: int) -> bool:
    """Whether it can move to a side: the Ritz formulations ask for two equal stages."""
    try:
        build(quantity.moved(sign * SHRUNK[-1] * quantity.step))
    except ModelError:
        return False
    return True


def _again(operators: Operators, branches: Sequence[Branch]) -> Array:
    """The critical points of a vehicle close by, shape (branches, 2)."""
    found = []
    for each in branches:
        point = polish(pencil(operators), each.kind, each.point.thrust, each.point.W)
        if not point.converged:
            raise ConvergenceError(f"critical thrust near {each.point.thrust:.9g}: lost a step away")
        found.append([point.thrust, np.sqrt(max(point.W, 0.0))])
    return np.array(found)


def _sets_adrift(found: Change, here: Operators, branches: Sequence[Branch]) -> bool:
    """Whether a divergence of the elastic motions alone becomes one of rigid-body motions too, at another thrust."""
    moved = found.operators[0]
    return any(
        np.any(acting(moved) != acting(here)) or _neutral(moved, each) != _neutral(here, each)
        for each in branches
        if each.kind == "divergence"
    )


def _neutral(operators: Operators, at: Branch) -> bool:
    return bool(operators.rigid) and rigid_body_root(reduced(pencil(operators)), at.point.thrust) == "neutral"


def _damps(path: str) -> bool:
    return path.endswith("_damping") or path.startswith("damping")
