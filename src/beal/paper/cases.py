"""What the paper fixes, and what had to be chosen because the paper does not say."""

from dataclasses import dataclass

from beal.discretisation.build import Formulation
from beal.vehicle.catalog import tsto
from beal.vehicle.parts import Force
from beal.vehicle.signals import Sine
from beal.vehicle.vehicle import Vehicle

LOCATIONS = (0.2, 0.4, 0.6, 0.8)
MAP_FIGURES = {0.2: 4, 0.4: 6, 0.6: 8, 0.8: 11}
ROTATIONAL, SHEAR = (1.0, 1e4), (1e2, 1e4)  # ranges of the maps
K_R, K_S = "joint[0].rotational_stiffness", "joint[0].shear_stiffness"
RESPONSE_JOINT = (0.6, 5000.0, 5000.0)
RESPONSE_THRUSTS = {13: 90.0, 14: 128.0}
FORCED_THRUSTS, FORCED_AMPLITUDES, FORCED_FREQUENCY = (50.0, 100.0), (0.01, 0.02), 2.0
PAPER_CRITICAL, PAPER_UNIFORM = 109.7, 109.9
UNIFORM = 109.689191958738  # exact, free-free uniform beam under a follower thrust
NAMES: dict[Formulation, str] = {
    "as-printed": "as printed",
    "corrected-ritz": "corrected Ritz",
    "converged": "converged",
    "objective": "objective",
}
ORDER: tuple[Formulation, ...] = ("as-printed", "corrected-ritz", "converged", "objective")
CURVE_POINTS = 261


@dataclass(frozen=True)
class CurveCase:
    """One row of panels of a figure of frequencies over thrust.

    Parameters
    ----------
    figure : int
        Number in the paper.
    joint : (float, float, float)
        L1/L, k_r L/EI and k_s L^3/EI.
    reach : float
        Last thrust, P L^2/EI.
    chosen : str
        Why these springs, where the paper does not give them; empty where it does.
    """

    figure: int
    joint: tuple[float, float, float]
    reach: float
    chosen: str


CURVES = (
    CurveCase(3, (0.2, 1000.0, 1000.0), 140.0, "a stiff joint, on which all formulations agree"),
    CurveCase(3, (0.2, 1.0, 1000.0), 150.0, "the softest rotational spring of the maps, on which they do not"),
    CurveCase(5, (0.4, 1000.0, 1000.0), 140.0, "flutter of modes 1 and 2"),
    CurveCase(5, (0.4, 300.0, 100.0), 140.0, "flutter of modes 2 and 3 in the paper's equations"),
    CurveCase(7, (0.6, 3.0, 5000.0), 150.0, "divergence"),
    CurveCase(7, (0.6, 1000.0, 1000.0), 150.0, "flutter of modes 1 and 2"),
    CurveCase(9, (0.8, 10.0, 5000.0), 120.0, "divergence, in the formulation as printed"),
    CurveCase(10, (0.8, 5000.0, 5000.0), 150.0, "flutter of modes 1 and 2"),
    CurveCase(12, (0.8, 200.0, 600.0), 140.0, ""),
)


def joint_text(joint: tuple[float, float, float]) -> str:
    """A joint in words for captions.

    Parameters
    ----------
    joint : (float, float, float)

    Returns
    -------
    str

    Examples
    --------
    >>> joint_text((0.8, 200.0, 600.0))
    'L₁ = 0.8, k_r = 200, k_s = 600'
    """
    split, rotational, shear = joint
    return f"L₁ = {split:g}, k_r = {rotational:g}, k_s = {shear:g}"


def forced(amplitude: float) -> Vehicle:
    """The vehicle of the responses with F = amplitude sin 2t at its tail.

    Parameters
    ----------
    amplitude : float
        F L^2/EI.

    Returns
    -------
    Vehicle
    """
    signal = Sine(kind="sine", amplitude=amplitude, angular_frequency=FORCED_FREQUENCY)
    return tsto(*RESPONSE_JOINT).model_copy(update={"forces": (Force(station=1.0, signal=signal),)})
