"""Hysteresis loops, loads of the bearings, and the axial stiffness over speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.axial_cycle.result import AxialCycleResult
from rotordyn.figures.curves import draw_columns, merged
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    add_axes,
    evenly,
    grid_boxes,
    line_of,
    mark_few_points,
    marked,
    new_figure,
    speed_ticks,
)
from rotordyn.preload.arrangement import SHAFT
from rotordyn.results.display import MICROMETRE, RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def cycle_figure(result: AxialCycleResult, speeds: int = 3) -> Figure:
    """Draw displacement over force, and loads over displacement: first, middle and last speed."""
    picked = evenly(result.speed.size, speeds)
    figure = new_figure(168.0, 130.0)
    boxes = grid_boxes(figure, 2, len(picked), margins=(16.0, 6.0, 12.0, 9.0), gaps=(9.0, 17.0))
    for panel, index in enumerate(picked):
        first = not panel
        shift = result.position[index, ..., SHAFT] * MICROMETRE.factor
        upper = add_axes(
            figure, boxes[panel], "axial force [N]", "axial shift of the shaft [µm]" * first
        )
        lower = add_axes(
            figure,
            boxes[len(picked) + panel],
            "axial shift of the shaft [µm]",
            "axial load [N]" * first,
        )
        for k, name in enumerate(result.branch):
            upper.plot(result.force, shift[k], label=f"force {name}", **line_of(0, k))
            for bearing, column in merged(result.bearing, result.axial_load[index, k]):
                load = result.axial_load[index, k, :, column]
                name_once = bearing if k == 0 else None
                look = line_of(column, k) | marked(column)
                lower.plot(shift[k], load, label=name_once, **look)
        rpm = result.speed[index] * RPM.factor
        upper.set_title(f"{rpm:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
        if first:
            legend(upper)
    top_legend(figure, *figure.axes[1::2])
    return figure


def stiffness_figure(result: AxialCycleResult) -> Figure:
    """Draw axial stiffness at no load over speed, a line per branch."""
    figure = new_figure(168.0, 90.0)
    axes = add_axes(
        figure, (15.0, 11.0, 147.0, 74.0), "speed [rpm]", "axial stiffness at no load [N/µm]"
    )
    rpm = result.speed * RPM.factor
    speed_ticks(axes, float(rpm[-1]))
    names = [f"force {name}" for name in result.branch]
    draw_columns(axes, rpm, result.no_load_stiffness * STIFFNESS.factor, names)
    mark_few_points(axes)
    axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    legend(axes)
    return figure


def held_figure(result: AxialCycleResult, speeds: int = 5) -> Figure:
    """Draw the cyclic force within which friction holds the sleeves, over its mean, at some of the
    speeds at which it does."""
    held_rows = np.flatnonzero(np.isfinite(result.held_force).any(axis=1))
    picked = held_rows[evenly(len(held_rows), speeds)]
    figure = new_figure(168.0, 90.0)
    axes = add_axes(
        figure,
        (15.0, 11.0, 147.0, 74.0),
        "mean axial force [N]",
        "cyclic force without sliding [±N]",
    )
    for k, index in enumerate(picked):
        name = f"{result.speed[index] * RPM.factor:.0f} rpm"
        axes.plot(result.held_mean[index], result.held_force[index], label=name, **line_of(k))
    axes.set_ylim(bottom=0.0)
    legend(axes)
    return figure
