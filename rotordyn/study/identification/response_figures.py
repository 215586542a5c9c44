"""Figures of measured frequency responses and those of the identified machine."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Indices
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    BLUE,
    FONT_SIZE,
    GREY,
    ORANGE,
    add_axes,
    grid_boxes,
    head,
    new_figure,
)
from rotordyn.results.display import RPM
from rotordyn.study.identification.responses import Responses

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rotordyn.study.identification.identification import Identification

COLUMNS, ROW, MOST = 2, 50.0, 12  # mm; panels of a figure
DEEP = 1e-4  # lowest end of an axis over the highest value


def figures(result: Identification) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Yield name and drawing function of a figure for every measurement of responses."""
    for place, measurement in enumerate(result.explained.problem.measurements):
        if isinstance(measurement, Responses):
            yield f"{measurement.word}_responses", partial(_responses, result, place)


def _responses(result: Identification, place: int) -> Figure:
    """Draw amplitudes, residuals and noise of the responses of a measurement."""
    measurement = result.explained.problem.measurements[place]
    assert isinstance(measurement, Responses)
    order = sorted(measurement.responses, key=lambda one: one.speed)
    chosen = [measurement.responses.index(one) for one in order][:MOST]
    columns = min(COLUMNS, len(chosen))
    rows = -(-len(chosen) // columns)
    title = f"{len(chosen)} of {len(order)} responses" if len(chosen) < len(order) else ""
    figure = new_figure(height=26.0 + ROW * rows, title=title)
    boxes = grid_boxes(figure, rows, columns, margins=(17.0, 5.0, 12.0, 14.0))
    drawn = []
    for k, box in zip(chosen, boxes, strict=False):
        axes = add_axes(figure, box)
        _response(axes, result, place, k)
        drawn.append(axes)
    top_legend(figure, *drawn)
    return head(figure, result.title or result.name)


def _response(axes: Axes, result: Identification, place: int, k: int) -> None:
    best = result.explained
    measurement = best.problem.measurements[place]
    assert isinstance(measurement, Responses)
    response, data = measurement.responses[k], measurement.data
    parts = _parts(measurement, k)
    residual, predicted = best.residuals[place], best.fit.predicted[place]
    frequency = np.array(response.frequency)[measurement.compared(response)]
    lines = (
        (predicted + residual, ".", GREY, "measured", 1.0),
        (predicted, "-", BLUE, "the machine", 1.0),
        (residual, "-", ORANGE, "difference", 0.6),
    )
    high = 0.0
    for values, style, colour, label, width in lines:
        size = np.hypot(*values[parts]) * data.factor
        high = max(high, float(size.max()))
        axes.plot(frequency, size, style, ms=2.4, lw=width, color=colour, label=label)
    noise = np.sqrt(2.0) * data.deviation[parts[0]] * data.factor
    axes.plot(frequency, noise, "--", lw=0.8, color=ORANGE, label="noise stated")
    axes.set_ylim(max(axes.get_ylim()[0], DEEP * high), 2.0 * high)
    log_axis(axes)
    axes.set_xlim(response.frequency[0], response.frequency[-1])
    words = f"{response.pair}, {response.speed * RPM.factor:.0f} rpm"
    axes.set_title(shortened(words, 44), fontsize=FONT_SIZE)
    axes.set_xlabel("frequency [Hz]", fontsize=FONT_SIZE - 1.0)
    axes.set_ylabel(f"|H| [{data.unit}]", fontsize=FONT_SIZE - 1.0)


def _parts(of: Responses, k: int) -> Indices:
    """Indices of the real and imaginary parts of response ``k`` in the data (2, f)."""
    sizes = [2 * int(of.compared(one).sum()) for one in of.responses]
    first = sum(sizes[:k])
    return np.arange(first, first + sizes[k]).reshape(2, -1)
