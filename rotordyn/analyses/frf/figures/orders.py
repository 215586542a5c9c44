"""Frequency responses along engine orders, over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.figures.amplitudes import log_axis, phase_axis, wrapped_phase
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    add_axes,
    grid_boxes,
    line_of,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def orders_figure(result: FrequencyResponse, pairs: Sequence[int]) -> Figure:
    """Amplitude (log) over phase, a column per pair, a line per engine order; broken where a stop
    closes, a mark where there is one speed only."""
    figure = new_figure(168.0, 112.0)
    boxes = grid_boxes(figure, 2, len(pairs), margins=(17.0, 6.0, 12.0, 15.0), gaps=(17.0, 4.0))
    for column, pair in enumerate(pairs):
        unit = shown(result.unit(pair))
        upper, lower = boxes[column], boxes[len(pairs) + column]
        above = add_axes(figure, upper, "", f"amplitude [{unit.unit}]")
        below = add_axes(figure, lower, "speed of the spindle [rpm]", "phase [deg]")
        above.tick_params(labelbottom=False)
        above.set_title(f"{result.kind} {result.pair[pair]}", fontsize=FONT_SIZE, pad=4.0)
        for row in range(len(result.line)):
            _draw(above, below, result, row, pair)
        for axes in (above, below):
            speed_ticks(axes, float(result.speed[-1]) * RPM.factor, 4)
        if above.get_lines():
            log_axis(above)
        phase_axis(below)
    top_legend(figure, *figure.axes)
    return figure


def _draw(above: Axes, below: Axes, result: FrequencyResponse, row: int, pair: int) -> None:
    rpm = result.line_speed[row] * RPM.factor
    values = result.line_curve[row, :, pair] * shown(result.unit(pair)).factor
    size = np.abs(values)
    size[~(np.isfinite(size) & (size > 0.0))] = np.nan
    if np.isnan(size).all():
        return  # nothing couples the two ends
    look = {**line_of(row), "lw": 1.1}
    if np.isfinite(size).sum() == 1:
        look |= {"marker": "o", "ls": "none"}
    above.plot(rpm, size, label=result.line[row], **look)
    below.plot(rpm, wrapped_phase(np.degrees(np.angle(values))), **look)
