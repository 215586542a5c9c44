"""A frequency response over speed and frequency as a heat map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.figures.decimate import nearest, peak_bins
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.arrays import Array
from rotordyn.figures.labels import axis_label
from rotordyn.figures.mode_lines import LEAST_SPEEDS, Modes, draw_known, draw_modes
from rotordyn.figures.style import (
    FONT_SIZE,
    add_axes,
    colour_scale,
    grid_boxes,
    log_ticks,
    new_figure,
    speed_ticks,
)
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage

_ROWS, _COLUMNS = 420, 480
FLOOR_DECADES = 4.0
LEAST_RASTER = 8  # speeds; of fewer each is a band of its own
BAND, UNKNOWN = 0.025, "#A8A8A8"  # of the axis on both sides of a speed; colour where none is near
COLOURS = "viridis"


def map_figure(
    result: FrequencyResponse, pairs: Sequence[int], campbell: Modes | None = None
) -> Figure:
    """Draw |H| of one pair on a full figure, or of several on small axes, with mode lines."""
    columns = 1 if len(pairs) == 1 else 2
    rows = math.ceil(len(pairs) / columns)
    figure = new_figure(168.0, 110.0 if columns == 1 else 14.0 + 64.0 * rows)
    boxes = grid_boxes(figure, rows, columns, margins=(15.0, 20.0, 12.0, 9.0), gaps=(32.0, 17.0))
    name = axis_label(result, "frequency")
    for place, (pair, box) in enumerate(zip(pairs, boxes, strict=False)):
        axes = add_axes(figure, box, "speed [rpm]", "" if place % columns else name)
        image = draw_map(axes, result, pair)
        speeds_shown(axes, result, 6 if columns == 1 else 3)
        if campbell is not None:
            draw_modes(axes, campbell, colour="white", width=0.3)
        title = f"{result.kind} {result.pair[pair]}"
        if campbell is not None:
            lines = "marks" if len(campbell.speed) < LEAST_SPEEDS else "thin lines"
            title += f", {lines}: damped modes" if columns == 1 else ""
        axes.set_title(title, fontsize=FONT_SIZE, pad=4.0)
        draw_scale(figure, image, result, pair, box)
    return figure


def amplitude(result: FrequencyResponse, pair: int) -> Array:
    """|H| of a pair in printed units, shape (speed, frequency)."""
    return np.abs(result.response[:, pair]) * shown(result.unit(pair)).factor


def amplitude_range(values: Array) -> tuple[float, float]:
    """Limits of colour or height: the 0.5 % quantile, at most four decades below the largest value,
    and that value."""
    drawable = values[np.isfinite(values) & (values > 0.0)]
    if not drawable.size:
        return 0.1, 1.0
    high = float(drawable.max())
    low = max(float(np.percentile(drawable, 0.5)), high / 10.0**FLOOR_DECADES)
    return (low if low < high else high / 10.0), high


def common_range(variants: Sequence[Shown]) -> tuple[float, float]:
    """Limits of the amplitude of the first pair over all variants."""
    return amplitude_range(np.concatenate([amplitude(v.result, 0).ravel() for v in variants]))


def draw_variant(axes: Axes, variant: Shown, limits: tuple[float, float]) -> None:
    """Draw the map of the first pair of a variant, with its published or measured frequencies."""
    result = variant.result
    draw_map(axes, result, 0, limits)
    speeds_shown(axes, result, 4)
    axes.set_xlabel("speed [rpm]", fontsize=FONT_SIZE)
    axes.set_ylabel(axis_label(result, "frequency"), fontsize=FONT_SIZE)
    draw_known(axes, variant.known, face="white")


def scale_of_variants(
    figure: Figure, axes: Axes, variant: Shown, box: tuple[float, float, float, float]
) -> None:
    """Draw the colour scale common to all maps, beside one of them."""
    draw_scale(figure, axes.images[0], variant.result, 0, box)


def draw_map(
    axes: Axes, result: FrequencyResponse, pair: int, limits: tuple[float, float] | None = None
) -> AxesImage:
    """Draw |H| as an even raster: a column of pixels shows the nearest speed, a pixel the largest
    amplitude in its row, peaks between frequencies included. Few speeds are drawn as bands.

    ``limits`` of the amplitude [printed unit]; by default those of the pair.
    """
    from matplotlib.image import PcolorImage

    rpm, frequency = result.speed * RPM.factor, result.frequency
    top = max(float(rpm[-1]), 1.0)
    edges = np.linspace(frequency[0], frequency[-1] * (1.0 + 1e-12), _ROWS + 1)
    values = with_peaks(peak_bins(amplitude(result, pair), frequency, edges), result, pair, edges)
    values[values <= 0.0] = np.nan
    low, high = limits or amplitude_range(values)
    first = float(rpm[0])
    values = np.minimum(values, high)  # without damping a peak has no limit
    pixel_rpm = first + (top - first) * (np.arange(_COLUMNS) + 0.5) / _COLUMNS
    values = nearest(values, rpm, pixel_rpm)
    if 1 < len(rpm) < LEAST_RASTER:
        distance = np.abs(pixel_rpm[:, None] - rpm).min(axis=1)
        values[distance > BAND * (top - first)] = np.nan
        axes.set_facecolor(UNKNOWN)
    ends = math.log10(low), math.log10(high)
    speeds = np.linspace(first, top, _COLUMNS + 1)
    # pixels by their cell: `imshow` would resample colours as numbers, 16 bytes a pixel on paper
    image = PcolorImage(axes, speeds, edges, _coloured(np.log10(values.T), *ends), rasterized=True)
    image.set_clim(*ends)
    image.set_clip_path(axes.patch)
    axes.add_image(image)
    axes.set_xlim(first, top)
    axes.set_ylim(0.0, float(edges[-1]))
    axes.grid(visible=False)
    return image


def _coloured(values: Array, low: float, high: float) -> NDArray[np.uint8]:
    """Map values between ``low`` and ``high`` to colours (n, m, 4) here: matplotlib would resample
    the values instead, many times as large on paper."""
    from matplotlib import colormaps

    share = np.ma.masked_invalid((values - low) / (high - low))
    return np.asarray(colormaps[COLOURS](share, bytes=True))


def with_peaks(
    values: Array,
    result: FrequencyResponse,
    pair: int,
    edges: Array,
) -> Array:
    """Amplitudes (speeds, bins) between ``edges`` [Hz] with every peak in its bin."""
    speed, place = np.nonzero(np.isfinite(result.peak_frequency[:, pair]))
    at = np.searchsorted(edges, result.peak_frequency[speed, pair, place], side="right") - 1
    size = np.abs(result.peak_value[speed, pair, place]) * shown(result.unit(pair)).factor
    raised = values.copy()
    np.maximum.at(raised, (speed, np.clip(at, 0, values.shape[1] - 1)), size)
    return raised


def speeds_shown(axes: Axes, result: FrequencyResponse, most: int) -> None:
    """Set the speed axis to the speeds of the case [rpm], with round ticks."""
    rpm = result.speed * RPM.factor
    speed_ticks(axes, max(float(rpm[-1]), 1.0), most)
    axes.set_xlim(float(rpm[0]), max(float(rpm[-1]), 1.0))


def draw_scale(
    figure: Figure,
    image: AxesImage,
    result: FrequencyResponse,
    pair: int,
    box: tuple[float, float, float, float],
) -> None:
    """Draw the colour scale of ``image`` beside its ``box`` [mm]."""
    left, bottom, wide, tall = box
    scale_box = (left + wide + 2.5, bottom, 3.0, tall)
    low, high = image.get_clim()
    scale = colour_scale(
        figure, scale_box, low, high, f"|H| [{shown(result.unit(pair)).unit}]", COLOURS
    )
    ticks = log_ticks(10.0**low, 10.0**high)
    scale.set_yticks([math.log10(v) for v, _ in ticks], [name for _, name in ticks])
