"""The half-section: directions of contact lines, and labels that do not overlap."""

from __future__ import annotations

import itertools
import math
import types
from dataclasses import replace

import numpy as np
import pytest

from bearings import FourPointBallBearing
from rotordyn.figures.holders import draw_holders
from rotordyn.figures.labels import spread
from rotordyn.figures.machine import _draw_section, _marks, machine_figure
from rotordyn.figures.sketch import Sketch
from rotordyn.figures.static_loads import draw_load
from rotordyn.figures.style import BLUE, GREEN, SKY
from rotordyn.figures.symbols import (
    RING,
    SLEEVE,
    bore_of,
    contact_lines,
    draw_bearing,
    draw_drawbar,
    draw_sleeve,
)
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.scene.loads import PointLoad
from tests.oracles.rotors import STEEL, STEPPED, support
from tests.rotordyn.figures import samples


def _seat(thrust):
    return BearingSeat("a", samples.ball_bearing(0.09, 25), 0.1, thrust)


@pytest.mark.parametrize("thrust", [1, -1])
def test_contact_line_meets_the_axis_behind_the_thrust(thrust):
    (foot, on_axis), (tip, outside) = contact_lines(_seat(thrust))[0]
    assert on_axis == 0.0
    assert foot == pytest.approx(0.1 - thrust * 0.045 * math.tan(math.radians(25.0)))
    assert outside > 0.045
    assert (tip - 0.1) * thrust > 0.0


@pytest.mark.parametrize("thrust", [1, -1])
def test_contact_line_passes_the_ball_centre(thrust):
    (x0, r0), (x1, r1) = contact_lines(_seat(thrust))[0]
    assert np.interp(0.045, [r0, r1], [x0, x1]) == pytest.approx(0.1)


def test_a_bearing_that_takes_thrust_both_ways_has_a_line_for_each():
    bearing = FourPointBallBearing(0.0095, 0.09, 20, contact_angle=math.radians(35.0))
    first, second = contact_lines(BearingSeat("a", bearing, 0.1))
    for x0, x1 in zip(first, second, strict=True):
        assert x0[0] - 0.1 == pytest.approx(0.1 - x1[0])
        assert x0[1] == pytest.approx(x1[1])
    assert first[0][0] < 0.1 < first[1][0]


def test_an_axial_contact_line_is_level_and_ends_before_the_axis():
    class Thrust:
        contact_lines = (math.pi / 2.0,)
        pitch_diameter, ball_diameter = 0.09, 0.0095

    (line,) = contact_lines(types.SimpleNamespace(bearing=Thrust(), x=0.1, thrust=1))
    (x0, r0), (x1, r1) = line
    assert r0 == pytest.approx(0.045)
    assert r1 == pytest.approx(0.045)
    assert x0 < 0.1 - 0.00475 < 0.1 + 0.00475 < x1


def test_front_plus_rear_minus_is_an_o_arrangement():
    front, rear = contact_lines(_seat(1))[0][0][0], contact_lines(_seat(-1))[0][0][0]
    assert front < 0.1 < rear


def test_labels_do_not_overlap_each_other():
    figure = machine_figure(samples.spindle())
    renderer = figure.canvas.get_renderer()
    texts = [*figure.axes[0].texts, *figure.texts]
    boxes = [(t.get_text(), t.get_window_extent(renderer)) for t in texts]
    legend = figure.axes[0].get_legend()
    boxes.append(("legend", legend.get_window_extent(renderer)))
    clashes = [(a, b) for (a, p), (b, q) in itertools.combinations(boxes, 2) if p.overlaps(q)]
    assert clashes == []
    inside = figure.bbox
    assert all(inside.x0 <= b.x0 and b.x1 <= inside.x1 for _, b in boxes)


def test_captions_of_sleeves_side_by_side_are_apart():
    """By 3 mm at least, as wide as they are."""
    plain = samples.spindle()
    springs = (("wash", "d", 1500.0, math.inf), ("cup", "e", 350.0, 1e6))
    sleeves = tuple(Sleeve(name, (on,), Spring(f, k)) for name, on, f, k in springs)
    figure = machine_figure(replace(plain, sleeves=sleeves))
    boxes = {t.get_text(): t.get_window_extent() for t in figure.axes[0].texts}
    first, second = boxes["wash: 1500 N, rigid"], boxes["cup: 350 N, 1 N/µm"]
    assert second.x0 - first.x1 > 3.0 * figure.dpi / 25.4


def test_leaders_begin_where_supports_and_discs_end():
    stiffness = {("y", "y"): 1e8, ("z", "z"): 1e8}
    box = RigidHousing("box", ("low",), 0.1, 9.0, stiffness)
    held = replace(STEPPED, supports=(support("low", 0.1, (1e8, 1e8)),))
    held = replace(held, discs=(Disc("wheel", 0.16, 0.18, 0.1, 0.02, STEEL),))
    for housings in ((), (box,)):
        machine = replace(held, housings=housings)
        sketch = Sketch()
        draw_holders(sketch, machine)
        strokes = [*sketch.lines.values(), *sketch.polygons.values()]
        lowest = min(y for each in strokes for points in each for _, y in points)
        starts = {words: y for _, y, words in _marks(Sketch(), machine, 1.0)}
        assert starts["low"] == pytest.approx(lowest)
        assert starts["wheel"] == pytest.approx(-90.0)


def test_everything_is_named():
    words = " ".join(t.get_text() for t in machine_figure(samples.spindle()).axes[0].texts)
    for name in ("a", "e", "Oc2", "nose", "drawbar 2\n0.2 kg", "release unit\n2.19 kg"):
        assert name in words
    assert "front sleeve: 574 N, 6.2 N/µm, stop after 52.2 µm" in words


@pytest.mark.parametrize("guides", [(), (0.1, 0.2), "everywhere"])
def test_drawbar_is_drawn_in_the_bore_and_named(guides):
    plain = samples.spindle()
    with_bar = replace(plain, drawbar=Drawbar(18e3, 0.02, 0.4, guides))
    words = [t.get_text() for t in machine_figure(with_bar).axes[0].texts]
    assert "drawbar\n18 kN" in words
    assert "drawbar\n18 kN" not in [t.get_text() for t in machine_figure(plain).axes[0].texts]
    sketch = Sketch()
    draw_drawbar(sketch, with_bar.drawbar, plain.shaft)
    (shapes,) = sketch.polygons.values()
    corners = np.array([corner for shape in shapes for corner in shape])
    assert corners[:, 0].min() == pytest.approx(20.0)
    assert corners[:, 0].max() == pytest.approx(400.0)
    assert corners[:, 1].min() == 0.0
    bores = [s.inner_diameter for s in plain.shaft.sections if s.inner_diameter]
    assert corners[:, 1].max() <= max(bores) * 500.0
    assert len(shapes) == 3 + (0 if guides == "everywhere" else len(guides))


def test_drawn_to_scale():
    axes = machine_figure(samples.spindle()).axes[0]
    assert axes.get_aspect() == 1.0
    box = axes.get_window_extent()
    across = box.width / np.ptp(axes.get_xlim())
    assert box.height / np.ptp(axes.get_ylim()) == pytest.approx(across, rel=1e-2)


@pytest.mark.parametrize("seed", range(5))
def test_spread_keeps_order_and_distance(seed):
    rng = np.random.default_rng(seed)
    wanted, sizes = rng.uniform(0.0, 10.0, 8), rng.uniform(0.2, 1.0, 8)
    placed = spread(wanted, sizes, 0.0, 10.0)
    order = np.argsort(wanted)
    gaps = np.diff(placed[order]) - (sizes[order][1:] + sizes[order][:-1]) / 2.0
    assert gaps.min() > -1e-9
    assert (placed - sizes / 2).min() > -1e-9
    assert (placed + sizes / 2).max() < 10.0 + 1e-9


def test_spread_leaves_what_has_room():
    np.testing.assert_allclose(spread([5.0, 1.0], [1.0, 1.0], 0.0, 10.0), [5.0, 1.0])


def test_spread_of_too_many_stays_inside():
    placed = spread([5.0] * 6, [3.0] * 6, 0.0, 10.0)
    assert placed.min() >= 0.0
    assert placed.max() <= 10.0
    assert np.diff(np.sort(placed)).min() > 0.0


def test_a_cone_is_drawn_whole_its_joints_and_housing_named() -> None:
    steel = STEPPED.shaft.sections[0].material
    nose = Section(0.1, 0.03, 0.0, steel, "nose", 0.06, 0.01)
    shaft = Shaft(0.0, (nose, *STEPPED.shaft.sections))
    supports = (support("left", 0.12, (1e7, 1e7)), support("right", 0.3, (1e7, 1e7)))
    box = RigidHousing("box", ("left", "right"), 0.2, 9.0, {("y", "y"): 1e8, ("z", "z"): 1e8})
    machine = replace(
        STEPPED,
        shaft=shaft,
        masses=(),
        supports=supports,
        housings=(box,),
        joints=(Joint("flange", 0.2, tilt=1e5),),
    )
    sketch = Sketch()
    _draw_section(sketch, nose, 0.0, 100.0, "#B9C4CE", 0)
    wall, *_ = sketch.polygons["#B9C4CE", "#333333", 0.7, 2]
    assert wall == [(0.0, 0.0), (100.0, 5.0), (100.0, 30.0), (0.0, 15.0)]
    words = {text.get_text() for text in machine_figure(machine).axes[0].texts}
    assert {"flange", "box", "left", "right"} <= words


@pytest.mark.parametrize(("x", "named"), [(0.16, 160.0), (0.0, 120.0)])
def test_a_rigid_housing_is_named_at_its_centre_within_its_block(x, named):
    supports = (support("left", 0.12, (1e7, 1e7)), support("right", 0.25, (1e7, 1e7)))
    box = RigidHousing("box", ("left", "right"), x, 9.0, {("y", "y"): 1e8})
    machine = replace(STEPPED, masses=(), supports=supports, housings=(box,))
    (at,) = (x for x, _, words in _marks(Sketch(), machine, 1.0) if words == "box")
    assert at == pytest.approx(named)


def _words(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def test_a_rigid_preload_is_said_and_has_no_spring():
    plain = samples.spindle()
    locked = replace(plain, sleeves=(Sleeve("set", ("d", "e"), Spring(528.0)),))
    assert "set: 528 N, rigid" in _words(machine_figure(locked))
    for rigid in (False, True):
        sketch = Sketch()
        draw_sleeve(sketch, 0.0, 20.0, 50.0, 1, stop=False, rigid=rigid, grounded=True)
        assert any(colour == BLUE for colour, *_ in sketch.lines) != rigid


def test_a_ring_is_drawn_at_the_bore_of_its_model_where_the_shaft_does_not_fit():
    seat = replace(_seat(1), sizes={"bore_diameter": 0.07})
    assert bore_of(seat, 0.0352) == pytest.approx(35.2)
    assert bore_of(seat, 0.030) == pytest.approx(35.0)
    assert bore_of(seat, 0.040) == pytest.approx(35.0)
    assert bore_of(_seat(1), 0.030) == pytest.approx(30.0)
    sketch = Sketch()
    draw_bearing(sketch, seat, 0.016, 0.030)
    radii = [
        r for look, rings in sketch.polygons.items() if look[0] == RING for p in rings for _, r in p
    ]
    assert min(abs(r) for r in radii) == pytest.approx(35.0)


def test_a_housing_under_bearings_is_a_block_on_springs_and_named():
    plain = samples.spindle()
    stiffness = {("y", "y"): 1e8, ("z", "z"): 1e8}
    box = RigidHousing("quill", ("a", "b", "d"), 0.2, 9.0, stiffness)
    housed = replace(plain, housings=(box,))
    assert "quill: housing, 9 kg" in _words(machine_figure(housed))
    sketch = Sketch()
    draw_holders(sketch, housed)
    blocks = [p for look, shapes in sketch.polygons.items() if look[0] == SLEEVE for p in shapes]
    widest = max(blocks, key=lambda p: p[1][0] - p[0][0])
    assert widest[0][0] < 28.6 < 380.9 < widest[1][0]
    assert widest[0][1] >= plain.shaft.largest_diameter * 500.0
    assert any(colour == BLUE for colour, *_ in sketch.lines)
    sketch = Sketch()
    draw_holders(sketch, plain)
    assert not sketch.polygons


def test_a_squeeze_film_is_drawn_about_its_journal_and_named():
    film = SqueezeFilmDamper("film", 0.2, 0.02, 0.03, 0.06, 1e-4)
    machine = replace(samples.spindle(), dampers=(film,))
    figure = machine_figure(machine)
    assert "film" in _words(figure)
    assert "squeeze film" in [t.get_text() for t in figure.axes[0].get_legend().get_texts()]
    sketch = Sketch()
    draw_holders(sketch, machine)
    (shapes,) = (shapes for look, shapes in sketch.polygons.items() if look[0] == SKY)
    assert sorted({abs(r) for shape in shapes for _, r in shape})[0] == pytest.approx(60.0)


@pytest.mark.parametrize("Fy", [500.0, -500.0])
def test_a_static_load_is_an_arrow_the_way_it_acts_and_said(Fy):
    machine, load = samples.spindle(), PointLoad("nose", "cut", Fx=100.0, Fy=Fy, Mx=5.0)
    assert f"cut\nFx 100 N\nFy {Fy:g} N\nMx 5 N·m" in _words(machine_figure(machine, (load,)))
    sketch = Sketch()
    draw_load(sketch, machine, replace(load, Fx=0.0, Mx=0.0), 10.0)
    (((tail, neck),),) = sketch.lines.values()
    assert (neck[1] - tail[1]) * Fy > 0.0
    assert tail[1] * Fy < 0.0
    assert {colour for colour, *_ in sketch.lines} == {GREEN}


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_moment_is_an_arrow_by_the_right_hand(sense):
    """Two heads along its axis x or y; about z, towards the viewer, anticlockwise if positive."""
    machine = samples.spindle()

    def drawn(**moment):
        sketch = Sketch()
        draw_load(sketch, machine, PointLoad("nose", **moment), 10.0)
        ((line,),) = sketch.lines.values()
        (heads,) = sketch.polygons.values()
        return np.array(line), np.array(heads)

    for axis, key in enumerate(("Mx", "My")):
        (tail, neck), heads = drawn(**{key: 5.0 * sense})
        assert (neck - tail)[axis] * sense > 0.0
        assert len(heads) == 2
        assert ((heads[:, 0] - heads[:, 1:].mean(axis=1))[:, axis] * sense > 0.0).all()
    line, heads = drawn(Mz=5.0 * sense)
    x = machine.place("nose").x * 1e3
    from_centre = line - [x, 0.0]
    turn = from_centre[:-1, 0] * from_centre[1:, 1] - from_centre[:-1, 1] * from_centre[1:, 0]
    assert (turn * sense > 0.0).all()
    assert len(heads) == 1


def test_a_legend_with_long_names_stays_inside():
    steel = samples.spindle().shaft.sections[0].material
    names = [f"{word} with a long name of its own" for word in ("carbide", "steel", "bronze")]
    sections = samples.spindle().shaft.sections
    longer = tuple(
        replace(s, material=replace(steel, name=names[k % 3])) for k, s in enumerate(sections)
    )
    machine = replace(samples.spindle(), shaft=Shaft(-0.0918, longer))
    figure = machine_figure(machine)
    renderer = figure.canvas.get_renderer()
    axes = figure.axes[0]
    legends = [a for a in axes.get_children() if type(a).__name__ == "Legend"]
    boxes = [legend.get_window_extent(renderer) for legend in legends]
    assert len(boxes) > 1
    assert all(box.x0 >= figure.bbox.x0 and box.x1 <= figure.bbox.x1 for box in boxes)
    boxes += [text.get_window_extent(renderer) for text in axes.texts]
    assert not any(p.overlaps(q) for p, q in itertools.combinations(boxes, 2))
