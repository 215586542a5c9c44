"""Figures of four panels over one speed axis, or over one load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.arrays import Array
from rotordyn.figures.style import add_axes, grid_boxes, new_figure, speed_ticks
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def four_over_speed(
    names: Sequence[str], speed: Array, instead: str = ""
) -> tuple[Figure, list[Axes]]:
    """Return a figure and its panels, for quantities with ``names``, over ``speed`` [rad/s], or
    over a quantity with the label ``instead``."""
    figure = new_figure(168.0, 118.0)
    boxes = grid_boxes(figure, 2, 2, margins=(15.0, 6.0, 12.0, 8.0), gaps=(18.0, 5.0))
    panels = []
    for place, (box, name) in enumerate(zip(boxes, names, strict=True)):
        axes = add_axes(figure, box, (instead or "speed [rpm]") if place > 1 else "", name)
        if not instead:
            speed_ticks(axes, float(speed[-1] * RPM.factor))
        axes.tick_params(labelbottom=place > 1)
        panels.append(axes)
    return figure, panels
