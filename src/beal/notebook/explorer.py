"""A vehicle to play with in a notebook: the sliders are there, the computation is here."""

from html import escape
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from beal.errors import BealError
from beal.notebook import results
from beal.notebook.page import CSS
from beal.notebook.pictures import verdict
from beal.report.verdict import shown_to
from beal.stability.critical import critical_thrust
from beal.stability.curve import thrust_curve
from beal.vehicle.paths import with_values
from beal.vehicle.vehicle import Vehicle

HERE = Path(__file__).parent
POINTS = 61  # of the curve


class Explorer(anywidget.AnyWidget):
    """Sliders, the verdict and the frequencies over thrust of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
        As it is before any slider is moved; later, as the sliders make it.
    quantities : list of dict
        From `beal.vehicle.sliders.sliders`.
    """

    _esm = HERE / "explorer.js"
    _css = CSS + (HERE / "explorer.css").read_text(encoding="utf-8")
    quantities: Any = traitlets.List().tag(sync=True)
    values = traitlets.Dict().tag(sync=True)  # of the quantities that were moved
    answer = traitlets.Dict().tag(sync=True)  # as HTML, and to which values

    def __init__(self, vehicle: Vehicle, quantities: list[dict[str, Any]]) -> None:
        self.vehicle = self._base = vehicle
        super().__init__(quantities=quantities)
        self._show({})

    @traitlets.observe("values")
    def _moved(self, change: dict[str, Any]) -> None:
        self._show(change["new"])

    def _show(self, values: dict[str, float]) -> None:
        try:
            self.vehicle = with_values(self._base, values)
            found = critical_thrust(self.vehicle)
            curve = thrust_curve(self.vehicle, shown_to(found), POINTS)
            html = "".join([*results.critical(found), *results.curve(curve)])
        except BealError as error:
            html = verdict(escape(str(error)))
        self.answer = {"html": html, "values": values}
