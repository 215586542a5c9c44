"""Damping ratios of variants over speed, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.analyses.campbell.figures.damping import LABEL, draw_damping, limits
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.panels import Shown, beside, panels
from rotordyn.figures.style import FONT_SIZE, add_axes, speed_ticks
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def damping_figure(variants: Sequence[Shown]) -> Figure:
    """A panel per variant on equal axes, as of one result."""
    figure, boxes = panels(
        len(variants), tall=52.0, margins=(15.0, 9.0, 12.0, 14.0), gaps=(14.0, 13.0)
    )
    low, high = limits([variant.result for variant in variants])
    rows = [box[1] for box in boxes]
    for place, (variant, box) in enumerate(zip(variants, boxes, strict=True)):
        below = "speed [rpm]" if box[1] == min(rows) or place + 2 >= len(boxes) else ""
        axes = add_axes(figure, box, below, beside([LABEL] * len(boxes), place))
        speed_ticks(axes, float(variant.result.speed[-1]) * RPM.factor, 4)
        axes.set_ylim(low, high)
        draw_damping(axes, variant.result)
        axes.set_title(shortened(variant.title), fontsize=FONT_SIZE, pad=4.0)
    top_legend(figure, *figure.axes)
    return figure
