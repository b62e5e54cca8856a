"""References of the known answers, for tests that look at more than the number."""

from beal.verification.run import CASES

REFERENCE = {
    (case.name, quantity): expected.reference.value for case in CASES for quantity, expected in case.expected.items()
}


def thrust(name: str, note: str = "") -> float:
    """The critical thrust of a case, of whichever kind."""
    kinds = (f"{kind} thrust{note}" for kind in ("flutter", "divergence"))
    return next(REFERENCE[name, quantity] for quantity in kinds if (name, quantity) in REFERENCE)


def frequency(name: str, note: str = "") -> float:
    """Its frequency of flutter, 0 for a divergence."""
    return REFERENCE.get((name, f"flutter frequency{note}"), 0.0)
