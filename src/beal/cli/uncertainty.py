"""``beal uncertainty``: how the critical thrust scatters, and what makes it scatter."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import named, new_figure, uncertainty_figure
from beal.cli.options import AsJson, Figure
from beal.cli.output import emit, new_file, note, progress_bar, show_table, write_columns

if TYPE_CHECKING:
    from beal.design.indices import Output
    from beal.design.sampling import Progress, Sample
    from beal.design.uncertain_file import UncertaintyStudy


def uncertainty(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file (TOML).", show_default=False)],
    thrust: Annotated[
        float | None, typer.Option("--thrust", metavar="P", help="Whose probability of instability, default nominal.")
    ] = None,
    indices: Annotated[
        int | None, typer.Option("--indices", metavar="N", help="Sobol' indices, N (quantities + 2) vehicles more.")
    ] = None,
    morris: Annotated[
        int | None,
        typer.Option("--morris", metavar="N", help="Elementary effects, N (quantities + 1) vehicles more."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write all vehicles there, as CSV.")
    ] = None,
    workers: Annotated[int | None, typer.Option("--workers", metavar="N", help="Workers, one for each core.")] = None,
    figure: Figure = None,
    as_json: AsJson = False,
) -> None:
    """Distribution of the critical thrust, probability of instability, worst case and scenarios."""
    from beal.design.indices import thrust_output
    from beal.design.robust import scenarios, worst_case
    from beal.design.sampling import sample
    from beal.design.uncertain_file import load_uncertainty
    from beal.report.records import sample_record

    task = load_uncertainty(study)
    asked = thrust if thrust is not None else task.vehicle.thrust.nominal
    with new_figure(figure, as_json) as draw, progress_bar() as bar:
        reports = {text: _report(bar, text) for text in ("vehicles", "worst case", "indices")}
        wanted = indices is not None or morris is not None
        effect = thrust_output(task.uncertain, None, task.solve, workers, reports["indices"]) if wanted else None
        imperfect = scenarios(task.vehicle, task.scenarios, task.solve) if task.scenarios else []
        found = sample(task.uncertain, task.samples, task.method, task.seed, task.solve, workers, reports["vehicles"])
        data: dict[str, Any] = sample_record(found, asked)
        data["scenarios"] = [
            {"name": name, "critical_thrust": case.critical_thrust, "kind": case.kind} for name, case in imperfect
        ]
        data["worst_case"] = None
        if task.tolerances:
            worst = worst_case(task.vehicle, task.tolerances, task.solve, workers, reports["worst case"])
            data["worst_case"] = asdict(worst)
        data |= {"sobol": None, "morris": None} if effect is None else _importance(effect, task, indices, morris)
        if output:
            with new_file(output) as file:
                write_columns(file, {"critical_thrust": found.critical_thrust, "kind": found.kind, **_columns(found)})
        draw(lambda: uncertainty_figure(found, asked, task.vehicle))
    data |= {"units": task.vehicle.units, "file": str(output) if output else None, **named(figure)}
    if as_json:
        emit(data)
    else:
        _show(data)


def _report(bar: Any, text: str) -> "Progress":
    return lambda done, total: bar(text, done, total)


def _columns(found: "Sample") -> dict[str, Any]:
    return dict(zip(found.paths, found.values.T, strict=True))


def _importance(output: "Output", task: "UncertaintyStudy", indices: int | None, morris: int | None) -> dict[str, Any]:
    """Sobol' indices and elementary effects, where they are asked for."""
    from beal.design.indices import morris_effects, sobol_indices

    paths = tuple(task.uncertain.distributions)
    return {
        "sobol": None if indices is None else asdict(sobol_indices(output, paths, indices, task.seed)),
        "morris": None if morris is None else asdict(morris_effects(output, paths, morris, task.seed)),
    }


def _show(data: dict[str, Any]) -> None:
    for path, mass in data["truncated"].items():
        note(f"{path}: {mass:.3g} of the probability was impossible and cut off")
    unit = " [N]" if data["units"] == "SI" else ""
    kinds = ", ".join(f"{number} {name}" for name, number in data["kind"].items())
    print(f"{data['samples']} vehicles ({data['method']}, seed {data['seed']}): {kinds}, {data['failed']} not solved")
    if (probability := data["probability_of_instability"]) is not None:
        chance = "{value:.3g} (95 %: {low:.3g} to {high:.3g})".format(**probability)
        print(f"probability of instability up to P = {data['thrust']:.6g}: {chance}")
    rows = [(f"{row['probability']:.0%}", row["value"], row["low"], row["high"]) for row in data["quantiles"]]
    show_table(("quantile", f"critical thrust{unit}", "95 % from", "to"), rows)
    if data["scenarios"]:
        cases = [(case["name"], case["critical_thrust"], case["kind"]) for case in data["scenarios"]]
        show_table(("name", f"critical thrust{unit}", "kind"), cases)
    if (worst := data["worst_case"]) is not None:
        where = ", ".join(f"{path} = {value:.6g}" for path, value in worst["values"].items())
        print(f"weakest found within the tolerances: P = {worst['critical_thrust']:.6g} at {where}")
    if data["sobol"]:
        columns = ("name", "first", "95 % from", "to", "total", "95 % from", "to")
        show_table(columns, _rows(data["sobol"], "first", "total"))
    if data["morris"]:
        effects = data["morris"]
        found = _rows(effects, "mean_absolute")
        extra = zip(effects["mean"], effects["deviation"], strict=True)
        show_table(
            ("name", "mean |effect|", "95 % from", "to", "mean", "deviation"),
            [(*row, *pair) for row, pair in zip(found, extra, strict=True)],
        )


def _rows(found: dict[str, Any], *parts: str) -> list[tuple[object, ...]]:
    return [
        (path, *(found[part][n][end] for part in parts for end in ("value", "low", "high")))
        for n, path in enumerate(found["quantities"])
    ]
