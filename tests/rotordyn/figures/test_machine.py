"""The half-section: directions of contact lines, and labels that do not overlap."""

from __future__ import annotations

import itertools
import math
import types
from dataclasses import replace

import numpy as np
import pytest

from bearings import FourPointBallBearing
from rotordyn.figures.labels import spread
from rotordyn.figures.machine import _draw_section, machine_figure
from rotordyn.figures.sketch import Sketch
from rotordyn.figures.symbols import contact_lines, draw_drawbar
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.joint import Joint
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from tests.oracles.rotors import STEPPED, support
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
