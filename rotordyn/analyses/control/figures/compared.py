"""Race control of a single bearing in variants: boundaries over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.control.figures.boundaries import load_label
from rotordyn.analyses.control.solve import BOUNDARY_WORDS
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import BLACK, add_axes, new_figure, speed_ticks
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def control_figure(variants: Sequence[Shown]) -> Figure:
    """Both boundaries: a colour per variant, the boundary of the outer race dashed."""
    figure = new_figure(168.0, 100.0)
    first = variants[0].result
    axes = add_axes(figure, (17.0, 12.0, 143.0, 74.0), "speed [rpm]", load_label(first))
    for place, variant in enumerate(variants):
        rpm, result = variant.result.speed * RPM.factor, variant.result
        for race, load in enumerate(result.boundary_load):
            axes.plot(rpm, load, color=colour(place), ls=dash(race))
        absent = "" if np.isfinite(result.boundary_load).any() else ": no boundary"
        axes.plot([], [], color=colour(place), label=f"{variant.title}{absent}")
    for race, word in enumerate(BOUNDARY_WORDS.values()):
        axes.plot([], [], color=BLACK, ls=dash(race), label=word)
    axes.set_ylim(0.0, float(first.load[-1]))
    speed_ticks(axes, float(first.speed[-1] * RPM.factor))
    top_legend(figure, axes)
    return figure
