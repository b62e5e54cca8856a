"""The uniform beam that most of the catalog is built from, whole or in two pieces."""

from beal.errors import ModelError
from beal.vehicle.parts import Stage


def beam(length: float = 1.0, name: str = "", internal_damping: float = 0.0, **more: float) -> Stage:
    """A stage with EI = m = 1 and whatever else it is given."""
    unit = {"mass_per_length": 1.0, "bending_stiffness": 1.0}
    return Stage(name=name, length=length, internal_damping=internal_damping, **unit, **more)


def divided(share: float, field: str, names: tuple[str, str] = ("", ""), internal_damping: float = 0.0) -> list[Stage]:
    """Two stages of the uniform beam that meet at a share of its length, refused by the name of its field."""
    if not 0 < share < 1:
        raise ModelError([(field, f"must lie between 0 and 1, found {share}")])
    pieces = zip((share, 1.0 - share), names, strict=True)
    return [beam(length, name, internal_damping) for length, name in pieces]
