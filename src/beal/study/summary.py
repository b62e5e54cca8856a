"""What a map found, in a few numbers that blocks add up to."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from beal.study.variables import KINDS, METHODS, STATUS, Arrays


@dataclass(frozen=True)
class Summary:
    """Numbers of points, and the range of the critical thrust.

    Parameters
    ----------
    status, kind, method : tuple of int
        How many points have each flag of `beal.study.store`; kinds of solved points only.
    lowest, highest : float
        Critical thrust, in N; infinite and opposite where there is none.
    """

    status: tuple[int, ...] = (0,) * len(STATUS)
    kind: tuple[int, ...] = (0,) * len(KINDS)
    method: tuple[int, ...] = (0,) * len(METHODS)
    lowest: float = np.inf
    highest: float = -np.inf

    @classmethod
    def of(cls, arrays: Arrays) -> "Summary":
        """Summary of a block."""
        solved = arrays["status"] == STATUS.index("solved")
        thrust = arrays["critical_thrust"][solved & np.isfinite(arrays["critical_thrust"])]
        return cls(
            _count(arrays["status"], len(STATUS)),
            _count(arrays["kind"][solved], len(KINDS)),
            _count(arrays["method"], len(METHODS)),
            float(thrust.min(initial=np.inf)),
            float(thrust.max(initial=-np.inf)),
        )

    def __add__(self, other: "Summary") -> "Summary":
        return Summary(
            _sum(self.status, other.status),
            _sum(self.kind, other.kind),
            _sum(self.method, other.method),
            min(self.lowest, other.lowest),
            max(self.highest, other.highest),
        )

    @property
    def points(self) -> int:
        """All points."""
        return sum(self.status)

    def named(self) -> dict[str, Any]:
        """As words and numbers, for people and programs."""
        known = self.lowest <= self.highest
        return {
            "points": self.points,
            "status": dict(zip(STATUS, self.status, strict=True)),
            "kind": dict(zip(KINDS, self.kind, strict=True)),
            "method": dict(zip(METHODS[1:], self.method[1:], strict=True)),
            "lowest": self.lowest if known else None,
            "highest": self.highest if known else None,
        }


def _count(flags: Any, number: int) -> tuple[int, ...]:
    return tuple(np.bincount(np.ravel(flags), minlength=number).tolist())


def _sum(one: tuple[int, ...], other: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(a + b for a, b in zip(one, other, strict=True))
