"""Studies of many vehicles as a notebook shows them: what the critical thrust depends on, how it scatters, its map."""

from collections.abc import Iterator
from html import escape

import numpy as np

from beal.design.reliability import thrust_quantile
from beal.design.sampling import Sample
from beal.design.sensitivity import Sensitivity
from beal.notebook.pictures import HIGH, picture, verdict
from beal.report import table
from beal.report.numbers import cell, quantity
from beal.report.verdict import close_by
from beal.study.refined import RefinedMap

QUANTILES = (0.1, 0.5, 0.9)  # 64 vehicles, the fewest there may be, are enough for their intervals
MOST = 15  # quantities in a table


def sensitivity(found: Sensitivity) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Sensitivity

    Yields
    ------
    str
    """
    critical, force = found.critical, "N" if found.units == "SI" else ""
    thrust = quantity(critical.critical_thrust or 0.0, force, critical.error_estimate)
    yield verdict(f"{critical.kind} at P = {thrust}; derivatives: {found.status}")
    for rival in found.rivals:
        yield f"<p>{close_by(rival)}</p>"
    shown = found.ranked[:MOST]
    if not shown:
        yield "<p>none of the quantities has an effect</p>"
        return
    yield picture(
        lambda plot, on: plot.tornado(found, on.subplots()), "percent of critical thrust per percent of each quantity"
    )
    rows = [[each.path, cell(each.value), cell(each.derivative), cell(each.elasticity), each.status] for each in shown]
    yield table(["quantity", "value", "derivative", "% per %", "status"], rows, numeric=range(1, 4))
    if len(found.ranked) > MOST:
        yield f"<p>and {len(found.ranked) - MOST} of less effect</p>"


def sample(found: Sample) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : Sample

    Yields
    ------
    str
    """
    si = found.units == "SI"
    kinds = [f"{number} {name}" for name, number in found.kinds.items()]
    yield verdict(f"{found.count} vehicles: {', '.join(kinds)}, {found.failed} not solved")
    if found.failed == found.count:
        return
    yield picture(
        lambda plot, on: plot.thrust_distribution(found, on.subplots(), nondimensional=not si),
        "histogram of the critical thrust",
        height=1.2 * HIGH,
    )
    estimates = [(share, thrust_quantile(found, share)) for share in QUANTILES]
    rows = [[f"{share:.0%}", *(cell(end) for end in (each.value, each.low, each.high))] for share, each in estimates]
    unit = " [N]" if si else ""
    yield table(["quantile", f"critical thrust{unit}", "95 % from", "to"], rows, numeric=range(4))
    over = ", ".join(map(escape, found.paths))
    yield f"<p>over {over}; {found.method}, seed {found.seed}</p>"


def refined(found: RefinedMap) -> Iterator[str]:
    """Blocks of HTML.

    Parameters
    ----------
    found : RefinedMap

    Yields
    ------
    str
    """
    thrust = np.concatenate([np.ravel(part.critical_thrust) for part in (found.grid, found.refined)])
    points, cells = found.refined.sizes["point"], found.refined.sizes["cell"]
    yield verdict(f"{found.grid.critical_thrust.size} points, and {points} that resolve {cells} cells of its borders")
    if np.isfinite(thrust).any():
        force = "N" if found.grid.attrs["units"] == "SI" else ""
        low, high = (quantity(float(end), force) for end in (np.nanmin(thrust), np.nanmax(thrust)))
        yield f"<p>critical thrust from {low} to {high}</p>"
    if sum(length > 1 for length in found.grid.critical_thrust.shape) == found.grid.critical_thrust.ndim == 2:
        yield picture(lambda plot, on: plot.stability_map(found, on.subplots()), "stability map", height=4.6)
