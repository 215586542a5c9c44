"""Response of variants to unbalance, a line each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import FONT_SIZE, add_axes, new_figure, speed_ticks
from rotordyn.results.display import MICROMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_POINTS = 3


def amplitudes_figure(variants: Sequence[Shown]) -> Figure:
    """Major half axis of the orbit over speed, a panel per point."""
    points = variants[0].result.point[:MOST_POINTS]
    tall, gap = 50.0, 8.0
    figure = new_figure(168.0, 14.0 + (tall + gap) * len(points))
    for place, name in enumerate(points):
        last = place == len(points) - 1
        box = (17.0, 12.0 + (len(points) - 1 - place) * (tall + gap), 145.0, tall)
        axes = add_axes(figure, box, "speed [rpm]" if last else "", "half axis of the orbit [µm]")
        for k, variant in enumerate(variants):
            values = variant.result.fine_major_axis[:, place] * MICROMETRE.factor
            shown = np.where(values > 0.0, values, np.nan)
            rpm = variant.result.fine_speed * RPM.factor
            axes.plot(rpm, shown, color=colour(k), ls=dash(k), lw=1.0, label=variant.title)
        speed_ticks(axes, float(variants[0].result.speed[-1]) * RPM.factor, 8)
        axes.tick_params(labelbottom=last)
        log_axis(axes)
        axes.set_title(f"{name}, major half axis, zero to peak", fontsize=FONT_SIZE, pad=4.0)
    top_legend(figure, *figure.axes)
    return figure
