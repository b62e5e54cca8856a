"""The characteristic function of a joint's two springs, with its derivatives in thrust and W."""

from collections.abc import Sequence

import numpy as np
from numpy.polynomial import chebyshev

from beal.stability.pencil import Array
from beal.stability.table import THRUST_DEGREE, W_DEGREE, Panel


class Surface:
    """D at the four ends of the two springs, with its derivatives, over all thrusts up to a target."""

    def __init__(self, panels: Sequence[Panel], ends: Sequence[float]) -> None:
        self.panels, self.ends = panels, np.asarray(ends)
        self.lowest = float(panels[0].edges[1])

    def __call__(self, thrust: Array, W: Array, in_thrust: int = 0, in_W: int = 0) -> Array:
        """Derivative of D of some orders, shape (4, n)."""
        values = np.empty((4, len(thrust)))
        index = np.clip(np.searchsorted(self.ends, thrust) - 1, 0, len(self.panels) - 1)
        for number in np.unique(index):
            here = index == number
            values[:, here] = self._on(number, thrust[here], W[here], in_thrust, in_W)
        return values

    def _on(self, number: int, thrust: Array, W: Array, in_thrust: int, in_W: int) -> Array:
        panel, (low, high) = self.panels[number], self.ends[number : number + 2]
        patch = np.clip(np.searchsorted(panel.edges, W) - 1, 0, len(panel.patches) - 1)
        width = np.diff(panel.edges)[patch]
        rows = (
            _derived(2 * (thrust - low) / (high - low) - 1, THRUST_DEGREE, in_thrust) * (2 / (high - low)) ** in_thrust
        )
        columns = _derived(2 * (W - panel.edges[patch]) / width - 1, W_DEGREE, in_W) * (2 / width[:, None]) ** in_W
        series = panel.patches.reshape(*panel.patches.shape[:2], THRUST_DEGREE + 1, W_DEGREE + 1)
        found = np.empty((4, len(W)))
        for one in np.unique(patch):
            here = patch == one
            found[:, here] = np.einsum("sij,ni,nj->sn", series[one], rows[here], columns[here], optimize=True)
        return found


def _derived(x: Array, degree: int, order: int) -> Array:
    """Derivatives of the Chebyshev polynomials, shape (n, degree + 1)."""
    inner = chebyshev.chebder(np.eye(degree + 1), order) if order else np.eye(degree + 1)
    return np.asarray(chebyshev.chebvander(x, len(inner) - 1) @ inner, dtype=np.float64)
