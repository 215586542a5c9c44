"""Frequency responses over frequency at chosen speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.figures.amplitudes import log_axis, wrapped_phase
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    CYCLE,
    DASHES,
    FONT_SIZE,
    add_axes,
    grid_boxes,
    new_figure,
    round_ticks,
)
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
ROUNDING = 1e-12  # of the largest amplitude


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
    frequency = result.frequency
    factor = shown(result.unit(pair)).factor
    for place, index in enumerate(np.flatnonzero(result.is_slice).tolist()):
        if not np.any(result.response[index, pair]):
            continue  # planes that nothing couples have no phase and no place on a log axis
        values = _part(result.response[index, pair] * factor, part)
        axes.plot(
            frequency,
            values,
            color=CYCLE[place % len(CYCLE)],
            lw=1.1,
            label=f"{result.speed[index] * RPM.factor:.0f} rpm",
        )
    draw_measured(axes, result, pair, part)
    axes.set_xlim(0.0, float(frequency[-1]))
    axes.set_xticks(round_ticks(0.0, float(frequency[-1]), 4))
    if part == "phase":
        axes.set_ylim(-190.0, 190.0)
        axes.set_yticks([-180.0, -90.0, 0.0, 90.0, 180.0])
    elif part == "amplitude":
        log_axis(axes)
    else:
        _keep_rounding_flat(
            axes, float(np.abs(result.response[result.is_slice, pair]).max()) * factor
        )


def _keep_rounding_flat(axes: Axes, largest: float) -> None:
    """A part that is nothing but rounding (imaginary, without damping) is drawn as a zero."""
    if max(map(abs, axes.get_ylim())) < ROUNDING * largest:
        axes.set_ylim(-largest, largest)


def draw_measured(
    axes: Axes, result: FrequencyResponse, pair: int, part: str, index: int | None = None
) -> None:
    """What was measured of a pair, dashed; ``index``: only what is nearest to that slice speed."""
    factor = shown(result.unit(pair)).factor
    for row, name in enumerate(result.measured):
        if result.measured_pair[row] != result.pair[pair]:
            continue
        speed = float(result.measured_speed[row])
        if index is not None and _nearest_slice(result, speed) != index:
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


def _nearest_slice(result: FrequencyResponse, speed: float) -> int:
    slices = np.flatnonzero(result.is_slice)
    return int(slices[np.abs(result.speed[slices] - speed).argmin()])


def _part(values: NDArray[np.complex128], part: str) -> Array:
    """The part asked for; a phase does not draw a line where it wraps."""
    if part == "amplitude":
        return np.abs(values)
    if part != "phase":
        return np.asarray(values.real if part == "real part" else values.imag)
    return wrapped_phase(np.degrees(np.angle(values)))
