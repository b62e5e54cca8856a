"""``beal design``: the best vehicle for a question, with the evidence."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from beal.cli.figures import Draw, design_figure, named, new_figure, sensitivity_figure, uncertainty_figure
from beal.cli.loaded import note_omissions
from beal.cli.options import AsJson, Figure, Report
from beal.cli.output import Answer, emit, new_file, note, progress_bar, show
from beal.cli.reports import new_report

if TYPE_CHECKING:
    from beal.design.answer import DesignAnswer
    from beal.design.ranges import Edge
    from beal.design.variables import Variable

MOST = 6  # quantities in the table of sensitivities
AT_BOUND = 1e-6  # of the way from bound to bound


def design(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file (TOML).", show_default=False)],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write the model of the design there (TOML).")
    ] = None,
    workers: Annotated[int | None, typer.Option("--workers", metavar="N", help="Workers, one for each core.")] = None,
    figure: Figure = None,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """The largest critical thrust or the least mass: which design, how far from a cliff, how robust."""
    from beal.design.answer import design_answer
    from beal.design.design_file import load_design
    from beal.vehicle.file import dumps

    task = load_design(study)
    note_omissions(task.space.vehicle)
    question = task.question or f"{task.space.vehicle.title or 'vehicle'}: which design is the best?"
    with new_figure(figure, as_json) as draw, new_report(report, as_json) as tell, progress_bar() as bar:
        found = design_answer(task, workers, bar)
        if output:
            with new_file(output) as file:
                file.write(dumps(found.best.vehicle))
        draw(lambda: design_figure(found))
        answer, evidence = _answer(found), _evidence(found)
        sources = {"the study": task.text, "the model": dumps(task.space.vehicle)}
        tell(found.best.vehicle, question, answer, _figures(found), evidence, sources)
    if as_json:
        emit({**_data(found), "file": str(output) if output else None, **named(figure, report)})
        return
    print(question)
    show([*answer, *evidence])
    if output:
        note(f"design written to {output}")


def _figures(found: "DesignAnswer") -> dict[str, Draw]:
    vehicle = found.best.vehicle
    figures: dict[str, Draw] = {"Critical thrust around the design.": lambda: design_figure(found)}
    if (slopes := found.sensitivity) is not None:
        figures["What one percent more of each quantity does."] = lambda: sensitivity_figure(slopes)
    if (scatter := found.scatter) is not None:
        figures["Critical thrust of vehicles that scatter about the design."] = lambda: uncertainty_figure(
            scatter, found.asked, vehicle
        )
    return figures


def _answer(found: "DesignAnswer") -> Answer:
    """The verdict, the design, and how it was found."""
    from beal.report.numbers import quantity
    from beal.report.verdict import instability, thrust_unit

    best, study = found.best, found.study
    given, unit = study.space.vehicle, thrust_unit(study.space.vehicle)
    thrust = found.critical.critical_thrust or 0.0
    kilograms = " kg" if unit else ""
    told = [f"mass {best.mass:.6g}{kilograms}, as given {given.mass:.6g}{kilograms}"]
    if found.given and found.given.critical_thrust:
        before = found.given.critical_thrust
        told.append(f"critical thrust as given {quantity(before, unit)}: the design has {thrust / before - 1:+.1%}")
    how = f"best of {best.starts} local searches over {best.evaluations} vehicles, confirmed by the complete search"
    if best.second and best.second.critical_thrust:
        apart = abs(best.second.critical_thrust / (best.critical.critical_thrust or 1.0) - 1)
        how += f" and by another discretisation, to {apart:.0e}"
    if study.cases:
        weakest = "the weakest" if not study.quantile else f"the weakest but for {study.quantile:.0%}"
        told.insert(
            0, f"{weakest} of {len(best.case_thrusts)} cases, {best.case}: {instability(best.vehicle, best.critical)}"
        )
    told.append(f"{how}; nothing proves that no other design is better")
    if len(best.active) > 1:
        tied = " and ".join(f"{event.kind} of modes {event.modes[0]} and {event.modes[1]}" for event in best.active)
        told.append(f"tied there: {tied}")
    rows = []
    for (path, value), one in zip(best.values.items(), found.ranges.values(), strict=True):
        ends = (one.low, _edge(one.low_edge, one.low_kind), one.high, _edge(one.high_edge, one.high_kind))
        rows.append((path, value, _bound(study.space.variables[path], value), *ends))
    return [
        f"design: {instability(best.vehicle, found.critical)}",
        (("name", "design", "at bound", "from", "ends with", "to", "ends with"), rows),
        f"from, to: the variable moved alone keeps {study.keep:.0%} of that thrust, {quantity(found.kept, unit)}",
        *told,
    ]


def _bound(variable: "Variable", value: float) -> str:
    share = variable.share(value)
    return "low" if share < AT_BOUND else "high" if share > 1 - AT_BOUND else ""


def _edge(edge: "Edge", kind: str) -> str:
    return {"end": "bound", "unsolved": "not solved", "crossing": kind, "jump": f"jump to {kind}"}[edge]


def _evidence(found: "DesignAnswer") -> Answer:
    """Robustness and sensitivities."""
    from beal.report.numbers import quantity
    from beal.report.records import sample_record
    from beal.report.verdict import thrust_unit

    unit = thrust_unit(found.best.vehicle)
    told: list[Any] = []
    if found.worst is not None:
        where = ", ".join(f"{path} = {value:.6g}" for path, value in found.worst.values.items())
        told.append(f"weakest within the tolerances: P = {quantity(found.worst.critical_thrust, unit)} at {where}")
    if found.scatter is not None:
        record = sample_record(found.scatter, found.asked)
        weak = record["quantiles"][0]
        value, low, high = (quantity(weak[name], unit) for name in ("value", "low", "high"))
        told.append(
            f"of {record['samples']} vehicles that scatter about the design, {weak['probability']:.0%} fail up to "
            f"P = {value} (95 %: {low} to {high})"
        )
        if (chance := record["probability_of_instability"]) is not None:
            told.append(
                f"probability of instability up to P = {quantity(record['thrust'], unit)}: "
                + "{value:.3g} (95 %: {low:.3g} to {high:.3g})".format(**chance)
            )
    if found.scenarios:
        cases = [(name, case.critical_thrust, case.kind) for name, case in found.scenarios]
        told.append((("name", f"critical thrust{f' [{unit}]' if unit else ''}", "kind"), cases))
    if found.sensitivity is not None:
        rows = [(each.path, each.value, each.elasticity) for each in found.sensitivity.ranked[:MOST]]
        told.append((("name", "value", "critical thrust, % per %"), rows))
    return [*told, *found.gaps]


def _data(found: "DesignAnswer") -> dict[str, Any]:
    from beal.report.records import critical_record, event_record, sample_record

    best, study = found.best, found.study
    return {
        **critical_record(best.vehicle, found.critical),
        "question": study.question,
        "objective": study.objective,
        "target": study.target,
        "mass": best.mass,
        "variables": [
            {"path": path, "value": value, **asdict(study.space.variables[path]), "range": asdict(found.ranges[path])}
            for path, value in best.values.items()
        ],
        "kept": found.kept,
        "given": found.given and critical_record(study.space.vehicle, found.given),
        "second": best.second and asdict(best.second),
        "case": best.case,
        "case_thrust": best.critical.critical_thrust,
        "active": [event_record(event) for event in best.active],
        "starts": best.starts,
        "evaluations": best.evaluations,
        "sensitivity": found.sensitivity and [asdict(each) for each in found.sensitivity.ranked],
        "worst_case": found.worst and asdict(found.worst),
        "scatter": found.scatter and sample_record(found.scatter, found.asked),
        "scenarios": [
            {"name": name, "critical_thrust": case.critical_thrust, "kind": case.kind} for name, case in found.scenarios
        ],
        "gaps": found.gaps,
    }
