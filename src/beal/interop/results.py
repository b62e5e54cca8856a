"""Results as labelled arrays: mode shapes along the vehicle, frequencies over thrust, motion at the sensors."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from beal.control import ClosedLoop, StateSpace
from beal.discretisation.operators import Operators
from beal.motion.amplitude import AmplitudeMap
from beal.motion.histories import PARTS, QUANTITIES, Response
from beal.stability.curve import ThrustCurve
from beal.stability.spectrum import Spectrum

if TYPE_CHECKING:
    import xarray  # takes a second

Array = NDArray[np.float64]
UNITS = {
    "station": "m",
    "angular_frequency": "rad/s",
    "growth_rate": "1/s",
    "slope_real": "1/m",
    "slope_imag": "1/m",
    "thrust": "N",
    "time": "s",
    "displacement": "m",
    "rate": "m/s",
    "acceleration": "m/s^2",
    "slope": "rad",
    "slope_rate": "rad/s",
    "rigid_displacement": "m",
    "elastic_displacement": "m",
    "rigid_slope": "rad",
    "elastic_slope": "rad",
}


def mode_shapes(spectrum: Spectrum, operators: Operators, points: int = 21) -> "xarray.Dataset":
    """Sample the mode shapes of a spectrum along the vehicle.

    Parameters
    ----------
    spectrum : Spectrum
    operators : Operators
        Those that the spectrum was computed from.
    points : int
        Stations in each stage, both ends counted: at a joint the forward face is listed, then the aft one.

    Returns
    -------
    xarray.Dataset
        ``displacement`` (largest value 1) and ``slope``, real and imaginary part, over ``mode`` and ``point``.

    Examples
    --------
    >>> from beal.discretisation.build import discretise
    >>> from beal.stability.spectrum import spectrum
    >>> from beal.vehicle import catalog
    >>> column = discretise(catalog.beck(), order=10)
    >>> float(mode_shapes(spectrum(column, count=1), column).displacement_real[0, -1])
    1.0
    """
    ends = operators.vehicle.boundaries
    stages = [np.linspace(front, back, points) for front, back in zip(ends, ends[1:], strict=False)]
    values = []
    for derivative in (0, 1):
        rows = [
            np.vstack([operators.shape(x[:-1], derivative, "aft"), operators.shape(x[-1:], derivative, "forward")])
            for x in stages
        ]
        values.append((np.vstack(rows) @ spectrum.shapes).T)
    displacement, slope = values
    places = abs(displacement).argmax(axis=1)
    largest = displacement[np.arange(len(places)), places, None]
    shapes = {"displacement": displacement / largest, "slope": slope / largest}
    dims = ("mode", "point")
    return _labelled(
        {
            "angular_frequency": ("mode", spectrum.angular_frequency),
            "growth_rate": ("mode", spectrum.growth_rate + 0.0),
            **{f"{name}_real": (dims, shape.real) for name, shape in shapes.items()},
            **{f"{name}_imag": (dims, shape.imag) for name, shape in shapes.items()},
        },
        {
            "mode": np.arange(1, len(places) + 1, dtype=np.int32),
            "station": ("point", np.concatenate(stages)),
            "stage": ("point", np.repeat(np.arange(len(stages), dtype=np.int32), points)),
        },
        {"title": operators.vehicle.title, "units": operators.vehicle.units, "thrust": spectrum.thrust},
    )


def thrust_curve(curve: ThrustCurve) -> "xarray.Dataset":
    """Frequency and growth rate of each mode over the thrust.

    Parameters
    ----------
    curve : ThrustCurve

    Returns
    -------
    xarray.Dataset
        Over ``thrust`` and ``mode``.
    """
    dims = ("thrust", "mode")
    return _labelled(
        {name: (dims, getattr(curve, name)) for name in ("angular_frequency", "growth_rate")},
        {"thrust": curve.thrust, "mode": np.arange(1, curve.growth_rate.shape[1] + 1, dtype=np.int32)},
        {"formulation": curve.formulation},
    )


def response(found: Response) -> "xarray.Dataset":
    """Motion at the sensors over time.

    Parameters
    ----------
    found : Response

    Returns
    -------
    xarray.Dataset
        What a sensor reads, and its rigid and elastic parts, over ``sensor`` and ``time``.
    """
    return at_sensors(found, "time", found.time, {name: getattr(found, name) for name in (*QUANTITIES, *PARTS)})


def at_sensors(found: Response, axis: str, along: Array, values: Mapping[str, Array]) -> "xarray.Dataset":
    """What is told of a motion at its sensors over time or frequency.

    Parameters
    ----------
    found : Response
    axis : {"time", "angular_frequency"}
    along : ndarray, shape (k,)
    values : mapping of quantity to ndarray, shape (sensors, k)

    Returns
    -------
    xarray.Dataset
        Over ``sensor`` and the axis.
    """
    return _labelled(
        {name: (("sensor", axis), value) for name, value in values.items()},
        {"sensor": list(found.sensors), axis: along},
        {"thrust": found.thrust, "method": found.method, "step": found.step},
    )


def amplitude_map(found: AmplitudeMap) -> "xarray.Dataset":
    """The largest motion at a sensor.

    Parameters
    ----------
    found : AmplitudeMap

    Returns
    -------
    xarray.Dataset
        ``amplitude`` over ``thrust`` and ``force``, multiples of the vehicle's forces.
    """
    return _labelled(
        {"amplitude": (("thrust", "force"), found.amplitude)},
        {"thrust": found.thrust, "force": found.factor},
        {"sensor": found.sensor, "quantity": found.quantity, "duration": found.duration},
    )


def closed_loop(found: ClosedLoop) -> "xarray.Dataset":
    """The roots of a closed loop.

    Parameters
    ----------
    found : ClosedLoop

    Returns
    -------
    xarray.Dataset
        ``real``, ``imag`` and ``damping_ratio`` over ``root``.
    """
    return _labelled(
        {
            "real": ("root", found.roots.real),
            "imag": ("root", found.roots.imag),
            "damping_ratio": ("root", found.damping_ratio),
        },
        {"root": np.arange(1, len(found.roots) + 1, dtype=np.int32)},
        {"thrust": found.thrust, "rigid_body_roots": found.drift},
    )


def state_space(found: StateSpace) -> "xarray.Dataset":
    """The matrices of a state space with the names and units of what they relate.

    Parameters
    ----------
    found : StateSpace

    Returns
    -------
    xarray.Dataset
        ``A`` and ``B`` over ``rate`` (the state whose rate a row gives), ``C`` and ``D`` over ``output``.
    """
    return _labelled(
        {
            "A": (("rate", "state"), found.A),
            "B": (("rate", "input"), found.B),
            "C": (("output", "state"), found.C),
            "D": (("output", "input"), found.D),
            "input_unit": ("input", list(found.input_units)),
            "output_unit": ("output", list(found.output_units)),
        },
        {"state": list(found.states), "input": list(found.inputs), "output": list(found.outputs)},
        {"thrust": found.thrust},
    )


def _labelled(values: dict[str, Any], coordinates: dict[str, Any], attributes: dict[str, Any]) -> "xarray.Dataset":
    import xarray

    dataset = xarray.Dataset(values, coordinates, attributes)
    if attributes.get("units") != "nondimensional":
        for name in set(UNITS) & set(dataset.variables):
            dataset[name].attrs["units"] = UNITS[name]
    return dataset
