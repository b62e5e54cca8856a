"""The drawn vehicle, straight and bent: what is where, and that no words meet."""

import itertools
import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Polygon

from beal import plot
from beal.discretisation import discretise
from beal.plot.body import flexible, gap, sections
from beal.plot.captions import Caption, arranged, width
from beal.plot.shapes import _nodes
from beal.plot.style import fitted
from beal.stability.spectrum import spectrum
from beal.vehicle import (
    AxialLoad,
    DistributedThrust,
    ElasticEnd,
    Force,
    Joint,
    PointMass,
    Sensor,
    Stage,
    Support,
    Thrust,
    Vehicle,
    catalog,
)

COLUMN = 3.35  # inches, 85 mm
SINE = {"kind": "sine", "amplitude": 1.0, "angular_frequency": 1.0}


@pytest.fixture
def ax():
    return Figure(figsize=(5.0, 20.0)).subplots()


def beam(length=1.0, **given):
    return Stage(length=length, **({"mass_per_length": 1.0, "bending_stiffness": 1.0} | given))


def one(**parts):
    """A vehicle of one stage."""
    return Vehicle(units="nondimensional", stages=[beam()], **parts)


def crowd(stages):
    """Many parts close to each other, with names of all lengths."""
    places = np.linspace(0.0, 1.0, 3 * stages)
    return Vehicle(
        units="nondimensional",
        stages=[beam(1 / stages, name=f"stage number {n}") for n in range(stages)],
        joints=[
            Joint(name=f"clamp band {n}", rotational_stiffness=10.0, shear_stiffness=9.0) for n in range(1, stages)
        ],
        point_masses=[PointMass(name=f"lump {n}" * (1 + n % 3), station=x, mass=0.01) for n, x in enumerate(places)],
        sensors=[Sensor(name=f"sensor {n}", station=x) for n, x in enumerate(places)],
        forces=[Force(station=0.99, signal=SINE)],
        axial_loads=[AxialLoad(name="drag", station=0.0, force=-1.0)],
    )


def words(ax):
    return {text.get_text() for text in ax.texts}


def of(ax, kind):
    return [patch for patch in (*ax.patches, *ax.artists) if isinstance(patch, kind)]


def arrows(ax):
    """Tail and tip of every arrow."""
    return [np.array(patch._posA_posB) for patch in of(ax, FancyArrowPatch)]


def bodies(ax):
    return [patch.get_xy() for patch in of(ax, Polygon) if len(patch.get_xy()) > 4]


def test_stages_are_drawn_to_scale_along_the_axis(ax):
    stages = [beam(2.0), beam(3.0)]
    plot.vehicle(Vehicle(stages=stages, joints=[Joint()]), ax)
    assert [(outline[:, 0].min(), outline[:, 0].max()) for outline in bodies(ax)] == [(0.0, 2.0), (2.0, 5.0)]
    assert ax.get_aspect() == 1.0
    assert ax.get_xlabel() == "station x (m)"


def test_the_width_goes_with_the_fourth_root_of_the_stiffness(ax):
    stages = [beam(bending_stiffness=1.0), beam(bending_stiffness=16.0)]
    plot.vehicle(Vehicle(stages=stages, joints=[Joint()]), ax)
    heights = [np.ptp(outline[:, 1]) for outline in bodies(ax)]
    assert heights[1] / heights[0] == pytest.approx(2.0)


def test_a_step_and_a_taper_of_the_stiffness_show():
    table = {"x": [0.0, 0.5, 0.5, 1.0], "value": [1.0, 1.0, 16.0, 81.0]}
    (body,) = sections(Vehicle(stages=[beam(bending_stiffness=table)]), 0.03)
    at_step = body.half_width[body.x == 0.5]
    assert at_step == pytest.approx([0.01, 0.02])
    assert body.half_width[-1] == pytest.approx(0.03)
    between = np.interp(0.75, body.x, body.half_width)
    assert between == pytest.approx(0.03 * ((16 + 81) / 2 / 81) ** 0.25, rel=1e-4)


def test_a_rigid_stage_is_as_wide_as_the_stiffest_of_the_others():
    rigid = beam().model_construct(**dict(beam()) | {"bending_stiffness": math.inf})
    flexible_beam, widest, drawn = sections(
        Vehicle(stages=[beam(), beam(bending_stiffness=16.0), rigid], joints=[Joint()] * 2)
    )
    assert drawn.half_width.max() == widest.half_width.max() == 2 * flexible_beam.half_width.max()


@pytest.mark.parametrize(
    ("joint", "label", "circles"),
    [
        (Joint(), None, 0),
        (Joint(rotational_stiffness=1.0), "$k_r$", 1),
        (Joint(shear_stiffness=1.0), "$k_s$", 0),
        (Joint(rotational_stiffness=1.0, shear_stiffness=1.0, name="clamp"), "clamp ($k_r$, $k_s$)", 1),
        (Joint(name="weld"), "weld", 0),
    ],
)
def test_a_joint_shows_which_springs_it_has(ax, joint, label, circles):
    vehicle = Vehicle(stages=[beam(), beam()], joints=[joint])
    plot.vehicle(vehicle, ax)
    assert words(ax) == {"$P$, follower", *filter(None, [label])}
    assert len(of(ax, Circle)) == circles
    fore, aft = bodies(ax)
    assert aft[:, 0].min() - fore[:, 0].max() == pytest.approx(2 * gap(vehicle, 0))
    assert (gap(vehicle, 0) > 0) == flexible(joint)


def test_the_area_of_a_mass_goes_with_the_mass(ax):
    plot.vehicle(one(point_masses=[PointMass(station=0.2, mass=0.1), PointMass(station=0.8, mass=0.4)]), ax)
    small, large = of(ax, Circle)
    assert large.radius / small.radius == pytest.approx(2.0)
    assert (small.center, large.center) == ((0.2, 0.0), (0.8, 0.0))


def test_a_mass_at_a_joint_is_drawn_on_the_aft_face(ax):
    masses = [PointMass(station=1.0, mass=0.1)]
    vehicle = Vehicle(stages=[beam(), beam()], joints=[Joint(shear_stiffness=1.0)], point_masses=masses)
    plot.vehicle(vehicle, ax)
    assert of(ax, Circle)[0].center[0] == pytest.approx(1.0 + gap(vehicle, 0))


@pytest.mark.parametrize(
    ("thrust", "label"),
    [
        (Thrust(), "$P$, follower"),
        (Thrust(tangency=0.0), "$P$, fixed in space"),
        (Thrust(tangency=0.5), r"$P$, $\eta$ = 0.5"),
        (Thrust(line="fixed"), "$P$, fixed line"),
        (Thrust(scale=0.25), "0.25 $P$, follower"),
    ],
)
def test_the_thrust_points_to_the_nose_and_says_how_it_acts(ax, thrust, label):
    plot.vehicle(one(thrust=thrust), ax)
    ((tail, tip),) = arrows(ax)
    assert tip.tolist() == [1.0, 0.0]
    assert tail[0] > tip[0]
    assert words(ax) == {label}


def test_a_thrust_inside_the_vehicle_is_drawn_there(ax):
    plot.vehicle(one(thrust=Thrust(station=0.4)), ax)
    assert arrows(ax)[0][1].tolist() == [0.4, 0.0]


def test_a_distributed_thrust_is_as_long_as_the_load_there(ax):
    load = DistributedThrust(value={"x": [0.0, 1.0], "value": [-1.0, 1.0]})
    plot.vehicle(one(thrust=Thrust(scale=0.0), distributed_thrusts=[load]), ax)
    drawn = np.array(arrows(ax))
    forward = drawn[:, 0, 0] - drawn[:, 1, 0]  # towards the nose
    middle = drawn[:, :, 0].mean(axis=1)
    assert (np.sign(forward) == np.sign(middle - 0.5)).all()
    assert np.corrcoef(forward, middle)[0, 1] > 0.97
    assert words(ax) == {"distributed thrust"}


def test_loads_act_where_and_as_they_are_given(ax):
    loads = [AxialLoad(name="drag", station=0.0, force=-2.0), AxialLoad(station=0.7, force=1.0)]
    forces = [Force(name="gust", station=0.9, signal=SINE)]
    plot.vehicle(one(axial_loads=loads, forces=forces, gravity=9.8), ax)
    _, drag, push, gravity, gust = arrows(ax)
    (from_drag, _), (from_push, _) = drag[0], push[0]
    assert (drag[1].tolist(), push[1].tolist()) == ([0.0, 0.0], [0.7, 0.0])
    assert from_drag < 0.0 < 0.7 < from_push
    assert gravity[1, 0] > gravity[0, 0] == pytest.approx(0.5)
    assert gust[:, 0].tolist() == [0.9, 0.9]
    assert gust[1, 1] > gust[0, 1]
    assert words(ax) == {"$P$, follower", "drag", "axial load", "$g$", "gust"}


def lines_beyond(ax, station):
    """Lines drawn beyond an end of the vehicle or below it: those of its support."""
    return [line for line in ax.lines if (line.get_xdata() < station).any() or min(line.get_ydata()) < -0.04]


@pytest.mark.parametrize(
    ("end", "triangles", "circles", "drawn"),
    [
        ("free", 0, 0, False),
        ("clamped", 0, 0, True),
        ("pinned", 1, 0, True),
        ("sliding", 0, 2, True),
        (ElasticEnd(translation=1.0), 0, 0, True),
        (ElasticEnd(rotation=1.0), 0, 0, True),
        (ElasticEnd(translation=math.inf, rotation=1.0), 1, 0, True),
    ],
)
def test_a_support_is_drawn_at_its_end(ax, end, triangles, circles, drawn):
    plot.vehicle(one(support=Support(nose=end)), ax)
    assert len([p for p in of(ax, Polygon) if len(p.get_xy()) == 4]) == triangles
    assert len(of(ax, Circle)) == circles
    assert bool(lines_beyond(ax, 0.0)) == drawn


def test_the_thrust_stays_clear_of_a_wall_at_the_tail(ax):
    plot.vehicle(one(support=Support(tail="sliding")), ax)
    assert arrows(ax)[0][1][0] > max(line.get_xdata().max() for line in ax.lines[:8])


def test_a_foundation_is_drawn_under_the_stage_that_stands_on_it(ax):
    stages = [beam(), beam(foundation_stiffness=2.0)]
    plot.vehicle(Vehicle(stages=stages, joints=[Joint()]), ax)
    feet = [line.get_xdata().mean() for line in ax.lines if min(line.get_ydata()) < -0.08]
    assert len(feet) > 20
    assert min(feet) > 1.0


def overlapping(ax):
    """Pairs of words that meet on the drawn figure."""
    figure = ax.figure
    figure.draw_without_rendering()
    boxes = [(text.get_text(), text.get_window_extent().shrunk(0.99, 0.9)) for text in ax.texts]
    return [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if one.overlaps(other)]


@pytest.mark.parametrize("stages", range(1, 7))
@pytest.mark.parametrize("size", [(COLUMN, COLUMN), (6.4, 4.8), (10.0, 2.5)])
def test_no_words_meet(stages, size):
    with plot.style():
        ax = plot.vehicle(crowd(stages), Figure(figsize=size, layout="constrained").subplots())
        assert overlapping(ax) == []


def test_words_stay_beside_the_drawing():
    with plot.style():
        figure = Figure(figsize=(COLUMN, 10.0), layout="constrained")
        ax = plot.vehicle(crowd(6), figure.subplots())
        fitted(ax)
        figure.draw_without_rendering()
        left, right = ax.bbox.padded(1.0).intervalx
        reach = [(box.x0, box.x1) for box in (text.get_window_extent() for text in ax.texts)]
    assert left <= min(reach)[0]
    assert max(end for _, end in reach) <= right


def test_long_words_are_shortened():
    assert (
        Caption(0.0, 0.0, "payload adapter ring with its 24 separation bolts").words
        == "payload adapter ring with its …"
    )


def test_captions_keep_their_line_until_it_is_full():
    wide = width("payload") / 100.0
    placed = arranged([Caption(x, 0.0, "payload") for x in (0.5, 0.5, 0.5 + 2 * wide, 0.5)], 0.0, 1.0 + 3 * wide, 100.0)
    assert [one.line for one in placed] == [0, 1, 0, 2]


def shapes_of(vehicle, thrust=0.0, count=3):
    operators = discretise(vehicle)
    return spectrum(operators, thrust, count), operators


def test_the_bent_body_follows_the_mode(ax):
    found, operators = shapes_of(catalog.beck(), count=1)
    plot.mode_shapes(found, operators, ax)
    (outline,) = bodies(ax)
    n = (len(outline) - 1) // 2
    middle = (outline[:n] + outline[n : 2 * n][::-1]) / 2
    exact = (operators.shape(middle[:, 0]) @ found.shapes[:, 0]).real
    exact *= middle[-1, 1] / exact[-1]
    np.testing.assert_allclose(middle[:, 1], exact, atol=1e-9)


def test_cross_sections_stay_normal_to_the_axis(ax):
    plot.mode_shapes(*shapes_of(catalog.beal(), count=1), ax)
    (outline,) = bodies(ax)
    n = (len(outline) - 1) // 2
    across = outline[:n] - outline[n : 2 * n][::-1]
    along = np.gradient((outline[:n] + outline[n : 2 * n][::-1]) / 2, axis=0)
    cosine = (across * along).sum(axis=1) / np.hypot(*across.T) / np.hypot(*along.T)
    assert abs(cosine[2:-2]).max() < 5e-3
    np.testing.assert_allclose(np.hypot(*across.T), np.hypot(*across[0]))


def test_both_faces_of_a_joint_show_the_jump_of_the_mode(ax):
    found, operators = shapes_of(catalog.tsto(0.6, 100.0, 300.0), count=2)
    plot.mode_shapes(found, operators, ax)
    for number, q in enumerate(found.shapes.T):
        faces = [line for line in ax.lines if line.get_marker() == "o" and list(line.get_xdata()) == [0.6, 0.6]]
        drawn = np.diff(faces[number].get_ydata()).item()
        x = np.linspace(0.0, 1.0, 401)
        jump = (operators.shape(0.6, 0, "aft") - operators.shape(0.6, 0, "forward"))[0] @ q
        axis = [line for line in ax.lines if len(line.get_xdata()) == 161][2 * number : 2 * number + 2]
        heights = np.concatenate([line.get_ydata() for line in axis]) + 0.22 * number
        scale = abs(heights).max() / abs(operators.shape(x) @ q).max()
        assert abs(drawn) == pytest.approx(abs(jump) * scale, rel=1e-3)
        assert abs(drawn) > 0.005


def nodes(ax):
    return [line.get_xdata() for line in ax.lines if line.get_markerfacecolor() == "white"]


def test_nodes_are_where_the_mode_stands_still(ax):
    # Free-free beam: 0.2241, 0.7759; 0.1321, 0.5, 0.8679. Clamped-free, second mode: 0.7834 (Blevins, 1979).
    plot.mode_shapes(*shapes_of(catalog.beal(), count=2), ax)
    assert nodes(ax)[0] == pytest.approx([0.2241, 0.7759], abs=2e-4)
    assert nodes(ax)[1] == pytest.approx([0.1321, 0.5, 0.8679], abs=2e-4)


def test_a_clamped_end_is_no_node(ax):
    plot.mode_shapes(*shapes_of(catalog.beck(), count=2), ax)
    assert [len(x) for x in nodes(ax)] == [0, 1]
    assert nodes(ax)[1] == pytest.approx([0.7834], abs=2e-4)


def test_the_rounding_at_a_clamped_end_is_no_node():
    assert _nodes(np.array([0.0, 0.5, 1.0]), np.array([-1e-17, 0.5, 1.0])).tolist() == []


def test_a_mode_in_flutter_is_drawn_at_phases_within_its_envelope(ax):
    found, operators = shapes_of(catalog.tsto(0.6, 5000.0, 5000.0), thrust=120.0, count=1)
    plot.mode_shapes(found, operators, ax)
    assert nodes(ax) == []
    curves = np.array(
        [line.get_ydata() for line in ax.lines if len(line.get_xdata()) == 161 and line.get_xdata()[0] == 0]
    )
    envelope = abs(curves).max(axis=0)
    x = np.linspace(0.0, 0.6, 161)
    exact = abs(operators.shape(x, side="forward") @ found.shapes[:, 0])
    np.testing.assert_allclose(envelope / envelope[0], exact / exact[0], rtol=1e-9)
    assert len(curves) == 1 + 7 + 2


@pytest.mark.parametrize(
    ("thrust", "label"),
    [(0.0, "mode 1\n$\\omega$ = 12.40"), (40.0, "mode 1\ndiverges, 18.7")],
)
def test_a_mode_says_how_it_moves(ax, thrust, label):
    plot.mode_shapes(*shapes_of(catalog.tsto(0.6, 1.0, 1e4), thrust, 1), ax)
    assert words(ax) == {label}


def test_a_mode_in_si_units_is_told_in_hertz(ax):
    found, operators = shapes_of(Vehicle(stages=[beam(length=10.0, bending_stiffness=1e4)]), count=1)
    plot.mode_shapes(found, operators, ax)
    omega = 4.730040745**2 * math.sqrt(1e4 / 10.0**4)
    assert words(ax) == {f"mode 1\n{omega / (2 * math.pi):.4g} Hz"}
    assert ax.get_xlabel() == "station x (m)"


def test_modes_stand_one_below_the_other(ax):
    plot.mode_shapes(*shapes_of(catalog.beal(), count=4), ax)
    levels = [text.get_position()[1] for text in ax.texts]
    assert levels == sorted(levels, reverse=True)
    for outline, level in zip(bodies(ax), levels, strict=True):
        assert abs(outline[:, 1] - level).max() < 0.11


def test_a_figure_of_its_own_has_the_height_of_the_drawing():
    from matplotlib import pyplot

    ax = plot.vehicle(catalog.beck())
    wide, high = ax.figure.get_size_inches()
    pyplot.close(ax.figure)
    assert high < 0.5 * wide
