"""Figures of the motion of points and loads of bearings over time, and of orbits."""

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
ROUNDING = 1e-9  # of the largest load: smaller ones are rounding
LINEAR: Any = {"color": GREY, "lw": 0.8, "zorder": 1.5}
ROW, SIDE = 46.0, 50.0  # [mm]


def motion_figure(result: TimeResponseResult) -> Figure:
    """Draw displacement of the first points over time, in a column for each of some speeds; in
    grey, with linear bearings."""
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
        _label(axes, result, row, first=not k, last=k == len(points) - 1)
        if not column:
            axes.set_ylabel(f"{points[k]} [µm]", fontsize=FONT_SIZE)
    top_legend(figure, *panels)
    return figure


def bearing_figure(result: TimeResponseResult) -> Figure:
    """Draw radial and axial load of the bearings over time, at most ``BEARINGS`` with the largest
    loads, in a column for each of some speeds."""
    picked = _picked(result)
    chosen = np.sort(np.argsort(-result.peak_load[picked].max(axis=0))[:BEARINGS])
    load = result.bearing_load[picked][:, :, chosen]
    kinds = {"radial load": np.hypot(load[..., 1], load[..., 2])}
    kinds["axial load towards +x"] = load[..., 0]
    least = ROUNDING * np.nanmax(np.abs(load))
    kinds = {label: each for label, each in kinds.items() if np.nanmax(np.abs(each)) >= least}
    figure = new_figure(168.0, ROW * len(kinds) + 22.0)
    panels = _panels(figure, len(kinds), picked.size)
    for place, axes in enumerate(panels):
        kind, column = divmod(place, picked.size)
        label, values = [*kinds.items()][kind]
        for look, k in enumerate(chosen):
            name, style = result.bearing[k], {**line_of(look), "lw": 1.0}
            axes.plot(result.time * 1e3, values[column][:, look], label=name, **style)
        _label(axes, result, picked[column], first=not kind, last=kind == len(kinds) - 1)
        if not column:
            axes.set_ylabel(f"{label} [N]", fontsize=FONT_SIZE)
    top_legend(figure, *panels)
    return figure


def stop_figure(result: TimeResponseResult) -> Figure:
    """Draw gaps of end stops over time, in a column for each of some speeds; below zero a stop is
    compressed."""
    picked = _picked(result)
    figure = new_figure(168.0, ROW + 22.0)
    panels = _panels(figure, 1, picked.size)
    for row, axes in zip(picked, panels, strict=True):
        for look, name in enumerate(result.sleeve):
            gap = result.gap[row, :, look] * MICROMETRE.factor
            if np.isfinite(gap).any():
                axes.plot(result.time * 1e3, gap, label=name, **{**line_of(look), "lw": 1.0})
        axes.axhline(0.0, color=GREY, lw=0.8, label="closed below")
        _label(axes, result, row, first=True, last=True)
    panels[0].set_ylabel("gap of the end stop [µm]", fontsize=FONT_SIZE)
    top_legend(figure, *panels)
    return figure


def orbit_figure(result: TimeResponseResult) -> Figure:
    """Draw the path of the first points across the axis, seen from +x, in a column for each of some
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
        _label(axes, result, row, first=not k, last=False)
        axes.set_xlabel(f"{points[k]}, y [µm]", fontsize=FONT_SIZE)
        if not column:
            axes.set_ylabel("z [µm]", fontsize=FONT_SIZE)
    return figure


def _picked(result: TimeResponseResult) -> Indices:
    """Return first, middle and last of the speeds with a motion over some time."""
    usable = np.flatnonzero(result.ended > 0.0)
    return usable[evenly(usable.size, SPEEDS)]


def _panels(figure: Figure, rows: int, columns: int, gap: float = 8.0) -> list[Axes]:
    boxes = grid_boxes(figure, rows, columns, margins=(19.0, 5.0, 12.0, 9.0), gaps=(15.0, gap))
    return [add_axes(figure, box) for box in boxes]


def _label(axes: Axes, result: TimeResponseResult, row: int, *, first: bool, last: bool) -> None:
    """Write the speed above the first panel of a column, the time axis below the last."""
    if first:
        axes.set_title(f"{result.speed[row] * RPM.factor:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
    if last:
        axes.set_xlabel("time [ms]", fontsize=FONT_SIZE)
