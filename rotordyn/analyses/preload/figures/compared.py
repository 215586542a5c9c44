"""Preload of variants over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.analyses.preload.known import preload_sum
from rotordyn.figures.curves import draw_references
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import add_axes, grid_boxes, new_figure, speed_ticks
from rotordyn.results.display import MICROMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def preload_figure(variants: Sequence[Shown]) -> Figure:
    """Sum of the preloads and the way of every sleeve, a line per variant."""
    sleeves = variants[0].result.sleeve
    columns = 1 + len(sleeves)
    figure = new_figure(168.0, 80.0)
    boxes = grid_boxes(figure, 1, columns, margins=(15.0, 6.0, 12.0, 12.0), gaps=(17.0, 0.0))
    names = ["sum of preloads [N]", *(f"sleeve {name}, shift [µm]" for name in sleeves)]
    axes = [
        add_axes(figure, box, "speed [rpm]", name) for box, name in zip(boxes, names, strict=True)
    ]
    for place, variant in enumerate(variants):
        look = {"color": colour(place), "ls": dash(place), "label": variant.title}
        result, rpm = variant.result, variant.result.speed * RPM.factor
        if variant.spindle is not None:
            axes[0].plot(rpm, preload_sum(result, variant.spindle), **look)
        for panel, name in zip(axes[1:], sleeves, strict=True):
            body = result.body.index(name)
            panel.plot(rpm, result.position[:, body] * MICROMETRE.factor, **look)
    known, top = variants[0].known, float(variants[0].result.speed[-1] * RPM.factor)
    draw_references(axes[0], known, "preload_sum", top)
    for panel, name in zip(axes[1:], sleeves, strict=True):
        own = [r for r in known if r.subject == name]
        draw_references(panel, own, "sleeve_displacement", top)
    for panel in axes:
        speed_ticks(panel, top, 4)
    top_legend(figure, *axes)
    return figure
