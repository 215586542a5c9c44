"""Cycles of variants: displacement at the first and last speed, stiffness at no load over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour
from rotordyn.figures.style import DASHES, FONT_SIZE, add_axes, grid_boxes, new_figure, speed_ticks
from rotordyn.results.display import MICROMETRE, RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHAFT = 0


def cycle_figure(variants: Sequence[Shown]) -> Figure:
    """Displacement of the shaft under force, a colour per variant; the rising branch is dashed."""
    figure = new_figure(168.0, 80.0)
    speed = variants[0].result.speed
    picked = sorted({0, len(speed) - 1})
    margins = (16.0, 6.0, 12.0, 18.0)
    boxes = grid_boxes(figure, 1, len(picked), margins=margins, gaps=(12.0, 0.0))
    panels = []
    for place, (index, box) in enumerate(zip(picked, boxes, strict=True)):
        label = "" if place else "axial shift of the shaft [µm]"
        axes = add_axes(figure, box, "axial force [N]", label)
        axes.set_title(f"{speed[index] * RPM.factor:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
        for k, variant in enumerate(variants):
            for branch, line in enumerate(variant.result.position[index, ..., SHAFT]):
                axes.plot(
                    variant.result.force,
                    line * MICROMETRE.factor,
                    color=colour(k),
                    ls=DASHES[branch],
                    label="" if branch else variant.title,
                )
        panels.append(axes)
    top_legend(figure, *panels)
    return figure


def stiffness_figure(variants: Sequence[Shown]) -> Figure:
    """Axial stiffness at no load, a colour per variant; the rising branch is dashed."""
    figure = new_figure(168.0, 90.0)
    axes = add_axes(
        figure, (15.0, 11.0, 147.0, 66.0), "speed [rpm]", "axial stiffness at no load [N/µm]"
    )
    for k, variant in enumerate(variants):
        rpm = variant.result.speed * RPM.factor
        for branch, line in enumerate(variant.result.no_load_stiffness.T * STIFFNESS.factor):
            label = "" if branch else variant.title
            axes.plot(rpm, line, color=colour(k), ls=DASHES[branch], label=label)
    speed_ticks(axes, float(variants[0].result.speed[-1] * RPM.factor))
    axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    top_legend(figure, axes)
    return figure
