"""Kernels that run for every vehicle of a map: compiled where numba is installed, each beside its plain twin."""

from importlib.util import find_spec


def compiled_kernels() -> bool:
    """Whether numba is installed."""
    return find_spec("numba") is not None
