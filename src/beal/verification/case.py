"""A case: a vehicle of the catalog, what is known of it, and how it is computed here."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

from beal.vehicle.vehicle import Vehicle
from beal.verification.measure import Measure, Measured, critical, frequencies, frequency_name

HALF = 0.5001  # of the last digit printed, and a little for rounding
EXACT = 1e-13  # rounding of a closed form, relative
SECOND = 1e-6  # relative difference of two ways that is still agreement
Verdict = Literal["agrees", "differs", "no published value"]


@dataclass(frozen=True)
class Known:
    """A number as it is written, and how far from it the truth may lie."""

    text: str
    value: float
    within: float

    def met_by(self, measured: Measured) -> bool:
        """Whether a computed value agrees, given its error estimate."""
        return abs(measured.value - self.value) <= self.within + measured.error_estimate


def printed(text: str) -> Known:
    """A number that is known to the digits printed.

    Examples
    --------
    >>> printed("20.05").met_by(Measured(20.0509536, 1e-9, 20.0509536))
    True
    """
    return Known(text, float(text), HALF * 10.0 ** -len(text.partition(".")[2]))


def exact(formula: str, value: float) -> Known:
    """A number that a formula gives.

    Examples
    --------
    >>> exact("4 pi^2", 39.47841760435743).text
    '39.4784176 = 4 pi^2'
    """
    return Known(f"{value:.9g} = {formula}", value, EXACT * abs(value))


@dataclass(frozen=True)
class Expected:
    """A value from an independent exact computation, the published value if there is one, and why the two differ."""

    reference: Known
    published: Known | None = None
    reason: str = ""


@dataclass(frozen=True)
class Row:
    """One quantity of one case, compared.

    Parameters
    ----------
    name : str
        The entry of the catalog, as it is called.
    title : str
    source : str
        Author and year of the published value, or of the model where there is none.
    quantity : str
    expected : Expected
    measured : Measured
    """

    name: str
    title: str
    source: str
    quantity: str
    expected: Expected
    measured: Measured

    @property
    def verdict(self) -> Verdict:
        """On the published value, to all digits printed, and on the reference where nothing is published."""
        if not self.sound:
            return "differs"
        if self.expected.published is None:
            return "no published value"
        return "agrees" if self.expected.published.met_by(self.measured) else "differs"

    @property
    def sound(self) -> bool:
        """Whether the value agrees with the exact reference and with the second way."""
        value, second = self.measured.value, self.measured.second
        return self.expected.reference.met_by(self.measured) and abs(value - second) <= SECOND * abs(value)

    @property
    def unexplained(self) -> bool:
        """Whether the row differs, and not for a reason that lies in the published value."""
        return not self.sound or (self.verdict == "differs" and not self.expected.reason)

    @property
    def plain(self) -> dict[str, Any]:
        """The row as names and numbers."""
        published = self.expected.published
        return {
            "name": self.name,
            "title": self.title,
            "source": self.source,
            "quantity": self.quantity,
            "published": published and published.value,
            "published_as": published and published.text,
            "reference": self.expected.reference.value,
            "value": self.measured.value,
            "error_estimate": self.measured.error_estimate,
            "second": self.measured.second,
            "verdict": self.verdict,
            "reason": self.expected.reason,
        }


def counted(rows: Sequence[Row]) -> str:
    """How many rows there are and how many agree, in a sentence."""
    count = Counter(row.verdict for row in rows)
    agree, differ, alone = (count[verdict] for verdict in ("agrees", "differs", "no published value"))
    return f"{len(rows)} values: {agree} agree, {differ} differ, {alone} have no published counterpart."


@dataclass(frozen=True)
class Case:
    """What is known of a vehicle, by quantity, and how it is computed."""

    name: str
    vehicle: Vehicle
    source: str
    expected: dict[str, Expected]
    measure: Measure = critical

    def rows(self) -> list[Row]:
        """Each quantity computed and compared."""
        found = self.measure(self.vehicle)
        return [
            Row(self.name, self.vehicle.title, self.source, quantity, expected, found.get(quantity, Measured()))
            for quantity, expected in self.expected.items()
        ]


def called(entry: Callable[..., Vehicle], *arguments: float | str, **options: float | str) -> tuple[str, Vehicle]:
    """An entry of the catalog as it is called, and the vehicle.

    Examples
    --------
    >>> from beal.vehicle.catalog import pflueger
    >>> called(pflueger, 0.5, rotary_inertia=0.1)[0]
    'pflueger(0.5, rotary_inertia=0.1)'
    """
    given = [repr(value) for value in arguments] + [f"{name}={value!r}" for name, value in options.items()]
    return f"{entry.__name__}({', '.join(given)})", entry(*arguments, **options)


def flutter(
    thrust: Known | str, omega: Known | str = "", published: Known | None = None, reason: str = "", of: str = ""
) -> dict[str, Expected]:
    """What is known of a flutter: the thrust and, unless left out, the frequency."""
    expected = {f"flutter thrust{of}": Expected(_known(thrust), published, reason)}
    return {**expected, f"flutter frequency{of}": Expected(_known(omega))} if omega else expected


def divergence(
    thrust: Known | str, published: Known | None = None, reason: str = "", of: str = ""
) -> dict[str, Expected]:
    """What is known of a divergence: the thrust."""
    return {f"divergence thrust{of}": Expected(_known(thrust), published, reason)}


def at_thrust(thrust: float, known: Sequence[Known | str]) -> tuple[dict[str, Expected], Measure]:
    """The lowest frequencies at a thrust and the way to compute them; those that a formula gives count as published."""
    expected = {}
    for number, value in enumerate(known, 1):
        published = value if isinstance(value, Known) else None
        expected[frequency_name(number, thrust)] = Expected(_known(value), published)
    return expected, partial(frequencies, thrust=thrust, count=len(known))


def _known(value: Known | str) -> Known:
    return printed(value) if isinstance(value, str) else value
