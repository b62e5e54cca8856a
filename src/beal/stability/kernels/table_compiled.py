"""Values of the characteristic function at the nodes of a table, compiled."""

import numpy as np

from beal.stability.kernels.compiled import compiled


@compiled
def determinants(H, left, right, s):
    """det(I - s H) det(rows of G where a spring is rigid, of I - G where it is free), G = left^T (I - s H)^-1 right.

    Parameters
    ----------
    H : ndarray, shape (n, n)
        Upper Hessenberg.
    left, right : ndarray, shape (n, springs)
    s : ndarray, shape (k,)

    Returns
    -------
    ndarray, shape (2**springs, k)
        The subsets of rigid springs by the binary digits of their index.
    """
    n, m = right.shape
    values = np.empty((2**m, len(s)))
    A, G = np.empty((n + m, n + m)), np.empty((m, m))
    rows, pivots, products = np.empty((m, m)), np.empty(m, dtype=np.int64), np.empty(m + 1)
    for j in range(len(s)):
        for r in range(n):  # I - s H with the columns of right beside it and the rows of left below
            for c in range(n):
                A[r, c] = -s[j] * H[r, c]
            A[r, r] += 1.0
            for u in range(m):
                A[r, n + u] = right[r, u]
        for t in range(m):
            for r in range(n):
                A[n + t, r] = left[r, t]
            for u in range(m):
                A[n + t, n + u] = 0.0
        products[0] = eliminate(A, n)
        for t in range(m):
            for u in range(m):
                G[t, u] = -A[n + t, n + u]
        for number in range(2**m):  # its binary digits, the highest first: whether each spring is rigid
            same = m
            while same and (number == 0 or (number ^ (number - 1)) >> (m - same)):
                same -= 1
            subset = 0
            for t in range(m):
                rigid = number >> (m - 1 - t) & 1
                subset |= rigid << t
                if t >= same:
                    extend(G, t, rigid, rows, pivots, products)
            values[subset, j] = products[m]
    return values


@compiled
def eliminate(A, n):
    """The determinant of the leading block, upper Hessenberg; its Schur complement is left in the last rows."""
    determinant = 1.0
    size = len(A)
    for k in range(n):
        if k + 1 < n and abs(A[k + 1, k]) > abs(A[k, k]):
            determinant = -determinant
            for c in range(k, size):
                A[k, c], A[k + 1, c] = A[k + 1, c], A[k, c]
        determinant *= A[k, k]
        if k + 1 < n:
            subtract(A, k + 1, k)
        for row in range(n, size):
            subtract(A, row, k)
    return determinant


@compiled
def subtract(A, row, k):
    """Eliminates column k of a row."""
    factor = A[row, k] / A[k, k]
    for c in range(k + 1, A.shape[1]):
        A[row, c] -= factor * A[k, c]


@compiled
def extend(G, t, rigid, rows, pivots, products):
    """Eliminates one more row, of G or of I - G, with exchange of columns; ``products`` holds the leading minors."""
    m = len(G)
    row = rows[t]
    for u in range(m):
        row[u] = G[t, u] if rigid else (1.0 if u == t else 0.0) - G[t, u]
    for k in range(t):
        factor = row[pivots[k]] / rows[k, pivots[k]]
        for u in range(m):
            row[u] -= factor * rows[k, u]
        row[pivots[k]] = 0.0
    best = -1
    for u in range(m):
        free = True
        for k in range(t):
            free = free and pivots[k] != u
        if free and (best < 0 or abs(row[u]) > abs(row[best])):
            best = u
    sign = 1.0
    for k in range(t):
        if pivots[k] > best:
            sign = -sign
    pivots[t] = best
    products[t + 1] = sign * products[t] * row[best]
