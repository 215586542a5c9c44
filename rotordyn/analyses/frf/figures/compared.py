"""Frequency responses of variants: curves over one another, maps and surfaces on one scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.figures.map import (
    amplitude,
    amplitude_range,
    draw_map,
    draw_scale,
    speeds_shown,
)
from rotordyn.analyses.frf.figures.slices import draw_measured
from rotordyn.analyses.frf.figures.surface import draw_pins, draw_surface
from rotordyn.analyses.frf.result import FrequencyResponse, TurningFrfResult
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.mode_lines import draw_known
from rotordyn.figures.panels import Shown, beside, colour, dash, panels
from rotordyn.figures.style import FONT_SIZE, add_axes, new_figure, round_ticks
from rotordyn.machine.reference import Reference
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_SLICES = 3


def curves_figure(variants: Sequence[Shown], pair: int) -> Figure:
    """Amplitude over frequency, a panel per slice speed, a line per variant."""
    first: FrequencyResponse = variants[0].result
    slices = np.flatnonzero(first.is_slice)[:MOST_SLICES].tolist()
    figure = new_figure(168.0, 22.0 + 58.0 * len(slices))
    unit = shown(first.unit(pair)).unit
    below = ", ".join(dict.fromkeys(axis_label(v.result, "frequency") for v in variants))
    tall, gap = 50.0, 8.0
    for place, index in enumerate(slices):
        last = place == len(slices) - 1
        box = (17.0, 12.0 + (len(slices) - 1 - place) * (tall + gap), 145.0, tall)
        axes = add_axes(figure, box, below if last else "", f"amplitude [{unit}]")
        for k, variant in enumerate(variants):
            frequency, values = variant.result.curve(index, pair)
            size = np.abs(values) * shown(first.unit(pair)).factor
            axes.plot(frequency, size, color=colour(k), ls=dash(k), lw=1.0, label=variant.title)
        draw_measured(axes, first, pair, "amplitude", index)
        top = float(first.frequency[-1])
        axes.set_xlim(0.0, top)
        axes.set_xticks(round_ticks(0.0, top, 8))
        axes.tick_params(labelbottom=last)
        log_axis(axes)
        rpm = first.speed[index] * RPM.factor
        axes.set_title(
            f"{first.kind} {first.pair[pair]} at {rpm:.0f} rpm", fontsize=FONT_SIZE, pad=4.0
        )
    top_legend(figure, *figure.axes)
    return figure


def maps_figure(variants: Sequence[Shown], pair: int) -> Figure:
    """A heat map per variant, one colour scale for all."""
    figure, boxes = panels(
        len(variants), tall=66.0, margins=(15.0, 20.0, 12.0, 9.0), gaps=(8.0, 16.0)
    )
    limits = _common_range(variants, pair)
    labels = [axis_label(variant.result, "frequency") for variant in variants]
    for place, (variant, box) in enumerate(zip(variants, boxes, strict=True)):
        axes = add_axes(figure, box, "speed [rpm]", beside(labels, place))
        image = draw_map(axes, variant.result, pair, limits)
        speeds_shown(axes, variant.result, 4)
        draw_known(axes, _fixed(variant), edge="white")
        axes.tick_params(labelleft=not place % 2)
        axes.set_title(shortened(variant.title), fontsize=FONT_SIZE, pad=4.0)
        if place == min(1, len(variants) - 1):
            draw_scale(figure, image, variant.result, pair, box)
    return figure


def surfaces_figure(variants: Sequence[Shown], pair: int) -> Figure:
    """A surface per variant, one height scale for all."""
    figure, boxes = panels(len(variants), tall=72.0, margins=(1.0, 1.0, 2.0, 2.0), gaps=(3.0, 2.0))
    limits = _common_range(variants, pair)
    for variant, box in zip(variants, boxes, strict=True):
        axes = add_axes(figure, box)
        draw_surface(axes, variant.result, pair, shortened(variant.title), limits, shrink=1.6)
        draw_pins(axes, variant.result, _fixed(variant))
    return figure


def _fixed(variant: Shown) -> Sequence[Reference]:
    """What is known of a variant; frequencies of the fixed frame are none of the turning one."""
    return () if isinstance(variant.result, TurningFrfResult) else variant.known


def _common_range(variants: Sequence[Shown], pair: int) -> tuple[float, float]:
    values: list[NDArray[np.float64]] = [amplitude(v.result, pair).ravel() for v in variants]
    return amplitude_range(np.concatenate(values))
