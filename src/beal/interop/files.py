"""A vehicle from any file that holds one, and into any, by the ending of the name."""

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beal.errors import ModelError
from beal.interop.cells import csv_text, sheet_content
from beal.interop.matlab import write_matlab
from beal.interop.nastran import Imported, read_nastran
from beal.interop.nastran_deck import nastran_text
from beal.interop.netcdf import write_netcdf
from beal.interop.stations import read_stations
from beal.interop.stations_out import station_rows
from beal.interop.uff import write_uff
from beal.vehicle.file import dumps, read_toml, vehicle_from
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray

DECKS, TABLES = (".bdf", ".dat", ".nas"), (".csv", ".xlsx")
RESULTS = {".nc": write_netcdf, ".mat": write_matlab, ".uff": write_uff, ".unv": write_uff}


def load(path: str | os.PathLike[str]) -> Vehicle:
    """Read a vehicle from a model file.

    Parameters
    ----------
    path : str or path-like
        A TOML file, where in SI files (the default) a quantity is a number or a string with a unit, such as
        ``"12 ft"``; Nastran bulk data (``.bdf``, ``.dat``, ``.nas``); or a station table (``.csv``, ``.xlsx``).

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        With every problem in the file, each with its path, or the reason why the file cannot be read.

    Warns
    -----
    UserWarning
        Of what has an influence in the file and was left out or simplified.
    """
    found = imported(path)
    for line in found.ignored:
        warnings.warn(f"{path}: {line}", stacklevel=2)
    return found.vehicle


def imported(path: str | os.PathLike[str], **options: Any) -> Imported:
    """Read a vehicle from a file of any known kind, with notes on how it was understood.

    Parameters
    ----------
    path : str or path-like
    **options
        Those of `read_nastran` or `read_stations`.

    Returns
    -------
    Imported

    Raises
    ------
    ModelError
        With every problem in the file, or if an option does not suit its kind.
    """
    ending = Path(path).suffix.lower()
    known = {
        **dict.fromkeys(DECKS, ("plane", "nose", "lumps", "length_unit", "force_unit")),
        **dict.fromkeys(TABLES, ("x_from", "columns")),
    }.get(ending, ())
    if unsuited := [name for name in options if name not in known]:
        choices = f"takes {', '.join(known)}" if known else "takes no options"
        raise ModelError(
            [(name, f"does not suit {ending or 'this'} files, which {choices}"[:200]) for name in unsuited]
        )
    if ending in DECKS:
        return read_nastran(path, **options)
    if ending in TABLES:
        return read_stations(path, **options)
    return Imported(vehicle_from(read_toml(path), str(path)))


def content(vehicle: Vehicle, path: str | os.PathLike[str], elements: int | None = None) -> bytes:
    """A vehicle as the content of a file of the kind that the name's ending says.

    Parameters
    ----------
    vehicle : Vehicle
    path : str or path-like
        Ending with ``.toml``, ``.bdf``, ``.dat``, ``.nas``, ``.csv`` or ``.xlsx``.
    elements : int, optional
        Bars in each stage of a deck.

    Returns
    -------
    bytes

    Raises
    ------
    ModelError
        If the ending is unknown.
    """
    ending = Path(path).suffix.lower()
    if elements is not None and ending not in DECKS:
        raise ModelError([("elements", f"does not suit {ending or 'this'} files, only {', '.join(DECKS)}")])
    if ending in DECKS:
        return nastran_text(vehicle, **({} if elements is None else {"elements": elements})).encode()
    if ending == ".xlsx":
        return sheet_content(station_rows(vehicle))
    if ending == ".csv":
        return csv_text(station_rows(vehicle)).encode()
    if ending != ".toml":
        raise ModelError(f"must end with {', '.join(('.toml', *TABLES, *DECKS))}", str(path))
    return dumps(vehicle).encode()


def write_result(dataset: "xarray.Dataset", path: str | os.PathLike[str], ending: str) -> None:
    """Write a result of `beal.interop.results` as a file of another program.

    Parameters
    ----------
    dataset : xarray.Dataset
    path : str or path-like
    ending : str
        ``.nc``, ``.mat``, ``.uff`` or ``.unv``: the kind of file.

    Raises
    ------
    ModelError
        If the universal file format has no place for this result.
    """
    if RESULTS[ending] is write_uff and not {"point", "time"} & set(dataset.dims):
        raise ModelError(f"{ending} files hold mode shapes and time histories: give .csv, .nc or .mat")
    RESULTS[ending](dataset, path)
