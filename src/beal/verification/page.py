"""The rows as a page of documentation."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from beal.verification.case import Row, counted

DIGITS = 9  # of a value; machines differ in those that follow
HEAD = """# Known answers

Written by `beal verify --markdown`. Each row is a quantity of a vehicle of `beal.catalog`, named as it is called there.

* **published**: the number that the source prints, or the formula that it gives.
* **reference**: an independent exact value: the formula, or transfer matrices to the digits shown.
* **value**: what beal finds. It *agrees* with a published value if it does so to all digits printed, given its own
  error estimate. Where nothing is published it has been held against the reference alone.
* **second**: the same in another way. A thrust or a frequency in cubic finite elements, extrapolated; one in a given
  number of modes or elements by the complete search; a limit of vanishing damping from two small dampings.

A row also differs where the value is off its reference, or the two ways are more than a millionth apart.
"""
COLUMNS = ("case", "quantity", "published", "reference", "value", "second", "verdict")


def page(rows: Sequence[Row]) -> str:
    """The page in Markdown.

    Parameters
    ----------
    rows : sequence of Row

    Returns
    -------
    str
    """
    lines = [HEAD, counted(rows)]
    for (title, source), group in groupby(rows, lambda row: (row.title, row.source)):
        lines += ["", f"## {title[0].upper()}{title[1:]}", "", f"{source}.", ""]
        lines += _table(list(group))
    return "\n".join(lines) + "\n"


def _table(rows: list[Row]) -> Iterator[str]:
    """A table, and below it why rows differ."""
    yield "| " + " | ".join(COLUMNS) + " |"
    yield "|" + "---|" * len(COLUMNS)
    for row in rows:
        published, found = row.expected.published, row.measured
        cells = [f"`{row.name}`", row.quantity, published.text if published else "", row.expected.reference.text]
        yield "| " + " | ".join([*cells, f"{found.value:#.{DIGITS}g}", f"{found.second:#.7g}", row.verdict]) + " |"
    for row in rows:
        if row.expected.reason:
            yield f"\n{row.quantity[0].upper()}{row.quantity[1:]}: {row.expected.reason}."
