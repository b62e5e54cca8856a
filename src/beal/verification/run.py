"""All cases, or some of them, computed and compared."""

from collections.abc import Callable

from beal.errors import ModelError
from beal.verification import becks, columns, controlled, damped, joints, missiles, pendulum, timoshenko
from beal.verification.case import Case, Row

FAMILIES = (becks, columns, pendulum, missiles, controlled, joints, timoshenko, damped)
CASES: tuple[Case, ...] = tuple(case for family in FAMILIES for case in family.CASES)

Progress = Callable[[int, int], None]


def chosen(text: str) -> list[Case]:
    """The cases whose name or title holds a text, in capitals or not.

    Raises
    ------
    ModelError
        If there is none.
    """
    part = text.casefold()
    found = [case for case in CASES if part in case.name.casefold() or part in case.vehicle.title.casefold()]
    if not found:
        entries = sorted({case.name.partition("(")[0] for case in CASES})
        raise ModelError(f"case: must be part of a name such as {', '.join(entries)}, found {text!r}")
    return found


def verify(case: str | None = None, progress: Progress | None = None) -> list[Row]:
    """Compute what is known of the vehicles of the catalog and compare.

    Parameters
    ----------
    case : str, optional
        Part of the name of some cases, such as ``pflueger`` or ``pflueger(0.5)``; all cases without it.
    progress : callable, optional
        Called with the number of cases done and of all.

    Returns
    -------
    list of Row
        One for each quantity, with its published value, an independent exact one and the verdict.

    Raises
    ------
    ModelError
        If there is no such case.

    Examples
    --------
    >>> thrust, frequency = verify("reut")
    >>> thrust.quantity, thrust.verdict, round(thrust.measured.value, 6)
    ('flutter thrust', 'agrees', 20.050954)
    """
    cases = chosen(case) if case else CASES
    rows: list[Row] = []
    for done, known in enumerate(cases, 1):
        rows += known.rows()
        if progress:
            progress(done, len(cases))
    return rows
