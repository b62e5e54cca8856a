"""A vehicle as Nastran bulk data, which reads back to the same vehicle and is ready for a free vibration analysis."""

import math
from collections.abc import Iterator

from beal.errors import ModelError
from beal.interop.cards import KEPT
from beal.interop.stick import SAME_PLACE, titled
from beal.vehicle.file import dumps_rest
from beal.vehicle.parts import Joint
from beal.vehicle.stations import mean
from beal.vehicle.vehicle import Vehicle

OUT_OF_PLANE = "1345"  # held everywhere: a vehicle bends in the plane xy
SUPPORTS = {"clamped": "26", "pinned": "2", "sliding": "6"}
SAID = {
    "stage": ["length", "mass_per_length", "bending_stiffness"],
    "joint": ["rotational_stiffness", "shear_stiffness"],
    "point_mass": ["station", "mass", "rotary_inertia"],
    "support": ["nose", "tail"],
}
WIDTH = 16  # of a large field


def nastran_text(vehicle: Vehicle, elements: int = 8) -> str:
    """Nastran bulk data of a vehicle: bars along x, which runs from the tail to the nose, bending in the plane xy.

    A bar has E = 1, so that its second moment of area is the bending stiffness, and all its mass is non-structural.
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
        If the number of elements is not positive.

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
    """Refuse what the cards that are written cannot say."""
    problems = [
        (f"stage[{n}].{name}", "is a table, which is not written to decks; keep it in TOML")
        for n, stage in enumerate(vehicle.stages)
        for name in stage.tables
    ]
    problems += [(f"tank[{n}]", "is not written to decks; keep it in TOML") for n in range(len(vehicle.tanks))]
    for name in ("nose", "tail"):
        if not isinstance(getattr(vehicle.support, name), str):
            problems.append((f"support.{name}", "is elastic, which is not written to decks; keep it in TOML"))
    if problems:
        raise ModelError(problems)


def _bulk(vehicle: Vehicle, elements: int) -> Iterator[str]:
    yield "PARAM,COUPMASS,1"
    yield "EIGRL,1,,,12"
    yield "MAT1,1,1.,,0."
    grids, bars, faces = _mesh(vehicle, elements)
    yield f"SPC1,1,{OUT_OF_PLANE},1,THRU,{len(grids)}"
    for end, grid in ((vehicle.support.nose, 1), (vehicle.support.tail, len(grids))):
        if isinstance(end, str) and end != "free":
            yield f"SPC1,1,{SUPPORTS[end]},{grid}"
    for number, station in enumerate(grids, 1):
        yield from _large("GRID", number, None, vehicle.length - station, 0.0, 0.0)
    for number, stage in enumerate(vehicle.stages, 1):
        stiffness, mass_per_length = mean(stage.bending_stiffness), mean(stage.mass_per_length)  # uniform, see _check
        yield from _large("PBAR", number, 1, 1.0, stiffness, stiffness, None, mass_per_length)
    before = 0
    for element, (number, fore, aft) in enumerate(bars, 1):
        if number != before:
            yield f"$ {_comment(vehicle.stages[number - 1].name)}"
            before = number
        yield f"CBAR,{element},{number},{fore},{aft},0.,1.,0."
    for index, joint in enumerate(vehicle.joints):
        yield from _springs(joint, len(bars) + 2 * index + 1, *faces[index])
    for index, mass in enumerate(vehicle.point_masses, len(bars) + 2 * len(vehicle.joints) + 1):
        grid = _grid_at(vehicle, mass.station, grids, faces)
        yield f"$ {_comment(mass.name)}"
        inertia = mass.rotary_inertia
        moments = (inertia, None, inertia, None, None, inertia)
        yield from _large("CONM2", index, grid, 0, mass.mass, None, None, None, None, *(moments if inertia else ()))


def _mesh(vehicle: Vehicle, elements: int) -> tuple[list[float], list[tuple[int, int, int]], list[tuple[int, int]]]:
    """Stations of the grids, bars as (stage, forward grid, aft grid), and both faces' grids of every joint."""
    grids = [0.0]
    bars: list[tuple[int, int, int]] = []
    faces: list[tuple[int, int]] = []
    near = 10 * SAME_PLACE * vehicle.length
    masses = sorted(mass.station for mass in vehicle.point_masses)
    for number, (start, end) in enumerate(zip(vehicle.boundaries, vehicle.boundaries[1:], strict=False), 1):
        if number > 1:
            faces.append((len(grids), len(grids) + (not _is_rigid(vehicle.joints[number - 2]))))
            if faces[-1][0] != faces[-1][1]:
                grids.append(start)
        wanted = [start + (end - start) * n / elements for n in range(1, elements)]
        wanted += [x for x in masses if start + near < x < end - near]
        for x in (*sorted(set(wanted)), end):
            bars.append((number, len(grids), len(grids) + 1))
            grids.append(x)
    return grids, bars, faces


def _is_rigid(joint: Joint) -> bool:
    return joint.rotational_stiffness == joint.shear_stiffness == math.inf


def _grid_at(vehicle: Vehicle, station: float, grids: list[float], faces: list[tuple[int, int]]) -> int:
    """The grid nearest to a station; of a joint's two the aft one, unless the station is clearly forward of it."""
    near = 10 * SAME_PLACE * vehicle.length
    for (forward, aft), x in zip(faces, vehicle.boundaries[1:], strict=False):
        if abs(station - x) <= near:
            return aft if station >= x - SAME_PLACE * vehicle.length / 2 else forward
    return min(range(len(grids)), key=lambda n: abs(grids[n] - station)) + 1


def _springs(joint: Joint, number: int, forward: int, aft: int) -> Iterator[str]:
    """A CBUSH for what gives, an RBE2 for what does not."""
    if forward == aft:
        return
    stiffness = {2: joint.shear_stiffness, 6: joint.rotational_stiffness}
    rigid = "".join(str(n) for n, k in stiffness.items() if math.isinf(k))
    soft = [stiffness[n] if n in (2, 6) and str(n) not in rigid else None for n in range(1, 7)]
    yield f"$ {_comment(joint.name)}"
    yield f"CBUSH,{number},{number},{forward},{aft},,,,0"
    yield from _large("PBUSH", number, "K", *soft)
    if rigid:
        yield f"RBE2,{number + 1},{forward},{rigid},{aft}"


def _large(name: str, *fields: float | str | None) -> Iterator[str]:
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
