"""Scattered points of a refined map on disk: a group in the zarr store of the grid, to which blocks are added.

The status of a block is written last, so what is marked done is done, whenever the program was stopped.
"""

import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from beal.errors import ModelError
from beal.study.place import Place

GROUP = "refined"
CHUNK = 16384

Variable = tuple[tuple[str, ...], NDArray[Any], Mapping[str, Any]]  # dimensions, values, attributes


class PointStore:
    """The group of refined points in the store of a grid.

    Parameters
    ----------
    place : Place
        Of the store.
    empty : mapping of str to variable
        Every variable of a point, without points, ``status`` last.

    Raises
    ------
    ModelError
        If it cannot be written.
    """

    def __init__(self, place: Place, empty: Mapping[str, Variable]) -> None:
        self.place, self.names = place, tuple(empty)
        with self._writing():
            root = zarr.open_group(place.zarr(), mode="r+", use_consolidated=False)
            self._group = root.require_group(GROUP)
            for name, variable in empty.items():
                if name not in self._group:
                    self._create(name, variable)
        lengths = [self._array(name).shape[0] for name in self.names]
        done = np.asarray(self._array("status")[: min(lengths)]) > 0
        self.count = int(len(done) if done.all() else np.argmin(done))

    def read(self, name: str) -> NDArray[Any]:
        """A variable at the points that are there."""
        return np.asarray(self._array(name)[: self.count])

    def append(self, columns: Mapping[str, NDArray[Any]]) -> None:
        """Adds points.

        Raises
        ------
        ModelError
            If the disk is full or not writable; what was added before is kept.
        """
        end = self.count + len(columns["status"])
        with self._writing():
            for name in self.names:
                array = self._array(name)
                array.resize((end, *array.shape[1:]))
            for name in self.names:
                self._array(name)[self.count : end] = columns[name]
            self._consolidate()
        self.count = end

    def finish(self, variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> None:
        """Writes what is no variable of a point, in place of what was there."""
        with self._writing():
            for name, variable in variables.items():
                self._create(name, variable)
            self._group.attrs.update(attributes)
            self._consolidate()

    def _create(self, name: str, variable: Variable) -> None:
        dimensions, values, attributes = variable
        array = self._group.create_array(
            name,
            shape=values.shape,
            chunks=(CHUNK, *(max(1, length) for length in values.shape[1:])),
            dtype=values.dtype,
            fill_value=np.nan if values.dtype.kind == "f" else 0,
            dimension_names=dimensions,
            attributes=dict(attributes),
            overwrite=True,
        )
        array[...] = values

    def _array(self, name: str) -> "zarr.Array[Any]":
        return self._group[name]  # type: ignore[return-value]

    def _consolidate(self) -> None:
        with (
            warnings.catch_warnings()
        ):  # an extension of the format; xarray looks for groups in that of the whole store
            warnings.simplefilter("ignore", category=UserWarning)
            zarr.consolidate_metadata(self.place.zarr())

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            reason = error.strerror or error
            raise ModelError(
                f"{self.place}: cannot be written, {reason}; what was solved before is kept, go on with --resume"
            ) from None
