"""``beal map`` and ``beal reproduce``: many vehicles, with progress on standard error."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.options import AsJson
from beal.cli.output import check_folder, emit, make_folder, note
from beal.errors import ModelError

if TYPE_CHECKING:
    from xarray import Dataset


def map_study(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file (TOML).", show_default=False)],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="OUT.zarr", help="Result.", show_default=False)],
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what an earlier run left.")] = False,
    workers: Annotated[int | None, typer.Option("--workers", metavar="N", help="Number of processes.", min=1)] = None,
    scheduler: Annotated[str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Not available.")] = None,
    as_json: AsJson = False,
) -> None:
    """Critical thrust, kind, modes, frequency and error over a grid of parameters."""
    if scheduler is not None:
        raise ModelError("--scheduler: clusters are not supported; leave it out and use --workers on this machine")
    check_folder(output)
    from beal.study.file import load_study
    from beal.study.map import run_study

    task = load_study(study)
    try:
        with _progress() as progress:
            found = run_study(task, output, resume, workers, lambda done, total: progress("points", done, total))
    except KeyboardInterrupt:
        note(f"interrupted; beal map {study} -o {output} --resume goes on with it")
        raise
    data = {"file": str(output), **_counts(found)}
    if as_json:
        emit(data)
        return
    kinds = ", ".join(f"{number} {name}" for name, number in data["kind"].items())
    failed = ", ".join(f"{number} {name}" for name, number in data["status"].items() if number and name != "solved")
    print(f"{output}: {data['points']} points: {kinds}" + (f"; {failed}" if failed else ""))
    if data["lowest"] is not None:
        print(f"critical thrust from {data['lowest']:.6g} to {data['highest']:.6g}")


def _counts(found: "Dataset") -> dict[str, Any]:
    """How many points of each status and kind, and the range of the critical thrust."""
    import numpy as np

    status, kind, thrust = (found[name].values for name in ("status", "kind", "critical_thrust"))
    statuses, kinds = (found[name].attrs["flag_meanings"].split() for name in ("status", "kind"))
    solved = status == statuses.index("solved")
    known = thrust[solved & np.isfinite(thrust)]
    return {
        "points": status.size,
        "status": {name: int(np.sum(status == n)) for n, name in enumerate(statuses)},
        "kind": {name: int(np.sum(kind[solved] == n)) for n, name in enumerate(kinds)},
        "lowest": known.min() if known.size else None,
        "highest": known.max() if known.size else None,
    }


def reproduce(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder.", show_default=False)],
    points: Annotated[int | None, typer.Option(metavar="N", help="Points per axis of each map.", min=4)] = None,
    as_json: AsJson = False,
) -> None:
    """Regenerate Irani & Kavianipour (2009): every figure, its data, every claim, and a report."""
    make_folder(output)
    try:
        from beal.paper.reproduce import reproduce as run
    except ModuleNotFoundError as error:
        if error.name != "matplotlib":
            raise
        raise ModelError("reproduce: needs matplotlib, which is not installed; install beal[plot]") from None
    with _progress() as progress:
        report = run(output, points=points, progress=progress)
    if as_json:
        emit({"directory": str(output), "report": str(report), "claims": str(output / "claims.json")})
    else:
        print(f"report: {report}")


@contextmanager
def _progress() -> Iterator[Callable[[str, int, int], None]]:
    """A bar on standard error that is moved by (text, done, total)."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("", total=None)
        yield lambda text, done, total: bar.update(task, description=text, completed=done, total=total)
