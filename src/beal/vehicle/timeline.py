"""What changes during a flight: thrust, how full the tanks are, which stages are still attached."""

import re
from collections.abc import Iterator, Sequence
from typing import Annotated, Any

from pydantic import Field, FiniteFloat, model_validator

from beal.vehicle.base import Misfit, Part, si, together
from beal.vehicle.parts import number
from beal.vehicle.stations import NOT_NEGATIVE

_RANGE = re.compile(r"\s*([1-9][0-9]{0,5})\s*(?:-\s*([1-9][0-9]{0,5})\s*)?")


class Timeline(Part):
    """Histories over time, one entry for each time; a time given twice is a step, such as a separation.

    Parameters
    ----------
    time : sequence of float
        In s, never falling.
    thrust : sequence of float
        In N; 0 where the vehicle coasts.
    fill : mapping of str to sequence of float
        Share of the mass of the full tank for each tank named; the others keep their own.
    stages : sequence of str
        The stages that are attached, counted from the nose, such as ``"1-3"`` or ``"2"``; all of them if left out.

    Examples
    --------
    >>> Timeline(time=[0.0, 60.0], thrust=[9.0, 9.0], fill={"LOX": [1.0, 0.4]}, stages=["1-2", "1"]).attached(1)
    (1, 1)
    """

    time: tuple[Annotated[FiniteFloat, si("s")], ...]
    thrust: tuple[Annotated[FiniteFloat, si("N"), NOT_NEGATIVE], ...]
    fill: dict[str, tuple[Annotated[FiniteFloat, si(""), Field(ge=0, le=1)], ...]] = Field(default_factory=dict)
    stages: tuple[str, ...] = ()

    @model_validator(mode="wrap")
    @classmethod
    def _fits_together(cls, data: Any, handler: Any) -> "Timeline":
        timeline: Timeline = together(cls, data, handler, _misfits)
        return timeline

    def __hash__(self) -> int:
        return hash((self.time, self.thrust, tuple(self.fill.items()), self.stages))

    def attached(self, index: int) -> tuple[int, int] | None:
        """First and last stage at a time, counted from 1; None where all are."""
        return _range(self.stages[index]) if self.stages else None


def strangers(timeline: Any, tanks: Sequence[Any], stages: int) -> Iterator[Misfit]:
    """What a timeline, raw or not, says of tanks and stages that a vehicle does not have."""
    fields = timeline if isinstance(timeline, dict) else getattr(timeline, "__dict__", {})
    known = ", ".join(str(name) for name in tanks) or "none"
    for name in _mapping(fields.get("fill")):
        if name not in tanks:
            yield ("timeline", "fill", name), f"must be a tank of this vehicle ({known})", name
    for n, text in enumerate(_listed(fields.get("stages"))):
        last = (_range(text) or (0, 0))[1]
        if stages and last > stages:
            yield ("timeline", "stages", n), f"must lie on the vehicle, stages 1-{stages}, found {text!r}", text


def _misfits(data: dict[str, Any]) -> Iterator[Misfit]:
    """What does not fit together in raw input, as far as it can be judged."""
    times = _listed(data.get("time"))
    if data.get("time") in ([], ()):
        yield ("time",), "must hold at least one time, found none", ()
    seconds = [number(time, "s") for time in times]
    for n in range(1, len(seconds)):
        if seconds[n] < seconds[n - 1]:
            yield ("time", n), f"must not be below the one before, {seconds[n - 1]:.12g}, found {seconds[n]:.12g}", n
        elif n > 1 and seconds[n] == seconds[n - 2]:
            yield ("time", n), f"may come twice, for a step; found {seconds[n]:.12g} again", n
    histories: dict[tuple[str, ...], Any]
    histories = {("thrust",): data.get("thrust"), ("stages",): data.get("stages") or None}
    histories |= {("fill", name): values for name, values in _mapping(data.get("fill")).items()}
    for location, values in histories.items():
        if times and isinstance(values, list | tuple) and len(values) != len(times):
            yield location, f"must have one entry for each of the {len(times)} times, found {len(values)}", values
    for n, text in enumerate(_listed(data.get("stages"))):
        if isinstance(text, str) and _range(text) is None:
            yield ("stages", n), f"must be stages from the nose, such as 1-3 or 2, found {text!r}", text


def _range(text: Any) -> tuple[int, int] | None:
    match = _RANGE.fullmatch(text) if isinstance(text, str) else None
    if match is None:
        return None
    first = int(match[1])
    last = int(match[2] or first)
    return (first, last) if first <= last else None


def _listed(values: Any) -> list[Any]:
    return list(values) if isinstance(values, list | tuple) else []


def _mapping(values: Any) -> dict[str, Any]:
    return values if isinstance(values, dict) else {}
