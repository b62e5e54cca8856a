"""``beal map`` and ``beal reproduce``: many vehicles, with progress on standard error."""

import math
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from beal.cli.figures import map_figure, named, new_figure
from beal.cli.loaded import note_omissions
from beal.cli.options import AsJson, Figure
from beal.cli.output import check_folder, emit, make_folder, note, progress_bar
from beal.errors import ModelError

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from beal.study.map import Progress
    from beal.study.study import Study


def map_study(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file (TOML).", show_default=False)],
    output: Annotated[
        str, typer.Option("-o", "--output", metavar="OUT.zarr", help="Folder or URL of the result.", show_default=False)
    ],
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what an earlier run left.")] = False,
    workers: Annotated[
        int | None,
        typer.Option("--workers", metavar="N", help="Workers on this machine, as many as cores if left out.", min=1),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", metavar="ADDRESS", help="Of a dask cluster, tcp://host:port, or local."),
    ] = None,
    refine: Annotated[
        float | None,
        typer.Option("--refine", metavar="WIDTH", help="Resolve borders to this share of each axis, such as 0.001."),
    ] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Critical thrust, kind, modes, frequency and error over a grid of parameters."""
    if "://" not in output:
        check_folder(Path(output))
    from beal.study.file import load_study
    from beal.study.map import run_study

    task = load_study(study)
    note_omissions(task.vehicle)
    if figure and (len(task.shape) != 2 or min(task.shape) < 2):
        shape = " x ".join(map(str, task.shape))
        raise ModelError(f"--figure: draws maps over two axes of more than one value each, found {shape}")
    try:
        with (
            new_figure(figure, as_json) as draw,
            _cluster(scheduler, workers) as executor,
            progress_bar() as progress,
        ):
            how = None if scheduler else workers, lambda done, total: progress("points", done, total), executor
            borders = {"refined": _refined(task, refine, output, resume, *how)} if refine is not None else {}
            found = run_study(task, output, resume or refine is not None, *how)
            draw(lambda: map_figure(output, refined=refine is not None))
    except KeyboardInterrupt:
        where = (f" --scheduler {scheduler}" if scheduler else "") + (f" --refine {refine}" if refine else "")
        note(f"interrupted; beal map {study} -o {output}{where} --resume goes on with it")
        raise
    data = {"file": output, **found.named(), **borders, **named(figure)}
    if as_json:
        emit(data)
        return
    kinds = ", ".join(f"{number} {name}" for name, number in data["kind"].items())
    failed = ", ".join(f"{number} {name}" for name, number in data["status"].items() if number and name != "solved")
    single = f"; {data['method']['single']} solved one by one" if data["method"]["single"] else ""
    print(f"{output}: {data['points']} points: {kinds}" + (f"; {failed}" if failed else "") + single)
    if data["lowest"] is not None:
        unit = " N" if task.vehicle.units == "SI" else ""
        print(f"critical thrust from {data['lowest']:.6g} to {data['highest']:.6g}{unit}")
    if borders:
        print(
            "borders resolved to {width:g}: {points} points more, {cells} cells; ".format(**borders["refined"]), end=""
        )
        print(f"a uniform grid as fine has {borders['refined']['uniform_points']} points")


def _refined(
    study: "Study",
    width: float,
    out: str,
    resume: bool,
    workers: int | None,
    progress: "Progress",
    executor: "Executor | None",
) -> dict[str, float]:
    """Solves the grid and resolves the borders in it; how many points and cells that takes."""
    from beal.study.refined import run_refined

    found = run_refined(study, width, out, resume, workers, progress, executor).refined
    uniform = (math.ceil(1 / width) + 1) ** sum(points > 1 for points in study.shape)
    return {"width": width, "points": found.sizes["point"], "cells": found.sizes["cell"], "uniform_points": uniform}


def _cluster(scheduler: str | None, workers: int | None) -> "AbstractContextManager[Executor | None]":
    if scheduler is None:
        return nullcontext()
    from beal.study.cluster import cluster

    return cluster(scheduler, workers)


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
    with progress_bar() as progress:
        report = run(output, points=points, progress=progress)
    if as_json:
        emit({"directory": str(output), "report": str(report), "claims": str(output / "claims.json")})
    else:
        print(f"report: {report}")
