"""Mode shapes in space: sheets and animations around rendered pictures."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREY,
    RED,
    add_axes,
    grid_boxes,
    head,
    new_figure,
    own_settings,
)
from rotordyn.results.display import RPM, number
from rotordyn.surface.projection import projected

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Pixels = NDArray[np.uint8]
Picture = Callable[[int, int], Pixels]  # of a speed and a mode
PANELS = 8  # on a sheet
SECONDS = 2.0  # that one period takes in an animation
_WIDTH, _TITLE, _FOOT = 168.0, 8.0, 20.0
_TURNS = ((BLUE, "forward whirl"), (RED, "backward whirl"), (BLACK, "along a line"))


class Look(Protocol):
    """Properties of the pictures that legends name: colour map, largest displacement drawn."""

    @property
    def colours(self) -> str: ...
    @property
    def amplitude(self) -> float: ...


def sheets(result: CampbellResult) -> Iterator[tuple[str, int, list[int]]]:
    """Yield name, speed and modes of every sheet: modes that have a shape, the lowest first."""
    for speed, rpm in enumerate(result.shape_speed * RPM.factor):
        drawable = np.isfinite(result.shape[speed]).all(axis=(1, 2)) & ~result.mostly_overdamped
        modes = sorted(np.flatnonzero(drawable).tolist(), key=lambda k: _hertz(result, speed, k))
        pages = [modes[k : k + PANELS] for k in range(0, len(modes), PANELS)]
        for sheet, page in enumerate(pages, start=1):
            part = f"_{sheet}" if len(pages) > 1 else ""
            yield f"shapes_3d_{rpm:.6g}rpm{part}", speed, page


def sheet_figure(
    result: CampbellResult, speed: int, modes: Sequence[int], picture: Picture, look: Look
) -> Figure:
    """Draw a panel per mode with its ``picture``; ``look``: how it was made."""
    columns = 2 if len(modes) > 1 else 1
    rows = math.ceil(len(modes) / columns)
    images = [picture(speed, mode) for mode in modes]
    tall, wide = images[0].shape[:2]
    width = (_WIDTH - 6.0 - 4.0 * (columns - 1)) / columns
    height = width * tall / wide
    rpm = result.shape_speed[speed] * RPM.factor
    scale = f"{100.0 * look.amplitude:g} % of the shaft's length"
    title = f"mode shapes at {rpm:.6g} rpm, drawn up to {scale}"
    figure = new_figure(_WIDTH, _TITLE + rows * (height + 5.5) + _FOOT, title)
    margins = (3.0, 3.0, _FOOT, _TITLE + 5.5)
    boxes = grid_boxes(figure, rows, columns, margins=margins, gaps=(4.0, 5.5))
    for mode, image, box in zip(modes, images, boxes, strict=False):
        axes = _canvas(figure, box)
        axes.imshow(image, interpolation="antialiased", aspect="auto")
        axes.set_title(_caption(result, speed, mode), fontsize=FONT_SIZE, pad=2.5)
    _foot(figure, look.colours)
    return figure


@own_settings()
def save_animation(
    path: Path,
    result: CampbellResult,
    speed: int,
    mode: int,
    frames: Pixels,
    look: Look,
    heading: str = "",
) -> None:
    """Save one period of a mode as an endless GIF with its legend; ``frames`` (n, h, w, 3)."""
    from PIL import Image

    height, width = frames.shape[1:3]
    page, corner = _page(result, speed, mode, (height, width), look.colours, heading)
    palette = Image.fromarray(_pasted(page, frames[0], corner)).quantize(
        255, Image.Quantize.MAXCOVERAGE
    )
    images = [
        Image.fromarray(_pasted(page, frame, corner)).quantize(
            palette=palette, dither=Image.Dither.NONE
        )
        for frame in frames
    ]
    ms = round(1000.0 * SECONDS / len(images) / 10.0) * 10  # GIF counts hundredths of a second
    images[0].save(path, save_all=True, append_images=images[1:], duration=ms, loop=0)


def _page(
    result: CampbellResult,
    speed: int,
    mode: int,
    size: tuple[int, int],
    colours: str,
    heading: str,
) -> tuple[Pixels, tuple[int, int]]:
    """Return the page of an animation without its picture, and the pixel where this begins."""
    height, width = size
    dpi = width / (_WIDTH / 25.4)
    high = _TITLE + height / dpi * 25.4 + _FOOT
    rpm = result.shape_speed[speed] * RPM.factor
    figure = new_figure(_WIDTH, high, f"{_caption(result, speed, mode)}, {rpm:.6g} rpm", dpi)
    _foot(figure, colours)
    below = figure.bbox.height
    if heading:
        head(figure, heading)
    canvas = figure.canvas
    canvas.draw()
    page = np.asarray(canvas.buffer_rgba())[:, :, :3].copy()  # type: ignore[attr-defined]
    top = page.shape[0] - below + _TITLE / 25.4 * dpi
    return page, (round(top), (page.shape[1] - width) // 2)


def _pasted(page: Pixels, frame: Pixels, corner: tuple[int, int]) -> Pixels:
    result, (top, left) = page.copy(), corner
    part = result[top : top + frame.shape[0], left : left + frame.shape[1]]
    part[:] = frame[: part.shape[0], : part.shape[1]]
    return result


def _caption(result: CampbellResult, speed: int, mode: int) -> str:
    """Return name, frequency, whirl where the name lacks it, and damping of a mode."""
    row = _row(result, speed)
    name, whirl = result.mode[mode], result.whirl[row, mode]
    has_whirl = "forward" in name or "backward" in name
    turn = "" if has_whirl else {1.0: " forward", -1.0: " backward"}.get(float(whirl), "")
    damping = 100.0 * float(result.damping_ratio[row, mode])
    shown = f"{damping:.2g}" if abs(damping) > 1e-4 else "0"
    return f"{name}{turn}: {number(_hertz(result, speed, mode))} Hz, damping {shown} %".replace(
        "-", "−"
    )


def _hertz(result: CampbellResult, speed: int, mode: int) -> float:
    return float(result.frequency[_row(result, speed), mode])


def _row(result: CampbellResult, speed: int) -> int:
    """Return the row of a speed of the shapes among all speeds."""
    return int(np.abs(result.speed - result.shape_speed[speed]).argmin())


def _canvas(figure: Figure, box: Sequence[float]) -> Axes:
    axes = add_axes(figure, box)
    axes.set_axis_off()
    return axes


def _foot(figure: Figure, colours: str) -> None:
    """Draw the colour scale, the axes, and the meaning of the orbits."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.lines import Line2D

    axes = add_axes(figure, (6.0, 10.0, 52.0, 2.6))
    bar = figure.colorbar(ScalarMappable(cmap=colours), cax=axes, orientation="horizontal")
    bar.ax.tick_params(labelsize=FONT_SIZE - 1.0, length=2.0, direction="in")
    label = "displacement over its largest [-]"
    bar.set_label(label, fontsize=FONT_SIZE - 1.0)
    _triad(_canvas(figure, (64.0, 2.0, 16.0, 16.0)))
    handles = [Line2D([], [], color=colour, lw=1.8, label=name) for colour, name in _TURNS]
    rest = Line2D([], [], color=GREY, lw=0.9, label="at rest; bearings, supports")
    figure.legend(
        handles=[*handles, rest],
        loc="lower right",
        ncols=2,
        frameon=False,
        fontsize=FONT_SIZE - 1.0,
        title="orbits of the axis, dot at the instant shown",
        title_fontsize=FONT_SIZE - 1.0,
    )


def _triad(axes: Axes) -> None:
    """Draw the axes of the spindle as the pictures show them; it turns from y to z."""
    axes.set(xlim=(-0.6, 1.2), ylim=(-0.6, 1.2), aspect="equal")
    for name, end in zip("xyz", projected(np.eye(3)), strict=True):
        axes.annotate(
            "", end, (0.0, 0.0), arrowprops=dict(arrowstyle="-|>", color=BLACK, lw=0.8, shrinkA=0)
        )
        at = end * (1.0 + 0.18 / np.hypot(*end))
        axes.text(at[0], at[1], name, ha="center", va="center", fontsize=FONT_SIZE - 1.0)
