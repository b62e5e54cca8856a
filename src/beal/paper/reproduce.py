"""The whole paper in one call: data, figures, verdicts and the report."""

import csv
import io
import json
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from beal.discretisation.build import Formulation
from beal.paper import cases, figures
from beal.paper.claims import Verdict, judge
from beal.paper.evidence import FORCED_DURATION, FORCED_SWEEP, FREE_DURATION, Maps, Progress, curves, maps, motion
from beal.paper.figures_motion import forced_motion, free_motion
from beal.paper.findings import Findings, convergence_curves, findings
from beal.paper.page import report
from beal.plot.style import style
from beal.vehicle.catalog import tsto

POINTS = 32  # per axis of each map
START_TEXT = "Released at rest in the shape of the first free mode, with the nose deflected by L/1000."


def reproduce(directory: str | Path, points: int | None = None, progress: Progress | None = None) -> Path:
    """Regenerate Irani & Kavianipour (2009): figures, the data behind them, claims and a report.

    Parameters
    ----------
    directory : str or Path
        Where ``report.html``, ``claims.json`` and, for each figure, ``.png``, ``.svg`` and ``.csv`` are written.
    points : int, optional
        Of each axis of the maps.
    progress : callable, optional
        Called with (what is done, steps done, all steps).

    Returns
    -------
    Path
        Of the report.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    points = points or POINTS
    tell = progress or (lambda text, done, total: None)
    drawings: list[figures.Drawing] = []
    pictures: dict[str, dict[str, bytes]] = {}
    charts = maps(points, tell)
    found, verdicts = _judged(charts, tell)
    with style():
        makers = _makers(charts, verdicts, found)
        for make in makers:
            tell("figures", len(drawings), len(makers))
            drawing = make()
            drawings.append(drawing)
            pictures[drawing.name] = save(drawing, folder)
    tell("figures", len(drawings), len(makers))
    _write(folder / "claims.json", json.dumps([verdict.record() for verdict in verdicts], indent=1, ensure_ascii=False))
    page = report(drawings, pictures, verdicts, found, charts, points)
    _write(folder / "report.html", page)
    return folder / "report.html"


def save(drawing: figures.Drawing, folder: Path) -> dict[str, bytes]:
    """Write a drawing as PNG and SVG and its data as CSV.

    Parameters
    ----------
    drawing : Drawing
    folder : Path

    Returns
    -------
    dict of kind to content
        Of the two pictures.
    """
    pictures = {}
    for kind, metadata in (("png", {}), ("svg", {"Date": None})):
        buffer = io.BytesIO()
        drawing.figure.savefig(buffer, format=kind, metadata=metadata)
        pictures[kind] = buffer.getvalue()
        (folder / f"{drawing.name}.{kind}").write_bytes(pictures[kind])
    _write_table(folder / f"{drawing.name}.csv", drawing.table)
    return pictures


def _judged(charts: Maps, tell: Progress) -> tuple[Findings, list[Verdict]]:
    total = len(cases.ORDER) + 1
    verdicts: list[Verdict] = []
    for index, name in enumerate(cases.ORDER):
        tell(f"claims, {cases.NAMES[name]}", index, total)
        verdicts += judge(charts, name)
    tell("findings", total - 1, total)
    return findings(), verdicts


def _makers(charts: Maps, verdicts: Sequence[Verdict], found: Findings) -> list[Callable[[], figures.Drawing]]:
    """What draws each figure, in the order of the paper."""
    makers: dict[int, Callable[[], figures.Drawing]] = {2: figures.shapes}
    for number in sorted({case.figure for case in cases.CURVES}):
        makers[number] = partial(_frequencies, number)
    for split, number in cases.MAP_FIGURES.items():
        makers[number] = partial(figures.chart, number, split, charts)
    for number, thrust in cases.RESPONSE_THRUSTS.items():
        makers[number] = partial(_free, number, thrust)
    makers[15] = partial(_forced, verdicts)
    last = partial(figures.convergence, convergence_curves(found))
    return [*(makers[number] for number in sorted(makers)), last]


def _frequencies(number: int) -> figures.Drawing:
    return figures.frequencies(number, [curves(case) for case in cases.CURVES if case.figure == number])


def _free(number: int, thrust: float) -> figures.Drawing:
    vehicle, duration = tsto(*cases.RESPONSE_JOINT), FREE_DURATION[number]
    motions = {name: motion(vehicle, name, thrust, duration, free=True) for name in cases.ORDER}
    return free_motion(number, thrust, motions, START_TEXT)


def _forced(verdicts: Sequence[Verdict]) -> figures.Drawing:
    pairs = [(thrust, force) for thrust in cases.FORCED_THRUSTS for force in cases.FORCED_AMPLITUDES]
    motions = {
        (thrust, force): motion(cases.forced(force), "objective", thrust, FORCED_DURATION / 2, free=False)
        for thrust, force in pairs
    }
    sweeps: dict[Formulation, dict[float, Any]] = {
        verdict.formulation: {force: verdict.numbers[f"amplitude_F_{force:g}"] for force in cases.FORCED_AMPLITUDES}
        for verdict in verdicts
        if verdict.id == "C9"
    }
    return forced_motion(motions, FORCED_SWEEP, sweeps)


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def _write_table(path: Path, table: figures.Table) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# {table.about}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table.columns)
        for row in table.rows:
            writer.writerow([f"{value:.10g}" if isinstance(value, float) else value for value in row])
