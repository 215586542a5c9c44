"""The figure of stability lobes: pockets by number, listed below; speeds from the first one."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from rotordyn.analyses.stability_lobes.figures.lobes import lobes_figure

POCKETS = (30000.0, 40000.0, 59500.0)


def _result(count):
    rpm = np.linspace(20000.0, 60000.0, count)
    depth = 2e-3 + 1e-3 * np.cos(rpm / 3000.0)
    speed, near = np.array(POCKETS) * math.pi / 30.0, 300.0 * math.pi / 30.0
    return SimpleNamespace(
        cutting_speed=rpm * math.pi / 30.0, depth=depth, at_rest=0.5 * depth,
        measured=np.full(count, np.nan), even=np.full(count, np.nan), least=depth, most=depth,
        loss=("",) * count, motor="",
        removal=depth * rpm * 1e-6, chatter=np.full(count, 900.0),
        mode_frequency=np.full(count, 850.0), pocket=np.arange(3), pocket_speed=speed,
        pocket_from=speed - near, pocket_to=speed + near, pocket_depth=np.full(3, 3e-3),
        pocket_removal=np.full(3, 1e-6),
    )  # fmt: skip


SPEC = SimpleNamespace(
    turning=False,
    teeth=2,
    diameter=0.006,
    milling="down",
    immersion=0.2,
    pairs=((767e6, 2e8),),
    uneven=False,
)


@pytest.mark.parametrize("count", [41, 161])
def test_the_axis_of_speeds_begins_with_them(count):
    upper, lower, *_ = lobes_figure(_result(count), SPEC).axes
    assert upper.get_xlim() == lower.get_xlim() == pytest.approx((20000.0, 60000.0))


@pytest.mark.parametrize("count", [41, 161])
def test_pockets_are_numbered_at_their_speeds_and_listed_below_the_panels(count):
    figure = lobes_figure(_result(count), SPEC)
    upper, lower, *_ = figure.axes
    figure.canvas.draw()
    numbers = {t.get_text(): t for t in upper.texts}
    assert {n: t.xy[0] for n, t in numbers.items()} == pytest.approx(
        dict(zip("123", POCKETS, strict=True))
    )
    assert all(t.get_window_extent().x1 < upper.bbox.x1 for t in numbers.values())
    listed = [t for t in figure.texts if t.get_text()[:2] in ("1:", "2:", "3:")]
    assert listed[2].get_text() == "3: 59500 rpm, 60 cm³/min, from 59200 to 59800 rpm"
    boxes = [t.get_window_extent() for t in listed]
    assert all(box.y1 < lower.xaxis.label.get_window_extent().y0 for box in boxes)
    assert all(box.y0 >= 0.0 and box.x1 <= figure.bbox.x1 for box in boxes)


def test_the_deepest_pockets_are_listed_however_near_they_are():
    """The number of one that is beside a deeper one's is in the list alone."""
    result, rpm = _result(161), np.array([30000.0, 30400.0, 33000.0, 31500.0, 50000.0])
    result.pocket, result.pocket_speed = np.arange(5), rpm * math.pi / 30.0
    result.pocket_from = result.pocket_to = result.pocket_speed
    result.pocket_depth = 3e-3 - 1e-4 * np.arange(5)
    result.pocket_removal = np.full(5, 1e-6)
    figure = lobes_figure(result, SPEC)
    listed = [t.get_text().split(",")[0] for t in figure.texts if t.get_text()[1:2] == ":"]
    assert listed == ["1: 30000 rpm", "2: 30400 rpm", "3: 31500 rpm", "4: 33000 rpm"]
    numbers = {t.get_text(): t.xy[0] for t in figure.axes[0].texts}
    assert numbers == pytest.approx({"1": 30000.0, "3": 31500.0, "4": 33000.0})
    assert sum(line.get_marker() == "|" for line in figure.axes[0].get_lines()) == 4


def test_of_few_speeds_depths_above_the_frame_are_triangles_at_its_edge():
    """Unbounded ones too; a speed without a depth has no mark."""
    result = _result(41)
    result.depth[[5, 9, 12]] = 0.5, np.inf, np.nan
    result.at_rest[20] = 0.5
    figure = lobes_figure(result, SPEC)
    upper = figure.axes[0]
    rpm, top = result.cutting_speed * 30.0 / math.pi, upper.get_ylim()[1]
    lines = {line.get_label(): line for line in upper.get_lines()}
    depth = lines["with the receptance at every speed"].get_ydata()
    assert np.flatnonzero(np.isnan(depth)).tolist() == [5, 9, 12]
    own, rest = (
        line for line in upper.get_lines() if line.get_marker() == "^" and len(line.get_xdata())
    )
    assert own.get_xdata() == pytest.approx(rpm[[5, 9]])
    assert rest.get_xdata() == pytest.approx(rpm[[20]])
    assert own.get_ydata() == pytest.approx(top)
    assert not own.get_clip_on()
    assert "deeper than drawn" in [t.get_text() for t in figure.legends[0].get_texts()]
    drawn = lobes_figure(_result(41), SPEC).legends[0].get_texts()
    assert "deeper than drawn" not in [t.get_text() for t in drawn]


@pytest.mark.parametrize("count", [41, 161])
def test_the_band_is_drawn_at_few_speeds_and_at_many(count):
    result = _result(count)
    words = "band of intervals and sources"
    assert words not in lobes_figure(result, SPEC).axes[0].get_legend_handles_labels()[1]
    result.least, result.most = 0.8 * result.depth, 1.2 * result.depth
    upper = lobes_figure(result, SPEC).axes[0]
    (band,) = (each for each in upper.collections if each.get_label() == words)
    reach = np.concatenate([path.vertices for path in band.get_paths()])[:, 1]
    assert reach.min() == pytest.approx(1e3 * result.least.min())
    assert reach.max() == pytest.approx(1e3 * result.most.max())
    assert count > 100 or len(band.get_paths()) == count


def test_a_limit_of_the_motor_above_the_frame_is_said_to_be_there():
    """That of a motor which limits some speeds is a line of its own."""
    result, top = _result(161), lobes_figure(_result(161), SPEC).axes[0].get_ylim()[1]
    result.motor = "9 kW"
    for least, words in ((1.01, ": deeper than drawn"), (0.99, "")):
        result.motor_depth = 1e-3 * top * np.linspace(least, 3.0, 161)
        told = [t.get_text() for t in lobes_figure(result, SPEC).legends[0].get_texts()]
        assert f"limit of the motor (9 kW){words}" in told


def test_lines_leave_the_frame():
    result = _result(161)
    result.depth[[50, 60]] = 0.5, np.inf
    upper = lobes_figure(result, SPEC).axes[0]
    lines = {line.get_label(): line for line in upper.get_lines()}
    depth = lines["with the receptance at every speed"].get_ydata()
    assert (depth[[50, 60]] > upper.get_ylim()[1]).all()
    assert "^" not in {line.get_marker() for line in upper.get_lines()}
