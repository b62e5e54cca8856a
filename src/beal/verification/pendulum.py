"""Ziegler's pendulum, whose answers are all closed forms."""

from beal.vehicle.catalog import ziegler
from beal.verification.case import Case, called, exact, flutter
from beal.verification.closed_forms import herrmann_jong, ziegler_flutter
from beal.verification.measure import vanishing

FORMULA = "(4 b^2 + 33 b + 4)/(2 (b + 1)(b + 6)) + B1 B2/2"
ROOT = "sqrt((B1 + B2)/(B1 + 6 B2))"


def _undamped(mass_ratio: float) -> Case:
    thrust, omega = ziegler_flutter(mass_ratio)
    load = exact("(5 + mu)/2 - sqrt(mu)", thrust)
    return Case(*called(ziegler, mass_ratio), "Ziegler (1952)", flutter(load, exact("mu^(-1/4)", omega), load))


def _damped(first: float, second: float) -> Case:
    thrust, omega = herrmann_jong(first, second)
    load = exact(FORMULA, thrust)
    vehicle = called(ziegler, 2.0, first, second)
    return Case(*vehicle, "Herrmann & Jong (1965)", flutter(load, exact(ROOT, omega), load))


def _vanishing(ratio: float) -> Case:
    tiny = 1e-12
    thrust, omega = herrmann_jong(tiny * ratio, tiny)
    load = exact(FORMULA.removesuffix(" + B1 B2/2"), thrust)
    expected = flutter(load, exact(ROOT, omega), load, of=", vanishing damping")
    return Case(*called(ziegler, 2.0, ratio, 1.0), "Herrmann & Jong (1965)", expected, vanishing)


CASES = [
    *(_undamped(mass_ratio) for mass_ratio in (0.5, 1.0, 2.0, 10.0)),
    *(_damped(*dashpots) for dashpots in ((0.1, 0.1), (0.1, 0.01), (0.01, 0.1), (0.5, 0.5))),
    *(_vanishing(ratio) for ratio in (0.1, 1.0, 10.0)),
]
