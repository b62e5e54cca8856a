"""The HTML of whatever a notebook can show."""

from collections.abc import Iterator

from beal.control import ClosedLoop, ControlLocus
from beal.motion import Response
from beal.notebook import results
from beal.notebook.vehicle import vehicle
from beal.shown import Shown
from beal.stability.critical import CriticalThrust
from beal.stability.curve import ThrustCurve
from beal.study.flight import Flight
from beal.vehicle.vehicle import Vehicle

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
    match result:
        case Vehicle():
            return vehicle(result)
        case CriticalThrust():
            return results.critical(result)
        case ThrustCurve():
            return results.curve(result)
        case Flight():
            return results.flight(result)
        case Response():
            return results.response(result)
        case ClosedLoop():
            return results.closed_loop(result)
        case ControlLocus():
            return results.control_locus(result)
    raise TypeError(f"{type(result).__name__}: no way to show it")
