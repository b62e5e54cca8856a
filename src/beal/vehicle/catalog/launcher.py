"""A launcher of stages, tanks and a timeline, in SI units."""

from importlib.resources import files

from beal.vehicle.file import loads
from beal.vehicle.vehicle import Vehicle


def generic_small_launcher() -> Vehicle:
    """GSL-1, a generic two-stage launcher of 16.8 t that is no real vehicle, with tanks and the timeline of a flight.

    Computed for checks such as these: 6.3821, 18.6695, 28.7919 and 37.7398 Hz at lift-off with a rigid joint, flutter
    of modes 1 and 2 at 311 times its nominal thrust with its own; nothing about it is published.

    Returns
    -------
    Vehicle

    Examples
    --------
    >>> launcher = generic_small_launcher()
    >>> round(launcher.mass), len(launcher.stages), [tank.name for tank in launcher.tanks][-1]
    (16765, 10, 'kerosene 1')
    """
    model = files("beal.vehicle.catalog") / "models" / "generic_small_launcher.toml"
    return loads(model.read_text(encoding="utf-8"), "generic_small_launcher")
