"""Linear maps Z -> sum of A Z B^T between symmetric and antisymmetric matrices, on their independent entries."""

import numpy as np
from numpy.typing import NDArray

from beal.stability.pencil import Array

Pairs = tuple[NDArray[np.intp], NDArray[np.intp]]


def pairs(kept: NDArray[np.bool_], diagonal: bool) -> Pairs:
    """Entries i > j (i >= j) of a matrix, those of which at least one index is kept."""
    i, j = np.tril_indices(len(kept), 0 if diagonal else -1)
    either = kept[i] | kept[j]
    return i[either], j[either]


def matrix(rows: Pairs, columns: Pairs, sign: float, *products: tuple[Array, Array]) -> Array:
    """The map from the entries ``columns`` of Z = sign * Z^T to the entries ``rows`` of the sum of A Z B^T.

    Parameters
    ----------
    rows, columns : pairs of indices
    sign : {1, -1}
    products : pairs (A, B) of ndarray, shape (n, n)

    Returns
    -------
    ndarray, shape (len(rows), len(columns))

    Examples
    --------
    >>> turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    >>> one = pairs(np.array([True, True]), False)
    >>> matrix(one, one, -1, (turn, turn)).tolist()  # T Z T^T = det(T) Z
    [[1.0]]
    """
    (i, j), (k, m) = rows, columns
    mapped = np.zeros((len(i), len(k)))
    for A, B in products:
        mapped += A[np.ix_(i, k)] * B[np.ix_(j, m)]
        mapped += np.where(k == m, 0.0, sign) * A[np.ix_(i, m)] * B[np.ix_(j, k)]
    return mapped
