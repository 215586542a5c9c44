"""Sheets and animations around given pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rotordyn.analyses.campbell.figures.shapes_3d import (
    PANELS,
    SECONDS,
    save_animation,
    sheet_figure,
    sheets,
)
from rotordyn.view.order import Order
from tests.rotordyn.figures import samples

RESULT = samples.campbell(3)
LOOK = Order(samples.spindle(), RESULT.node, RESULT.node_rotor, RESULT.shape, 0.06)


def picture(speed: int, mode: int) -> np.ndarray:
    """A wide one with a grey of its own."""
    return np.full((50, 120, 3), 40 + 10 * mode + speed, np.uint8)


def test_every_mode_that_has_a_shape_is_on_one_sheet_from_below() -> None:
    result = samples.campbell(3)
    result.shape[0, 2] = np.nan
    found = list(sheets(result))
    assert [name for name, *_ in found] == [
        *("shapes_3d_0rpm_1", "shapes_3d_0rpm_2", "shapes_3d_24000rpm_1", "shapes_3d_24000rpm_2")
    ]
    assert [speed for _, speed, _ in found] == [0, 0, 1, 1]
    assert max(len(modes) for *_, modes in found) <= PANELS
    for speed, row in ((0, 0), (1, -1)):
        shown = [mode for _, at, modes in found if at == speed for mode in modes]
        assert set(shown) == set(range(10)) - ({2} if speed == 0 else set())
        assert (np.diff(result.frequency[row, shown]) >= 0.0).all()


def test_one_sheet_has_no_number() -> None:
    result = samples.campbell(3)
    result.shape[:, 4:] = np.nan
    assert [name for name, *_ in sheets(result)] == ["shapes_3d_0rpm", "shapes_3d_24000rpm"]


def test_a_sheet_says_what_it_shows() -> None:
    (_, speed, modes) = list(sheets(RESULT))[2]
    figure = sheet_figure(RESULT, speed, modes, picture, LOOK)
    (title,) = [text.get_text() for text in figure.texts]
    assert title == "mode shapes at 24000 rpm, drawn up to 6 % of the shaft's length"
    titles = [axes.get_title() for axes in figure.axes if axes.get_title()]
    assert len(titles) == len(modes) == PANELS
    assert titles[0] == "axial: 350.0 Hz, damping 2 %"
    assert titles[1] == "1 bw backward: 693.0 Hz, damping 2 %"
    images = [axes.images[0].get_array() for axes in figure.axes if axes.images]
    assert [int(image[0, 0, 0]) for image in images[:PANELS]] == [41 + 10 * k for k in modes]
    assert "displacement over its largest [-]" in [axes.get_xlabel() for axes in figure.axes]
    words = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert {"forward whirl", "backward whirl"} <= set(words)


def test_damping_of_rounding_is_none() -> None:
    result = samples.campbell(3)
    result.damping_ratio[:, 9], result.damping_ratio[:, 8] = -1e-17, -0.031
    figure = sheet_figure(result, 1, [8, 9], picture, LOOK)
    titles = [axes.get_title() for axes in figure.axes if axes.get_title()]
    assert titles == ["axial: 350.0 Hz, damping −3.1 %", "torsion: 2974.0 Hz, damping 0 %"]


@pytest.mark.parametrize("count", [5, 20])
def test_animation_has_a_frame_for_every_picture_and_never_ends(tmp_path: Path, count: int) -> None:
    frames = np.full((count, 60, 300, 3), 255, np.uint8)
    for number, frame in enumerate(frames):
        frame[10:50, 10 * number : 10 * number + 10] = (0, 114, 178)
    save_animation(tmp_path / "mode.gif", RESULT, 1, 1, frames, LOOK)
    with Image.open(tmp_path / "mode.gif") as found:
        assert found.format == "GIF"
        assert found.n_frames == count
        assert found.info["loop"] == 0
        length = 0.0
        for number in range(count):
            found.seek(number)
            length += found.info["duration"] / 1000.0
            blue = (np.asarray(found.convert("RGB")).astype(int) - (0, 114, 178)).__abs__()
            columns = np.flatnonzero((blue.max(axis=2) < 12).sum(axis=0) >= 40)
            left = (found.size[0] - 300) // 2
            assert columns - left == pytest.approx(10 * number + np.arange(10), abs=0)
    assert length == pytest.approx(SECONDS, rel=0.05)
