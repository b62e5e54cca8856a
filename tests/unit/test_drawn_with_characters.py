"""Frequencies over thrust drawn with characters: what stands where."""

import math

import pytest

from beal.cli.canvas import Canvas
from beal.cli.drawn import HIGH, drawing
from beal.stability.critical import critical_events, critical_thrust
from beal.stability.curve import thrust_curve
from beal.vehicle import Stage, Vehicle, catalog

REACH = 1.3


@pytest.fixture(scope="module")
def pendulum():
    vehicle = catalog.ziegler()
    found = critical_thrust(vehicle)
    return vehicle, thrust_curve(vehicle, REACH * found.critical_thrust, 151), found


@pytest.fixture(scope="module")
def diverging():
    vehicle = catalog.tsto(0.6, 10.0, 5000.0)
    found = critical_thrust(vehicle)
    return vehicle, thrust_curve(vehicle, REACH * found.critical_thrust, 61, 1), found


def drawn(case, width=80, fine=True, **options):
    vehicle, curve, found = case
    return [line.plain for line in drawing(vehicle, curve, width, fine, found, **options)]


def inside(lines):
    """The rows of the drawing without the numbers beside it."""
    start = lines[HIGH + 1].index("└") + 1
    return [line[start:] for line in lines[1 : HIGH + 1]], len(lines[HIGH + 1]) - start


def test_the_mark_stands_at_the_critical_thrust_and_its_frequency(pendulum):
    rows, width = inside(drawn(pendulum))
    row, column = next((n, row.index("●")) for n, row in enumerate(rows) if "●" in row)
    assert (column + 0.5) / width == pytest.approx(1 / REACH, abs=1.0 / width)
    top = 1.05 * math.sqrt((7 + math.sqrt(41)) / 4)  # the second frequency falls from the first thrust on
    frequency = (1 / 2) ** (1 / 4)  # det M W^2 = det K where both meet: 2 W^2 = 1, whatever the thrust
    assert 1 - (row + 0.5) / HIGH == pytest.approx(frequency / top, abs=1.0 / HIGH)


def test_what_is_unstable_is_dotted(pendulum):
    rows, width = inside(drawn(pendulum))
    right = [row[round(width / REACH) + 2 :] for row in rows]
    left = [row[2 : round(width / REACH) - 4] for row in rows]
    assert all(sum(row[n : n + 1] > "⠀" for row in left) == 2 for n in range(20))  # two whole lines
    columns = width - round(width / REACH) - 2
    assert 0 < sum(letter > "⠀" for row in right for letter in row) < 0.8 * columns  # one in three has no dot
    assert "unstable" in drawn(pendulum)[-1]


def test_divergence_is_marked_on_the_axis(diverging):
    rows, _ = inside(drawn(diverging))
    assert [n for n, row in enumerate(rows) if "◆" in row] == [HIGH - 1]


@pytest.mark.parametrize("width", [20, 40, 61, 80, 100])
@pytest.mark.parametrize("fine", [True, False])
def test_no_line_is_wider_than_the_terminal(pendulum, width, fine):
    assert max(map(len, drawn(pendulum, width, fine))) <= max(width, 40)


def test_a_terminal_without_the_letters_gets_ascii(pendulum, diverging):
    for case in (pendulum, diverging):
        assert "\n".join(drawn(case, fine=False)).isascii()
    rows, _ = inside([line.replace("+", "└", 1) for line in drawn(pendulum, fine=False)])
    assert "*" in "".join(rows)
    assert rows[0].startswith("2") or rows[1].startswith("2")  # a line is made of the number of its mode


def test_every_event_within_the_drawing_is_marked():
    vehicle = catalog.beck()
    curve, events = thrust_curve(vehicle, 150.0, 61, 4), critical_events(vehicle, 150.0)
    text = "\n".join(line.plain for line in drawing(vehicle, curve, 80, True, critical_thrust(vehicle), events))
    marks = sum(curve.angular_frequency.max() > event.W**0.5 for event in events if event.kind == "flutter")
    assert text.count("●") == marks + 1  # and the one that says what it stands for
    assert marks >= 2


def test_si_is_told_in_hertz_and_prefixed_newtons():
    stage = Stage(length=20.0, mass_per_length=500.0, bending_stiffness=2e8)
    vehicle = Vehicle(stages=[stage])
    lines = [line.plain for line in drawing(vehicle, thrust_curve(vehicle, 5e7, 3, 1), 80)]
    assert lines[0] == "frequency [Hz]"
    assert lines[HIGH + 2].split() == ["0", "10", "20", "30", "40", "50"]
    assert lines[HIGH + 3].split() == ["thrust", "[MN]"]


def test_a_letter_stands_where_it_is_put():
    canvas = Canvas(3, 3, fine=True)
    canvas.put(0.0, 0.0, "a")
    canvas.put(1.0, 1.0, "b")
    canvas.put(1.0, 1.0, "c", over=False)
    assert [row.plain for row in canvas.rows()] == ["  b", "", "a"]
