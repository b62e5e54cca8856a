"""``beal verify``: known answers, and what beal finds."""

from typing import TYPE_CHECKING, Annotated

import typer

from beal.cli.options import AsJson
from beal.cli.output import emit, progress_bar, show_table
from beal.errors import ConvergenceError, ModelError
from beal.report.numbers import digits

if TYPE_CHECKING:
    from beal.verification.case import Row


def verify(
    case: Annotated[
        str | None, typer.Option("--case", metavar="NAME", help="Those whose name holds this, such as pflueger.")
    ] = None,
    markdown: Annotated[bool, typer.Option("--markdown", help="As a page of documentation.")] = False,
    as_json: AsJson = False,
) -> None:
    """Recompute published and exact values of the literature, each in two ways, and compare."""
    from beal.verification.page import page
    from beal.verification.run import verify as run

    if markdown and as_json:
        raise ModelError("--markdown: is given beside --json; give one of them")
    with progress_bar() as progress:
        rows = run(case, lambda done, total: progress("cases", done, total))
    if as_json:
        emit({"cases": [row.plain for row in rows]})
    elif markdown:
        print(page(rows), end="")
    else:
        _show(rows)
    if wrong := [f"{row.name}, {row.quantity}" for row in rows if row.unexplained]:
        raise ConvergenceError(f"{len(wrong)} of {len(rows)} values differ without a known reason: {'; '.join(wrong)}")


def _show(rows: "list[Row]") -> None:
    from beal.verification.case import counted

    columns = ["name", "quantity", "published", "value", "error estimate", "verdict"]
    show_table(
        columns,
        [
            [
                row.name,
                row.quantity,
                row.expected.published and row.expected.published.text,
                digits(row.measured.value, row.measured.error_estimate),
                f"{row.measured.error_estimate:.1e}",
                row.verdict,
            ]
            for row in rows
        ],
    )
    print(counted(rows))
    for row in rows:
        if row.expected.reason or row.unexplained:
            print(f"{row.name}, {row.quantity}: {row.expected.reason or 'differs for no known reason'}")
