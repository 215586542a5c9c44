"""Axial loads and temperatures of every bearing over time from the start."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.warm_up.result import WarmUpResult
from rotordyn.figures.curves import draw_columns
from rotordyn.figures.legends import legend
from rotordyn.figures.style import FONT_SIZE, add_axes, evenly, grid_boxes, new_figure
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TIME = "time from the start [min]"
ROWS = (
    ("axial_load", "axial load [N]"),
    ("ball_temperature", "balls [°C]"),
    ("inner_temperature", "inner ring [°C]"),
    ("outer_temperature", "outer ring [°C]"),
)


def warming_figure(result: WarmUpResult, speeds: int = 3) -> Figure:
    """A column at the first, the middle and the last speed: loads, and temperatures."""
    picked = evenly(result.speed.size, speeds)
    figure = new_figure(168.0, 190.0)
    boxes = grid_boxes(
        figure, len(ROWS), len(picked), margins=(15.0, 5.0, 11.0, 9.0), gaps=(11.0, 5.0)
    )
    for line, (field, label) in enumerate(ROWS):
        values = getattr(result, field)
        low, high = (
            np.nanmin(values[picked], initial=np.inf),
            np.nanmax(values[picked], initial=0.0),
        )
        for place, row in enumerate(picked):
            box, last = boxes[line * len(picked) + place], line == len(ROWS) - 1
            axes = add_axes(figure, box, TIME * last, label * (not place))
            draw_columns(axes, result.time / 60.0, values[row], result.bearing)
            axes.set_xlim(0.0, result.time[-1] / 60.0)
            lowest = min(low, high) - 2.0 if line else min(1.05 * low, 0.0)
            axes.set_ylim(lowest, 1.05 * high + 1e-3)
            axes.tick_params(labelbottom=last)
            if not line:
                rpm = result.speed[row] * RPM.factor
                axes.set_title(f"{rpm:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
            if not line and not place:
                legend(axes)
    return figure
