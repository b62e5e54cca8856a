"""``beal control --map``: where the closed loop is stable, over the thrust and another quantity."""

from pathlib import Path
from typing import TYPE_CHECKING

from beal.cli.figures import control_map_figure, named, new_figure
from beal.cli.output import check_new_folder, emit, note, progress_bar
from beal.errors import ModelError
from beal.report.numbers import quantity

if TYPE_CHECKING:
    from xarray import Dataset

    from beal.vehicle.vehicle import Vehicle

BEYOND = 2.0  # how many times the thrust the map reaches unless told
Limits = tuple[float | None, float | None, float | None]


def show_map(
    vehicle: "Vehicle",
    over: str,
    limits: Limits,
    points: int,
    thrust: float | None,
    modes: int,
    output: Path | None,
    figure: Path | None,
    as_json: bool,
) -> None:
    """Compute, draw, write and tell a map; ``limits`` are those of the quantity and the largest thrust."""
    from numpy import linspace

    from beal.control import control_map
    from beal.study.place import Place
    from beal.study.pulsating import write_chart

    start, end, top = limits
    if over == "thrust":
        raise ModelError("--over: the thrust is one axis of a map; name the other, such as gain or sensor[0].station")
    if start is None or end is None or not start < end:
        raise ModelError(f"--from, --to: give both ends of the map along {over}, in ascending order")
    nominal = vehicle.thrust.nominal if thrust is None else thrust
    top = BEYOND * nominal if top is None and nominal else top
    if not top or top < 0:
        raise ModelError("--max-thrust: give a positive one, or set thrust.nominal in the model")
    if points < 2:
        raise ModelError(f"--points: must be at least 2, found {points}")
    if output:
        check_new_folder(output)
    with new_figure(figure, as_json) as draw, progress_bar() as progress:
        values, thrusts = linspace(start, end, points), linspace(0.0, top, points + 1)[1:]
        chart = control_map(vehicle, over, values, thrusts, modes, lambda *n: progress(f"values of {over}", *n))
        draw(lambda: control_map_figure(chart, vehicle))
    if output:
        write_chart(chart, Place.of(output))
    if as_json:
        emit(
            {
                "over": over,
                "values": values,
                "border": [[border for border in row if border == border] for row in chart.border.values.tolist()],
                "max_thrust": top,
                "watched_modes": modes,
                "units": vehicle.units,
                "file": str(output) if output else None,
                **named(figure),
            }
        )
        return
    print(_told(chart, over, vehicle.units == "SI"))
    if output:
        note(f"map written to {output}")


def _told(chart: "Dataset", over: str, si: bool) -> str:
    """The best value of the quantity, in words."""
    import numpy as np

    top = float(chart.thrust[-1])
    first = np.nan_to_num(chart.border.values[:, 0], nan=top)
    best = int(first.argmax())
    borne = quantity(float(first[best]), "N" if si else "")
    share = f"{np.mean(chart.stable.values):.0%} of the map is stable"
    reach = "up to all thrusts of the map" if first[best] >= top else f"up to P = {borne}"
    return f"{share}; {reach} with {over} = {float(chart[over][best]):.6g}"
