"""Axial load of every bearing over the temperature difference."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotordyn.analyses.thermal_preload.result import ThermalPreloadResult
from rotordyn.figures.curves import draw_columns
from rotordyn.figures.legends import legend
from rotordyn.figures.style import FONT_SIZE, add_axes, evenly, grid_boxes, new_figure
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ADDED = "temperature added to shaft,\ninner rings and balls [K]"


def load_figure(result: ThermalPreloadResult, speeds: int = 3) -> Figure:
    """A panel at the first, the middle and the last speed."""
    picked = evenly(result.speed.size, speeds)
    figure = new_figure(168.0, 84.0)
    boxes = grid_boxes(figure, 1, len(picked), margins=(15.0, 5.0, 16.0, 9.0), gaps=(11.0, 0.0))
    for place, (index, box) in enumerate(zip(picked, boxes, strict=True)):
        axes = add_axes(figure, box, ADDED, "axial load along thrust [N]" * (not place))
        draw_columns(axes, result.difference, result.axial_load[index], result.bearing)
        axes.set_ylim(bottom=0.0)
        axes.set_title(f"{result.speed[index] * RPM.factor:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
        if not place:
            legend(axes)
    return figure
