"""Motion on runs through the speeds, beside that of steady rotation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.figures.amplitudes import decades
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    GREY,
    add_axes,
    grid_boxes,
    line_of,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MICROMETRE, RPM
from rotordyn.results.kinds import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_POINTS = 4


def runs_figure(result: UnbalanceResult) -> Figure:
    """Half axis of the orbit over the speed on the way, a panel for each of the first points."""
    picked = range(min(len(result.point), MOST_POINTS))
    figure = new_figure(168.0, 26.0 + 56.0 * len(picked))
    boxes = grid_boxes(figure, len(picked), 1, margins=(17.0, 6.0, 12.0, 9.0), gaps=(0.0, 8.0))
    turns = "" if result.speed_ratio == 1.0 else " of the spindle"
    for place, (box, point) in enumerate(zip(boxes, picked, strict=True)):
        last = place == len(picked) - 1
        axes = add_axes(figure, box, f"speed{turns} [rpm]" * last, "half axis of the orbit [µm]")
        steady = _seen(result.fine_major_axis[:, point])
        axes.plot(result.fine_speed * RPM.factor, steady, color=GREY, lw=2.2, label="steady")
        for k, name in enumerate(result.run):
            if result.run_outcome[k]:
                continue
            moved = _seen(result.run_amplitude[k, :, point])
            axes.plot(result.run_speed * RPM.factor, moved, label=name, **line_of(k))
        axes.set_title(result.point[point], fontsize=FONT_SIZE, pad=3.0)
        decades(axes)
        axes.tick_params(labelbottom=last)
        speed_ticks(axes, float(result.speed[-1]) * RPM.factor, 8)
    top_legend(figure, figure.axes[0])
    return figure


def _seen(size: Array) -> Array:
    """[µm], without what has no logarithm."""
    return np.where(size > 0.0, size * MICROMETRE.factor, np.nan)
