"""How the kernels are compiled: without the interpreter's lock, kept on disk, sums in any order."""

from numba import njit

compiled = njit(nogil=True, cache=True, fastmath={"contract", "reassoc", "nsz", "arcp"})
