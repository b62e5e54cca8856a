"""The HTML of whatever a notebook can show."""

from collections.abc import Callable, Iterator
from typing import Any

from beal.control import ClosedLoop, ControlledThrust, ControlLocus, Margins
from beal.design.sampling import Sample
from beal.design.sensitivity import Sensitivity
from beal.motion import Response
from beal.notebook import loops, results, studies
from beal.notebook.vehicle import vehicle
from beal.shown import Shown
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve
from beal.stability.floquet import Floquet
from beal.stability.spectrum import Spectrum
from beal.study.flight import Flight
from beal.study.refined import RefinedMap
from beal.vehicle.vehicle import Vehicle

BLOCKS: dict[type[Shown], Callable[[Any], Iterator[str]]] = {
    Vehicle: vehicle,
    CriticalThrust: results.critical,
    ThrustCurve: results.curve,
    Spectrum: results.spectrum,
    Floquet: results.floquet,
    Flight: results.flight,
    Response: results.response,
    ClosedLoop: loops.closed_loop,
    ControlLocus: loops.control_locus,
    Margins: loops.margins,
    ControlledThrust: loops.controlled,
    RefinedMap: studies.refined,
    Sensitivity: studies.sensitivity,
    Sample: studies.sample,
}

CSS = """
.beal .verdict { font-weight: 600; }
.beal p { margin: .35em 0; }
.beal img { max-width: 100%; background: #fff; }
.beal table { border-collapse: collapse; margin: .5em 0; }
.beal caption { text-align: left; font-weight: 600; padding: .2em 0; }
.beal th, .beal td { padding: .15em .8em .15em 0; text-align: left; vertical-align: top; }
.beal .n { text-align: right; font-variant-numeric: tabular-nums; }
"""


def html(result: Shown) -> str:
    """One block of HTML that needs nothing else: text, tables, figures as images.

    Parameters
    ----------
    result : Shown

    Returns
    -------
    str

    Examples
    --------
    >>> from beal.stability.critical import critical_thrust
    >>> from beal.vehicle import catalog
    >>> "flutter at P = 20.0509536" in html(critical_thrust(catalog.beck()))
    True
    """
    return f'<div class="beal"><style>{CSS}</style>{"".join(_blocks(result))}</div>'


def _blocks(result: Shown) -> Iterator[str]:
    for kind, blocks in BLOCKS.items():
        if isinstance(result, kind):
            return blocks(result)
    raise TypeError(f"{type(result).__name__}: no way to show it")
