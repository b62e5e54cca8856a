"""Where a map is kept: a folder, or a URL that fsspec understands."""

import os
import shutil
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from beal.errors import ModelError

if TYPE_CHECKING:
    from zarr.abc.store import Store

OLD = 60.0  # seconds after which an unfinished file is taken to be left over from a program that was killed


@dataclass(frozen=True)
class Place:
    """An absolute path or a URL.

    Parameters
    ----------
    name : str
    """

    name: str

    @classmethod
    def of(cls, out: object) -> "Place":
        """The place that a user names; ``file://`` and ``local://`` are folders like any other.

        Examples
        --------
        >>> Place.of("s3://bucket/map.zarr"), Place.of("file:///data/map.zarr")
        (Place(name='s3://bucket/map.zarr'), Place(name='/data/map.zarr'))
        """
        protocol, url, rest = str(out).rpartition("://")
        if url and protocol not in ("file", "local"):
            return cls(str(out))
        return cls(str(Path(rest if url else str(out)).absolute()))

    def __str__(self) -> str:
        return self.name

    @property
    def is_url(self) -> bool:
        """Whether it is a URL and not a folder."""
        return "://" in self.name

    @property
    def is_shared(self) -> bool:
        """Whether other processes see it."""
        return not self.name.startswith("memory://")

    def exists(self) -> bool:
        """Whether anything is there."""
        if not self.is_url:
            return os.path.lexists(self.name)
        system, root = self._system()
        return bool(system.exists(root))

    def zarr(self) -> "Store":
        """As a store of zarr."""
        from zarr.storage import FsspecStore, LocalStore

        if not self.is_url:
            return LocalStore(self.name)
        self._system()
        return FsspecStore.from_url(self.name)

    @contextmanager
    def new(self) -> "Iterator[Place]":
        """A place to fill, that then gets this name; of a folder, either all is there in the end or nothing."""
        if self.is_url:
            yield self
            return
        self._tidy_beside()
        part = Path(self.name).with_name(f".{Path(self.name).name}.{uuid4().hex}.part")
        try:
            yield Place(str(part))
            part.rename(self.name)
        finally:
            shutil.rmtree(part, ignore_errors=True)

    def chunks(self, array: str, dimensions: int) -> Iterator[tuple[int, ...]]:
        """Indices of the chunks of an array that are there."""
        for key in self._files(f"{array}/c"):
            corner = key.split("/")[-dimensions:]
            if all(part.isdigit() for part in corner):
                yield tuple(map(int, corner))

    def tidy(self) -> None:
        """Removes what a killed program left unfinished."""
        if self.is_url:
            return
        self._tidy_beside()
        for path in self._files(""):
            if path.endswith(".partial") and _is_old(path):
                Path(path).unlink(missing_ok=True)

    def _tidy_beside(self) -> None:
        path = Path(self.name)
        for part in path.parent.glob(f".{path.name}.*.part"):
            if _is_old(part):
                shutil.rmtree(part, ignore_errors=True)

    def _files(self, folder: str) -> Iterable[str]:
        if self.is_url:
            system, root = self._system()
            yield from system.find(f"{root}/{folder}")
            return
        for where, _, names in os.walk(os.path.join(self.name, folder)):
            yield from (f"{where}/{name}" for name in names)

    def _system(self) -> tuple[Any, str]:
        """The file system of a URL, and the path in it."""
        try:
            from fsspec.core import url_to_fs
        except ModuleNotFoundError:
            raise ModelError(f"{self.name}: URLs need fsspec, which is not installed; install beal[cluster]") from None
        try:
            return url_to_fs(self.name)
        except (ImportError, ValueError) as error:  # the protocol's own package is missing, or no such protocol
            raise ModelError(f"{self.name}: cannot be opened, {error}") from None


def _is_old(path: str | Path) -> bool:
    try:
        return time.time() - os.stat(path).st_mtime > OLD
    except FileNotFoundError:
        return False
