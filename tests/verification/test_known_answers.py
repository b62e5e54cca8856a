"""Every known answer: what beal finds, what the documentation prints, and what an exact solver of its own finds."""

from collections import Counter
from pathlib import Path

import pytest

from beal.verification.case import Case, Expected, Row, exact, printed
from beal.verification.measure import Measured
from beal.verification.page import page
from beal.verification.run import CASES
from verification import transfer_matrix

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "verification.md").read_text(encoding="utf-8").splitlines()
APART = 1 + 3e-4  # how far from the value that it is to confirm the exact solver starts
ROUNDING = 3e-12  # of the exact solver, relative
FEW = (", as-printed", ", corrected-ritz", ", converged", " cubic elements")  # quantities of other equations
EXACT = [case for case in CASES if not next(iter(case.expected)).endswith(FEW)]


def named(case: Case) -> str:
    return f"{case.name}: {next(iter(case.expected))}"


def cells(line: str) -> list[str]:
    return line.strip("| ").split(" | ")


def same(line: str, other: str) -> bool:
    """Whether two lines of the page are the same but for one in the last digit of a number."""
    pairs = list(zip(cells(line), cells(other), strict=True))
    return all(one == two or abs(float(one) - float(two)) < 2.1 * printed(one).within for one, two in pairs)


@pytest.mark.parametrize("case", CASES, ids=named)
def test_known_answer_is_found_in_two_ways_and_stands_in_the_documentation(case):
    rows = case.rows()
    assert [row.plain for row in rows if row.unexplained] == []
    documented = {tuple(cells(line)[:2]): line for line in PAGE if line.startswith("| `")}
    for line in page(rows).splitlines():
        if line.startswith("| `"):
            assert same(line, documented[tuple(cells(line)[:2])])


def test_documentation_holds_all_cases_and_nothing_else():
    rows = [
        Row(case.name, case.vehicle.title, case.source, quantity, expected, Measured())
        for case in CASES
        for quantity, expected in case.expected.items()
    ]

    def without_results(lines):
        return [cells(line)[:4] if line.startswith("| `") else line for line in lines if "values:" not in line]

    assert without_results(PAGE) == without_results(page(rows).splitlines())
    count = Counter(cells(line)[-1] for line in PAGE if line.startswith("| `"))
    numbers = (count["agrees"], count["differs"], count["no published value"])
    assert "{} values: {} agree, {} differ, {} have no published counterpart.".format(len(rows), *numbers) in PAGE
    assert f"{len(rows)} values" in (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("case", EXACT, ids=named)
def test_reference_is_what_transfer_matrices_give(case):
    known = [expected.reference for expected in case.expected.values()]
    for found, reference in zip(by_transfer_matrices(case, [number.value for number in known]), known, strict=True):
        assert abs(found - reference.value) <= reference.within + ROUNDING * abs(found)


def by_transfer_matrices(case: Case, values: list[float]) -> list[float]:
    """The case's quantities, from guesses beside the values that are to be confirmed."""
    quantity = next(iter(case.expected))
    guess = [APART * value for value in values]
    if quantity.startswith("frequency"):
        thrust = case.measure.keywords["thrust"]
        return [transfer_matrix.frequency(case.vehicle, thrust, omega) for omega in guess]
    if quantity.startswith("divergence"):
        return [transfer_matrix.divergence(case.vehicle, *guess)]
    if quantity.endswith("vanishing damping"):
        return transfer_matrix.damped_flutter(case.vehicle, *guess, damping=1e-30)
    solve = transfer_matrix.damped_flutter if case.vehicle.damped else transfer_matrix.flutter
    return solve(case.vehicle, *guess)


@pytest.mark.parametrize(
    ("expected", "measured", "verdict", "unexplained"),
    [
        (Expected(printed("1.25"), printed("1.3")), Measured(1.2549, 0.0, 1.2549), "agrees", False),
        (Expected(printed("1.25"), printed("1.3")), Measured(1.2551, 0.0, 1.2551), "differs", True),
        (Expected(printed("1.25"), printed("1.3")), Measured(1.2551, 2e-4, 1.2551), "agrees", False),
        (Expected(printed("1.25"), printed("1.4"), "known"), Measured(1.25, 0.0, 1.25), "differs", False),
        (Expected(printed("1.25"), printed("1.4")), Measured(1.25, 0.0, 1.25), "differs", True),
        (Expected(printed("1.25")), Measured(1.25, 0.0, 1.25), "no published value", False),
        (Expected(printed("1.25"), reason="known"), Measured(1.26, 0.0, 1.26), "differs", True),
        (Expected(printed("1.25")), Measured(1.25, 0.0, 1.2501), "differs", True),
        (Expected(exact("5/4", 1.25)), Measured(1.25 + 1e-12, 0.0, 1.25), "differs", True),
        (Expected(exact("5/4", 1.25)), Measured(), "differs", True),
    ],
)
def test_verdict_is_on_all_digits_printed_given_the_error_estimate(expected, measured, verdict, unexplained):
    row = Row("", "", "", "", expected, measured)
    assert (row.verdict, row.unexplained) == (verdict, unexplained)
