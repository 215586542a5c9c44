"""Motion of points and loads of bearings over time, and the orbits of points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.time_response.result import TimeResponseResult
from rotordyn.arrays import Indices
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    GREY,
    add_axes,
    evenly,
    grid_boxes,
    line_of,
    new_figure,
)
from rotordyn.results.display import MICROMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SPEEDS, POINTS, BEARINGS = 3, 5, 7
LINEAR: Any = {"color": GREY, "lw": 0.8, "zorder": 1.5}
ROW, SIDE = 46.0, 50.0  # [mm]


def motion_figure(result: TimeResponseResult) -> Figure:
    """Displacement of the first points over time, in a column for each of some speeds; grey, what
    it would be if bearings were linear."""
    picked, points = _picked(result), result.point[:POINTS]
    figure = new_figure(168.0, ROW * len(points) + 22.0)
    panels = _panels(figure, len(points), picked.size)
    for place, axes in enumerate(panels):
        k, column = divmod(place, picked.size)
        row = picked[column]
        for axis, name in enumerate(result.axis):
            linear = result.linear_displacement[row, :, k, axis] * MICROMETRE.factor
            moved = result.displacement[row, :, k, axis] * MICROMETRE.factor
            if result.bearing:
                axes.plot(result.time * 1e3, linear, **{**line_of(axis), **LINEAR})
            axes.plot(result.time * 1e3, moved, label=name, **{**line_of(axis), "lw": 1.0})
        if result.bearing:
            axes.plot([], [], **LINEAR, label="linear bearings")
        _name(axes, result, row, first=not k, last=k == len(points) - 1)
        if not column:
            axes.set_ylabel(f"{points[k]} [µm]", fontsize=FONT_SIZE)
    top_legend(figure, *panels)
    return figure


def bearing_figure(result: TimeResponseResult) -> Figure:
    """Radial and axial load of the bearings over time, of many those with the largest loads, in a
    column for each of some speeds."""
    picked = _picked(result)
    chosen = np.sort(np.argsort(-result.peak_load[picked].max(axis=0))[:BEARINGS])
    figure = new_figure(168.0, ROW * 2 + 22.0)
    panels = _panels(figure, 2, picked.size)
    for place, axes in enumerate(panels):
        axial, column = divmod(place, picked.size)
        load = result.bearing_load[picked[column]]
        values = load[..., 0] if axial else np.hypot(load[..., 1], load[..., 2])
        for look, k in enumerate(chosen):
            name, style = result.bearing[k], {**line_of(look), "lw": 1.0}
            axes.plot(result.time * 1e3, values[:, k], label=name, **style)
        _name(axes, result, picked[column], first=not axial, last=bool(axial))
        if not column:
            words = "axial load towards +x" if axial else "radial load"
            axes.set_ylabel(f"{words} [N]", fontsize=FONT_SIZE)
    top_legend(figure, *panels)
    return figure


def orbit_figure(result: TimeResponseResult) -> Figure:
    """Path of the first points across the axis, seen along +x, in a column for each of some
    speeds."""
    picked, points = _picked(result), result.point[:POINTS]
    figure = new_figure(168.0, SIDE * len(points) + 18.0)
    panels = _panels(figure, len(points), picked.size, gap=12.0)
    for place, axes in enumerate(panels):
        k, column = divmod(place, picked.size)
        row = picked[column]
        y, z = (result.displacement[row, :, k, axis] * MICROMETRE.factor for axis in (1, 2))
        axes.plot(y, z, **{**line_of(0), "lw": 0.8})
        axes.plot([0.0], [0.0], "+", color=GREY)
        axes.set_aspect("equal", adjustable="datalim")
        _name(axes, result, row, first=not k, last=False)
        axes.set_xlabel(f"{points[k]}, y [µm]", fontsize=FONT_SIZE)
        if not column:
            axes.set_ylabel("z [µm]", fontsize=FONT_SIZE)
    return figure


def _picked(result: TimeResponseResult) -> Indices:
    """First, middle and last of the speeds with an answer over some time."""
    known = np.flatnonzero(result.ended > 0.0)
    return known[evenly(known.size, SPEEDS)]


def _panels(figure: Figure, rows: int, columns: int, gap: float = 8.0) -> list[Axes]:
    boxes = grid_boxes(figure, rows, columns, margins=(19.0, 5.0, 12.0, 9.0), gaps=(15.0, gap))
    return [add_axes(figure, box) for box in boxes]


def _name(axes: Axes, result: TimeResponseResult, row: int, *, first: bool, last: bool) -> None:
    """The speed above the first panel of a column, time below the last."""
    if first:
        axes.set_title(f"{result.speed[row] * RPM.factor:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
    if last:
        axes.set_xlabel("time [ms]", fontsize=FONT_SIZE)
