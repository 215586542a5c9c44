"""Frequency responses over frequency at chosen speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.arrays import Array, Complex
from rotordyn.figures.amplitudes import log_axis, phase_axis, wrapped_phase
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    DASHES,
    FONT_SIZE,
    add_axes,
    grid_boxes,
    line_of,
    marked,
    new_figure,
    round_ticks,
)
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROUNDING = 1e-12  # of the largest amplitude
LINEAR, PALE_GREY = "linear scale, logarithmic beyond", "#E4E4E4"
SHARP = 300.0  # times the median: a linear axis shows nothing beside a higher peak


def amplitude_phase_figure(result: FrequencyResponse, pairs: Sequence[int]) -> Figure:
    """Amplitude (log) over phase, a column per pair, a line per slice speed."""
    return _figure(result, pairs, ("amplitude", "phase"))


def real_imaginary_figure(result: FrequencyResponse, pairs: Sequence[int]) -> Figure:
    """Real over imaginary part, a column per pair, a line per slice speed."""
    return _figure(result, pairs, ("real part", "imaginary part"))


def _figure(result: FrequencyResponse, pairs: Sequence[int], parts: tuple[str, str]) -> Figure:
    figure = new_figure(168.0, 112.0)
    boxes = grid_boxes(figure, 2, len(pairs), margins=(17.0, 6.0, 12.0, 15.0), gaps=(17.0, 4.0))
    for column, pair in enumerate(pairs):
        for row, part in enumerate(parts):
            name = _label(part, result.unit(pair))
            box = boxes[row * len(pairs) + column]
            axes = add_axes(figure, box, axis_label(result, "frequency") if row else "", name)
            axes.tick_params(labelbottom=bool(row))
            _lines(axes, result, pair, part)
            if not row:
                axes.set_title(f"{result.kind} {result.pair[pair]}", fontsize=FONT_SIZE, pad=4.0)
    top_legend(figure, *figure.axes)
    return figure


def _label(part: str, unit: str) -> str:
    return f"{part} [{'deg' if part == 'phase' else shown(unit).unit}]"


def _lines(axes: Axes, result: FrequencyResponse, pair: int, part: str) -> None:
    top, factor = float(result.frequency[-1]), shown(result.unit(pair)).factor
    largest = 0.0
    for place, index in enumerate(np.flatnonzero(result.is_slice).tolist()):
        if not np.any(result.response[index, pair]):
            continue  # planes that nothing couples have no phase and no place on a log axis
        frequency, curve = result.curve(index, pair)
        largest = max(largest, float(np.abs(curve).max()) * factor)
        axes.plot(
            frequency,
            _part(curve * factor, part),
            lw=1.1,
            **line_of(place),
            **marked(place),
            label=f"{result.speed[index] * RPM.factor:.0f} rpm",
        )
    draw_measured(axes, result, pair, part)
    axes.set_xlim(0.0, top)
    axes.set_xticks(round_ticks(0.0, top, 4))
    if part == "phase":
        phase_axis(axes)
    elif part == "amplitude":
        log_axis(axes)
    else:
        _scale(axes, largest)


def _scale(axes: Axes, largest: float) -> None:
    """Scale the axis of a real or imaginary part: linear, or, where the highest peak is more than
    ``SHARP`` times the median, logarithmic on both sides of a linear band about zero. A part that
    is zero is annotated."""
    drawn = [np.abs(np.asarray(line.get_ydata(), float)) for line in axes.get_lines()]
    values = np.concatenate([np.zeros(1), *drawn])
    high = float(values.max())
    if high <= ROUNDING * largest:
        axes.set_ylim(-1.0, 1.0)
        axes.set_yticks([0.0])
        axes.annotate(
            "zero: no damping",
            (0.5, 0.6),
            xycoords="axes fraction",
            ha="center",
            fontsize=FONT_SIZE,
        )
        return
    median = float(np.median(values[values > 0.0]))
    if high < SHARP * median:
        return
    linear = 10.0 ** math.floor(math.log10(median))
    axes.set_yscale("symlog", linthresh=linear, linscale=0.5)
    axes.axhspan(-linear, linear, color=PALE_GREY, lw=0.0, zorder=0, label=LINEAR)
    decades = [10.0**k for k in range(round(math.log10(linear)), math.ceil(math.log10(high)) + 1)]
    labelled = decades[1 :: 1 + len(decades) // 4]
    axes.set_yticks([-value for value in labelled[::-1]] + [0.0, *labelled])
    axes.yaxis.set_major_formatter(lambda value, _: _power_of_ten(value))
    axes.minorticks_off()
    axes.set_ylim(-2.0 * high, 2.0 * high)


def _power_of_ten(value: float) -> str:
    """Tick label short enough to stay clear of the axis label: 0.01, 1, 1e-4."""
    sign, size = "\u2212" if value < 0.0 else "", abs(value)
    plain = size == 0.0 or 0.01 <= size < 1e4
    return sign + (f"{size:g}" if plain else f"{size:.0e}".replace("e-0", "e-"))


def draw_measured(
    axes: Axes, result: FrequencyResponse, pair: int, part: str, index: int | None = None
) -> None:
    """Draw measured responses of a pair, dashed; ``index``: only those nearest to that slice."""
    factor = shown(result.unit(pair)).factor
    for row, name in enumerate(result.measured):
        if result.measured_pair[row] != result.pair[pair]:
            continue
        speed = float(result.measured_speed[row])
        if index is not None and nearest_slice(result, speed) != index:
            continue
        frequency = result.measured_frequency[row]
        inside = (frequency >= result.frequency[0]) & (frequency <= result.frequency[-1])
        axes.plot(
            frequency[inside],
            _part(result.measured_response[row, inside] * factor, part),
            color=BLACK,
            lw=0.9,
            ls=DASHES[1 + row % (len(DASHES) - 1)],
            label=f"{name}, measured at {speed * RPM.factor:.0f} rpm",
        )


def nearest_slice(result: FrequencyResponse, speed: float) -> int:
    """Index, among all speeds, of the slice speed nearest to ``speed``."""
    slices = np.flatnonzero(result.is_slice)
    return int(slices[np.abs(result.speed[slices] - speed).argmin()])


def _part(values: Complex, part: str) -> Array:
    """The named part of complex values; a phase [deg] is broken where it wraps."""
    if part == "amplitude":
        return np.abs(values)
    if part != "phase":
        return np.asarray(values.real if part == "real part" else values.imag)
    return wrapped_phase(np.degrees(np.angle(values)))
