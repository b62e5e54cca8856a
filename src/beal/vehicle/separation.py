"""What is left of a vehicle when stages leave it."""

from collections.abc import Iterator

from beal.errors import ModelError
from beal.vehicle.parts import Support
from beal.vehicle.stations import REACH
from beal.vehicle.tanks import Tank
from beal.vehicle.vehicle import Vehicle


def attached(vehicle: Vehicle, first: int, last: int) -> Vehicle:
    """Some neighbouring stages of a vehicle, with what sits on them; stations count from the new nose.

    What sits at a joint belongs to the stage aft of it. The thrust acts at the new tail, or at its station where that
    is still attached. The control law is that of the whole vehicle and goes.

    Parameters
    ----------
    vehicle : Vehicle
        With free ends.
    first, last : int
        Stages, counted from 1 at the nose.

    Returns
    -------
    Vehicle

    Raises
    ------
    ModelError
        If the vehicle has no such stages, or parts that cannot be divided: held ends, distributed thrusts, a tank
        with propellant on both sides of a separation.

    Examples
    --------
    >>> from beal.vehicle.catalog import tsto
    >>> attached(tsto(0.6, 10.0, 20.0), 2, 2).boundaries
    (0.0, 0.4)
    """
    count = len(vehicle.stages)
    if not 1 <= first <= last <= count:
        raise ModelError(f"stages: must lie on the vehicle, stages 1-{count}, found {first}-{last}")
    if (first, last) == (1, count):
        return vehicle
    nose, tail = vehicle.boundaries[first - 1], vehicle.boundaries[last]
    if problems := list(_indivisible(vehicle, nose, tail)):
        raise ModelError(problems)
    station = vehicle.thrust.station
    left = station is not None and not first <= vehicle.stage_at(station) + 1 <= last
    return vehicle.model_copy(
        update={
            "stages": vehicle.stages[first - 1 : last],
            "joints": vehicle.joints[first - 1 : last - 1],
            "tanks": [_moved(tank, nose, tail) for tank in vehicle.tanks if _within(vehicle, tank, nose, tail)],
            "timeline": None,
            "control": None,
            "thrust": vehicle.thrust.model_copy(
                update={"station": None if station is None or left else _shifted(station, nose, tail)}
            ),
            **{
                name: [
                    part.model_copy(update={"station": _shifted(part.station, nose, tail)})
                    for part in getattr(vehicle, name)
                    if first <= vehicle.stage_at(part.station) + 1 <= last
                ]
                for name in ("point_masses", "axial_loads", "sensors", "forces")
            },
        }
    )


def _indivisible(vehicle: Vehicle, nose: float, tail: float) -> Iterator[tuple[str, str]]:
    """Why the stages between two stations cannot be left alone."""
    if vehicle.support != Support():
        yield "support", "stages leave only a vehicle whose ends are free, found one that is held"
    if vehicle.distributed_thrusts:
        yield "distributed_thrust", "what of it stays when stages leave is not known; leave one of the two out"
    for index, tank in enumerate(vehicle.tanks):
        margin = REACH * vehicle.length
        outside = tank.aft_end <= nose + margin or tank.forward_end >= tail - margin
        if tank.fill and not outside and not _within(vehicle, tank, nose, tail):
            yield f"tank[{index}]", f"{tank.name!r} holds propellant on both sides of a separation"


def _within(vehicle: Vehicle, tank: Tank, nose: float, tail: float) -> bool:
    margin = REACH * vehicle.length
    return nose - margin <= tank.forward_end and tank.aft_end <= tail + margin


def _moved(tank: Tank, nose: float, tail: float) -> Tank:
    ends = {end: _shifted(getattr(tank, end), nose, tail) for end in ("forward_end", "aft_end")}
    return tank.model_copy(update=ends)


def _shifted(station: float, nose: float, tail: float) -> float:
    return min(max(station - nose, 0.0), tail - nose)
