"""Everything that the figures and the claims rest on, computed once: maps, curves and motions."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from beal.discretisation import discretise
from beal.discretisation.build import Formulation
from beal.discretisation.operators import Operators
from beal.motion import QUANTITIES, AliasingWarning, ModeShape, Response, growth_rate, response
from beal.paper import cases
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.stability.curve import ThrustCurve, thrust_curve
from beal.study.map import stability_map
from beal.vehicle.catalog import tsto
from beal.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from xarray import Dataset

Array = NDArray[np.float64]
Progress = Callable[[str, int, int], None]
Maps = dict[tuple[float, Formulation], "Dataset"]

START = ModeShape(1, amplitude=1e-3, at="nose")
SENSOR = "imu"
FREE_DURATION = {13: 6.0, 14: 0.5}  # of what is drawn; the motion at P = 128 grows tenfold in 0.14
BOUNDED_DURATION, GROWTH_DURATION, FORCED_DURATION = 40.0, 2.0, 20.0
FORCED_SWEEP = tuple(np.arange(0.0, 105.1, 5.0).tolist())
NEWMARK_STEP, DRAWN = 1e-4, 10  # every tenth step is drawn: the eighth mode has a period of 9e-3
ABOVE = 1.1  # thrust of the diverging motion over the critical one
DIVERGING = (0.6, 3.0, 1e4)  # diverges under every formulation


@dataclass(frozen=True)
class Curve:
    """Frequencies over thrust of one case under one formulation."""

    case: cases.CurveCase
    curve: ThrustCurve
    critical: CriticalThrust


@dataclass(frozen=True)
class Motion:
    """A motion by Newmark's method and by the exact solution at the same times."""

    newmark: Response
    exact: Response

    @property
    def difference(self) -> float:
        """Largest difference of the displacements over the largest displacement."""
        exact = self.exact.displacement[0]
        return float(abs(self.newmark.displacement[0] - exact).max() / abs(exact).max())


@dataclass(frozen=True)
class Growth:
    """What a free motion does in the long run.

    Parameters
    ----------
    thrust : float
        P L^2/EI.
    amplitude_ratio : float
        Largest displacement in the last quarter over that in the first.
    rate, eigenvalue_rate : float
        Growth rate measured on the motion, and the largest of the roots.
    turning_points : int
        Of the displacement in the second half.
    """

    thrust: float
    amplitude_ratio: float
    rate: float
    eigenvalue_rate: float
    turning_points: int


def critical(joint: tuple[float, float, float], formulation: Formulation) -> CriticalThrust:
    """Critical thrust of the paper's vehicle under a formulation.

    Parameters
    ----------
    joint : (float, float, float)
        L1/L, k_r L/EI and k_s L^3/EI.
    formulation : str

    Returns
    -------
    CriticalThrust
    """
    return critical_thrust(tsto(*joint), formulation=formulation)


def maps(points: int, progress: Progress, locations: Sequence[float] = cases.LOCATIONS) -> Maps:
    """The maps of Figs. 4, 6, 8 and 11 under each formulation.

    Parameters
    ----------
    points : int
        Per axis.
    progress : callable
        Called with (text, done, total).
    locations : sequence of float
        L1/L of each map.

    Returns
    -------
    dict of (L1, formulation) to Dataset
    """
    axes = {
        cases.K_R: np.geomspace(*cases.ROTATIONAL, points).tolist(),
        cases.K_S: np.geomspace(*cases.SHEAR, points).tolist(),
    }
    keys = [(split, formulation) for split in locations for formulation in cases.ORDER]
    total = len(keys) * points**2
    charts: Maps = {}
    for index, (split, formulation) in enumerate(keys):
        text = f"map of L1 = {split:g}, {cases.NAMES[formulation]}"

        def step(done: int, _: int, text: str = text, before: int = index * points**2) -> None:
            progress(text, before + done, total)

        vehicle = tsto(split, cases.ROTATIONAL[0], cases.SHEAR[0])
        charts[split, formulation] = stability_map(vehicle, axes, formulation=formulation, progress=step)
    return charts


def curves(case: cases.CurveCase) -> dict[Formulation, Curve]:
    """Frequencies over thrust of a case under each formulation.

    Parameters
    ----------
    case : CurveCase

    Returns
    -------
    dict of str to Curve
    """
    vehicle = tsto(*case.joint)
    return {
        name: Curve(
            case, thrust_curve(vehicle, case.reach, cases.CURVE_POINTS, formulation=name), critical(case.joint, name)
        )
        for name in cases.ORDER
    }


def motion(vehicle: Vehicle, formulation: Formulation, thrust: float, duration: float, free: bool) -> Motion:
    """Elastic motion at the sensor by both methods.

    Parameters
    ----------
    vehicle : Vehicle
    formulation : str
    thrust : float
        P L^2/EI.
    duration : float
        In units of sqrt(m L^4/EI).
    free : bool
        Whether the motion starts from ``START``, or from rest under the vehicle's forces.

    Returns
    -------
    Motion
    """
    operators = discretise(vehicle, formulation)
    initial = START if free else None
    step = duration / (DRAWN * round(duration / (DRAWN * NEWMARK_STEP)))
    newmark = response(operators, duration, thrust, step=step, initial=initial, rigid_body=False)
    exact = sampled(operators, duration, thrust, step=DRAWN * step, initial=initial, rigid_body=False)
    return Motion(_drawn(newmark), exact)


def sampled(operators: Operators, duration: float, thrust: float, **options: Any) -> Response:
    """The exact response at times that are too coarse for the fastest modes, which hardly move."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AliasingWarning)
        return response(operators, duration, thrust, method="exact", **options)


def _drawn(moved: Response) -> Response:
    """The history at the steps that are drawn."""
    rows = {name: getattr(moved, name)[:, ::DRAWN] for name in (*QUANTITIES, "rigid_displacement", "rigid_slope")}
    columns = {
        name: getattr(moved, name)[::DRAWN] for name in ("time", "thrust_history", "coordinates", "coordinate_rates")
    }
    return replace(moved, **rows, **columns)


def growth(joint: tuple[float, float, float], formulation: Formulation, thrust: float, duration: float) -> Growth:
    """How the free motion from ``START`` grows, from the exact solution.

    Parameters
    ----------
    joint : (float, float, float)
    formulation : str
    thrust : float
        P L^2/EI.
    duration : float

    Returns
    -------
    Growth
    """
    step = duration / round(duration / 5e-3)
    operators = discretise(tsto(*joint), formulation)
    moved = sampled(operators, duration, thrust, step=step, initial=START, rigid_body=False)
    size, quarter = abs(moved.displacement[0]), len(moved.time) // 4
    late = moved.rate[0][len(moved.time) // 2 :]
    return Growth(
        thrust=thrust,
        amplitude_ratio=float(size[-quarter:].max() / size[:quarter].max()),
        rate=growth_rate(moved, SENSOR),
        eigenvalue_rate=float(np.sqrt(-moved.mu.astype(complex)).real.max()),
        turning_points=int(np.count_nonzero(late[:-1] * late[1:] < 0)),
    )


def forced_amplitude(formulation: Formulation, thrust: float, amplitude: float, free: bool = False) -> float:
    """Largest elastic displacement of the IMU under F = amplitude sin 2t.

    Parameters
    ----------
    formulation : str
    thrust : float
        P L^2/EI.
    amplitude : float
        F L^2/EI.
    free : bool
        Whether the motion starts from ``START`` rather than from rest.

    Returns
    -------
    float
    """
    operators = discretise(cases.forced(amplitude), formulation)
    moved = sampled(
        operators,
        FORCED_DURATION,
        thrust,
        step=0.01,
        initial=START if free else None,
        rigid_body=False,
    )
    return float(abs(moved.displacement[0]).max())
