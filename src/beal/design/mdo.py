"""A vehicle as a component of OpenMDAO, with analytic partials."""

import math
import re
from functools import cached_property
from typing import Any

from beal.design.derivatives import Quantity, mass, slope
from beal.design.gradient import critical_gradient
from beal.design.sensitivity import differentiable
from beal.errors import ConvergenceError, ModelError
from beal.stability.critical import CriticalThrust, critical_thrust
from beal.vehicle.links import Link, with_links
from beal.vehicle.paths import unit_at, value_at, with_values
from beal.vehicle.vehicle import Vehicle

try:
    import openmdao.api as om
except ModuleNotFoundError:
    raise ModelError("StabilityComponent: needs OpenMDAO, which is not installed; install beal[mdo]") from None

NOMINAL = "thrust.nominal"


class StabilityComponent(om.ExplicitComponent):  # type: ignore[misc]
    """Critical thrust, its frequency and the mass of a vehicle, over some of its quantities.

    Inputs are the quantities, named like their paths with underscores: ``joint[0].shear_stiffness`` is
    ``joint_0_shear_stiffness``. Outputs are ``critical_thrust`` (N), ``angular_frequency`` (rad/s), ``mass`` (kg) and,
    where the vehicle has a nominal thrust, ``margin``: critical over nominal thrust, less 1. In nondimensional vehicles
    all are pure numbers.

    The partials are those of the instability that comes first. Where another one overtakes it they jump, and where a
    pair of modes begins or ceases to meet the critical thrust itself does, which a gradient method cannot see;
    `beal.sensitivity` and `beal.allowed_range` tell how close that is.

    Parameters
    ----------
    vehicle : Vehicle
        Gives every quantity that is not an input.
    paths : sequence of str
    links : mapping of str to Link, optional
        By the path of a quantity that follows an input.
    max_thrust : float, optional
        In N, as for `beal.critical_thrust`.
    formulation : {"objective", "converged"}

    Raises
    ------
    ModelError
        If OpenMDAO is not installed, or, in ``setup``, if the vehicle has no such quantity or an infinite one.
    openmdao.api.AnalysisError
        In ``compute``, if the quantities make no vehicle, or one without a critical thrust.

    Examples
    --------
    >>> import openmdao.api as om
    >>> from beal.vehicle.catalog import beck
    >>> problem = om.Problem(reports=None)
    >>> column = StabilityComponent(vehicle=beck(), paths=["stage[0].bending_stiffness"])
    >>> _ = problem.model.add_subsystem("column", column, promotes=["*"])
    >>> _ = problem.setup()
    >>> problem["stage_0_bending_stiffness"] = 2.0
    >>> _ = problem.run_model()
    >>> round(problem["critical_thrust"].item(), 5)
    40.10191
    """

    def initialize(self) -> None:
        """Declares the options."""
        self.options.declare("vehicle", types=Vehicle, recordable=False)
        self.options.declare("paths", types=(list, tuple))
        self.options.declare("links", default={}, types=dict, recordable=False)
        self.options.declare("max_thrust", default=None, allow_none=True)
        self.options.declare("formulation", default="objective", values=["objective", "converged"])

    def setup(self) -> None:
        """Declares inputs and outputs."""
        vehicle: Vehicle = self.options["vehicle"]
        links: dict[str, Link] = self.options["links"]
        bad = [(path, "is an input and linked to one; keep one of the two") for path in links if path in self.names]
        bad += [(path, f"follows {link.of}, not an input") for path, link in links.items() if link.of not in self.names]
        for path, name in self.names.items():
            value = value_at(vehicle, path)
            if math.isinf(value):
                bad.append((path, "is infinite; give the vehicle a finite value to start from"))
            self.add_input(name, val=0.0 if math.isinf(value) else value, units=_units(vehicle, path))
        if bad:
            raise ModelError(bad)
        for path in links:
            value_at(vehicle, path)
        si = vehicle.units == "SI"
        self.add_output("critical_thrust", val=1.0, units="N" if si else None)
        self.add_output("angular_frequency", val=1.0, units="rad/s" if si else None)
        self.add_output("mass", val=1.0, units="kg" if si else None)
        if vehicle.thrust.nominal is not None or NOMINAL in self.names:
            self.add_output("margin", val=0.0)
        self.declare_partials("*", "*")

    @cached_property
    def names(self) -> dict[str, str]:
        """Name of the input of each path."""
        return {path: re.sub(r"\W+", "_", path) for path in self.options["paths"]}

    def compute(self, inputs: Any, outputs: Any) -> None:
        """The outputs of a vehicle."""
        vehicle, found = self._solved(inputs)
        outputs["critical_thrust"] = found.critical_thrust
        outputs["angular_frequency"] = found.angular_frequency
        outputs["mass"] = vehicle.mass
        if vehicle.thrust.nominal is not None:
            outputs["margin"] = (found.critical_thrust or 0.0) / vehicle.thrust.nominal - 1

    def compute_partials(self, inputs: Any, partials: Any) -> None:
        """Their derivatives."""
        vehicle, found = self._solved(inputs)
        links: dict[str, Link] = self.options["links"]
        moving = [path for path in (*self.names, *links) if path != NOMINAL]
        gradient = critical_gradient(vehicle, moving, None, self.options["formulation"], found)
        slopes = dict(zip(moving, zip(gradient.thrust, gradient.angular_frequency, strict=True), strict=True))
        nominal, thrust = vehicle.thrust.nominal, found.critical_thrust or 0.0
        for path, name in self.names.items():
            value = float(inputs[name].item())
            rates = {path: 1.0} | {key: link.slope(value) for key, link in links.items() if link.of == path}
            P, omega = (sum(rate * slopes[key][n] for key, rate in rates.items() if key in slopes) for n in (0, 1))
            partials["critical_thrust", name] = P
            partials["angular_frequency", name] = omega
            partials["mass", name] = sum(rate * slope(Quantity(vehicle, key), mass) for key, rate in rates.items())
            if nominal is not None:
                partials["margin", name] = (P - thrust / nominal * rates.get(NOMINAL, 0.0)) / nominal

    def _solved(self, inputs: Any) -> tuple[Vehicle, CriticalThrust]:
        """The vehicle and its critical thrust, found once for both outputs and partials."""
        values = tuple(float(inputs[name].item()) for name in self.names.values())
        if getattr(self, "_at", None) != values:
            named = with_links(dict(zip(self.names, values, strict=True)), self.options["links"])
            how = self.options["max_thrust"], self.options["formulation"]
            try:
                vehicle = with_values(self.options["vehicle"], named)
                self._found = vehicle, differentiable(critical_thrust(vehicle, *how, tolerance=1e-9))
            except (ModelError, ConvergenceError) as error:
                raise om.AnalysisError(str(error)) from None
            self._at = values
        return self._found


def _units(vehicle: Vehicle, path: str) -> str | None:
    return unit_at(vehicle, path).replace("^", "**") or None
