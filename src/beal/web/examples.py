"""The models of the catalog that one may start from."""

from importlib.resources import files

EXAMPLES = ("beck", "beal", "pflueger", "tsto", "generic_small_launcher")


def example_text(name: str) -> str:
    """The commented model file of an example."""
    return (files("beal.vehicle.catalog") / "models" / f"{name}.toml").read_text(encoding="utf-8")
