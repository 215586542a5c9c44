"""Campbell diagrams of variants: side by side, and laid over one another."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.campbell.figures.diagram import draw_orders, draw_unstable, orders
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.mode_lines import draw_known, draw_modes
from rotordyn.figures.panels import Shown, beside, colour, panels
from rotordyn.figures.style import BLACK, FONT_SIZE, add_axes, new_figure, speed_ticks
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def panels_figure(
    variants: Sequence[Shown], teeth: Sequence[int] = (), max_frequency: float = 0.0
) -> Figure:
    """A diagram per variant on equal axes, each with the frequencies known of it."""
    figure, boxes = panels(
        len(variants), tall=66.0, margins=(15.0, 9.0, 12.0, 14.0), gaps=(14.0, 13.0)
    )
    top = max_frequency or _highest(variants)
    rows = [box[1] for box in boxes]
    labels = [axis_label(variant.result, "frequency") for variant in variants]
    for place, (variant, box) in enumerate(zip(variants, boxes, strict=True)):
        below = "speed [rpm]" if box[1] == min(rows) or place + 2 >= len(boxes) else ""
        axes = add_axes(figure, box, below, beside(labels, place))
        _prepare(axes, variant, top, teeth)
        draw_modes(axes, variant.result)
        draw_unstable(axes, variant.result)
        draw_known(axes, variant.known)
        axes.set_title(shortened(variant.title), fontsize=FONT_SIZE, pad=4.0)
    top_legend(figure, *figure.axes)
    return figure


def overlay_figure(
    variants: Sequence[Shown], teeth: Sequence[int] = (), max_frequency: float = 0.0
) -> Figure:
    """All modes in one diagram, a colour per variant, dashes by whirl."""
    figure = new_figure(168.0, 115.0)
    labels = dict.fromkeys(axis_label(variant.result, "frequency") for variant in variants)
    axes = add_axes(figure, (15.0, 11.0, 147.0, 92.0), "speed [rpm]", ", ".join(labels))
    top = max_frequency or _highest(variants)
    _prepare(axes, variants[0], top, teeth)
    for place, variant in enumerate(variants):
        draw_modes(axes, variant.result, colour(place), 1.2)
        axes.plot([], [], color=colour(place), label=variant.title)
    axes.plot([], [], color=BLACK, ls="-", label="forward")
    axes.plot([], [], color=BLACK, ls=(0, (5, 2)), label="backward")
    top_legend(figure, axes)
    return figure


def _prepare(axes: Axes, variant: Shown, top: float, teeth: Sequence[int]) -> None:
    rpm = float(variant.result.speed[-1] * RPM.factor)
    speed_ticks(axes, rpm, 4)
    axes.set_ylim(0.0, top)
    draw_orders(axes, orders(variant.result, teeth), rpm, top)


def _highest(variants: Sequence[Shown]) -> float:
    """A little above the highest frequency of all."""
    known = [np.nanmax(v.result.frequency) for v in variants if v.result.frequency.size]
    return 1.04 * float(max(known, default=1.0))
