"""Results of a study on disk: a zarr group that xarray opens, filled block by block.

A block is a chunk of every array. Its status is written last, so what has a status is done, whenever the program was
stopped; blocks without are solved again on resumption. The group appears under its name when it is whole, and it holds
the study, so that a worker anywhere needs its place alone.
"""

import json
import os
import socket
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.metadata import version
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.study.blocks import Blocks, blocks
from beal.study.place import Place
from beal.study.study import Solve, Study
from beal.study.variables import VARIABLES, Arrays, variable_attributes
from beal.vehicle.file import loads
from beal.vehicle.links import Link


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


def prepare(out: object, study: Study, resume: bool) -> "Store":
    """The store of a study, made or found again.

    Parameters
    ----------
    out : str or Path
    study : Study
    resume : bool
        Whether to go on with what is there.

    Returns
    -------
    Store

    Raises
    ------
    ModelError
        If something is there already, or was made from other inputs or by another version, or nothing can be written.
    """
    place = Place.of(out)
    try:
        if not place.exists():
            with place.new() as new:
                _create(new, study)
        elif not resume:
            raise ModelError(f"{out}: exists already; continue it with --resume, or name another place or remove it")
        else:
            place.tidy()
            _check(out, place, study)
    except OSError as error:
        raise ModelError(f"{out}: cannot be written, {error.strerror or error}") from None
    return Store(place, study.digest)


def _create(place: Place, study: Study) -> None:
    group = zarr.create_group(store=place.zarr())
    for path, values in study.axes.items():
        axis = group.create_array(path, shape=(len(values),), dtype="float64", dimension_names=(path,))
        axis[:] = np.array(values)
    for name, (dtype, fill) in VARIABLES.items():
        group.create_array(
            name,
            shape=study.shape,
            chunks=blocks(study).sizes,
            dtype=dtype,
            fill_value=fill,
            dimension_names=tuple(study.axes),
            attributes=variable_attributes(name, study.vehicle.units),
        )
    with warnings.catch_warnings():  # an extension of the format, which xarray looks for first
        warnings.simplefilter("ignore", category=UserWarning)
        zarr.consolidate_metadata(place.zarr()).update_attributes(attributes(study))


def _check(out: object, place: Place, study: Study) -> None:
    """Refuses to go on with a store that was made from something else."""
    try:
        was = dict(zarr.open_group(place.zarr(), mode="r").attrs)
        inputs = json.loads(str(was["inputs"])) | {"beal_version": was["beal_version"]}
    except (KeyError, ValueError, FileNotFoundError):
        raise ModelError(f"{out}: is not a map of this program, or not a whole one; name another place") from None
    now: Mapping[str, Any] = study.inputs | {"beal_version": version("beal")}
    changed = sorted(name for name in {*now, *inputs} if now.get(name) != inputs.get(name))
    if changed:
        details = [(name, f"was {_short(inputs.get(name))}, is {_short(now.get(name))}") for name in changed]
        raise ModelError([(str(out), "cannot be resumed, its inputs have changed"), *details])


def _short(text: str | None) -> str:
    if text is None:
        return "absent"
    return text if len(text) <= 60 else f"{text[:57]}..."


@dataclass(frozen=True)
class Store:
    """The zarr group of one study, as any worker finds it.

    Parameters
    ----------
    place : Place
    digest : str
        SHA-256 of the study's inputs, which must be those at the place.
    """

    place: Place
    digest: str

    @property
    def study(self) -> Study:
        """The study, as it was written."""
        return self._opened.study

    @property
    def blocks(self) -> Blocks:
        """The blocks, as they were cut when the store was made."""
        return self._opened.blocks

    def done(self) -> NDArray[np.bool_]:
        """Which blocks have a status, shape (blocks,)."""
        found = np.zeros(len(self.blocks), dtype=bool)
        for corner in self.place.chunks("status", len(self.blocks.shape)):
            found[np.ravel_multi_index(corner, self.blocks.counts)] = True
        return found

    def read(self, index: int) -> Arrays:
        """All variables of a block."""
        return {name: np.asarray(array[self.blocks[index]]) for name, array in self._opened.arrays.items()}

    def write(self, index: int, arrays: Arrays) -> None:
        """Writes a block, its status last.

        Raises
        ------
        ModelError
            If the disk is full or not writable; the blocks written before are kept.
        """
        try:
            for name, array in self._opened.arrays.items():
                array[self.blocks[index]] = arrays[name]
        except OSError as error:
            reason = error.strerror or error
            raise ModelError(
                f"{self.place}: cannot be written, {reason}; what was solved before is kept, go on with --resume"
            ) from None

    @property
    def _opened(self) -> "_Opened":
        return _opened(self.place, self.digest, os.getpid())


@dataclass(frozen=True)
class _Opened:
    """What a process has found at a place."""

    group: zarr.Group

    @cached_property
    def arrays(self) -> Mapping[str, "zarr.Array[Any]"]:
        return {name: self.group[name] for name in VARIABLES}  # type: ignore[misc]

    @cached_property
    def blocks(self) -> Blocks:
        return Blocks(self.arrays["status"].shape, self.arrays["status"].chunks)

    @cached_property
    def study(self) -> Study:
        inputs = json.loads(str(self.group.attrs["inputs"]))
        dimensions: Iterable[Any] = self.arrays["status"].metadata.dimension_names or ()  # type: ignore[union-attr]
        axes = {path: tuple(np.asarray(self.group[path][:]).tolist()) for path in dimensions}  # type: ignore[index]
        solve = {key.removeprefix("solve."): json.loads(text) for key, text in inputs.items() if key[:6] == "solve."}
        links = {key[len("links.") :]: Link(**json.loads(text)) for key, text in inputs.items() if key[:6] == "links."}
        return Study(loads(inputs["model"]), axes, Solve(**solve), links)


@lru_cache(maxsize=4)
def _opened(place: Place, digest: str, process: int) -> _Opened:
    """Opened once in each process: what was opened before a fork may hold on to threads that are no more."""
    try:
        group = zarr.open_group(place.zarr(), mode="r+")
    except FileNotFoundError:
        host = socket.gethostname()
        raise ModelError(f"{place}: not there on {host}; give a place that all workers see under this name") from None
    if (group.attrs.get("inputs_sha256"), group.attrs.get("beal_version")) != (digest, version("beal")):
        raise ModelError(f"{place}: was made anew meanwhile, or beal {version('beal')} of a worker is another version")
    return _Opened(group)
