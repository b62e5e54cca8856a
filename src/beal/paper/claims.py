"""The paper's nine claims, each split into parts that are counted, under each formulation.

A part is a share of cases that bear the claim out. A claim holds where all cases of all parts do; it fails where, on
average over its parts, fewer than half do; it holds in part otherwise. No verdict is written down anywhere.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beal.discretisation.build import Formulation
from beal.paper import cases
from beal.paper.evidence import (
    ABOVE,
    BOUNDED_DURATION,
    DIVERGING,
    FORCED_DURATION,
    FORCED_SWEEP,
    GROWTH_DURATION,
    Maps,
    critical,
    forced_amplitude,
    growth,
)
from beal.study.variables import KINDS, STATUS

FLUTTER, DIVERGENCE = KINDS.index("flutter"), KINDS.index("divergence")
LOW_ROTATIONAL, HIGH_SHEAR = 1e2, 1e3  # geometric middles of the ranges
LAST_DIGIT = 0.1  # of the paper's 109.7
CLOSE = 0.01  # to the uniform beam
STEADY, SAME_RATE = 0.05, 0.05
STIFFER = (1e4, 1e5, 1e6)
RESPONSE_GRID = "the one vehicle L₁ = 0.6, k_r = k_s = 5000"


@dataclass(frozen=True)
class Part:
    """One countable statement of a claim: how many of the cases bear it out."""

    statement: str
    borne_out: int
    cases: int

    @property
    def count(self) -> str:
        """``yes`` or ``no`` for one case, ``k of n`` for more."""
        if self.cases == 1:
            return "yes" if self.borne_out else "no"
        return f"{self.borne_out} of {self.cases}"


@dataclass(frozen=True)
class Verdict:
    """A claim judged under one formulation.

    Parameters
    ----------
    id, claim, formulation : str
    parts : tuple of Part
    note : str
        Numbers that a reader wants beside the counts.
    numbers : dict
    grid : str
        What it was tested on.
    """

    id: str
    claim: str
    formulation: Formulation
    parts: tuple[Part, ...]
    note: str
    numbers: dict[str, Any] = field(default_factory=dict)
    grid: str = ""

    @property
    def verdict(self) -> str:
        """``holds``, ``fails`` or ``holds in part``, by the rule of this module."""
        shares = [part.borne_out / part.cases for part in self.parts if part.cases]
        if min(shares) == 1:
            return "holds"
        return "holds in part" if sum(shares) >= len(shares) / 2 else "fails"

    @property
    def evidence(self) -> str:
        """The counts of the parts and the note, as one text."""
        counts = "; ".join(f"{part.statement}: {part.count}" for part in self.parts)
        return f"{counts[0].upper()}{counts[1:]}. {self.note}".strip()

    def record(self) -> dict[str, Any]:
        """The entry of ``claims.json``."""
        parts = [{"statement": p.statement, "borne_out": p.borne_out, "cases": p.cases} for p in self.parts]
        return {
            "id": self.id,
            "claim": self.claim,
            "formulation": self.formulation,
            "verdict": self.verdict,
            "evidence": self.evidence,
            "numbers": {**self.numbers, "parts": parts},
            "grid": self.grid,
        }


@dataclass(frozen=True)
class _Map:
    """A stability map as arrays with k_r along the first axis."""

    k_r: NDArray[np.float64]
    k_s: NDArray[np.float64]
    thrust: NDArray[np.float64]
    kind: NDArray[np.int_]
    pair: NDArray[np.int_]  # 10 low + high
    solved: NDArray[np.bool_]

    def flutter(self, low: int, high: int) -> NDArray[np.bool_]:
        return (self.kind == FLUTTER) & (self.pair == 10 * low + high)

    @property
    def grid(self) -> str:
        size = f"{len(self.k_r)} by {len(self.k_s)} points"
        return f"{size}, k_r {self.k_r[0]:g} to {self.k_r[-1]:g}, k_s {self.k_s[0]:g} to {self.k_s[-1]:g}, logarithmic"


def _map(charts: Maps, split: float, formulation: Formulation) -> _Map:
    chart = charts[split, formulation]
    low, high, kind, status = (
        np.asarray(chart[name]).astype(int) for name in ("mode_low", "mode_high", "kind", "status")
    )
    return _Map(
        np.asarray(chart[cases.K_R]),
        np.asarray(chart[cases.K_S]),
        np.asarray(chart.critical_thrust),
        kind,
        10 * low + high,
        status == STATUS.index("solved"),
    )


def _part(statement: str, borne_out: Any) -> Part:
    """A part from one truth value or an array of them."""
    values = np.atleast_1d(np.asarray(borne_out, dtype=bool))
    return Part(statement, int(values.sum()), values.size)


def c1(charts: Maps, formulation: Formulation) -> Verdict:
    """L1 = 0.2: flutter of modes 1 and 2 for every joint."""
    chart = _map(charts, 0.2, formulation)
    diverges = chart.kind == DIVERGENCE
    parts = (_part("first instability is flutter 1-2", chart.flutter(1, 2)[chart.solved]),)
    note = ""
    if diverges.any():
        softest = chart.k_r[diverges.any(axis=1)].max()
        note = f"Divergence at {int(diverges.sum())} points, all with k_r ≤ {softest:.3g}."
    numbers = {"lowest": _low(chart), "highest": _high(chart), "divergence_points": int(diverges.sum())}
    return Verdict(
        "C1", "L₁ = 0.2: flutter of modes 1 and 2 for every joint", formulation, parts, note, numbers, chart.grid
    )


def c2(charts: Maps, formulation: Formulation) -> Verdict:
    """L1 = 0.4: flutter for every joint, mostly 1-2; 2-3 only for low k_r and high k_s."""
    chart = _map(charts, 0.4, formulation)
    flutters, first, second = chart.kind == FLUTTER, chart.flutter(1, 2), chart.flutter(2, 3)
    soft, stiff = chart.k_r[:, None] < LOW_ROTATIONAL, chart.k_s > HIGH_SHEAR
    exchanged = ~soft & ~stiff
    parts = (
        _part("first instability is flutter", flutters[chart.solved]),
        _part("modes 1-2 are more than half of the flutter points", first.sum() > flutters.sum() / 2),
        _part(
            f"2-3 has k_r < {LOW_ROTATIONAL:g} and k_s > {HIGH_SHEAR:g}",
            (soft & stiff)[second] if second.any() else False,
        ),
    )
    where = "It does not occur"
    if second.any():
        rows, columns = np.nonzero(second)
        where = (
            f"It lies at k_r from {chart.k_r[rows].min():.3g} to {chart.k_r[rows].max():.3g} and k_s from "
            f"{chart.k_s[columns].min():.3g} to {chart.k_s[columns].max():.3g}; with the words low and high "
            f"exchanged, {int(exchanged[second].sum())} of {int(second.sum())} points agree"
        )
    note = f"Flutter 2-3 at {int(second.sum())} points. {where}."
    numbers = {
        "flutter_12_points": int(first.sum()),
        "flutter_23_points": int(second.sum()),
        "flutter_23_points_at_high_k_r_and_low_k_s": int((exchanged & second).sum()),
    }
    claim = "L₁ = 0.4: flutter for every joint, mostly 1-2, and 2-3 only where k_r is low and k_s high"
    return Verdict("C2", claim, formulation, parts, note, numbers, chart.grid)


def c3(charts: Maps, formulation: Formulation) -> Verdict:
    """L1 = 0.6: divergence for small k_r, flutter 1-2 for higher, at a higher load."""
    chart = _map(charts, 0.6, formulation)
    diverges, flutters = chart.kind == DIVERGENCE, chart.kind == FLUTTER
    changes = (np.diff(diverges.astype(int), axis=0) != 0).sum(axis=0)
    once = diverges[0] & flutters[-1] & (changes == 1)
    both = diverges.any(axis=0) & flutters.any(axis=0)
    highest = np.where(diverges, chart.thrust, -np.inf).max(axis=0)[both]
    lowest = np.where(flutters, chart.thrust, np.inf).min(axis=0)[both]
    parts = (
        _part("rows of constant k_s that go from divergence to flutter once as k_r rises", once),
        _part("flutter is of modes 1-2", chart.flutter(1, 2)[flutters]),
        _part(
            "rows in which every divergence load is below every flutter load", highest < lowest if both.any() else False
        ),
    )
    numbers = {
        "highest_divergence": float(chart.thrust[diverges].max()) if diverges.any() else None,
        "lowest_flutter": float(chart.thrust[flutters].min()) if flutters.any() else None,
    }
    note = ""
    if both.any():
        border = chart.k_r[diverges.cumsum(axis=0).argmax(axis=0)[both]]
        note = f"The last diverging point has k_r between {border.min():.3g} and {border.max():.3g}."
    claim = (
        "L₁ = 0.6: divergence for small k_r, flutter 1-2 for higher; at constant k_s divergence comes at the lower load"
    )
    return Verdict("C3", claim, formulation, parts, note, numbers, chart.grid)


def c4(charts: Maps, formulation: Formulation) -> Verdict:
    """L1 = 0.6, flutter region: the critical thrust falls as k_r rises."""
    chart = _map(charts, 0.6, formulation)
    flutters = chart.kind == FLUTTER
    neighbours = flutters[1:] & flutters[:-1]
    steps = np.diff(chart.thrust, axis=0)[neighbours]
    parts = (_part("steps of rising k_r at constant k_s with a falling load", steps < 0),)
    falling, rising = (float(steps[s].sum()) if s.any() else 0.0 for s in (steps < 0, steps > 0))
    note = f"Sum of all falls {falling:.1f}, of all rises {rising:.1f}."
    numbers = {"sum_of_falls": falling, "sum_of_rises": rising}
    claim = "L₁ = 0.6, flutter region: P_cr falls as k_r rises"
    return Verdict("C4", claim, formulation, parts, note, numbers, f"{steps.size} steps on {chart.grid}")


def c5(charts: Maps, formulation: Formulation) -> Verdict:
    """L1 = 0.8: divergence, flutter 1-2 and flutter 3-4 all occur; (200, 600) is 3-4."""
    chart = _map(charts, 0.8, formulation)
    found = critical((0.8, 200.0, 600.0), formulation)
    counts = {
        "divergence": int((chart.kind == DIVERGENCE).sum()),
        "flutter 1-2": int(chart.flutter(1, 2).sum()),
        "flutter 3-4": int(chart.flutter(3, 4).sum()),
    }
    here = found.kind == "flutter" and found.modes == (3, 4)
    parts = (*(_part(f"{name} occurs", count > 0) for name, count in counts.items()), _part("(200, 600) is 3-4", here))
    listed = ", ".join(f"{name} at {count}" for name, count in counts.items())
    event = f"{_named(found.kind, found.modes)} at {found.critical_thrust:.3f}"
    note = f"Points: {listed} of {chart.kind.size}. (200, 600): {event}."
    numbers = {"points": counts, "critical_thrust_200_600": found.critical_thrust, "modes_200_600": found.modes}
    claim = "L₁ = 0.8: divergence, flutter 1-2 and flutter 3-4 all occur; k_r = 200, k_s = 600 is 3-4"
    return Verdict("C5", claim, formulation, parts, note, numbers, chart.grid + "; and the one point")


def c6(charts: Maps, formulation: Formulation) -> Verdict:
    """(0.6, 5000, 5000): flutter at 109.7."""
    found = critical(cases.RESPONSE_JOINT, formulation)
    thrust = found.critical_thrust or np.nan
    parts = (
        _part("first instability is flutter", found.kind == "flutter"),
        _part(f"load within {LAST_DIGIT} of {cases.PAPER_CRITICAL}", abs(thrust - cases.PAPER_CRITICAL) <= LAST_DIGIT),
    )
    note = f"P_cr = {thrust:.6f}, {thrust / cases.PAPER_CRITICAL - 1:+.2%}; {_named(found.kind, found.modes)}."
    numbers = {"critical_thrust": thrust, "error_estimate": found.error_estimate}
    return Verdict("C6", "L₁ = 0.6, k_r = k_s = 5000: flutter at 109.7", formulation, parts, note, numbers, "one point")


def c7(charts: Maps, formulation: Formulation) -> Verdict:
    """Stiff joints approach the uniform beam."""
    off = np.array(
        [
            [(critical((split, k, k), formulation).critical_thrust or np.inf) / cases.UNIFORM - 1 for k in STIFFER]
            for split in cases.LOCATIONS
        ]
    )
    parts = (
        _part(f"within {CLOSE:.0%} of the uniform beam at the stiff corner of the maps", abs(off[:, 0]) < CLOSE),
        _part("the difference shrinks as both springs stiffen tenfold", np.diff(abs(off), axis=1) < 0),
    )
    each = ", ".join(f"{100 * o:+.3f} % (L₁ = {split:g})" for split, o in zip(cases.LOCATIONS, off[:, 0], strict=True))
    note = f"At k_r = k_s = 10⁴: {each}; at 10⁶ at most {100 * abs(off[:, -1]).max():.4f} %."
    numbers = {
        "relative_difference": {
            f"{s:g}": dict(zip(map(str, STIFFER), row.tolist(), strict=True))
            for s, row in zip(cases.LOCATIONS, off, strict=True)
        }
    }
    claim = "Stiff joints approach the uniform beam (109.9 after Beal, 1965; exactly 109.689192)"
    return Verdict("C7", claim, formulation, parts, note, numbers, "L₁ = 0.2, 0.4, 0.6, 0.8; k_r = k_s = 10⁴, 10⁵, 10⁶")


def c8(charts: Maps, formulation: Formulation) -> Verdict:
    """Constant amplitude below the critical thrust; periodic growth above in flutter, at once in divergence."""
    below = growth(cases.RESPONSE_JOINT, formulation, cases.RESPONSE_THRUSTS[13], BOUNDED_DURATION)
    above = growth(cases.RESPONSE_JOINT, formulation, cases.RESPONSE_THRUSTS[14], GROWTH_DURATION)
    diverging = critical(DIVERGING, formulation)
    fold = growth(DIVERGING, formulation, ABOVE * (diverging.critical_thrust or np.nan), GROWTH_DURATION)
    swings = above.turning_points > 0 and abs(above.rate / above.eigenvalue_rate - 1) < SAME_RATE
    leaves = fold.turning_points == 0 and abs(fold.rate / fold.eigenvalue_rate - 1) < SAME_RATE
    parts = (
        _part(
            "P = 90: amplitude constant within 5 %",
            abs(below.amplitude_ratio - 1) < STEADY and below.eigenvalue_rate < 1e-6,
        ),
        _part("P = 128: swings, and grows at the rate of the root", swings),
        _part(
            "beyond divergence: grows at the rate of the root without a swing",
            diverging.kind == "divergence" and leaves,
        ),
    )
    note = (
        f"P = 90: amplitude of the last quarter over the first {below.amplitude_ratio:.4f}. P = 128: "
        f"{above.turning_points} turning points in the second half, growth rate {above.rate:.3f} (root "
        f"{above.eigenvalue_rate:.3f}). k_r = {DIVERGING[1]:g}, k_s = {DIVERGING[2]:g}, P = {fold.thrust:.3f}: "
        f"{fold.turning_points} turning points, {fold.rate:.3f} (root {fold.eigenvalue_rate:.3f})."
    )
    numbers = {"below": vars(below), "above": vars(above), "divergence": vars(fold)}
    claim = "Below P_cr the amplitude stays constant; above, it grows periodically in flutter and at once in divergence"
    grid = (
        f"{RESPONSE_GRID}, and L₁ = 0.6, k_r = 3, k_s = 10⁴ at 1.1 P_cr; elastic motion of the IMU from the first "
        f"free mode at rest; durations {BOUNDED_DURATION:g} at P = 90, {GROWTH_DURATION:g} above; exact solution"
    )
    return Verdict("C8", claim, formulation, parts, note, numbers, grid)


def c9(charts: Maps, formulation: Formulation) -> Verdict:
    """The amplitude of the IMU grows with the thrust and with the force."""
    small, large = cases.FORCED_AMPLITUDES
    sweep = {F: np.array([forced_amplitude(formulation, P, F) for P in FORCED_SWEEP]) for F in (small, large)}
    at = {P: sweep[small][FORCED_SWEEP.index(P)] for P in cases.FORCED_THRUSTS}
    free = {P: forced_amplitude(formulation, P, small, free=True) for P in cases.FORCED_THRUSTS}
    low, high = cases.FORCED_THRUSTS
    parts = (
        _part("thrusts at which twice the force gives a larger amplitude", sweep[large] > sweep[small]),
        _part("steps of 5 in P that raise the amplitude", np.diff(sweep[small]) > 0),
        _part("larger at P = 100 than at 50, from rest", at[high] > at[low]),
        _part("larger at P = 100 than at 50, from the initial condition of Figs. 13 and 14", free[high] > free[low]),
    )
    lowest = int(np.argmin(sweep[small]))
    note = (
        f"Amplitude for F = 0.01 from rest: {1e6 * sweep[small][0]:.1f}·10⁻⁶ without thrust, {1e6 * at[low]:.1f} at "
        f"50, {1e6 * sweep[small][lowest]:.1f} at {FORCED_SWEEP[lowest]:g}, {1e6 * at[high]:.1f} at 100; twice the "
        f"force gives {sweep[large][0] / sweep[small][0]:.3f} times the amplitude."
    )
    numbers = {
        "thrust": list(FORCED_SWEEP),
        "amplitude_F_0.01": sweep[small].tolist(),
        "amplitude_F_0.02": sweep[large].tolist(),
        "with_initial_condition": {f"{P:g}": value for P, value in free.items()},
    }
    amplitude = f"largest elastic |y| over {FORCED_DURATION:g}"
    grid = f"{RESPONSE_GRID}; P = 0, 5, ..., 105; F = 0.01 and 0.02 sin 2t at the tail; {amplitude}"
    return Verdict("C9", "The amplitude of the IMU grows with P and with F", formulation, parts, note, numbers, grid)


TESTS: tuple[Callable[[Maps, Formulation], Verdict], ...] = (c1, c2, c3, c4, c5, c6, c7, c8, c9)


def judge(charts: Maps, formulation: Formulation) -> list[Verdict]:
    """All claims under one formulation.

    Parameters
    ----------
    charts : dict of (L1, formulation) to Dataset
    formulation : str

    Returns
    -------
    list of Verdict
    """
    return [test(charts, formulation) for test in TESTS]


def _named(kind: str, modes: tuple[int, int] | None) -> str:
    low, high = modes or (0, 0)
    return {"flutter": f"flutter {low}-{high}", "divergence": f"divergence {low}"}.get(kind, kind)


def _low(chart: _Map) -> float:
    return float(np.nanmin(chart.thrust))


def _high(chart: _Map) -> float:
    return float(np.nanmax(chart.thrust))
