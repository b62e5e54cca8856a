"""What the page may ask, with the limits that keep an answer short."""

from typing import Annotated, Any

from pydantic import Field, FiniteFloat

from beal.discretisation import Formulation
from beal.vehicle.base import Part

MODEL, FILE = 500_000, 5_000_000  # characters of a model, and bytes of a file in base64
Path = Annotated[str, Field(max_length=120)]
Thrust = Annotated[FiniteFloat, Field(ge=0, le=1e15)]
Positive = Annotated[FiniteFloat, Field(gt=0, le=1e15)]
Count = Annotated[int, Field(ge=1, le=8)]


class Question(Part):
    """A vehicle: a model, then what the sliders and the choices of the page replace in it.

    Parameters
    ----------
    model : str or dict
        The text of a model file (TOML), or the same as a JSON object.
    values : mapping of path to number or text
        Quantities by their paths, such as ``joint[0].rotational_stiffness``; ``"inf"`` is rigid.
    choices : mapping of path to text
        Words by their paths, such as ``joint[0].shear_axis`` or ``support.nose``.
    formulation : str
    """

    model: Annotated[str, Field(max_length=MODEL)] | dict[str, Any]
    values: dict[Path, float | Annotated[str, Field(max_length=80)]] = Field(default={}, max_length=300)
    choices: dict[Path, Annotated[str, Field(max_length=40)]] = Field(default={}, max_length=300)
    formulation: Formulation = "objective"


class Critical(Question):
    """The first instability; with ``every`` all changes of stability."""

    max_thrust: Positive | None = None
    every: bool = False


class Curve(Question):
    """Modes over thrust; by default to a little beyond the critical thrust."""

    to: Positive | None = None
    points: Annotated[int, Field(ge=2, le=401)] = 61
    modes: Count = 4


class Modes(Question):
    """Frequencies at a thrust, converged."""

    thrust: Thrust = 0.0
    count: Count = 4


class Solve(Curve):
    """Everything that a move of a slider changes: verdict, curves, and mode shapes at a thrust."""

    thrust: Thrust | None = None


class Map(Question):
    """Critical thrusts at points in the plane of two quantities.

    Parameters
    ----------
    axes : two paths
    points : sequence of pairs of float
        A value on each axis.
    """

    axes: tuple[Path, Path]
    points: Annotated[tuple[tuple[FiniteFloat, FiniteFloat], ...], Field(min_length=1, max_length=2000)]


class Response(Question):
    """Motion at the sensors, without an error of the step.

    Parameters
    ----------
    duration : float
    thrust : float, optional
        By default the nominal one.
    points : int
        Of time.
    mode, amplitude : int, float
        The elastic mode, at zero thrust, that the vehicle is released from; 0 starts from rest.
    elastic : bool
        Whether the rigid-body motion is left out.
    """

    duration: Positive
    thrust: Thrust | None = None
    points: Annotated[int, Field(ge=2, le=4001)] = 801
    mode: Annotated[int, Field(ge=0, le=8)] = 1
    amplitude: FiniteFloat = 0.01
    elastic: bool = True


class Locus(Question):
    """Roots of the closed loop over the thrust, the gains, or any quantity."""

    over: Path = "gain"
    at: Annotated[tuple[FiniteFloat, ...], Field(min_length=2, max_length=201)]
    thrust: Thrust | None = None
    modes: Annotated[int, Field(ge=1, le=6)] = 3


class Flight(Question):
    """Margins at some of the times of the vehicle's flight: ``count`` of them from the ``first``, counted from 0."""

    first: Annotated[int, Field(ge=0)] = 0
    count: Annotated[int, Field(ge=1, le=100)] = 10
    modes: Count = 3


class Pulsation(Question):
    """Stability under P(t) = P0 + P1 cos(W t) over a grid; P0 is the thrust, by default the nominal one."""

    thrust: Thrust | None = None
    angular_frequencies: Annotated[tuple[Positive, ...], Field(min_length=1, max_length=61)]
    amplitudes: Annotated[tuple[Thrust, ...], Field(min_length=1, max_length=61)]
    modes: Count = 6


class Loop(Question):
    """Margins and frequency response of the control loop."""

    thrust: Thrust | None = None
    modes: Count = 6


class Dropped(Part):
    """A file: its name, whose ending says what it is, and its content in base64."""

    name: Annotated[str, Field(min_length=1, max_length=200)]
    content: Annotated[str, Field(max_length=FILE)]
