"""Quantities that follow others."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Link:
    """A quantity that follows another: factor times its value to a power.

    Parameters
    ----------
    of : str
        Path of the other.
    factor, power : float
    """

    of: str
    factor: float = 1.0
    power: float = 1.0

    def value(self, of: float) -> float:
        """Its value while the other has one."""
        return self.factor * of**self.power

    def slope(self, of: float) -> float:
        """Its derivative with respect to the other."""
        return self.factor * self.power * of ** (self.power - 1)


def with_links(values: Mapping[str, float], links: Mapping[str, Link]) -> dict[str, float]:
    """Values by path, and those of the quantities that follow them.

    Examples
    --------
    >>> with_links({"stage[0].length": 2.0}, {"stage[1].length": Link("stage[0].length", factor=0.5)})
    {'stage[0].length': 2.0, 'stage[1].length': 1.0}
    """
    return {**values, **{path: link.value(values[link.of]) for path, link in links.items()}}
