"""Figure of axial loads and temperatures of every bearing over time from the start."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.warm_up.result import WarmUpResult
from rotordyn.arrays import Array
from rotordyn.figures.curves import draw_columns
from rotordyn.figures.legends import legend
from rotordyn.figures.style import FONT_SIZE, add_axes, evenly, grid_boxes, new_figure
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TIME = "time from the start [min]"
DOTTED = (0, (1.0, 1.2))
ROWS = (
    ("axial_load", "axial load [N]"),
    ("ball_temperature", "balls [°C]"),
    ("inner_temperature", "inner ring [°C]"),
    ("outer_temperature", "outer ring [°C]"),
)
BESIDE = {
    "inner_temperature": ("shaft_temperature", "shaft"),
    "outer_temperature": ("housing_temperature", "housing"),
}


def warming_figure(result: WarmUpResult, speeds: int = 3) -> Figure:
    """Draw loads and temperatures in a column for the first, the middle and the last speed, with a
    dot at the largest loads; those of shaft and housing where they change."""
    picked = evenly(result.speed.size, speeds)
    figure = new_figure(168.0, 190.0)
    boxes = grid_boxes(
        figure, len(ROWS), len(picked), margins=(15.0, 5.0, 11.0, 9.0), gaps=(11.0, 5.0)
    )
    every_field = [getattr(result, field)[picked] for field, _ in ROWS]
    for line, (field, label) in enumerate(ROWS):
        values = getattr(result, field)
        adjacent = _adjacent(result, field)
        all_values = np.append(values[picked], adjacent)
        low, high = np.nanmin(all_values, initial=np.inf), np.nanmax(all_values, initial=0.0)
        for place, row in enumerate(picked):
            box, last = boxes[line * len(picked) + place], line == len(ROWS) - 1
            axes = add_axes(figure, box, TIME * last, label * (not place))
            draw_columns(axes, result.time / 60.0, values[row], result.bearing, every_field)
            if not line and not result.outcome[row]:
                _mark_largest(axes, result, row)
            if adjacent.size:
                _draw_adjacent(axes, result.time / 60.0, adjacent, BESIDE[field][1])
            axes.set_xlim(0.0, result.time[-1] / 60.0)
            lowest = min(low, high) - 2.0 if line else min(1.05 * low, 0.0)
            axes.set_ylim(lowest, 1.05 * high + 1e-3)
            axes.tick_params(labelbottom=last)
            if not line:
                rpm = result.speed[row] * RPM.factor
                axes.set_title(f"{rpm:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
            if not line and not place:
                axes.plot([], [], "o", color="black", ms=2.5, label="largest")
                legend(axes)
    return figure


def _mark_largest(axes: Axes, result: WarmUpResult, row: int) -> None:
    """Mark the largest load of every bearing that is larger than at both ends, however early."""
    load = result.axial_load[row, : np.searchsorted(result.time, result.ended[row]) + 1]
    most = np.searchsorted(result.time, result.largest_time[row])
    for k, at in enumerate(most.tolist()):
        if abs(load[at, k]) > 1.005 * max(abs(load[0, k]), abs(load[-1, k])):
            axes.plot(result.time[at] / 60.0, load[at, k], "o", color="black", ms=2.5, zorder=5)


def _adjacent(result: WarmUpResult, field: str) -> Array:
    """Return the temperature of the part adjacent to a ring (t,); empty if it is constant."""
    if field not in BESIDE:
        return np.zeros(0)
    values: Array = getattr(result, BESIDE[field][0])
    return values if np.ptp(values) > 0.0 else np.zeros(0)


def _draw_adjacent(axes: Axes, minutes: Array, values: Array, name: str) -> None:
    """Draw the temperature of an adjacent part, with its name at the end."""
    axes.plot(minutes, values, color="black", linestyle=DOTTED)
    style: dict[str, Any] = {"ha": "right", "va": "top", "fontsize": FONT_SIZE}
    end = minutes[-1], values[-1]
    axes.annotate(name, end, (-3.0, -3.0), textcoords="offset points", **style)
