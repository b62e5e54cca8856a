"""What is known of each point of a study, and the codes that it is kept in."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

STATUS = ("pending", "solved", "not_converged", "invalid")
KINDS = ("stable", "flutter", "divergence")
METHODS = ("none", "tables", "single")
VARIABLES: dict[str, tuple[str, Any]] = {
    "critical_thrust": ("float64", np.nan),
    "kind": ("int8", 0),
    "mode_low": ("int8", 0),
    "mode_high": ("int8", 0),
    "angular_frequency": ("float64", np.nan),
    "error_estimate": ("float64", np.nan),
    "border": ("int8", 0),  # 1 where something else comes first at practically the same thrust, or next to the point
    "method": ("int8", 0),
    "status": ("int8", 0),  # last, see above
}

Arrays = dict[str, NDArray[Any]]


def empty(shape: tuple[int, ...]) -> Arrays:
    """Arrays of a grid that is still to be solved."""
    return {name: np.full(shape, fill, dtype) for name, (dtype, fill) in VARIABLES.items()}


def variable_attributes(name: str, units: str) -> dict[str, Any]:
    """Units, or the meaning of flags, of a variable."""
    flags = {"kind": KINDS, "method": METHODS, "border": ("no", "yes"), "status": STATUS}
    if name in flags:
        return {"flag_values": list(range(len(flags[name]))), "flag_meanings": " ".join(flags[name])}
    units_of = {"critical_thrust": "N", "error_estimate": "N", "angular_frequency": "rad/s"}
    return {"units": units_of[name] if units == "SI" else "1"} if name in units_of else {}
