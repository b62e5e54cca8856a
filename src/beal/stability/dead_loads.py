"""Whether a vehicle bears the loads that do not grow with the thrust, such as its weight."""

import numpy as np

from beal.errors import ModelError
from beal.stability.damped import fed_modes
from beal.stability.pencil import Pencil
from beal.stability.ridge import REAL
from beal.stability.zero_roots import ZERO, rigid_body_root


def check_dead_loads(undamped: Pencil, limit: float, damped: Pencil | None = None, top: float = 0.0) -> None:
    """Refuse a vehicle whose elastic modes its dead loads alone make unstable.

    Parameters
    ----------
    undamped : Pencil
        Reduced; divergence does not notice damping.
    limit : float
        Thrust to be searched to.
    damped : Pencil, optional
        Of the same vehicle with its damping, if it has any, which decides on flutter.
    top : float
        Frequency up to which damped modes are looked at, in rad/s.

    Raises
    ------
    ModelError
    """
    if undamped.dead is None:
        return
    roots = undamped.roots(0.0)
    pairs = np.abs(roots.imag) > REAL * np.abs(roots) + ZERO * undamped.shift
    falling = np.sum(roots[~pairs].real < -ZERO * undamped.shift)
    tumbles = rigid_body_root(undamped, limit) == "tumbling"
    flutters = np.any(pairs) if damped is None else fed_modes(damped, undamped, 0.0, limit, top)
    if flutters or falling > tumbles:
        raise ModelError("axial_load: the dead loads alone, axial loads and gravity, make the vehicle unstable")
