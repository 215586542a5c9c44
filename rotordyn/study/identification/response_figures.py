"""Measured frequency responses beside those of the identified machine, speed by speed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

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

Array = NDArray[np.float64]
COLUMNS, ROW, MOST = 2, 50.0, 12  # mm; panels of a figure
DEEP = 1e-4  # of the highest value: below that no axis goes


def figures(found: Identification) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Name and drawing of the figure of every such measurement."""
    for place, each in enumerate(found.explained.problem.measurements):
        if isinstance(each, Responses):
            yield f"{each.word}_responses", partial(_responses, found, place)


def _responses(found: Identification, place: int) -> Figure:
    """Amplitudes, and what of them is not explained beside the noise."""
    measurement = found.explained.problem.measurements[place]
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
        _response(axes, found, place, k)
        drawn.append(axes)
    top_legend(figure, *drawn)
    return head(figure, found.title or found.name)


def _response(axes: Axes, found: Identification, place: int, k: int) -> None:
    best = found.explained
    measurement = best.problem.measurements[place]
    assert isinstance(measurement, Responses)
    one, data = measurement.responses[k], measurement.data
    parts = _parts(measurement, k)
    residual, predicted = best.residuals[place], best.fit.predicted[place]
    frequency = np.array(one.frequency)
    lines = (
        (predicted + residual, ".", GREY, "measured", 1.0),
        (predicted, "-", BLUE, "the machine", 1.0),
        (residual, "-", ORANGE, "difference", 0.6),
    )
    high = 0.0
    for values, look, colour, label, width in lines:
        size = np.hypot(*values[parts]) * data.factor
        high = max(high, float(size.max()))
        axes.plot(frequency, size, look, ms=2.4, lw=width, color=colour, label=label)
    noise = np.sqrt(2.0) * data.deviation[parts[0]] * data.factor
    axes.plot(frequency, noise, "--", lw=0.8, color=ORANGE, label="noise stated")
    axes.set_ylim(max(axes.get_ylim()[0], DEEP * high), 2.0 * high)
    log_axis(axes)
    axes.set_xlim(frequency[0], frequency[-1])
    words = f"{one.pair}, {one.speed * RPM.factor:.0f} rpm"
    axes.set_title(shortened(words, 44), fontsize=FONT_SIZE)
    axes.set_xlabel("frequency [Hz]", fontsize=FONT_SIZE - 1.0)
    axes.set_ylabel(f"|H| [{data.unit}]", fontsize=FONT_SIZE - 1.0)


def _parts(of: Responses, k: int) -> NDArray[np.intp]:
    """Rows of the real and imaginary part of a response (2, f)."""
    sizes = [2 * len(one.frequency) for one in of.responses]
    first = sum(sizes[:k])
    return np.arange(first, first + sizes[k]).reshape(2, -1)
