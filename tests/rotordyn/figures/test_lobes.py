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
        loss=("",) * count,
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


def test_pockets_are_numbered_at_their_speeds_and_listed_below_the_panels():
    figure = lobes_figure(_result(161), SPEC)
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
