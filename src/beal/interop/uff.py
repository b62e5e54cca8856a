"""Results in the universal file format: mode shapes as data set 55, time histories as data set 58."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray

START = END = "    -1"
NONE = "NONE"
TIME, DISPLACEMENT, VELOCITY, ACCELERATION, UNKNOWN = 17, 8, 11, 12, 0  # specific data types
QUANTITIES = {  # and direction
    "displacement": (DISPLACEMENT, 2),
    "rate": (VELOCITY, 2),
    "acceleration": (ACCELERATION, 2),
    "slope": (UNKNOWN, 6),
    "slope_rate": (UNKNOWN, 6),
}


def write_uff(dataset: "xarray.Dataset", path: str | os.PathLike[str]) -> None:
    """Write mode shapes (nodes as data set 15, shapes as 55) or motion at sensors (58) in the universal file format.

    The vehicle lies along X from nose to tail and deflects along Y. Shapes have six digits, histories thirteen.

    Parameters
    ----------
    dataset : xarray.Dataset
        What `mode_shapes` or `response` gives.
    path : str or path-like
    """
    lines = _histories(dataset) if "time" in dataset.dims else _modes(dataset)
    Path(path).write_text("\n".join([*lines, ""]), encoding="ascii", errors="replace")


def _modes(dataset: "xarray.Dataset") -> Iterator[str]:
    title = dataset.attrs["title"]
    yield from (START, f"{15:6d}")
    stations = dataset["station"].values.tolist()
    for node, station in enumerate(stations, 1):
        yield f"{node:10d}{0:10d}{0:10d}{1:10d}{station:13.5E}{0:13.5E}{0:13.5E}"
    yield END
    shapes = [
        dataset[f"{name}_real"].values + 1j * dataset[f"{name}_imag"].values for name in ("displacement", "slope")
    ]
    frequency, growth = dataset["angular_frequency"].values, dataset["growth_rate"].values
    for n, (omega, rate) in enumerate(zip(frequency.tolist(), growth.tolist(), strict=True)):
        real = rate == 0 and not any(shape[n].imag.any() for shape in shapes)
        yield from (START, f"{55:6d}", _line(title), NONE, _line(f"thrust {dataset.attrs['thrust']:.9g}"), NONE, NONE)
        # structural model, normal or complex modes, six degrees of freedom, displacement, real or complex, six values
        yield _integers(1, 2 if real else 3, 3, DISPLACEMENT, 2 if real else 5, 6)
        yield _integers(*((2, 4, 1, n + 1) if real else (2, 6, 1, n + 1)))
        yield from _reals(*((omega / (2 * np.pi), 1.0, 0.0, 0.0) if real else (rate, omega, 1.0, 0.0, 1.0, 0.0)))
        for node, (deflection, slope) in enumerate(zip(*(shape[n].tolist() for shape in shapes), strict=True), 1):
            values = (0j, deflection, 0j, 0j, 0j, slope)
            yield f"{node:10d}"
            yield from _reals(*(part for v in values for part in ((v.real,) if real else (v.real, v.imag))))
        yield END


def _histories(dataset: "xarray.Dataset") -> Iterator[str]:
    time = dataset["time"].values
    for node, sensor in enumerate(dataset["sensor"].values.tolist(), 1):
        for name, (kind, direction) in QUANTITIES.items():
            yield from (START, f"{58:6d}", _line(f"{sensor} {name}"), NONE, NONE, NONE, NONE)
            yield f"{1:5d}{0:10d}{0:5d}{0:10d} {_entity(sensor)}{node:10d}{direction:4d} {NONE:<10}{0:10d}{0:4d}"
            step = float(time[1] - time[0]) if len(time) > 1 else 0.0
            yield _integers(4, len(time), 1) + "".join(_reals(float(time[0]), step, 0.0))
            for what, label in ((TIME, "time"), (kind, name), (0, NONE), (0, NONE)):
                yield f"{what:10d}{0:5d}{0:5d}{0:5d} {label:<20} {NONE:<20}"
            yield from _doubles(dataset[name].values[node - 1])
            yield END


def _line(text: str) -> str:
    return " ".join(text.split())[:80] or NONE


def _entity(name: str) -> str:
    return f"{_line(name)[:10]:<10}"


def _integers(*values: int) -> str:
    return "".join(f"{value:10d}" for value in values)


def _reals(*values: float) -> Iterator[str]:
    for start in range(0, len(values), 6):
        yield "".join(f"{value:13.5E}" for value in values[start : start + 6])


def _doubles(values: NDArray[np.float64]) -> Iterator[str]:
    for start in range(0, len(values), 4):
        yield "".join(f"{value:20.12E}" for value in values[start : start + 4].tolist())
