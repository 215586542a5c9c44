"""A single bearing in variants: stiffness over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.analyses.bearing.solve import under
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import BLACK, add_axes, grid_boxes, new_figure, speed_ticks
from rotordyn.results.display import RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def bearing_figure(variants: Sequence[Shown]) -> Figure:
    """Kxx and Kyy, tilts blocked: a colour per variant, dashes by axial load."""
    figure = new_figure(168.0, 90.0)
    boxes = grid_boxes(figure, 1, 2, margins=(15.0, 6.0, 12.0, 12.0), gaps=(18.0, 0.0))
    result = variants[0].result
    loads = result.load
    for entry, (name, box) in enumerate(zip(("Kxx", "Kyy"), boxes, strict=True)):
        axes = add_axes(figure, box, "speed [rpm]", f"stiffness {name} [N/µm]")
        for place, variant in enumerate(variants):
            rpm = variant.result.speed * RPM.factor
            values = variant.result.stiffness[:, :, 0, entry, entry] * STIFFNESS.factor
            for column in range(len(loads)):
                look = dash(column if len(loads) > 1 else place)
                axes.plot(rpm, values[:, column], color=colour(place), ls=look, label=variant.title)
        if len(loads) > 1:
            for column in range(len(loads)):
                axes.plot(
                    [], [], color=BLACK, ls=dash(column), label=under(result, column, " axial")
                )
        speed_ticks(axes, float(variants[0].result.speed[-1] * RPM.factor), 4)
        axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    top_legend(figure, *figure.axes)
    return figure
