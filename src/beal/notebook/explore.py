"""A vehicle to play with in a notebook."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from beal.errors import ModelError
from beal.vehicle.paths import SPLIT, value_at
from beal.vehicle.paths import paths as paths_of
from beal.vehicle.sliders import sliders
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from beal.notebook.explorer import Explorer

MOST = 12  # sliders, where nobody says which


def explore(vehicle: Vehicle, paths: Sequence[str] | None = None) -> "Explorer":
    """Sliders beside the verdict and the frequencies over thrust, which follow them.

    Parameters
    ----------
    vehicle : Vehicle
    paths : sequence of str, optional
        The quantities that get a slider, by their paths in the model file; by default the stiffnesses of the
        joints and where the first one sits, or the first dozen of all.

    Returns
    -------
    Explorer
        For the end of a cell. Its attribute ``vehicle`` is the vehicle as it is now. Everything is computed in the
        notebook's own Python; nothing is asked of a server or of a network.

    Raises
    ------
    ModelError
        If the vehicle has no such quantity, or anywidget is not installed.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> shown = explore(tsto(0.6, 5000.0, 5000.0))
    >>> shown.values = {"joint[0].rotational_stiffness": 10.0}
    >>> shown.vehicle.joints[0].rotational_stiffness
    10.0
    """
    try:
        from beal.notebook.explorer import Explorer
    except ModuleNotFoundError as error:
        if not str(error.name).startswith(("anywidget", "traitlets")):
            raise
        raise ModelError("anywidget is needed and not installed; install beal[notebook]") from None
    if paths is None:
        there = paths_of(vehicle)
        joints = [path for path in there if path.startswith("joint") and path.endswith("stiffness")]
        paths = [*joints, SPLIT][:MOST] if joints else there[:MOST]
    for path in paths:
        value_at(vehicle, path)
    known = {slider["path"]: slider for slider in sliders(vehicle, vehicle)}
    return Explorer(vehicle, [known[path] for path in paths])
