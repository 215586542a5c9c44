"""Errors of other tangents of a single bearing against the complete one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import mounted_under, tangent_error
from rotordyn.arrays import Array
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.style import (
    BLACK,
    FONT_SIZE,
    GREY,
    add_axes,
    grid_boxes,
    line_of,
    new_figure,
    round_ticks,
    speed_ticks,
)
from rotordyn.machine.reference import Reference
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import ContourSet
    from matplotlib.figure import Figure

PERCENT = 100.0
DOFS = {"x": "Kxx", "y": "Kyy"}
LEAST_LOADS = 5  # for a map
BAR_ROOM = 14.0  # [mm] beside a map, for its colour bar
COLOURS = "RdBu_r"


def tangents_figure(result: BearingMapResult, references: Sequence[Reference] = ()) -> Figure:
    """Draw relative errors of Kxx and Kyy over speed, a curve per load; maps where loads are many.

    The first tangent besides the complete one is drawn in full, further ones by their largest
    difference at each speed. ``references``: magnitudes of the frozen tangent's error of Kxx.
    """
    first, *further = [name for name in result.tangent if name != "complete"]
    mapped = result.load.size >= LEAST_LOADS and result.speed.size > 1
    figure = new_figure(168.0, 128.0 if mapped else 74.0)
    boxes = grid_boxes(figure, 1 + mapped, 2, margins=(15.0, 6.0, 12.0, 8.0), gaps=(18.0, 15.0))
    for panel, (dof, name) in enumerate(DOFS.items()):
        axes = add_axes(figure, boxes[panel], "speed [rpm]", f"{name}, {first}: error [%]")
        error = tangent_error(result, first, dof) * PERCENT
        _curves(axes, result, error)
        if panel == 0:
            top_legend(figure, axes)
            _unnamed(axes)
        for other in further:
            _largest(axes, result, other, dof)
        if first == "frozen" and dof == "x":
            _known(axes, references, error)
        if panel == 0:
            legend(axes, loc="lower left")
        if mapped:
            left, low, wide, tall = boxes[2 + panel]
            box = (left, low, wide - BAR_ROOM, tall)
            chart = add_axes(figure, box, "speed [rpm]", axis_label(result, "load"))
            colours = _map(chart, result, error)
            if colours is not None:
                scale = add_axes(figure, (left + wide - BAR_ROOM + 2.0, low, 2.5, tall))
                ends = float(np.nanmin(error)), float(np.nanmax(error))
                figure.colorbar(colours, cax=scale, ticks=round_ticks(*ends, 8))
                scale.set_ylabel("error [%]", fontsize=FONT_SIZE, labelpad=1.0)
                scale.tick_params(labelsize=FONT_SIZE - 1.5, length=2.0)
                scale.grid(visible=False)
    return figure


def _curves(axes: Axes, result: BearingMapResult, error: Array) -> None:
    rpm = result.speed * RPM.factor
    for column in range(result.load.size):
        axes.plot(rpm, error[:, column], label=mounted_under(result, column), **line_of(column))
    speed_ticks(axes, float(rpm[-1]))


def _unnamed(axes: Axes) -> None:
    """Exclude the lines drawn so far from further legends."""
    for line in axes.lines:
        line.set_label("_")


def _largest(axes: Axes, result: BearingMapResult, tangent: str, dof: str) -> None:
    """Draw the largest error of a tangent over all loads."""
    error = np.fmax.reduce(np.abs(tangent_error(result, tangent, dof)), axis=1) * PERCENT
    rpm = result.speed * RPM.factor
    axes.plot(rpm, error, color=GREY, lw=2.2, label=f"{tangent}: largest of all loads")


def _known(axes: Axes, references: Sequence[Reference], error: Array) -> None:
    """Draw magnitudes of references, with the sign of the largest computed error."""
    computed = np.nan_to_num(error).ravel()
    side = -1.0 if computed[np.abs(computed).argmax()] < 0.0 else 1.0
    for reference in dict.fromkeys(references):
        if reference.quantity == "frozen_error":
            axes.plot(
                np.asarray(reference.speeds) * RPM.factor,
                side * PERCENT * np.asarray(reference.values),
                marker="D",
                mfc="none",
                mec=BLACK,
                ls="none",
                clip_on=False,
                label=f"{reference.kind} magnitude",
            )


def _map(axes: Axes, result: BearingMapResult, error: Array) -> ContourSet | None:
    """Draw labelled lines of equal error over speed and load, and mark the largest error."""
    size = float(np.nanmax(np.abs(error)))
    rpm = result.speed * RPM.factor
    axes.grid(visible=False)
    speed_ticks(axes, float(rpm[-1]), 4)
    axes.set_ylim(float(result.load[0]), float(result.load[-1]))
    if size < 1e-6:
        axes.text(0.5, 0.5, "no difference", ha="center", transform=axes.transAxes)
        return None
    levels = [v for v in round_ticks(float(np.nanmin(error)), float(np.nanmax(error)), 9) if v]
    masked = np.ma.masked_invalid(error.T)
    fills = np.linspace(float(np.nanmin(error)), float(np.nanmax(error)), 41)
    filled = axes.contourf(rpm, result.load, masked, fills, cmap=COLOURS, vmin=-size, vmax=size)
    filled.set_edgecolor("face")
    lines = axes.contour(rpm, result.load, masked, levels, colors=BLACK, linewidths=0.6)
    axes.clabel(lines, fmt="%g", fontsize=FONT_SIZE - 1.5)
    row, column = np.unravel_index(np.nanargmax(np.abs(error)), error.shape)
    peak = f"× largest {error[row, column]:+.1f} % at {rpm[row]:.0f} rpm, "
    axes.set_title(peak + mounted_under(result, int(column)), fontsize=FONT_SIZE - 1.0, pad=3.0)
    axes.plot(
        rpm[row], result.load[column], marker="x", color=BLACK, mew=1.4, clip_on=False, zorder=6
    )
    return filled
