"""Results as MATLAB data."""

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def write_matlab(dataset: "xarray.Dataset", path: str | os.PathLike[str]) -> None:
    """Write a result as a ``.mat`` file (version 5): one variable for each array and attribute, vectors as columns.

    Parameters
    ----------
    dataset : xarray.Dataset
    path : str or path-like
    """
    from scipy.io import savemat

    arrays = {str(name): array.values for name, array in dataset.variables.items()}
    texts = {name: array.astype(object) for name, array in arrays.items() if array.dtype.kind in "UO"}  # cells
    savemat(
        path, {**arrays, **texts, **{str(k): v for k, v in dataset.attrs.items()}}, oned_as="column", appendmat=False
    )
