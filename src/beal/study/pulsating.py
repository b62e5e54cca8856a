"""Instability charts of a pulsating thrust: Floquet's multipliers over its frequency and amplitude."""

import os
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from beal.discretisation.operators import Operators
from beal.errors import ModelError
from beal.stability.floquet import MODES, check, check_frequency, discretised, steady_growth_rate
from beal.stability.pencil import Array
from beal.stability.periodic import PulsatingEquations, monodromy, pulsating_equations
from beal.stability.resonances import KINDS, resonance_name, resonances
from beal.stability.threads import one_thread
from beal.study.place import Place
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

SETTLED = 1e-10
NODES = (8, 16, 32, 64)  # amplitudes between which the monodromy matrix is interpolated
LAST = 2  # coefficients that tell the error


def floquet_chart(
    vehicle: Vehicle | Operators,
    thrust: float,
    angular_frequencies: Sequence[float] | Array,
    amplitudes: Sequence[float] | Array,
    modes: int = MODES,
    progress: Callable[[int, int], None] | None = None,
) -> "xarray.Dataset":
    """Largest Floquet multiplier over the frequency and the amplitude of a pulsating thrust.

    The monodromy matrix is an entire function of the amplitude: at each frequency it is computed at a few Chebyshev
    nodes and interpolated between them, to ten digits.

    Parameters
    ----------
    vehicle : Vehicle or Operators
    thrust : float
        P0, in N.
    angular_frequencies, amplitudes : sequence of float
        Omega in rad/s and P1 in N, each ascending.
    modes : int
        Elastic modes whose inertia is kept; those above follow statically.
    progress : callable, optional
        Called with the number of frequencies done and of all.

    Returns
    -------
    xarray.Dataset
        ``largest_modulus``, ``growth_rate`` and ``stable`` over ``angular_frequency`` and ``amplitude``; along
        ``resonance`` those within the frequencies: ``resonance_angular_frequency``, ``_kind``, ``_low`` and ``_high``
        (the modes) and ``_order``.

    Raises
    ------
    ModelError
        If a value is out of range or a list is not ascending.
    ConvergenceError
        If the multipliers do not settle.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> chart = floquet_chart(catalog.beck(), 5.0, [8.3569, 8.357, 8.5186, 8.5187], [0.0, 0.5])
    >>> chart.stable.values.astype(int).tolist()
    [[1, 1], [1, 0], [1, 0], [1, 1]]
    """
    frequency = _ascending("angular_frequencies", angular_frequencies)
    amplitude = _ascending("amplitudes", amplitudes)
    check(thrust, amplitude.tolist(), frequency.tolist(), modes)
    with one_thread():
        operators = discretised(vehicle, modes)
        equations = pulsating_equations(operators, thrust, modes)
        check_frequency(float(frequency[-1]), equations)
        rows = []
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            for row in threads.map(partial(_row, equations, amplitude), frequency.tolist()):
                rows.append(row)
                if progress:
                    progress(len(rows), len(frequency))
    return _dataset(operators, equations, float(thrust), frequency, amplitude, np.array(rows))


def write_chart(chart: "xarray.Dataset", place: Place) -> None:
    """Write a chart as a zarr folder, all of it or nothing."""
    with place.new() as new, warnings.catch_warnings():  # an extension of the format, which xarray looks for first
        warnings.simplefilter("ignore", category=UserWarning)
        chart.to_zarr(new.name, consolidated=True)


def chart_resonances(chart: "xarray.Dataset") -> list[tuple[str, float]]:
    """Names and frequencies of the resonances of a chart, in order of frequency."""
    columns = (
        chart[f"resonance_{name}"].values.tolist() for name in ("kind", "low", "high", "order", "angular_frequency")
    )
    return [
        (resonance_name(KINDS[kind], (low, high), order), omega)
        for kind, low, high, order, omega in zip(*columns, strict=True)
    ]


def _row(equations: PulsatingEquations, amplitudes: Array, frequency: float) -> Array:
    """Largest modulus at each amplitude."""
    multipliers = np.linalg.eigvals(_transitions(equations, amplitudes, frequency))
    return np.asarray(np.abs(multipliers).max(axis=1))


def _transitions(equations: PulsatingEquations, amplitudes: Array, frequency: float) -> Array:
    """The monodromy matrices, interpolated where that takes fewer of them."""
    low, high = float(amplitudes[0]), float(amplitudes[-1])
    middle, half = (high + low) / 2, (high - low) / 2
    for count in NODES:
        if count >= len(amplitudes):
            break
        nodes = np.cos(np.pi * (np.arange(count) + 0.5) / count)
        known, _ = monodromy(equations, middle + half * nodes, frequency, SETTLED)
        basis = np.polynomial.chebyshev.chebvander(nodes, count - 1)
        coefficients = np.linalg.solve(basis, known.reshape(count, -1))
        if np.abs(coefficients[-LAST:]).max() <= SETTLED * np.abs(known).max(axis=(1, 2)).min():
            at = np.polynomial.chebyshev.chebvander((amplitudes - middle) / half, count - 1)
            return np.asarray((at @ coefficients).reshape(-1, *known.shape[1:]))
    return monodromy(equations, amplitudes, frequency, SETTLED)[0]


def _dataset(
    operators: Operators,
    equations: PulsatingEquations,
    thrust: float,
    frequency: Array,
    amplitude: Array,
    largest: Array,
) -> "xarray.Dataset":
    import xarray

    grid = ("angular_frequency", "amplitude")
    within = [r for r in resonances(equations) if frequency[0] <= r.angular_frequency <= frequency[-1]]
    si = operators.vehicle.units == "SI"
    units = {"angular_frequency": "rad/s", "amplitude": "N", "growth_rate": "1/s"}
    chart = xarray.Dataset(
        {
            "largest_modulus": (grid, largest),
            "growth_rate": (grid, np.log(largest) * frequency[:, None] / (2 * np.pi)),
            "stable": (grid, largest <= equations.neutral),
            "resonance_angular_frequency": ("resonance", np.array([r.angular_frequency for r in within], dtype=float)),
            "resonance_kind": (
                "resonance",
                np.array([KINDS.index(r.kind) for r in within], dtype=np.int8),
                {"flag_values": list(range(len(KINDS))), "flag_meanings": " ".join(KINDS)},
            ),
            "resonance_low": ("resonance", np.array([r.modes[0] for r in within], dtype=np.int8)),
            "resonance_high": ("resonance", np.array([r.modes[1] for r in within], dtype=np.int8)),
            "resonance_order": ("resonance", np.array([r.order for r in within], dtype=np.int8)),
        },
        coords={"angular_frequency": frequency, "amplitude": amplitude},
        attrs={
            "title": operators.vehicle.title,
            "thrust": thrust,
            "steady_growth_rate": steady_growth_rate(equations),
            "rigid_body_modes": operators.rigid - equations.rigid,
            "modes": len(equations.A) - equations.rigid,
            "units": operators.vehicle.units,
            "beal_version": version("beal"),
        },
    )
    for name, unit in units.items():
        chart[name].attrs["units"] = unit if si else "1"
    return chart


def _ascending(name: str, values: Sequence[float] | Array) -> Array:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or not len(array) or not np.all(np.diff(array) > 0):
        raise ModelError(f"{name}: must be numbers in ascending order, found {values}")
    return array
