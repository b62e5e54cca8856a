"""Results of a study on disk: a zarr group that xarray opens, filled block by block.

A block is a chunk of every array. Its status is written last, so what is marked done is done, whenever the program was
stopped; blocks still marked pending are solved again on resumption.
"""

import json
import warnings
from collections.abc import Iterator, Mapping
from importlib.metadata import version
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.study.study import Study

BLOCK = 256  # points of a block at least, along the last axes
STATUS = ("pending", "solved", "not_converged", "invalid")
KINDS = ("stable", "flutter", "divergence")
VARIABLES: dict[str, tuple[str, Any]] = {
    "critical_thrust": ("float64", np.nan),
    "kind": ("int8", 0),
    "mode_low": ("int8", 0),
    "mode_high": ("int8", 0),
    "angular_frequency": ("float64", np.nan),
    "error_estimate": ("float64", np.nan),
    "status": ("int8", 0),
}

Block = tuple[slice, ...]
Arrays = dict[str, NDArray[Any]]


def block_shape(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Shape of a block: whole trailing axes until it holds enough points, single points of the others."""
    sizes = [1] * len(shape)
    for axis in reversed(range(len(shape))):
        room = -(-BLOCK // int(np.prod(sizes)))
        sizes[axis] = min(shape[axis], room)
    return tuple(sizes)


def blocks(shape: tuple[int, ...]) -> Iterator[Block]:
    """The blocks of a grid, in order."""
    sizes = block_shape(shape)
    starts = (range(0, points, size) for points, size in zip(shape, sizes, strict=True))
    for corner in product(*starts):
        yield tuple(slice(a, min(a + b, n)) for a, b, n in zip(corner, sizes, shape, strict=True))


def empty(shape: tuple[int, ...]) -> Arrays:
    """Arrays of a grid that is still to be solved."""
    return {name: np.full(shape, fill, dtype) for name, (dtype, fill) in VARIABLES.items()}


def attributes(study: Study) -> dict[str, Any]:
    """What the dataset says of itself: the resolved inputs, their hash, version, units and formulation."""
    return {
        "title": study.vehicle.title,
        "inputs": json.dumps(study.inputs),
        "inputs_sha256": study.digest,
        "beal_version": version("beal"),
        "units": study.vehicle.units,
        "formulation": study.solve.formulation,
    }


def variable_attributes(name: str, units: str) -> dict[str, Any]:
    """Units, or the meaning of flags, of a variable."""
    flags = {"kind": KINDS, "status": STATUS}
    if name in flags:
        return {"flag_values": list(range(len(flags[name]))), "flag_meanings": " ".join(flags[name])}
    units_of = {"critical_thrust": "N", "error_estimate": "N", "angular_frequency": "rad/s"}
    return {"units": units_of[name] if units == "SI" else "1"} if name in units_of else {}


class Store:
    """The zarr group of one study.

    Parameters
    ----------
    path : Path
    study : Study
    resume : bool
        Whether to go on with what is there.

    Raises
    ------
    ModelError
        If something is there already, or was computed from other inputs, or nothing can be written there.
    """

    def __init__(self, path: Path, study: Study, resume: bool) -> None:
        self.path = path
        if path.exists() and not resume:
            raise ModelError(f"{path}: exists already; continue it with --resume, or name another place or remove it")
        try:
            self._group = self._opened(study) if path.exists() else self._created(study)
        except OSError as error:
            raise ModelError(f"{path}: cannot be written, {error.strerror or error}") from None
        self.arrays: Mapping[str, zarr.Array[Any]] = {name: self._group[name] for name in VARIABLES}  # type: ignore[misc]

    def _created(self, study: Study) -> zarr.Group:
        group = zarr.create_group(store=str(self.path), attributes=attributes(study))
        for path, values in study.axes.items():
            axis = group.create_array(path, shape=(len(values),), dtype="float64", dimension_names=(path,))
            axis[:] = np.array(values)
        for name, (dtype, fill) in VARIABLES.items():
            group.create_array(
                name,
                shape=study.shape,
                chunks=block_shape(study.shape),
                dtype=dtype,
                fill_value=fill,
                dimension_names=tuple(study.axes),
                attributes=variable_attributes(name, study.vehicle.units),
            )
        with warnings.catch_warnings():  # an extension of the format, which xarray looks for first
            warnings.simplefilter("ignore", category=UserWarning)
            zarr.consolidate_metadata(str(self.path))
        return group

    def _opened(self, study: Study) -> zarr.Group:
        try:
            group = zarr.open_group(str(self.path), mode="r+")
            inputs = json.loads(str(group.attrs["inputs"]))
        except (KeyError, ValueError, FileNotFoundError):
            raise ModelError(f"{self.path}: is not a map of this program; name another place") from None
        now = study.inputs
        changed = sorted(name for name in {*now, *inputs} if now.get(name) != inputs.get(name))
        if changed:
            details = [(name, f"was {_short(inputs.get(name))}, is {_short(now.get(name))}") for name in changed]
            raise ModelError([(f"{self.path}", "cannot be resumed, its inputs have changed"), *details])
        return group

    def pending(self, block: Block) -> bool:
        """Whether a block is still to be solved."""
        return bool(np.any(np.asarray(self.arrays["status"][block]) == 0))

    def write(self, block: Block, arrays: Arrays) -> None:
        """Writes a block, its status last.

        Raises
        ------
        ModelError
            If the disk is full or not writable; the blocks written before are kept.
        """
        try:
            for name, values in arrays.items():
                self.arrays[name][block] = values  # status is the last of VARIABLES
        except OSError as error:
            reason = error.strerror or error
            raise ModelError(
                f"{self.path}: cannot be written, {reason}; what was solved before is kept, go on with --resume"
            ) from None


def _short(text: str | None) -> str:
    if text is None:
        return "absent"
    return text if len(text) <= 60 else f"{text[:57]}..."
