"""A vehicle as Nastran bulk data, which reads back to the same vehicle and is ready for a free vibration analysis."""

import math
from collections.abc import Iterator
from itertools import count, groupby

from beal.errors import ModelError
from beal.interop.cards import KEPT
from beal.interop.mesh import VARYING, meshed
from beal.interop.pieces import titled
from beal.interop.tables import between
from beal.vehicle.file import dumps_rest
from beal.vehicle.parts import Joint, Stage
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle

OUT_OF_PLANE = "1345"  # held everywhere: a vehicle bends in the plane xy
PLANE = "26"  # components of deflection and slope
SAID = {
    "stage": ["length", *VARYING],
    "joint": ["rotational_stiffness", "shear_stiffness", "rotational_damping", "shear_damping"],
    "point_mass": ["station", "mass", "rotary_inertia"],
    "support": ["nose", "tail"],
}
WIDTH = 16  # of a large field
Field = float | str | None
Ends = tuple[int, int, int]  # of a bar: its number, forward grid, aft grid


def nastran_text(vehicle: Vehicle, elements: int = 8) -> str:
    """Nastran bulk data of a vehicle: bars along x, which runs from the tail to the nose, bending in the plane xy.

    A bar has E = 1, so that its second moment of area is the bending stiffness, and all its mass is non-structural.
    Where a stage varies, it has tapered bars between grids at the stations of its tables.
    What bulk data cannot say (thrust, sensors, forces, names) is kept in comments that begin with ``$ beal:``.

    Parameters
    ----------
    vehicle : Vehicle
    elements : int
        Bars in each stage, at least; beal joins them again, other programs need them for accurate modes.

    Returns
    -------
    str
        Numbers with 10 to 14 digits, as many as the 16 columns of a large field hold.

    Raises
    ------
    ModelError
        If the number of elements is not positive, or a stage is rigid.

    Examples
    --------
    >>> from beal.vehicle import catalog
    >>> print(nastran_text(catalog.beck(), elements=1).partition("BEGIN BULK\\n")[2].partition("CBAR")[0])
    PARAM,COUPMASS,1
    EIGRL,1,,,12
    MAT1,1,1.,,0.
    SPC1,1,1345,1,THRU,2
    SPC1,1,26,1
    GRID*                  1                              1.              0.
    *                     0.
    GRID*                  2                              0.              0.
    *                     0.
    PBAR*                  1               1              1.              1.
    *                     1.                              1.
    $ -
    <BLANKLINE>
    """
    if elements < 1:
        raise ModelError([("elements", f"must be at least 1, found {elements}")])
    vehicle = vehicle.without_tanks
    _check(vehicle)
    named = {
        kind: all(_is_title(part.name) for part in parts)
        for kind, parts in (("stage", vehicle.stages), ("joint", vehicle.joints), ("point_mass", vehicle.point_masses))
    }
    said = {kind: [*keys, "name"] if named.get(kind, True) else keys for kind, keys in SAID.items()}
    cards = list(_bulk(vehicle, elements))
    head = [
        "$ beam model of a flexible vehicle, written by beal",
        "SOL 103",
        "CEND",
        "METHOD = 1",
        "SPC = 1",
        "BEGIN BULK",
    ]
    rest = [f"$ {KEPT} {line}" for line in (dumps_rest(vehicle, said) or "\n").splitlines()]
    return "\n".join([head[0], *rest, *head[1:], *cards, "ENDDATA", ""])


def _check(vehicle: Vehicle) -> None:
    """Refuse what no bar can be."""
    message = "is infinite, which no section of a bar can be; keep it in TOML"
    stages = enumerate(vehicle.stages)
    if rigid := [f"stage[{n}].bending_stiffness" for n, stage in stages if math.isinf(mean(stage.bending_stiffness))]:
        raise ModelError([(path, message) for path in rigid])


def _bulk(vehicle: Vehicle, elements: int) -> Iterator[str]:
    mesh = meshed(vehicle, elements)
    numbers, properties = count(len(mesh.bars) + 1), count(1)
    yield "PARAM,COUPMASS,1"
    yield "EIGRL,1,,,12"
    yield "MAT1,1,1.,,0."
    yield f"SPC1,1,{OUT_OF_PLANE},1,THRU,{len(mesh.grids)}"
    for stiffness, grid in zip(vehicle.support.stiffness, (1, len(mesh.grids)), strict=True):
        yield from _end(stiffness, grid, numbers)
    for number, station in enumerate(mesh.grids, 1):
        yield from _large("GRID", number, None, vehicle.length - station, 0.0, 0.0)
    for index, bars in groupby(enumerate(mesh.bars, 1), key=lambda bar: bar[1][0]):
        stage, front = vehicle.stages[index], vehicle.boundaries[index]
        ends = [(element, fore, aft) for element, (_, fore, aft) in bars]
        if stage.tables.keys() & VARYING:
            yield from _tapered(stage, ends, [station - front for station in mesh.grids], properties)
        else:
            yield from _uniform(stage, ends, next(properties))
    for joint, (forward, aft) in zip(vehicle.joints, mesh.faces, strict=True):
        if forward != aft:
            yield from _springs(joint, forward, aft, numbers)
    for mass in vehicle.point_masses:
        yield f"$ {_comment(mass.name)}"
        inertia = mass.rotary_inertia
        moments = (None, None, None, None, inertia, None, inertia, None, None, inertia) if inertia else ()
        yield from _large("CONM2", next(numbers), mesh.grid_at(mass.station), 0, mass.mass, *moments)


def _end(stiffness: tuple[float, float], grid: int, numbers: Iterator[int]) -> Iterator[str]:
    """What holds an end: constraints where it is rigid, springs to the ground where it is elastic."""
    springs = dict(zip(PLANE, stiffness, strict=True))
    if held := "".join(component for component, k in springs.items() if math.isinf(k)):
        yield f"SPC1,1,{held},{grid}"
    for component, k in springs.items():
        if 0 < k < math.inf:
            yield from _large("CELAS2", next(numbers), k, grid, component)


def _uniform(stage: Stage, ends: list[Ends], number: int) -> Iterator[str]:
    """Bars of one section."""
    stiffness, shear = mean(stage.bending_stiffness), mean(stage.shear_stiffness)
    factors: list[Field] = [*[None] * 9, 1.0, 1.0] if shear < math.inf else []
    mass = mean(stage.mass_per_length)
    yield from _large("PBAR", number, 1, _area(shear), stiffness, stiffness, None, mass, *factors)
    yield f"$ {_comment(stage.name)}"
    for element, fore, aft in ends:
        yield f"CBAR,{element},{number},{fore},{aft},0.,1.,0."


def _tapered(stage: Stage, ends: list[Ends], x: list[float], properties: Iterator[int]) -> Iterator[str]:
    """Bars that each have a section of their own at either end, x counting from the front of the stage."""
    for element, fore, aft in ends:
        number = next(properties)
        values = [between(getattr(stage, name), x[fore - 1], x[aft - 1]) for name in VARYING]
        sections: list[list[Field]] = [[_area(s), k, k, None, None, m] for m, k, s in zip(*values, strict=True)]
        no_points: list[Field] = [None] * 8
        factor = 0.0 if math.isinf(values[2][0]) else 1.0
        yield from _large("PBEAM", number, 1, *sections[0], *no_points, "NO", 1.0, *sections[1], factor, factor)
        if element == ends[0][0]:
            yield f"$ {_comment(stage.name)}"
        yield f"CBEAM,{element},{number},{fore},{aft},0.,1.,0."


def _area(shear_stiffness: float) -> float:
    """The area whose shear stiffness K G A is the stage's, K being 1 and G half of E; any where it is rigid."""
    return 2 * shear_stiffness if shear_stiffness < math.inf else 1.0


def _springs(joint: Joint, forward: int, aft: int, numbers: Iterator[int]) -> Iterator[str]:
    """A CBUSH for what gives or dissipates, an RBE2 for what does neither."""
    stiffness = joint.shear_stiffness, joint.rotational_stiffness
    rows: list[Field] = ["K", *_components(*(k if k < math.inf else None for k in stiffness))]
    if joint.shear_damping or joint.rotational_damping:
        rows += [None, "B", *_components(joint.shear_damping, joint.rotational_damping)]
    number = next(numbers)
    yield f"$ {_comment(joint.name)}"
    yield f"CBUSH,{number},{number},{forward},{aft},,,,0"
    yield from _large("PBUSH", number, *rows)
    if rigid := "".join(component for component, k in zip(PLANE, stiffness, strict=True) if math.isinf(k)):
        yield f"RBE2,{next(numbers)},{forward},{rigid},{aft}"


def _components(deflection: float | None, slope: float | None) -> list[Field]:
    """Six fields for the components, of which a vehicle has two."""
    return [None, deflection, None, None, None, slope]


def _large(name: str, *fields: Field) -> Iterator[str]:
    """A card in the large format, four fields to a line."""
    texts = ["" if field is None else field if isinstance(field, str) else _number(field) for field in fields]
    for start in range(0, len(texts), 4):
        first = f"{name}*" if start == 0 else "*"
        yield (f"{first:<8}" + "".join(f"{text:>{WIDTH}}" for text in texts[start : start + 4])).rstrip()


def _number(value: float) -> str:
    """A number in at most sixteen columns, with as many digits as fit.

    Examples
    --------
    >>> _number(7), _number(0.6), _number(-1 / 3), _number(2e-300 / 3)
    ('7', '.6', '-.33333333333333', '6.6666666667-301')
    """
    if isinstance(value, int):
        return str(value)
    for digits in range(17, 0, -1):
        text = f"{value:.{digits}g}"
        mantissa, _, exponent = text.partition("e")
        mantissa = mantissa if "." in mantissa else f"{mantissa}."
        sign = "-" if mantissa.startswith("-") else ""
        mantissa = sign + mantissa.lstrip("-").removeprefix("0") if mantissa.lstrip("-") != "0." else "0."
        text = mantissa + (f"{int(exponent):+d}" if exponent else "")
        if len(text) <= WIDTH:
            return text
    raise ModelError(f"the number {value} does not fit into {WIDTH} columns")


def _comment(name: str) -> str:
    return name if name and _is_title(name) else "-"


def _is_title(name: str) -> bool:
    """Whether a comment in the deck can carry the name."""
    return not name or (titled(name) == name.strip() == name and name.isprintable() and not name.startswith(KEPT))
