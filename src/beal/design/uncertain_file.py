"""The study file of ``beal uncertainty``: a model and how its quantities scatter (TOML)."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from beal.design.robust import Scenario
from beal.design.sampling import Method
from beal.design.scatter_file import LawEntry, ScatterEntry
from beal.design.uncertain import Uncertain
from beal.errors import ModelError
from beal.study.file import read_study
from beal.study.study import Solve
from beal.vehicle.paths import unit_at
from beal.vehicle.vehicle import Vehicle


class UncertaintyEntry(ScatterEntry):
    """The whole file."""

    uncertain: dict[str, LawEntry]


@dataclass(frozen=True)
class UncertaintyStudy:
    """What a study file asks.

    Parameters
    ----------
    vehicle : Vehicle
    uncertain : Uncertain
    samples : int
    method : str
    seed : int
    tolerances : mapping of path to (float, float)
    scenarios : tuple of Scenario
    solve : Solve
    """

    vehicle: Vehicle
    uncertain: Uncertain
    samples: int
    method: Method
    seed: int
    tolerances: Mapping[str, tuple[float, float]]
    scenarios: tuple[Scenario, ...]
    solve: Solve


def load_uncertainty(path: str | Path) -> UncertaintyStudy:
    """Reads a study file; the paths of the model and of measured values are taken relative to it.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    UncertaintyStudy

    Raises
    ------
    ModelError
        With every problem of the file, or of the model that it names.
    """
    entry, vehicle = read_study(path, UncertaintyEntry)
    try:
        laws, tolerances = entry.scatter(Path(path).parent, partial(unit_at, vehicle))
        uncertain = Uncertain(vehicle, laws, entry.correlation.by_pair(), entry.correlation.measure)
    except ModelError as error:
        raise ModelError(error.problems, str(path)) from None
    draw, solve = entry.sampling, entry.solve.solve
    return UncertaintyStudy(
        vehicle, uncertain, draw.samples, draw.method, draw.seed, tolerances, entry.scenarios, solve
    )
