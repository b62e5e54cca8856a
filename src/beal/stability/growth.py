"""How fast a vehicle's motion grows under a constant thrust."""

import numpy as np

from beal.discretisation.operators import Operators
from beal.stability.damped_roots import damped_roots
from beal.stability.pencil import pencil, reduced
from beal.stability.spectrum import spectrum
from beal.stability.zero_roots import rigid_body_root

ELASTIC = 6  # modes that are looked at
GROWING = 1e-6  # Re s beside |s| that is more than rounding


def largest_growth_rate(operators: Operators, thrust: float, rigid_body: bool = True) -> float:
    """Growth rate of the fastest growing motion; 0 where none grows and nothing decays.

    Parameters
    ----------
    operators : Operators
    thrust : float
        In N.
    rigid_body : bool
        Whether the rigid-body motions count where the thrust acts on the attitude; what only drifts does not grow.

    Returns
    -------
    float
        In 1/s, of the lowest six elastic modes and the rigid-body motions.

    Examples
    --------
    >>> from beal.discretisation import discretise
    >>> from beal.vehicle import Thrust, catalog
    >>> missile = catalog.beal().model_copy(update={"thrust": Thrust(tangency=0.8)})
    >>> [round(largest_growth_rate(discretise(missile), 0.01, rigid), 4) for rigid in (True, False)]
    [0.1095, 0.0]
    """
    elastic = float(spectrum(operators, thrust, count=ELASTIC).growth_rate.max())
    full = pencil(operators)
    if not rigid_body or not full.rigid or rigid_body_root(reduced(full), thrust) == "neutral":
        return elastic + 0.0  # no -0
    s = damped_roots(full, thrust)[: 2 * (full.rigid + ELASTIC)]
    growing = s.real[s.real > GROWING * np.abs(s)]
    return max(elastic, float(growing.max(initial=0.0))) + 0.0
