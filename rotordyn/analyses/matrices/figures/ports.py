"""Receptance of every port to a force at itself, by the matrices."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.matrices.result import MatricesResult
from rotordyn.figures.amplitudes import decades
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    add_axes,
    grid_boxes,
    line_of,
    new_figure,
    round_ticks,
)
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 6  # ports that are drawn
ACROSS = 2
EVEN = 200  # frequencies between which peaks may lie
HIGH = 1e2  # times that at even frequencies: a higher peak, as without damping, leaves the panel


def ports_figure(result: MatricesResult) -> Figure:
    """Panels of the first ports, each with a line for the first and the last speed with a state."""
    count = min(len(result.port), MOST)
    columns = min(count, ACROSS)
    rows = math.ceil(count / columns)
    figure = new_figure(168.0, 26.0 + 52.0 * rows)
    boxes = grid_boxes(figure, rows, columns, margins=(17.0, 6.0, 12.0, 15.0), gaps=(17.0, 9.0))
    top = result.max_frequency
    for port in range(count):
        printed = shown(result.unit(port))
        last = port + columns >= count
        label = axis_label(result, "frequency") if last else ""
        axes = add_axes(figure, boxes[port], label, f"amplitude [{printed.unit}]")
        axes.tick_params(labelbottom=last)
        axes.set_title(result.port[port], fontsize=FONT_SIZE, pad=4.0)
        for place, speed in enumerate(result.shown_speed):
            curve = np.abs(result.receptance[place, port]) * printed.factor
            name = f"{speed * RPM.factor:.0f} rpm"
            axes.plot(result.frequency, curve, lw=1.1, label=name, **line_of(place))
        axes.set_xlim(0.0, top)
        axes.set_xticks(round_ticks(0.0, top, 4))
        decades(axes, HIGH * _between(result, port) * printed.factor)
    top_legend(figure, *figure.axes)
    return figure


def _between(result: MatricesResult, port: int) -> float:
    """The highest receptance of a port at evenly spaced frequencies."""
    even = result.max_frequency * np.arange(1, EVEN + 1) / EVEN
    curves = np.abs(result.receptance[:, port])
    return max(float(np.nanmax(np.interp(even, result.frequency, curve))) for curve in curves)
