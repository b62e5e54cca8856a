"""What commands draw with ``--figure``: a file of the kind that its name's ending says."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beal.cli.output import new_path, note
from beal.errors import ModelError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import Dataset

    from beal.control import ControlLocus, Margins, StateSpace
    from beal.design.answer import DesignAnswer
    from beal.design.sampling import Sample
    from beal.design.sensitivity import Sensitivity
    from beal.discretisation.operators import Operators
    from beal.motion import AmplitudeMap, Response
    from beal.stability.complete import Event
    from beal.stability.critical import CriticalThrust
    from beal.stability.curve import ThrustCurve
    from beal.stability.floquet import Floquet
    from beal.stability.spectrum import Spectrum
    from beal.study.flight import Flight
    from beal.vehicle.vehicle import Vehicle

FORMATS = (".png", ".svg", ".pdf")
DOTS = 300  # per inch of a picture, as printers ask for
WIDE, HIGH = 5.0, 3.0  # of a panel, inches
DRAWN = ("displacement", "rate", "slope")  # of a motion, unless told

Draw = Callable[[], "Figure"]


@contextmanager
def new_figure(path: Path | None, quiet: bool) -> Iterator[Callable[[Draw], None]]:
    """Writes a figure, refusing before any work what could not be written.

    Parameters
    ----------
    path : Path or None
        Nothing is drawn for None.
    quiet : bool
        Whether nothing is said about it.

    Raises
    ------
    ModelError
        If the ending is none of a figure's, matplotlib is not installed, or no file can be written there.
    """
    if path is None:
        yield lambda draw: None
        return
    if path.suffix.lower() not in FORMATS:
        known = ", ".join(FORMATS)
        raise ModelError(f"--figure: must end with one of {known}, found {path.suffix or 'no ending'}", str(path))
    try:
        from beal.plot import style
    except ModuleNotFoundError as error:
        if not str(error.name).startswith("matplotlib"):
            raise
        raise ModelError("--figure: needs matplotlib, which is not installed; install beal[plot]") from None
    with new_path(path) as part:

        def write(draw: Draw) -> None:
            kind = path.suffix.lower().removeprefix(".")
            dates = {} if kind == "png" else {"Date" if kind == "svg" else "CreationDate": None}  # the same each time
            with style():
                draw().savefig(part, format=kind, dpi=DOTS, metadata=dates)

        yield write
    if not quiet:
        note(f"figure written to {path}")


def named(figure: Path | None, report: Path | None = None) -> dict[str, str]:
    """The entries of a figure and of a report in a JSON object, of those that there are."""
    return {name: str(path) for name, path in (("figure", figure), ("report", report)) if path}


def vehicle_figure(vehicle: "Vehicle") -> "Figure":
    """The vehicle."""
    from beal import plot

    return _fitted(lambda ax: plot.vehicle(vehicle, ax))


def flight_figure(found: "Flight") -> "Figure":
    """Frequencies, thrusts and margins over a flight."""
    from matplotlib.figure import Figure

    from beal import plot

    page = Figure(figsize=(6.4, 5.2), layout="constrained")
    plot.flight(found, page.subplots())
    return page


def modes_figure(spectrum: "Spectrum", operators: "Operators") -> "Figure":
    """The vehicle bent by each mode."""
    from beal import plot

    return _fitted(lambda ax: plot.mode_shapes(spectrum, operators, ax))


def curve_figure(
    vehicle: "Vehicle", curve: "ThrustCurve", critical: "CriticalThrust", events: "list[Event]"
) -> "Figure":
    """Frequencies over growth rates; of a damped vehicle the root locus too."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(WIDE * (1.8 if vehicle.damped else 1.0), 2 * HIGH), layout="constrained")
    plain = vehicle.units == "nondimensional"
    columns: Any = figure.subfigures(1, 2, width_ratios=(1.0, 0.8)) if vehicle.damped else (figure,)
    upper, lower = columns[0].subplots(2, 1, sharex=True)
    plot.thrust_curve(curve, upper, critical, nondimensional=plain, events=events)
    plot.growth_rates(curve, lower, critical, nondimensional=plain)
    upper.set_xlabel("")
    columns[0].align_ylabels()
    if vehicle.damped:
        plot.root_locus(curve, columns[1].subplots(), critical, nondimensional=plain)
    return figure


def response_figure(
    found: "Response",
    nondimensional: bool,
    quantities: Sequence[str] = DRAWN,
    draw: "Callable[..., Axes] | None" = None,
) -> "Figure":
    """Quantities at the sensors, a column for each; histories unless another function draws them."""
    from matplotlib.figure import Figure

    from beal import plot

    drawing: Callable[..., Axes] = draw or plot.response
    number = len(found.sensors)
    figure = Figure(figsize=(WIDE * max(1.0, 0.7 * number), 2 / 3 * HIGH * len(quantities)), layout="constrained")
    panels = figure.subplots(len(quantities), number, sharex=True, squeeze=False)
    for sensor, column in zip(found.sensors, panels.T, strict=True):
        column[0].set_title(sensor, loc="left")
        for quantity, ax in zip(quantities, column, strict=True):
            drawing(found, ax, sensor, quantity, nondimensional)
            ax.label_outer()
    return figure


def control_figure(locus: "ControlLocus", nondimensional: bool) -> "Figure":
    """The paths of the closed loop's roots."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(WIDE, 1.3 * HIGH), layout="constrained")
    plot.control_locus(locus, figure.subplots(), nondimensional)
    return figure


def open_loop_figure(loop: "StateSpace", margins: "Margins", drawn: str) -> "Figure":
    """The open loop by Nyquist or Nichols."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(WIDE, 1.5 * HIGH), layout="constrained")
    draw = plot.nyquist if drawn == "nyquist" else plot.nichols
    draw(loop, figure.subplots(), margins)
    return figure


def control_map_figure(chart: "Dataset", vehicle: "Vehicle") -> "Figure":
    """Where the closed loop is stable; over the station of a sensor the vehicle lies beneath."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(1.2 * WIDE, 1.3 * HIGH), layout="constrained")
    if not str(chart.stable.dims[0]).endswith(".station"):
        plot.control_map(chart, figure.subplots())
        return figure
    figure.set_figheight(1.8 * HIGH)
    upper, lower = figure.subplots(2, 1, height_ratios=(3, 1))
    plot.control_map(chart, upper)
    plot.vehicle(vehicle, lower)
    upper.set_xlim(lower.get_xlim())  # the sensor beneath its stations
    return figure


def map_figure(out: str, refined: bool) -> "Figure":
    """The critical thrust over two axes, from the result of a map."""
    import xarray
    from matplotlib.figure import Figure

    from beal import plot
    from beal.study.points import GROUP
    from beal.study.refined import RefinedMap

    figure = Figure(figsize=(WIDE, 1.3 * HIGH), layout="constrained")
    with xarray.open_zarr(out, chunks=None) as grid:
        chart = RefinedMap(grid, xarray.open_zarr(out, group=GROUP, chunks=None)) if refined else grid
        plot.stability_map(chart, figure.subplots())
    return figure


def sensitivity_figure(found: "Sensitivity") -> "Figure":
    """What each quantity does to the critical thrust."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(1.3 * WIDE, 1.3 * HIGH), layout="constrained")
    plot.tornado(found, figure.subplots())
    return figure


def design_figure(found: "DesignAnswer") -> "Figure":
    """The design among its neighbours."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(WIDE, 1.3 * HIGH), layout="constrained")
    plot.design_map(found, figure.subplots())
    return figure


def floquet_figure(chart: "Dataset") -> "Figure":
    """Growth under a pulsating thrust over its frequency and amplitude."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(1.3 * WIDE, 1.3 * HIGH), layout="constrained")
    plot.floquet_chart(chart, figure.subplots())
    return figure


def uncertainty_figure(found: "Sample", thrust: float | None, vehicle: "Vehicle") -> "Figure":
    """How the critical thrust scatters."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(1.2 * WIDE, 1.3 * HIGH), layout="constrained")
    plot.thrust_distribution(found, figure.subplots(), thrust, vehicle.units == "nondimensional")
    return figure


def multipliers_figure(found: "Floquet") -> "Figure":
    """The multipliers of one pulsation beside the unit circle."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(WIDE, 1.4 * HIGH), layout="constrained")
    plot.multipliers(found, figure.subplots())
    return figure


def amplitude_figure(found: "AmplitudeMap", nondimensional: bool) -> "Figure":
    """The largest motion over thrust and force."""
    from matplotlib.figure import Figure

    from beal import plot

    figure = Figure(figsize=(1.2 * WIDE, 1.2 * HIGH), layout="constrained")
    plot.amplitude_map(found, figure.subplots(), nondimensional)
    return figure


def _fitted(draw: "Callable[[Axes], Axes]") -> "Figure":
    """A figure as high as the drawing in it; first it is higher, so that only its width limits the drawing."""
    from matplotlib.figure import Figure

    from beal.plot.style import fitted

    figure = Figure(figsize=(WIDE, 4 * WIDE), layout="constrained")
    fitted(draw(figure.subplots()))
    return figure
