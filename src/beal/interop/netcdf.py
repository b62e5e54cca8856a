"""Results as netCDF."""

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def write_netcdf(dataset: "xarray.Dataset", path: str | os.PathLike[str]) -> None:
    """Write a result as netCDF 3 with 64-bit offsets, which every netCDF reader takes and SciPy writes.

    Parameters
    ----------
    dataset : xarray.Dataset
        Of numbers and texts; netCDF has no complex ones.
    path : str or path-like
    """
    dataset.to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")
