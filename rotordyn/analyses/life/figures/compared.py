"""Life and heat of variants over speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import add_axes, grid_boxes, new_figure, speed_ticks, with_zero
from rotordyn.results.display import GIGAPASCAL, RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HOUR = 3600.0


def life_figure(variants: Sequence[Shown]) -> Figure:
    """Life of the set, static safety of the worst bearing, its pressure, heat of all bearings."""
    oiled = all(math.isfinite(variant.result.viscosity) for variant in variants)
    names = ["life of the set L10r [h]", "least static safety S0 [-]", "peak pressure [GPa]"]
    names += ["heat of all bearings [W]"] if oiled else []
    figure = new_figure(168.0, 118.0)
    boxes = grid_boxes(figure, 2, 2, margins=(15.0, 6.0, 12.0, 12.0), gaps=(18.0, 12.0))
    axes = [add_axes(figure, b, "speed [rpm]", n) for b, n in zip(boxes, names, strict=False)]
    for place, variant in enumerate(variants):
        look = {"color": colour(place), "ls": dash(place), "label": variant.title}
        result, rpm = variant.result, variant.result.speed * RPM.factor
        life = np.where(np.isfinite(result.set_life), result.set_life / HOUR, np.nan)
        axes[0].plot(rpm, life, **look)
        axes[1].plot(rpm, result.static_safety.min(axis=1), **look)
        axes[2].plot(rpm, result.pressure.max(axis=1) * GIGAPASCAL.factor, **look)
        if oiled:
            axes[3].plot(rpm, result.heat.sum(axis=1), **look)
    log_axis(axes[0])
    for panel in axes[1:]:
        with_zero(panel, 1.05)
    for panel in axes:
        speed_ticks(panel, float(variants[0].result.speed[-1] * RPM.factor), 4)
    top_legend(figure, *axes)
    return figure
